//! Lane operations are inlined into the kernels that use them.
//!
//! An operation of a level that is chosen while the program runs can only be inlined into code compiled for that level. A
//! closure that the compiler leaves out of line is not, and then each operation within it is a call: the bytes of frames
//! stay, at a third of the speed. It happened once, in what lights and clouds look up.

use crate::{cargo, target};
use std::fs;

/// Part of the name of every operation that is a function of its own.
const OPERATION: &[u8] = b"__fearless_simd_kernel";
/// Part of the name of what `map` over an array becomes where it is not inlined: a tenth of the time of the flight once.
const MAP: &[u8] = b"try_map";
/// Part of the name of every kernel.
const KERNEL: &[u8] = b"__FearlessDispatch";

#[test]
#[ignore = "long: run by .ci/run"]
fn no_lane_operation_of_the_plain_build_is_a_call() {
    // The release build with its names, beside it.
    let mut words = vec!["build", "--bin", "paprsek", "--profile", "symbols"];
    let settings = ["inherits=\"release\"", "strip=false", "package.paprsek.strip=false"];
    let settings = settings.map(|setting| format!("profile.symbols.{setting}"));
    words.extend(settings.iter().flat_map(|setting| ["--config", setting]));
    let built = cargo(&words);
    assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
    let program = fs::read(target().join("symbols/paprsek")).unwrap();
    let count = |name: &[u8]| program.windows(name.len()).filter(|bytes| *bytes == name).count();
    assert!(count(KERNEL) > 0, "the program has no names");
    assert_eq!(count(MAP), 0, "`map` is called; a loop is not");
    assert_eq!(count(OPERATION), 0, "operations are called; `nm -C target/symbols/paprsek` names them");
}

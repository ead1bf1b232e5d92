//! Objects put in order, linked and run.

use object::{Object, ObjectSymbol};
use pack::link;
use pack::order::TASTES;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn work(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(name)
}

fn cc(arguments: &[&str]) {
    let output = Command::new("cc").args(arguments).output().expect("cc runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

fn path(path: &Path) -> &str {
    path.to_str().expect("a path that is text")
}

/// The program of an object, linked as it is or in order, and what it prints.
fn linked(object: &Path, name: &str) -> (Vec<u8>, String) {
    let program = work(name);
    cc(&["-no-pie", path(object), "-lm", "-o", path(&program)]);
    let output = Command::new(&program).output().expect("it runs");
    assert!(output.status.success(), "{name} fails: {}", output.status);
    (fs::read(&program).expect("just linked"), String::from_utf8(output.stdout).expect("it prints text"))
}

#[test]
fn a_program_in_order_does_the_same() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/order.c");
    for options in ["-O0", "-O2"] {
        let (object, ordered) = (work(&format!("as-is{options}.o")), work(&format!("ordered{options}.o")));
        let sections = ["-ffunction-sections", "-fdata-sections", "-fno-pie", "-fno-asynchronous-unwind-tables"];
        cc(&[&[options, "-g", "-c", path(&source), "-o", path(&object)], &sections[..]].concat());
        fs::write(&ordered, link::ordered(&fs::read(&object).expect("just compiled"), TASTES[0]).expect("an object"))
            .unwrap();
        let (before, said) = linked(&object, &format!("as-is{options}"));
        let (after, says) = linked(&ordered, &format!("ordered{options}"));
        assert_eq!(said, says);
        assert!(said.starts_with("4.75 6 "), "{said}");
        let has = |program: &[u8], name: &str| {
            let file = object::File::parse(program).expect("an executable");
            file.symbols().any(|symbol| symbol.name() == Ok(name))
        };
        assert!(has(&before, "nobody_s") && !has(&after, "nobody_s"));
        assert!(has(&after, "third") && has(&after, "first") != has(&after, "second"));
    }
}

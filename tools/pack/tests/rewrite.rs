//! Programs rewritten and run.

use pack::compress::costs;
use pack::elf;
use pack::rewrite::rewrite;
use pack_model::form::{Form, convert};
use pack_model::tuned::SETS;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn work(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(name)
}

/// What a program prints.
fn says(program: &Path) -> String {
    let output = Command::new(program).output().expect("it runs");
    assert!(output.status.success(), "{} fails: {}", program.display(), output.status);
    String::from_utf8(output.stdout).expect("it prints text")
}

#[test]
fn a_rewritten_program_does_the_same_and_packs_better() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let bits = |program: &[u8]| {
        let mut program = elf::trim(program).expect("a program");
        convert(&mut program.bytes[program.code.clone()], program.code_address as u32, Form::Coded);
        costs(&SETS, &program.bytes, program.code()).iter().map(|cost| cost.0).sum::<f32>()
    };
    // With the bits that are saved at least: there is little to choose where few instructions have three operands.
    let programs = [(&["-O1"][..], 0.0), (&["-O2", "-mavx2"], 90.0), (&["-O3", "-mavx2", "-ffast-math"], 400.0)];
    for (options, least) in programs {
        let name = options.concat();
        let (before, after) = (work(&format!("as-is{name}")), work(&format!("rewritten{name}")));
        let source = here.join("tests/rewrite.c");
        let mut cc = Command::new("cc");
        cc.args(options).args(["-no-pie", "-g0"]).arg(source).arg("-lm").arg("-o").arg(&before);
        assert!(cc.status().expect("cc runs").success(), "cc fails");
        let program = fs::read(&before).expect("just linked");
        let new = rewrite(&program).expect("an ordinary program");
        // Only instructions have changed.
        let code = elf::trim(&program).expect("a program").code;
        let mut with_new_code = program.clone();
        with_new_code[code.clone()].copy_from_slice(&new[code]);
        assert!(new == with_new_code && new != program, "{name}");
        let less = bits(&program) - bits(&new);
        assert!(less > least, "{name}: {less}");
        fs::copy(&before, &after).expect("the work directory is writable");
        fs::write(&after, new).expect("own file");
        assert_eq!(says(&before), says(&after), "{name}");
    }
}

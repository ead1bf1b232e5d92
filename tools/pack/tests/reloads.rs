//! Assembly without its needless reloads: functions at random, run before and after, and single cases.

use pack::reloads::shorten;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use testkit::random::Random;

const GENERAL: [&str; 10] = ["ax", "cx", "dx", "bx", "si", "8", "9", "10", "12", "13"];
const BLOCKS: usize = 8;

/// A function of assembly with the remarks of LLVM, which takes the address of 64 numbers.
struct Writer<'a> {
    random: &'a mut Random,
    text: String,
}

impl Writer<'_> {
    fn below(&mut self, end: usize) -> usize {
        (self.random.unit() * end as f64) as usize
    }

    fn line(&mut self, line: &str) {
        writeln!(self.text, "\t{line}").expect("text grows");
    }

    fn spelled(register: &str, size: usize) -> String {
        match (register.parse::<u8>().is_ok(), size) {
            (true, 8) => format!("%r{register}"),
            (true, _) => format!("%r{register}d"),
            (false, 8) => format!("%r{register}"),
            (false, _) => format!("%e{register}"),
        }
    }

    fn general(&mut self, size: usize) -> String {
        let register = GENERAL[self.below(GENERAL.len())];
        Self::spelled(register, size)
    }

    fn vector(&mut self) -> String {
        format!("%ymm{}", self.below(4))
    }

    /// Few, so that they meet; those of 4 bytes lie within those of 8.
    fn slot(&mut self, size: usize) -> String {
        match size {
            32 => format!("{}(%rsp)", 64 + 32 * self.below(2)),
            _ => format!("{}(%rsp)", size * self.below(24 / size)),
        }
    }

    fn instruction(&mut self) {
        let size = [8, 8, 8, 4][self.below(4)];
        let (letter, slot) = (if size == 8 { 'q' } else { 'l' }, self.slot(size));
        let (a, b) = (self.general(size), self.general(size));
        let (v, w, wide) = (self.vector(), self.vector(), self.slot(32));
        let line = match self.below(36) {
            0..10 => format!("mov{letter}\t{slot}, {a}\t# {size}-byte Reload"),
            10..14 => format!("mov{letter}\t{a}, {slot}\t# {size}-byte Spill"),
            14 => format!("mov{letter}\t{a}, {b}"),
            15 => format!("add{letter}\t{a}, {b}"),
            16 => format!("xor{letter}\t{slot}, {a}\t# {size}-byte Folded Reload"),
            17 => format!("add{letter}\t{a}, {slot}\t# {size}-byte Folded Spill"),
            18 => format!("cmp{letter}\t{slot}, {a}\t# {size}-byte Folded Reload"),
            19 => format!("cmp{letter}\t$7, {slot}\t# {size}-byte Folded Reload"),
            20 => "setb\t%al".into(),
            21 => format!("lea{letter}\t5({}), {b}", self.general(8)),
            22 => format!("imul{letter}\t$77, {a}, {b}"),
            23 => format!("vmovups\t{wide}, {v}\t# 32-byte Reload"),
            24 => format!("vmovups\t{v}, {wide}\t# 32-byte Spill"),
            25 => format!("vpaddd\t{wide}, {v}, {w}\t# 32-byte Folded Reload"),
            26 => format!("vpxor\t{v}, {w}, {v}"),
            27 => format!("vmovaps\t{v}, {w}"),
            28 => "callq\tclobber".into(),
            29 => format!("pushq\t$5\n\tpopq\t{}", self.general(8)),
            30 => "mulq\t%rcx".into(),
            31 => "#APP\n\tmovq\t$3, %rcx\n\txorl\t%ebx, %ebx\n\t#NO_APP".into(),
            _ => "movb\t$9, %cl".into(),
        };
        self.line(&line);
    }

    fn function(&mut self, number: usize) {
        writeln!(self.text, "subject{number}: # @subject{number}").expect("text grows");
        for register in ["bx", "bp", "12", "13", "14", "15"] {
            self.line(&format!("pushq\t{}", Self::spelled(register, 8)));
        }
        self.line("subq\t$264, %rsp\n\tmovq\t%rdi, 200(%rsp)\n\tmovq\t$40, 208(%rsp)");
        for (n, register) in GENERAL.iter().enumerate() {
            self.line(&format!("movq\t{}(%rdi), {}", 8 * n, Self::spelled(register, 8)));
        }
        for (slot, register) in GENERAL[..3].iter().enumerate() {
            self.line(&format!("movq\t{}, {}(%rsp)\t# 8-byte Spill", Self::spelled(register, 8), 8 * slot));
        }
        for n in 0..4 {
            self.line(&format!("vmovups\t{}(%rdi), %ymm{n}", 128 + 32 * n));
        }
        self.line("vmovups\t%ymm0, 64(%rsp)\t# 32-byte Spill\n\tvmovups\t%ymm1, 96(%rsp)\t# 32-byte Spill");
        for block in 0..BLOCKS {
            writeln!(self.text, ".LBB{number}_{block}:").expect("text grows");
            for _ in 0..12 {
                self.instruction();
            }
            // At most 40 times, so that it ends.
            self.line(&format!("decq\t208(%rsp)\n\tjs\t.LBB{number}_{BLOCKS}"));
            match self.below(4) {
                0 => self.line(&format!("movl\t%ecx, %eax\n\tandl\t$1, %eax\n\tjmpq\t*.LJTI{number}_0(,%rax,8)")),
                1 => {
                    let to = self.below(BLOCKS);
                    self.line(&format!("jmp\t.LBB{number}_{to}"));
                }
                _ => {
                    let (a, b, to) = (self.general(8), self.general(8), self.below(BLOCKS));
                    self.line(&format!("cmpq\t{a}, {b}\n\tjb\t.LBB{number}_{to}"));
                }
            }
        }
        writeln!(self.text, ".LBB{number}_{BLOCKS}:").expect("text grows");
        self.line("movq\t200(%rsp), %rdi");
        for (n, register) in GENERAL.iter().enumerate() {
            self.line(&format!("movq\t{}, {}(%rdi)", Self::spelled(register, 8), 8 * n));
        }
        for n in 0..4 {
            self.line(&format!("vmovups\t%ymm{n}, {}(%rdi)", 128 + 32 * n));
        }
        for slot in 0..3 {
            self.line(&format!(
                "movq\t{}(%rsp), %rax\t# 8-byte Reload\n\tmovq\t%rax, {}(%rdi)",
                8 * slot,
                256 + 8 * slot
            ));
        }
        for slot in 0..2 {
            self.line(&format!("vmovups\t{}(%rsp), %ymm0\t# 32-byte Reload", 64 + 32 * slot));
            self.line(&format!("vmovups\t%ymm0, {}(%rdi)", 288 + 32 * slot));
        }
        self.line("addq\t$264, %rsp");
        for register in ["15", "14", "13", "12", "bp", "bx"] {
            self.line(&format!("popq\t{}", Self::spelled(register, 8)));
        }
        self.line("retq");
        writeln!(self.text, ".Lfunc_end{number}:\n.LJTI{number}_0:").expect("text grows");
        for _ in 0..2 {
            let to = self.below(BLOCKS);
            self.line(&format!(".quad\t.LBB{number}_{to}"));
        }
    }
}

/// What the functions of an assembly do.
fn says(assembly: &str, name: &str) -> String {
    let place = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let [source, program]: [PathBuf; 2] = [format!("{name}.s"), name.into()].map(|name| place.join(name));
    fs::write(&source, assembly).expect("the work directory is writable");
    let main = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reloads.c");
    let cc = Command::new("cc").args(["-no-pie", "-O1"]).args([&main, &source]).arg("-o").arg(&program).status();
    assert!(cc.expect("cc runs").success(), "cc fails");
    let output = Command::new(&program).output().expect("it runs");
    assert!(output.status.success(), "{name}: {}", output.status);
    String::from_utf8(output.stdout).expect("it prints text")
}

#[test]
fn functions_do_the_same_without_needless_reloads() {
    if !std::arch::is_x86_feature_detected!("avx2") {
        return;
    }
    let mut random = Random(16);
    for round in 0..8 {
        let mut writer = Writer { random: &mut random, text: "\t.text\n".into() };
        for number in 0..64 {
            writer.function(number);
        }
        let mut text = writer.text + "\t.section\t.rodata\n\t.globl\tsubjects\nsubjects:\n";
        for number in 0..64 {
            writeln!(text, "\t.quad\tsubject{number}").expect("text grows");
        }
        text += "\t.section\t.note.GNU-stack,\"\",@progbits\n";
        let short = shorten(&text);
        let count = |text: &str| text.lines().filter(|line| line.starts_with('\t')).count();
        let (less, folded) =
            (count(&text) - count(&short), text.matches("Folded").count() - short.matches("Folded").count());
        assert!(less > 50 && folded > 100, "{less} instructions and {folded} accesses less");
        assert_eq!(says(&text, "reloads-as-is"), says(&short, "reloads-shortened"), "round {round}");
    }
}

/// The instructions that are left of a function's.
fn left(lines: &str) -> String {
    let text = format!("f: # @f\n{lines}\n.Lfunc_end0:\n");
    let short = shorten(&text);
    let code = |line: &str| line.split('#').next().unwrap_or_default().trim_end().to_owned();
    let lines: Vec<_> = short.lines().map(code).filter(|line| !line.is_empty() && !line.ends_with(':')).collect();
    lines.join("\n")
}

#[test]
fn what_a_register_holds_is_not_loaded_again() {
    let spill = "\tmovq\t%rax, 8(%rsp)\t# 8-byte Spill\n";
    let reload = "\tmovq\t8(%rsp), %rax\t# 8-byte Reload\n";
    let cases: [(String, &str); 8] = [
        // After the store itself, after another load, and through a copy.
        (format!("{spill}{reload}"), "\tmovq\t%rax, 8(%rsp)"),
        (format!("{reload}{reload}"), "\tmovq\t8(%rsp), %rax"),
        (format!("{reload}\tmovq\t%rax, %rbx\n\taddq\t8(%rsp), %rax\t# 8-byte Folded Reload\n{spill}"), {
            "\tmovq\t8(%rsp), %rax\n\tmovq\t%rax, %rbx\n\taddq\t%rax, %rax\n\tmovq\t%rax, 8(%rsp)"
        }),
        // A store of what is there already.
        (format!("{reload}{spill}"), "\tmovq\t8(%rsp), %rax"),
        // Four bytes, where zeros are known to be above them.
        (
            "\tmovl\t%eax, 8(%rsp)\t# 4-byte Spill\n\tmovl\t8(%rsp), %eax\t# 4-byte Reload".into(),
            "\tmovl\t%eax, 8(%rsp)\n\tmovl\t8(%rsp), %eax",
        ),
        (
            "\taddl\t$1, %eax\n\tmovl\t%eax, 8(%rsp)\t# 4-byte Spill\n\tmovl\t8(%rsp), %eax\t# 4-byte Reload".into(),
            "\taddl\t$1, %eax\n\tmovl\t%eax, 8(%rsp)",
        ),
        // The lower lanes of a vector, by the name that the instruction needs.
        (
            "\tvmovaps\t32(%rsp), %ymm1\t# 32-byte Reload\n\tvmulss\t32(%rsp), %xmm2, %xmm3\t# 4-byte Folded Reload"
                .into(),
            "\tvmovaps\t32(%rsp), %ymm1\n\tvmulss\t%xmm1, %xmm2, %xmm3",
        ),
        // A constant.
        (
            "\tvbroadcastss\t.LCPI0_0(%rip), %ymm3\n\tvpbroadcastd\t.LCPI0_0(%rip), %ymm3".into(),
            "\tvbroadcastss\t.LCPI0_0(%rip), %ymm3",
        ),
    ];
    for (lines, expected) in cases {
        assert_eq!(left(&lines), expected, "{lines}");
    }
}

#[test]
fn what_may_have_changed_is_loaded() {
    let reload = "\tmovq\t8(%rsp), %rax\t# 8-byte Reload";
    for between in [
        "\taddq\t$1, %rax",
        "\tmovb\t$1, %al",
        "\tcallq\tg",
        "\tmovq\t%rbx, 8(%rsp)\t# 8-byte Spill",
        "\tmovl\t%ebx, 12(%rsp)\t# 4-byte Spill",
        "\tincq\t8(%rsp)\t# 8-byte Folded Spill",
        // As an argument of a call would be.
        "\tmovq\t%rbx, (%rsp)",
        "\tpushq\t$1\n\tpopq\t%rax",
        "\tsubq\t$16, %rsp",
        "\tandq\t$-32, %rsp",
        "\tcpuid",
        "\tlock\n\tcmpxchgq\t%rcx, (%rdx)",
        "\t#APP\n\tmovq\t$3, %rax\n\t#NO_APP",
        // One of two ways leads there without it.
        "\tjne\t.LBB0_1\n\txorl\t%eax, %eax\n.LBB0_1:",
        // Around a loop it is not there any more.
        ".LBB0_1:\n\tcmpq\t8(%rsp), %rax\t# 8-byte Folded Reload\n\tincq\t%rax\n\tjne\t.LBB0_1",
    ] {
        let lines = format!("{reload}\n{between}\n{reload}");
        let loads = left(&lines).matches("\tmovq\t8(%rsp), %rax").count();
        assert_eq!(loads, 2, "{between}");
    }
}

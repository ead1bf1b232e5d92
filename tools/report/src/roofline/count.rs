//! The instructions of a piece of work, counted by Valgrind's Callgrind and told apart by their names in objdump's listing.
//!
//! Callgrind executes the program on a processor of its own, instruction by instruction, and writes how often each one ran.
//! So the counts are exact, and the same on any machine. What is before and beside the work takes part too: so it is run
//! twice, with fewer and with more repetitions, and their difference counts.

use crate::options::Result;
use crate::program::output;
use std::collections::HashMap;
use std::ops::{AddAssign, Sub};
use std::path::Path;
use std::process::Command;

/// Caches that Callgrind simulates: those of a core of most machines since 2020, and a slice of the last level.
const CACHES: [&str; 3] = ["--I1=32768,8,64", "--D1=32768,8,64", "--LL=33554432,16,64"];
/// Bytes of a line of a cache.
const LINE: f64 = 64.0;

/// What a piece of work executes.
#[derive(Clone, Copy, Default, Debug)]
pub struct Count {
    /// Instructions on vectors, that add, multiply, divide, compare, round, convert, shift or are logical.
    pub arithmetic: f64,
    /// Instructions that move, shuffle, select or gather vectors.
    pub moves: f64,
    /// Every other instruction.
    pub scalar: f64,
    /// Lanes of 32 bits in the first ones.
    pub operations: f64,
    /// Bytes that are loaded or stored.
    pub bytes: f64,
    /// Bytes of lines that come from beyond the first cache, and from memory.
    pub beyond: [f64; 2],
}

impl Count {
    /// The number of instructions.
    pub fn all(&self) -> f64 {
        self.arithmetic + self.moves + self.scalar
    }

    /// So many of these.
    pub fn times(self, factor: f64) -> Count {
        self.with(self, |own, _| own * factor)
    }

    fn with(self, other: Count, f: impl Fn(f64, f64) -> f64) -> Count {
        Count {
            arithmetic: f(self.arithmetic, other.arithmetic),
            moves: f(self.moves, other.moves),
            scalar: f(self.scalar, other.scalar),
            operations: f(self.operations, other.operations),
            bytes: f(self.bytes, other.bytes),
            beyond: [0, 1].map(|k| f(self.beyond[k], other.beyond[k])),
        }
    }
}

impl Sub for Count {
    type Output = Count;
    fn sub(self, other: Count) -> Count {
        self.with(other, |own, other| own - other)
    }
}

impl AddAssign for Count {
    fn add_assign(&mut self, other: Count) {
        *self = self.with(other, |own, other| own + other);
    }
}

/// What the instructions of a program do, by their addresses in its file.
pub type Listing = HashMap<u64, Count>;

/// The instructions of a program's file.
pub fn listing(program: &Path) -> Result<Listing> {
    let text = output(Command::new("objdump").args(["-d", "-M", "intel", "--no-show-raw-insn"]).arg(program))?;
    let text = String::from_utf8(text)?;
    let line = |line: &str| {
        let (address, instruction) = line.split_once(":\t")?;
        Some((u64::from_str_radix(address.trim(), 16).ok()?, classify(instruction)))
    };
    Ok(text.lines().filter_map(line).collect())
}

/// What one instruction does, by its name and operands.
fn classify(instruction: &str) -> Count {
    let (name, operands) = instruction.split_once(' ').unwrap_or((instruction, ""));
    let operands = operands.split('#').next().unwrap_or_default();
    let bytes = if name == "lea" || name.starts_with("nop") { 0.0 } else { memory(operands) };
    let count = Count { bytes, ..Count::default() };
    if !operands.contains("mm") {
        return Count { scalar: 1.0, ..count };
    }
    let lanes = if name.ends_with("ss") || name.ends_with("sd") || name.contains("si") && !name.starts_with("vp") {
        1.0
    } else if operands.contains("ymm") {
        8.0
    } else {
        4.0
    };
    let bare = name.trim_start_matches('v');
    let arithmetic = [
        "add", "sub", "mul", "div", "sqrt", "min", "max", "round", "cmp", "and", "or", "xor", "cvt", "rcp", "rsqrt",
        "padd", "psub", "pmul", "pmadd", "pmin", "pmax", "pcmp", "pand", "por", "pxor", "psll", "psrl", "psra", "pabs",
        "ucomis", "comis",
    ];
    // A shift by whole bytes is a shuffle.
    let bytewise = bare.ends_with("slldq") || bare.ends_with("srldq");
    if arithmetic.iter().any(|start| bare.starts_with(start)) && !bytewise {
        Count { arithmetic: 1.0, operations: lanes, ..count }
    } else if bare.starts_with("pgather") || bare.starts_with("gather") {
        Count { moves: 1.0, bytes: 4.0 * lanes, ..count }
    } else {
        Count { moves: 1.0, ..count }
    }
}

/// Bytes of the operand in memory, if there is one.
fn memory(operands: &str) -> f64 {
    let sizes = [("YMMWORD", 32.0), ("XMMWORD", 16.0), ("QWORD", 8.0), ("DWORD", 4.0), ("BYTE", 1.0), ("WORD", 2.0)];
    sizes.iter().find(|(size, _)| operands.contains(&format!("{size} PTR"))).map_or(0.0, |(_, bytes)| *bytes)
}

/// What a run of a program executes, by Callgrind. The program must have kept its symbols: Callgrind tells the place of an
/// instruction within a file only of files that have them.
pub fn count(program: &Path, words: &[&str], listing: &Listing) -> Result<Count> {
    let file = tempfile::NamedTempFile::new()?;
    let mut valgrind = Command::new("valgrind");
    valgrind.args([
        "--tool=callgrind",
        "--dump-instr=yes",
        "--compress-pos=no",
        "--compress-strings=no",
        "--cache-sim=yes",
    ]);
    valgrind.args(CACHES).arg(format!("--callgrind-out-file={}", file.path().display())).arg(program).args(words);
    output(&mut valgrind)?;
    let own = program.to_str().ok_or("the program's path is not UTF-8")?;
    let (mut within, mut met) = (false, false);
    let mut sum = Count::default();
    let text = std::fs::read_to_string(file.path())?;
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if line.starts_with("calls=") {
            // The costs of what is called stand in the next line, and where they arise once more.
            lines.next();
        } else if let Some(object) = line.strip_prefix("ob=") {
            within = object == own;
        } else if let Some(line) = line.strip_prefix("0x") {
            let mut words = line.split(' ');
            let address = u64::from_str_radix(words.next().ok_or("a line without an address")?, 16)?;
            // Executions, reads, writes; misses of the first cache: instructions, reads, writes; of the last: the same.
            let mut events = [0.0; 9];
            for (event, word) in events.iter_mut().zip(words.skip(1)) {
                *event = word.parse()?;
            }
            // What libraries do is scalar here: most of it is the same in two runs.
            let one = if within { listing.get(&address).copied() } else { None };
            met |= one.is_some();
            sum += one.unwrap_or(Count { scalar: 1.0, ..Count::default() }).times(events[0]);
            sum.beyond[0] += LINE * (events[4] + events[5]);
            sum.beyond[1] += LINE * (events[7] + events[8]);
        }
    }
    if met { Ok(sum) } else { Err(format!("none of the instructions is one of {own}: has it no symbols?").into()) }
}

//! Where the bytes of an executable go, at a stand-in for the packer's costs:
//! `cargo run --release -p pack --example sizes -- FILE [--self] [--functions N] [--within N] [--lines N]`.
//! The file must have symbols and lines: build with `-Cdebuginfo=1`, unstripped.

use std::collections::HashMap;
use std::io::Write;

use object::read::elf::ElfFile64;
use object::{Object, ObjectSection, ObjectSegment};
use pack::table::{Profile, View, lines, markdown};

const USAGE: &str = "usage: sizes FILE [--self] [--functions N] [--within N] [--lines N]";

fn main() -> Result<(), String> {
    let mut args = std::env::args().skip(1);
    let mut path = None;
    let mut whole = View::Owner;
    let mut tops = Vec::new();
    while let Some(arg) = args.next() {
        let view = match &*arg {
            "--functions" => View::Function,
            "--within" => View::Within,
            "--lines" => View::Line,
            "--self" => {
                whole = View::Inner;
                continue;
            }
            _ => {
                path = Some(arg);
                continue;
            }
        };
        let count: usize = args.next().and_then(|n| n.parse().ok()).ok_or(format!("{arg} wants a number"))?;
        tops.push((view, count));
    }
    let path = path.ok_or(USAGE)?;
    let elf = std::fs::read(&path).map_err(|e| format!("{path}: {e}"))?;
    let costs = costs(&elf)?;
    let bits = |at: u64| costs.get(&at).copied();
    let profile = Profile::read(&elf)?;
    let mut text = markdown(&profile.rows(whole, &bits));
    for (view, count) in tops {
        let mut rows = profile.rows(view, &bits);
        rows.truncate(count);
        text += &format!("\n{}", lines(&rows));
    }
    // A pager that has seen enough is no error.
    let _ = std::io::stdout().write_all(text.as_bytes());
    Ok(())
}

/// Bits of each loaded byte by an adaptive mix of orders 0 to 2 in the logistic domain: about what a packer makes of it.
fn costs(elf: &[u8]) -> Result<HashMap<u64, f32>, String> {
    let file = ElfFile64::<object::Endianness>::parse(elf).map_err(|e| e.to_string())?;
    // strip takes these out.
    let dropped = [".comment", ".note.gnu.property", ".note.ABI-tag", ".eh_frame", ".debug_gdb_scripts"];
    let dropped: Vec<_> = file
        .sections()
        .filter(|s| s.name().is_ok_and(|n| dropped.contains(&n)))
        .map(|s| s.address()..s.address() + s.size())
        .collect();
    let mut costs = HashMap::new();
    let mut model = Model::new();
    for segment in file.segments() {
        for (at, &byte) in (segment.address()..).zip(segment.data().map_err(|e| e.to_string())?) {
            if !dropped.iter().any(|d| d.contains(&at)) {
                costs.insert(at, model.cost(byte));
            }
        }
    }
    Ok(costs)
}

const ORDERS: usize = 4;

struct Model {
    counts: Vec<HashMap<u64, f32>>,
    weights: [f32; ORDERS],
    history: u64,
}

impl Model {
    fn new() -> Self {
        Self { counts: vec![HashMap::new(); ORDERS], weights: [0.4; ORDERS], history: 0 }
    }

    fn cost(&mut self, byte: u8) -> f32 {
        let mut bits = 0.0;
        let mut seen = 1u64;
        for i in (0..8).rev() {
            let bit = f32::from(byte >> i & 1);
            let keys: [u64; ORDERS] = std::array::from_fn(|n| (self.history & ((1 << (8 * n)) - 1)) << 8 | seen);
            let stretched: [f32; ORDERS] =
                std::array::from_fn(|n| self.counts[n].get(&keys[n]).map_or(0.0, |p| (p / (1.0 - p)).ln()));
            let dot: f32 = stretched.iter().zip(self.weights).map(|(s, w)| s * w).sum();
            let p = (1.0 / (1.0 + (-dot).exp())).clamp(1.0 / 4096.0, 1.0 - 1.0 / 4096.0);
            bits -= if bit == 1.0 { p.log2() } else { (1.0 - p).log2() };
            for n in 0..ORDERS {
                self.weights[n] += 0.02 * stretched[n] * (bit - p);
                let count = self.counts[n].entry(keys[n]).or_insert(0.5);
                *count = (*count + (bit - *count) * 0.18).clamp(0.002, 0.998);
            }
            seen = seen << 1 | u64::from(byte >> i & 1);
        }
        self.history = self.history << 8 | u64::from(byte);
        bits
    }
}

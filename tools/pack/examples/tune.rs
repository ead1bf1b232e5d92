//! Searches for better contexts at random: `tune SECONDS [SKIP-FROM SKIP-TO] FILE...` changes one set of features at
//! a time and keeps what makes the files together smaller, then prints the table of `model/src/tuned.rs`.
//! What lies between the two offsets is left out of each file. A file needs its sections, as `paprsek.ordered` in
//! `target/intro/build` has them: without, all of it counts as instructions.

use pack::compress::costs;
use pack::elf;
use pack_model::form::{Form, convert};
use pack_model::model::{CONTEXTS, Sets};
use pack_model::tuned::SETS;
use std::time::Instant;

/// Marsaglia's xorshift.
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as usize % end
    }
}

type Text = (Vec<u8>, [u32; 3]);

fn bytes(sets: &Sets, texts: &[Text]) -> f64 {
    let cost = |text: &Text| costs(sets, &text.0, text.1).iter().map(|c| c.0 as f64).sum::<f64>();
    texts.iter().map(cost).sum::<f64>() / 8.0
}

fn changed(sets: &Sets, random: &mut Random) -> Sets {
    let mut new = *sets;
    let class = (random.below(5) == 0) as usize;
    let other = sets[class][random.below(CONTEXTS)];
    let set = &mut new[class][random.below(CONTEXTS)];
    match random.below(8) {
        0 => *set = other,
        1 => *set = 0,
        _ => {}
    }
    for _ in 0..=random.below(3) {
        // Adding and removing are tried equally often, though most features are absent.
        let mut feature = random.below(32);
        if random.below(2) == 0 && *set != 0 {
            while *set >> feature & 1 == 0 {
                feature = random.below(32);
            }
        }
        *set ^= 1 << feature;
    }
    new
}

fn main() {
    let mut arguments: Vec<String> = std::env::args().skip(1).collect();
    let mut numbers = Vec::new();
    while let Some(number) = arguments.first().and_then(|a| a.parse::<usize>().ok()) {
        numbers.push(number);
        arguments.remove(0);
    }
    let mut texts: Vec<Text> = Vec::new();
    for name in &arguments {
        let file = std::fs::read(name).unwrap_or_else(|error| panic!("{name}: {error}"));
        let mut t = elf::trim(&file).unwrap_or_else(|error| panic!("{name}: {error}"));
        convert(&mut t.bytes[t.code.clone()], t.code_address as u32, Form::Coded);
        if let [_, from, to] = numbers[..] {
            t.bytes.drain(from..to);
            t.code.end -= to - from;
        }
        let code = t.code();
        texts.push((t.bytes, code));
    }
    let (start, mut best) = (Instant::now(), SETS);
    let mut least = bytes(&best, &texts);
    println!("{least:.0} bytes");
    let mut random = Random(0x9e37_79b9_7f4a_7c15 ^ std::process::id() as u64);
    while start.elapsed().as_secs() < numbers.first().map_or(0, |&n| n as u64) {
        let new = changed(&best, &mut random);
        let size = bytes(&new, &texts);
        if size < least {
            (best, least) = (new, size);
            println!("{least:.0} bytes after {} s: {best:#010x?}", start.elapsed().as_secs());
        }
    }
}

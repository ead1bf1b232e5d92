//! `replay TARGET RUNS SEED FILE...`: feeds files to a target, and then so many mutations of them.
//!
//! What broke the target is left in `target/fuzz/TARGET-last`, whatever ended the process.

use fuzz::mutate::{Random, mutant};
use std::{env, fs, process};

fn main() {
    let mut words = env::args().skip(1);
    let mut word = || words.next().unwrap_or_else(|| usage());
    let (target, runs, seed) = (word(), word(), word());
    let (Ok(runs), Ok(seed)) = (runs.parse::<usize>(), seed.parse()) else { usage() };
    let inputs: Vec<Vec<u8>> = words.map(|path| fs::read(&path).expect("a file to read")).collect();
    fs::create_dir_all("target/fuzz").expect("a directory to write to");
    let last = format!("target/fuzz/{target}-last");
    let mut random = Random(seed);
    for number in 0..inputs.len() + runs {
        let input = inputs.get(number).cloned().unwrap_or_else(|| mutant(&mut random, &inputs));
        fs::write(&last, &input).expect("a file to write to");
        fuzz::run(&target, &input);
    }
    fs::remove_file(&last).expect("the file that was written");
    println!("{target}: {} files, {runs} mutations", inputs.len());
}

fn usage() -> ! {
    eprintln!("replay TARGET RUNS SEED FILE...");
    process::exit(2)
}

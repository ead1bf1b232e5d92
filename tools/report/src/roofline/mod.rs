//! What kernels and frames reach of what the machine could do: the roofline of Williams, Waterman and Patterson (2009).
//!
//! Arithmetic and bandwidths of memory are measured, instructions and bytes are counted, times are measured. Writes
//! `roofline.md` and `roofline.svg`. It needs `valgrind` and `objdump`, and a processor with AVX2.

mod count;
mod work;

use crate::limits;
use crate::machine;
use crate::options::{Common, Result};
use crate::plot::{self, Axis, Curve};
use count::Count;
use fearless_simd::Level;
use paprsek::frame::Renderer;
use std::fmt::Write;
use std::path::Path;
use work::{WORKS, Work};

/// What is measured.
#[derive(clap::Args)]
pub struct Options {
    #[command(flatten)]
    pub common: Common,
    /// Only do one row's work, so many times after the first: what is counted.
    #[arg(long, hide = true, requires = "times")]
    work: Option<String>,
    /// How many times.
    #[arg(long, hide = true)]
    times: Option<usize>,
}

const SIZE: (usize, usize) = (1280, 720);
const SMALL: (usize, usize) = (160, 90);
/// The level that Valgrind knows, and most machines.
const LEVEL: &str = "avx2";
/// Frames that are timed, after the first.
const TIMES: usize = 4;
/// The most operations per byte that the figure shows.
const MOST: f64 = 1000.0;
/// Bytes of the pieces that are read again and again: within the first cache and within the second.
const PIECES: [usize; 2] = [1 << 14, 1 << 18];

/// What one core of the machine can do, per second.
struct Peak {
    cycles: f64,
    /// Vectors that are added or multiplied.
    arithmetic: f64,
    /// Bytes read of the first cache, the second and memory.
    bytes: [f64; 3],
}

/// A row of the table.
struct Row {
    work: &'static Work,
    count: Count,
    seconds: f64,
}

/// Measures and counts, and writes the table and the figure.
pub fn run(options: &Options) -> Result {
    let Common { quick, out } = &options.common;
    let (size, rounds) = if *quick { (SMALL, 1) } else { (SIZE, 9) };
    let level = paprsek::simd::level::all().into_iter().find(|(name, _)| *name == LEVEL);
    let (_, level) = level.ok_or("the roofline is one of AVX2, which this processor lacks")?;
    if let (Some(name), Some(times)) = (&options.work, options.times) {
        let work = WORKS.iter().find(|work| work.name == name).ok_or_else(|| format!("no work is called {name}"))?;
        return work.run(level, size, times).map(|_| ());
    }
    let program = std::env::current_exe()?;
    let listing = count::listing(&program)?;
    let run = |work: &Work, times: &str| {
        let mut words = vec!["roofline", "--work", work.name, "--times", times];
        words.extend(quick.then_some("--quick"));
        count::count(&program, &words, &listing).map_err(|error| error.to_string())
    };
    let peak = peak(level, rounds)?;
    let mut rows = Vec::new();
    for work in &WORKS {
        let seconds = (0..rounds).map(|_| work.run(level, size, TIMES));
        let seconds = seconds.collect::<Result<Vec<f64>>>()?.into_iter().fold(f64::MAX, f64::min);
        // The second frame is what two have more than one.
        let [one, two] = std::thread::scope(|scope| {
            let runs = ["0", "1"].map(|times| scope.spawn(move || run(work, times)));
            runs.map(|run| run.join().expect("counting does not panic"))
        });
        rows.push(Row { work, count: two? - one?, seconds: seconds / TIMES as f64 });
        eprintln!("{}: counted", work.name);
    }
    std::fs::create_dir_all(out)?;
    let file = out.join("roofline.md");
    std::fs::write(&file, markdown(&options.common, size, rounds, &peak, &rows)?)?;
    draw(&out.join("roofline.svg"), &peak, &rows)?;
    println!("{}", file.display());
    Ok(())
}

fn peak(level: Level, rounds: usize) -> Result<Peak> {
    let renderer = Renderer::new(1)?.at_level(level);
    let [near, far] = PIECES.map(|bytes| limits::bandwidth(level, bytes, rounds));
    let particle = (limits::NUMBERS * size_of::<f32>()) as f64;
    let memory = limits::memory(&renderer, rounds)[0] * particle;
    Ok(Peak {
        cycles: limits::clock(rounds),
        arithmetic: limits::arithmetic(&renderer, level, rounds),
        bytes: [near, far, memory],
    })
}

fn markdown(options: &Common, size: (usize, usize), rounds: usize, peak: &Peak, rows: &[Row]) -> Result<String> {
    let mut text = format!("# Roofline\n\nWritten by `{}`; not edited by hand.\n\n", options.command("roofline"));
    let Peak { cycles, arithmetic, bytes } = peak;
    let [near, far, memory] = bytes.map(|bytes| bytes / 1e9);
    writeln!(
        text,
        "{}; one thread, {LEVEL}, {}x{}. Times are of the best of {rounds} rounds of {TIMES} frames, instructions of one.\n\n\
         ## What one core can do\n\n\
         | | measured by | per second | per cycle |\n|---|---|--:|--:|\n\
         | cycles | a word that is turned and added to, each step waiting for the last | {:.2}e9 | |\n\
         | arithmetic | six chains of sums beside six of products, vectors of 8 lanes | {:.1}e9 operations | {:.1} |\n\
         | first cache | a sum of 16 kB, again and again | {near:.0} GB | {:.0} bytes |\n\
         | second cache | of 256 kB | {far:.0} GB | {:.0} bytes |\n\
         | memory | of 512 MB | {memory:.1} GB | {:.1} bytes |\n",
        machine::machine(),
        size.0,
        size.1,
        cycles / 1e9,
        arithmetic * 8.0 / 1e9,
        arithmetic * 8.0 / cycles,
        bytes[0] / cycles,
        bytes[1] / cycles,
        bytes[2] / cycles,
    )?;
    text += "## What frames reach of it\n\n\
         Instructions are counted by Valgrind's Callgrind, each time it is executed, and told apart by their names. \
         Arithmetic: those on vectors that add, multiply, divide, compare, convert, shift or are logical, in floats and in \
         whole numbers; an operation is one lane of them, whether it is masked or not. Moves: other instructions on vectors, \
         that load, store, shuffle, select or gather. The rest is scalar. Bytes are those of every operand in memory. What \
         comes from beyond the caches is simulated: 32 kB of 64-byte lines in the first, 32 MB in the last.\n\n\
         | work | kernel | ms | million instructions | arithmetic, moves, scalar | per cycle | Gop/s, of peak | operands, GB/s, of the first cache's | from beyond the first cache, of the second's | from memory, GB/s, of peak |\n\
         |---|---|--:|--:|--:|--:|--:|--:|--:|--:|\n";
    for Row { work, count, seconds } in rows {
        let share = |part: f64| 100.0 * part / count.all();
        let rate = |amount: f64| amount / seconds;
        let of = |amount: f64, peak: f64| format!("{:.1}, {:.0} %", rate(amount) / 1e9, 100.0 * rate(amount) / peak);
        writeln!(
            text,
            "| `{}` | {} | {:.2} | {:.1} | {:.0}, {:.0}, {:.0} % | {:.2} | {} | {} | {} | {} |",
            work.name,
            work.kernel,
            1e3 * seconds,
            count.all() / 1e6,
            share(count.arithmetic),
            share(count.moves),
            share(count.scalar),
            rate(count.all()) / cycles,
            of(count.operations, 8.0 * arithmetic),
            of(count.bytes, bytes[0]),
            of(count.beyond[0], bytes[1]),
            of(count.beyond[1], bytes[2]),
        )?;
    }
    text += "\n![Operations per second against operations per byte from beyond the first cache](roofline.svg)\n";
    Ok(text)
}

/// The figure: operations per second against operations for each byte that comes from beyond the first cache.
fn draw(path: &Path, peak: &Peak, rows: &[Row]) -> Result {
    let roof = |name: &str, bytes: f64| {
        let point = |intensity: f64| (intensity, (intensity * bytes).min(8.0 * peak.arithmetic) / 1e9, String::new());
        // The line bends where bandwidth is enough for all arithmetic.
        let bend = 8.0 * peak.arithmetic / bytes;
        Curve { name: name.into(), points: [0.25, bend, MOST].map(point).into() }
    };
    let mut curves = vec![roof("second cache", peak.bytes[1]), roof("memory", peak.bytes[2])];
    curves.extend(rows.iter().map(|Row { work, count, seconds }| {
        // Nothing comes from beyond for noise, of whose points a block is in use at a time.
        let intensity = (count.operations / count.beyond[0].max(1.0)).min(MOST);
        let point = (intensity, count.operations / seconds / 1e9, work.name.into());
        Curve { name: work.name.into(), points: vec![point] }
    }));
    let axes = [
        Axis { name: "operations per byte from beyond the first cache" },
        Axis { name: "billion operations per second, one core" },
    ];
    plot::draw(path, &["AVX2"], &[curves], axes)
}

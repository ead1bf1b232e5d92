//! The machine that measures.

use crate::options::Result;
use fearless_simd::Level;
use paprsek::simd::level;
use std::process::Command;

/// The processor's name and number of threads.
pub fn machine() -> String {
    let cpu = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let field = |name: &str| cpu.lines().find(|l| l.starts_with(name)).and_then(|l| l.split(": ").nth(1));
    let count = std::thread::available_parallelism().map_or(1, usize::from);
    let (family, model) = (field("cpu family").unwrap_or("?"), field("model\t").unwrap_or("?"));
    format!("{}, family {family} model {model}, {count} threads", field("model name").unwrap_or("unknown processor"))
}

/// The SIMD levels that speeds are told at: AVX2, which most machines and the packed intro have, and the best of this one.
pub fn levels() -> Vec<(&'static str, Level)> {
    let all = level::all();
    let mut levels: Vec<_> = all.iter().filter(|(name, _)| *name == "avx2").copied().collect();
    if all[0].0 != "avx2" {
        levels.push(all[0]);
    }
    levels
}

/// The day in Greenwich, as in 2026-11-22.
pub fn date() -> Result<String> {
    let date = Command::new("date").args(["-u", "+%F"]).output()?.stdout;
    Ok(String::from_utf8(date)?.trim().into())
}

/// The compiler and the revision of the sources.
pub fn versions() -> String {
    let first = |program: &str, arguments: &[&str]| {
        let output = Command::new(program).args(arguments).output().ok()?.stdout;
        Some(String::from_utf8(output).ok()?.trim().to_string()).filter(|line| !line.is_empty())
    };
    let rustc = first("rustc", &["--version"]).unwrap_or("unknown compiler".into());
    let revision = first("git", &["describe", "--always", "--dirty"]).unwrap_or("unknown revision".into());
    format!("{rustc}, revision {revision}")
}

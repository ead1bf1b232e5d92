//! The machine that measures.

/// The processor's name and number of threads.
pub fn machine() -> String {
    let cpu = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let field = |name: &str| cpu.lines().find(|l| l.starts_with(name)).and_then(|l| l.split(": ").nth(1));
    let count = std::thread::available_parallelism().map_or(1, usize::from);
    let (family, model) = (field("cpu family").unwrap_or("?"), field("model\t").unwrap_or("?"));
    format!("{}, family {family} model {model}, {count} threads", field("model name").unwrap_or("unknown processor"))
}

//! What measurements are asked for.

use std::error::Error;
use std::path::{Path, PathBuf};

/// Of a measurement; without a type, whether it succeeded.
pub type Result<T = ()> = std::result::Result<T, Box<dyn Error>>;

/// Where tables and curves go.
const OUT: &str = "docs/report";

/// What most measurements take.
#[derive(clap::Args, Clone, Debug)]
pub struct Common {
    /// Take seconds instead of minutes, with rough figures: to see that the report works.
    #[arg(long)]
    pub quick: bool,
    /// Directory of the tables and curves.
    #[arg(long, value_name = "DIR", default_value = OUT)]
    pub out: PathBuf,
}

/// What measurements take that only print.
#[derive(clap::Args, Clone, Copy, Debug)]
pub struct Quick {
    /// Take seconds instead of minutes, with rough figures: to see that the report works.
    #[arg(long)]
    pub quick: bool,
}

impl Common {
    /// The command line of a measurement with these options.
    pub fn command(&self, measurement: &str) -> String {
        let quick = if self.quick { " --quick" } else { "" };
        let out = if self.out == Path::new(OUT) { String::new() } else { format!(" --out {}", self.out.display()) };
        format!("cargo run --release -p report -- {measurement}{quick}{out}")
    }
}

//! One report: every measurement of speed against error in turn, then one HTML file of all pages.

use crate::options::{Common, Result};
use crate::{films, fronts, html, machine, not_modelled, quality, unseen};
use std::env;
use std::path::PathBuf;
use std::time::Instant;

/// What the report takes.
#[derive(clap::Args)]
pub struct Options {
    #[command(flatten)]
    pub common: Common,
    /// The HTML file [default: report.html in cargo's target directory].
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// What `versus.py speed` printed of other renderers.
    #[arg(long, value_name = "FILE", default_value = "docs/report/peers.txt")]
    pub peers: PathBuf,
    /// Measure nothing: bind the pages that are there.
    #[arg(long)]
    pub bind: bool,
}

/// Measures everything, and binds it.
pub fn run(options: &Options) -> Result {
    let Options { common, html: file, peers, bind } = options;
    let began = Instant::now();
    let done = |what: &str| eprintln!("{:6.1} s  {what}", began.elapsed().as_secs_f64());
    if !bind {
        quality::run(&quality::Options { common: common.clone(), threads: None, half: true, scenes: Vec::new() })?;
        done("knobs");
        fronts::run(&fronts::Options { common: common.clone(), peers: peers.clone() })?;
        done("fronts");
        unseen::run(&unseen::Options { common: common.clone(), date: None, scenes: Vec::new() })?;
        done("instants not tuned on");
        films::run(common)?;
        done("films");
        not_modelled::run(common)?;
        done("what is not modelled");
    }
    let target = PathBuf::from(env::var_os("CARGO_TARGET_DIR").unwrap_or("target".into()));
    let file = file.clone().unwrap_or_else(|| target.join("report.html"));
    let about = format!(
        "Bound on {} from the pages in <code>{}</code>, on {}; {}. Each page names the command that writes it and the \
         machine that it was measured on.",
        machine::date()?,
        common.out.display(),
        machine::machine(),
        machine::versions(),
    );
    html::bind(&common.out, &file, &about)?;
    println!("{}: {:.0} s", file.display(), began.elapsed().as_secs_f64());
    Ok(())
}

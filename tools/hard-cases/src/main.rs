//! The program; see the library.

use clap::{Parser, Subcommand};
use hard_cases::{CHAPTERS, Effort, page, walk};
use std::process::ExitCode;

/// Tries Paprsek's hard cases, writes docs/hard-cases.md, and fails where an error is beyond its target.
#[derive(Parser)]
struct Arguments {
    /// A twentieth of the inputs, and no page.
    #[arg(long)]
    quick: bool,
    /// Only the cases whose name contains this, and no page.
    #[arg(long, value_name = "TEXT")]
    only: Option<String>,
    #[command(subcommand)]
    walk: Option<Walk>,
}

#[derive(Subcommand)]
enum Walk {
    /// Renders random frames and fails where one is not finite, or takes 2.5 times the work of its neighbours.
    Walk(walk::Options),
}

fn main() -> ExitCode {
    let Arguments { quick, only, walk } = Arguments::parse();
    if let Some(Walk::Walk(options)) = walk {
        return verdict(walk::walk(&options));
    }
    let effort = if quick { Effort::QUICK } else { Effort::FULL };
    let mut holds = true;
    let mut chapters = Vec::new();
    for (name, cases) in CHAPTERS {
        let mut outcomes = Vec::new();
        for case in cases.iter().filter(|case| only.as_ref().is_none_or(|only| case.name.contains(only.as_str()))) {
            let outcome = case.run(&effort);
            println!("{}", outcome.line());
            holds &= outcome.holds();
            outcomes.push(outcome);
        }
        chapters.push((*name, outcomes));
    }
    if !quick && only.is_none() {
        let levels: Vec<_> = testkit::levels().into_iter().map(|level| level.0).collect();
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/hard-cases.md");
        if let Err(error) = std::fs::write(path, page(&chapters, &levels)) {
            eprintln!("docs/hard-cases.md: {error}");
            return ExitCode::FAILURE;
        }
    }
    verdict(holds)
}

fn verdict(holds: bool) -> ExitCode {
    if holds { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

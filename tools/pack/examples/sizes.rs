//! Where the bytes of an executable go, at the packer's own costs:
//! `cargo run --release -p pack --example sizes -- FILE [--self] [--functions N] [--within N] [--lines N]`.
//! The file must have symbols and lines: build with `-Cdebuginfo=1`, unstripped.

use std::io::Write;

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
    let costs = pack::packer::measure(&elf)?;
    let bits = |at: u64| Some(costs.bits(at));
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

//! What a feature costs at the margin: the packed intro with all, less the packed intro without it.
//!
//! The table by modules counts code where it stands. What leaving a feature out would save is another figure: what only
//! that feature calls goes too, and what it shares with others stays. So each is left out for once, by a `cfg` that the
//! sources ask for where the feature begins, and the rest is left to the compiler.

use crate::toolchain::Toolchain;
use crate::{build, packer};
use std::fs;
use std::path::Path;

/// Values of `cfg(without)`, which Cargo.toml lists too, and what each leaves out.
const FEATURES: &[(&str, &str)] = &[
    ("lumen", "part: glass and marble, the last light; the tracer with them"),
    ("day", "part: June and September by the lake"),
    ("clouds", "part: the flight; the cloud renderer with it"),
    ("snowfall", "part: the first snow"),
    ("torches", "part: fires in the ruin"),
    ("writing", "title and credits"),
    ("guard", "tracer: small things between corners are met"),
    ("snow-cover", "rasterizer: snow that settles"),
    ("cloud-shadows", "rasterizer: shadows of clouds"),
    ("stars", "sky: stars"),
    ("discs", "sky: discs of sun and moon, their glare"),
    ("crystals", "particles: flakes from close by are crystals"),
    ("fog", "particles: fog"),
    ("aeroplane", "the aeroplane"),
    ("capture", "films and stills by `--capture`"),
    ("stills", "stills by S"),
    ("governor", "smaller frames where the machine is slow"),
    ("fullscreen", "the whole screen"),
];

/// Builds and packs the intro of the workspace at `root` without each feature in turn; gives a table in Markdown, dearest
/// first. `unpacker` is [`crate::stub::unpacker`]'s. Fails where leaving something out changes nothing: then the sources no
/// longer ask for it.
pub fn table(root: &Path, toolchain: &Toolchain, unpacker: &[u8], target: &Path) -> Result<String, String> {
    let pack = |without| -> Result<packer::Packed, String> {
        let program = build::build(root, toolchain, target, without)?;
        let program = fs::read(&program).map_err(|error| format!("{}: {error}", program.display()))?;
        packer::pack(&program, unpacker)
    };
    let all = pack(None)?;
    let mut rows = Vec::new();
    for &(name, what) in FEATURES {
        let less = pack(Some(name))?;
        if less.bytes == all.bytes {
            return Err(format!("without {name} the program is the same"));
        }
        let bytes = all.trimmed as i64 - less.trimmed as i64;
        let packed = all.bytes.len() as i64 - less.bytes.len() as i64;
        eprintln!("{name}: {bytes} bytes, {packed} packed");
        rows.push((packed, bytes, name, what));
    }
    rows.sort_by_key(|row| -row.0);
    let mut table = String::from("| without | what that is | bytes | packed |\n|---|---|---:|---:|\n");
    for (packed, bytes, name, what) in rows {
        table += &format!("| {name} | {what} | {bytes} | {packed} |\n");
    }
    Ok(table)
}

//! `pack`: builds the intro for size, packs it into `target/intro/paprsek` and says where its bytes go.
//! `pack FILE -o OUT`: packs any executable.
//! `pack marginal`: what the packed intro would save without each of its dearer features.
//! `pack shuffle`: packs the intro of sources that are shuffled, too, and says how far apart the sizes are.

use pack::packer::{self, Packed};
use pack::table::{Profile, Row, View, markdown, rounded};
use pack::toolchain::Toolchain;
use pack::{build, elf, marginal, shuffle, stub};
use std::ffi::OsString;
use std::io::Write;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::{env, fs, io};

fn main() -> ExitCode {
    let arguments: Vec<_> = env::args_os().skip(1).collect();
    let said = match &arguments[..] {
        [] => Place::find().and_then(|place| intro(&place)),
        // Without one of its dearer features after another.
        [word] if word == "marginal" => {
            Place::find().and_then(|p| marginal::table(&p.root, &p.toolchain, &p.unpacker, &p.target.join("build")))
        }
        // From shuffled sources, too.
        [word] if word == "shuffle" => Place::find()
            .and_then(|p| shuffle::show(&p.root, &p.toolchain, &p.unpacker, &p.target.with_file_name("shuffle"))),
        [file, option, out] if option == "-o" => any(Path::new(file), Path::new(out)),
        _ => Err("usage: pack, pack FILE -o OUT, pack marginal, or pack shuffle".into()),
    };
    let printed =
        said.and_then(|said| io::stdout().write_all(said.as_bytes()).map_err(|error| format!("stdout: {error}")));
    match printed {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("pack: {why}");
            ExitCode::FAILURE
        }
    }
}

/// Builds and packs the intro; gives the table of its modules.
fn intro(place: &Place) -> Result<String, String> {
    let Place { root, target, toolchain, unpacker } = place;
    let program = read(&build::build(root, toolchain, &target.join("build"), None)?)?;
    let packed = packer::pack(&program, unpacker)?;
    write(&target.join("paprsek.elf"), &elf::trim(&program)?.bytes)?;
    write(&target.join("paprsek"), &packed.bytes)?;

    let costs = packer::measure(&program)?;
    let mut rows = Profile::read(&program)?.rows(View::Owner, &|address| Some(costs.bits(address)));
    let coded: f64 = rows.iter().map(|row| row.packed).sum();
    let rest = packed.bytes.len() as f64 - coded;
    rows.push(Row { name: "unpacker".into(), bytes: (packed.headers + packed.stub) as u64, packed: rest });
    let table = markdown(&rows);
    write(&target.join("size.md"), table.as_bytes())?;
    write(&target.join("size.toml"), modules(&rows).as_bytes())?;
    Ok(format!("{table}\n{}", sizes(&packed)))
}

/// What the intro is built from, where, and with what.
struct Place {
    /// The workspace.
    root: PathBuf,
    /// Where what is built goes.
    target: PathBuf,
    toolchain: Toolchain,
    unpacker: Vec<u8>,
}

impl Place {
    /// The workspace that this packer was built in, with the toolchain that there is.
    fn find() -> Result<Place, String> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let target =
            root.join(env::var_os("CARGO_TARGET_DIR").unwrap_or_else(|| OsString::from("target"))).join("intro");
        let toolchain = Toolchain::find()?;
        let unpacker = stub::unpacker(&toolchain, &target)?;
        Ok(Place { root, target, toolchain, unpacker })
    }
}

/// Packs any executable.
fn any(file: &Path, out: &Path) -> Result<String, String> {
    let program = read(file)?;
    let packed = packer::pack(&program, &stub::unpacker(&Toolchain::find()?, &env::temp_dir())?)?;
    write(out, &packed.bytes)?;
    Ok(sizes(&packed))
}

/// The rows in whole bytes, for a program to read.
fn modules(rows: &[Row]) -> String {
    let module =
        |Row { name, bytes, packed }| format!("[[module]]\nname = {name:?}\nbytes = {bytes}\npacked = {packed}\n");
    rounded(rows).into_iter().map(module).collect()
}

fn sizes(packed: &Packed) -> String {
    let Packed { bytes, trimmed, headers, stub, payload } = packed;
    let total = bytes.len();
    format!("program {trimmed}\nheaders {headers}\nunpacker {stub}\ncoded program {payload}\npacked {total}\n")
}

fn read(path: &Path) -> Result<Vec<u8>, String> {
    fs::read(path).map_err(|error| format!("{}: {error}", path.display()))
}

/// Writes an executable, whole or not at all.
fn write(path: &Path, bytes: &[u8]) -> Result<(), String> {
    let part: PathBuf = path.with_extension(format!("part-{}", std::process::id()));
    let written = fs::write(&part, bytes)
        .and_then(|()| fs::set_permissions(&part, fs::Permissions::from_mode(0o755)))
        .and_then(|()| fs::rename(&part, path));
    if written.is_err() {
        let _ = fs::remove_file(&part);
    }
    written.map_err(|error| format!("{}: {error}", path.display()))
}

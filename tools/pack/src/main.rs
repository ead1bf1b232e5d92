//! Packs an executable: `pack FILE -o OUT`.

use pack::{packer, stub};
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::{env, fs, process};

fn main() {
    if let Err(error) = run() {
        eprintln!("pack: {error}");
        process::exit(1);
    }
}

fn run() -> Result<(), String> {
    let arguments: Vec<_> = env::args().skip(1).collect();
    let [file, option, out] = &arguments[..] else { return Err("usage: pack FILE -o OUT".into()) };
    if option != "-o" {
        return Err(format!("unknown option {option}"));
    }
    let original = fs::read(file).map_err(|error| format!("{file}: {error}"))?;
    let work = env::temp_dir().join(format!("pack-{}", process::id()));
    fs::create_dir_all(&work).map_err(|error| format!("{}: {error}", work.display()))?;
    let stub = stub::build(Path::new("rustc"), Path::new(env!("CARGO_MANIFEST_DIR")), &work);
    // What is left there harms nobody.
    let _ = fs::remove_dir_all(&work);
    let packed = packer::pack(&original, &stub?)?;
    fs::write(out, &packed.bytes).map_err(|error| format!("{out}: {error}"))?;
    fs::set_permissions(out, fs::Permissions::from_mode(0o755)).map_err(|error| format!("{out}: {error}"))?;
    println!("original {:8}", original.len());
    println!("trimmed  {:8}", packed.trimmed);
    println!("headers  {:8}", packed.headers);
    println!("stub     {:8}", packed.stub);
    println!("payload  {:8}", packed.payload);
    println!("total    {:8}", packed.bytes.len());
    Ok(())
}

//! The standard library's sources without what the intro never uses: 3.6 kB packed; and without the bounds checks of
//! slices: 1.7 kB more.
//!
//! Links lead to the toolchain's own files but for those that are cut.
//!
//! SAFETY of the latter: an index out of bounds is undefined in the packed file, where it is a panic in every other build.
//! The sources are the same, and safe Rust. That none is out of bounds is what the other builds show: their tests, the
//! fuzzing of all that comes from outside (command line, X server, cookies, scripts), and each frame of the show, which the
//! packed file is held against. What the X server or a file says of lengths is no bound anywhere: answers are read into
//! buffers that have a place for whatever 16 bits can name (`window/protocol.rs`).
//!
//! SAFETY of what is cut from memory and threads: each comment there says what the intro never does, such as making a `Weak`,
//! or joining a thread. A type with an alignment above 64 would end the program (`size_of_one`).

mod cuts;

use cuts::CUTS;
use std::fs;
use std::io;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};

/// The sources in `original`, cut, below `copy`. An error where a text that is cut is not there, or more than once.
pub fn cut(original: &Path, copy: &Path) -> Result<(), String> {
    mirror(original, copy, Path::new("")).map_err(|error| format!("cannot make {}: {error}", copy.display()))
}

fn mirror(original: &Path, copy: &Path, place: &Path) -> io::Result<()> {
    unlink(&copy.join(place));
    fs::create_dir_all(copy.join(place))?;
    for entry in fs::read_dir(original.join(place))? {
        let place = place.join(entry?.file_name());
        let (from, to) = (original.join(&place), copy.join(&place));
        match CUTS.iter().find(|(path, _)| Path::new(path).starts_with(&place)) {
            Some((path, cuts)) if Path::new(path) == place => {
                let text = cuts.iter().try_fold(fs::read_to_string(&from)?, without)?;
                unlink(&to);
                // Written anew, a file that is the same would have cargo build all that needs it once more.
                if fs::read(&to).ok().as_deref() != Some(text.as_bytes()) {
                    fs::write(&to, text)?;
                }
            }
            Some(_) => mirror(original, copy, &place)?,
            None if fs::read_link(&to).is_ok_and(|there| there == from) => {}
            None => {
                // What an older packer has cut.
                let _ = fs::remove_file(&to).or_else(|_| fs::remove_dir_all(&to));
                symlink(&from, &to)?;
            }
        }
    }
    Ok(())
}

/// Removes what an older packer has linked: to write there would change the toolchain's own files.
fn unlink(path: &Path) {
    if path.is_symlink() {
        let _ = fs::remove_file(path);
    }
}

/// The text with a part replaced that is in it once.
fn without(text: String, (old, new): &(&str, &str)) -> io::Result<String> {
    match text.matches(old).count() {
        1 => Ok(text.replace(old, new)),
        count => Err(io::Error::other(format!("{count} times there instead of once: {old}"))),
    }
}

/// Where a toolchain at `sysroot` keeps them.
pub fn sources(sysroot: &Path) -> PathBuf {
    sysroot.join("lib/rustlib/src/rust/library")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_is_cut_where_it_is_there_once() {
        let cut = |text: &str| without(text.into(), &("hooks();\n", "")).ok();
        assert_eq!(cut("a();\nhooks();\nb();\n").as_deref(), Some("a();\nb();\n"));
        assert_eq!(cut("a();\n"), None);
        assert_eq!(cut("hooks();\nhooks();\n"), None);
    }

    #[test]
    fn a_copy_reads_as_the_original_but_for_what_is_cut() {
        let work = tempfile::tempdir().unwrap();
        let (original, copy) = (work.path().join("original"), work.path().join("copy"));
        let write = |path: &str, text: &str| {
            let path = original.join(path);
            fs::create_dir_all(path.parent().unwrap()).and_then(|()| fs::write(path, text)).unwrap();
        };
        let all = |cuts: &[(&str, &str)]| cuts.iter().map(|(old, _)| *old).collect::<String>();
        CUTS.iter().for_each(|(path, cuts)| write(path, &all(cuts)));
        write("core/src/lib.rs", "core");
        // As an older packer left it: links where there are cuts now, cuts where there are none any more.
        fs::create_dir_all(copy.join("core/src")).unwrap();
        symlink(original.join("std"), copy.join("std")).unwrap();
        for _ in 0..2 {
            cut(&original, &copy).unwrap();
        }
        let (path, cuts) = CUTS[0];
        let read = |path: PathBuf| fs::read_to_string(path).unwrap();
        assert_eq!(read(copy.join("core/src/lib.rs")), "core");
        assert_eq!(read(copy.join(path)), cuts.iter().map(|(_, new)| *new).collect::<String>());
        assert_eq!(read(original.join(path)), all(cuts));
        // Another library is told from the one that is cut.
        write(path, &all(cuts).replacen(cuts[1].0, "another's words\n", 1));
        let why = cut(&original, &copy).unwrap_err();
        assert!(why.contains("0 times there instead of once") && why.contains(cuts[1].0), "{why}");
    }
}

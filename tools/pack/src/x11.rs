//! x11-dl without the functions that minifb never names.
//!
//! x11-dl looks up all 767 functions of Xlib when a window opens, one after another in code: 66 kB of an executable.
//! minifb names 56 of them, and of Xcursor one of 59. Cargo's `paths` takes a copy of the crate with only those in
//! its lists, and leaves the lock file as it is. There a loop over a table of names looks them up.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

/// The files with lists that minifb opens. Other lists do not get into the executable.
const LISTS: [&str; 2] = ["xlib.rs", "xcursor.rs"];

/// The file with the code that looks functions up, and what becomes of its parts.
const CODE: &str = "link.rs";
const LOOP: [(&str, &str); 4] = [
    // All fields but the empty one are pointers, in the order of the names.
    ("    pub struct $struct_name {", "    #[repr(C)]\n    #[derive(Clone, Copy)]\n    pub struct $struct_name {"),
    (
        "            let funcs = $struct_name {
              _private: (),
              $($fn_name: ::std::mem::transmute(lib.symbol(stringify!($fn_name))?),)*
              $($vfn_name: ::std::mem::transmute(lib.symbol(stringify!($vfn_name))?),)*
              $($var_name: ::std::mem::transmute(lib.symbol(stringify!($var_name))?),)*
            };
",
        "            let names = concat!($(stringify!($fn_name), \" \",)* $(stringify!($vfn_name), \" \",)* \
         $(stringify!($var_name), \" \",)*);
            let mut funcs = ::std::mem::MaybeUninit::<$struct_name>::uninit();
            lib.symbols(names, funcs.as_mut_ptr().cast())?;
            let funcs = funcs.assume_init();
",
    ),
    (
        "        Ok($struct_name {
          _private: (),
          $($fn_name: funcs.$fn_name,)*
          $($vfn_name: funcs.$vfn_name,)*
          $($var_name: funcs.$var_name,)*
        })
",
        "        Ok(*funcs)
",
    ),
    (
        "    pub fn symbol(&self,",
        "    /// Looks up names that end in spaces; `to` has room for as many.
    pub unsafe fn symbols(&self, mut names: &str, mut to: *mut *mut c_void) -> Result<(), OpenError> {
        while let Some((name, rest)) = names.split_once(' ') {
            unsafe {
                *to = self.symbol(name)?;
                to = to.add(1);
            }
            names = rest;
        }
        Ok(())
    }

    pub fn symbol(&self,",
    ),
];

/// Copies x11-dl into `copy`, cut down to what minifb names; both are found in the output of `cargo metadata`.
pub fn cut(metadata: &str, copy: &Path) -> Result<(), String> {
    let words = words(&source(metadata, "minifb")?.join("src"))?;
    let from = source(metadata, "x11-dl")?;
    for name in LISTS.into_iter().chain([CODE]) {
        read(&from.join("src").join(name))?;
    }
    // What another version left there.
    for path in files(copy).unwrap_or_default() {
        if !path.strip_prefix(copy).is_ok_and(|place| from.join(place).exists()) {
            fs::remove_file(&path).map_err(|error| format!("cannot remove {}: {error}", path.display()))?;
        }
    }
    for path in files(&from)? {
        let place = path.strip_prefix(&from).unwrap_or(&path);
        let mut bytes = fs::read(&path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
        if LISTS.iter().any(|name| place == Path::new("src").join(name)) {
            bytes = cut_list(&read(&path)?, &words).map_err(|why| changed(&path, &why))?.into_bytes();
        }
        if place == Path::new("src").join(CODE) {
            bytes = with_loop(&read(&path)?).map_err(|why| changed(&path, &why))?.into_bytes();
        }
        let copy = copy.join(place);
        // Written anew, a file that is the same would have cargo build all that needs it once more.
        if fs::read(&copy).is_ok_and(|there| there == bytes) {
            continue;
        }
        let made = copy.parent().map_or(Ok(()), fs::create_dir_all).and_then(|()| fs::write(&copy, bytes));
        made.map_err(|error| format!("cannot write {}: {error}", copy.display()))?;
    }
    Ok(())
}

fn changed(path: &Path, why: &str) -> String {
    format!("{}: {why}; has x11-dl changed? tools/pack/src/x11.rs must follow", path.display())
}

/// The text with [`LOOP`] in it.
fn with_loop(text: &str) -> Result<String, String> {
    LOOP.iter().try_fold(text.to_owned(), |text, (old, new)| match text.matches(old).count() {
        1 => Ok(text.replace(old, new)),
        count => Err(format!("{count} times '{old}'")),
    })
}

/// The directory of a package of crates.io, by the paths of manifests in cargo's metadata.
fn source(metadata: &str, name: &str) -> Result<PathBuf, String> {
    let is_version = |rest: &str| rest.starts_with(|c: char| c.is_ascii_digit());
    let mut found = metadata.split("\"manifest_path\":\"").skip(1).filter_map(|rest| {
        let directory = Path::new(rest.split('"').next()?).parent()?;
        let package = directory.file_name()?.to_str()?;
        package.strip_prefix(name)?.strip_prefix('-').filter(|rest| is_version(rest))?;
        Some(directory.to_owned())
    });
    match (found.next(), found.next()) {
        (Some(directory), None) => Ok(directory),
        (None, _) => Err(format!("cargo metadata names no source of {name}")),
        (Some(_), Some(_)) => Err(format!("cargo metadata names two versions of {name}")),
    }
}

/// Every word of the Rust files below a directory.
fn words(directory: &Path) -> Result<HashSet<String>, String> {
    let mut words = HashSet::new();
    for path in files(directory)? {
        if path.extension().is_some_and(|extension| extension == "rs") {
            let text = read(&path)?;
            words.extend(text.split(|c: char| c != '_' && !c.is_ascii_alphanumeric()).map(str::to_owned));
        }
    }
    Ok(words)
}

/// The text with only those functions and variables in its `x11_link!` list that are among `words`.
fn cut_list(text: &str, words: &HashSet<String>) -> Result<String, String> {
    let mut lines = text.lines();
    let mut cut = String::new();
    let mut keep = |line: &str| cut.extend([line, "\n"]);
    for line in lines.by_ref() {
        keep(line);
        if line.starts_with("x11_link! {") {
            break;
        }
    }
    let mut kept = 0;
    for line in lines.by_ref() {
        let entry = line.trim_start();
        let rest = entry.strip_prefix("pub fn ").or(entry.strip_prefix("pub static "));
        match rest.and_then(|rest| rest.split([' ', '(', ':']).next()) {
            Some(name) if !line.ends_with(',') => return Err(format!("{name} has a line that does not end its entry")),
            Some(name) if !words.contains(name) => continue,
            Some(_) => kept += 1,
            None if ["", "variadic:", "globals:", "}"].contains(&entry) => {}
            None => return Err(format!("'{entry}' in the list of functions")),
        }
        keep(line);
        if entry == "}" {
            break;
        }
    }
    lines.for_each(keep);
    if kept == 0 { Err("no list with a function that minifb names".into()) } else { Ok(cut) }
}

/// All files below a directory.
fn files(directory: &Path) -> Result<Vec<PathBuf>, String> {
    let failed = |error| format!("cannot read {}: {error}", directory.display());
    let mut found = Vec::new();
    for entry in fs::read_dir(directory).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        if path.is_dir() {
            found.extend(files(&path)?);
        } else {
            found.push(path);
        }
    }
    Ok(found)
}

fn read(path: &Path) -> Result<String, String> {
    fs::read_to_string(path).map_err(|error| format!("cannot read {}: {error}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIST: &str = "use x;\n\nx11_link! { Xlib, x11, [\"libX11.so.6\"], 4,\n  pub fn XOne (_1: c_int) -> (),\n  \
                        pub fn XTwo () -> c_int,\nvariadic:\n  pub fn XMany (_1: XIM) -> XIC,\nglobals:\n  \
                        pub static XValue: c_int,\n}\n\npub fn XTwo() {}\n";

    fn words(words: &[&str]) -> HashSet<String> {
        words.iter().map(|word| (*word).to_owned()).collect()
    }

    #[test]
    fn only_what_is_named_stays_in_the_list() {
        let cut = cut_list(LIST, &words(&["XOne", "XMany"])).unwrap();
        assert!(cut.contains("fn XOne") && cut.contains("fn XMany"), "{cut}");
        assert!(!cut.contains("fn XTwo ()") && !cut.contains("XValue"), "{cut}");
        assert!(
            cut.ends_with("variadic:\n  pub fn XMany (_1: XIM) -> XIC,\nglobals:\n}\n\npub fn XTwo() {}\n"),
            "{cut}"
        );
        assert_eq!(cut_list(LIST, &words(&["XOne", "XTwo", "XMany", "XValue"])).unwrap(), LIST);
    }

    #[test]
    fn a_source_that_looks_otherwise_is_refused() {
        assert!(cut_list("pub mod xlib;\n", &words(&["XOne"])).is_err());
        assert!(cut_list(LIST, &words(&["XThree"])).is_err());
        assert!(cut_list(&LIST.replace(") -> c_int,", ")\n    -> c_int,"), &words(&["XOne"])).is_err());
        assert!(cut_list(&LIST.replace("variadic:", "#[cfg(x)]"), &words(&["XOne"])).is_err());
    }

    #[test]
    fn names_are_looked_up_in_a_loop() {
        let text = LOOP.map(|(old, _)| old).concat();
        let looped = with_loop(&text).unwrap();
        assert!(looped.contains("lib.symbols(names,") && !looped.contains("transmute"), "{looped}");
        assert!(with_loop(&looped).is_err());
        assert!(with_loop(&text.repeat(2)).is_err());
    }

    #[test]
    fn a_package_is_found_by_its_directory() {
        let metadata =
            r#"{"manifest_path":"/r/minifb-0.29.0/Cargo.toml"},{"manifest_path":"/r/minifb-gl-1/Cargo.toml"}"#;
        assert_eq!(source(metadata, "minifb"), Ok("/r/minifb-0.29.0".into()));
        assert!(source(metadata, "x11-dl").is_err());
        assert!(source(&metadata.repeat(2), "minifb").is_err());
    }
}

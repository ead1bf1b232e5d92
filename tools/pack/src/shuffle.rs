//! Shows that the packed size stands still: the sources are copied to another directory, and there a module gets another
//! name, a function moves to another file, functions of a file are sorted; each time the intro is built and packed.

use crate::toolchain::Toolchain;
use crate::{build, packer};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

/// What the packed size may move by, in bytes.
const LIMIT: usize = 60;

/// Texts by path, from the root.
type Sources = BTreeMap<String, String>;

/// What becomes of the sources.
type Shuffle = (&'static str, fn(&mut Sources) -> Result<(), String>);

const SHUFFLES: [Shuffle; 5] = [
    ("in another directory", |_| Ok(())),
    ("module `raster` is `polygons`", |sources| rename(sources, "raster", "polygons")),
    ("`refracted` is in sky/sun.rs", |sources| relocate(sources, "refracted", "src/sky/place.rs", "src/sky/sun.rs")),
    ("functions of show/day.rs by name", |sources| sort(sources, "src/scenes/show/day.rs")),
    ("all three, functions of every file by name", |sources| {
        let mut paths: Vec<String> = sources.keys().cloned().collect();
        paths.retain(|path| functions(&sources[path]).len() > 1);
        paths.iter().try_for_each(|path| sort(sources, path))?;
        relocate(sources, "refracted", "src/sky/place.rs", "src/sky/sun.rs")?;
        rename(sources, "raster", "polygons")
    }),
];

/// Builds and packs the workspace at `root`, and each shuffle of it in a copy at `place`; gives a table of their sizes, or
/// says that they are too far apart. `unpacker` is [`crate::stub::unpacker`]'s.
pub fn show(root: &Path, toolchain: &Toolchain, unpacker: &[u8], place: &Path) -> Result<String, String> {
    let sources = copy(root, place)?;
    let mut table = String::from("| sources | packed |\n|---|---:|\n");
    let mut sizes = Vec::new();
    let mut pack = |what: &str, root: &Path| {
        let program = build::build(root, toolchain, &root.join("target/intro/build"), None)?;
        let program = fs::read(&program).map_err(|error| format!("{}: {error}", program.display()))?;
        let size = packer::pack(&program, unpacker)?.bytes.len();
        eprintln!("{what}: {size} bytes");
        table += &format!("| {what} | {size} |\n");
        sizes.push(size);
        Ok::<_, String>(())
    };
    pack("in their own directory", root)?;
    for (what, shuffle) in SHUFFLES {
        let mut shuffled = sources.clone();
        shuffle(&mut shuffled).map_err(|why| format!("{what}: {why}"))?;
        write(place, &shuffled)?;
        pack(what, place)?;
    }
    let most = sizes.iter().max().zip(sizes.iter().min()).map_or(0, |(most, least)| most - least);
    if most > LIMIT {
        return Err(format!("{table}\nthe largest difference is {most} bytes, more than {LIMIT}"));
    }
    Ok(format!("{table}\nlargest difference {most}\n"))
}

/// Copies what git has of `root`; gives what can be shuffled.
fn copy(root: &Path, place: &Path) -> Result<Sources, String> {
    let list = Command::new("git").current_dir(root).args(["ls-files", "-z"]).output();
    let list = list.map_err(|error| format!("git: {error}"))?;
    let list = String::from_utf8(list.stdout).map_err(|_| "git lists a name that is no text")?;
    let mut sources = Sources::new();
    for path in list.split('\0').filter(|path| !path.is_empty()) {
        let failed = |error| format!("{path}: {error}");
        if path.starts_with("src/") && path.ends_with(".rs") {
            sources.insert(path.into(), fs::read_to_string(root.join(path)).map_err(failed)?);
            continue;
        }
        let to = place.join(path);
        // What is written anew is compiled anew.
        let bytes = fs::read(root.join(path)).map_err(failed)?;
        if fs::read(&to).is_ok_and(|there| there == bytes) {
            continue;
        }
        fs::create_dir_all(to.parent().expect("it is in `place`")).map_err(failed)?;
        // With permissions: the linker is a script.
        fs::copy(root.join(path), &to).map_err(failed)?;
    }
    if sources.is_empty() { Err(format!("git has no sources in {}", root.display())) } else { Ok(sources) }
}

/// Writes the sources, with no other ones beside them.
fn write(place: &Path, sources: &Sources) -> Result<(), String> {
    let src = place.join("src");
    if src.exists() {
        fs::remove_dir_all(&src).map_err(|error| format!("{}: {error}", src.display()))?;
    }
    for (path, text) in sources {
        let to = place.join(path);
        let written = fs::create_dir_all(to.parent().expect("it is in `src`")).and_then(|()| fs::write(&to, text));
        written.map_err(|error| format!("{}: {error}", to.display()))?;
    }
    Ok(())
}

/// Gives a module of the library another name, with its files and wherever it is named.
fn rename(sources: &mut Sources, old: &str, new: &str) -> Result<(), String> {
    let (file, folder) = (format!("src/{old}.rs"), format!("src/{old}/"));
    let there = |name: &str| {
        let (file, folder) = (format!("src/{name}.rs"), format!("src/{name}/"));
        sources.keys().any(|path| *path == file || path.starts_with(&folder))
    };
    if !there(old) || there(new) {
        return Err(format!("there must be a module {old}, and none {new}"));
    }
    *sources = std::mem::take(sources)
        .into_iter()
        .map(|(path, text)| {
            let moved = match path.strip_prefix(&folder) {
                Some(rest) => format!("src/{new}/{rest}"),
                None if path == file => format!("src/{new}.rs"),
                None => path,
            };
            (moved, renamed(&text, old, new))
        })
        .collect();
    Ok(())
}

/// The text with the module's new name where the old one stands in a path, or is declared or imported.
fn renamed(text: &str, old: &str, new: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    while let Some(at) = rest.find(old) {
        let (before, after) = (&rest[..at], &rest[at + old.len()..]);
        let line = before.rsplit('\n').next().unwrap_or(before);
        let whole = !before.ends_with(is_word) && !after.starts_with(is_word);
        let declared = line.ends_with("mod ") && after.starts_with(';');
        let imported = line.starts_with("use ") || line.starts_with("pub use ");
        out += before;
        out += if whole && (after.starts_with("::") || declared || imported) { new } else { old };
        rest = after;
    }
    out + rest
}

/// Moves a function from one file to another beside it; the old one imports it.
fn relocate(sources: &mut Sources, name: &str, from: &str, to: &str) -> Result<(), String> {
    let text = sources.get(from).ok_or_else(|| format!("there is no {from}"))?;
    let mut lines: Vec<&str> = text.lines().collect();
    let found = functions(text).into_iter().find(|function| function.name == name);
    let function = found.ok_or_else(|| format!("{from} has no function {name}"))?;
    let moved: Vec<&str> = lines.drain(function.lines.clone()).collect();
    let moved = format!("\n{}\n", moved.join("\n"));
    let module = Path::new(to).file_stem().and_then(|stem| stem.to_str()).ok_or("a file without a name")?;
    let text = format!("{}\npub use super::{module}::{name};\n", lines.join("\n"));
    *sources.get_mut(to).ok_or_else(|| format!("there is no {to}"))? += &moved;
    sources.insert(from.into(), text);
    Ok(())
}

/// Sorts the functions of a file by their names.
fn sort(sources: &mut Sources, path: &str) -> Result<(), String> {
    let text = sources.get(path).ok_or_else(|| format!("there is no {path}"))?;
    let lines: Vec<&str> = text.lines().collect();
    let functions = functions(text);
    let mut sorted = functions.clone();
    sorted.sort_by(|a, b| a.name.cmp(&b.name));
    if sorted.len() < 2 {
        return Err(format!("{path} has no functions to sort"));
    }
    let mut out: Vec<&str> = Vec::new();
    let mut at = 0;
    for (here, instead) in functions.iter().zip(&sorted) {
        out.extend(&lines[at..here.lines.start]);
        out.extend(&lines[instead.lines.clone()]);
        at = here.lines.end;
    }
    out.extend(&lines[at..]);
    let text = out.join("\n") + "\n";
    sources.insert(path.into(), text);
    Ok(())
}

/// A function that is in nothing else.
#[derive(Clone, Debug, PartialEq)]
struct Function {
    name: String,
    /// Its lines, with its attributes and what documents it.
    lines: std::ops::Range<usize>,
}

/// The functions of a text that rustfmt has formatted.
fn functions(text: &str) -> Vec<Function> {
    let lines: Vec<&str> = text.lines().collect();
    let mut found = Vec::new();
    for (at, line) in lines.iter().enumerate() {
        let head = line.find("fn ").filter(|&head| {
            ["", "pub ", "pub(super) ", "pub(crate) ", "const ", "pub const "].contains(&&line[..head])
        });
        let Some(head) = head else { continue };
        let name = line[head + 3..].split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or("");
        let above = lines[..at].iter().rev().take_while(|line| line.starts_with("///") || line.starts_with("#["));
        let body = if line.ends_with('}') { Some(0) } else { lines[at..].iter().position(|line| *line == "}") };
        if let Some(body) = body {
            found.push(Function { name: name.into(), lines: at - above.count()..at + body + 1 });
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sources(texts: &[(&str, &str)]) -> Sources {
        texts.iter().map(|(path, text)| ((*path).into(), (*text).into())).collect()
    }

    #[test]
    fn a_module_is_renamed_where_it_is_a_module() {
        let mut all = sources(&[
            ("src/lib.rs", "pub mod sky;\nuse crate::{sky, sea};\n"),
            ("src/sky/mod.rs", "pub fn sky(sky: u8) {}\n"),
            ("src/sea.rs", "fn f() {\n    crate::sky::sky(skyline::sky);\n}\n"),
        ]);
        rename(&mut all, "sky", "heaven").unwrap();
        let right = sources(&[
            ("src/lib.rs", "pub mod heaven;\nuse crate::{heaven, sea};\n"),
            ("src/heaven/mod.rs", "pub fn sky(sky: u8) {}\n"),
            ("src/sea.rs", "fn f() {\n    crate::heaven::sky(skyline::sky);\n}\n"),
        ]);
        assert_eq!(all, right);
        assert!(rename(&mut all, "sky", "heaven").is_err());
        assert!(rename(&mut all, "heaven", "sea").is_err());
    }

    #[test]
    fn a_function_moves_with_what_documents_it() {
        let mut all =
            sources(&[("src/a/x.rs", "use b;\n\n/// One.\n#[inline]\nfn one() {\n}\n"), ("src/a/y.rs", "//! Y.\n")]);
        relocate(&mut all, "one", "src/a/x.rs", "src/a/y.rs").unwrap();
        assert_eq!(all["src/a/y.rs"], "//! Y.\n\n/// One.\n#[inline]\nfn one() {\n}\n");
        assert_eq!(all["src/a/x.rs"], "use b;\n\npub use super::y::one;\n");
        assert!(relocate(&mut all, "one", "src/a/x.rs", "src/a/y.rs").is_err());
    }

    #[test]
    fn functions_are_sorted_and_all_else_stays() {
        let text = "const N: u8 = 1;\n\n/// B.\nfn b(\n) {\n    {\n    }\n}\n\nstruct S;\n\npub fn a() {}\n";
        let mut all = sources(&[("src/x.rs", text)]);
        sort(&mut all, "src/x.rs").unwrap();
        let right = "const N: u8 = 1;\n\npub fn a() {}\n\nstruct S;\n\n/// B.\nfn b(\n) {\n    {\n    }\n}\n";
        assert_eq!(all["src/x.rs"], right);
        assert!(sort(&mut sources(&[("src/x.rs", "fn a() {}\n")]), "src/x.rs").is_err());
    }
}

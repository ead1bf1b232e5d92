//! The floors of `ARCHITECTURE.md`: imports run down, no renderer names another, and no file needs itself by way of others.
//!
//! Arrows are what `use` lines and paths in code name, each followed through re-exports to the file that defines it. What a `mod.rs`
//! re-exports is no arrow of its own. Modules named `tests` are not looked at: a test may compare what it likes.

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::fs;
use std::path::Path;

/// Floors from below, each with its rooms: folders of `src/`, or single files there. Arrows run from a floor to those below it and
/// within a room; between the rooms of a floor as [`SEPARATE`] says.
const FLOORS: [&[&str]; 6] = [
    &["simd", "angle", "vector", "timeline", "settings", "cuts"],
    &["view", "noise", "texture"],
    &["frame"],
    &["trace", "raster", "cloud", "particles", "sky", "effects", "sound"],
    &["scenes"],
    &["bin"],
];

/// The floor whose rooms do not know each other: renderers.
const SEPARATE: usize = 3;

/// Arrows that close a circle and may: from, to, and why.
const ALLOWED: &[(&str, &str, &str)] = &[];

/// The module path of a file or of a module within it: `lib` or `bin` first.
type Module = Vec<String>;

/// What a `use` line brings: where from, and under which name; without one, everything.
#[derive(Debug)]
struct Import {
    path: Vec<String>,
    name: Option<String>,
    /// In which module the line stands.
    within: Module,
    is_public: bool,
}

/// A source file.
#[derive(Default)]
struct Source {
    path: String,
    module: Module,
    imports: Vec<Import>,
    /// Paths in code, and the modules that they stand in.
    paths: Vec<(Vec<String>, Module)>,
    /// Modules within the file.
    inner: Vec<Module>,
    /// Items by module and name.
    items: BTreeSet<(Module, String)>,
}

impl Source {
    /// `path` begins with `src/`.
    fn read(path: &str, text: &str) -> Source {
        let mut source = Source { path: path.to_owned(), module: module_of(path), ..Source::default() };
        let tokens: TokenStream = text.parse().unwrap_or_else(|e| panic!("{path}: {e}"));
        let module = source.module.clone();
        source.walk(tokens, &module);
        source
    }

    fn walk(&mut self, tokens: TokenStream, module: &Module) {
        let tokens: Vec<_> = tokens.into_iter().collect();
        let mut at = 0;
        while at < tokens.len() {
            let word = ident(&tokens, at);
            let is_use = word.as_deref() == Some("use") && !is_punct(&tokens, at + 1, '<');
            let is_module = word.as_deref() == Some("mod") && brace(&tokens, at + 2).is_some();
            if is_use {
                let end = (at..tokens.len()).find(|i| is_punct(&tokens, *i, ';')).unwrap_or(tokens.len());
                let mut found = Vec::new();
                tree(&tokens[at + 1..end], &[], &mut found);
                let is_public = is_public(&tokens[..at]);
                let import = |(path, name)| Import { path, name, within: module.clone(), is_public };
                self.imports.extend(found.into_iter().map(import));
                at = end;
            } else if is_module && let (Some(name), Some(inside)) = (ident(&tokens, at + 1), brace(&tokens, at + 2)) {
                if name != "tests" {
                    let inner = [&module[..], &[name]].concat();
                    self.walk(inside, &inner);
                    self.inner.push(inner);
                }
                at += 2;
            } else if let TokenTree::Group(group) = &tokens[at] {
                self.walk(group.stream(), module);
            } else if let Some(word) = word {
                if ["struct", "enum", "union", "fn", "const", "static", "trait", "type"].contains(&&*word)
                    && let Some(name) = ident(&tokens, at + 1)
                {
                    self.items.insert((module.clone(), name));
                }
                let mut path = vec![word];
                while is_double_colon(&tokens, at + 1)
                    && let Some(next) = ident(&tokens, at + 3)
                {
                    path.push(next);
                    at += 3;
                }
                if path.len() > 1 {
                    self.paths.push((path, module.clone()));
                }
            }
            at += 1;
        }
    }

    /// Whether it holds a folder's modules together, and so may re-export them.
    fn is_a_tour(&self) -> bool {
        self.path.ends_with("/mod.rs") || self.path == "src/lib.rs"
    }
}

fn ident(tokens: &[TokenTree], at: usize) -> Option<String> {
    match tokens.get(at)? {
        TokenTree::Ident(ident) => Some(ident.to_string()),
        _ => None,
    }
}

fn brace(tokens: &[TokenTree], at: usize) -> Option<TokenStream> {
    match tokens.get(at)? {
        TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => Some(group.stream()),
        _ => None,
    }
}

fn is_punct(tokens: &[TokenTree], at: usize, sign: char) -> bool {
    matches!(tokens.get(at), Some(TokenTree::Punct(punct)) if punct.as_char() == sign)
}

fn is_double_colon(tokens: &[TokenTree], at: usize) -> bool {
    is_punct(tokens, at, ':') && is_punct(tokens, at + 1, ':')
}

/// Whether the tokens before an item end in `pub` or `pub(...)`.
fn is_public(before: &[TokenTree]) -> bool {
    let last = before.len().wrapping_sub(1);
    let is_restricted = matches!(before.last(), Some(TokenTree::Group(g)) if g.delimiter() == Delimiter::Parenthesis);
    ident(before, if is_restricted { last.wrapping_sub(1) } else { last }).as_deref() == Some("pub")
}

/// Flattens a tree of a `use` line.
fn tree(tokens: &[TokenTree], prefix: &[String], found: &mut Vec<(Vec<String>, Option<String>)>) {
    let mut path = prefix.to_vec();
    let mut at = 0;
    while let Some(token) = tokens.get(at) {
        match token {
            TokenTree::Ident(word) if *word == "as" => {
                return found.push((path, ident(tokens, at + 1)));
            }
            // In a list, the module itself.
            TokenTree::Ident(word) if *word == "self" && !path.is_empty() => {}
            TokenTree::Ident(word) => path.push(word.to_string()),
            TokenTree::Punct(punct) if punct.as_char() == '*' => return found.push((path, None)),
            TokenTree::Group(group) => {
                let inside: Vec<_> = group.stream().into_iter().collect();
                for part in inside.split(|token| matches!(token, TokenTree::Punct(p) if p.as_char() == ',')) {
                    if !part.is_empty() {
                        tree(part, &path, found);
                    }
                }
                return;
            }
            _ => {}
        }
        at += 1;
    }
    let name = path.last().cloned();
    found.push((path, name));
}

/// The module of a file.
fn module_of(path: &str) -> Module {
    let inside = path.strip_prefix("src/").and_then(|path| path.strip_suffix(".rs")).expect("a source file");
    let (root, inside) = match inside.strip_prefix("bin/") {
        // The executable's name is no module.
        Some(inside) => ("bin", inside.split_once('/').map_or("", |(_, inside)| inside)),
        None => ("lib", inside),
    };
    let names = inside.split('/').filter(|name| !["mod", "lib", "main", ""].contains(name));
    [root].into_iter().chain(names).map(str::to_owned).collect()
}

/// The room of a file and its floor; none for `lib.rs`, which is the house's roof.
fn room(path: &str) -> Option<(&str, usize)> {
    let inside = path.strip_prefix("src/")?;
    let room = inside.split('/').next()?.trim_end_matches(".rs");
    let floor = FLOORS.iter().position(|rooms| rooms.contains(&room))?;
    Some((room, floor))
}

/// All files, and who is where.
struct House {
    sources: Vec<Source>,
    modules: BTreeMap<Module, usize>,
}

impl House {
    fn new(files: &[(&str, &str)]) -> House {
        let sources: Vec<_> = files.iter().map(|(path, text)| Source::read(path, text)).collect();
        let mut modules = BTreeMap::new();
        for (i, source) in sources.iter().enumerate() {
            modules.extend(source.inner.iter().cloned().chain([source.module.clone()]).map(|module| (module, i)));
        }
        House { sources, modules }
    }

    /// The module that defines what a path names; none for another crate's.
    fn resolve(&self, path: &[String], within: &Module, depth: u32) -> Option<Module> {
        // A circle of re-exports.
        if depth == 0 {
            return None;
        }
        let mut module = within.clone();
        let mut rest = path;
        let first = path.first()?.as_str();
        match first {
            "crate" => module.truncate(1),
            "self" => {}
            "super" => {
                module.pop();
            }
            "paprsek" if within[0] == "bin" => module = vec!["lib".to_owned()],
            _ if self.modules.contains_key(&[&module[..], &path[..1]].concat()) => rest = path,
            _ => return None,
        }
        if ["crate", "self", "super", "paprsek"].contains(&first) {
            rest = &path[1..];
        }
        while let Some((next, after)) = rest.split_first() {
            let child = [&module[..], &rest[..1]].concat();
            if next == "super" {
                module.pop();
            } else if self.modules.contains_key(&child) {
                module = child;
            } else {
                return Some(self.item(next, after, &module, depth).unwrap_or(module));
            }
            rest = after;
        }
        Some(module)
    }

    /// The module that defines what is known as `name` in a module, if that is not this one.
    fn item(&self, name: &str, after: &[String], module: &Module, depth: u32) -> Option<Module> {
        let source = &self.sources[*self.modules.get(module)?];
        let here = || source.imports.iter().filter(|import| import.within == *module);
        if let Some(import) = here().find(|import| import.name.as_deref() == Some(name)) {
            return self.resolve(&[&import.path, after].concat(), module, depth - 1);
        }
        if source.items.contains(&(module.clone(), name.to_owned())) {
            return None;
        }
        here().filter(|import| import.name.is_none()).find_map(|import| {
            let origin = self.resolve(&import.path, module, depth - 1)?;
            let source = &self.sources[*self.modules.get(&origin)?];
            source.items.contains(&(origin.clone(), name.to_owned())).then_some(origin)
        })
    }

    /// The file of that module: of the nearest that is one.
    fn file(&self, module: &Module) -> Option<usize> {
        (1..=module.len()).rev().find_map(|length| self.modules.get(&module[..length])).copied()
    }

    /// Which file needs which others.
    fn arrows(&self) -> BTreeSet<(usize, usize)> {
        const DEPTH: u32 = 16;
        let mut arrows = BTreeSet::new();
        for (from, source) in self.sources.iter().enumerate() {
            let imports = source.imports.iter().filter(|import| !(source.is_a_tour() && import.is_public));
            let imports = imports.map(|import| (&import.path, &import.within));
            let paths = source.paths.iter().map(|(path, within)| (path, within));
            let targets = imports.chain(paths).filter_map(|(path, within)| self.resolve(path, within, DEPTH));
            arrows.extend(targets.filter_map(|module| self.file(&module)).map(|to| (from, to)));
        }
        arrows.retain(|(from, to)| from != to);
        arrows
    }

    fn path(&self, file: usize) -> &str {
        &self.sources[file].path
    }

    /// What is wrong, a line each.
    fn complaints(&self, allowed: &[(&str, &str, &str)]) -> Vec<String> {
        let mut complaints = Vec::new();
        let mut arrows = self.arrows();
        for (from, to) in &arrows {
            let (from, to) = (self.path(*from), self.path(*to));
            let Some((room_from, floor_from)) = room(from) else { continue };
            match room(to) {
                None => complaints.push(format!("up: {from} -> {to}")),
                Some((_, floor_to)) if floor_to > floor_from => complaints.push(format!("up: {from} -> {to}")),
                Some((room_to, SEPARATE)) if floor_from == SEPARATE && room_to != room_from => {
                    complaints.push(format!("sideways: {from} -> {to}"));
                }
                _ => {}
            }
        }
        for (from, to, _) in allowed {
            let arrow = arrows.iter().find(|arrow| (self.path(arrow.0), self.path(arrow.1)) == (*from, *to)).copied();
            if !arrow.is_some_and(|arrow| way(&arrows, arrow.1, arrow.0).is_some() && arrows.remove(&arrow)) {
                complaints.push(format!("allowed, but closes no circle: {from} -> {to}"));
            }
        }
        // One circle after another, until the rest is a tree of arrows.
        while let Some(circle) = circle(&arrows) {
            let names: Vec<_> = circle.iter().chain(&circle[..1]).map(|file| self.path(*file)).collect();
            complaints.push(format!("circle: {}", names.join(" -> ")));
            arrows.remove(&(circle[circle.len() - 1], circle[0]));
        }
        complaints
    }
}

/// The shortest circle of arrows.
fn circle(arrows: &BTreeSet<(usize, usize)>) -> Option<Vec<usize>> {
    arrows.iter().filter_map(|(from, to)| way(arrows, *to, *from)).min_by_key(Vec::len)
}

/// The shortest way between two files, both among it.
fn way(arrows: &BTreeSet<(usize, usize)>, from: usize, to: usize) -> Option<Vec<usize>> {
    let mut before = BTreeMap::from([(from, from)]);
    let mut queue = VecDeque::from([from]);
    while let Some(at) = queue.pop_front() {
        if at == to {
            let mut way = vec![to];
            while way[way.len() - 1] != from {
                way.push(before[&way[way.len() - 1]]);
            }
            way.reverse();
            return Some(way);
        }
        for (_, next) in arrows.range((at, 0)..=(at, usize::MAX)) {
            if !before.contains_key(next) {
                before.insert(*next, at);
                queue.push_back(*next);
            }
        }
    }
    None
}

/// Every Rust file below a directory, named from the package's root on.
fn files(directory: &Path, found: &mut Vec<(String, String)>) {
    for entry in fs::read_dir(directory).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let name = path.strip_prefix(crate::root()).unwrap().to_str().unwrap().to_owned();
            found.push((name, fs::read_to_string(&path).unwrap()));
        }
    }
}

#[test]
fn imports_run_down_and_in_no_circles() {
    let mut found = Vec::new();
    files(&crate::root().join("src"), &mut found);
    found.sort();
    assert!(found.iter().any(|(path, _)| path == "src/lib.rs"));
    for (path, _) in &found {
        assert!(path == "src/lib.rs" || room(path).is_some(), "{path} has no floor");
    }
    let files: Vec<_> = found.iter().map(|(path, text)| (&**path, &**text)).collect();
    let house = House::new(&files);
    assert!(house.arrows().len() > files.len(), "arrows are not seen");
    let complaints = house.complaints(ALLOWED);
    assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
}

/// Where the lint may be off: `ARCHITECTURE.md` names these.
const UNSAFE: [&str; 7] = [
    "src/bin/paprsek/raw.rs",
    "tools/pack/model/src/mix.rs",
    "tools/pack/model/src/model.rs",
    "tools/pack/model/src/slot.rs",
    "tools/pack/model/src/vector.rs",
    "tools/pack/src/compress.rs",
    "tools/pack/stub/src/sys.rs",
];

#[test]
fn unsafe_code_has_its_addresses() {
    let mut found = Vec::new();
    for directory in ["src", "tools", "examples", "benches"] {
        files(&crate::root().join(directory), &mut found);
    }
    found.retain(|(_, text)| text.contains("allow(unsafe_code)"));
    found.sort();
    assert_eq!(found.iter().map(|(path, _)| &**path).collect::<Vec<_>>(), UNSAFE);
    let manifest = fs::read_to_string(crate::root().join("Cargo.toml")).unwrap();
    assert!(manifest.contains("unsafe_code = \"deny\""));
}

/// The complaints about made-up files.
fn complaints(files: &[(&str, &str)], allowed: &[(&str, &str, &str)]) -> Vec<String> {
    House::new(files).complaints(allowed)
}

const LIB: (&str, &str) = ("src/lib.rs", "pub mod frame; pub mod trace; pub mod sky; pub use frame::Tile;");
const FRAME: (&str, &str) = ("src/frame/mod.rs", "mod tile; pub use tile::Tile;");
const TILE: (&str, &str) = ("src/frame/tile.rs", "pub struct Tile;");

#[test]
fn an_arrow_up_or_sideways_is_found_however_it_is_written() {
    for (path, text, complaint) in [
        ("src/trace/mod.rs", "use crate::frame::Tile;", ""),
        ("src/trace/mod.rs", "use crate::Tile;", ""),
        ("src/trace/mod.rs", "use std::sky; fn f() { g::sky() }", ""),
        ("src/trace/mod.rs", "// use crate::sky;\nconst TEXT: &str = \"crate::sky::Sky\";", ""),
        ("src/trace/mod.rs", "mod tests { use crate::sky::Sky; }", ""),
        ("src/trace/mod.rs", "use crate::sky::Sky;", "sideways: src/trace/mod.rs -> src/sky.rs"),
        (
            "src/trace/mod.rs",
            "use crate::{frame::Tile, sky::{self, Sky as S}};",
            "sideways: src/trace/mod.rs -> src/sky.rs",
        ),
        ("src/trace/mod.rs", "use super::sky::*;", "sideways: src/trace/mod.rs -> src/sky.rs"),
        ("src/trace/deep.rs", "use super::super::{sky::Sky};", "sideways: src/trace/deep.rs -> src/sky.rs"),
        ("src/trace/deep.rs", "mod a { use super::super::super::sky; }", "sideways: src/trace/deep.rs -> src/sky.rs"),
        ("src/trace/deep.rs", "fn f() -> [u8; 2] { g!(crate::sky::Sky) }", "sideways: src/trace/deep.rs -> src/sky.rs"),
        ("src/frame/pool.rs", "fn f() { crate::sky::f() }", "up: src/frame/pool.rs -> src/sky.rs"),
        ("src/bin/paprsek/main.rs", "use paprsek::sky::Sky;", ""),
    ] {
        let files = [LIB, FRAME, TILE, ("src/sky.rs", "pub struct Sky;"), (path, text)];
        let found = complaints(&files, &[]);
        assert_eq!(found, if complaint.is_empty() { vec![] } else { vec![complaint.to_owned()] }, "{text}");
    }
}

#[test]
fn a_re_export_leads_to_where_it_is_from() {
    let passed_on = ("src/frame/mod.rs", "mod tile; pub use tile::Tile; pub use crate::sky::Sky;");
    let user = ("src/frame/pool.rs", "use super::Sky;");
    let found = complaints(&[LIB, passed_on, TILE, ("src/sky.rs", "pub struct Sky;"), user], &[]);
    assert_eq!(found, ["up: src/frame/pool.rs -> src/sky.rs"]);
    // And through everything of a module.
    let passed_on = ("src/frame/mod.rs", "mod tile; pub use tile::*;");
    let user = ("src/frame/pool.rs", "use super::Tile;");
    assert!(complaints(&[LIB, passed_on, TILE, user], &[]).is_empty());
}

#[test]
fn circles_are_found_and_can_be_allowed() {
    // What a file re-exports makes no circle; what stands in `mod.rs` itself does.
    let user = ("src/frame/pool.rs", "use super::{Tile, LIMIT};");
    let text = "mod pool; mod tile; pub use tile::Tile; pub use pool::Pool; pub const LIMIT: u32 = 1;";
    let tour = [LIB, TILE, user, ("src/frame/mod.rs", text)];
    assert!(complaints(&tour, &[]).is_empty());
    let text = format!("{text} use pool::f; fn g() {{ f() }}");
    let code = [LIB, TILE, user, ("src/frame/mod.rs", &*text)];
    let circle = ["circle: src/frame/pool.rs -> src/frame/mod.rs -> src/frame/pool.rs"];
    let found = complaints(&code, &[]);
    assert!(
        found == circle || found == ["circle: src/frame/mod.rs -> src/frame/pool.rs -> src/frame/mod.rs"],
        "{found:?}"
    );
    let allowed = ("src/frame/pool.rs", "src/frame/mod.rs", "made up");
    assert!(complaints(&code, &[allowed]).is_empty());
    // An exception that nothing needs any more.
    assert_eq!(complaints(&tour, &[allowed]).len(), 1);
    // Around three corners.
    let [a, b, c] = [("a", "b"), ("b", "c"), ("c", "a")]
        .map(|(from, to)| (format!("src/frame/{from}.rs"), format!("use super::{to}::T; pub struct T;")));
    let files = [LIB, (&a.0, &a.1), (&b.0, &b.1), (&c.0, &c.1), ("src/frame/mod.rs", "mod a; mod b; mod c;")];
    let found = complaints(&files, &[]);
    assert!(found.len() == 1 && found[0].matches("->").count() == 3, "{found:?}");
}

//! From paths of source files to crates and modules.

/// Where our own sources are: the package's folder and its crate.
pub struct Home {
    pub root: String,
    pub name: String,
}

impl Home {
    /// The module of a file, and whether it is ours.
    pub fn module(&self, file: &str) -> (String, bool) {
        let Some(path) = self.inside(file).strip_prefix("src/") else { return (krate(self.inside(file)), false) };
        let path = path.strip_suffix(".rs").unwrap_or(path);
        let path = path.strip_suffix("/mod").unwrap_or(path);
        let module = if path == "lib" { String::new() } else { format!("::{}", path.replace('/', "::")) };
        (self.name.clone() + &module, true)
    }

    /// A file as a person names it: without the folders of cargo, of Rust and of the package.
    pub fn short<'a>(&self, file: &'a str) -> &'a str {
        let cargo = file.split_once("/registry/src/").and_then(|(_, rest)| rest.split_once('/'));
        let rust = || file.split_once("/library/");
        cargo.or_else(rust).map_or_else(|| self.inside(file), |(_, rest)| rest)
    }

    fn inside<'a>(&self, file: &'a str) -> &'a str {
        file.strip_prefix(&*self.root).and_then(|f| f.strip_prefix('/')).unwrap_or(file)
    }
}

/// The crate of a file that is not ours.
fn krate(file: &str) -> String {
    let parts: Vec<&str> = file.split('/').collect();
    let after = |folder| parts.iter().position(|p| *p == folder).and_then(|i| parts.get(i + 1));
    let before = |folder| parts.iter().rposition(|p| *p == folder).and_then(|i| parts.get(i.checked_sub(1)?));
    let versioned = parts.iter().rev().find_map(|part| without_version(part)).filter(|name| *name != "rustc");
    let intrinsics = parts.contains(&"stdarch").then_some("stdarch");
    let named = || after("library").or_else(|| before("src")).copied();
    let name = versioned.or(intrinsics).or_else(named).unwrap_or("other");
    match name {
        "stdarch" => "core_arch".into(),
        "portable-simd" => "core".into(),
        name => name.replace('-', "_"),
    }
}

/// `rayon-core` of `rayon-core-1.13.0`.
fn without_version(part: &str) -> Option<&str> {
    let (name, version) = part.rsplit_once('-')?;
    let number = version.starts_with(|c: char| c.is_ascii_digit()) && version.contains('.');
    number.then_some(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_have_their_modules() {
        let home = Home { root: "/home/me/paprsek".into(), name: "paprsek".into() };
        let cargo = "/home/me/.cargo/registry/src/index.crates.io-1949cf8c6b5b557f";
        let rust = "/usr/lib/rustlib/src/rust/library";
        for (file, module, ours) in [
            ("/home/me/paprsek/src/trace/packet.rs", "paprsek::trace::packet", true),
            ("/home/me/paprsek/src/trace/mod.rs", "paprsek::trace", true),
            ("/home/me/paprsek/src/lib.rs", "paprsek", true),
            ("/home/me/paprsek/src/main.rs", "paprsek::main", true),
            ("src/frame/tile.rs", "paprsek::frame::tile", true),
            ("/home/me/paprsek/third/x11-dl/src/link.rs", "x11_dl", false),
            ("/home/me/paprsek/third/x11-dl-2.21/src/link.rs", "x11_dl", false),
            (&format!("{cargo}/rayon-core-1.13.0/src/job.rs"), "rayon_core", false),
            (&format!("{cargo}/minifb-0.29.0/src/native/posix/scalar.c"), "minifb", false),
            (&format!("{rust}/core/src/slice/mod.rs"), "core", false),
            (&format!("{rust}/core/src/../../stdarch/crates/core_arch/src/x86/avx.rs"), "core_arch", false),
            (&format!("{rust}/std/src/fs.rs"), "std", false),
            (&format!("{rust}/compiler-builtins/compiler-builtins/src/mem/mod.rs"), "compiler_builtins", false),
            ("/usr/src/rustc-1.96.0/library/alloc/src/vec/mod.rs", "alloc", false),
            ("/rustc/59807616e1fa2540724bfbac14d7976d7e4a3860/library/core/src/num/mod.rs", "core", false),
            ("/rust/deps/hashbrown-0.16.0/src/raw.rs", "hashbrown", false),
            ("<unknown>", "other", false),
        ] {
            assert_eq!(home.module(file), (module.to_string(), ours), "{file}");
        }
    }

    #[test]
    fn files_have_short_names() {
        let home = Home { root: "/home/me/paprsek".into(), name: "paprsek".into() };
        for (file, short) in [
            ("/home/me/paprsek/src/frame/tile.rs", "src/frame/tile.rs"),
            ("/c/registry/src/index.crates.io-19/glam-0.34.2/src/lib.rs", "glam-0.34.2/src/lib.rs"),
            ("/usr/lib/rustlib/src/rust/library/core/src/option.rs", "core/src/option.rs"),
        ] {
            assert_eq!(home.short(file), short);
        }
    }
}

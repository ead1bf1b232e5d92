//! From paths of source files to crates and modules.

/// Where our own sources are: the package's folder and its crate.
pub struct Home {
    pub root: String,
    pub name: String,
}

impl Home {
    /// The module of a file and whether it is ours.
    pub fn module(&self, file: &str) -> (String, bool) {
        let inside = file.strip_prefix(&*self.root).map(|f| f.trim_start_matches('/'));
        if let Some(path) = inside.unwrap_or(file).strip_prefix("src/") {
            let path = path.strip_suffix(".rs").unwrap_or(path);
            let path = path.strip_suffix("/mod").unwrap_or(path);
            let ours = if path == "lib" { String::new() } else { format!("::{}", path.replace('/', "::")) };
            return (self.name.clone() + &ours, true);
        }
        (krate(inside.unwrap_or(file)), false)
    }
}

/// The crate of a file that is not ours.
fn krate(file: &str) -> String {
    let parts: Vec<&str> = file.split('/').collect();
    let name = parts
        .iter()
        .rev()
        .find_map(|part| without_version(part))
        .filter(|name| !name.starts_with("rustc"))
        .or_else(|| after(&parts, "library"))
        .or_else(|| parts.iter().rposition(|p| *p == "src").and_then(|i| parts.get(i.checked_sub(1)?)).copied())
        .unwrap_or("other");
    match name {
        "stdarch" | "portable-simd" => "core".into(),
        name => name.replace('-', "_"),
    }
}

/// `rayon-core` of `rayon-core-1.13.0`.
fn without_version(part: &str) -> Option<&str> {
    let (name, version) = part.rsplit_once('-')?;
    let number = version.starts_with(|c: char| c.is_ascii_digit()) && version.contains('.');
    number.then_some(name)
}

fn after<'a>(parts: &[&'a str], name: &str) -> Option<&'a str> {
    let at = parts.iter().position(|p| *p == name)?;
    parts.get(at + 1).copied()
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
            ("src/tile.rs", "paprsek::tile", true),
            ("/home/me/paprsek/third/x11-dl/src/link.rs", "x11_dl", false),
            ("/home/me/paprsek/third/x11-dl-2.21/src/link.rs", "x11_dl", false),
            (&format!("{cargo}/rayon-core-1.13.0/src/job.rs"), "rayon_core", false),
            (&format!("{cargo}/minifb-0.29.0/src/native/posix/scalar.c"), "minifb", false),
            (&format!("{rust}/core/src/slice/mod.rs"), "core", false),
            (&format!("{rust}/core/src/../../stdarch/crates/core_arch/src/x86/avx.rs"), "core", false),
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
}

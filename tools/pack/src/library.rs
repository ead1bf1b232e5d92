//! The standard library's sources without what the intro never uses: 1.5 kB packed.
//!
//! Links lead to the toolchain's own files but for those that are cut.

use std::fs;
use std::io;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};

/// Texts of a file, and what becomes of each.
type Cuts = (&'static str, &'static [(&'static str, &'static str)]);

const CUTS: [Cuts; 4] = [
    (
        "std/src/thread/lifecycle.rs",
        &[
            // Nothing asks to be told of new threads: that is unstable.
            (
                "    let hooks = if no_hooks {
        spawnhook::ChildSpawnHooks::default()
    } else {
        spawnhook::run_spawn_hooks(&thread)
    };
",
                "",
            ),
            ("            crate::sys::backtrace::__rust_begin_short_backtrace(|| hooks.run());\n", ""),
            // No thread has a name.
            ("        if let Some(name) = self.handle.cname() {\n            imp::set_name(name);\n        }\n", ""),
        ],
    ),
    (
        "std/src/sys/thread/unix.rs",
        &[
            // The stack that is asked for is larger.
            ("let stack_size = cmp::max(stack, min_stack_size(attr.as_ptr()));", "let stack_size = stack;"),
            // No handler tells a stack overflow from other faults.
            ("let _handler = sys::stack_overflow::Handler::new();", ""),
        ],
    ),
    // No local of a thread has a destructor but the thread's handle.
    ("std/src/sys/thread_local/guard/key.rs", &[("            destructors::run();\n", "")]),
    (
        "std/src/rt.rs",
        // What is written to stdout is flushed at once, and only `main` ends the process.
        &[("\n        cleanup();\n", ""), ("        crate::sys::exit::unique_thread_exit();\n", "")],
    ),
];

/// The sources in `original`, cut, below `copy`. Where a toolchain's text is another it stays, for some more bytes.
pub fn cut(original: &Path, copy: &Path) -> Result<(), String> {
    mirror(original, copy, Path::new("")).map_err(|error| format!("cannot make {}: {error}", copy.display()))
}

fn mirror(original: &Path, copy: &Path, place: &Path) -> io::Result<()> {
    fs::create_dir_all(copy.join(place))?;
    for entry in fs::read_dir(original.join(place))? {
        let place = place.join(entry?.file_name());
        let (from, to) = (original.join(&place), copy.join(&place));
        match CUTS.iter().find(|(path, _)| Path::new(path).starts_with(&place)) {
            Some((path, cuts)) if Path::new(path) == place => {
                let text = cuts.iter().fold(fs::read_to_string(&from)?, without);
                // Written anew, a file that is the same would have cargo build all that needs it once more.
                if fs::read(&to).ok().as_deref() != Some(text.as_bytes()) {
                    fs::write(&to, text)?;
                }
            }
            Some(_) => mirror(original, copy, &place)?,
            None if fs::read_link(&to).is_ok_and(|there| there == from) => {}
            None => {
                let _ = fs::remove_file(&to);
                symlink(&from, &to)?;
            }
        }
    }
    Ok(())
}

/// The text with a part replaced that is in it once.
fn without(text: String, (old, new): &(&str, &str)) -> String {
    if text.matches(old).count() == 1 { text.replace(old, new) } else { text }
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
        let cut = |text: &str| without(text.into(), &("hooks();\n", ""));
        assert_eq!(cut("a();\nhooks();\nb();\n"), "a();\nb();\n");
        assert_eq!(cut("a();\n"), "a();\n");
        assert_eq!(cut("hooks();\nhooks();\n"), "hooks();\nhooks();\n");
    }

    #[test]
    fn a_copy_reads_as_the_original_but_for_what_is_cut() {
        let at = |name: &str| std::env::temp_dir().join(format!("pack-library-{}-{name}", std::process::id()));
        let (original, copy) = (at("original"), at("copy"));
        let (path, cuts) = CUTS[0];
        let text: String = cuts.iter().map(|(old, _)| *old).collect();
        let file = |path: &str, text: &str| {
            let path = original.join(path);
            fs::create_dir_all(path.parent().unwrap()).and_then(|()| fs::write(path, text)).unwrap();
        };
        file(path, &text);
        file("core/src/lib.rs", "core");
        for _ in 0..2 {
            cut(&original, &copy).unwrap();
        }
        assert_eq!(fs::read_to_string(copy.join("core/src/lib.rs")).unwrap(), "core");
        assert_eq!(fs::read_to_string(copy.join(path)).unwrap(), cuts.iter().map(|(_, new)| *new).collect::<String>());
        assert_eq!(fs::read_to_string(original.join(path)).unwrap(), text);
        for made in [original, copy] {
            fs::remove_dir_all(made).unwrap();
        }
    }
}

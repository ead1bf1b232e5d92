//! Names of functions and statics, as the compiler mangles them.

/// The paths in a demangled name, from left to right: its own first, then those of its types.
pub fn paths(name: &str) -> impl Iterator<Item = &str> {
    name.split(|c: char| !c.is_alphanumeric() && c != '_' && c != ':')
        .map(|path| path.trim_matches(':'))
        .filter(|path| path.contains("::"))
}

/// The crate of a path.
pub fn krate(path: &str) -> &str {
    path.split("::").next().unwrap_or(path)
}

/// `<Vec>::push` of `<Vec<u8>>::push`, `sort` of `sort::<u8>`.
pub fn without_types(name: &str) -> String {
    let mut kept = name.len() - name.trim_start_matches('<').len();
    let mut depth = 0;
    let mut short = String::new();
    let mut before = ' ';
    for c in name.chars() {
        depth += usize::from(c == '<');
        if depth <= kept {
            short.push(c);
        }
        if c == '>' && before != '-' {
            depth -= 1;
            kept = kept.min(depth);
        }
        before = c;
    }
    short.replace("::::", "::").trim_end_matches("::").to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_of_a_name() {
        let name = "<core::cell::Cell<(u8, x11_dl::xlib::Xlib)> as core::fmt::Debug>::fmt::{closure#0}";
        let found: Vec<_> = paths(name).collect();
        assert_eq!(found, ["core::cell::Cell", "x11_dl::xlib::Xlib", "core::fmt::Debug"]);
    }

    #[test]
    fn types_are_left_out() {
        for (name, short) in [
            ("core::ptr::drop_in_place::<alloc::vec::Vec<u8>>", "core::ptr::drop_in_place"),
            ("<alloc::vec::Vec<u8>>::push", "<alloc::vec::Vec>::push"),
            ("<a::B<fn() -> u8> as c::D<E>>::f::<G>::{closure#0}", "<a::B as c::D>::f::{closure#0}"),
            ("<<A<u8> as From<B>>::from::C as D<E>>::f", "<<A as From>::from::C as D>::f"),
            ("<a::B<u8>>::with::<<a::C>::d::{closure#0}, u64>", "<a::B>::with"),
            ("memcpy", "memcpy"),
        ] {
            assert_eq!(without_types(name), short);
        }
    }
}

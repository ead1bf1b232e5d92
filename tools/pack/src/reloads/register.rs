//! Names of registers.

/// A register, whatever part of it a name means: 0 to 15 are general ones, 16 to 31 are vectors.
pub type Family = u8;
/// The stack pointer.
pub const RSP: Family = 4;
/// The first vector register.
pub const VECTORS: Family = 16;
/// The registers that calls may write to, as a set of bits.
pub const CALLERS: u32 = 0xffff_0fc7;

/// The first eight general registers, as their names end.
const OLD: [&str; 8] = ["ax", "cx", "dx", "bx", "sp", "bp", "si", "di"];

/// The register that a name such as `eax` means, and how many of its bytes; none for others.
pub fn named(name: &str) -> Option<(Family, u8)> {
    for (prefix, size) in [("ymm", 32), ("xmm", 16)] {
        if let Some(number) = name.strip_prefix(prefix) {
            return number.parse().ok().filter(|number| *number < 16).map(|number: u8| (VECTORS + number, size));
        }
    }
    if let Some(number) = name.strip_prefix('r')
        && let Ok(number @ 8..16) = number.trim_end_matches(['d', 'w', 'b']).parse()
    {
        let size = match name.as_bytes().last() {
            Some(b'd') => 4,
            Some(b'w') => 2,
            Some(b'b') => 1,
            _ => 8,
        };
        return Some((number, size));
    }
    let number = |end: &str| OLD.iter().position(|old| *old == end).map(|number| number as Family);
    match name.as_bytes() {
        [b'r', ..] => Some((number(&name[1..])?, 8)),
        [b'e', ..] => Some((number(&name[1..])?, 4)),
        [_, _, b'l'] => Some((number(&name[..2])?, 1)),
        [first @ b'a'..=b'd', b'l' | b'h'] => Some((number(&format!("{}x", *first as char))?, 1)),
        _ => Some((number(name)?, 2)),
    }
}

/// The name of the lower `size` bytes of a register; of a vector's 32 or 16.
pub fn name(family: Family, size: u8) -> String {
    match (family, size) {
        (VECTORS.., 32) => format!("%ymm{}", family - VECTORS),
        (VECTORS.., _) => format!("%xmm{}", family - VECTORS),
        (8.., 8) => format!("%r{family}"),
        (8.., 4) => format!("%r{family}d"),
        (8.., 2) => format!("%r{family}w"),
        (8.., _) => format!("%r{family}b"),
        (_, 8) => format!("%r{}", OLD[family as usize]),
        (_, 4) => format!("%e{}", OLD[family as usize]),
        (_, 2) => format!("%{}", OLD[family as usize]),
        (..4, _) => format!("%{}l", &OLD[family as usize][..1]),
        _ => format!("%{}l", OLD[family as usize]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_their_registers() {
        for family in 0..16 {
            for size in [8, 4, 2, 1] {
                assert_eq!(named(&name(family, size)[1..]), Some((family, size)), "{}", name(family, size));
            }
            for size in [32, 16] {
                let family = VECTORS + family;
                assert_eq!(named(&name(family, size)[1..]), Some((family, size)), "{}", name(family, size));
            }
        }
        assert_eq!((named("ah"), named("dh"), named("bpl")), (Some((0, 1)), Some((2, 1)), Some((5, 1))));
        assert_eq!((named("es"), named("st"), named("k1"), named("xmm16")), (None, None, None, None));
    }

    #[test]
    fn calls_leave_what_the_abi_says() {
        let kept: Vec<_> = (0..32).filter(|family| CALLERS >> family & 1 == 0).map(|family| name(family, 8)).collect();
        assert_eq!(kept, ["%rbx", "%rsp", "%rbp", "%r12", "%r13", "%r14", "%r15"]);
    }
}

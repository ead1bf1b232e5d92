//! The contexts. Found by random search (`cargo run -p pack --release --example tune`) in a
//! program without the code of `x11_dl::Xlib::open`, so that its 66 kB of repetition have no say.

use crate::model::Sets;

/// Which features ([`crate::features`]) make each context, in code and in data.
pub const SETS: Sets = [
    [
        0x00000040, 0xa0000000, 0x00000041, 0x00000440, 0x80000840, 0x90011480, 0x00003001, 0x000008c2, 0x00001040,
        0x00000140,
    ],
    [
        0x00000000, 0x00000003, 0x00000007, 0x2000000e, 0x00008008, 0x00a08020, 0x00800000, 0x40000001, 0x10000000,
        0x20000000,
    ],
];

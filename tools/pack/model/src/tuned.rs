//! The contexts. Found by random search (`cargo run -p pack --release --example tune`) in the intro itself: with
//! them, other programs take 5 to 6 % less than with ten contexts of before, too.

use crate::model::Sets;

/// Which features ([`crate::features`]) make each context, in code and in data.
pub const SETS: Sets = [
    [
        0x01810040, 0x00002041, 0x00000041, 0x00000400, 0x80400840, 0x04501440, 0x00044044, 0x00009408, 0x02001140,
        0x02000040, 0x00040140, 0x08050140, 0x00180140, 0x00300040, 0x01801140, 0x80040080,
    ],
    [
        0x20000000, 0x20000003, 0x00000007, 0x00000210, 0x20008848, 0x80000000, 0x00000030, 0x40000001, 0x10000000,
        0x00000001, 0x0000000c, 0x00000002, 0x00a14001, 0x00000080, 0x00000000, 0x00000000,
    ],
];

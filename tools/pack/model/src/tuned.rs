//! The contexts. Found by random search (`cargo run -p pack --release --example tune`) in the intro itself: with
//! them, other programs take 5 to 6 % less than with ten contexts of before, too.

use crate::model::Sets;

/// Which features ([`crate::features`]) make each context, in code and in data.
pub const SETS: Sets = [
    [
        0x04810040, 0xa4000200, 0x00000041, 0x00000400, 0x80400840, 0x045014c0, 0x00003041, 0x00009400, 0x00021040,
        0x00040040, 0x00040140, 0x2c000e00, 0x00180140, 0x00300040, 0x10800140, 0x80000080,
    ],
    [
        0x20000000, 0x00000003, 0x00000007, 0x00000210, 0x20008048, 0x80000000, 0x00000000, 0x40000001, 0x10000000,
        0x00000001, 0x0000000c, 0x00000002, 0x00a12001, 0x00000080, 0x00000000, 0x20000004,
    ],
];

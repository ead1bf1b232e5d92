//! The contexts. Found by random search (`cargo run -p pack --release --example tune`).

use crate::model::Sets;

/// Which features ([`crate::features`]) make each context, in code and in data.
pub const SETS: Sets = [[0x00000001,0x00000003,0x00000007,0x00000440,0x00001400,0x00011400,0x00044400,0x00000340,0x10000140,0x00001041,0x000001c0],[0x00000001,0x00000003,0x00000007,0x0000000f,0x00000081,0x00008800,0x00800000,0x20000009,0x40000001,0x00000006,0x20008000]];

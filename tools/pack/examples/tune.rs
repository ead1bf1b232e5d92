//! wip
use pack::compress::*;
use pack_model::{address::*, tuned::SETS};
fn code_range(e: &[u8]) -> (usize, usize) {
    let g = |o: usize, n: usize| (0..n).fold(0u64, |v, i| v | (e[o + i] as u64) << (8 * i));
    let sh = g(0x28, 8) as usize;
    let (mut a, mut b) = (usize::MAX, 0);
    for i in 0..g(0x3c, 2) as usize {
        let o = sh + 64 * i;
        if g(o + 4, 4) == 1 && g(o + 8, 8) & 4 != 0 {
            let p = g(o + 24, 8) as usize;
            a = a.min(p);
            b = b.max(p + g(o + 32, 8) as usize);
        }
    }
    (a, b)
}
fn main() {
    for f in std::env::args().skip(1) {
        let e = std::fs::read(&f).unwrap();
        let r = code_range(&e);
        let sh = u64::from_le_bytes(e[0x28..0x30].try_into().unwrap()) as usize;
        let mut d = e[..sh].to_vec();
        d[0x28..0x30].fill(0);
        d[0x3a..0x40].fill(0);
        convert(&mut d[r.0..r.1], 0x400000 + r.0 as u32, Way::Absolute);
        let c = costs(&SETS, &d, r);
        let t = std::time::Instant::now();
        let z = compress(&SETS, &d, r);
        let t1 = t.elapsed();
        let back = decompress(&SETS, &z, d.len(), r);
        assert!(back == d);
        println!("{f} {} cost {:.0} packed {} {:?}, {} ns/bit", d.len(), c.iter().map(|c| c.0 as f64).sum::<f64>() / 8.0, z.len(), t1, t1.as_nanos() / d.len() as u128 / 8);
    }
}

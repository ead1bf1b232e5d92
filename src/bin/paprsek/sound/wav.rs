//! The sound of a capture, as a WAV file: 16 bits, two channels (RIFF, "Multimedia Programming Interface and Data
//! Specifications 1.0", 1991).

use crate::args::Args;
use crate::io;
use paprsek::scenes::show::score::score;
use paprsek::sound::{Pair, RATE};

/// Samples that are evaluated and written at once.
const PIECE: u64 = 1 << 14;
/// Bytes of the head, before the samples.
const HEAD: usize = 44;
/// Bytes that a WAV file can hold: its numbers have 32 bits.
const MOST: u64 = u32::MAX as u64 - HEAD as u64;

/// Saves the sound of the range that `args` ask for.
pub fn save(args: &Args, name: &[u8]) -> Result<(), Vec<u8>> {
    let [first, end] =
        [args.start.unwrap_or(0.0), args.end_of(args.scene())].map(|time| (time * f64::from(RATE)).round() as u64);
    let bytes = (end - first).saturating_mul(size_of::<Pair>() as u64);
    if bytes > MOST {
        return Err(b"--sound cannot be that long: a WAV file has up to 4 GB".to_vec());
    }
    let mut score = score();
    let mut samples = vec![[0; 2]; PIECE as usize];
    let pieces = (first..end).step_by(PIECE as usize).map(|from| {
        let samples = &mut samples[..(end - from).min(PIECE) as usize];
        score.samples(from, samples);
        samples.as_flattened().iter().flat_map(|code| code.to_le_bytes()).collect()
    });
    io::save(name, std::iter::once(head(bytes as u32)).chain(pieces), false)
}

/// The head of a file with so many bytes of samples.
fn head(bytes: u32) -> Vec<u8> {
    let frame = size_of::<Pair>() as u32;
    let mut head = Vec::with_capacity(HEAD);
    let mut put = |bytes: &[u8]| head.extend_from_slice(bytes);
    put(b"RIFF");
    put(&(bytes + HEAD as u32 - 8).to_le_bytes());
    put(b"WAVEfmt ");
    put(&16_u32.to_le_bytes());
    // Whole numbers, two channels.
    put(&[1, 0, 2, 0]);
    put(&RATE.to_le_bytes());
    put(&(RATE * frame).to_le_bytes());
    // Bytes of a sample of both, bits of one.
    put(&[frame as u8, 0, 16, 0]);
    put(b"data");
    put(&bytes.to_le_bytes());
    head
}

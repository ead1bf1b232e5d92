//! What every renderer stands on: noise, keyframes, fog, encoding to 8 bits, two eyes, and that SIMD levels, threads and
//! history change no byte.

mod angle;
mod color;
mod fog;
mod inspect;
mod levels;
mod noise;
mod renderers;
mod stereo;
mod timeline;
mod vector;

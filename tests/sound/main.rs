//! Sound: voices against the theory of frequency modulation, samples wherever one starts to listen and at every SIMD
//! level, and the show's score as a listener and a sound card get it.

mod score;
mod voice;

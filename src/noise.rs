//! stub
use fearless_simd::prelude::*;
use glam::Vec3;
pub const BLOCK: usize = 64;
pub fn fbm(_p: Vec3, _o: u32) -> f32 { 0.0 }
pub fn turbulence(_p: Vec3, _o: u32) -> f32 { 0.0 }
pub fn fbm_block<S: Simd>(_: S, _x: &[f32; 64], _y: &[f32; 64], _z: &[f32; 64], _octaves: u32, out: &mut [f32; 64]) { *out = [0.0; 64]; }
pub fn turbulence_block<S: Simd>(_: S, _x: &[f32; 64], _y: &[f32; 64], _z: &[f32; 64], _octaves: u32, out: &mut [f32; 64]) { *out = [0.0; 64]; }

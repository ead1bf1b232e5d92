//! Pictures of worlds, made in more than one way, and how much they differ.
#![allow(dead_code)] // Every test takes its part.

use fearless_simd::Level;
use glam::Vec3;
use paprsek::frame::encode::{Transfer, quantize};
use paprsek::frame::{Layer, Tile};
use paprsek::settings::Quality;
use paprsek::trace::reference::{self, Ray};
use paprsek::trace::{TraceLayer, World};
use paprsek::view::{Camera, View};

/// A picture of linear light, row by row from the top left.
#[derive(Clone)]
pub struct Light {
    pub width: usize,
    pub height: usize,
    pub pixels: Vec<Vec3>,
    /// Eye rays.
    pub samples: u64,
}

/// An empty tile.
fn tile() -> Tile {
    Tile::at(0, 0, Tile::SIZE, Tile::SIZE)
}

/// What the renderer makes of a world, tile by tile.
pub fn traced(world: &World, camera: Camera, size: (usize, usize), quality: Quality, level: Level) -> Light {
    let (width, height) = size;
    let layer = TraceLayer::new(world.clone(), &View::new(camera, width, height), &quality.trace);
    let mut pixels = vec![Vec3::ZERO; width * height];
    let (mut tile, mut samples) = (tile(), 0);
    for y in (0..height).step_by(Tile::SIZE) {
        for x in (0..width).step_by(Tile::SIZE) {
            (tile.x, tile.y) = (x, y);
            (tile.width, tile.height) = (Tile::SIZE.min(width - x), Tile::SIZE.min(height - y));
            samples += layer.draw(level, &mut tile).samples;
            for row in 0..tile.height {
                for column in 0..tile.width {
                    let at = row * Tile::SIZE + column;
                    pixels[(y + row) * width + x + column] = Vec3::new(tile.red[at], tile.green[at], tile.blue[at]);
                }
            }
        }
    }
    Light { width, height, pixels, samples }
}

/// The unit eye ray through the middle of a pixel, by the bench scenes' text.
pub fn eye_ray(camera: &Camera, size: (usize, usize), x: usize, y: usize) -> Vec3 {
    let (w, h) = (size.0 as f64, size.1 as f64);
    let px = (2.0 * (x as f64 + 0.5) - w) / h;
    let py = (h - 2.0 * (y as f64 + 0.5)) / h;
    let d = camera.forward.as_dvec3() + camera.right.as_dvec3() * px + camera.up.as_dvec3() * py;
    d.normalize().as_vec3()
}

/// One ray a pixel, one after the other.
pub fn plain(world: &World, camera: Camera, size: (usize, usize)) -> Light {
    let (width, height) = size;
    let rows = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let pixels = rows.map(|(x, y)| reference::radiance(world, Ray::new(camera.eye, eye_ray(&camera, size, x, y)), 1));
    Light { width, height, pixels: pixels.collect(), samples: (width * height) as u64 }
}

impl Light {
    /// The screen's codes.
    pub fn codes(&self) -> Codes {
        let channel = |(i, c): (usize, &Vec3)| {
            let (x, y) = ((i % self.width) as u32, (i / self.width) as u32);
            [0, 1, 2].map(|k| quantize(Transfer::Gamma22, c[k], x, y, k as u32) as u8)
        };
        let pixels = self.pixels.iter().enumerate().map(channel).collect();
        Codes { width: self.width, height: self.height, pixels }
    }
}

/// A picture of 8 bits a channel.
#[derive(Clone, PartialEq)]
pub struct Codes {
    pub width: usize,
    pub height: usize,
    pub pixels: Vec<[u8; 3]>,
}

/// How much two pictures differ.
#[derive(Clone, Copy, Debug)]
pub struct Difference {
    /// Over all channels, decibels; 99 for none.
    pub psnr: f64,
    /// Of luminance, over blocks of 8x8.
    pub ssim: f64,
    /// Share of pixels in which a channel differs by more than 8 codes.
    pub bad: f64,
    /// Root mean square, codes.
    pub rms: f64,
    /// The largest difference of a channel, codes.
    pub largest: u8,
}

impl Codes {
    pub fn from_pixels(width: usize, height: usize, pixels: &[u32]) -> Codes {
        let pixels = pixels.iter().map(|p| [(p >> 16) as u8, (p >> 8) as u8, *p as u8]).collect();
        Codes { width, height, pixels }
    }

    /// The largest difference of each pixel's channels.
    pub fn gaps(&self, other: &Codes) -> Vec<u8> {
        let gap = |(a, b): (&[u8; 3], &[u8; 3])| (0..3).map(|k| a[k].abs_diff(b[k])).max().unwrap();
        self.pixels.iter().zip(&other.pixels).map(gap).collect()
    }

    /// The metrics of the bench scenes: mean square over 8-bit RGB, and Wang's structural similarity with a uniform
    /// window.
    ///
    /// Z. Wang et al., "Image quality assessment: from error visibility to structural similarity", 2004.
    pub fn difference(&self, other: &Codes) -> Difference {
        assert_eq!((self.width, self.height), (other.width, other.height));
        let pairs = || self.pixels.iter().flatten().zip(other.pixels.iter().flatten());
        let square: f64 = pairs().map(|(a, b)| (*a as f64 - *b as f64).powi(2)).sum();
        let rms = (square / (3 * self.pixels.len()) as f64).sqrt();
        let gaps = self.gaps(other);
        Difference {
            psnr: if rms == 0.0 { 99.0 } else { 20.0 * (255.0 / rms).log10() },
            ssim: self.similarity(other),
            bad: gaps.iter().filter(|g| **g > 8).count() as f64 / gaps.len() as f64,
            rms,
            largest: *gaps.iter().max().unwrap(),
        }
    }

    fn similarity(&self, other: &Codes) -> f64 {
        const BLOCK: usize = 8;
        let luminance = |p: [u8; 3]| 0.2126 * p[0] as f64 + 0.7152 * p[1] as f64 + 0.0722 * p[2] as f64;
        let (c1, c2) = ((0.01 * 255f64).powi(2), (0.03 * 255f64).powi(2));
        let (mut sum, mut blocks) = (0.0, 0.0);
        for y in (0..=self.height - BLOCK).step_by(BLOCK) {
            for x in (0..=self.width - BLOCK).step_by(BLOCK) {
                let mut moments = [0.0; 5];
                for at in (0..BLOCK * BLOCK).map(|i| (y + i / BLOCK) * self.width + x + i % BLOCK) {
                    let (a, b) = (luminance(self.pixels[at]), luminance(other.pixels[at]));
                    for (moment, value) in moments.iter_mut().zip([a, b, a * a, b * b, a * b]) {
                        *moment += value / (BLOCK * BLOCK) as f64;
                    }
                }
                let [a, b, aa, bb, ab] = moments;
                let (va, vb, cov) = (aa - a * a, bb - b * b, ab - a * b);
                sum += (2.0 * a * b + c1) * (2.0 * cov + c2) / ((a * a + b * b + c1) * (va + vb + c2));
                blocks += 1.0;
            }
        }
        sum / blocks
    }
}

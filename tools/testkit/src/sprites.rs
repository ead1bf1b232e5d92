//! Particles of any kind as a layer, in linear light, and what they should be in f64.

use super::particles::{Camera, Spot, random, smoothstep};
use fearless_simd::Level;
use glam::{DVec3, Vec3A, dvec3, vec3a};
use paprsek::frame::encode::Transfer;
use paprsek::frame::{Frame, Layer, Picture, Renderer, Stats, Tile};
use paprsek::particles::{Emitter, Fire, ParticleLayer, Snow};
use paprsek::scenes::bench::particles::fires;
use paprsek::settings::Quality;
use paprsek::view;
use paprsek::view::View;
use std::f64::consts::TAU;
use std::sync::{Arc, Mutex};

/// Pixels along x and y.
pub type Size = (usize, usize);

/// What is at a pixel before particles are: light, and metres along the view axis to a solid, if there is one.
pub type Behind = fn(usize, usize) -> (Vec3A, Option<f32>);

/// What is behind where it does not matter.
pub fn dusk(x: usize, y: usize) -> (Vec3A, Option<f32>) {
    (Vec3A::new(0.3, 0.2, 0.1) + 0.001 * (x % 7) as f32 + 0.002 * (y % 5) as f32, None)
}

/// Draws what is behind.
struct Below(Behind);

impl Layer for Below {
    fn draw(&self, _: Level, tile: &mut Tile) -> Stats {
        for row in 0..tile.height {
            for column in 0..tile.width {
                let at = row * Tile::SIZE + column;
                let (light, depth) = self.0(tile.x + column, tile.y + row);
                [tile.red[at], tile.green[at], tile.blue[at]] = light.to_array();
                (tile.inv_depth[at], tile.coverage[at]) = depth.map_or((0.0, 0.0), |depth| (1.0 / depth, 1.0));
            }
        }
        Stats::default()
    }
}

/// A layer that draws nothing and remembers what is below it: pixels row by row, and how many there are in a row.
struct Probe(Arc<Mutex<Vec<Vec3A>>>, usize);

impl Layer for Probe {
    fn draw(&self, _: Level, tile: &mut Tile) -> Stats {
        let mut light = self.0.lock().unwrap();
        for row in 0..tile.height {
            for column in 0..tile.width {
                let from = row * Tile::SIZE + column;
                light[(tile.y + row) * self.1 + tile.x + column] =
                    Vec3A::new(tile.red[from], tile.green[from], tile.blue[from]);
            }
        }
        Stats::default()
    }
}

/// The view of the bench scenes from an eye towards a direction.
pub fn view(eye: Vec3A, forward: Vec3A, size: Size) -> View {
    View::new(view::Camera::look_at(eye, eye + forward, 50f32.to_radians(), 0.0), size.0, size.1)
}

/// The light of a picture with particles over what is behind.
pub fn draw(renderer: &mut Renderer, particles: ParticleLayer, size: Size, behind: Behind) -> Vec<Vec3A> {
    over(renderer, Box::new(Below(behind)), particles, size)
}

fn over(renderer: &mut Renderer, below: Box<dyn Layer>, particles: ParticleLayer, size: Size) -> Vec<Vec3A> {
    let light = Arc::new(Mutex::new(vec![Vec3A::NAN; size.0 * size.1]));
    let probe = Probe(light.clone(), size.0);
    let layers: Vec<Box<dyn Layer>> = vec![below, Box::new(particles), Box::new(probe)];
    renderer.draw(Picture { layers, transfer: Transfer::Linear }, &mut Frame::new(size.0, size.1));
    let light = light.lock().unwrap();
    light.clone()
}

/// The same for fires seen along `forward` from `eye`, on two threads.
pub fn burn(fires: &[Fire], exposure: f32, eye: Vec3A, forward: Vec3A, size: Size, behind: Behind) -> Vec<Vec3A> {
    let particles = ParticleLayer::new(
        fires.iter().copied().map(Emitter::Fire).collect(),
        &view(eye, forward, size),
        &Quality::EXACT.particles,
    )
    .exposed(exposure);
    draw(&mut Renderer::new(2).unwrap(), particles, size, behind)
}

/// Snow over the background of the bench scene.
pub fn snow(field: Snow, eye: Vec3A, forward: Vec3A, size: Size) -> Vec<Vec3A> {
    struct Gradient(f32);
    impl Layer for Gradient {
        fn draw(&self, _: Level, tile: &mut Tile) -> Stats {
            for at in 0..Tile::AREA {
                let up = 1.0 - ((tile.y + at / Tile::SIZE) as f32 + 0.5) / self.0;
                let light = vec3a(0.58, 0.63, 0.70).lerp(vec3a(0.16, 0.20, 0.30), up);
                [tile.red[at], tile.green[at], tile.blue[at]] = light.to_array();
            }
            Stats::default()
        }
    }
    let layer = ParticleLayer::new(vec![field.into()], &view(eye, forward, size), &Quality::EXACT.particles)
        .colored(vec3a(0.95, 0.97, 1.0));
    over(&mut Renderer::new(2).unwrap(), Box::new(Gradient(size.1 as f32)), layer, size)
}

/// A particle that stands still: where it is, its radius, and its light where it is brightest. It is number 0 of the bench
/// scene's stream.
pub fn still(place: Vec3A, radius: f32, light: Vec3A) -> Fire {
    let mut fire = fires(0.0)[0];
    fire.flame.life = [1.0, 0.0];
    (fire.flame.ring, fire.flame.speed, fire.flame.lift) = ([0.0; 2], [0.0; 2], 0.0);
    fire.flame.radius = [radius; 2];
    // A third of a life after its birth 30 x (1 - x)^2 is 40/9.
    fire.time = 1.0 / 3.0 - random(fire.seed, 0, 1);
    fire.weight = 9.0 / 40.0;
    fire.flame.light = [light; 2];
    Fire { place, count: 1.0, first: 0, ..fire }
}

/// A sprite in f64.
struct Soft {
    spot: Spot,
    /// Metres before a solid within which it fades.
    edge: f64,
    light: DVec3,
}

/// A fire's particles that are before the eye.
fn softs(fire: &Fire, eye: DVec3, camera: &Camera, height: usize) -> Vec<Soft> {
    let flame = &fire.flame;
    let [inner, outer] = flame.ring.map(f64::from);
    let ends = |pair: [f32; 2], x: f64| f64::from(pair[0]) + f64::from(pair[1] - pair[0]) * x;
    let mut found = Vec::new();
    for i in 0..fire.count.ceil() as u32 {
        let chance = |k| random(fire.seed, fire.first + i, k);
        let life = flame.life[0] + flame.life[1] * chance(0);
        let lived = fire.time / life + chance(1);
        let x = lived - lived.floor();
        let (phi, theta) = (TAU * chance(2), f64::from(flame.cone) * chance(3).sqrt());
        let (from, gamma) = ((inner * inner + (outer * outer - inner * inner) * chance(4)).sqrt(), TAU * chance(5));
        let first = f64::from(flame.speed[0]) + f64::from(flame.speed[1]) * chance(6);
        let way = life * first * (x + (f64::from(flame.slows) - 1.0) * x * x / 2.0);
        let from = from * (1.0 - x * f64::from(flame.narrows));
        let mut at = dvec3(from * gamma.cos(), 0.0, from * gamma.sin());
        at += way * dvec3(theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin());
        at.y += f64::from(flame.lift) * (x * life).powi(2);
        let scale = f64::from(fire.scale);
        let Some(mut spot) = camera.spot(fire.place.as_dvec3() + at * scale - eye, scale * ends(flame.radius, x))
        else {
            continue;
        };
        // The lens: its blur, a least and a greatest radius, and where things come into sight.
        let metre = 0.5 * height as f64 / 25f64.to_radians().tan() / spot.depth;
        let lacks = (1.0 - spot.depth / f64::from(fire.lens.focus)).max(0.0);
        let [least, greatest] = fire.lens.radius.map(f64::from);
        let size = spot.radius;
        spot.radius = (size + lacks * f64::from(fire.lens.aperture) * metre).clamp(least, greatest);
        let [near, far] = fire.lens.near.map(f64::from);
        let share = (size / spot.radius).powi(2).min(1.0) * smoothstep(near, far, spot.depth);
        // What is left of the last one.
        let whole = (f64::from(fire.count) - f64::from(i)).clamp(0.0, 1.0);
        let glow = 30.0 * x * (1.0 - x).powi(2) * f64::from(fire.weight) * whole;
        let light = flame.light[0].as_dvec3() + (flame.light[1] - flame.light[0]).as_dvec3() * x;
        found.push(Soft { edge: spot.radius / metre, spot, light: light * glow * share });
    }
    found
}

/// What [`burn`] should give: the light of all sprites on film, over what is behind.
pub fn truth(fires: &[Fire], exposure: f64, eye: Vec3A, forward: Vec3A, size: Size, behind: Behind) -> Vec<DVec3> {
    let camera = Camera::new(forward.as_dvec3(), size);
    let mut sum = vec![DVec3::ZERO; size.0 * size.1];
    for soft in fires.iter().flat_map(|fire| softs(fire, eye.as_dvec3(), &camera, size.1)) {
        camera.cover(&soft.spot, |at, mut weight| {
            if let Some(depth) = behind(at % size.0, at / size.0).1 {
                weight *= ((f64::from(depth) - soft.spot.depth) / soft.edge).clamp(0.0, 1.0);
            }
            sum[at] += soft.light * weight;
        });
    }
    let pixel = |at: usize| {
        let light = behind(at % size.0, at / size.0).0.as_dvec3();
        1.0 - (1.0 - light) * (-exposure * sum[at]).exp()
    };
    (0..size.0 * size.1).map(pixel).collect()
}

/// The largest difference of a channel; infinite where there is no number.
pub fn worst(found: &[Vec3A], truth: &[DVec3]) -> f64 {
    assert_eq!(found.len(), truth.len());
    let off = |(a, b): (&Vec3A, &DVec3)| {
        let off = (a.as_dvec3() - *b).abs().max_element();
        if a.is_finite() { off } else { f64::INFINITY }
    };
    found.iter().zip(truth).map(off).fold(0.0, f64::max)
}

/// The same between two pictures.
pub fn off(a: &[Vec3A], b: &[Vec3A]) -> f64 {
    worst(a, &b.iter().map(|c| c.as_dvec3()).collect::<Vec<_>>())
}

/// Have two pictures the same bits?
pub fn same(a: &[Vec3A], b: &[Vec3A]) -> bool {
    let bits = |light: &[Vec3A]| light.iter().map(|c| c.to_array().map(f32::to_bits)).collect::<Vec<_>>();
    bits(a) == bits(b)
}

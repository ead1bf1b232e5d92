//! The level of detail of fires: which particles are left of one, and that nothing pops as that changes.

use glam::{Vec3A, vec3a};
use paprsek::frame::encode::Transfer;
use paprsek::frame::{Frame, Layer, Picture, Renderer, Stats, Tile};
use paprsek::particles::{Fire, ParticleLayer};
use paprsek::scenes::bench::particles::fires;
use paprsek::settings::Quality;
use paprsek::view::Camera;
use paprsek::view::View;

const SIZE: (usize, usize) = (320, 180);
/// Share of the particles for each pixel of height: all where a fire is half as high as the picture.
const DETAIL: f32 = 1.0 / 90.0;

/// A torch of 2000 particles, and the view of an eye so many metres from it that looks beside it.
fn torch(away: f32) -> (Fire, View) {
    let eye = vec3a(0.0, 0.8, away);
    let camera = Camera::look_at(eye, vec3a(0.1 * away, 0.8, 0.0), 50f32.to_radians(), 0.0);
    (Fire { place: Vec3A::ZERO, ..fires(7.0)[0] }, View::new(camera, SIZE.0, SIZE.1))
}

/// Distances that grow by a hundredth, from in the fire to far away.
fn distances(from: f32, to: f32) -> impl Iterator<Item = f32> {
    std::iter::successors(Some(from), |away| Some(away * 1.01)).take_while(move |away| *away < to)
}

#[test]
fn infinite_detail_is_the_fire_itself() {
    for away in [0.0, 0.3, 4.0, 1e4] {
        let (fire, view) = torch(away);
        let all = fire.detailed(&view, f32::INFINITY);
        assert_eq!((all.count, all.weight), (fire.count, fire.weight), "at {away} m");
        // Nor has it more than there are.
        let more = fire.detailed(&view, 1e3);
        assert_eq!((more.count, more.weight), (fire.count, fire.weight), "at {away} m");
    }
}

#[test]
fn light_stays_and_the_count_follows_the_distance_without_a_leap() {
    /// Rounding of one quotient and two products.
    const ROUNDING: f32 = 3e-7;
    let mut last: Option<f32> = None;
    for away in distances(0.01, 1e4) {
        let (fire, view) = torch(away);
        let less = fire.detailed(&view, DETAIL);
        let (light, all) = (less.count * less.weight, fire.count * fire.weight);
        assert!((light / all - 1.0).abs() < ROUNDING, "{light} of {all} at {away} m");
        // It is proportional to the distance, or to 1 over it; the eye is not quite as high as the fire's middle.
        if let Some(last) = last {
            assert!((less.count / last - 1.0).abs() < 0.0102, "from {last} to {} at {away} m", less.count);
        }
        last = Some(less.count);
    }
}

#[test]
fn small_fires_and_fires_around_the_eye_have_fewer() {
    let count = |away: f32| {
        let (fire, view) = torch(away);
        fire.detailed(&view, DETAIL).count
    };
    // 90 pixels high at 3.5 m, and as high as the picture at 1.7 m.
    assert_eq!([2.0, 3.0].map(count), [2000.0; 2]);
    let far = [count(7.0), count(14.0)];
    assert!((900.0..1100.0).contains(&far[0]) && (far[0] / far[1] - 2.0).abs() < 0.01, "{far:?}");
    let near = [count(0.7), count(0.35)];
    assert!((600.0..1000.0).contains(&near[0]) && (near[0] / near[1] - 2.0).abs() < 0.05, "{near:?}");
    // Never so few that it flickers, and none is cut that has so few.
    assert_eq!([0.0, 1e3, 1e6].map(count), [128.0; 3]);
    let (fire, view) = torch(100.0);
    assert_eq!(Fire { count: 60.0, ..fire }.detailed(&view, DETAIL).count, 60.0);
}

/// Nothing behind the particles.
struct Black;

impl Layer for Black {
    fn draw(&self, _: fearless_simd::Level, tile: &mut Tile) -> Stats {
        tile.clear();
        Stats::default()
    }
}

fn draw(renderer: &mut Renderer, fire: Fire, view: &View) -> Vec<u32> {
    let particles = ParticleLayer::new(vec![fire.into()], view, &Quality::EXACT.particles);
    let mut frame = Frame::new(SIZE.0, SIZE.1);
    let layers: Vec<Box<dyn Layer>> = vec![Box::new(Black), Box::new(particles)];
    renderer.draw(Picture { layers, transfer: Transfer::Linear }, &mut frame);
    frame.pixels
}

/// The mean square of the changes of channels, codes.
fn change(a: &[u32], b: &[u32]) -> f64 {
    let off = |(a, b): (&u32, &u32)| [0, 8, 16].map(|shift| f64::from((a >> shift & 255).abs_diff(b >> shift & 255)));
    a.iter().zip(b).flat_map(off).map(|off| off * off).sum::<f64>() / (3 * a.len()) as f64
}

/// An eye that backs off at 3 m/s while the fire burns, at 60 frames a second: particles that go change the picture by
/// less than those that fly. So no frame differs from the one before by much more than it would with all of them.
#[test]
fn nothing_pops_as_the_eye_backs_off() {
    /// How much larger the change may be: fewer and brighter flames are rougher, by the root of 2000 over their number.
    const MORE: f64 = 1.25;
    let mut renderer = Renderer::new(2).expect("threads can be started");
    let mut last: Option<[Vec<u32>; 2]> = None;
    let mut worst = 0f64;
    for frame in 0..180 {
        let time = f64::from(frame) / 60.0;
        let (fire, view) = torch(2.5 + 3.0 * time as f32);
        let fire = Fire { time: fire.time + time, ..fire };
        let less = fire.detailed(&view, DETAIL);
        let frames = [fire, less].map(|fire| draw(&mut renderer, fire, &view));
        if let Some(last) = last {
            let [all, fewer] = [0, 1].map(|k| change(&last[k], &frames[k]).sqrt());
            worst = worst.max(fewer / all / f64::from((fire.count / less.count).sqrt()));
        }
        last = Some(frames);
    }
    println!("a frame's change over that with all particles and the root: at most {worst:.2}");
    assert!((0.5..MORE).contains(&worst), "{worst}");
}

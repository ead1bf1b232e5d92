//! Depth maps under a sun just above the horizon, against what stands between a point and the sun, in f64: how much light
//! level ground keeps, and what leaks behind a thin wall and under a beam.
//!
//! Bias by slope ends at a tangent of 4. Lit ground lost a third of its light under a sun at 1 degree, and some
//! hundredths at 5. A slope without an end would keep that light, and open gaps of three texels of the map behind
//! whatever stands on the ground: at 1 degree that is 170 texels of the ground.

use glam::{DVec3, Vec3A, dvec3, vec3a};
use paprsek::raster::{Bias, Light, Projection, ShadowViews, World};
use paprsek::settings::Quality;
use paprsek::view::Camera;
use testkit::drawn::{block, body, dark, draw, enters, ground, ray};

const SIZE: [usize; 2] = [240, 160];
const ELEVATIONS: [f64; 9] = [0.5, 1.0, 2.0, 3.0, 5.0, 8.0, 12.0, 20.0, 30.0];
/// Width of the map, metres: the sun of the show has maps with such texels.
const WIDTH: f32 = 44.0;
/// The bias of the show's sun.
const BIAS: Bias = Bias { constant: 0.02, slope: 3.0, normal: 0.5 };

/// Percent of the light that may leak far from any edge where light grazes: none.
const FAR: f64 = 1e-3;
/// Percent of the light that may leak around edges: bias is 12 texels deep at the most, which under a sun at 8 degrees are
/// 1.7 texels of the map.
const NEAR: f64 = 13.0;
/// The same under a higher sun, where the same depth is more of a shorter shadow.
const GAP: f64 = 20.0;

/// Direction to a sun, oblique to the rows of the map and to the wall.
fn sun(elevation: f64) -> DVec3 {
    let (sin, cos) = elevation.to_radians().sin_cos();
    dvec3(cos * 0.6, sin, cos * 0.8)
}

/// Points of level ground with the share of the sun's light there, among boxes that cast shadows.
fn floor(elevation: f64, texels: u32, boxes: &[(Vec3A, Vec3A)]) -> Vec<(DVec3, f64)> {
    let towards = sun(elevation).as_vec3a().normalize();
    let view = Projection::parallel(towards, Vec3A::ZERO, WIDTH, texels);
    let light = Light::sun(towards, Vec3A::ONE).with_shadow(ShadowViews::new(vec![view], BIAS));
    let mut bodies = vec![body(ground(18.0, 0.0, 6))];
    bodies.extend(boxes.iter().map(|&(low, high)| body(block(low, high))));
    let camera = Camera::look_at(vec3a(0.0, 24.0, -2.0), Vec3A::ZERO, 0.9, 0.0);
    let planes =
        draw(&World { lights: vec![light], ..dark(bodies) }, camera, SIZE, Quality::FAST, testkit::levels()[0].1);
    let point = |pixel: usize| {
        let d = ray(&camera, SIZE, (pixel % SIZE[0]) as f64 + 0.5, (pixel / SIZE[0]) as f64 + 0.5);
        let p = camera.eye.as_dvec3() - d * (camera.eye.y as f64 / d.y);
        let seen = boxes.iter().all(|&b| enters(camera.eye.as_dvec3(), d, b).is_none());
        (seen && p.abs().max_element() < 17.9).then(|| (p, planes.color[pixel].x as f64 / towards.y as f64))
    };
    (0..planes.color.len()).filter_map(point).collect()
}

#[test]
fn lit_ground_keeps_its_light() {
    let mut failed = Vec::new();
    for texels in [256, 1024, 2048] {
        for elevation in ELEVATIONS {
            let points = floor(elevation, texels, &[]);
            let kept = points.iter().map(|(_, share)| share).sum::<f64>() / points.len() as f64;
            println!("{elevation:4.1} degrees, {texels:4} texels: {:.2} % of the light kept", 100.0 * kept);
            assert!(points.len() > 20_000);
            if (kept - 1.0).abs() > 1e-4 {
                failed.push((elevation, texels, kept));
            }
        }
    }
    assert!(failed.is_empty(), "degrees, texels, share kept: {failed:?}");
}

/// A lookup at the best: the share of the ground that is lit in truth, among the places that the 3x3 texels around a point
/// of the ground show. And whether all of it is dark as far as a lookup reaches.
fn filtered(p: DVec3, towards: DVec3, texel: f64, caster: (Vec3A, Vec3A)) -> (f64, bool) {
    let side = towards.cross(DVec3::Y).normalize();
    let over = side.cross(towards);
    let lit = |x: f64, y: f64| {
        let q = p + (side * x + over * y) * texel;
        enters(q - towards * (q.y / towards.y), towards, caster).is_none()
    };
    let place = |k: i32| (k as f64 - 4.0) / 3.0;
    let share = (0..81).filter(|k| lit(place(k % 9), place(k / 9))).count() as f64 / 81.0;
    (
        share,
        !(0..16).any(|k| {
            lit(
                2.5 * (k as f64 * std::f64::consts::FRAC_PI_8).cos(),
                2.5 * (k as f64 * std::f64::consts::FRAC_PI_8).sin(),
            )
        }),
    )
}

/// Light in the shadow of a thin wall on the ground, and of a beam just above it.
#[test]
fn what_grazing_light_leaves_dark_stays_dark() {
    let wall = (vec3a(-6.0, 0.0, -0.05), vec3a(6.0, 0.6, 0.05));
    let beam = (vec3a(-6.0, 0.05, -0.3), vec3a(6.0, 0.5, 0.3));
    for (name, caster) in [("wall", wall), ("beam", beam)] {
        for texels in [1024, 2048] {
            for elevation in ELEVATIONS {
                let towards = sun(elevation).normalize();
                let (mut count, mut light, mut due, mut inner, mut leaks) = (0.0f64, 0.0, 0.0, 0.0f64, 0.0);
                for (p, share) in floor(elevation, texels, &[caster]) {
                    if enters(p, towards, caster).is_some() {
                        let (best, deep) = filtered(p, towards, (WIDTH / texels as f32) as f64, caster);
                        count += 1.0;
                        light += share;
                        due += best;
                        if deep {
                            inner += 1.0;
                            leaks += share;
                        }
                    }
                }
                let [light, due, leaks] = [light / count, due / count, leaks / inner.max(1.0)].map(|k| 100.0 * k);
                println!(
                    "{name}, {elevation:4.1} degrees, {texels} texels: {light:.2} % of the light at {count} dark points, \
                     {due:.2} % by the filter; {leaks:.3} % at {inner} far from an edge"
                );
                assert!(count > 300.0);
                // From 12 degrees on what leaks is the gap by bias, as ever.
                assert!(leaks <= if elevation < 10.0 { FAR } else { GAP }, "{name}, {elevation} degrees: {leaks} %");
                assert!(
                    light <= due + if elevation < 10.0 { NEAR } else { GAP },
                    "{name}, {elevation} degrees: {light} %"
                );
            }
        }
    }
}

//! Shadows of a lamp by a cube of depth maps against what stands between a point and the lamp, in f64.
//!
//! A point is misclassified where more than half of the light comes though it should not, or the other way round. Acne
//! (dark instead of lit) and leaks (lit instead of dark) are counted apart.

use glam::{DVec3, Vec2, Vec3A, vec3a};
use paprsek::raster::{Bias, Light, Mesh, Projection, ShadowViews, World};
use paprsek::settings::Quality;
use paprsek::view::Camera;
use testkit::drawn::{Count, block, body, dark, draw, enters, ray};

const SIZE: [usize; 2] = [220, 130];
/// Depth maps are what is tested: one sample a pixel, and shadows as the intro has them.
const QUALITY: Quality = Quality::FAST;
/// A map cannot know an edge better than its 3x3 texels reach.
const REACH: f64 = 1.5;
/// The target: misclassified points, of the receiver's visible pixels.
const SHARE: f64 = 0.01;

/// Boxes by their least and greatest corners.
type Boxes = Vec<(Vec3A, Vec3A)>;

/// A room around the origin, turned inwards.
fn room(half: Vec3A) -> Mesh {
    let mut mesh = block(-half, half);
    for face in &mut mesh.faces {
        face.corners.swap(1, 2);
    }
    mesh
}

/// A torch in a room with boxes: every pixel that is not within 1.5 texels of a true edge.
#[derive(Default, Debug)]
struct Torch {
    count: Count,
    /// Points whose direction lies within two texels of an edge, and of a corner, of the cube.
    edges: u32,
    corners: u32,
}

fn torch(texels: u32, torch: Vec3A, half: Vec3A, smooth: bool, boxes: &Boxes, cameras: &[Camera], into: &mut Torch) {
    // The bench scene's: 2.12 texels are half the diagonal of 3x3; and the room shadows itself if that is too little.
    let bias = Bias { constant: 0.02, slope: 2.12, normal: 0.0 };
    let views = (0..6).map(|face| Projection::face(face, torch, texels)).collect();
    let shadow_views = ShadowViews { smooth, ..ShadowViews::new(views, bias) };
    let lights = vec![Light::lamp(torch, Vec3A::ONE, Vec2::ZERO, f32::INFINITY).with_shadow(shadow_views)];
    let mut bodies = vec![body(room(half))];
    bodies.extend(boxes.iter().map(|b| body(block(b.0, b.1))));
    let world = World { lights, ..dark(bodies) };
    let from = torch.as_dvec3();
    let lit = |p: DVec3| !boxes.iter().any(|b| enters(p, from - p, *b).is_some_and(|(t, _)| t > 1e-9 && t < 1.0));
    for &camera in cameras {
        let planes = draw(&world, camera, SIZE, QUALITY, testkit::levels()[0].1);
        for pixel in 0..planes.color.len() {
            let d = ray(&camera, SIZE, (pixel % SIZE[0]) as f64 + 0.5, (pixel / SIZE[0]) as f64 + 0.5);
            let eye = camera.eye.as_dvec3();
            // The room's wall, and the first box before it.
            let (a, b) = ((-half.as_dvec3() - eye) / d, (half.as_dvec3() - eye) / d);
            let mut way = a.max(b).min_element();
            let mut axis = (0..3).find(|&k| a[k].max(b[k]) == way).unwrap();
            for (t, k) in boxes.iter().filter_map(|b| enters(eye, d, *b)) {
                if t < way {
                    (way, axis) = (t, k);
                }
            }
            if (planes.inv_depth[pixel] as f64 * way - 1.0).abs() > 1e-4 {
                // Another surface, on an edge.
                continue;
            }
            let p = eye + d * way;
            // The face looks at the eye.
            let normal = -DVec3::AXES[axis] * d[axis].signum();
            let q = p - from;
            let cosine = -q.normalize().dot(normal);
            let major = q.abs().max_element();
            // Slopes above 4 are not made up for.
            if cosine < 1.0 / 17f64.sqrt() {
                assert!(cosine > 0.0 || planes.color[pixel].x == 0.0, "{p}: light from behind");
                continue;
            }
            let found = planes.color[pixel].x as f64 / cosine > 0.5;
            let truth = lit(p);
            // The same point as 1.5 texels away on the cube's face, where it stands in the light's way; each a little
            // towards the light, so that its own surface is none.
            let step = REACH * 2.0 * major / texels as f64;
            let moved = |i: i32| {
                let k = [i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1].map(|k| k as f64 * step);
                let off = DVec3::from(k);
                // Across the light's major axis, on the same surface.
                let to = q + off - DVec3::select(q.abs().cmpge(DVec3::splat(major)), off, DVec3::ZERO);
                from + to * (q.dot(normal) / to.dot(normal)) * (1.0 - 1e-6)
            };
            let far = (0..27).all(|i| lit(moved(i)) == truth);
            into.count.add(truth, found, far);
            let mut sides = q.abs().to_array();
            sides.sort_by(f64::total_cmp);
            let near = |k: usize| sides[2] - sides[k] < 2.0 * 2.0 * major / texels as f64;
            into.edges += near(1) as u32;
            into.corners += (near(1) && near(0)) as u32;
        }
    }
}

#[test]
fn a_torchs_shadows_pass_the_cubes_edges_and_corners() {
    // Boxes across directions of equal components, in all octants and some of the twelve edges.
    let mut boxes: Boxes = Vec::new();
    for (k, d) in [
        vec3a(1.0, 1.0, 1.0),
        vec3a(-1.0, 1.0, -1.0),
        vec3a(1.0, -1.0, -1.0),
        vec3a(-1.0, -1.0, 1.0),
        vec3a(1.0, 0.0, -1.0),
        vec3a(-1.0, 0.0, -1.0),
        vec3a(0.0, -1.0, 1.0),
        vec3a(0.0, 1.0, -1.0),
        vec3a(1.0, -0.9, 0.2),
        vec3a(-1.0, 0.1, 0.2),
    ]
    .into_iter()
    .enumerate()
    {
        let half = vec3a(0.35, 0.3, 0.4) * (1.0 + 0.1 * k as f32);
        boxes.push((d * 1.5 - half, d * 1.5 + half));
    }
    let half = Vec3A::splat(3.5);
    let eyes = [vec3a(3.2, 3.0, 3.1), vec3a(-3.2, -3.0, 3.1), vec3a(-3.0, 3.2, -3.1), vec3a(3.2, -3.0, -3.1)];
    let cameras = eyes.map(|eye| Camera::look_at(eye, Vec3A::ZERO, 1.5, 0.0));
    for texels in [128, 512] {
        for smooth in [false, true] {
            let mut sum = Torch::default();
            for place in [Vec3A::ZERO, vec3a(0.2, 0.3, -0.1), vec3a(-0.5, 0.1, 0.4)] {
                torch(texels, place, half, smooth, &boxes, &cameras, &mut sum);
            }
            println!("{texels}, smooth: {smooth}: {:.3} %, {sum:?}", 100.0 * sum.count.share());
            assert!(
                sum.count.pixels > 50_000 && sum.count.dark > 5000 && sum.edges > 500 && sum.corners > 5,
                "{sum:?}"
            );
            assert_eq!(sum.count.far, 0, "{texels}: {sum:?}");
            // At 128 texels each is five hundredths of a metre at the walls, an eighth of a box.
            assert!(texels < 512 || sum.count.share() <= SHARE, "{sum:?}");
        }
    }
}

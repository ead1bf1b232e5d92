//! A box above level ground under a sun, by a depth map and by what stands between a point and the sun in f64.

use super::drawn::{Count, Planes, block, body, dark, draw, enters, ground, ray};
use glam::{DVec2, DVec3, Vec3A, dvec3, vec3a};
use paprsek::raster::{Bias, Light, Projection, ShadowViews, World};
use paprsek::settings::Quality;
use paprsek::view::Camera;

/// Pixels of the picture.
pub const SIZE: [usize; 2] = [220, 130];
/// Depth maps are what is tested: one sample a pixel, and shadows as the intro has them.
pub const QUALITY: Quality = Quality::FAST;
/// A map cannot know an edge better than its 3x3 texels reach.
pub const REACH: f64 = 1.5;
/// Texels along a map's border in which it is not looked up, and how far rounding may move a point there.
pub const MARGIN: f32 = 2.0;
/// Texels.
pub const NEAR: f32 = 0.01;
/// The target: misclassified points, of the receiver's visible pixels.
pub const SHARE: f64 = 0.01;

/// The distance of a point from the outline of the convex hull of others.
pub fn from_outline(points: &[DVec2], p: DVec2) -> f64 {
    // An edge of the hull has all points on one side.
    let mut least = f64::MAX;
    for &a in points {
        for &b in points {
            let along = b - a;
            let length = along.length();
            if length < 1e-9 || points.iter().any(|&q| along.perp_dot(q - a) < -1e-9 * length) {
                continue;
            }
            let k = ((p - a).dot(along) / (length * length)).clamp(0.0, 1.0);
            least = least.min(p.distance(a + along * k));
        }
    }
    least
}

/// Direction to a sun.
pub fn sun(elevation: f64, azimuth: f64) -> DVec3 {
    let (sin, cos) = elevation.to_radians().sin_cos();
    if elevation == 90.0 { DVec3::Y } else { dvec3(cos * azimuth.sin(), sin, cos * azimuth.cos()) }
}

/// A box above level ground under a sun, whose map is `width` metres wide.
pub struct Sunny {
    /// Of the sun, degrees.
    pub elevation: f64,
    /// Along an edge of the map.
    pub texels: u32,
    /// Of the map, metres.
    pub width: f32,
    /// What keeps surfaces from shadowing themselves.
    pub bias: Bias,
    /// Whether lookups are interpolated.
    pub smooth: bool,
    /// Whether the map holds what looks away from the sun.
    pub back_faces: bool,
    /// Whether shadows are traced instead.
    pub traced: bool,
}

/// The box, where the sun is not low.
pub const BOX: (Vec3A, Vec3A) = (vec3a(-1.5, 2.5, -1.0), vec3a(1.5, 4.0, 2.0));

impl Sunny {
    /// Unit direction to the sun.
    pub fn towards(&self) -> DVec3 {
        sun(self.elevation, 0.7)
    }

    /// It stands on the ground where the sun is low, and else above it: so that the shadow is seen.
    pub fn block(&self) -> (Vec3A, Vec3A) {
        (if self.elevation < 10.0 { BOX.0.with_y(0.0) } else { BOX.0 }, BOX.1)
    }

    /// Its map.
    pub fn shadow_views(&self) -> ShadowViews {
        let view = Projection::parallel(self.towards().as_vec3a(), Vec3A::ZERO, self.width, self.texels);
        let Sunny { bias, smooth, back_faces, traced, .. } = *self;
        ShadowViews { back_faces, traced, smooth, ..ShadowViews::new(vec![view], bias) }
    }

    /// The picture.
    pub fn draw(&self, camera: Camera) -> Planes {
        let (low, high) = self.block();
        let bodies = vec![body(ground(14.0, 0.0, 6)), body(block(low, high))];
        let lights = vec![Light::sun(self.towards().as_vec3a(), Vec3A::ONE).with_shadow(self.shadow_views())];
        draw(&World { lights, ..dark(bodies) }, camera, SIZE, QUALITY, super::levels()[0].1)
    }

    /// Each pixel that shows the ground: where, and the share of the sun's light there.
    pub fn receivers(&self, camera: Camera) -> Vec<(DVec3, f64)> {
        let planes = self.draw(camera);
        let point = |pixel: usize| {
            let d = ray(&camera, SIZE, (pixel % SIZE[0]) as f64 + 0.5, (pixel / SIZE[0]) as f64 + 0.5);
            let t = -camera.eye.as_dvec3().y / d.y;
            let seen = (planes.inv_depth[pixel] as f64 * t - 1.0).abs() < 1e-3;
            // Where the box stands, its sides are as far away as the ground.
            let (low, high) = self.block();
            let p = camera.eye.as_dvec3() + d * t;
            let gap = (p - p.clamp(low.as_dvec3(), high.as_dvec3())).length();
            (seen && gap > 0.02)
                .then(|| (camera.eye.as_dvec3() + d * t, planes.color[pixel].x as f64 / self.towards().y))
        };
        (0..planes.color.len()).filter_map(point).collect()
    }

    /// The points that are misclassified, and those of them that are more than `reach` texels from an edge.
    pub fn count(&self, camera: Camera, reach: f64) -> Count {
        let towards = self.towards();
        let texel = (self.width / self.texels as f32) as f64;
        let side = towards.any_orthonormal_vector();
        let over = towards.cross(side);
        let flat = |p: DVec3| DVec2::new(p.dot(side), p.dot(over));
        let (low, high) = self.block();
        let corners: Vec<DVec2> = (0..8)
            .map(|i| flat(Vec3A::select(glam::BVec3A::new(i & 1 != 0, i & 2 != 0, i & 4 != 0), low, high).as_dvec3()))
            .collect();
        let mut count = Count::default();
        for (p, share) in self.receivers(camera) {
            let lit = enters(p, towards, (low, high)).is_none();
            let far = from_outline(&corners, flat(p)) > reach * texel;
            count.add(lit, share > 0.5, far);
        }
        count
    }
}

/// From above and from the side.
pub fn cameras() -> [Camera; 2] {
    let look = |eye: Vec3A| Camera::look_at(eye, vec3a(0.0, 0.0, 0.5), 0.9, 0.0);
    [look(vec3a(3.0, 16.0, 9.0)), look(vec3a(-9.0, 5.0, 7.0))]
}

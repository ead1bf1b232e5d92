//! From points in space to the pixels of a picture or of a depth map.

use crate::view::View;
use glam::{Affine3A, Mat4, Vec3, Vec4};

/// A projection onto a raster, in homogeneous pixels from its top left corner.
///
/// Nearness is affine on planes as they appear in the raster, and more of it hides less: 1 / distance along the axis in
/// perspective, height towards the light in a parallel projection. So nothing has a far plane, and in floating point the
/// far is as precise as the near (reversed depth).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    /// Of a point p, their inner products with (p, 1) are x w, y w, nearness w, w.
    pub rows: [Vec4; 4],
    /// Pixels in a row, and rows: at most 16,384 each.
    pub size: [u32; 2],
    /// Metres a pixel in the middle, where w is 1.
    pub texel: f32,
}

/// Least w that is drawn: the distance from the eye at which solids begin, metres.
pub const NEAR: f32 = 0.05;

impl Projection {
    /// What a camera sees.
    pub fn of_view(view: &View, size: [u32; 2]) -> Projection {
        let camera = view.camera();
        let (middle, pixels) = view.screen();
        let depth = row(camera.forward, camera.eye);
        Projection::new([camera.right, camera.up], camera.eye, [Vec4::W, depth], pixels, middle, size)
    }

    /// A parallel projection of `size` x `size` pixels, `width` metres wide, around `middle`, along -`towards` (unit).
    ///
    /// Nearness is metres towards the light. The rows' direction is level, as far as there is one.
    pub fn parallel(towards: Vec3, middle: Vec3, width: f32, size: u32) -> Projection {
        Projection::square(towards, middle, [row(towards, middle), Vec4::W], size as f32 / width, size)
    }

    /// Face `index` of the cube around `eye`, in the order +x -x +y -y +z -z; 90 degrees wide.
    pub fn face(index: usize, eye: Vec3, size: u32) -> Projection {
        let look = Vec3::AXES[index / 2] * if index.is_multiple_of(2) { 1.0 } else { -1.0 };
        Projection::square(-look, eye, [Vec4::W, row(look, eye)], 0.5 * size as f32, size)
    }

    /// The rows of nearness and w are `depth`; of `pixels` a metre, where w is 1.
    fn square(towards: Vec3, origin: Vec3, depth: [Vec4; 2], pixels: f32, size: u32) -> Projection {
        let right = Vec3::Y.cross(towards).try_normalize().unwrap_or(Vec3::X);
        let half = 0.5 * size as f32;
        Projection::new([right, towards.cross(right)], origin, depth, pixels, (half, half), [size; 2])
    }

    /// The same with those directions to the right and up, `origin` in the `middle`.
    fn new(
        [right, up]: [Vec3; 2],
        origin: Vec3,
        [inv_depth, w]: [Vec4; 2],
        pixels: f32,
        middle: (f32, f32),
        size: [u32; 2],
    ) -> Projection {
        let x = row(right, origin) * pixels + w * middle.0;
        let y = row(up, origin) * -pixels + w * middle.1;
        Projection { rows: [x, y, inv_depth, w], size, texel: 1.0 / pixels }
    }

    /// The matrix that takes points to homogeneous pixels.
    pub fn matrix(&self) -> Mat4 {
        let [x, y, inv_depth, w] = self.rows;
        Mat4::from_cols(x, y, inv_depth, w).transpose()
    }

    /// The same for points of a body that is placed in the world.
    pub fn of_body(&self, place: &Affine3A) -> Mat4 {
        self.matrix() * *place
    }

    /// Is a ball certainly not in the picture?
    pub fn misses(&self, center: Vec3, radius: f32) -> bool {
        let [x, y, _, w] = self.rows;
        let [width, height] = self.size.map(|n| n as f32);
        [x, w * width - x, y, w * height - y, w - Vec4::W * NEAR]
            .into_iter()
            .any(|plane| plane.dot(center.extend(1.0)) < -radius * plane.truncate().length())
    }
}

/// The affine function that is 0 at `origin` and grows along `direction`.
fn row(direction: Vec3, origin: Vec3) -> Vec4 {
    direction.extend(-direction.dot(origin))
}

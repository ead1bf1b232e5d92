//! From points in space to the pixels of a picture or of a depth map.

use crate::view::View;
use glam::{Affine3A, Mat4, Vec3, Vec4};

/// A projection onto a raster, in homogeneous pixels from its top left corner.
///
/// Of a point p, `matrix * (p, 1)` is (x w, y w, nearness w, w). Nearness is affine on planes as they appear in the
/// raster, and more of it hides less: 1 / distance along the axis in perspective, height towards the light in a parallel
/// projection. So nothing has a far plane, and in floating point the far is as precise as the near (reversed depth).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    /// Columns as `glam` has them.
    pub matrix: Mat4,
    /// Pixels in a row, and rows: at most 16,384 each.
    pub size: [u32; 2],
    /// Least w that is drawn.
    pub near: f32,
}

/// Distance from the eye at which solids begin, metres.
pub const NEAR: f32 = 0.05;

impl Projection {
    /// What a camera sees.
    pub fn of_view(view: &View, size: [u32; 2]) -> Projection {
        let camera = view.camera();
        let (middle, pixels) = view.screen();
        let depth = row(camera.forward, camera.eye);
        let x = row(camera.right, camera.eye) * pixels + depth * middle.0;
        let y = row(camera.up, camera.eye) * -pixels + depth * middle.1;
        Projection { matrix: Mat4::from_cols(x, y, Vec4::W, depth).transpose(), size, near: NEAR }
    }

    /// A parallel projection of `size` x `size` pixels, `width` metres wide, around `middle`, along -`towards` (unit).
    ///
    /// Nearness is metres towards the light. The rows' direction is level, as far as there is one.
    pub fn parallel(towards: Vec3, middle: Vec3, width: f32, size: u32) -> Projection {
        let right = Vec3::Y.cross(towards).try_normalize().unwrap_or(Vec3::X);
        let up = towards.cross(right);
        let scale = size as f32 / width;
        let half = Vec4::W * (0.5 * size as f32);
        let x = row(right, middle) * scale + half;
        let y = row(up, middle) * -scale + half;
        let matrix = Mat4::from_cols(x, y, row(towards, middle), Vec4::W).transpose();
        Projection { matrix, size: [size; 2], near: NEAR }
    }

    /// Face `index` of the cube around `eye`, in the order +x -x +y -y +z -z; 90 degrees wide.
    pub fn face(index: usize, eye: Vec3, size: u32) -> Projection {
        let sign = if index.is_multiple_of(2) { 1.0 } else { -1.0 };
        let look = Vec3::AXES[index / 2] * sign;
        let up = if index / 2 == 1 { Vec3::NEG_Z * sign } else { Vec3::Y };
        let half = 0.5 * size as f32;
        let depth = row(look, eye);
        let x = (row(look.cross(up), eye) + depth) * half;
        let y = (depth - row(up, eye)) * half;
        Projection { matrix: Mat4::from_cols(x, y, Vec4::W, depth).transpose(), size: [size; 2], near: NEAR }
    }

    /// The same for points of a body that is placed in the world.
    pub fn of_body(&self, place: &Affine3A) -> Mat4 {
        self.matrix * *place
    }

    /// Is a ball certainly not in the picture?
    pub fn misses(&self, center: Vec3, radius: f32) -> bool {
        let rows = self.matrix.transpose();
        let [width, height] = self.size;
        let (x, y, w) = (rows.x_axis, rows.y_axis, rows.w_axis);
        let near = w - Vec4::W * self.near;
        [x, w * width as f32 - x, y, w * height as f32 - y, near]
            .into_iter()
            .any(|plane| plane.dot(center.extend(1.0)) < -radius * plane.truncate().length())
    }
}

/// The affine function that is 0 at `origin` and grows along `direction`.
fn row(direction: Vec3, origin: Vec3) -> Vec4 {
    direction.extend(-direction.dot(origin))
}

//! From points in space to the pixels of a picture or of a shadow map.

use crate::frame::Tile;
use crate::vector::cross;
use crate::view::View;
use glam::{Affine3A, Mat4, Vec3A, Vec4};

/// A projection onto a raster, in homogeneous pixels from its top left corner.
///
/// The depth of a raster is called `inv_depth` throughout, and larger is nearer: 1 / distance along the axis in
/// perspective, and metres towards the light in a parallel projection. Either is affine over the raster on a plane in
/// space, so it is interpolated without a division. Nothing needs a far plane, and in floating point far surfaces are
/// told apart as well as near ones (reversed depth).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    /// Inner products of a point (p, 1) with the four rows are `x w`, `y w`, `inv_depth w` and `w`, with x and y in
    /// pixels to the right and down.
    pub rows: [Vec4; 4],
    /// Width and height of the raster, pixels: at most 16,384 each.
    pub size: [u32; 2],
    /// Size of a pixel in space where w is 1, in the middle of the raster: metres.
    pub texel: f32,
}

/// The near plane, metres from the eye along its axis: solids before it are clipped.
pub const NEAR: f32 = 0.05;

impl Projection {
    /// What a view's camera sees, on the pixels of the view.
    pub fn of_view(view: &View) -> Projection {
        let camera = view.camera();
        let (middle, pixels) = view.screen();
        let depth = row(camera.forward, camera.eye);
        let size = [view.width() as u32, view.height() as u32];
        Projection::new([camera.right, camera.up], camera.eye, [Vec4::W, depth], pixels, middle, size)
    }

    /// A parallel projection of `size` x `size` pixels and `width` metres around the point `middle`, as seen from the
    /// direction `towards` (unit).
    ///
    /// Its `inv_depth` is metres from `middle` towards the light. Rows of pixels are level, whatever the direction; seen
    /// straight from above or below they run along x.
    pub fn parallel(towards: Vec3A, middle: Vec3A, width: f32, size: u32) -> Projection {
        Projection::square(towards, middle, [row(towards, middle), Vec4::W], size as f32 / width, size)
    }

    /// Face `index` of the cube around `eye`, 90 degrees wide, on `size` x `size` pixels. The order of faces is +x, -x,
    /// +y, -y, +z, -z.
    pub fn face(index: usize, eye: Vec3A, size: u32) -> Projection {
        let look = Vec3A::AXES[index / 2] * if index.is_multiple_of(2) { 1.0 } else { -1.0 };
        Projection::square(-look, eye, [Vec4::W, row(look, eye)], 0.5 * size as f32, size)
    }

    /// A square raster seen from the direction `towards`, with `origin` in its middle and `pixels` per metre where w is
    /// 1. `depth` holds the rows of `inv_depth` and w.
    fn square(towards: Vec3A, origin: Vec3A, depth: [Vec4; 2], pixels: f32, size: u32) -> Projection {
        let right = cross(Vec3A::Y, towards).try_normalize().unwrap_or(Vec3A::X);
        let half = 0.5 * size as f32;
        Projection::new([right, cross(towards, right)], origin, depth, pixels, (half, half), [size; 2])
    }

    /// The general case: any directions to the right and up, and `origin` at the pixel `middle`.
    fn new(
        [right, up]: [Vec3A; 2],
        origin: Vec3A,
        [inv_depth, w]: [Vec4; 2],
        pixels: f32,
        middle: (f32, f32),
        size: [u32; 2],
    ) -> Projection {
        let x = row(right, origin) * pixels + w * middle.0;
        let y = row(up, origin) * -pixels + w * middle.1;
        Projection { rows: [x, y, inv_depth, w], size, texel: 1.0 / pixels }
    }

    /// The matrix from points in space to homogeneous pixels.
    pub fn matrix(&self) -> Mat4 {
        let [x, y, inv_depth, w] = self.rows;
        Mat4::from_cols(x, y, inv_depth, w).transpose()
    }

    /// The matrix from points of a body placed in the world by `place` to homogeneous pixels.
    pub fn of_body(&self, place: &Affine3A) -> Mat4 {
        self.matrix() * *place
    }

    /// Whether a sphere certainly lies outside of the raster or before the near plane. False for a NaN.
    pub fn misses(&self, center: Vec3A, radius: f32) -> bool {
        let [x, y, _, w] = self.rows;
        let [width, height] = self.size.map(|n| n as f32);
        [x, w * width - x, y, w * height - y, w - Vec4::W * NEAR]
            .into_iter()
            .any(|plane| plane.dot(center.extend(1.0)) < -radius * plane.truncate().length())
    }

    /// Metres along the axis of the view, towards the eye or the light: the larger, the nearer a point.
    pub fn nearness(&self, point: Vec3A) -> f32 {
        // One of the two is 1 everywhere.
        let [_, _, inv_depth, w] = self.rows;
        (inv_depth - w).dot(point.extend(1.0))
    }

    /// First and last column, first and last row of the tiles that a sphere may touch. In perspective they are all.
    pub fn tiles(&self, center: Vec3A, radius: f32) -> [f32; 4] {
        let [x, y, _, w] = self.rows;
        if w != Vec4::W {
            return [f32::NEG_INFINITY, f32::INFINITY, f32::NEG_INFINITY, f32::INFINITY];
        }
        // A pixel more, since corners are snapped.
        let reach = radius / self.texel + 1.0;
        let tile = |pixel: f32| (pixel * (1.0 / Tile::SIZE as f32)).floor();
        let [x, y] = [x, y].map(|row| row.dot(center.extend(1.0)));
        [tile(x - reach), tile(x + reach), tile(y - reach), tile(y + reach)]
    }
}

/// The affine function that is 0 at `origin` and grows by 1 per metre along a unit `direction`.
fn row(direction: Vec3A, origin: Vec3A) -> Vec4 {
    direction.extend(-direction.dot(origin))
}

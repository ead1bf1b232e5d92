//! A sprite: what a particle is on the screen.

/// The plane of the share of the light behind that passes, among the planes that sprites are drawn into.
pub const PASSES: usize = 0;
/// The first of the three planes of light that is added.
pub const LIGHT: usize = 1;
/// Planes in all.
pub const PLANES: usize = 4;

/// An ellipse on the screen, in pixels from the picture's top left corner.
///
/// Its weight at a point is `(1 - q)^2`, where q is the square of the point's distance from the middle in a space in
/// which the ellipse is the unit disc. That is close to a Gaussian, ends at a border and needs two products.
///
/// With 16 numbers it is one line of memory: they are copied as they are drawn.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Sprite {
    /// The middle.
    pub at: [f32; 2],
    /// From pixels beside the middle to the unit disc: the rows of a matrix.
    pub axes: [f32; 4],
    /// Half of the width and of the height of its bounding box.
    pub reach: [f32; 2],
    /// Distance along the view axis, metres.
    pub depth: f32,
    /// 1 over the metres in front of a solid within which it fades: its radius.
    pub edge: f32,
    /// Share of the light behind that it takes where its weight is 1.
    pub alpha: f32,
    /// What it adds to each plane where its weight is 1: nothing to [`PASSES`], and premultiplied light.
    pub ink: [f32; PLANES],
    /// Its radius in pixels as far as it is in focus, by which it is drawn as a crystal; 0 where it is not.
    pub crystal: f32,
}

impl Sprite {
    /// A sprite of its numbers in the order of the fields.
    pub fn of(
        [x, y, a, b, c, d, across, down, depth, edge, alpha, none, red, green, blue, crystal]: [f32; 16],
    ) -> Sprite {
        Sprite {
            at: [x, y],
            axes: [a, b, c, d],
            reach: [across, down],
            depth,
            edge,
            alpha,
            ink: [none, red, green, blue],
            crystal,
        }
    }

    /// Whether the middle of a pixel lies in the ellipse.
    #[cfg(feature = "full")]
    pub fn covers(&self, x: usize, y: usize) -> bool {
        let (dx, dy) = (x as f32 + 0.5 - self.at[0], y as f32 + 0.5 - self.at[1]);
        let [a, b, c, d] = self.axes;
        (a * dx + b * dy).powi(2) + (c * dx + d * dy).powi(2) < 1.0
    }
}

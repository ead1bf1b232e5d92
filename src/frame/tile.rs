//! How a frame is cut into tiles.

/// A piece of the picture that stays in the first levels of the cache: linear light, and what lies in front of what.
///
/// All planes have rows of [`Tile::SIZE`] pixels, whatever the width.
pub struct Tile {
    /// Left edge in the picture, pixels.
    pub x: usize,
    /// Top edge in the picture, pixels.
    pub y: usize,
    /// Pixels in use in a row.
    pub width: usize,
    /// Rows in use.
    pub height: usize,
    /// Linear red.
    pub red: Box<[f32; Tile::AREA]>,
    /// Linear green.
    pub green: Box<[f32; Tile::AREA]>,
    /// Linear blue.
    pub blue: Box<[f32; Tile::AREA]>,
    /// 1 / distance along the view axis of the nearest solid, 0 for none: affine on planes, and empty space needs no infinity.
    pub inv_depth: Box<[f32; Tile::AREA]>,
    /// Share of the pixel that solids cover.
    pub coverage: Box<[f32; Tile::AREA]>,
    /// Will a later layer read `inv_depth` and `coverage`? Else they are not written.
    pub solids_matter: bool,
}

impl Tile {
    /// Pixels along an edge.
    pub const SIZE: usize = 64;
    /// Pixels.
    pub const AREA: usize = Tile::SIZE * Tile::SIZE;

    /// The tile of a picture of `width` x `height` pixels in that column and row of tiles.
    pub fn at(column: usize, row: usize, width: usize, height: usize) -> Tile {
        let mut tile = Tile::new();
        tile.place(column, row, width, height);
        tile
    }

    /// Moves the tile over the picture.
    pub(super) fn place(&mut self, column: usize, row: usize, width: usize, height: usize) {
        (self.x, self.y) = (column * Tile::SIZE, row * Tile::SIZE);
        self.width = Tile::SIZE.min(width - self.x);
        self.height = Tile::SIZE.min(height - self.y);
    }

    pub(super) fn new() -> Tile {
        let plane = || Box::new([0.0; Tile::AREA]);
        let (red, green, blue, inv_depth, coverage) = (plane(), plane(), plane(), plane(), plane());
        Tile { x: 0, y: 0, width: 0, height: 0, red, green, blue, inv_depth, coverage, solids_matter: true }
    }

    /// Black and empty.
    pub fn clear(&mut self) {
        for plane in [&mut self.red, &mut self.green, &mut self.blue] {
            plane.fill(0.0);
        }
        if self.solids_matter {
            self.inv_depth.fill(0.0);
            self.coverage.fill(0.0);
        }
    }
}

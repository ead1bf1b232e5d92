//! Tiles: 64 x 64 pixels of linear light, small enough to stay in the first levels of the cache while layer after layer
//! draws into them.

/// A square of the picture: linear light, and where its solids are.
///
/// Every plane has rows of [`Tile::SIZE`] pixels, also where fewer are in use.
pub struct Tile {
    /// Left edge in the picture, pixels.
    pub x: usize,
    /// Top edge in the picture, pixels.
    pub y: usize,
    /// Pixels in use per row.
    pub width: usize,
    /// Rows in use.
    pub height: usize,
    /// Linear red.
    pub red: Box<[f32; Tile::AREA]>,
    /// Linear green.
    pub green: Box<[f32; Tile::AREA]>,
    /// Linear blue.
    pub blue: Box<[f32; Tile::AREA]>,
    /// 1 / distance along the view axis of the nearest solid, 1/metres; 0 where there is none. The inverse is affine on
    /// planes, and empty space needs no infinity.
    pub inv_depth: Box<[f32; Tile::AREA]>,
    /// Share of the pixel that solids cover, 0 to 1.
    pub coverage: Box<[f32; Tile::AREA]>,
    /// 1 / distance along the view axis from which on solids need not be drawn, as a later layer hides them, 1/metres; 0
    /// for none. A layer that foresees what it hides writes it.
    pub hidden: Box<[f32; Tile::AREA]>,
    /// What a layer leaves for itself when it foresees what it hides; empty otherwise.
    pub foreseen: Vec<f32>,
    /// Whether a later layer may read `inv_depth` and `coverage`. Where none does they need not be written.
    pub solids_matter: bool,
    /// Octaves of noise that textures have evaluated for each pixel, where these are counted; empty otherwise.
    #[cfg(feature = "full")]
    pub octaves: Vec<f32>,
}

impl Tile {
    /// Pixels along an edge of a tile.
    pub const SIZE: usize = 64;
    /// Pixels of a tile.
    pub const AREA: usize = Tile::SIZE * Tile::SIZE;

    /// The tile in a column and row of tiles, of a picture of `width` x `height` pixels.
    pub fn at(column: usize, row: usize, width: usize, height: usize) -> Tile {
        let mut tile = Tile::new();
        tile.place(column, row, width, height);
        tile
    }

    /// Moves the tile to another column and row.
    pub(super) fn place(&mut self, column: usize, row: usize, width: usize, height: usize) {
        (self.x, self.y) = (column * Tile::SIZE, row * Tile::SIZE);
        self.width = Tile::SIZE.min(width - self.x);
        self.height = Tile::SIZE.min(height - self.y);
    }

    pub(super) fn new() -> Tile {
        let plane = || Box::new([0.0; Tile::AREA]);
        let (red, green, blue, inv_depth, coverage) = (plane(), plane(), plane(), plane(), plane());
        let (hidden, foreseen) = (plane(), Vec::new());
        let (x, y, width, height, solids_matter) = (0, 0, 0, 0, true);
        Tile {
            x,
            y,
            width,
            height,
            red,
            green,
            blue,
            inv_depth,
            coverage,
            hidden,
            foreseen,
            solids_matter,
            #[cfg(feature = "full")]
            octaves: Vec::new(),
        }
    }

    /// An empty tile in the same place, in which as much is hidden: for a layer that draws once more to be watched.
    #[cfg(feature = "full")]
    pub fn again(&self) -> Tile {
        let mut tile = Tile::new();
        (tile.x, tile.y, tile.width, tile.height) = (self.x, self.y, self.width, self.height);
        tile.hidden = self.hidden.clone();
        tile
    }

    /// Makes the tile black and empty.
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

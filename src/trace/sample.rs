//! What one eye ray saw: what a corner of the grid remembers.

/// Textured hits that a sample can remember; later ones (the deepest, of least weight) are looked up on the spot.
pub const REMEMBERED: usize = 4;
/// Numbers of a sample before those of its textured hits.
pub const PLAIN: usize = 4;
/// Numbers of a textured hit.
pub const HIT: usize = 7;
/// Numbers of a sample.
pub const NUMBERS: usize = PLAIN + HIT * REMEMBERED;

/// What one eye ray saw: a chain to be compared, and numbers to be interpolated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Hash of the whole chain: every object hit, by which path, and the state of every light there.
    pub path_signature: u32,
    /// Textured hits that count.
    pub count: u32,
    /// The object of each textured hit.
    pub object: [u32; REMEMBERED],
    /// Linear light that depends on no texture (highlights, plain surfaces, sky), then the closeness of the first hit,
    /// 1 / distance in steps of the unnormalised eye ray or 0 where there is none.
    ///
    /// Then for each textured hit: its gain, the light that would reach the eye from there off a white surface (3);
    /// the hit point times its closeness (3); and its closeness, 1 / length of the path from the eye in those steps.
    /// In this homogeneous form a point on a plane is affine in screen space, exactly, also seen in flat mirrors.
    pub numbers: [f32; NUMBERS],
}

impl Default for Sample {
    fn default() -> Sample {
        Sample { path_signature: 0, count: 0, object: [0; REMEMBERED], numbers: [0.0; NUMBERS] }
    }
}

impl Sample {
    /// 1 / distance of the first hit along the view axis, 0 for the sky.
    pub fn inv_depth(&self) -> f32 {
        self.numbers[3]
    }

    /// The textured hits: the object, and the numbers of each.
    #[inline(always)]
    pub fn hits(&self) -> impl Iterator<Item = (u32, &[f32; HIT])> {
        let (hits, _) = self.numbers[PLAIN..].as_chunks::<HIT>();
        self.object.iter().copied().zip(hits).take(self.count as usize)
    }

    /// How many of the numbers are in use.
    pub fn used(&self) -> usize {
        PLAIN + HIT * self.count as usize
    }
}

// They come in full lanes of any width.
const _: () = assert!(NUMBERS.is_multiple_of(16));

//! From linear light to the 8-bit pixels of a screen.

/// How linear light becomes an 8-bit code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Transfer {
    /// `round(255 c^(1/2.2))`, no dither: what the bench scenes specify.
    Gamma22,
    /// The piecewise sRGB curve with an unbiased dither.
    Srgb,
}

//! What the 64 kB build leaves out: one constant per cut, false in that build.
//!
//! A cut is asked for as a constant, so that both builds are checked by the compiler and the code behind it vanishes.
//! What each of them saves is the packed size with that constant alone true, less 64,607 bytes. Some ten bytes are the
//! packing's noise.

/// Whether everything is built: single scenes, the benchmark, qualities without shortcuts. The feature `full`.
pub const FULL: bool = cfg!(feature = "full");

/// Whether scenes can be timed by the benchmark of the command line. Saves 53 bytes.
pub const BENCH: bool = FULL;

/// Whether scenes have names, so that the parts of the show can be played alone. Saves 1,945 bytes.
pub const SCENES: bool = FULL;

/// Whether two eyes can be rendered side by side. Saves 124 bytes.
pub const STEREO: bool = FULL;

/// Whether there are qualities beside fast and default, such as one that has a grid of samples per pixel.
/// Saves 439 bytes.
pub const QUALITIES: bool = FULL;

/// Whether scenes can be changed by their parameters. Saves 1,537 bytes.
pub const PARAMETERS: bool = FULL;

/// Whether imposters can stand for clouds. Saves 3,245 bytes.
pub const IMPOSTERS: bool = FULL;

/// Whether particles can be drawn as streaks along their way, as rain is. Saves 96 bytes.
pub const STREAKS: bool = FULL;

/// Whether the rasterizer can trace shadows through triangles instead of looking them up in maps. Saves 332 bytes.
pub const TRACED_SHADOWS: bool = FULL;

/// Whether lights can have a bias of their own against shadowing what they light. Those of the show have one.
pub const BIAS: bool = FULL;

/// Whether a lookup of a shadow map can count 3x3 texels alike, as the bench scenes specify, instead of weighting them.
/// Saves 105 bytes.
pub const COUNTED_TEXELS: bool = FULL;

/// Whether the rasterizer can leave light as it is, without the film's compression. Saves nothing (-4 bytes).
pub const LIGHT_WITHOUT_FILM: bool = FULL;

/// Whether the rasterizer can fill what solids leave open with a colour. Saves 64 bytes.
pub const BACKGROUND: bool = FULL;

/// Whether lights of the ray tracer can have a radius. What the show has of it has hard shadows. Saves 288 bytes.
pub const SOFT_LIGHTS: bool = FULL;

/// Whether pictures can be encoded by another curve than sRGB's. Saves nothing any more (-15 bytes).
pub const TRANSFERS: bool = FULL;

/// Whether the ray tracer's worlds can have more than 64 bodies, which it then finds in groups. The show has some tens.
/// Saves 1,834 bytes.
pub const MANY_BODIES: bool = FULL;

/// Whether blocks and cylinders of the ray tracer can stand askew. Those of the show stand upright, along the axes.
/// Saves 289 bytes.
pub const ASKEW: bool = FULL;

/// Whether textures can be checkers: the show has none. Saves 51 bytes.
pub const CHECKER: bool = FULL;

/// Whether the command line has the options beyond playing and capturing, and `--help` names them. Saves 5 bytes, since
/// most of them hang on a constant above.
pub const ALL_OPTIONS: bool = FULL;

//! What a light is to see so that it casts shadows: the views of its shadow maps, and the bias of lookups.

use super::project::Projection;

/// How a lookup keeps a lit surface from shadowing itself. All three parts add up.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bias {
    /// Offset towards the light, metres.
    pub constant: f32,
    /// Offset towards the light for a surface at 45 degrees to it, texels. In proportion to the tangent of the angle of
    /// incidence, up to 4 times this. Beyond, a smooth lookup of a sun's shadow follows the plane of the surface instead.
    pub slope: f32,
    /// Offset along the normal for a surface that the light grazes, texels. In proportion to the sine of the angle of
    /// incidence.
    pub normal: f32,
}

impl Bias {
    /// What the lights of the show have, on texels of every size: at the knee of the curve in docs/report/shadows.md.
    pub const SHOW: Bias = Bias { constant: 0.02, slope: 2.0, normal: 0.0 };

    /// A share of the bias.
    pub fn times(self, share: f32) -> Bias {
        Bias { constant: self.constant * share, slope: self.slope * share, normal: self.normal * share }
    }
}

/// The views of a light that casts shadows.
#[derive(Clone, Debug, PartialEq)]
pub struct ShadowViews {
    /// For a sun parallel projections from the finest to the coarsest, for a lamp the six faces of a cube (see
    /// [`super::fit`]). Without views there is no shadow. All have one size: square, a multiple of 64 texels.
    pub views: Vec<Projection>,
    /// Against self-shadowing.
    pub bias: Bias,
    /// Whether maps show the faces that look away from the light, instead of those that look towards it.
    pub back_faces: bool,
    /// Whether shadows are traced, without maps: exactly, at any size of the views. These then serve to sort triangles,
    /// and a 32nd of the bias is left. The 64 kB build cannot trace.
    pub traced: bool,
    /// Index of the first body that casts shadows. Those before it, such as the land, do not.
    pub first_caster: usize,
    /// Whether a lookup weights the border of its 3x3 texels by how much of them it meets, so that shadows change
    /// evenly, and is made on the smooth surface that the normals describe. Otherwise all nine count alike, on the flat
    /// face, which the 64 kB build cannot do.
    pub smooth: bool,
}

impl ShadowViews {
    /// Smooth shadows of all bodies, from maps of the faces that look towards the light.
    #[inline(always)]
    pub fn new(views: Vec<Projection>, bias: Bias) -> ShadowViews {
        ShadowViews { views, bias, back_faces: false, traced: false, first_caster: 0, smooth: true }
    }
}

//! What is rendered: clouds, and the light that falls on them.

use super::voxels::Voxels;
use glam::Vec3A;
use std::sync::Arc;

/// A cube of voxels in the world.
#[derive(Clone)]
pub struct Cloud {
    /// Density and light. Clouds of one shape share their voxels.
    pub voxels: Arc<Voxels>,
    /// The centre of the cube, metres.
    pub centre: Vec3A,
    /// Half of the cube's edge, metres.
    pub size: f32,
    /// Extinction coefficient of the greatest density, per half of the cube's edge.
    pub extinction: f32,
}

/// The light that falls on clouds. Colours are linear light.
#[derive(Clone, Copy, Debug)]
pub struct CloudLight {
    /// Light that comes from everywhere, at the bottom of a cube and at its top. It is linear in the height between.
    pub ambient: [Vec3A; 2],
    /// Unit vector towards the sun.
    pub towards: Vec3A,
    /// The sun's light.
    pub sun: Vec3A,
    /// The phase function: a share `phase[0]` of the sun's light is scattered alike in all directions, and `phase[1]`
    /// forwards, by the sixth power of the cosine of the angle.
    pub phase: [f32; 2],
}

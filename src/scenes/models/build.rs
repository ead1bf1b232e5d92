//! Builds a mesh from bodies of rings, as a [script](crate::scenes::script) says.

use super::land;
use crate::angle;
use crate::raster::Mesh;
use crate::raster::form::Rings;
use crate::scenes::script::{Script, VARIABLES, Word, operations, variable};
use crate::simd::hash::rnd;
use glam::{Mat3A, Vec3A, vec3, vec3a};

operations! {
    /// The columns of a matrix that turns and scales the next bodies.
    turn = 40;
    /// `rotate(y, x, out)`: instead, the next bodies are turned around x and then around y, and stand `out` units away
    /// along their own z axis.
    rotate = 41;
    /// The foot of the next bodies is on the ground where they stand.
    ground = 42;
    /// `random(number)`: [`CHANCE`] becomes that random number of the model, from 0 to 1.
    random = 43;
    /// `body(x, y, z, a, b, c, index)`: a body in the paint [`PAINT`], at a place in units, scaled along its axes by
    /// tenths of a unit.
    body = 44;
    /// The last operation.
    end = 45;
}

/// The number of the paint of the next bodies.
pub const PAINT: Word = variable(0);
/// The last random number.
pub const CHANCE: Word = variable(4);
const CHANCE_AT: usize = 4;

/// The stream of random numbers that models draw from.
pub const STREAM: u32 = 5;

/// Adds to a mesh what a script builds of `bodies` on a `foot`, metres. A unit of the script is `unit` metres; random
/// numbers are those of `seed`.
#[inline(never)]
pub fn build(mesh: &mut Mesh, script: &mut Script, bodies: &[Rings], mut foot: Vec3A, unit: f32, seed: u32) {
    let (mut turn, mut out) = (Mat3A::IDENTITY, Vec3A::ZERO);
    loop {
        let operation = script.next();
        let n: &[f32; 9] = script.numbers[VARIABLES..].first_chunk().unwrap();
        match operation {
            op::turn => turn = Mat3A::from_cols_array(n),
            op::rotate => {
                turn = angle::turn_y(n[0]) * angle::turn_x(n[1]);
                out = turn.z_axis * n[2];
            }
            op::ground => foot.y = land::height(out.x, out.z),
            op::random => script.numbers[CHANCE_AT] = rnd(STREAM, seed, n[0] as u32),
            op::body => {
                let [x, y, z, a, b, c, index, ..] = *n;
                let size = turn * Mat3A::from_diagonal(vec3(a, b, c) * (0.1 * unit));
                let at = foot + (vec3a(x, y, z) + out) * unit;
                mesh.rings(&bodies[index as usize], &size, at, script.numbers[0] as u16);
            }
            _ => return,
        }
    }
}

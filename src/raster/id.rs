//! The number of a triangle among all that are set up for one raster: 32 bits, which also hold its texture, so that
//! fragments are sorted by texture without a look at the triangle.

/// A triangle: from the lowest bit on 14 bits for its number in its mesh, 14 bits for the mesh, and 4 bits for its texture
/// (or [`PLAIN`]). [`NOTHING`] is no triangle.
pub type Id = u32;
/// The [`Id`] of no triangle.
pub const NOTHING: Id = u32::MAX;
/// Bits of an [`Id`] for the number of the triangle, and for the number of the mesh.
const BITS: u32 = 14;
/// Number of meshes that can be told apart.
pub const MESHES: usize = 1 << BITS;
/// Most triangles of a mesh. The number after the last one is left to [`NOTHING`].
pub const TRIANGLES: usize = (1 << BITS) - 1;
/// The bit of an [`Id`] from which on it holds the index of a texture, or [`PLAIN`].
pub const TEXTURE: u32 = 2 * BITS;
/// Stands for the index of a texture where there is none.
pub const PLAIN: u32 = 15;

/// The [`Id`] of triangle `number` of mesh 0, with the index of its texture or [`PLAIN`].
#[inline(always)]
pub fn join(number: usize, texture: u32) -> Id {
    texture << TEXTURE | number as u32
}

/// The same triangle of another mesh, for an [`Id`] of mesh 0.
#[inline(always)]
pub fn of_mesh(mesh: usize, id: Id) -> Id {
    (mesh as u32) << BITS | id
}

/// The mesh of a triangle, and its number in that.
#[inline(always)]
pub fn parts(id: Id) -> (usize, usize) {
    ((id >> BITS) as usize & ((1 << BITS) - 1), id as usize & ((1 << BITS) - 1))
}

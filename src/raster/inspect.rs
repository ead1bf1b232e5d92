//! What the rasterizer does, made visible: how often pixels are covered, which maps are looked up, and what one pixel
//! shows and is lit by. All of it runs at the level that every machine has, for one point at a time, so that the
//! executable has it once: every level gives the same bits.

use super::context::ShadowLookup;
use super::depth_map::{DepthMap, EMPTY};
use super::id::{Id, of_mesh, parts};
use super::light::{Light, Source};
use super::lighting::{Facet, light_at, locate};
use super::rasters::Raster;
use super::triangle::{SUB, Triangle};
use super::world::World;
use crate::frame::Tile;
use crate::simd::lanes::{F, V3};
use crate::view::View;
use fearless_simd::{Level, Simd, dispatch, prelude::*};
use glam::Vec3A;

/// What a point of the picture shows.
pub struct Shown {
    /// Index of the body, and the number of the triangle among those of it that are set up.
    pub triangle: (usize, usize),
    /// Place on the surface, metres.
    pub point: Vec3A,
    /// The same on the smooth surface that the normals describe, where shadow maps are looked up.
    pub lifted: Vec3A,
    /// Unit normal.
    pub normal: Vec3A,
    /// Distance along the view axis, metres.
    pub depth: f32,
}

/// The triangles that the tile of a column and a row of tiles may show.
pub fn listed(raster: &Raster, tile: [usize; 2]) -> impl Iterator<Item = (Id, &Triangle)> {
    raster
        .meshes
        .iter()
        .enumerate()
        .flat_map(move |(number, mesh)| mesh.in_tile(tile).map(move |(id, triangle)| (of_mesh(number, id), triangle)))
}

/// The triangles that cover a point of the raster, pixels.
fn covering(raster: &Raster, x: f32, y: f32) -> impl Iterator<Item = (Id, &Triangle)> {
    let (sx, sy) = (x as f64 * SUB as f64, y as f64 * SUB as f64);
    listed(raster, [x, y].map(|n| n as usize / Tile::SIZE)).filter(move |(_, triangle)| {
        triangle.edges.iter().all(|&(a, b, c)| a as f64 * sx + b as f64 * sy + c as f64 >= 0.0)
    })
}

/// How many triangles cover a point of the raster, hidden ones too.
pub fn overdraw(raster: &Raster, x: f32, y: f32) -> usize {
    covering(raster, x, y).count()
}

/// What is visible at a point of the raster.
pub fn visible(raster: &Raster, view: &View, x: f32, y: f32) -> Option<Shown> {
    let mut nearest: Option<(f32, Id, &Triangle)> = None;
    for (id, triangle) in covering(raster, x, y) {
        let inv_depth = triangle.inv_depth(x, y);
        if nearest.is_none_or(|nearest| inv_depth > nearest.0) {
            nearest = Some((inv_depth, id, triangle));
        }
    }
    let (inv_depth, id, Triangle { anchor, at, by, bulge, .. }) = nearest?;
    let value = *at + by[0] * (x - anchor[0]) + by[1] * (y - anchor[1]);
    let (depth, normal) = (1.0 / inv_depth, Vec3A::from_vec4(value).normalize_or_zero());
    let point = view.camera().eye + view.ray(x, y) * depth;
    let (mesh, number) = parts(id);
    let triangle = (raster.bodies[mesh].0, number);
    Some(Shown { triangle, point, lifted: point + normal * *bulge, normal, depth })
}

/// The number of the view in which a light's shadow on a point is looked up, from 0; none where the light casts none
/// there.
pub fn shadow_view(light: &Light, shown: &Shown) -> Option<usize> {
    dispatch!(Level::baseline(), simd => view_in(simd, light, shown))
}

#[inline(always)]
fn view_in<S: Simd>(simd: S, light: &Light, shown: &Shown) -> Option<usize> {
    let shadow = light.shadow_views()?;
    let towards = match light.source {
        Source::Sun(direction) => direction,
        Source::Lamp { position, reach, .. } => {
            (position.distance(shown.point) <= reach).then(|| (position - shown.point).normalize_or_zero())?
        }
    };
    let cosine = F::<S>::splat(simd, shown.normal.dot(towards));
    let (point, normal) = (V3::splat(simd, shown.lifted), V3::splat(simd, shown.normal));
    let wanted = cosine.simd_gt(0.0);
    let points = locate(simd, shadow, light.source, &Facet { point, normal, cosine }, wanted);
    (points.inside.to_bitmask() & 1 == 1).then(|| points.view.as_slice()[0] as usize)
}

/// The light that a light gives to a point, clouds aside.
fn given(light: &Light, lookup: &ShadowLookup, shown: &Shown) -> Vec3A {
    dispatch!(Level::baseline(), simd => {
        let places = (V3::splat(simd, shown.point), V3::splat(simd, shown.lifted));
        let light = light_at(simd, light, lookup, places, V3::splat(simd, shown.normal));
        Vec3A::new(light.x.as_slice()[0], light.y.as_slice()[0], light.z.as_slice()[0])
    })
}

/// Tells what a point of the picture shows, and what each light gives to it.
pub fn explain(world: &World, lookups: &[ShadowLookup], shown: &Shown) -> Vec<String> {
    let ((body, triangle), p, n) = (shown.triangle, shown.point, shown.normal);
    let mut lines = vec![format!(
        "body {body}, triangle {triangle}, {:.3} m along the axis, at {:.2} {:.2} {:.2}, facing {:.2} {:.2} {:.2}",
        shown.depth, p.x, p.y, p.z, n.x, n.y, n.z
    )];
    for (number, (light, lookup)) in world.lights.iter().zip(lookups).enumerate() {
        let all = given(&Light { shadow: None, ..light.clone() }, &None, shown);
        let what = match light.source {
            Source::Sun(_) => "sun".to_owned(),
            Source::Lamp { position, .. } => format!("lamp {:.2} m away", position.distance(p)),
        };
        let most = all.max_element();
        if most <= 0.0 {
            lines.push(format!("light {number}, {what}: gives nothing here"));
            continue;
        }
        let left = given(light, lookup, shown);
        let share = left.max_element() / most * 100.0;
        let map = match shadow_view(light, shown) {
            Some(_) if light.shadow_views().is_some_and(|shadow| shadow.traced) => {
                format!("{share:.0} % of it past shadows, traced")
            }
            Some(view) => format!("{share:.0} % of it past shadows, looked up in map {view}"),
            None => "without shadows here".into(),
        };
        lines.push(format!("light {number}, {what}: {:.4} {:.4} {:.4}, {map}", left.x, left.y, left.z));
    }
    lines
}

/// The maps of a light as a picture: side by side, each over the whole height.
pub struct MapDepths<'a> {
    map: &'a DepthMap,
    /// The least and the greatest depth of each map, over a grid of its texels.
    ranges: Vec<[f32; 2]>,
}

impl MapDepths<'_> {
    /// The maps of a light with so many views; none where they are not looked up at all.
    pub fn new(lookup: &ShadowLookup, views: usize) -> Option<MapDepths<'_>> {
        let map = lookup.as_deref()?;
        // Every 32nd texel of each row and column.
        let range = |view: usize| {
            let mut range = [f32::INFINITY, f32::NEG_INFINITY];
            for (x, y) in (0..map.size).step_by(32).flat_map(|y| (0..map.size).step_by(32).map(move |x| (x, y))) {
                let depth = map.at(view, x, y);
                if depth != EMPTY {
                    range = [range[0].min(depth), range[1].max(depth)];
                }
            }
            range
        };
        Some(MapDepths { map, ranges: (0..views).map(range).collect() })
    }

    /// The depth at the share (`u`, `v`) of the picture's width and height: 0 for the farthest in that map and where
    /// there is nothing, 1 for the nearest.
    pub fn at(&self, u: f32, v: f32) -> f32 {
        let views = self.ranges.len();
        let along = u * views as f32;
        let view = (along as usize).min(views - 1);
        let texel = |share: f32| ((share * self.map.size as f32) as usize).min(self.map.size - 1);
        let depth = self.map.at(view, texel(along - view as f32), texel(v));
        let [far, near] = self.ranges[view];
        if depth == EMPTY || near <= far { 0.0 } else { ((depth - far) / (near - far)).clamp(0.0, 1.0) }
    }
}

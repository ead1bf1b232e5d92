//! What the tracer does, told by its reference: the path of one ray, and how deep paths are.

use super::reference::{Exits, Ray, background, first, fresnel, local, through, toward};
use super::world::World;
use crate::frame::Tile;
use glam::Vec3A;

/// Squares of a tile, each a column, a row and an edge in pixels, as the edge at each pixel.
pub fn squares(squares: impl Iterator<Item = (usize, usize, f32)>) -> Vec<f32> {
    let mut numbers = vec![0.0; Tile::AREA];
    for (x, y, size) in squares {
        let edge = size.ceil() as usize;
        for row in numbers.chunks_exact_mut(Tile::SIZE).skip(y).take(edge) {
            row[x..Tile::SIZE.min(x + edge)].fill(size);
        }
    }
    numbers
}

/// What a ray met.
struct Hit {
    index: usize,
    distance: f32,
    point: Vec3A,
    normal: Vec3A,
    inside: bool,
    cosine: f32,
}

/// The nearest surface along a ray.
fn meet(world: &World, ray: &Ray) -> Option<Hit> {
    let Ray { origin, direction, from } = *ray;
    let (index, distance) = first(world, origin, direction, |index| match from {
        Some((own, true)) if own == index => Exits::Far,
        Some((own, false)) if own == index => Exits::None,
        _ => Exits::Both,
    })?;
    let point = origin + direction * distance;
    let outward = world.objects[index].shape.normal_at(point);
    let inside = direction.dot(outward) > 0.0;
    let normal = if inside { -outward } else { outward };
    Some(Hit { index, distance, point, normal, inside, cosine: -direction.dot(normal) })
}

/// The rays that leave a hit, each with what it is and its weight.
fn next(world: &World, ray: &Ray, hit: &Hit) -> Vec<(&'static str, Ray, Vec3A)> {
    let Hit { index, point, normal, inside, cosine, .. } = *hit;
    let material = &world.objects[index].material;
    let direction = ray.direction + normal * (2.0 * cosine);
    let mirrored = Ray { origin: point, direction, from: Some((index, material.is_glass() && inside)) };
    if material.is_glass() {
        let eta = if inside { material.ior } else { 1.0 / material.ior };
        let Some((share, through)) = fresnel(eta, cosine) else {
            return vec![("all reflected", mirrored, Vec3A::ONE)];
        };
        let direction = ray.direction * eta + normal * (eta * cosine - through);
        let refracted = Ray { origin: point, direction, from: Some((index, !inside)) };
        return vec![
            ("reflected", mirrored, Vec3A::splat(share)),
            ("refracted", refracted, material.filter * (1.0 - share)),
        ];
    }
    let mirror = mirror(world, hit);
    if mirror.max_element() > 0.0 { vec![("mirrored", mirrored, mirror)] } else { Vec::new() }
}

/// The share of each colour that an opaque surface mirrors.
fn mirror(world: &World, hit: &Hit) -> Vec3A {
    let material = &world.objects[hit.index].material;
    let grazing = (1.0 - hit.cosine.min(1.0)).powi(5);
    material.reflectance + (Vec3A::ONE - material.reflectance) * (material.fresnel * grazing)
}

/// Rays in the longest path that begins with a ray, which is the one of that number in its path.
pub fn depth(world: &World, ray: Ray, level: u32) -> u32 {
    if level >= world.max_level {
        return level;
    }
    let Some(hit) = meet(world, &ray) else { return level };
    next(world, &ray, &hit).into_iter().map(|(_, ray, _)| depth(world, ray, level + 1)).fold(level, u32::max)
}

/// Tells the path of a ray: what it meets, which lights that sees, and what comes back, times its weight in the pixel.
pub fn trail(world: &World, (what, ray, weight): (&str, Ray, Vec3A), level: u32, lines: &mut Vec<String>) {
    let indent = "  ".repeat(level as usize - 1);
    if level > world.max_level {
        lines.push(format!("{indent}ray {level}, {what}: deeper than the scene's {} rays, black", world.max_level));
        return;
    }
    let Some(hit) = meet(world, &ray) else {
        let light = background(world, ray.direction) * weight;
        lines.push(format!("{indent}ray {level}, {what}: the background, contributes {}", triple(light)));
        return;
    };
    let body = &world.objects[hit.index];
    let shape = format!("{:?}", body.shape);
    let shape = shape.split(' ').next().unwrap_or_default();
    let (number, side) = (hit.index, if hit.inside { ", from within" } else { "" });
    lines.push(format!(
        "{indent}ray {level}, {what}: body {number}, {shape}{side}, after {:.3} m, weight {}",
        hit.distance,
        triple(weight)
    ));
    for (number, light) in world.lights.iter().enumerate() {
        lines.push(format!("{indent}  light {number}: {}", state(world, &hit, &ray, light)));
    }
    let (diffuse, shine) = local(world, hit.index, hit.point, hit.normal, ray.direction);
    let own = if body.material.is_glass() {
        shine
    } else {
        (diffuse * body.material.albedo.color(hit.point) + shine) * (Vec3A::ONE - mirror(world, &hit))
    };
    lines.push(format!("{indent}  the surface contributes {}", triple(own * weight)));
    for (what, ray, share) in next(world, &ray, &hit) {
        trail(world, (what, ray, weight * share), level + 1, lines);
    }
}

/// What a light does for a hit.
fn state(world: &World, hit: &Hit, ray: &Ray, light: &super::world::Light) -> String {
    let (aim, reach) = toward(light, hit.point);
    let cosine = hit.normal.dot(aim);
    if cosine <= 0.0 {
        return "behind the surface".into();
    }
    let seen = through(world, hit.index, hit.point, aim, reach);
    if seen == Vec3A::ZERO {
        return format!("in shadow, cosine {cosine:.3}");
    }
    let glint = (aim - hit.normal * (2.0 * cosine)).dot(ray.direction);
    let shines = glint > 0.0 && world.objects[hit.index].material.specular > 0.0;
    let glass = if seen == Vec3A::ONE { String::new() } else { format!(" {} times through glass", triple(seen)) };
    format!("lit{glass}{}, cosine {cosine:.3}", if shines { " with a highlight" } else { "" })
}

/// A colour as words.
fn triple(light: Vec3A) -> String {
    format!("{:.4} {:.4} {:.4}", light.x, light.y, light.z)
}

#[cfg(test)]
mod tests {
    use super::super::reference::radiance;
    use super::*;
    use crate::scenes::bench::spheres;

    /// What the lines say of contributions adds up to the light of the reference, which is by another function.
    #[test]
    fn contributions_add_up() {
        for (glass, textured) in [(false, true), (true, false)] {
            let world = spheres::world(2.0, textured, glass);
            let camera = spheres::camera(2.0);
            for (x, y) in [(0.0, 0.0), (0.3, -0.2), (-0.6, -0.4), (0.1, 0.5), (0.0, -0.15)] {
                let direction = (camera.forward + camera.right * x + camera.up * y).normalize();
                let ray = Ray::new(camera.eye, direction);
                let mut lines = Vec::new();
                trail(&world, ("from the eye", ray, Vec3A::ONE), 1, &mut lines);
                let told = |line: &String| line.split_once("contributes ").map(|told| told.1.to_owned());
                let mut sum = Vec3A::ZERO;
                for told in lines.iter().filter_map(told) {
                    let numbers: Vec<f32> = told.split(' ').map(|word| word.parse().unwrap()).collect();
                    sum += Vec3A::from_slice(&numbers);
                }
                let truth = radiance(&world, ray, 1);
                // Each line is rounded to four places.
                let most = 0.5e-4 * lines.len() as f32;
                assert!((sum - truth).abs().max_element() <= most + 1e-5, "{sum} {truth} {lines:#?}");
                let deepest = lines.iter().filter(|line| line.contains("ray ") && !line.contains("deeper")).count();
                assert!((1..=deepest as u32).contains(&depth(&world, ray, 1)));
            }
        }
    }
}

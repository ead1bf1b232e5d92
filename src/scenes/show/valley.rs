//! The valley that half of the show plays in: the land and what stands on it through the seasons, under the sky of a
//! time and a place.
//!
//! What scenes share is here: the date and the textures of a [`season`], the [`sky`], the [`world`] of triangles lit by
//! sun or moon, their shadow [`cascades`], the [`lamp`] in the chapel, and the picture of it all ([`show`]). Axes: x
//! east, y up, z south, metres; the chapel is at the origin.

use crate::angle;
use crate::cuts;
use crate::frame::encode::Transfer;
use crate::frame::{FrameSpec, Layer, Parameter, Picture};
use crate::raster::{Bias, Body, Haze, Light, RasterLayer, ShadowViews, World, fit};
use crate::scenes::models::{chapel, land, mustang, tree, tuft};
use crate::scenes::script::kind::{self, CLOUDS, LAYERS};
use crate::scenes::script::{
    Script, VARIABLES, Word, assign_all, operations, pattern, script, texture, variable, words,
};
use crate::simd::math::to_f32;
use crate::sky::dome::{Dome, Sky};
use crate::sky::layer::SkyLayer;
use crate::sky::place::Place;
use crate::sky::time::days;
use crate::texture::Texture;
use crate::timeline::ease;
use crate::vector::unit;
use crate::view::{Camera, View};
use glam::{Affine3A, Mat3A, Vec2, Vec3A, vec3a};
use std::f32::consts::TAU;
use std::sync::{Arc, Mutex};

/// Where the valley lies: the sun's path and the stars follow from it.
pub const LATITUDE: Parameter =
    Parameter::new("latitude", "degrees", (-90.0, 90.0), 49.75, "where the valley lies, north positive");
/// Where the valley lies: the local time of the sun follows from it.
pub const LONGITUDE: Parameter = Parameter::new(
    "longitude",
    "degrees",
    (-180.0, 180.0),
    13.38,
    "where the valley lies, east positive; clocks stay at UT + 1",
);

/// Days per hour.
pub const HOUR: f64 = 1.0 / 24.0;
/// Degrees per radian.
const DEGREES: f64 = 57.295_779_513_082_32;

// The days of the show, midnight UT.
/// In June, when the days are longest.
const SUMMER: f64 = days(2026, 6, 25);
/// In September.
const AUTUMN: f64 = days(2026, 9, 19);
/// In December, when the days are shortest.
const WINTER: f64 = days(2026, 12, 22);
/// In March.
const SPRING: f64 = days(2027, 3, 10);

/// The midnight that a scene's parameter asks for: a day of the year 2026, of which 1 is New Year's Day.
#[inline(always)]
pub fn date(spec: &FrameSpec, parameter: &Parameter) -> f64 {
    days(2026, 1, 1) + (spec.get(parameter) - 1.0)
}

operations! {
    /// The days from `SUMMER` to the season's date, in twenties.
    date = 41;
    /// The land's next texture, with the operands of `pattern`.
    texture = 42;
    /// The last operation.
    end = 43;
}

/// The number of the season.
const SEASON: Word = variable(0);
// What the colours of meadows and of leaves are multiplied by.
const MEADOW_RED: Word = variable(8);
const MEADOW_GREEN: Word = variable(9);
const MEADOW_BLUE: Word = variable(10);
const LEAF_RED: Word = variable(11);
const LEAF_GREEN: Word = variable(12);
const LEAF_BLUE: Word = variable(13);
/// The share of the land that is white with snow.
const WHITE: Word = variable(4);
// How much white is added to a colour of meadows or leaves, and what is left of the colour.
const SNOW: Word = variable(5);
const BARE: Word = variable(6);
// The same for the land from afar, and for rocks.
const FAR_SNOW: Word = variable(7);
const FAR_BARE: Word = variable(4);

/// The seasons: the date, and the textures of the land and of what stands on it, in the order of
/// [`PAINTS`](crate::scenes::models::PAINTS).
const SEASONS: &[u8] = script! {
    ..row(SUMMER, [1.0, 1.0, 1.0], [1.0, 1.0, 1.0], 0.0);
    ..row(AUTUMN, [1.39, 0.85, 1.285], [2.2, 0.8, 0.3], 0.0);
    ..row(WINTER, [6.085, 4.365, 22.285], [0.6, 0.35, 0.7], 1.0);
    ..row(SPRING, [1.045, 0.91, 0.855], [1.0, 1.1, 0.8], 0.15);
    pick(SEASON, 8.0);
    ..assign_all([MEADOW_RED, MEADOW_GREEN, MEADOW_BLUE, LEAF_RED, LEAF_GREEN, LEAF_BLUE, WHITE]);
    date();
    SNOW = (WHITE * 0.7);
    BARE = (SNOW * -1.0 + 1.0);
    FAR_SNOW = (WHITE * 0.5);
    FAR_BARE = (FAR_SNOW * -1.0 + 1.0);
    FAR_SNOW = (FAR_SNOW * 0.6);
    // 0, grass.
    ..near(-0.4, MEADOW_RED); ..near(0.0, MEADOW_GREEN); ..near(0.1, MEADOW_BLUE);
    ..near(2.4, MEADOW_RED); ..near(2.0, MEADOW_GREEN); ..near(1.9, MEADOW_BLUE);
    texture(1.8, 4.0, CLOUDS);
    // 1, the land by height, from -50 m to 1250 m: grass, woods, rock, snow.
    push(MEADOW_RED * 0.115, MEADOW_GREEN * 0.165, MEADOW_BLUE * 0.035);
    ..far(0.045); ..far(0.075); ..far(0.025);
    push(0.04 * 0.06, 3.0, LAYERS, 0.2);
    ..far(0.2); ..far(0.185); ..far(0.17);
    texture(0.8, 0.83, 0.88, 6.0);
    // 2 to 5, bark, needles, masonry, tiles: these vary the paint's own colour about 1.
    ..pattern(kind::CLOUDS, [0.3; 3], [1.7; 3], 3.0, 3.0); texture();
    ..pattern(kind::CLOUDS, [-0.8, -0.5, -0.2], [2.8, 2.5, 2.2], 1.2, 4.0); texture();
    ..pattern(kind::CLOUDS, [0.2, 0.2, 0.25], [1.8, 1.8, 1.75], 0.9, 4.0); texture();
    ..pattern(kind::LAYERS, [0.6; 3], [0.865; 3], 14.0, 5.0); texture(6.0, 1.135, 1.135, 1.135, 1.4, 1.4, 1.4, 0.0);
    // 6, leaves.
    ..near(-0.8, LEAF_RED); ..near(-0.5, LEAF_GREEN); ..near(-0.2, LEAF_BLUE);
    ..near(2.8, LEAF_RED); ..near(2.5, LEAF_GREEN); ..near(2.2, LEAF_BLUE);
    texture(2.5, 4.0, CLOUDS);
    // 7, water: waves.
    ..pattern(kind::CLOUDS, [0.0; 3], [2.0; 3], 0.2, 3.0); texture();
    end();
};

/// The texture of grass.
const GRASS: usize = 0;
/// The texture of water. Its noise passes at a metre a second along each axis, and up through the surface: so waves come
/// and go.
const WAVES: usize = 7;

/// A row of the table: a season's date in days since J2000; what the colours of meadows and of leaves are multiplied
/// by; the share of the land that is white.
const fn row(date: f64, [r, g, b]: [Word; 3], [x, y, z]: [Word; 3], white: Word) -> [Word; 8] {
    [((date - SUMMER) / 20.0) as Word, r, g, b, x, y, z, white]
}

/// A channel of the colour of meadows or leaves, with the snow on them, times a factor of the season.
const fn near(color: Word, factor: Word) -> [Word; 7] {
    words!((color * BARE + SNOW) * factor)
}

/// A channel of the colour of the land from afar, or of rocks, with the snow on them.
const fn far(color: Word) -> [Word; 5] {
    words!(color * FAR_BARE + FAR_SNOW)
}

/// The number of the first body that casts a shadow: none of the tufts before it does.
pub const FIRST_CASTER: usize = tuft::COUNT;

/// The bodies, made at the first call: tufts, the land, the woods, the lake, the chapel; last the aeroplane and its propeller,
/// which [`world`] moves.
fn bodies() -> Vec<Body> {
    static BODIES: Mutex<Vec<Body>> = Mutex::new(Vec::new());
    let mut bodies = BODIES.lock().unwrap();
    if bodies.is_empty() {
        let mut meshes = tuft::tufts();
        meshes.append(&mut land::ground());
        meshes.append(&mut tree::woods(&tree::trees()));
        meshes.extend([land::lake(), chapel::chapel()]);
        if !cfg!(without = "aeroplane") {
            meshes.extend([mustang::airframe(), mustang::propeller()]);
        }
        for mesh in meshes {
            bodies.push(Body::new(Arc::new(mesh), Affine3A::IDENTITY));
        }
    }
    bodies.clone()
}

/// The date of a season, days after that of summer, and its textures. They are numbered from summer, 0, to spring, 3.
pub fn season(number: usize) -> (f32, Vec<Texture>) {
    let mut seasons = Script::new(SEASONS, [to_f32(number), 0.0]);
    let (mut days, mut textures) = (0.0, Vec::new());
    loop {
        match seasons.next() {
            op::date => days = 20.0 * seasons.numbers[VARIABLES],
            op::texture => {
                let operands = seasons.numbers[VARIABLES..].first_chunk().unwrap();
                textures.push(texture(operands, &Mat3A::IDENTITY, Vec3A::ZERO));
            }
            _ => return (days, textures),
        }
    }
}

/// The sky over the valley at a time, in days since J2000.
#[inline(never)]
pub fn sky(spec: &FrameSpec, time: f64) -> Dome {
    let place = Place { latitude: spec.get(&LATITUDE) / DEGREES, longitude: spec.get(&LONGITUDE) / DEGREES };
    Dome::new(Sky::new(time, &place), &spec.quality.sky)
}

/// The picture of a world under a sky, with a layer that lies between them, such as clouds.
#[inline(never)]
pub fn show(spec: &FrameSpec, dome: Dome, mut world: World, view: View, between: Option<Box<dyn Layer>>) -> Picture {
    tuft::sink(&mut world.bodies, view.camera().eye);
    let sky = SkyLayer::new(dome.with_shimmer(spec.time), &view, &spec.quality.sky).behind();
    let mut layers: Vec<Box<dyn Layer>> = vec![Box::new(RasterLayer::new(world, &view, &spec.quality.raster))];
    layers.extend(between);
    layers.push(Box::new(sky));
    Picture { layers, transfer: Transfer::Srgb }
}

/// The land under a sky, lit by sun or moon, without shadows. The aeroplane is turned by `turn` and stands at `place`;
/// its propeller turns and the waves go by `time`, seconds.
#[inline(never)]
pub fn world(dome: &Dome, mut textures: Vec<Texture>, turn: Mat3A, place: Vec3A, time: f64) -> World {
    let now = dome.lighting();
    let mut bodies = bodies();
    textures[WAVES].origin = Vec3A::splat(time as f32);
    // The same at every height, as the ground is but gentle slopes: there noise takes two thirds of its time.
    textures[GRASS].turn.y_axis = Vec3A::ZERO;
    // Five turns per second.
    let turns = 5.0 * time;
    let spin = turn * angle::turn_z((turns - turns.floor()) as f32 * TAU);
    let aeroplane = bodies.len() - 2;
    for (body, turn) in bodies[aeroplane..].iter_mut().zip([turn, spin]) {
        body.put(Affine3A { matrix3: turn, translation: place });
    }
    // The sky glows where the sun is or was, also while the moon lights the land.
    let sun = level(dome.sky.sun);
    let [glow, haze] = [sun, level(-sun)].map(|d| dome.radiance(d));
    let image = now.color * ease(0.0, 0.04, now.direction.y as f64) * 3.0;
    // Every field, since those of `World::new` would be dropped: 0.2 kB packed.
    World {
        bodies,
        textures,
        cloud_shadow: None,
        snow: None,
        lights: vec![Light::sun(now.direction, now.color)],
        ambient: [(now.sky + now.ground) * 0.5, (now.sky - now.ground) * 0.5],
        haze: Haze {
            color: haze,
            density: 1.0 / 9000.0,
            glow: (sun, (glow - haze).max(Vec3A::ZERO)),
            image: (level(now.direction), image),
        },
        zenith: dome.radiance(Vec3A::Y),
        film: true,
        background: None,
    }
}

/// A direction just above the horizon, below the given one.
#[inline(never)]
fn level(d: Vec3A) -> Vec3A {
    unit(vec3a(d.x, 0.05, d.z))
}

/// Lights a lamp in the chapel as it gets `dark`, 0 to 1.
#[inline(never)]
pub fn lamp(world: &mut World, dark: f32) {
    if dark > 0.0 {
        let color = vec3a(3.2, 1.5, 0.5) * dark;
        world.lights.push(point(
            vec3a(0.0, 14.5, 1.0),
            color,
            Vec2::new(0.05, 0.06),
            30.0,
            [512, FIRST_CASTER as u32],
            false,
        ));
    }
}

/// A lamp whose shadows are a cube of depth maps of `texels` along an edge, or traced. It reaches `reach` metres;
/// bodies before number `from` cast no shadow of it.
#[inline(never)]
pub fn point(
    position: Vec3A,
    color: Vec3A,
    falloff: Vec2,
    reach: f32,
    [texels, from]: [u32; 2],
    traced: bool,
) -> Light {
    let shadow = ShadowViews::new(fit::cube(position, texels), Bias::SHOW);
    let shadow = ShadowViews { traced, first_caster: from as usize, ..shadow };
    Light::lamp(position, color, falloff, reach).with_shadow(shadow)
}

/// The shadows of the sun or the moon, which stands in direction `towards`, over what a camera sees: one depth map up
/// to each of the distances `ends`, metres.
#[inline(never)]
pub fn cascades(spec: &FrameSpec, camera: &Camera, towards: Vec3A, ends: &[f32]) -> Option<ShadowViews> {
    let aspect = to_f32(spec.width) / to_f32(spec.height);
    let shadow_map = spec.quality.raster.built().shadow_map;
    let size = if shadow_map == 0 { 1024 } else { shadow_map };
    let shadow = ShadowViews::new(fit::cascades(camera, aspect, towards, ends, size), Bias::SHOW);
    Some(ShadowViews { traced: cuts::TRACED_SHADOWS && shadow_map == 0, first_caster: FIRST_CASTER, ..shadow })
}

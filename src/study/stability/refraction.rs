//! Refraction near the critical angle of glass, through many slabs, and between glass and water.

use fastrand::Rng;
use glam::{DAffine3, DMat3, DVec3};

use super::super::exact::{Exact, dot, vector};
use super::super::random::{perpendicular, random_rotation, random_sign, uniform, unit_vector};
use super::{MethodResult, ResultCounter, StabilityCase, powers_of_2, powers_of_10};
use crate::csg::{MaterialTag, Primitive, Solid};
use crate::picture::{Quality, Size};
use crate::scene::{Camera, Material, Scene};
use crate::tracer::{Path, RayKind, Scratch, Tracer};
use crate::view::Scale;

const IOR: f64 = 1.5;

const WATER: f64 = 1.33;

pub(super) fn cases() -> [StabilityCase; 3] {
    [
        StabilityCase {
            name: "critical",
            title: "The critical angle",
            about: "Rays inside glass (n = 1.5) that meet its face at a small angle above or below the critical one \
                    (41.81°: at 41.80° light refracts, at 41.82° it reflects), the face in a random orientation: is \
                    the light transmitted? A method that takes the root of 1 − n² sin² without checking its sign has \
                    no result where light is reflected. Truth: the exact sign of the radicand, for the given ray and \
                    normal.",
            parameter: "angle off the critical angle, radians",
            values: powers_of_10(-1, -16),
            required: 1e-12,
            scale: Scale::Log10,
            methods: &["f32", "unchecked sign", "ours"],
            measured_figure: None,
            tries: 2000,
            attempt: critical,
        },
        StabilityCase {
            name: "slabs",
            title: "A stack of slabs",
            about: "Rays through k parallel slabs of glass in a random orientation, at angles from 10⁻⁶ to 80° off \
                    their normal: they must leave in the direction in which they came. A method with angles (arc \
                    cosine, arc sine and sine) loses significant digits near the normal. Wrong: a direction that \
                    differs by more than 10⁻¹², or a ray that does not pass.",
            parameter: "slabs",
            values: powers_of_2(0, 8),
            required: 256.0,
            scale: Scale::Log2,
            methods: &["by angles", "ours"],
            measured_figure: Some("greatest error of the direction"),
            tries: 100,
            attempt: slabs,
        },
        StabilityCase {
            name: "media",
            title: "Glass that overlaps water",
            about: "Rays from water (n = 1.33) into glass (n = 1.5) that overlaps it a little, or only touches it: in \
                    the glass they refract by 1.33 / 1.5 at its face. A method that assumes air at every face has to \
                    leave a gap, and in the gap light travels as in air. Wrong: a direction behind the water that \
                    differs by more than 10⁻¹², or a ray that does not pass.",
            parameter: "overlap, or width of the gap",
            values: powers_of_10(-1, -14).into_iter().chain([0.0]).collect(),
            required: 0.0,
            scale: Scale::Log10,
            methods: &["a gap of air", "ours"],
            measured_figure: Some("greatest error of the direction"),
            tries: 200,
            attempt: media,
        },
    ]
}

/// Returns a scene of glass (tag 0) and water (tag 1) with an eye in it and without lights.
fn scene_of(solids: Vec<Solid>, eye: DVec3, direction: DVec3) -> Scene {
    let clear = |ior: f64| Material { ka: 0.0, kd: 0.0, kt: DVec3::ONE, ior, ..Material::default() };
    let up = direction.any_orthonormal_vector();
    let camera = Camera { eye, look_at: eye + direction, up, field_of_view: 10.0 };
    Scene {
        camera,
        background: DVec3::ONE,
        ambient: DVec3::ZERO,
        lights: Vec::new(),
        materials: vec![clear(IOR), clear(WATER)],
        names: vec![String::new(); 2],
        solids,
    }
}

/// Returns the paths of the ray from the eye and of the rays that it spawns, at most `depth` in sequence.
fn paths(scene: &Scene, depth: u32) -> Vec<Path> {
    let quality = Quality { max_depth: depth, cutoff: 0.0, ..Quality::default() };
    let mut paths = Vec::new();
    if let Ok(size) = Size::new(1, 1) {
        Tracer::new(scene, size, quality).paths(0..1, &mut Scratch::default(), |path| paths.push(path));
    }
    paths
}

fn critical(off: f64, tries: u32, rng: &mut Rng) -> Vec<MethodResult> {
    let mut count = ResultCounter::<3>::new();
    for _ in 0..tries {
        let normal = unit_vector(rng);
        let (sine, cosine) = (IOR.recip().asin() + off * random_sign(rng)).sin_cos();
        let direction = normal * cosine + perpendicular(rng, normal) * sine;
        let glass = Solid::Placed {
            primitive: Primitive::HalfSpace { normal, offset: 0.0 },
            scene_from_local: DAffine3::IDENTITY,
            tag: MaterialTag(0),
        };
        let paths = paths(&scene_of(vec![glass], -normal, direction), 2);
        let [first, next] = paths[..] else { continue };
        let gets_out = next.kind == RayKind::Refracted;
        let d = first.ray.direction;
        let (d32, n32) = (d.as_vec3(), normal.as_vec3());
        let in_f32 = 1.0 - (IOR * IOR) as f32 * (1.0 - d32.dot(n32) * d32.dot(n32)) >= 0.0;
        let rounded = is_transmitted(DVec3::from(d32), DVec3::from(n32));
        let truth = is_transmitted(d, normal);
        let root = (1.0 - IOR * IOR * (1.0 - d.dot(normal).powi(2))).sqrt();
        // A colour computed from NaN is wrong, whatever the truth.
        count.add([in_f32 != rounded, root.is_nan() || !truth, gets_out != truth]);
    }
    count.results()
}

/// Returns whether light of this direction leaves glass through a face with this normal: n² sin² ≤ 1. Neither vector
/// needs length 1.
fn is_transmitted(direction: DVec3, normal: DVec3) -> bool {
    let (d, n) = (vector(direction), vector(normal));
    let (lengths, cosine) = (dot(&d, &d) * dot(&n, &n), dot(&d, &n));
    let squared = Exact::from(IOR * IOR);
    !(&lengths - squared * (&lengths - &cosine * &cosine)).is_negative()
}

fn slabs(slabs: f64, tries: u32, rng: &mut Rng) -> Vec<MethodResult> {
    const MAX_ERROR: f64 = 1e-12;
    let mut count = ResultCounter::<2>::new();
    for _ in 0..tries {
        let turned = random_rotation(rng);
        let wide = 20.0 * slabs;
        let slab = |place: u32| Solid::Placed {
            primitive: Primitive::Cube,
            scene_from_local: DAffine3 {
                matrix3: turned * DMat3::from_diagonal(DVec3::new(wide, 0.25, wide)),
                translation: turned * DVec3::Y * -f64::from(place),
            },
            tag: MaterialTag(0),
        };
        let solids: Vec<Solid> = (1..=slabs as u32).map(slab).collect();
        let normal = turned * DVec3::Y;
        let off = (uniform(rng, 1e-6f64.ln(), 80f64.to_radians().ln())).exp();
        let direction = perpendicular(rng, normal) * off.sin() - normal * off.cos();
        let paths = paths(&scene_of(solids, DVec3::ZERO, direction), 2 * slabs as u32 + 1);
        let (Some(first), Some(last)) = (paths.first(), paths.last()) else { continue };
        let entry = first.ray.direction;
        let ours = if paths.len() as f64 == 2.0 * slabs + 1.0 { last.ray.direction } else { DVec3::NAN };
        let surfaces = 2 * slabs as u32;
        let naive = (0..surfaces).fold(entry, |d, surface| by_angles(d, normal, surface % 2 == 0));
        count.add_errors([naive, ours].map(|exit| (exit - entry).length()), MAX_ERROR);
    }
    count.results()
}

fn media(overlap: f64, tries: u32, rng: &mut Rng) -> Vec<MethodResult> {
    const MAX_ERROR: f64 = 1e-12;
    let mut count = ResultCounter::<2>::new();
    for _ in 0..tries {
        let turned = random_rotation(rng);
        let normal = turned * DVec3::Y;
        let slab = |low: f64, high: f64, tag: u32| Solid::Placed {
            primitive: Primitive::Cube,
            scene_from_local: DAffine3 {
                matrix3: turned * DMat3::from_diagonal(DVec3::new(50.0, (high - low) / 2.0, 50.0)),
                translation: normal * ((high + low) / 2.0),
            },
            tag: MaterialTag(tag),
        };
        let off = uniform(rng, 0.0, 80f64.to_radians());
        let direction = perpendicular(rng, normal) * off.sin() - normal * off.cos();
        // The water is from 0 to 1, and the glass ends in it or short of it.
        let errors = [-overlap, overlap].map(|end| {
            let solids = vec![slab(-1.0, end, 0), slab(0.0, 1.0, 1)];
            let paths = paths(&scene_of(solids, normal * 2.0, direction), 6);
            let entry = paths.first().map_or(DVec3::NAN, |path| path.ray.direction);
            let across = (entry - normal * normal.dot(entry)) / IOR;
            let expected = across - normal * (1.0 - across.length_squared()).sqrt();
            let gets_through = paths.len() == 4 || end < 0.0;
            paths.get(2).filter(|_| gets_through).map_or(f64::NAN, |path| (path.ray.direction - expected).length())
        });
        count.add_errors(errors, MAX_ERROR);
    }
    count.results()
}

/// Refracts by Snell's law with angles instead of vectors.
fn by_angles(direction: DVec3, normal: DVec3, enters: bool) -> DVec3 {
    let ratio = if enters { IOR.recip() } else { IOR };
    let incoming = (-direction.dot(normal)).acos();
    let outgoing = (ratio * incoming.sin()).asin();
    let side = (direction + normal * incoming.cos()).normalize();
    side * outgoing.sin() - normal * outgoing.cos()
}

#[cfg(test)]
mod tests {
    use super::super::check;
    use super::*;

    #[test]
    fn light_leaves_glass_below_the_critical_angle() {
        check(&cases()[0], 400);
    }

    #[test]
    fn light_leaves_slabs_in_its_first_direction() {
        check(&cases()[1], 30);
    }

    #[test]
    fn glass_that_overlaps_water_has_no_air_between() {
        check(&cases()[2], 20);
    }

    #[test]
    fn critical_angle_of_glass_is_between_41_80_and_41_82_degrees() {
        let direction = |degrees: f64| DVec3::new(degrees.to_radians().sin(), degrees.to_radians().cos(), 0.0);
        assert!(is_transmitted(direction(41.80), DVec3::Y) && !is_transmitted(direction(41.82), DVec3::Y));
    }
}

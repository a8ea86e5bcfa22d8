//! The same scene, scaled by powers of two.

use fastrand::Rng;
use glam::{DAffine3, DVec3};

use super::{MethodResult, ResultCounter, StabilityCase, powers_of_2};
use crate::csg::Solid;
use crate::geometry::Ray;
use crate::picture::{Colour, Quality, Size};
use crate::scene::{Light, SMALL_BUILT_IN, Scene};
use crate::tracer::{Scratch, Tracer};
use crate::view::Scale;

/// Returns the case: nothing in a tracer may depend on a scene's size.
pub(super) fn scenes() -> StabilityCase {
    StabilityCase {
        name: "scaled",
        title: "A scene and its copies at other scales",
        about: "Each built-in scene, scaled by 2ᵏ and by 2⁻ᵏ: its picture must be identical to the bit, since \
                multiplication by powers of two does not round. The naive picture is of a ball on a floor under a \
                lamp, by rays that ignore crossings nearer than 10⁻⁴, an offset that does not scale with the scene; \
                it counts once for each scene. Truth: the picture at k = 0. The count is of pixels.",
        parameter: "scale 2ᵏ, and its inverse",
        values: powers_of_2(0, 20),
        required: f64::from(1 << 20),
        scale: Scale::Log2,
        methods: &["beyond 1e-4", "ours"],
        measured_figure: None,
        // A scene's pixels.
        tries: 48 * 36,
        attempt,
    }
}

fn attempt(scale: f64, tries: u32, _: &mut Rng) -> Vec<MethodResult> {
    let height = (f64::from(tries) * 0.75).sqrt().max(1.0) as u32;
    let Ok(size) = Size::new(height * 4 / 3 + 1, height) else { return Vec::new() };
    let mut count = ResultCounter::<2>::new();
    for factor in [scale, scale.recip()] {
        let naive: Vec<bool> =
            (0..size.pixels()).map(|at| is_in_shadow(at, size, factor) != is_in_shadow(at, size, 1.0)).collect();
        for (_, text) in SMALL_BUILT_IN {
            // They parse, as tests check.
            let Ok(scene) = Scene::parse(text) else { continue };
            let (plain, other) = (picture(&scene, size), picture(&scaled(&scene, factor), size));
            for ((naive, pixel), other) in naive.iter().zip(&plain).zip(&other) {
                count.add([*naive, pixel.map(f32::to_bits) != other.map(f32::to_bits)]);
            }
        }
    }
    count.results()
}

fn picture(scene: &Scene, size: Size) -> Vec<Colour> {
    let mut pixels = Vec::new();
    Tracer::new(scene, size, Quality::default()).trace(0..size.pixels(), &mut Scratch::default(), &mut pixels);
    pixels
}

/// Returns the scene with every length multiplied by `factor`.
fn scaled(scene: &Scene, factor: f64) -> Scene {
    let mut scene = scene.clone();
    scene.camera.eye *= factor;
    scene.camera.look_at *= factor;
    for light in &mut scene.lights {
        if let Light::Point { position, .. } = light {
            *position *= factor;
        }
    }
    scene.solids.iter_mut().for_each(|solid| scale_solid(solid, &DAffine3::from_scale(DVec3::splat(factor))));
    scene
}

fn scale_solid(solid: &mut Solid, map: &DAffine3) {
    match solid {
        Solid::Placed { scene_from_local, .. } => *scene_from_local = *map * *scene_from_local,
        Solid::Union(solids) | Solid::Intersection(solids) | Solid::Difference(solids) => {
            solids.iter_mut().for_each(|solid| scale_solid(solid, map));
        }
    }
}

/// Returns whether a naive tracer finds the pixel's point in shadow.
fn is_in_shadow(pixel: u32, size: Size, factor: f64) -> bool {
    const EPSILON: f64 = 1e-4;
    let (ball, radius) = (DVec3::Y * factor, factor);
    let nearest = |ray: &Ray| {
        let floor = -ray.origin.y / ray.direction.y;
        let f = ray.origin - ball;
        let (b, c) = (f.dot(ray.direction), f.length_squared() - radius * radius);
        let root = (b * b - c).sqrt();
        [floor, -b - root, -b + root].into_iter().filter(|&t| t > EPSILON).fold(f64::INFINITY, f64::min)
    };
    let (eye, lamp) = (DVec3::new(0.0, 3.0, 8.0) * factor, DVec3::new(4.0, 8.0, 3.0) * factor);
    let (x, y) = (f64::from(pixel % size.width()), f64::from(pixel / size.width()));
    let (across, up) = (x / f64::from(size.width()) - 0.5, 0.5 - y / f64::from(size.height()));
    let ray = Ray::new(eye, DVec3::new(across, 0.75 * up - 0.25, -1.0).normalize());
    let t = nearest(&ray);
    let point = ray.at(t);
    let to_lamp = lamp - point;
    t.is_finite() && nearest(&Ray::new(point, to_lamp.normalize())) < to_lamp.length()
}

#[cfg(test)]
mod tests {
    #[test]
    fn scaled_scenes_have_identical_pictures() {
        super::super::check(&super::scenes(), 16 * 12);
    }
}

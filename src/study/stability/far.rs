//! A small ball far away.

use fastrand::Rng;
use glam::{DAffine3, DVec3, Vec3};

use super::super::random::{perpendicular, uniform, unit_vector};
use super::placed_primitive::PlacedPrimitive;
use super::{MethodResult, ResultCounter, StabilityCase, powers_of_10};
use crate::csg::Primitive;
use crate::geometry::Ray;
use crate::view::Scale;

/// Returns the case: the discriminant b² − c loses the ball's size against the distance.
pub(super) fn sphere() -> StabilityCase {
    StabilityCase {
        name: "far-sphere",
        title: "A far sphere",
        about: "Rays towards a sphere of radius 1 that pass its centre within 2: is the sphere hit? The textbook's \
                discriminant b² − ac subtracts squares of the distance; ours is that of the line's closest approach \
                (Haines, Günther and Akenine-Möller, *Ray Tracing Gems*, ch. 7). Truth: the exact sign of the \
                discriminant. In f32 the ray is rounded first, and the truth is that of the rounded ray.",
        parameter: "distance, radii",
        values: powers_of_10(1, 13),
        required: 1e8,
        scale: Scale::Log10,
        methods: &["textbook, f32", "textbook, f64", "ours"],
        measured_figure: None,
        tries: 20_000,
        attempt,
    }
}

fn attempt(distance: f64, tries: u32, rng: &mut Rng) -> Vec<MethodResult> {
    let ball = PlacedPrimitive::new(Primitive::Sphere, DAffine3::IDENTITY);
    let mut count = ResultCounter::<3>::new();
    for _ in 0..tries {
        let outward = unit_vector(rng);
        let (origin, target) = (outward * distance, perpendicular(rng, outward) * uniform(rng, 0.0, 2.0));
        let ray = Ray::new(origin, (target - origin).normalize());
        let truth = ball.truth(&ray);
        let (o, d) = (ray.origin.as_vec3(), ray.direction.as_vec3());
        let rounded = Ray::new(DVec3::from(o), DVec3::from(d));
        let in_f32 = is_hit_in_f32(o, d) != ball.truth(&rounded).intersects();
        count.add([in_f32, truth.contradicts(&ball.textbook(&ray)), truth.contradicts(&ball.ours(&ray))]);
    }
    count.results()
}

fn is_hit_in_f32(o: Vec3, d: Vec3) -> bool {
    let b = o.dot(d);
    b * b - d.dot(d) * (o.dot(o) - 1.0) > 0.0
}

#[cfg(test)]
mod tests {
    #[test]
    fn far_sphere_is_hit_or_missed_correctly() {
        super::super::check(&super::sphere(), 2000);
    }
}

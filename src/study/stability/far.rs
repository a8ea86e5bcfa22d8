//! A small ball far away.

use fastrand::Rng;
use glam::{DAffine3, DVec3, Vec3};

use super::super::random::{aside, between, unit};
use super::subject::Subject;
use super::{Count, StabilityCase, Verdicts, tens};
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
        values: tens(1, 13),
        required: 1e8,
        scale: Scale::Log10,
        methods: &["textbook, f32", "textbook, f64", "ours"],
        measures: None,
        tries: 20_000,
        attempt,
    }
}

fn attempt(distance: f64, tries: u32, rng: &mut Rng) -> Vec<Verdicts> {
    let ball = Subject::new(Primitive::Sphere, DAffine3::IDENTITY);
    let mut count = Count::<3>::new();
    for _ in 0..tries {
        let way = unit(rng);
        let (origin, target) = (way * distance, aside(rng, way) * between(rng, 0.0, 2.0));
        let ray = Ray::new(origin, (target - origin).normalize());
        let truth = ball.truth(&ray);
        let (o, d) = (ray.origin.as_vec3(), ray.direction.as_vec3());
        let rounded = Ray::new(DVec3::from(o), DVec3::from(d));
        let in_f32 = is_hit_in_f32(o, d) != ball.truth(&rounded).meets();
        count.add([in_f32, truth.is_missed_by(&ball.textbook(&ray)), truth.is_missed_by(&ball.ours(&ray))]);
    }
    count.outcomes()
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

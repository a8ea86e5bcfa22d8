//! Rays that nearly miss: tangents, rims, apexes, and generators of cones.

use std::f64::consts::TAU;

use fastrand::Rng;
use glam::{DAffine3, DMat3, DVec3};

use super::super::random::{perpendicular, random_placement, random_rotation, random_sign, uniform, unit_vector};
use super::placed_primitive::{PlacedPrimitive, is_impossible};
use super::{MethodResult, ResultCounter, StabilityCase, powers_of_10};
use crate::csg::Primitive;
use crate::geometry::Ray;
use crate::view::Scale;

const CONE: Primitive = Primitive::Cone { bottom: 1.0, top: 0.0 };

/// Distance from which grazing rays come.
const RAY_DISTANCE: f64 = 100.0;

const SEMI_AXES: DVec3 = DVec3::new(1.0, 0.8, 0.6);

pub(super) fn cases() -> [StabilityCase; 4] {
    let grazing = |name, title, about, required, attempt| StabilityCase {
        name,
        title,
        about,
        parameter: "distance from the tangent point, edge or apex, over the solid's size",
        values: decades_to_0(-1),
        required,
        scale: Scale::Log10,
        methods: &["textbook", "ours"],
        measured_figure: None,
        tries: 5000,
        attempt,
    };
    [
        StabilityCase {
            parameter: "angle off the generator",
            values: decades_to_0(0),
            ..grazing(
                "cone-generator",
                "Rays along a cone's generator",
                "Rays to a point inside a cone of 45°, parallel to one of its generators up to an angle. The square \
                 term vanishes, and the textbook's (−b ± √(b² − ac)) / a loses significant digits; ours takes the \
                 root without cancellation, and gets the other from the constant (Kahan). Wrong: not exactly one \
                 entry and one exit, or one of them is further than 10⁻⁹ from the point where the exact solid changes \
                 from outside to inside.",
                0.0,
                generator,
            )
        },
        grazing(
            "tangent",
            "Tangents",
            "Spheres, ellipsoids, cylinders and cones in random orientations, and rays from a distance of 100 that \
             pass a tangent's point inside or outside by a small distance: hit or miss? Wrong: also an odd number of \
             events, or an event that is not a number. Truth: exact signs of the quadratic at the caps, and of its \
             discriminant.",
            1e-12,
            tangent,
        ),
        grazing(
            "rim",
            "The rim of a cylinder",
            "Rays that pass the edge between the side and a cap at a small distance, inside or outside; a quarter of \
             them along the side or the cap of a cylinder that is not rotated. Otherwise as for tangents. A textbook \
             method that tests the side and the caps one by one finds one of the two events and not the other.",
            1e-12,
            rim,
        ),
        grazing(
            "apex",
            "The apex of a cone",
            "Rays that pass the apex at a small distance; otherwise as for tangents. The length of a ray inside the \
             cone is as small as this distance, and the discriminant is its square.",
            1e-9,
            apex,
        ),
    ]
}

/// Returns powers of ten down to the last that changes 1 in f64, and then 0.
fn decades_to_0(from: i32) -> Vec<f64> {
    powers_of_10(from, -16).into_iter().chain([0.0]).collect()
}

fn generator(angle: f64, tries: u32, rng: &mut Rng) -> Vec<MethodResult> {
    const TOLERANCE: f64 = 1e-9;
    let mut count = ResultCounter::<2>::new();
    for index in 0..tries {
        // Only a cone that is not rotated has rays that are exactly parallel.
        let rotation = if index % 2 == 0 { DMat3::IDENTITY } else { random_rotation(rng) };
        let cone =
            PlacedPrimitive::new(CONE, DAffine3::from_mat3(rotation * DMat3::from_diagonal(DVec3::new(2.0, 1.0, 2.0))));
        let about = if index % 4 == 0 { TAU / 4.0 * f64::from(index / 4 % 4) } else { uniform(rng, 0.0, TAU) };
        // For right angles sine and cosine must be exact, too.
        let (mut sine, mut cosine) = about.sin_cos();
        if index % 4 == 0 {
            (sine, cosine) = (sine.round(), cosine.round());
        }
        let along = rotation * DVec3::new(cosine, -1.0, sine) * random_sign(rng);
        let direction = (along + unit_vector(rng) * angle).normalize();
        let height = uniform(rng, -0.8, 0.6);
        let target = DVec3::new(0.0, height, 0.0) + perpendicular(rng, DVec3::Y) * (0.7 * (1.0 - height));
        let ray = Ray::new(rotation * target - direction * 10.0, direction);
        let ours = cone.ours(&ray);
        let truth = cone.truth(&ray);
        count.add([cone.textbook(&ray), ours].map(|places| truth.contradicts_within(&places, TOLERANCE)));
    }
    count.results()
}

fn tangent(distance: f64, tries: u32, rng: &mut Rng) -> Vec<MethodResult> {
    const SOLIDS: [(Primitive, DVec3); 4] = [
        (Primitive::Sphere, DVec3::ONE),
        (Primitive::Sphere, SEMI_AXES),
        (Primitive::Cylinder, SEMI_AXES),
        (CONE, SEMI_AXES),
    ];
    graze(tries, rng, |index, rng| {
        let (primitive, scale) = SOLIDS[index as usize % SOLIDS.len()];
        let solid = PlacedPrimitive::new(primitive, random_placement(rng, scale));
        let (side, height) = (perpendicular(rng, DVec3::Y), uniform(rng, -0.9, 0.9));
        let (own, normal) = match primitive {
            Primitive::Cone { .. } => (side * ((1.0 - height) / 2.0) + DVec3::Y * height, side + DVec3::Y / 2.0),
            Primitive::Cylinder => (side + DVec3::Y * height, side),
            _ => (side, side),
        };
        let normal = (solid.local_from_scene.matrix3.transpose() * normal).normalize();
        let point = solid.scene_from_local.transform_point3(own) + normal * (distance * random_sign(rng));
        let direction = perpendicular(rng, normal);
        (solid, point - direction * RAY_DISTANCE, direction)
    })
}

fn rim(distance: f64, tries: u32, rng: &mut Rng) -> Vec<MethodResult> {
    graze(tries, rng, |index, rng| {
        let off = distance * random_sign(rng);
        if index % 4 == 0 {
            let cylinder = PlacedPrimitive::new(Primitive::Cylinder, DAffine3::IDENTITY);
            let [along, across] = if rng.bool() { [DVec3::Y, DVec3::X] } else { [DVec3::X, DVec3::Y] };
            return (cylinder, across * (1.0 + off) + along * RAY_DISTANCE, -along);
        }
        let cylinder = PlacedPrimitive::new(Primitive::Cylinder, random_placement(rng, SEMI_AXES));
        let side = perpendicular(rng, DVec3::Y);
        let edge = cylinder.scene_from_local.transform_vector3(DVec3::Y.cross(side)).normalize();
        let (direction, away) = loop {
            let direction = unit_vector(rng);
            let away = edge.cross(direction);
            // A ray along the edge passes it where it curves away.
            if away.length() > 0.1 {
                break (direction, away.normalize());
            }
        };
        let point = cylinder.scene_from_local.transform_point3(side + DVec3::Y) + away * off;
        (cylinder, point - direction * RAY_DISTANCE, direction)
    })
}

fn apex(distance: f64, tries: u32, rng: &mut Rng) -> Vec<MethodResult> {
    graze(tries, rng, |_, rng| {
        let cone = PlacedPrimitive::new(CONE, random_placement(rng, SEMI_AXES));
        let point = cone.scene_from_local.transform_point3(DVec3::Y) + unit_vector(rng) * distance;
        let direction = unit_vector(rng);
        (cone, point - direction * RAY_DISTANCE, direction)
    })
}

/// Tries rays given by origin and direction, each with the solid that it grazes.
fn graze(
    tries: u32,
    rng: &mut Rng,
    mut aim: impl FnMut(u32, &mut Rng) -> (PlacedPrimitive, DVec3, DVec3),
) -> Vec<MethodResult> {
    let mut count = ResultCounter::<2>::new();
    for index in 0..tries {
        let (solid, origin, direction) = aim(index, rng);
        let ray = Ray::new(origin, direction);
        let truth = solid.truth(&ray);
        let answers = [solid.textbook(&ray), solid.ours(&ray)];
        count.add([0, 1].map(|method| truth.contradicts(&answers[method])));
        for (result, places) in count.0.iter_mut().zip(&answers) {
            result.measured = Some(result.measured.unwrap_or(0.0) + f64::from(u8::from(is_impossible(places))));
        }
    }
    count.results()
}

#[cfg(test)]
mod tests {
    use super::super::check;
    use super::*;

    #[test]
    fn rays_along_a_generator_lose_no_root() {
        check(&cases()[0], 400);
    }

    #[test]
    fn grazing_rays_hit_or_miss_correctly_and_have_an_exit_for_each_entry() {
        for case in &cases()[1..] {
            check(case, 1000);
            let broken = case.rows(1000).into_iter().filter(|row| row.method == "ours" && row.measured != Some(0.0));
            assert_eq!(broken.count(), 0, "{}", case.name);
        }
    }
}

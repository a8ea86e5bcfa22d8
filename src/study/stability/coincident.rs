//! Coincident faces, and faces that nearly coincide.

use fastrand::Rng;
use glam::{DAffine3, DMat3, DVec3};

use super::super::random::{perpendicular, random_rotation, uniform, unit_vector};
use super::{MethodResult, ResultCounter, StabilityCase, powers_of_10};
use crate::csg::{MaterialTag, Primitive, Solid, Stack, Tree};
use crate::geometry::{Ray, rotation};
use crate::view::Scale;

pub(super) fn cases() -> [StabilityCase; 2] {
    [
        StabilityCase {
            name: "bore",
            title: "Coincident faces",
            about: "A cylinder with a bore that ends exactly where the cylinder ends. The bore's map has another \
                    order of moves and scales, so that the two caps round differently. Both are rotated by (3°, 11°, \
                    5°), or at random. Rays through the bore must meet nothing. A plain merge of intervals sees a \
                    skin over the bore; grouping equal distances does so where rounding made them unequal; ours \
                    groups distances that differ by less than 10⁻¹² of the values they were computed from. Truth: by \
                    construction.",
            parameter: "distance from the origin",
            values: powers_of_10(0, 9),
            required: 1e3,
            scale: Scale::Log10,
            methods: &["plain merge", "equal distances", "ours"],
            measured_figure: None,
            tries: 5000,
            attempt: bore,
        },
        StabilityCase {
            name: "plate",
            title: "A thin plate",
            about: "Grouping must not lose anything. A plate seen from a distance of 10, rotated at random, in a \
                    union with a ball behind it or as the intersection of two half-spaces, is entered and left. \
                    Fusing distances within an absolute 0.0005 loses the plate. Wrong: entry or exit is missing, or \
                    their distance differs from the length of the ray's path through the plate by more than a \
                    thousandth. Truth: by construction.",
            parameter: "thickness",
            values: powers_of_10(0, -13),
            required: 1e-7,
            scale: Scale::Log10,
            methods: &["within 0.0005", "ours"],
            measured_figure: None,
            tries: 3000,
            attempt: plate,
        },
    ]
}

/// Returns the distances at which the ray enters and leaves the solid, in turn.
fn crossing_distances(solid: &Solid, ray: &Ray) -> Vec<f64> {
    let mut tree = Tree::default();
    let mut places = Vec::new();
    if let Some((root, _)) = tree.add(solid) {
        tree.crossings(root, ray, None, f64::INFINITY, false, &mut Stack::new(), |hit| {
            places.push(hit.t);
            true
        });
    }
    places
}

fn bore(distance: f64, tries: u32, rng: &mut Rng) -> Vec<MethodResult> {
    let mut count = ResultCounter::<3>::new();
    for index in 0..tries {
        let turned = if index % 4 == 0 { rotation(DVec3::new(3.0, 11.0, 5.0)) } else { random_rotation(rng) };
        let place = DAffine3 { matrix3: turned, translation: unit_vector(rng) * distance };
        let body = place * DAffine3::from_scale(DVec3::new(1.0, 1.5, 1.0));
        // The same height by a longer sequence: moved, scaled, moved back.
        let up = DAffine3::from_translation(DVec3::Y * 0.75) * DAffine3::from_scale(DVec3::new(0.4, 0.75, 0.4));
        let lengthened = DAffine3::from_scale(DVec3::new(1.0, 2.0, 1.0)) * up;
        let cutter = place * DAffine3::from_translation(DVec3::Y * -1.5) * lengthened;
        // Slightly tilted, so that a ray passes both caps but no wall.
        let axis = turned * DVec3::Y;
        let direction = (axis + perpendicular(rng, axis) * uniform(rng, 0.0, 0.02)).normalize();
        let through = place.translation + perpendicular(rng, axis) * uniform(rng, 0.0, 0.3);
        let ray = Ray::new(through - direction * 8.0, direction);
        let [body_caps, cutter_caps] = [body, cutter].map(|map| cap_distances(&map, &ray));
        let cylinder = |scene_from_local, tag| Solid::Placed { primitive: Primitive::Cylinder, scene_from_local, tag };
        let bored = Solid::Difference(vec![cylinder(body, MaterialTag(0)), cylinder(cutter, MaterialTag(1))]);
        // The remains of the body before and after the cutter.
        let skins = [cutter_caps[0] - body_caps[0], body_caps[1] - cutter_caps[1]];
        count.add([
            skins.iter().any(|&skin| skin >= 0.0),
            skins.iter().any(|&skin| skin > 0.0),
            !crossing_distances(&bored, &ray).is_empty(),
        ]);
    }
    count.results()
}

/// Returns the distances at which the ray crosses the caps of a cylinder.
fn cap_distances(scene_from_local: &DAffine3, ray: &Ray) -> [f64; 2] {
    let local_from_scene = scene_from_local.inverse();
    let o = local_from_scene.transform_point3(ray.origin);
    let d = local_from_scene.transform_vector3(ray.direction);
    [(-1.0 - o.y) / d.y, (1.0 - o.y) / d.y]
}

fn plate(thickness: f64, tries: u32, rng: &mut Rng) -> Vec<MethodResult> {
    const FUSE_DISTANCE: f64 = 0.0005;
    let mut count = ResultCounter::<2>::new();
    for index in 0..tries {
        let turned = random_rotation(rng);
        let placed = |primitive, size: DVec3, at: DVec3| Solid::Placed {
            primitive,
            scene_from_local: DAffine3 { matrix3: turned * DMat3::from_diagonal(size), translation: turned * at },
            tag: MaterialTag(0),
        };
        let half = thickness / 2.0;
        let solid = if index % 2 == 0 {
            let side =
                |y: f64| placed(Primitive::HalfSpace { normal: DVec3::Y * y, offset: half }, DVec3::ONE, DVec3::ZERO);
            Solid::Intersection(vec![side(1.0), side(-1.0)])
        } else {
            let plate = placed(Primitive::Cube, DVec3::new(2.0, half, 2.0), DVec3::ZERO);
            Solid::Union(vec![plate, placed(Primitive::Sphere, DVec3::ONE, DVec3::Y * -5.0)])
        };
        let target = perpendicular(rng, DVec3::Y) * rng.f64();
        let tilted = (DVec3::NEG_Y + perpendicular(rng, DVec3::Y) * uniform(rng, 0.0, 0.05)).normalize();
        let ray = Ray::new(turned * (target - tilted * 10.0), turned * tilted);
        let expected = thickness / -tilted.y;
        let is_wrong = |places: &[f64]| match places {
            [enter, leave, ..] => ((leave - enter) / expected - 1.0).abs() > 1e-3,
            _ => true,
        };
        let ours = crossing_distances(&solid, &ray);
        let map = DAffine3::from_mat3(turned * DMat3::from_diagonal(DVec3::new(2.0, half, 2.0)));
        let mut naive = cap_distances(&map, &ray).to_vec();
        naive.sort_by(f64::total_cmp);
        if naive[1] - naive[0] < FUSE_DISTANCE {
            naive.clear();
        }
        count.add([is_wrong(&naive), is_wrong(&ours)]);
    }
    count.results()
}

#[cfg(test)]
mod tests {
    use super::super::check;
    use super::*;

    #[test]
    fn rays_pass_through_a_bore_in_any_orientation() {
        check(&cases()[0], 500);
    }

    #[test]
    fn thin_plate_survives_grouping() {
        check(&cases()[1], 200);
    }
}

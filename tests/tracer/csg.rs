//! Boolean operations along rays: pictures as text, coincident faces, and many operands.

use anel::csg::{MaterialTag, Primitive, Solid, Stack, Tree};
use anel::geometry::{Ray, rotation};
use glam::{DAffine3, DMat3, DVec3};
use proptest::prelude::*;

fn placed(primitive: Primitive, scale: DVec3, degrees: DVec3, at: DVec3, tag: u32) -> Solid {
    let matrix3 = rotation(degrees) * DMat3::from_diagonal(scale);
    Solid::Placed { primitive, scene_from_local: DAffine3 { matrix3, translation: at }, tag: MaterialTag(tag) }
}

fn ball(at: DVec3, tag: u32) -> Solid {
    placed(Primitive::Sphere, DVec3::ONE, DVec3::ZERO, at, tag)
}

fn cube(at: DVec3, tag: u32) -> Solid {
    placed(Primitive::Cube, DVec3::splat(0.8), DVec3::ZERO, at, tag)
}

/// A picture of the solid along −z, 32 × 16 characters: the tag of the visible surface as a letter.
fn picture(solid: &Solid) -> String {
    let mut tree = Tree::default();
    let root = tree.add(solid).map(|(root, _)| root);
    tree.finish();
    let mut rows = String::new();
    for y in 0..16 {
        for x in 0..32 {
            let (x, y) = ((f64::from(x) - 15.5) / 8.0, (7.5 - f64::from(y)) / 4.0);
            let ray = Ray::new(DVec3::new(x, y, 10.0), DVec3::NEG_Z);
            let hit = root.and_then(|root| tree.nearest(root, &ray, None, f64::INFINITY, false, &mut Stack::new()));
            rows.push(hit.map_or('.', |hit| char::from(b'a' + tree.leaf(hit.surface).tag.0 as u8)));
        }
        rows.push('\n');
    }
    rows
}

#[test]
fn union_shows_both_operands() {
    let seen = picture(&Solid::Union(vec![ball(DVec3::new(-0.5, 0.0, 0.0), 0), cube(DVec3::new(0.7, 0.0, 0.0), 1)]));
    assert_eq!(seen, include_str!("golden/union.txt"), "\n{seen}");
}

#[test]
fn intersection_shows_the_common_part() {
    let seen =
        picture(&Solid::Intersection(vec![ball(DVec3::new(-0.5, 0.0, 0.0), 0), cube(DVec3::new(0.3, 0.0, 0.0), 1)]));
    assert_eq!(seen, include_str!("golden/intersection.txt"), "\n{seen}");
}

#[test]
fn difference_shows_the_cut_with_the_surface_of_the_cutter() {
    let cutter = placed(Primitive::Cylinder, DVec3::new(0.5, 3.0, 0.5), DVec3::new(90.0, 0.0, 0.0), DVec3::ZERO, 1);
    let bite = ball(DVec3::new(1.0, 0.6, 0.9), 2);
    let seen = picture(&Solid::Difference(vec![ball(DVec3::ZERO, 0), cutter, bite]));
    assert_eq!(seen, include_str!("golden/difference.txt"), "\n{seen}");
}

#[test]
fn empty_solids_are_dropped() {
    let mut tree = Tree::default();
    let far = ball(DVec3::X * 5.0, 0);
    assert!(tree.add(&Solid::Intersection(vec![ball(DVec3::ZERO, 0), far.clone()])).is_none());
    assert!(tree.add(&Solid::Intersection(vec![])).is_none());
    assert!(tree.add(&Solid::Union(vec![])).is_none());
    let (root, _) = tree.add(&Solid::Difference(vec![ball(DVec3::ZERO, 0), far])).expect("a ball");
    assert_eq!(tree.leaves_of(root).len(), 1, "a cutter out of reach is not part of the compiled solid");
}

/// A bored cylinder. Body and bore end at the same planes, but their maps round differently.
#[test]
fn rays_pass_a_bore_with_coincident_caps() {
    let degrees = DVec3::new(3.0, 11.0, 5.0);
    let turn = rotation(degrees);
    let at = DVec3::new(0.1, -0.7, 0.3);
    let body = placed(Primitive::Cylinder, DVec3::new(1.0, 1.5, 1.0), degrees, at, 0);
    // The same height through more maps: moved, scaled, moved back.
    let bore = {
        let scale = DAffine3::from_scale(DVec3::new(0.4, 0.75, 0.4));
        let up = DAffine3::from_translation(DVec3::Y * 0.75);
        let back = DAffine3::from_translation(DVec3::Y * -1.5);
        let lengthen = DAffine3::from_scale(DVec3::new(1.0, 2.0, 1.0));
        let place = DAffine3 { matrix3: turn, translation: at };
        Solid::Placed {
            primitive: Primitive::Cylinder,
            scene_from_local: place * back * lengthen * up * scale,
            tag: MaterialTag(1),
        }
    };
    let mut tree = Tree::default();
    let (root, _) = tree.add(&Solid::Difference(vec![body, bore])).expect("a bored cylinder");
    let axis = turn * DVec3::Y;
    let side = axis.any_orthonormal_vector();
    let mut wrong = 0;
    for index in 0..10_000 {
        let (radius, angle) = (0.3 * (f64::from(index) / 1e4).sqrt(), f64::from(index) * 2.4);
        let offset = (side * angle.cos() + axis.cross(side) * angle.sin()) * radius;
        // Slightly tilted: every ray passes both caps and misses the side.
        let direction = (axis + side * 0.02 * (f64::from(index % 7) / 7.0)).normalize();
        let ray = Ray::new(at + offset - direction * 8.0, direction);
        wrong += u32::from(tree.nearest(root, &ray, None, f64::INFINITY, false, &mut Stack::new()).is_some());
    }
    assert_eq!(wrong, 0, "rays of 10,000 that hit a surface over the bore");
}

#[test]
fn plate_of_thickness_1e_minus_7_survives_the_tolerance() {
    let plate = placed(Primitive::Cube, DVec3::new(1.0, 0.5e-7, 1.0), DVec3::ZERO, DVec3::ZERO, 0);
    let whole = Solid::Union(vec![plate, ball(DVec3::NEG_Y * 7.0, 1)]);
    let ray = Ray::new(DVec3::new(0.2, 10.0, 0.1), DVec3::NEG_Y);
    let found = crossings(&whole, &ray);
    assert_eq!(found.len(), 4);
    assert!((found[1].0 - found[0].0 - 1e-7).abs() < 1e-13);
}

/// The distance and the tag of each crossing.
fn crossings(solid: &Solid, ray: &Ray) -> Vec<(f64, u32)> {
    let mut tree = Tree::default();
    let Some((root, _)) = tree.add(solid) else { return Vec::new() };
    tree.finish();
    let mut found = Vec::new();
    tree.crossings(root, ray, None, f64::INFINITY, tree.contains(root, ray.origin, 0.0), &mut Stack::new(), |hit| {
        found.push((hit.t, tree.leaf(hit.surface).tag.0));
        true
    });
    found
}

/// A hundred thousand balls in a row and one ray along it: if the time grew with the square of their number, the test
/// would not end.
#[test]
fn hundred_thousand_operands_are_merged_in_linear_time() {
    const BALLS: u32 = 100_000;
    let balls: Vec<_> = (0..BALLS).map(|index| ball(DVec3::X * 3.0 * f64::from(index), index)).collect();
    let bar = placed(Primitive::Cube, DVec3::new(4.0 * f64::from(BALLS), 0.5, 0.5), DVec3::ZERO, DVec3::ZERO, BALLS);
    let ray = Ray::new(DVec3::X * -9.0, DVec3::X);
    let kept = Solid::Intersection(vec![bar.clone(), Solid::Union(balls.clone())]);
    assert_eq!(crossings(&kept, &ray).len(), 2 * BALLS as usize);
    let taken = Solid::Difference([vec![bar], balls].concat());
    assert_eq!(crossings(&taken, &ray).len(), 2 * BALLS as usize + 1);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn union_of_many_is_inside_where_any_operand_is(
        places in prop::collection::vec(prop::array::uniform3(-4.0..4.0f64), 1..60),
        origin in prop::array::uniform3(-4.0..4.0f64),
        towards in prop::array::uniform3(-4.0..4.0f64),
    ) {
        let balls: Vec<_> = places.iter().zip(0..).map(|(&at, tag)| ball(DVec3::from(at), tag)).collect();
        let direction = (DVec3::from(towards) - DVec3::from(origin)).normalize();
        // The ray starts outside the hall below, even if it passes its corner.
        let ray = Ray::new(DVec3::from(origin) - direction * 40.0, direction);
        // The crossings of each ball alone: an entry, then an exit.
        let alone = balls.iter().flat_map(|one| crossings(one, &ray));
        let mut changes: Vec<_> = alone.zip([1, -1].into_iter().cycle()).collect();
        changes.sort_by(|((a, _), _), ((b, _), _)| a.total_cmp(b));
        let mut depth = 0;
        let expected: Vec<_> = changes
            .into_iter()
            .filter_map(|(crossing, change)| {
                depth += change;
                (depth == i32::from(change > 0)).then_some(crossing)
            })
            .collect();
        prop_assert_eq!(crossings(&Solid::Union(balls.clone()), &ray), expected);
        // A difference removes all balls from a hall that contains them.
        let hall = placed(Primitive::Cube, DVec3::splat(10.0), DVec3::ZERO, DVec3::ZERO, 100);
        let left = crossings(&Solid::Difference([vec![hall], balls.clone()].concat()), &ray);
        prop_assert_eq!(&left[1..left.len() - 1], crossings(&Solid::Union(balls), &ray));
    }

    #[test]
    fn first_of_coincident_faces_in_scene_order_is_visible(
        boxes in prop::collection::vec((-5.0..5.0f64, 0.1..2.0f64), 1..40),
        x in -5.0..5.0f64,
    ) {
        // All fronts lie in one plane.
        let solids = boxes.iter().zip(0..).map(|(&(at, half), tag)| {
            placed(Primitive::Cube, DVec3::new(half, 1.0, half), DVec3::ZERO, DVec3::new(at, 0.0, -half), tag)
        });
        let first = boxes.iter().position(|(at, half)| (x - at).abs() < *half).map(|tag| tag as u32);
        let seen = crossings(&Solid::Union(solids.collect()), &Ray::new(DVec3::new(x, 0.3, 8.0), DVec3::NEG_Z));
        prop_assert_eq!(seen.first().map(|(_, tag)| *tag), first);
    }
}

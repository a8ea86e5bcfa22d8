//! Laws of boolean operations, along rays through random solids.

use anel::csg::{Hit, Primitive, QuadricCoefficients, Solid, Stack, Tree};
use anel::geometry::Ray;
use glam::DVec3;
use proptest::prelude::*;

use super::solids::{closed_solids, placed, rays, sheets, solids, vectors};

/// The distance of each crossing of a ray, and whether the ray enters there.
type Crossings = Vec<(f64, bool)>;

fn on(ray: &Ray, solid: &Solid) -> Crossings {
    let mut tree = Tree::default();
    let mut crossings = Vec::new();
    if let Some((root, _)) = tree.add(solid) {
        tree.finish();
        let is_inside = tree.contains(root, ray.origin, 0.0);
        tree.crossings(root, ray, None, f64::INFINITY, is_inside, &mut Stack::new(), |Hit { t, enters, .. }| {
            crossings.push((t, enters));
            true
        });
    }
    crossings
}

/// Whether two lists of crossings are equal up to rounding.
fn are_alike(one: &Crossings, other: &Crossings) -> bool {
    let alike = |((a, in_a), (b, in_b)): (&(f64, bool), &(f64, bool))| (a - b).abs() < 1e-9 && in_a == in_b;
    one.len() == other.len() && one.iter().zip(other).all(alike)
}

fn union(solids: &[&Solid]) -> Solid {
    Solid::Union(solids.iter().copied().cloned().collect())
}

fn intersection(solids: &[&Solid]) -> Solid {
    Solid::Intersection(solids.iter().copied().cloned().collect())
}

fn difference(solids: &[&Solid]) -> Solid {
    Solid::Difference(solids.iter().copied().cloned().collect())
}

/// Solids of one face each, with their complements.
fn with_complements() -> impl Strategy<Value = [Primitive; 2]> {
    let negative = |q: &QuadricCoefficients| QuadricCoefficients {
        squares: -q.squares,
        products: -q.products,
        linear: -q.linear,
        constant: -q.constant,
    };
    let half_spaces = (vectors(-1.0..1.0), -1.0..1.0f64).prop_map(|(normal, offset)| {
        let normal = normal.normalize_or(DVec3::Y);
        [Primitive::HalfSpace { normal, offset }, Primitive::HalfSpace { normal: -normal, offset: -offset }]
    });
    let quadrics = sheets().prop_map(move |sheet| match sheet {
        Primitive::Quadric(q) => [sheet, Primitive::Quadric(negative(&q))],
        _ => unreachable!("sheets are quadrics"),
    });
    prop_oneof![half_spaces, quadrics]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// Between two crossings a ray is inside exactly if the point in the middle is, by a test without rays; entries and
    /// exits alternate.
    #[test]
    fn crossings_agree_with_point_membership(solid in solids(), ray in rays()) {
        let crossings = on(&ray, &solid);
        let mut before = 0.0;
        for &(t, enters) in &crossings {
            let middle = (before + t) / 2.0;
            // A point this close to a face may be on either side of it.
            if t - before > 1e-6 {
                prop_assert_eq!(solid.contains(ray.at(middle)), !enters, "at {}", middle);
            }
            before = t;
        }
        let alternate = crossings.windows(2).all(|pair| pair[0].1 != pair[1].1 && pair[0].0 <= pair[1].0);
        prop_assert!(alternate, "{:?}", crossings);
        // Nothing changes after the last crossing.
        let inside = crossings.last().map_or_else(|| solid.contains(ray.origin), |(_, enters)| *enters);
        prop_assert_eq!(solid.contains(ray.at(before + 1.0)), inside);
    }

    #[test]
    fn ray_leaves_a_closed_solid_as_often_as_it_enters(solid in closed_solids(), ray in rays()) {
        let outside = Ray::new(ray.at(-100.0), ray.direction);
        let crossings = on(&outside, &solid);
        prop_assert!(crossings.len().is_multiple_of(2), "{:?}", crossings);
        prop_assert!(crossings.iter().enumerate().all(|(place, (_, enters))| *enters == place.is_multiple_of(2)));
        prop_assert!(crossings.is_sorted_by(|(a, _), (b, _)| a < b), "{:?}", crossings);
    }

    #[test]
    fn operands_commute(a in solids(), b in solids(), c in solids(), ray in rays()) {
        let alike = |one: Solid, other: Solid| are_alike(&on(&ray, &one), &on(&ray, &other));
        prop_assert!(alike(union(&[&a, &b, &c]), union(&[&c, &a, &b])), "union");
        prop_assert!(alike(intersection(&[&a, &b, &c]), intersection(&[&c, &a, &b])), "intersection");
        prop_assert!(alike(difference(&[&a, &b, &c]), difference(&[&a, &c, &b])), "difference");
    }

    #[test]
    fn operands_associate_and_distribute(a in solids(), b in solids(), c in solids(), ray in rays()) {
        let alike = |one: Solid, other: Solid| are_alike(&on(&ray, &one), &on(&ray, &other));
        let one_by_one = difference(&[&difference(&[&a, &b]), &c]);
        prop_assert!(alike(difference(&[&a, &union(&[&b, &c])]), one_by_one), "a − (b ∪ c) = (a − b) − c");
        let each = intersection(&[&difference(&[&a, &b]), &difference(&[&a, &c])]);
        prop_assert!(alike(difference(&[&a, &union(&[&b, &c])]), each), "a − (b ∪ c) = (a − b) ∩ (a − c)");
        let each = union(&[&difference(&[&a, &b]), &difference(&[&a, &c])]);
        prop_assert!(alike(difference(&[&a, &intersection(&[&b, &c])]), each), "a − (b ∩ c) = (a − b) ∪ (a − c)");
        let each = union(&[&intersection(&[&a, &b]), &intersection(&[&a, &c])]);
        prop_assert!(alike(intersection(&[&a, &union(&[&b, &c])]), each), "a ∩ (b ∪ c) = (a ∩ b) ∪ (a ∩ c)");
        let each = intersection(&[&union(&[&a, &b]), &union(&[&a, &c])]);
        prop_assert!(alike(union(&[&a, &intersection(&[&b, &c])]), each), "a ∪ (b ∩ c) = (a ∪ b) ∩ (a ∪ c)");
    }

    #[test]
    fn difference_and_intersection_make_up_the_whole(a in solids(), b in solids(), ray in rays()) {
        let (whole, other) = (on(&ray, &a), on(&ray, &b));
        let is_tie = |(t, _): &(f64, bool)| other.iter().any(|(u, _)| (t - u).abs() < 1e-6);
        prop_assume!(!whole.iter().any(is_tie));
        let (left, taken) = (on(&ray, &difference(&[&a, &b])), on(&ray, &intersection(&[&a, &b])));
        // At the common boundary the ray enters one part and leaves the other.
        let is_boundary = |(t, enters): &(f64, bool), of: &Crossings| {
            of.iter().any(|(u, other)| (t - u).abs() < 1e-9 && enters != other)
        };
        let mut parts: Crossings = left.iter().filter(|crossing| !is_boundary(crossing, &taken)).copied().collect();
        parts.extend(taken.iter().filter(|crossing| !is_boundary(crossing, &left)));
        parts.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        prop_assert!(are_alike(&parts, &whole), "{:?} and {:?} of {:?}", left, taken, whole);
    }

    #[test]
    fn difference_is_intersection_with_the_complement(
        a in solids(), pair in with_complements(), degrees in vectors(0.0..360.0), at in vectors(-1.0..1.0),
        ray in rays(),
    ) {
        let [b, not_b] = pair.map(|primitive| placed(primitive, DVec3::ONE, degrees, at));
        let (without, within) = (on(&ray, &difference(&[&a, &b])), on(&ray, &intersection(&[&a, &not_b])));
        prop_assert!(are_alike(&without, &within), "{:?} {:?}", without, within);
    }
}

//! How two solids lie to each other, proved by dividing space into cells.

use glam::{DMat3, DVec3};

use crate::csg::{Primitive, Solid};
use crate::geometry::Aabb;

/// How two solids lie to each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Placing {
    /// There is a gap between them.
    Apart,
    /// The first is inside the second, with a gap to its boundary.
    FirstInSecond,
    /// No point of the second is outside the first.
    SecondInFirst,
    /// They overlap, touch, or are so close to it that it takes too long to find out.
    Unclear,
}

/// The most cells that are looked at for one question.
const MAX_CELLS: usize = 200_000;

/// A cell that is smaller than this part of the first one is not divided: the solids touch there, or almost.
const SMALLEST_CELL: f64 = 1e-4;

/// A part of a solid that protrudes by less than this, relative to its coordinates, does so by rounding.
const ROUNDING: f64 = 1e-8;

/// Finds out how two solids lie to each other; `bounds` are their boxes.
pub(super) fn placing([first, second]: [&Solid; 2], bounds: [Aabb; 2]) -> Placing {
    let side = |solid: &Solid, centre, radius| side(solid, centre, radius);
    let both = bounds[0].intersection(bounds[1]);
    let never = |within, is_excluded: &dyn Fn(DVec3, f64) -> bool| all_cells(within, is_excluded);
    if both.is_empty()
        || never(both, &|at, radius| {
            side(first, at, radius) == Side::Outside || side(second, at, radius) == Side::Outside
        })
    {
        return Placing::Apart;
    }
    let inside = |inner: &Solid, outer: &Solid, within| {
        never(within, &|at, radius| side(inner, at, radius) == Side::Outside || side(outer, at, radius) == Side::Inside)
    };
    if first == second || convex_contains(first, bounds[1]) || inside(second, first, bounds[1]) {
        return Placing::SecondInFirst;
    }
    if inside(first, second, bounds[0]) { Placing::FirstInSecond } else { Placing::Unclear }
}

/// Whether `holds` is true for all of a box, given the centre and the radius of cells that cover it; false if that
/// cannot be shown.
fn all_cells(whole: Aabb, holds: &dyn Fn(DVec3, f64) -> bool) -> bool {
    if !whole.is_finite() {
        return false;
    }
    let smallest = SMALLEST_CELL * (whole.max - whole.min).length();
    let mut cells = vec![whole];
    for _ in 0..MAX_CELLS {
        let Some(cell) = cells.pop() else { return true };
        let half = (cell.max - cell.min) / 2.0;
        if holds(cell.centre(), half.length()) {
            continue;
        }
        if half.length() < smallest {
            return false;
        }
        let axis = half.max_position();
        let (mut lower, mut upper) = (cell, cell);
        lower.max[axis] = cell.centre()[axis];
        upper.min[axis] = cell.centre()[axis];
        cells.extend([lower, upper]);
    }
    false
}

/// Where a ball lies in relation to a solid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Inside,
    Outside,
    /// On both sides, or nearly.
    Unclear,
}

fn side(solid: &Solid, centre: DVec3, radius: f64) -> Side {
    let sides = |solids: &[Solid]| -> Vec<Side> { solids.iter().map(|solid| side(solid, centre, radius)).collect() };
    let any = |sides: &[Side], wanted| sides.contains(&wanted);
    let decide = |inside, outside| match (inside, outside) {
        (true, _) => Side::Inside,
        (_, true) => Side::Outside,
        _ => Side::Unclear,
    };
    match solid {
        Solid::Placed { primitive, scene_from_local, .. } => {
            let local_from_scene = scene_from_local.inverse();
            let [x, y, z] = [0, 1, 2].map(|axis| local_from_scene.matrix3.col(axis).length_squared());
            let (value, slack) =
                value(primitive, local_from_scene.transform_point3(centre), radius * (x + y + z).sqrt());
            decide(value < -slack, value > slack)
        }
        Solid::Union(solids) => {
            let sides = sides(solids);
            decide(any(&sides, Side::Inside), sides.iter().all(|&side| side == Side::Outside))
        }
        Solid::Intersection(solids) => {
            let sides = sides(solids);
            decide(sides.iter().all(|&side| side == Side::Inside), any(&sides, Side::Outside))
        }
        Solid::Difference(solids) => {
            let sides = sides(solids);
            let Some((&first, others)) = sides.split_first() else { return Side::Outside };
            decide(
                first == Side::Inside && others.iter().all(|&side| side == Side::Outside),
                first == Side::Outside || any(others, Side::Inside),
            )
        }
    }
}

/// Returns a value that is negative in the primitive and positive outside, and the most by which it changes over the
/// distance `radius`.
fn value(primitive: &Primitive, p: DVec3, radius: f64) -> (f64, f64) {
    let across = p.x.hypot(p.z);
    let capped = |side: f64| side.max(p.y.abs() - 1.0);
    let distance = match primitive {
        Primitive::Sphere => p.length() - 1.0,
        Primitive::HalfSpace { normal, offset } => normal.dot(p) - offset,
        Primitive::Cube => p.abs().max_element() - 1.0,
        Primitive::Cylinder => capped(across - 1.0),
        Primitive::Cone { bottom, top } => {
            let slope = (top - bottom) / 2.0;
            capped((across - bottom - slope * (p.y + 1.0)) / slope.hypot(1.0))
        }
        Primitive::Torus { tube } => (across - 1.0).hypot(p.y) - tube,
        Primitive::Quadric(q) => {
            let [xy, yz, zx] = q.products.to_array();
            let gradient = DMat3::from_cols(
                DVec3::new(2.0 * q.squares.x, xy, zx),
                DVec3::new(xy, 2.0 * q.squares.y, yz),
                DVec3::new(zx, yz, 2.0 * q.squares.z),
            ) * p
                + q.linear;
            let curvature = q.squares.length() + q.products.length();
            let products = DVec3::new(p.x * p.y, p.y * p.z, p.z * p.x);
            let value = q.squares.dot(p * p) + q.products.dot(products) + q.linear.dot(p) + q.constant;
            return (value, (gradient.length() + curvature * radius) * radius);
        }
    };
    (distance, radius)
}

/// Whether a solid that is certainly convex contains a box, up to rounding.
fn convex_contains(solid: &Solid, bounds: Aabb) -> bool {
    match solid {
        Solid::Placed { primitive: Primitive::Torus { .. } | Primitive::Quadric(_), .. } => false,
        Solid::Placed { primitive, scene_from_local, .. } => {
            let local_from_scene = scene_from_local.inverse();
            bounds.is_finite()
                && (0..8).all(|corner| {
                    let upper = |axis| corner >> axis & 1 == 1;
                    let corner = DVec3::select(glam::BVec3::new(upper(0), upper(1), upper(2)), bounds.max, bounds.min);
                    let local = local_from_scene.transform_point3(corner);
                    value(primitive, local, 0.0).0 <= ROUNDING * (1.0 + local.length())
                })
        }
        Solid::Intersection(solids) => !solids.is_empty() && solids.iter().all(|solid| convex_contains(solid, bounds)),
        Solid::Union(_) | Solid::Difference(_) => false,
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::csg::{Passes, Tree};
    use crate::scene::Scene;

    /// How the first two objects of a scene lie to each other.
    fn placed(objects: &str) -> Placing {
        let text = format!("Scene(camera: (eye: (0, 0, 9), look_at: (0, 0, 0)), objects: [{objects}])");
        let scene = Scene::parse(&text).expect("a scene");
        let mut tree = Tree::new(Passes::default());
        let [first, second] = [0, 1].map(|index| &scene.solids[index]);
        let bounds = [first, second].map(|solid| tree.add(solid).expect("not empty").1);
        placing([first, second], bounds)
    }

    #[test]
    fn solids_are_apart_inside_each_other_or_neither() {
        let cases = [
            ("Sphere(radius: 1), Sphere(radius: 1, centre: (1.5, 1.5, 0))", Placing::Apart),
            ("Sphere(radius: 1), Sphere(radius: 1, centre: (1.4, 1.4, 0))", Placing::Unclear),
            ("Sphere(radius: 1), Sphere(radius: 1, centre: (2, 0, 0))", Placing::Unclear),
            ("Sphere(radius: 1), Sphere(radius: 0.9)", Placing::SecondInFirst),
            ("Sphere(radius: 0.9), Sphere(radius: 1)", Placing::FirstInSecond),
            ("Sphere(radius: 1), Sphere(radius: 1)", Placing::SecondInFirst),
            // A bar with its ends flush in a pane.
            (
                "Box(min: (-1, -1, 0), max: (1, 1, 0.1)), Box(min: (-0.2, -1, 0), max: (0.2, 1, 0.1))",
                Placing::SecondInFirst,
            ),
            ("Box(min: (-0.2, -1, 0), max: (0.2, 1, 0.1)), Box(min: (-1, -1, 0), max: (1, 1, 0.1))", Placing::Unclear),
            ("HalfSpace(normal: (0, 1, 0)), Sphere(radius: 1, centre: (0, -1.1, 0))", Placing::SecondInFirst),
            ("HalfSpace(normal: (0, 1, 0)), Sphere(radius: 1, centre: (0, 1.1, 0))", Placing::Apart),
            ("HalfSpace(normal: (0, 1, 0)), HalfSpace(normal: (0, -1, 0), offset: -1)", Placing::Apart),
            ("HalfSpace(normal: (0, 1, 0)), HalfSpace(normal: (0, -1, 0))", Placing::Unclear),
            ("Torus(radius: 1, tube: 0.3), Cylinder(from: (0, -2, 0), to: (0, 2, 0), radius: 0.6)", Placing::Apart),
            (
                "Difference(of: [Sphere(radius: 1), Sphere(radius: 0.9)]), Cone(from: (0, -0.5, 0), to: (0, 0.5, 0), \
                 radius: 0.5)",
                Placing::Apart,
            ),
            (
                "Quadric(squares: (1, 4, 1), constant: -1), Quadric(squares: (1, 1, 1), linear: (2, 0, 0), constant: \
                 0.9)",
                Placing::Unclear,
            ),
        ];
        for (objects, expected) in cases {
            assert_eq!(placed(objects), expected, "{objects}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]
        #[test]
        fn cells_lie_on_the_side_that_is_claimed(
            kind in 0..7usize, at in prop::array::uniform3(-2.0..2.0f64), turn in prop::array::uniform3(-180.0..180.0f64),
            by in prop::array::uniform3(-1.0..1.0f64), radius in 0.01..1.0f64,
        ) {
            let solid = ["Sphere(radius: 1", "HalfSpace(normal: (0, 1, 0)", "Box(min: (-1, -1, -1), max: (1, 1, 1)",
                "Cylinder(from: (0, -1, 0), to: (0, 1, 0), radius: 1", "Cone(from: (0, -1, 0), to: (0, 1, 0), radius: 1",
                "Torus(radius: 1, tube: 0.4", "Quadric(squares: (1, -1, 2), products: (1, 0, 0.5), constant: -0.5"][kind];
            let text = format!("Scene(camera: (eye: (0, 0, 9), look_at: (0, 0, 0)), objects: [Difference(of: [{solid}, \
                transform: [Scale((1, 0.5, 2)), Rotate(({:?}, {:?}, {:?}))]), Sphere(radius: 0.7)])])", turn[0], turn[1], turn[2]);
            let scene = Scene::parse(&text).expect("a scene");
            let (centre, by) = (DVec3::from(at), DVec3::from(by));
            let point = centre + by.normalize_or_zero() * radius * by.length().min(1.0);
            let contains = scene.solids[0].contains(point);
            match side(&scene.solids[0], centre, radius) {
                Side::Inside => prop_assert!(contains),
                Side::Outside => prop_assert!(!contains),
                Side::Unclear => {}
            }
        }
    }
}

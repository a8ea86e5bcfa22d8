//! Nanoseconds of the tracer's parts, one by one: `cargo bench --bench kernels`, or a part of their names behind `--`.
//!
//! Each is measured with 1,024 random rays, the same ones every time, so that no branch is learnt by heart; the figure
//! of an item is that of a ray. The figures depend on the computer, which must be otherwise idle.

use anel::csg::{MaterialTag, Passes, Primitive, QuadricCoefficients, RootId, Solid, Stack, Tree};
use anel::geometry::{Aabb, BoxFrame, Boxes, Ray, WIDTH};
use anel::picture::{Quality, Size};
use anel::scene::Scene;
use anel::tracer::{Scratch, Tracer};
use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use fastrand::Rng;
use glam::{DAffine3, DQuat, DVec3};

const RAYS: usize = 1024;

fn main() {
    divan::main();
}

/// Rays from a sphere of radius 5 to points of the cube from −`reach` to `reach`: with 0.5 they all hit what is there.
fn rays(reach: f64) -> Vec<Ray> {
    let mut rng = Rng::with_seed(11);
    let mut place = |size: f64| DVec3::new(rng.f64() - 0.5, rng.f64() - 0.5, rng.f64() - 0.5) * (2.0 * size);
    let mut ray = |_| {
        let origin = place(1.0).normalize_or(DVec3::X) * 5.0;
        Ray::new(origin, (place(reach) - origin).normalize())
    };
    (0..RAYS).map(&mut ray).collect()
}

fn placed(primitive: Primitive, scene_from_local: DAffine3) -> Solid {
    Solid::Placed { primitive, scene_from_local, tag: MaterialTag(0) }
}

/// A ball in a cube of balls that overlap.
fn ball(number: usize, count: usize) -> Solid {
    let side = (count as f64).cbrt().ceil();
    let at = |stride: f64| (number as f64 / stride).floor() % side;
    let centre = (DVec3::new(at(1.0), at(side), at(side * side)) + 0.5) * (2.0 / side) - 1.0;
    placed(Primitive::Sphere, DAffine3::from_translation(centre) * DAffine3::from_scale(DVec3::splat(1.2 / side)))
}

fn tree(solid: &Solid) -> (Tree, RootId) {
    let mut tree = Tree::new(Passes::default());
    let (root, _) = tree.add(solid).expect("it is not empty");
    tree.finish();
    (tree, root)
}

/// Measures the nearest crossing of a solid.
fn nearest(bencher: Bencher<'_, '_>, solid: &Solid, reach: f64) {
    let ((tree, root), rays, mut stack) = (tree(solid), rays(reach), Stack::new());
    bencher.counter(ItemsCount::new(RAYS)).bench_local(|| {
        for ray in &rays {
            black_box(tree.nearest(root, black_box(ray), None, f64::INFINITY, false, &mut stack));
        }
    });
}

/// The primitives by name: under a turn, except those that are stored along the axes.
fn primitive(name: &str) -> Solid {
    let turn = DAffine3::from_quat(DQuat::from_rotation_x(0.4) * DQuat::from_rotation_z(0.7));
    let long = turn * DAffine3::from_scale(DVec3::new(1.0, 0.8, 1.2));
    let hyperboloid = QuadricCoefficients {
        squares: DVec3::new(1.0, -0.5, 1.0),
        products: DVec3::ZERO,
        linear: DVec3::ZERO,
        constant: -0.3,
    };
    match name {
        "ball" => placed(Primitive::Sphere, DAffine3::IDENTITY),
        "ellipsoid" => placed(Primitive::Sphere, long),
        "half-space" => placed(Primitive::HalfSpace { normal: DVec3::Y, offset: 0.0 }, turn),
        "box along the axes" => placed(Primitive::Cube, DAffine3::IDENTITY),
        "box" => placed(Primitive::Cube, turn),
        "cylinder" => placed(Primitive::Cylinder, turn),
        "cone" => placed(Primitive::Cone { bottom: 1.0, top: 0.3 }, turn),
        "torus" => placed(Primitive::Torus { tube: 0.3 }, turn),
        "quadric" => placed(Primitive::Quadric(hyperboloid), turn),
        other => unreachable!("no primitive is called {other}"),
    }
}

const PRIMITIVES: [&str; 9] =
    ["ball", "ellipsoid", "half-space", "box along the axes", "box", "cylinder", "cone", "torus", "quadric"];

#[divan::bench(args = PRIMITIVES)]
fn primitive_hit(bencher: Bencher<'_, '_>, name: &str) {
    nearest(bencher, &primitive(name), 0.2);
}

#[divan::bench(args = PRIMITIVES)]
fn primitive_nearly_missed(bencher: Bencher<'_, '_>, name: &str) {
    nearest(bencher, &primitive(name), 2.0);
}

/// A polyhedron of so many half-spaces.
#[divan::bench(args = [6, 20])]
fn convex_polyhedron(bencher: Bencher<'_, '_>, sides: usize) {
    let mut rng = Rng::with_seed(5);
    let mut side = |_| {
        let normal = DVec3::new(rng.f64() - 0.5, rng.f64() - 0.5, rng.f64() - 0.5).normalize_or(DVec3::X);
        placed(Primitive::HalfSpace { normal, offset: 0.7 }, DAffine3::IDENTITY)
    };
    nearest(bencher, &Solid::Intersection((0..sides).map(&mut side).collect()), 0.7);
}

#[divan::bench(args = [2, 8, 64])]
fn merge_union(bencher: Bencher<'_, '_>, operands: usize) {
    nearest(bencher, &Solid::Union((0..operands).map(|number| ball(number, operands)).collect()), 1.0);
}

#[divan::bench(args = [2, 8, 64])]
fn merge_difference(bencher: Bencher<'_, '_>, operands: usize) {
    let cube = placed(Primitive::Cube, DAffine3::IDENTITY);
    let balls = (1..operands).map(|number| ball(number, operands));
    nearest(bencher, &Solid::Difference(std::iter::once(cube).chain(balls).collect()), 1.0);
}

/// Tori and a ball, since an intersection of convex primitives alone is not merged.
#[divan::bench(args = [2, 4])]
fn merge_intersection(bencher: Bencher<'_, '_>, operands: usize) {
    let torus = |number: usize| {
        let turn = DAffine3::from_rotation_y(number as f64);
        placed(Primitive::Torus { tube: 0.9 }, turn)
    };
    let ball = placed(Primitive::Sphere, DAffine3::IDENTITY);
    let solids = std::iter::once(ball).chain((1..operands).map(torus));
    nearest(bencher, &Solid::Intersection(solids.collect()), 0.5);
}

/// Eight boxes tested by a ray at once, with the copy of the ray that they need.
#[divan::bench]
fn eight_boxes(bencher: Bencher<'_, '_>) {
    let (rays, mut rng) = (rays(1.0), Rng::with_seed(3));
    let whole = Aabb { min: DVec3::NEG_ONE, max: DVec3::ONE };
    let frame = BoxFrame::new(whole);
    let mut boxes = Boxes::NONE;
    for _ in 0..WIDTH {
        let min = DVec3::new(rng.f64(), rng.f64(), rng.f64()) - 1.0;
        boxes.add(Aabb { min, max: min + 0.6 }, &frame);
    }
    bencher.counter(ItemsCount::new(RAYS)).bench_local(|| {
        for ray in &rays {
            let single = frame.ray(black_box(ray));
            let range = [single.place(0.0), single.place(10.0)];
            black_box(single.meets(&boxes, range, &mut [0.0; WIDTH]));
        }
    });
}

/// Traces a picture of `solids`; the figure is that of a ray.
fn picture(bencher: Bencher<'_, '_>, (solids, material): (&str, &str), lights: usize) {
    let lights = "Point(position: (6, 9, 5), colour: (0.5, 0.5, 0.5)),".repeat(lights);
    let text = format!(
        r#"Scene(
    camera: (eye: (2.6, 2.4, 3.4), look_at: (0, 0, 0), field_of_view: 30),
    lights: [{lights}],
    materials: {{"only": ({material})}},
    solids: {{"all": {solids}}},
    objects: [Use(solid: "all", material: "only")],
)"#
    );
    let scene = Scene::parse(&text).unwrap_or_else(|error| panic!("{error}"));
    let size = Size::new(32, 32).expect("a small picture");
    let tracer = Tracer::new(&scene, size, Quality::default());
    let (mut scratch, mut pixels) = (Scratch::default(), Vec::new());
    tracer.trace(0..size.pixels(), &mut scratch, &mut pixels);
    let count = ItemsCount::new(scratch.rays.total());
    bencher.counter(count).bench_local(|| {
        pixels.clear();
        tracer.trace(0..size.pixels(), &mut scratch, &mut pixels);
        black_box(&pixels);
    });
}

const FLOOR: &str = "HalfSpace(normal: (0, 1, 0), offset: 0)";

/// The walk through the hierarchy, with a grey material and one light.
#[divan::bench(args = [10, 1_000, 60_000])]
fn hierarchy_of_balls(bencher: Bencher<'_, '_>, count: usize) {
    let side = (count as f64).cbrt().round() as usize;
    let (step, row) = (2.0 / side as f64, |of: &str, axis: [f64; 3]| {
        format!("Repeat(count: {side}, step: [Translate(({}, {}, {}))], of: {of})", axis[0], axis[1], axis[2])
    });
    let corner = step / 2.0 - 1.0;
    let ball = format!("Sphere(centre: ({corner}, {corner}, {corner}), radius: {})", 0.45 * step);
    let all = row(&row(&row(&ball, [step, 0.0, 0.0]), [0.0, step, 0.0]), [0.0, 0.0, step]);
    picture(bencher, (&all, "colour: (0.6, 0.6, 0.6)"), 1);
}

/// A floor that shines, without shadows of anything else.
#[divan::bench(args = [1, 4])]
fn shade_by_lights(bencher: Bencher<'_, '_>, lights: usize) {
    picture(bencher, (FLOOR, "colour: (0.6, 0.6, 0.6), ks: 0.3, n: 20"), lights);
}

#[divan::bench(args = ["20", "20.5"])]
fn shade_with_exponent(bencher: Bencher<'_, '_>, exponent: &str) {
    picture(bencher, (FLOOR, &format!("colour: (0.6, 0.6, 0.6), ks: 0.3, n: {exponent}")), 1);
}

/// The queue of secondary rays: each hit of a mirror sends one, each of glass two.
#[divan::bench(args = ["ks: 0.9", "ks: 0.1, kt: 0.9, ior: 1.5"])]
fn queue_of_rays(bencher: Bencher<'_, '_>, material: &str) {
    let balls = "Union(of: [Sphere(centre: (-0.6, 0, 0), radius: 0.5), Sphere(centre: (0.6, 0, 0), radius: 0.5)])";
    picture(bencher, (balls, &format!("colour: (0.9, 0.9, 0.9), {material}")), 1);
}

//! The time of each kernel of the tracer by itself: `cargo bench --bench kernels`, or a part of the kernels' names
//! behind `--`.
//!
//! An iteration is one ray, so a time in the table is the time of a ray. In `shade` and `queue` it is one pixel: a
//! primary ray with the rays that follow from it, which the items count. A sample is 1,024 random rays or pixels. The
//! next sample has others, so that no branch is learnt by heart; the next run has the same. The figures depend on the
//! computer, which must be otherwise idle; none of them is asserted.

use std::fmt;

use anel::csg::{Hit, MaterialTag, Pass, Passes, Primitive, QuadricCoefficients, RootId, Solid, Stack, Tree};
use anel::geometry::{Aabb, BoxFrame, Boxes, Ray, WIDTH, rotation};
use anel::picture::{Quality, Size};
use anel::scene::{Camera, Light, Material, Scene};
use anel::tracer::{Scratch, Tracer};
use divan::counter::ItemsCount;
use divan::{Bencher, Divan};
use fastrand::Rng;
use glam::{DAffine3, DMat3, DVec3};

const SAMPLE_SIZE: u32 = 1024;

const SEED: u64 = 1;

fn main() {
    Divan::default().sample_size(SAMPLE_SIZE).config_with_args().main();
}

/// A ray that meets boxes, and one that walks through a hierarchy of them.
mod hierarchy {
    use super::*;

    #[divan::bench]
    fn eight_boxes(bencher: Bencher<'_, '_>) {
        const SIDE: f64 = 0.6;
        let mut rng = Rng::with_seed(SEED);
        let frame = BoxFrame::new(Aabb { min: DVec3::NEG_ONE, max: DVec3::ONE });
        let mut boxes = Boxes::NONE;
        for _ in 0..WIDTH {
            let centre = point(&mut rng, 1.0 - SIDE / 2.0);
            boxes.add(Aabb { min: centre - SIDE / 2.0, max: centre + SIDE / 2.0 }, &frame);
        }
        let copy = || {
            let single = frame.ray(&ray(&mut rng, 1.0));
            (single, [0.0, 2.0 * DISTANCE].map(|t| single.place(t)))
        };
        bencher.counter(ItemsCount::new(1u32)).with_inputs(copy).bench_local_refs(|(single, range)| {
            let mut entry = [0.0; WIDTH];
            (single.meets(&boxes, *range, &mut entry), entry)
        });
    }

    /// Primary rays among balls that fill a cube, without lights.
    #[divan::bench(args = [10, 1_000, 60_000])]
    fn balls(bencher: Bencher<'_, '_>, count: u32) {
        let mut rng = Rng::with_seed(SEED);
        let radius = 0.9 / f64::from(count).cbrt();
        let balls = (0..count).map(|_| ball(point(&mut rng, 1.0), radius)).collect();
        pixels(bencher, scene(DVec3::new(2.6, 2.4, 3.4), Vec::new(), Material::default(), balls), Quality::default());
    }
}

/// The first crossing of a primitive's boundary.
mod primitive {
    use super::*;

    #[divan::bench(args = PRIMITIVES)]
    fn hit(bencher: Bencher<'_, '_>, primitive: &Named) {
        nearest(bencher, &primitive.solid(), true);
    }

    #[divan::bench(args = PRIMITIVES)]
    fn miss(bencher: Bencher<'_, '_>, primitive: &Named) {
        nearest(bencher, &primitive.solid(), false);
    }

    /// Each arm of the compiled shapes, under its name.
    const PRIMITIVES: [Named; 9] = [
        Named("ball", Primitive::Sphere, ALONG_AXES),
        Named("ellipsoid", Primitive::Sphere, TURNED),
        Named("half-space", Primitive::HalfSpace { normal: DVec3::Y, offset: 0.0 }, TURNED),
        Named("block", Primitive::Cube, ALONG_AXES),
        Named("cube", Primitive::Cube, TURNED),
        Named("cylinder", Primitive::Cylinder, TURNED),
        Named("cone", Primitive::Cone { bottom: 1.0, top: 0.3 }, TURNED),
        Named("torus", Primitive::Torus { tube: 0.3 }, TURNED),
        Named("quadric", Primitive::Quadric(HYPERBOLOID), TURNED),
    ];

    /// Scale and rotation in degrees.
    type Placement = [DVec3; 2];

    const ALONG_AXES: Placement = [DVec3::ONE, DVec3::ZERO];
    const TURNED: Placement = [DVec3::new(1.0, 0.8, 1.2), DVec3::new(20.0, 0.0, 40.0)];

    /// x² − y² / 2 + z² ≤ 0.3, of one sheet.
    const HYPERBOLOID: QuadricCoefficients = QuadricCoefficients {
        squares: DVec3::new(1.0, -0.5, 1.0),
        products: DVec3::ZERO,
        linear: DVec3::ZERO,
        constant: -0.3,
    };

    struct Named(&'static str, Primitive, Placement);

    impl Named {
        fn solid(&self) -> Solid {
            let &Self(_, primitive, [scale, degrees]) = self;
            placed(primitive, DAffine3::from_mat3(rotation(degrees) * DMat3::from_diagonal(scale)))
        }
    }

    impl fmt::Display for Named {
        fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str(self.0)
        }
    }
}

/// Compositions of balls around almost the same point: a ray that hits the result meets most of the balls, so most
/// operands are merged.
mod merge {
    use super::*;

    const COUNTS: [usize; 3] = [2, 8, 64];

    #[divan::bench(args = COUNTS)]
    fn union(bencher: Bencher<'_, '_>, operands: usize) {
        crossings(bencher, &Solid::Union(balls(operands)));
    }

    #[divan::bench(args = COUNTS)]
    fn intersection(bencher: Bencher<'_, '_>, operands: usize) {
        crossings(bencher, &Solid::Intersection(balls(operands)));
    }

    #[divan::bench(args = COUNTS)]
    fn difference(bencher: Bencher<'_, '_>, operands: usize) {
        let mut solids = vec![ball(DVec3::ZERO, 1.2)];
        solids.extend(balls(operands - 1));
        crossings(bencher, &Solid::Difference(solids));
    }

    fn balls(count: usize) -> Vec<Solid> {
        let mut rng = Rng::with_seed(SEED);
        (0..count).map(|_| ball(point(&mut rng, 0.1), 1.0)).collect()
    }

    /// Visits all crossings of the boundary. Without convex spans, so that intersections of balls are merged, too.
    fn crossings(bencher: Bencher<'_, '_>, solid: &Solid) {
        let (tree, root) = compiled(solid, Passes::default().without(Pass::ConvexSpans));
        let mut stack = Stack::new();
        let inputs = rays_that(true, &tree, root, solid);
        bencher.counter(ItemsCount::new(1u32)).with_inputs(inputs).bench_local_refs(|ray| {
            let mut last: Option<Hit> = None;
            tree.crossings(root, ray, None, f64::INFINITY, false, &mut stack, |hit| {
                last = Some(hit);
                true
            });
            last
        });
    }
}

/// Polyhedra around a ball, each face a half-space.
mod convex {
    use super::*;

    const FACES: [u32; 2] = [6, 20];

    #[divan::bench(args = FACES)]
    fn hit(bencher: Bencher<'_, '_>, faces: u32) {
        nearest(bencher, &polyhedron(faces), true);
    }

    #[divan::bench(args = FACES)]
    fn miss(bencher: Bencher<'_, '_>, faces: u32) {
        nearest(bencher, &polyhedron(faces), false);
    }

    /// The faces touch the ball of radius 1 at points of a spiral, which are spread evenly.
    fn polyhedron(faces: u32) -> Solid {
        const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;
        let face = |number: u32| {
            let y = 1.0 - f64::from(2 * number + 1) / f64::from(faces);
            let (sine, cosine) = (f64::from(number) * GOLDEN_ANGLE).sin_cos();
            let across = (1.0 - y * y).sqrt();
            let normal = DVec3::new(across * cosine, y, across * sine).normalize();
            placed(Primitive::HalfSpace { normal, offset: 1.0 }, DAffine3::IDENTITY)
        };
        Solid::Intersection((0..faces).map(face).collect())
    }
}

/// The equation on a floor that fills the picture and that every light reaches; no secondary rays.
mod shade {
    use super::*;

    const MATT: Material =
        Material { colour: DVec3::ONE, ka: 1.0, kd: 0.8, ks: 0.0, kt: DVec3::ZERO, n: 1.0, ior: 1.0 };

    #[divan::bench(args = [1, 4])]
    fn lights(bencher: Bencher<'_, '_>, count: u32) {
        floor(bencher, count, MATT);
    }

    #[divan::bench]
    fn whole_exponent(bencher: Bencher<'_, '_>) {
        floor(bencher, 1, Material { ks: 0.3, n: 50.0, ..MATT });
    }

    #[divan::bench]
    fn real_exponent(bencher: Bencher<'_, '_>) {
        floor(bencher, 1, Material { ks: 0.3, n: 50.5, ..MATT });
    }

    fn floor(bencher: Bencher<'_, '_>, lights: u32, material: Material) {
        let light = |number: u32| {
            let position = DVec3::new(f64::from(number) - 2.0, 3.0, -3.0);
            Light::Point { position, colour: DVec3::splat(0.25) }
        };
        let scene = scene(EYE, (0..lights).map(light).collect(), material, vec![layer(DVec3::Y, 0.0)]);
        pixels(bencher, scene, Quality { max_depth: 1, ..Quality::default() });
    }
}

/// Trees of rays between planes without end, which are the same for every pixel; no lights.
mod queue {
    use super::*;

    /// Two mirrors face each other: one ray waits at a time.
    #[divan::bench]
    fn mirror(bencher: Bencher<'_, '_>) {
        let mirrors = vec![layer(DVec3::Y, 0.0), layer(DVec3::NEG_Y, -2.0 * EYE.y)];
        let material = Material { ks: 0.9, ..Material::default() };
        pixels(bencher, scene(EYE, Vec::new(), material, mirrors), Quality::default());
    }

    /// Three plates of glass: a ray is reflected and refracted at each of six faces.
    #[divan::bench]
    fn glass(bencher: Bencher<'_, '_>) {
        let plate = |number: u32| {
            let top = -f64::from(number);
            Solid::Intersection(vec![layer(DVec3::Y, top), layer(DVec3::NEG_Y, 0.5 - top)])
        };
        let material = Material { ks: 0.2, kt: DVec3::splat(0.8), ior: 1.5, ..Material::default() };
        pixels(bencher, scene(EYE, Vec::new(), material, (0..3).map(plate).collect()), Quality::default());
    }
}

/// How far from the origin rays start.
const DISTANCE: f64 = 5.0;

/// Looks down to the origin, so that every ray meets the plane y = 0.
const EYE: DVec3 = DVec3::new(0.0, 3.0, 3.0);

/// A random point of the cube from −`reach` to `reach`.
fn point(rng: &mut Rng, reach: f64) -> DVec3 {
    DVec3::from([0, 1, 2].map(|_| (2.0 * rng.f64() - 1.0) * reach))
}

/// A random ray from afar to a point of the cube from −`reach` to `reach`.
fn ray(rng: &mut Rng, reach: f64) -> Ray {
    let origin = point(rng, 1.0).normalize_or(DVec3::X) * DISTANCE;
    Ray::new(origin, (point(rng, reach) - origin).normalize())
}

/// Random rays that start outside a solid, and hit it or pass it closely.
fn rays_that(hit: bool, tree: &Tree, root: RootId, solid: &Solid) -> impl FnMut() -> Ray {
    const REACH: f64 = 1.5;
    let (mut rng, mut stack) = (Rng::with_seed(SEED), Stack::new());
    move || loop {
        let ray = ray(&mut rng, REACH);
        let is_hit = tree.nearest(root, &ray, None, f64::INFINITY, false, &mut stack).is_some();
        if is_hit == hit && !solid.contains(ray.origin) {
            return ray;
        }
    }
}

fn placed(primitive: Primitive, scene_from_local: DAffine3) -> Solid {
    Solid::Placed { primitive, scene_from_local, tag: MaterialTag(0) }
}

fn ball(centre: DVec3, radius: f64) -> Solid {
    placed(Primitive::Sphere, DAffine3 { matrix3: DMat3::from_diagonal(DVec3::splat(radius)), translation: centre })
}

fn layer(normal: DVec3, offset: f64) -> Solid {
    placed(Primitive::HalfSpace { normal, offset }, DAffine3::IDENTITY)
}

fn compiled(solid: &Solid, passes: Passes) -> (Tree, RootId) {
    let mut tree = Tree::new(passes);
    let (root, _) = tree.add(solid).expect("the solid is not empty");
    tree.finish();
    (tree, root)
}

/// Measures the search for the first crossing of a solid's boundary, by rays that hit the solid or by rays that miss.
fn nearest(bencher: Bencher<'_, '_>, solid: &Solid, hit: bool) {
    let (tree, root) = compiled(solid, Passes::default());
    let mut stack = Stack::new();
    bencher
        .counter(ItemsCount::new(1u32))
        .with_inputs(rays_that(hit, &tree, root, solid))
        .bench_local_refs(|ray| tree.nearest(root, ray, None, f64::INFINITY, false, &mut stack));
}

fn scene(eye: DVec3, lights: Vec<Light>, material: Material, solids: Vec<Solid>) -> Scene {
    Scene {
        camera: Camera { eye, look_at: DVec3::ZERO, up: DVec3::Y, field_of_view: 30.0 },
        background: DVec3::ONE,
        ambient: DVec3::splat(0.1),
        lights,
        materials: vec![material],
        names: vec![String::new()],
        solids,
    }
}

/// Measures random pixels of a picture in which every pixel takes the same number of rays.
fn pixels(bencher: Bencher<'_, '_>, scene: Scene, quality: Quality) {
    let size = Size::new(256, 256).expect("a size within the limits");
    let tracer = Tracer::new(&scene, size, quality);
    let rays_of = |pixel: u32| {
        let (mut scratch, mut colours) = (Scratch::default(), Vec::new());
        tracer.trace(pixel..pixel + 1, &mut scratch, &mut colours);
        scratch.rays.total()
    };
    let rays = rays_of(0);
    assert!((0..size.pixels()).all(|pixel| rays_of(pixel) == rays), "every pixel takes {rays} rays");
    let (mut scratch, mut colours, mut rng) = (Scratch::default(), Vec::new(), Rng::with_seed(SEED));
    bencher.counter(ItemsCount::new(rays)).with_inputs(|| rng.u32(0..size.pixels())).bench_local_values(|pixel| {
        colours.clear();
        tracer.trace(pixel..pixel + 1, &mut scratch, &mut colours);
        colours.first().copied()
    });
}

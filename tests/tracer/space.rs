//! The paths of rays, and the messages they cause if the scene's space is shared (the article, §5).

use anel::picture::{Quality, Size};
use anel::scene::{SMALL_BUILT_IN, Scene};
use anel::space::{Partition, traffic};
use anel::tracer::{Path, RayCounts, RayKind, Scratch, Tracer};

fn tracer(text: &str, width: u32, height: u32) -> Tracer {
    let scene = Scene::parse(text).unwrap_or_else(|error| panic!("{error}"));
    Tracer::new(&scene, Size::new(width, height).expect("a size"), Quality::default())
}

fn built_in() -> impl Iterator<Item = (&'static str, Tracer)> {
    SMALL_BUILT_IN.iter().map(|&(name, text)| (name, tracer(text, 60, 45)))
}

fn paths(tracer: &Tracer, scratch: &mut Scratch) -> Vec<Path> {
    let mut paths = Vec::new();
    tracer.paths(0..tracer.size().pixels(), scratch, |path| paths.push(path));
    paths
}

#[test]
fn every_ray_has_a_path_and_observing_changes_nothing() {
    for (name, tracer) in built_in() {
        let pixels = 0..tracer.size().pixels();
        let (mut alone, mut watched) = (Scratch::default(), Scratch::default());
        let (mut picture, mut after) = (Vec::new(), Vec::new());
        tracer.trace(pixels.clone(), &mut alone, &mut picture);
        let mut counts = RayCounts::default();
        for path in paths(&tracer, &mut watched) {
            *match path.kind {
                RayKind::Primary => &mut counts.primary,
                RayKind::Shadow => &mut counts.shadow,
                RayKind::Reflected => &mut counts.reflected,
                RayKind::Refracted => &mut counts.refracted,
            } += 1;
        }
        assert_eq!((counts, watched.rays), (alone.rays, alone.rays), "{name}");
        tracer.trace(pixels, &mut watched, &mut after);
        assert_eq!(picture, after, "{name}");
    }
}

#[test]
fn path_starts_at_the_end_of_its_parent() {
    for (name, tracer) in built_in() {
        // The paths of the current sample.
        let mut sample: Vec<Path> = Vec::new();
        for path in paths(&tracer, &mut Scratch::default()) {
            assert!(path.to >= 0.0, "{name}: {path:?}");
            let is_shadow = path.kind == RayKind::Shadow;
            match path.from {
                None => sample.clear(),
                Some(from) => assert_eq!(sample[from as usize].level + u32::from(!is_shadow), path.level, "{name}"),
            }
            assert_eq!(path.kind == RayKind::Primary, sample.is_empty(), "{name}: {path:?}");
            if let Some(before) = path.from.map(|from| sample[from as usize]) {
                // A path through hidden boundaries is computed in pieces.
                let off = (before.ray.at(before.to) - path.ray.origin).length();
                assert!(off < 1e-12, "{name}: {path:?} {off:e} after {before:?}");
            }
            if !is_shadow {
                sample.push(path);
            }
        }
    }
}

/// The test of a shadow ray stops at any blocking solid; its path must still end at the nearest.
#[test]
fn end_of_a_path_does_not_depend_on_other_rays() {
    for (name, tracer) in built_in() {
        let together = paths(&tracer, &mut Scratch::default());
        let mut together = together.iter();
        for pixel in 0..tracer.size().pixels() {
            tracer.paths(pixel..pixel + 1, &mut Scratch::default(), |path| {
                assert_eq!(
                    Some(path.to.to_bits()),
                    together.next().map(|other| other.to.to_bits()),
                    "{name}: {path:?}"
                );
            });
        }
        assert!(together.next().is_none());
    }
}

/// A lamp 10 above a floor, with a pane of glass and lids between them: the path ends at a lid, not at the glass.
#[test]
fn path_of_a_shadow_ray_ends_at_its_light_or_at_the_nearest_blocker() {
    let ends = |objects: &str| {
        let tracer = tracer(
            &format!(
                r#"(camera: (eye: (0, 1, 0), look_at: (0, 0, 0), up: (1, 0, 0)),
                    lights: [Point(position: (0, 10, 0))],
                    materials: {{"floor": (), "glass": (kt: 0.5, kd: 0)}},
                    objects: [HalfSpace(normal: (0, 1, 0), material: "floor"), {objects}])"#
            ),
            1,
            1,
        );
        let paths = paths(&tracer, &mut Scratch::default());
        let shadows = paths.iter().filter(|path| path.kind == RayKind::Shadow);
        shadows.map(|path| (path.to * 1000.0).round() / 1000.0).collect::<Vec<_>>()
    };
    let glass = r#"Box(min: (-1, 2, -1), max: (1, 3, 1), material: "glass"),"#;
    let lids = r#"Box(min: (-1, 7, -1), max: (1, 8, 1), material: "floor"),
                  Box(min: (-1, 5, -1), max: (1, 6, 1), material: "floor"),"#;
    assert_eq!(ends(""), [10.0]);
    assert_eq!(ends(glass), [10.0]);
    assert_eq!(ends(&format!("{lids}{glass}")), [5.0]);
}

/// One ray passes two cells, is reflected by a mirror that every owner has, and returns through both cells.
#[test]
fn messages_of_a_ray_and_its_reflection_are_counted() {
    let balls: Vec<_> = [(2, 2), (-2, -2), (2, -2)]
        .iter()
        .flat_map(|(y, z)| [-8, 8].map(|x| format!(r#"Sphere(centre: ({x}, {y}, {z}), radius: 1, material: "m"),"#)))
        .collect();
    let text = format!(
        r#"(camera: (eye: (-20, 0.5, 0.5), look_at: (0, 0.5, 0.5)), materials: {{"m": (ks: 1)}},
            objects: [{} HalfSpace(normal: (-1, 0, 0), offset: -12, material: "m")])"#,
        balls.concat()
    );
    let tracer = tracer(&text, 1, 1);
    let one = traffic(&tracer, 2, Partition::Runs, 1);
    assert_eq!((one.leaves, one.rays, one.staying), (6, 2, 0));
    assert_eq!((one.messages, one.answers, one.most), (2, 1, 1));
    assert_eq!((one.shares.as_slice(), one.imbalance()), ([0.5, 0.5].as_slice(), 1.0));
    // Two of four owners have no work.
    assert!((traffic(&tracer, 4, Partition::Runs, 1).imbalance() - 2.0).abs() < 1e-12);
}

#[test]
fn single_owner_needs_no_messages() {
    for (name, tracer) in built_in() {
        let mut scratch = Scratch::default();
        let rays = paths(&tracer, &mut scratch).len() as u64;
        for how in [Partition::Runs, Partition::RoundRobin] {
            let alone = traffic(&tracer, 1, how, 1);
            assert_eq!((alone.messages, alone.answers, alone.most), (0, 0, 0), "{name}");
            assert_eq!((alone.rays, alone.staying, alone.shares.as_slice()), (rays, rays, [1.0].as_slice()), "{name}");
        }
    }
}

#[test]
fn runs_of_neighbours_need_fewer_messages_than_round_robin() {
    for (name, tracer) in built_in() {
        for owners in [2, 8] {
            let [runs, round_robin] =
                [Partition::Runs, Partition::RoundRobin].map(|how| traffic(&tracer, owners, how, 1));
            assert!(runs.messages < round_robin.messages, "{name}: {runs:?} {round_robin:?}");
            for traffic in [&runs, &round_robin] {
                assert!(traffic.messages >= traffic.rays - traffic.staying, "{name}: {traffic:?}");
                assert!(traffic.answers <= traffic.rays - traffic.staying, "{name}: {traffic:?}");
                assert!((traffic.shares.iter().sum::<f64>() - 1.0).abs() < 1e-9, "{name}: {traffic:?}");
            }
        }
    }
}

#[test]
fn part_of_the_pixels_represents_all() {
    for (name, tracer) in built_in() {
        let [all, part] = [1, 7].map(|every| traffic(&tracer, 4, Partition::Runs, every));
        let near = |a: u64, b: u64| (a as f64 / b as f64 - 1.0).abs() < 0.15;
        assert!(near(part.rays, all.rays) && near(part.messages, all.messages), "{name}: {all:?} {part:?}");
    }
}

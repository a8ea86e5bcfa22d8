//! The built-in scenes, and the effect of compiling on them.

use super::povray_scenes::{Case, cases, enlarge};
use anel::csg::{MaterialTag, Pass, Passes, Primitive, Solid};
use anel::export::to_pov;
use anel::picture::{Colour, Quality, Size};
use anel::scene::{BUILT_IN, SMALL_BUILT_IN, Scene};
use anel::tracer::{RayKind, Scratch, Tracer};
use glam::{DAffine3, DQuat, DVec3};
use proptest::prelude::*;

fn parse(name: &str, text: &str) -> Scene {
    Scene::parse(text).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn pixels(scene: &Scene) -> Vec<Colour> {
    let size = Size::new(80, 60).expect("small");
    let mut pixels = Vec::new();
    let tracer = Tracer::new(scene, size, Quality::default());
    tracer.trace(0..size.pixels(), &mut Scratch::default(), &mut pixels);
    pixels
}

fn leaves(solid: &Solid, visit: &mut impl FnMut(&Primitive)) {
    placed(solid, &mut |primitive, _| visit(primitive));
}

fn tags(solid: &Solid, visit: &mut impl FnMut(MaterialTag)) {
    placed(solid, &mut |_, tag| visit(tag));
}

fn placed(solid: &Solid, visit: &mut impl FnMut(&Primitive, MaterialTag)) {
    match solid {
        Solid::Placed { primitive, tag, .. } => visit(primitive, *tag),
        Solid::Union(solids) | Solid::Intersection(solids) | Solid::Difference(solids) => {
            solids.iter().for_each(|solid| placed(solid, visit));
        }
    }
}

#[test]
fn built_in_scenes_show_many_colours_and_only_finite_ones() {
    for (name, text) in BUILT_IN {
        let pixels = pixels(&parse(name, text));
        let finite = pixels.iter().flatten().all(|channel| channel.is_finite() && *channel >= 0.0);
        assert!(finite, "{name} has a negative or infinite pixel");
        let mut colours: Vec<_> = pixels.iter().map(|pixel| pixel.map(|channel| (channel * 64.0) as u32)).collect();
        colours.sort_unstable();
        colours.dedup();
        assert!(colours.len() > 100, "{name} has only {} colours", colours.len());
    }
}

/// The bits of all colours in linear light, as one number (Fowler, Noll and Vo, FNV-1a).
fn hash(pixels: &[Colour]) -> u64 {
    let bytes = pixels.iter().flatten().flat_map(|channel| channel.to_bits().to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

/// A change of any bit of any pixel is a change of the pictures: is it meant, then put the text into the file.
#[test]
fn pictures_have_the_same_bits_on_every_computer() {
    let lines = BUILT_IN.iter().map(|(name, text)| format!("{name} {:016x}\n", hash(&pixels(&parse(name, text)))));
    let found: String = lines.collect();
    assert_eq!(found, include_str!("golden/pictures.txt"), "\n{found}");
}

#[test]
fn scene_of_the_article_has_ten_objects_and_two_lights() {
    let (name, text) = BUILT_IN[0];
    let scene = parse(name, text);
    assert_eq!((scene.solids.len(), scene.lights.len()), (10, 2));
    assert!(scene.materials.iter().any(|material| material.kt.max_element() > 0.5), "a glass");
    assert!(scene.materials.iter().any(|material| material.ks > 0.5), "a mirror");
}

#[test]
fn every_primitive_is_used_by_a_scene() {
    let mut used = [false; 7];
    for (name, text) in BUILT_IN {
        for solid in &parse(name, text).solids {
            leaves(solid, &mut |primitive| {
                used[match primitive {
                    Primitive::Sphere => 0,
                    Primitive::HalfSpace { .. } => 1,
                    Primitive::Cube => 2,
                    Primitive::Cylinder => 3,
                    Primitive::Cone { .. } => 4,
                    Primitive::Quadric(_) => 5,
                    Primitive::Torus { .. } => 6,
                }] = true;
            });
        }
    }
    assert_eq!(used, [true; 7], "sphere, half-space, cube, cylinder, cone, quadric, torus");
}

/// Ray tracers treat overlapping glass in different ways, and all are to show the same picture.
#[test]
fn transmitting_solids_do_not_overlap() {
    for (name, text) in SMALL_BUILT_IN {
        let scene = parse(name, text);
        let transmits = |solid: &&Solid| {
            let mut found = false;
            tags(solid, &mut |tag| found |= scene.materials[tag.index()].transmits());
            found
        };
        let glasses: Vec<&Solid> = scene.solids.iter().filter(transmits).collect();
        let size = Size::new(80, 60).expect("small");
        let tracer = Tracer::new(&scene, size, Quality::default());
        tracer.paths(0..size.pixels(), &mut Scratch::default(), |path| {
            if path.kind == RayKind::Refracted && path.to.is_finite() {
                let middle = path.ray.at(path.to / 2.0);
                let around = glasses.iter().filter(|solid| solid.contains(middle)).count();
                assert!(around < 2, "{name}: {around} solids around {middle}");
            }
        });
    }
}

/// Compiling splits opaque unions, which must not change the picture. An intersection with a large box keeps a union
/// whole.
#[test]
fn split_union_looks_the_same() {
    for (name, text) in SMALL_BUILT_IN {
        let scene = parse(name, text);
        let mut kept_whole = scene.clone();
        let around = Solid::Placed {
            primitive: Primitive::Cube,
            scene_from_local: DAffine3::from_scale(DVec3::splat(1e5)),
            tag: MaterialTag(0),
        };
        for solid in &mut kept_whole.solids {
            if matches!(solid, Solid::Union(_)) {
                *solid = Solid::Intersection(vec![solid.clone(), around.clone()]);
            }
        }
        let (apart, whole) = (pixels(&scene), pixels(&kept_whole));
        let differing = apart.iter().zip(&whole).filter(|(a, b)| a != b).count();
        assert_eq!(differing, 0, "{name}: differing pixels, of {}", apart.len());
    }
}

/// A cube, ball or cylinder of this size and material in a place of a grid, so that faces coincide.
fn in_grid([x, y, z]: [i32; 3], half: f64, kind: u8, tag: u32) -> Solid {
    let primitive = [Primitive::Cube, Primitive::Sphere, Primitive::Cylinder][usize::from(kind)];
    let place = DVec3::new(f64::from(x), f64::from(y), f64::from(z));
    let scene_from_local = DAffine3::from_scale_rotation_translation(DVec3::splat(half), DQuat::IDENTITY, place);
    Solid::Placed { primitive, scene_from_local, tag: MaterialTag(tag) }
}

/// A place, half a size, a kind and a material.
type InGrid = ([i32; 3], f64, u8, u32);

/// What is done to a union: how, and the solids that it is done with, as for [`in_grid`].
fn step() -> impl Strategy<Value = (u8, Vec<InGrid>)> {
    let place = || [-3..=3_i32, -3..=3, -3..=3];
    let half = prop::sample::select(&[0.5, 1.0, 1.5, 2.5, 4.0][..]);
    (0..3_u8, prop::collection::vec((place(), half, 0..3_u8, 0..2_u32), 1..4))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn parts_of_a_large_composition_look_like_the_whole(
        union in prop::collection::vec((prop::sample::select(&[0.3, 0.5, 0.6][..]), 0..3_u8, 0..2_u32), 125),
        steps in prop::collection::vec(step(), 1..4), materials in 1..3_u32,
    ) {
        const TEXT: &str = r#"Scene(
            camera: (eye: (4.1, 5.3, 9.7), look_at: (0, 0, 0), field_of_view: 38),
            lights: [Point(position: (6, 9, 5)), Directional(direction: (1, -2, 0.5), colour: (0.3, 0.3, 0.3))],
            materials: { "red": (colour: (0.8, 0.2, 0.1), ks: 0.3), "grey": (colour: (0.5, 0.5, 0.5)) },
            objects: [Sphere(radius: 1, material: "red"), Sphere(radius: 1, material: "grey")],
        )"#;
        let mut scene = parse("parts", TEXT);
        let place = |index: i32| [index % 5 - 2, index / 5 % 5 - 2, index / 25 - 2];
        // With one material nothing depends on which of two coincident faces is seen.
        let parts = (0..).zip(union).map(|(index, (half, kind, tag))| in_grid(place(index), half, kind, tag % materials));
        let solid = steps.into_iter().fold(Solid::Union(parts.collect()), |solid, (way, others)| {
            let others: Vec<_> = others.into_iter().map(|(at, half, kind, tag)| in_grid(at, half, kind, tag % materials)).collect();
            let both = |first: Vec<Solid>, second: Vec<Solid>| first.into_iter().chain(second).collect();
            match way {
                0 => Solid::Difference(both(vec![solid], others)),
                1 => Solid::Intersection(vec![solid, Solid::Union(others)]),
                _ => Solid::Intersection(vec![Solid::Union(others), solid]),
            }
        });
        scene.solids = vec![solid];
        let picture = |passes| {
            let mut pixels = Vec::new();
            let tracer = Tracer::with_passes(&scene, Size::new(48, 36).expect("small"), Quality::default(), passes);
            tracer.trace(0..48 * 36, &mut Scratch::default(), &mut pixels);
            pixels
        };
        let (parts, whole) = (picture(Passes::default()), picture(Passes::default().without(Pass::LocalParts)));
        let differing = parts.iter().zip(&whole).filter(|(a, b)| a != b).count();
        prop_assert_eq!(differing, 0, "of {} pixels", whole.len());
    }
}

#[test]
fn exported_scene_has_every_primitive_and_every_light() {
    for (name, text) in BUILT_IN {
        let scene = parse(name, text);
        let pov = to_pov(&scene, Size::new(640, 480).expect("small"), &Quality::default()).text;
        let count = |word: &str| pov.matches(word).count();
        assert_eq!(count("light_source {"), scene.lights.len(), "{name}");
        let mut primitives = 0;
        scene.solids.iter().for_each(|solid| leaves(solid, &mut |_| primitives += 1));
        let written = ["matrix <", "plane {", "sphere { <", "quadric {"].map(count);
        assert_eq!(written.into_iter().sum::<usize>(), primitives, "{name}");
        assert_eq!(count("{"), count("}"), "{name}");
    }
}

#[test]
fn export_of_a_scene_at_another_scale_differs_only_in_the_unit() {
    for Case { name, scene, .. } in cases() {
        let text = |exponent: i32| {
            let mut scene = scene.clone();
            enlarge(&mut scene, f64::from(exponent).exp2());
            let text = to_pov(&scene, Size::new(640, 480).expect("small"), &Quality::default()).text;
            let (units, rest): (Vec<&str>, Vec<&str>) = text.lines().partition(|line| line.contains(" times 2^"));
            assert_eq!(units.len(), 1, "{name}");
            rest.join("\n")
        };
        let own = text(0);
        assert!([-20, 3, 23].into_iter().all(|exponent| text(exponent) == own), "{name}");
    }
}

#[test]
fn union_of_several_media_is_exported_as_these_media() {
    let exported = |objects: &str| {
        let text = format!(
            r#"Scene(camera: (eye: (0, 0, 9), look_at: (0, 0, 0)), materials: {{"glass": (ka: 0, kd: 0, ks: 0.1, kt: 0.9, ior: 1.5),
            "water": (ka: 0, kd: 0, ks: 0.1, kt: 0.9, ior: 1.3), "red": (colour: (1, 0, 0))}}, objects: [{objects}])"#
        );
        let exported = to_pov(&parse("union", &text), Size::new(640, 480).expect("small"), &Quality::default());
        assert!(exported.limits.is_empty(), "{:?}", exported.limits);
        exported.text
    };
    let [ball, core, block] = [
        r#"Sphere(radius: 1, material: "glass")"#,
        r#"Sphere(radius: 0.5, material: "red")"#,
        r#"Box(min: (1.1, -1, -1), max: (2, 1, 1), material: "water")"#,
    ];
    let union = exported(&format!("Union(of: [{ball}, Union(of: [{core}]), {block}])"));
    assert_eq!(union, exported(&format!("{ball}, {core}, {block}")));
}

#[test]
fn repetition_looks_like_its_copies_written_out() {
    let scene = |solids: &str, object: &str| {
        let text = format!(
            r#"Scene(camera: (eye: (3, 5, 9), look_at: (2, 0, 0)), lights: [Point(position: (5, 9, 9))],
            materials: {{"red": (colour: (1, 0, 0))}}, solids: {{{solids}}}, objects: [{object}])"#
        );
        parse("repetition", &text)
    };
    let pin = r#""pin": Union(of: [Cylinder(from: (0, 0, 0), to: (0, 1, 0), radius: 0.3), Sphere(radius: 0.4)])"#;
    let used = |transform: String| format!(r#"Use(solid: "pin", transform: [{transform}])"#);
    let union = |copies: Vec<String>, rest: &str| format!("Union(of: [{}]{rest})", copies.join(", "));
    let rest = r#", material: "red", transform: [Scale((1, 0.5, 1)), Rotate((0, 0, 90))]"#;

    let ring =
        format!(r#"Repeat(count: 7, step: [Rotate((0, 45, 0))], of: {}{rest})"#, used("Translate((2, 0, 0))".into()));
    let turned = (0..7).map(|k| used(format!("Translate((2, 0, 0)), Rotate((0, {}, 0))", 45 * k))).collect();
    assert_eq!(scene(pin, &ring).solids, scene(pin, &union(turned, rest)).solids);

    let grid = format!(
        r#"Repeat(count: 3, step: [Translate((0, 0, -1))], of: Repeat(count: 4, step: [Translate((1, 0.25, 0))], of: {}))"#,
        used(String::new())
    );
    let at = |x: usize, z: usize| used(format!("Translate(({x}, {}, -{z}))", x as f64 / 4.0));
    let rows = (0..3).flat_map(|z| (0..4).map(move |x| at(x, z))).collect();
    let (repeated, written) = (scene(pin, &grid), scene(pin, &union(rows, "")));
    assert!(pixels(&repeated) == pixels(&written));
    let exported = |scene: &Scene| to_pov(scene, Size::new(640, 480).expect("small"), &Quality::default()).text;
    let primitives = |scene: &Scene| exported(scene).matches("matrix <").count();
    assert_eq!((primitives(&repeated), primitives(&written)), (12, 12), "cylinders");

    let once = format!("Repeat(count: 1, step: [Scale((9, 9, 9))], of: {})", used(String::new()));
    assert!(pixels(&scene(pin, &once)) == pixels(&scene(pin, &used(String::new()))));
}

#[test]
fn scenes_in_the_documents_are_valid() {
    let documents =
        [("README.md", include_str!("../../README.md")), ("docs/scenes.md", include_str!("../../docs/scenes.md"))];
    for (name, document) in documents {
        let scene = document.split("```ron\n").find(|block| block.starts_with("Scene("));
        let text = scene.and_then(|rest| rest.split("```").next()).expect("an example");
        assert!(parse(name, text).solids.len() > 1, "{name}");
    }
}

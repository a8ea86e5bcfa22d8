//! Small scenes for the comparison with POV-Ray: every primitive, every boolean operation, glass in many ways, every
//! scale, other cameras and lights.

use anel::csg::Solid;
use anel::scene::{Light, Scene};
use glam::{DAffine3, DVec3};

use super::povray_glass::{Expected, GLASS_UNION, glass};

/// A scene for both programs.
pub struct Case {
    pub name: String,
    pub scene: Scene,
    /// The same in a form that POV-Ray draws right, where coincident faces are left to its rounding.
    pub for_povray: Option<Scene>,
    pub expected: Expected,
}

const CAMERA: &str = "eye: (1, 2, 7), look_at: (0, 0, 0), field_of_view: 30";
const LIGHTS: &str = "Point(position: (-4, 6, 5)), Directional(direction: (-1, -2, -1.5), colour: (0.3, 0.3, 0.2))";
const FLOOR: &str = r#"HalfSpace(normal: (0, 1, 0), offset: -1.3, material: "floor"), "#;

/// A scene over a floor.
fn scene(objects: &str) -> Scene {
    with(CAMERA, LIGHTS, &format!("{FLOOR}{objects}"))
}

fn with(camera: &str, lights: &str, objects: &str) -> Scene {
    let text = format!(
        r#"Scene(camera: ({camera}), background: (0.6, 0.7, 0.9), ambient: (0.3, 0.3, 0.35), lights: [{lights}],
        materials: {{
            "red": (colour: (0.9, 0.2, 0.1), ks: 0.2, n: 20), "blue": (colour: (0.1, 0.3, 0.8), ka: 0.5, kd: 0.6),
            "floor": (colour: (0.8, 0.6, 0.5)), "mirror": (ka: 0.1, kd: 0.1, ks: 0.8, n: 80.5),
            "glass": (ka: 0, kd: 0, ks: 0.1, kt: 0.9, ior: 1.5), "water": (ka: 0, kd: 0, ks: 0.05, kt: 0.95, ior: 1.3),
            "air": (ka: 0, kd: 0, ks: 0, kt: 1, ior: 1), "film": (colour: (0.9, 0.8, 0.2), ks: 0.1, kt: 0.5, ior: 1),
            "ruby": (ka: 0, kd: 0, ks: 0.05, kt: (0.95, 0.4, 0.5), ior: 1),
            "red film": (colour: (0.9, 0.8, 0.2), ks: 0.1, kt: (0.8, 0.1, 0.2), ior: 1),
            "lossy": (ka: 0, kd: 0, ks: 0.1, kt: 0.6, ior: 1.5),
        }}, objects: [{objects}])"#
    );
    Scene::parse(&text).unwrap_or_else(|error| panic!("{error} in {text}"))
}

const PRIMITIVES: [(&str, &str); 14] = [
    ("ball", "Sphere(radius: 1"),
    ("ellipsoid", "Sphere(radius: 1, transform: [Scale((1, 0.5, 0.8)), Rotate((20, 30, 40))]"),
    ("box", "Box(min: (-0.9, -1, -0.5), max: (0.8, 0.7, 1)"),
    ("turned box", "Box(min: (-0.9, -0.5, -0.5), max: (0.9, 0.5, 1), transform: [Rotate((10, 25, 35))]"),
    (
        "sheared box",
        "Box(min: (-0.8, -0.7, -0.6), max: (0.8, 0.7, 0.6), transform: [Rotate((0, 40, 30)), Scale((1, 0.6, -1.2))]",
    ),
    ("cylinder", "Cylinder(from: (-0.5, -1, 0), to: (0.5, 1, 0.3), radius: 0.7"),
    ("flat cylinder", "Cylinder(from: (0, -0.1, 0), to: (0, 0.1, 0), radius: 1, transform: [Scale((1, 1, 0.6))]"),
    ("cone", "Cone(from: (0, -1, 0), to: (0, 1, 0), radius: 0.9"),
    ("truncated cone", "Cone(from: (0, -1, 0), to: (0.2, 0.9, 0.3), radius: 0.5, to_radius: 0.9"),
    ("torus", "Torus(axis: (0.3, 1, 0.5), radius: 0.9, tube: 0.3"),
    ("scaled torus", "Torus(radius: 0.9, tube: 0.3, transform: [Scale((1.2, 2, 0.8)), Rotate((50, 0, 20))]"),
    (
        "quadric ellipsoid",
        "Quadric(squares: (1, 3, 2), products: (0.5, 0.3, 0.2), linear: (0.2, 0, 0.1), constant: -0.8",
    ),
    (
        "quadric hyperboloid",
        "Quadric(squares: (1, -1, 1), constant: -0.1, transform: [Rotate((70, 20, 0)), Scale((0.7, 0.8, 0.7))]",
    ),
    ("quadric paraboloid", "Quadric(squares: (1, 0, 1), linear: (0, 1, 0), constant: -0.9"),
];

/// Solids for the boolean operations.
const OPERANDS: [&str; 4] = [
    "Sphere(centre: (-0.3, 0.2, 0), radius: 0.9)",
    "Box(min: (-0.2, -0.9, -0.6), max: (1, 0.45, 0.75))",
    "Cylinder(from: (-1.3, 0.1, 0.55), to: (1.4, -0.15, 0.1), radius: 0.35)",
    "Cone(from: (-0.9, -0.8, 0.3), to: (0.2, 1.2, 0.4), radius: 0.5, to_radius: 0.3)",
];

/// Objects that several groups of cases use.
/// All cases.
pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    let mut add = |name: &str, scene: Scene, expected| {
        cases.push(Case { name: name.to_owned(), scene, for_povray: None, expected });
    };
    for (name, solid) in PRIMITIVES {
        add(name, scene(&format!(r#"{solid}, material: "red")"#)), Expected::Equal);
        add(&format!("{name} of glass"), scene(&format!(r#"{solid}, material: "glass")"#)), Expected::Equal);
    }
    let [ball, cube, rod, bar] = OPERANDS;
    for (name, solid) in [
        ("union", format!("Union(of: [{ball}, {cube}, {rod}]")),
        ("intersection", format!("Intersection(of: [{ball}, {cube}]")),
        ("difference", format!("Difference(of: [{ball}, {cube}, {rod}]")),
        ("difference of a union", format!("Difference(of: [Union(of: [{ball}, {cube}]), {rod}]")),
        ("difference from a union", format!("Difference(of: [{cube}, Union(of: [{ball}, {rod}])]")),
        (
            "intersection of unions",
            format!("Intersection(of: [Union(of: [{ball}, {rod}]), Union(of: [{cube}, {bar}])]"),
        ),
        ("difference of differences", format!("Difference(of: [{ball}, Difference(of: [{cube}, {rod}])]")),
    ] {
        for material in ["blue", "mirror", "glass"] {
            let objects = format!(r#"{solid}, material: "{material}")"#);
            add(&format!("{name} of {material}"), scene(&objects), Expected::Equal);
        }
    }
    for (name, objects, expected) in glass() {
        add(name, scene(&objects), expected);
    }
    for (name, scene) in views() {
        let expected = if name.contains("quadric") { Expected::EyeInMedia } else { Expected::Equal };
        add(name, scene, expected);
    }
    for (name, objects) in [
        (
            "ball and torus",
            r#"Sphere(radius: 0.6, material: "red"), Torus(radius: 1, tube: 0.2, material: "mirror", transform: [Rotate((30, 0, 20))])"#,
        ),
        ("glass union", GLASS_UNION),
        (
            "cut glass",
            r#"Difference(material: "glass", of: [Sphere(radius: 1), Cylinder(from: (0, -2, 0.2), to: (0, 2, 0.1), radius: 0.4)])"#,
        ),
        (
            "quadric and cone",
            r#"Quadric(squares: (1, 2, 1), constant: -0.8, material: "red"), Cone(from: (1, -1, 1), to: (1.3, 0.5, 1), radius: 0.4, material: "blue")"#,
        ),
    ] {
        for factor in [1e-6, 1e-3, 1e4, 1e7] {
            let mut scene = scene(objects);
            enlarge(&mut scene, factor);
            add(&format!("{name} times {factor:e}"), scene, Expected::Equal);
        }
    }
    add("in metres", Scene::parse(IN_METRES).expect("a scene"), Expected::Equal);
    cases.extend(coincident());
    cases
}

/// Other cameras and lights.
fn views() -> Vec<(&'static str, Scene)> {
    let objects = format!(
        r#"{FLOOR}Sphere(radius: 0.8, material: "red"), Box(min: (0.9, -1, -1), max: (1.6, 0.8, 0.2), material: "blue"), Torus(centre: (-1.4, 0, 0), axis: (0.2, 1, 1), radius: 0.5, tube: 0.2, material: "mirror")"#
    );
    let glass = format!(
        r#"{FLOOR}Sphere(radius: 1.5, material: "glass"), Box(min: (-3, -1, -6), max: (0.3, 1, -5), material: "red")"#
    );
    vec![
        ("wide view", with("eye: (0.5, 1, 3), look_at: (0, 0, 0), field_of_view: 110", LIGHTS, &objects)),
        ("narrow view from afar", with("eye: (90, 60, 80), look_at: (0, 0, 0), field_of_view: 1.2", LIGHTS, &objects)),
        (
            "tilted view",
            with("eye: (1, 2, 7), look_at: (0.2, -0.1, 0), up: (0.7, 1, 0.1), field_of_view: 28", LIGHTS, &objects),
        ),
        ("straight down", with("eye: (0, 8, 0), look_at: (0, 0, 0), field_of_view: 28", LIGHTS, &objects)),
        (
            "straight up",
            with("eye: (0.2, -8, 0.1), look_at: (0.2, 0, 0.1), field_of_view: 28", LIGHTS, &objects[FLOOR.len()..]),
        ),
        ("almost straight down", with("eye: (0, 8, 0.01), look_at: (0, 0, 0), field_of_view: 28", LIGHTS, &objects)),
        (
            "point to look at near the eye",
            with("eye: (1, 2, 7), look_at: (0.99, 1.98, 6.93), field_of_view: 30", LIGHTS, &objects),
        ),
        ("one sun", with(CAMERA, "Directional(direction: (0.5, -1, -0.7), colour: (1, 0.9, 0.7))", &objects)),
        ("no light", with(CAMERA, "", &objects)),
        ("far light", with(CAMERA, "Point(position: (30000, 90000, 40000))", &objects)),
        (
            "light in glass",
            with(
                CAMERA,
                "Point(position: (0.1, 0.2, 0.1))",
                &format!(
                    r#"{FLOOR}Sphere(radius: 0.9, material: "glass"), Box(min: (1, -1, -1), max: (1.6, 0.8, 0.2), material: "blue")"#
                ),
            ),
        ),
        ("eye in glass", with("eye: (0.2, 0.1, 1), look_at: (0, 0, -5), field_of_view: 50", LIGHTS, &glass)),
        (
            "eye in two media",
            with(
                "eye: (0.2, 0.1, 0.5), look_at: (0, 0, -5), field_of_view: 50",
                LIGHTS,
                &format!(
                    r#"{FLOOR}Sphere(centre: (-0.3, 0, 0), radius: 1, material: "water"), {}, Sphere(centre: (1, 0, -4), radius: 0.5, material: "blue"), Sphere(centre: (2, 1, -4), radius: 0.5, material: "red"), Sphere(centre: (-2, 1, -4), radius: 0.5, material: "red")"#,
                    &glass[FLOOR.len()..]
                ),
            ),
        ),
        (
            "eye in a cut quadric in glass",
            with(
                "eye: (0.1, 0.1, 0.2), look_at: (0, 0, -5), field_of_view: 50",
                "Point(position: (-4, 6, 5))",
                r#"Intersection(material: "air", of: [HalfSpace(normal: (0, 1, 0), offset: 0.8), HalfSpace(normal: (0, -1, 0), offset: 0.8), Quadric(squares: (1, 2, 1), products: (0.1, 0.2, 0), constant: -0.8)]), Sphere(radius: 1.2, material: "glass"), Box(min: (-3, -1, -6), max: (0.3, 1, -5), material: "red"), Sphere(centre: (1, 0, -4), radius: 0.5, material: "blue"), Sphere(centre: (2, 1, -4), radius: 0.5, material: "red"), Sphere(centre: (-2, 1, -4), radius: 0.5, material: "red"), Sphere(centre: (-2, -1, -4), radius: 0.5, material: "blue")"#,
            ),
        ),
        (
            "eye in a room",
            with(
                "eye: (0, 0, 1.5), look_at: (0.3, -0.2, -1), field_of_view: 60",
                "Point(position: (1, 1.5, 1))",
                r#"Difference(material: "blue", of: [Box(min: (-3, -3, -3), max: (3, 3, 3)), Box(min: (-2, -2, -2), max: (2, 2, 2))]), Sphere(centre: (0.4, -0.5, -0.5), radius: 0.7, material: "red")"#,
            ),
        ),
        (
            "eye in an opaque union",
            with(
                "eye: (-0.5, 0, 0.2), look_at: (1, 0, 0), field_of_view: 60",
                "Point(position: (0.4, 0.6, 0.3))",
                r#"Union(material: "blue", of: [Sphere(centre: (-0.5, 0, 0), radius: 1), Box(min: (0, -0.7, -0.7), max: (2, 0.7, 0.7))])"#,
            ),
        ),
    ]
}

/// Scenes with coincident faces: POV-Ray's rounding decides which of them it shows. It gets the same solid in another
/// form.
fn coincident() -> Vec<Case> {
    let cases = [
        (
            "bore that ends with its cylinder",
            r#"Difference(material: "red", transform: [Rotate((70, 11, 5))], of: [Cylinder(from: (0, -0.8, 0), to: (0, 0.8, 0), radius: 1), Cylinder(from: (0, -0.8, 0), to: (0, 0.8, 0), radius: 0.6)])"#,
            r#"Difference(material: "red", transform: [Rotate((70, 11, 5))], of: [Cylinder(from: (0, -0.8, 0), to: (0, 0.8, 0), radius: 1), Cylinder(from: (0, -0.9, 0), to: (0, 0.9, 0), radius: 0.6)])"#,
        ),
        (
            "glass blocks of one union that share a face",
            r#"Union(material: "glass", transform: [Rotate((10, 20, 0))], of: [Box(min: (-1, -0.5, -0.5), max: (0, 0.5, 0.5)), Box(min: (0, -0.5, -0.5), max: (1, 0.5, 0.5))])"#,
            r#"Box(min: (-1, -0.5, -0.5), max: (1, 0.5, 0.5), material: "glass", transform: [Rotate((10, 20, 0))])"#,
        ),
        (
            "box on a box of another colour",
            r#"Box(min: (-1, -1, -0.5), max: (1, 0, 0.7), material: "red"), Box(min: (-0.6, -1, -0.4), max: (0.8, 0.6, 0.7), material: "blue")"#,
            r#"Box(min: (-1, -1, -0.5), max: (1, 0, 0.7), material: "red"), Box(min: (-0.6, -0.9, -0.4), max: (0.8, 0.6, 0.6999), material: "blue")"#,
        ),
    ];
    let case = |(name, objects, for_povray): (&str, &str, &str)| Case {
        name: name.to_owned(),
        scene: scene(objects),
        for_povray: Some(scene(for_povray)),
        expected: Expected::Equal,
    };
    cases.into_iter().map(case).collect()
}

/// A planet, its moon and its ring.
const IN_METRES: &str = r#"Scene(
    camera: (eye: (-19113000.0, 12742000.0, 57339000.0), look_at: (2548400.0, 0.0, 0.0), field_of_view: 30),
    background: (0.01, 0.01, 0.03), ambient: (0.05, 0.05, 0.06),
    lights: [Point(position: (-101936000000.0, 9556500000.0, 108307000000.0), colour: (1, 0.95, 0.9))],
    materials: {"earth": (colour: (0.2, 0.5, 0.9)), "moon": (colour: (0.8, 0.8, 0.7)), "ring": (colour: (0.9, 0.6, 0.3))},
    objects: [
        Sphere(centre: (0.0, 0.0, 0.0), radius: 6371000.0, material: "earth"),
        Sphere(centre: (-5733900.0, 1592750.0, 8282300.0), radius: 1720170.0, material: "moon"),
        Torus(centre: (0.0, 0.0, 0.0), axis: (0.3, 1, 0), radius: 10193600.0, tube: 509680.0, material: "ring"),
    ],
)"#;

/// Makes a scene larger.
pub fn enlarge(scene: &mut Scene, factor: f64) {
    scene.camera.eye *= factor;
    scene.camera.look_at *= factor;
    for light in &mut scene.lights {
        if let Light::Point { position, .. } = light {
            *position *= factor;
        }
    }
    let larger = DAffine3::from_scale(DVec3::splat(factor));
    scene.solids.iter_mut().for_each(|solid| enlarge_solid(solid, &larger));
}

fn enlarge_solid(solid: &mut Solid, larger: &DAffine3) {
    match solid {
        Solid::Placed { scene_from_local, .. } => *scene_from_local = *larger * *scene_from_local,
        Solid::Union(solids) | Solid::Intersection(solids) | Solid::Difference(solids) => {
            solids.iter_mut().for_each(|solid| enlarge_solid(solid, larger));
        }
    }
}

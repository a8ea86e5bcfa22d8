//! Scenes of glass for the comparison with POV-Ray, and what the export must say of each.

/// What the export must say about a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expected {
    /// Nothing: the pictures are equal.
    Equal,
    /// It names media that POV-Ray shows in another way, and so it does.
    Media,
    /// It names the total internal reflection of a material.
    TotalReflection,
    /// It says that the eye is in several media.
    EyeInMedia,
    /// It names a coloured glass that also shows other light.
    ColouredKt,
}

/// Two balls of glass in one solid.
pub const GLASS_UNION: &str = r#"Union(material: "glass", of: [Sphere(centre: (-0.5, 0, 0), radius: 0.9), Sphere(centre: (0.5, 0, 0), radius: 0.8)])"#;

/// Glass in and beside glass.
pub fn glass() -> Vec<(&'static str, String, Expected)> {
    let of = |objects: &str| objects.to_owned();
    vec![
        ("two glass balls in a union", of(GLASS_UNION), Expected::Equal),
        (
            "three glasses in nested unions",
            of(
                r#"Union(material: "glass", of: [Union(of: [Sphere(centre: (-0.6, 0, 0), radius: 0.6), Box(min: (-0.4, -0.3, -0.3), max: (0.9, 0.3, 0.3))]), Cylinder(from: (0.6, -1, 0), to: (0.7, 1, 0), radius: 0.4)])"#,
            ),
            Expected::Equal,
        ),
        (
            "glass and water apart",
            of(
                r#"Sphere(centre: (-0.7, 0, 0), radius: 0.6, material: "glass"), Sphere(centre: (0.7, 0, 0), radius: 0.7, material: "water")"#,
            ),
            Expected::Equal,
        ),
        (
            "bubble in glass",
            of(r#"Sphere(centre: (0.2, 0.1, 0), radius: 0.5, material: "air"), Sphere(radius: 1, material: "glass")"#),
            Expected::Equal,
        ),
        (
            "water in glass",
            of(
                r#"Box(min: (-0.4, -0.5, -0.4), max: (0.5, 0.4, 0.5), material: "water"), Sphere(radius: 1, material: "glass")"#,
            ),
            Expected::Equal,
        ),
        (
            "glass in water in glass",
            of(
                r#"Sphere(radius: 0.3, material: "glass"), Sphere(radius: 0.6, material: "water"), Sphere(radius: 1, material: "glass")"#,
            ),
            Expected::Equal,
        ),
        (
            "glass around water that does not exist",
            of(r#"Sphere(radius: 1, material: "glass"), Sphere(centre: (0.2, 0, 0), radius: 0.5, material: "water")"#),
            Expected::Equal,
        ),
        (
            "glass ball under water that fills it",
            of(
                r#"Box(min: (-1, -1, -1), max: (1, 0.6, 1), material: "water"), Sphere(centre: (0, -0.2, 0), radius: 0.4, material: "glass")"#,
            ),
            Expected::Equal,
        ),
        (
            "glass overlaps water",
            of(
                r#"Sphere(centre: (-0.4, 0, 0), radius: 0.8, material: "glass"), Sphere(centre: (0.4, 0, 0), radius: 0.8, material: "water")"#,
            ),
            Expected::Media,
        ),
        (
            "glass overlaps the same glass",
            of(
                r#"Sphere(centre: (-0.4, 0, 0), radius: 0.8, material: "glass"), Sphere(centre: (0.4, 0, 0), radius: 0.8, material: "glass")"#,
            ),
            Expected::Media,
        ),
        (
            "glass touches water",
            of(
                r#"Box(min: (-1, -0.8, -0.5), max: (0, 0.8, 0.5), material: "glass"), Box(min: (0, -0.6, -0.4), max: (1, 0.6, 0.4), material: "water")"#,
            ),
            Expected::Media,
        ),
        (
            "water fills a glass and overlaps it",
            of(
                r#"Difference(material: "glass", of: [Cylinder(from: (0, -1, 0), to: (0, 1, 0), radius: 0.8), Cylinder(from: (0, -0.8, 0), to: (0, 1.2, 0), radius: 0.65)]), Cylinder(from: (0, -0.9, 0), to: (0, 0.6, 0), radius: 0.7, material: "water")"#,
            ),
            Expected::Media,
        ),
        (
            "water fills a glass and leaves a gap",
            of(
                r#"Difference(material: "glass", of: [Cylinder(from: (0, -1, 0), to: (0, 1, 0), radius: 0.8), Cylinder(from: (0, -0.8, 0), to: (0, 1.2, 0), radius: 0.65)]), Cylinder(from: (0, -0.77, 0), to: (0, 0.6, 0), radius: 0.62, material: "water")"#,
            ),
            Expected::Equal,
        ),
        (
            "red core in glass",
            of(r#"Sphere(radius: 1, material: "glass"), Sphere(radius: 0.4, material: "red")"#),
            Expected::Equal,
        ),
        (
            "red rod through glass",
            of(
                r#"Sphere(radius: 1, material: "glass"), Cylinder(from: (-1.4, -0.1, 0.1), to: (1.4, 0.3, 0), radius: 0.2, material: "red")"#,
            ),
            Expected::Equal,
        ),
        (
            "film before glass",
            of(
                r#"Sphere(centre: (-0.2, 0.1, 1), radius: 0.6, material: "film"), Sphere(centre: (0.3, 0, -1), radius: 0.9, material: "glass")"#,
            ),
            Expected::Equal,
        ),
        (
            "glass that absorbs, without total reflection",
            of(
                r#"Box(min: (-0.9, -0.6, -0.1), max: (0.9, 0.6, 0.1), material: "film"), Torus(radius: 1.1, tube: 0.1, material: "film")"#,
            ),
            Expected::Equal,
        ),
        (
            "glass that absorbs",
            of(
                r#"Box(min: (-0.9, -0.6, -0.4), max: (0.9, 0.6, 0.6), material: "lossy", transform: [Rotate((20, 30, 0))])"#,
            ),
            Expected::TotalReflection,
        ),
        (
            "the same ball twice",
            of(r#"Sphere(radius: 1, material: "glass"), Sphere(radius: 1, material: "glass")"#),
            Expected::Equal,
        ),
        (
            "bar flush in a pane",
            of(
                r#"Box(min: (-1, -0.8, 0), max: (1, 0.8, 0.2), material: "glass"), Box(min: (-0.2, -0.8, 0), max: (0.2, 0.8, 0.2), material: "glass")"#,
            ),
            Expected::Equal,
        ),
        (
            "glass with a core, and water, in one union",
            of(
                r#"Union(of: [Sphere(centre: (-0.8, 0, 0), radius: 0.7, material: "glass"), Sphere(centre: (-0.8, 0, 0), radius: 0.3, material: "red"), Sphere(centre: (0.8, 0, 0), radius: 0.7, material: "water")])"#,
            ),
            Expected::Equal,
        ),
        (
            "coloured glass",
            of(r#"Sphere(radius: 1, material: "ruby"), Box(min: (-1, -1, -3), max: (1, 1, -2), material: "film")"#),
            Expected::Equal,
        ),
        ("coloured film", of(r#"Sphere(radius: 1, material: "red film")"#), Expected::ColouredKt),
        (
            "cutter of another material",
            of(
                r#"Difference(of: [Sphere(radius: 1, material: "glass"), Box(min: (0, -0.4, -0.4), max: (1.5, 0.5, 0.5), material: "blue")])"#,
            ),
            Expected::Equal,
        ),
    ]
}

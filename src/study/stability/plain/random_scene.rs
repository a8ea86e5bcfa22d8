//! Random scenes of the kinds that go wrong: on a coarse grid, so that faces coincide and the eye lies on them; glass
//! in glass, and the same glass twice; solids turned by right angles; lights along faces; large and small scenes.

use fastrand::Rng;

/// Writes a scene in the scene language.
pub(in super::super) fn random_scene(seed: u64) -> String {
    let rng = &mut Rng::with_seed(seed);
    // A whole scene in metres or in micrometres; powers of ten round.
    let unit = pick(rng, &[1.0, 1.0, 1.0, 1e-5, 1e-3, 1e3, 1e7]);
    let mut scene = SceneText { rng, unit };
    let objects: Vec<String> = (0..scene.rng.usize(2..6)).map(|_| scene.object()).collect();
    let mut objects = objects;
    if scene.rng.u8(0..3) == 0 {
        let again = objects[0].clone();
        objects.push(again);
    }
    if scene.rng.bool() {
        objects.push(scene.floor());
    }
    let eye = match scene.rng.u8(0..3) {
        0 => scene.grid_point(),
        1 => format!("({}, {}, {})", scene.length(0.31), scene.length(0.27), scene.length(4.13)),
        _ => format!("({}, {}, {})", scene.length(3.0), scene.length(2.5), scene.length(3.5)),
    };
    let look_at = format!("({}, {}, {})", scene.length(0.01), scene.length(0.02), scene.length(-0.03));
    let light = scene.light();
    let second = if scene.rng.bool() { scene.light() } else { String::new() };
    format!(
        r#"(camera: (eye: {eye}, look_at: {look_at}, field_of_view: 60),
        background: (0.1, 0.2, 0.3), ambient: (0.3, 0.3, 0.3), lights: [{light}{second}],
        materials: {{
            "clear": (ka: 0, kd: 0, ks: 0.1, kt: 0.9, ior: 1.5, n: 20),
            "water": (ka: 0, kd: 0.1, ks: 0.1, kt: (0.9, 0.6, 0.7), ior: 1.33, n: 10, colour: (0.2, 0.5, 0.9)),
            "air": (ka: 0, kd: 0, ks: 0, kt: 1, ior: 1),
            "red": (colour: (0.9, 0.2, 0.1), ks: 0.3, n: 30),
            "matt": (colour: (0.3, 0.8, 0.4)),
        }},
        objects: [{}])"#,
        objects.join(",\n")
    )
}

struct SceneText<'a> {
    rng: &'a mut Rng,
    unit: f64,
}

impl SceneText<'_> {
    fn length(&self, units: f64) -> String {
        format!("{:?}", units * self.unit)
    }

    /// A coordinate on the grid.
    fn coordinate(&mut self) -> f64 {
        f64::from(self.rng.i32(-2..=2)) / 2.0
    }

    fn grid_point(&mut self) -> String {
        let [x, y, z] = [0; 3].map(|_| self.coordinate());
        format!("({}, {}, {})", self.length(x), self.length(y), self.length(z))
    }

    fn material(&mut self) -> &'static str {
        pick(self.rng, &["clear", "clear", "water", "water", "air", "red", "matt"])
    }

    /// A turn by right angles, by any angle, or none.
    fn turn(&mut self) -> String {
        let quarter = |rng: &mut Rng| 90 * rng.i32(-3..=3);
        match self.rng.u8(0..6) {
            0 | 1 => {
                let [x, y, z] = [0; 3].map(|_| quarter(self.rng));
                format!("transform: [Rotate(({x}, {y}, {z}))],")
            }
            2 => format!(
                "transform: [Rotate(({}, {}, {}))],",
                self.rng.i32(0..90),
                self.rng.i32(0..90),
                quarter(self.rng)
            ),
            _ => String::new(),
        }
    }

    fn floor(&mut self) -> String {
        let (quarters, offset) = (90 * self.rng.i32(-3..=3), self.length(-1.0));
        format!(
            r#"HalfSpace(normal: (0, 1, 0), offset: {offset}, material: "matt", transform: [Rotate(({quarters}, 0, 0))])"#
        )
    }

    fn object(&mut self) -> String {
        match self.rng.u8(0..5) {
            0 | 1 => self.primitive(),
            2 => self.composition("Union"),
            3 => self.composition("Difference"),
            _ => self.composition("Intersection"),
        }
    }

    fn composition(&mut self, name: &str) -> String {
        let operands: Vec<String> = (0..self.rng.usize(2..4)).map(|_| self.primitive()).collect();
        format!("{name}(of: [{}], {})", operands.join(", "), self.turn())
    }

    fn primitive(&mut self) -> String {
        let (material, turn) = (self.material(), self.turn());
        let centre = self.grid_point();
        let half = f64::from(self.rng.i32(1..=3)) / 2.0;
        let radius = self.length(half);
        let rest = format!(r#"material: "{material}", {turn}"#);
        let [x, y, z] = [0; 3].map(|_| self.coordinate());
        let at = |scene: &Self, by: [f64; 3]| {
            let [x, y, z] = [x + by[0], y + by[1], z + by[2]].map(|units| scene.length(units));
            format!("({x}, {y}, {z})")
        };
        match self.rng.u8(0..9) {
            0 | 1 => format!("Sphere(centre: {centre}, radius: {radius}, {rest})"),
            2..=4 => {
                let [a, b, c] = [0; 3].map(|_| f64::from(self.rng.i32(1..=3)) / 2.0);
                format!("Box(min: {}, max: {}, {rest})", at(self, [0.0; 3]), at(self, [a, b, c]))
            }
            5 => format!(
                "Cylinder(from: {}, to: {}, radius: {radius}, {rest})",
                at(self, [0.0; 3]),
                at(self, [0.0, half, 0.0])
            ),
            6 => {
                let end = self.length(half / 2.0);
                format!(
                    "Cone(from: {}, to: {}, radius: {radius}, to_radius: {end}, {rest})",
                    at(self, [0.0; 3]),
                    at(self, [half, 0.0, 0.0])
                )
            }
            7 => format!("Torus(centre: {centre}, radius: {radius}, tube: {}, {rest})", self.length(half / 4.0)),
            _ => {
                // A factor of Scale is at most 1e6.
                let (unit, ten, constant) = (self.unit / 10.0, 10, -half * half);
                let turn = turn.replace("transform: [", "").replace("],", "");
                format!(
                    r#"Quadric(squares: (1, 0, 1), constant: {constant:?}, material: "{material}",
                    transform: [Scale(({unit:?}, {unit:?}, {unit:?})), Scale(({ten}, {ten}, {ten})), {turn}])"#
                )
            }
        }
    }

    /// A light, often along the faces of the grid or in one of them.
    fn light(&mut self) -> String {
        match self.rng.u8(0..4) {
            0 => format!("Point(position: {}),", self.grid_point()),
            1 => format!("Point(position: ({}, {}, {})),", self.length(3.1), self.length(4.2), self.length(2.3)),
            2 => {
                let mut direction = [0; 3];
                direction[self.rng.usize(0..3)] = if self.rng.bool() { 1 } else { -1 };
                let [x, y, z] = direction;
                format!("Directional(direction: ({x}, {y}, {z})),")
            }
            _ => "Directional(direction: (-1, -2, -1.5)),".into(),
        }
    }
}

fn pick<T: Copy>(rng: &mut Rng, from: &[T]) -> T {
    from[rng.usize(0..from.len())]
}

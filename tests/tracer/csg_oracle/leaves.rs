//! Leaves with integer coordinates, and the same leaves as solids of a scene, rounded in one of several ways.

use anel::csg::{MaterialTag, Primitive, QuadricCoefficients, Solid};
use anel::geometry::{rotation, turn_y_to};
use fastrand::Rng;
use glam::{DAffine3, DMat3, DVec3};

use super::exact::{GivenUp, Place, Spans, below_zero, clipped};

/// The scene's unit in exact coordinates, which are eighths of it.
pub const UNIT: i128 = 8;

/// Upper bound of all coordinates that matter.
const SIZE: f64 = 100.0;

pub type Whole = [i128; 3];

/// A ray: the points `target + t direction`.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    pub target: Whole,
    pub direction: Whole,
}

/// Σ square x² + 2 half x + constant ≤ 0, in coordinates relative to a centre.
#[derive(Clone, Copy, Debug)]
struct Form {
    square: Whole,
    half: Whole,
    constant: i128,
}

/// A leaf: the points at which all forms hold.
#[derive(Clone, Debug)]
pub struct Leaf {
    centre: Whole,
    forms: Vec<Form>,
    primitive: Primitive,
    /// Maps the y axis to the leaf's axis.
    turn: DMat3,
    scale: DVec3,
}

/// The numbers from which random leaves are made.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    /// All sizes and positions are multiples of this.
    pub step: i128,
    /// The largest multiple.
    pub reach: i128,
}

pub fn vector(whole: Whole) -> DVec3 {
    DVec3::from(whole.map(|n| n as f64)) / UNIT as f64
}

fn dot(a: Whole, b: Whole) -> i128 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn times(a: Whole, b: Whole) -> Whole {
    [a[0] * b[0], a[1] * b[1], a[2] * b[2]]
}

/// A vector with `along` on `axis` and `across` on the other axes.
fn about(axis: usize, along: i128, across: i128) -> Whole {
    let mut whole = [across; 3];
    whole[axis] = along;
    whole
}

/// normal · x ≤ offset.
fn plane(normal: Whole, offset: i128) -> Form {
    // Doubled, so that the half is an integer.
    Form { square: [0; 3], half: normal, constant: -2 * offset }
}

/// The two planes at ±`half` on an axis.
fn slab(axis: usize, half: i128) -> [Form; 2] {
    [1, -1].map(|side| plane(about(axis, side, 0), half))
}

impl Grid {
    fn place(&self, rng: &mut Rng) -> Whole {
        [0; 3].map(|_| self.step * rng.i128(-self.reach..=self.reach))
    }

    /// A size in steps, of a small leaf or of one that contains most of the others.
    fn size(&self, rng: &mut Rng, large: bool) -> i128 {
        let middle = self.reach / 2 + 1;
        self.step * if large { rng.i128(middle..=self.reach + 1) } else { rng.i128(1..=middle) }
    }
}

impl Leaf {
    /// A random leaf on the grid. A large one is often centred.
    pub fn random(rng: &mut Rng, grid: Grid, large: bool) -> Self {
        let centre = if large && rng.bool() { [0; 3] } else { grid.place(rng) };
        let mut size = || grid.size(rng, large);
        let (r, s, h) = (size(), size(), size());
        let (axis, up) = (rng.usize(0..3), if rng.bool() { 1 } else { -1 });
        let turn = turn_y_to(DVec3::AXES[axis] * up as f64);
        let size = |x: i128, y: i128, z: i128| vector([x, y, z]);
        let ball = Form { square: [1; 3], half: [0; 3], constant: -r * r };
        let tube = Form { square: about(axis, 0, 1), ..ball };
        let (primitive, scale, forms) = match rng.u8(0..11) {
            0..2 => (Primitive::Sphere, size(r, r, r), vec![ball]),
            2 => {
                let form = Form { square: about(axis, 1, 4), half: [0; 3], constant: -4 * r * r };
                (Primitive::Sphere, size(r, 2 * r, r), vec![form])
            }
            3..5 => {
                let forms = [&[tube][..], &slab(axis, h)].concat();
                (Primitive::Cylinder, size(r, h, r), forms)
            }
            5..7 => {
                // The radius at height y above the centre is m + s y; the slope s is ±1/2 or ±1.
                let slope_of_2 = up * rng.i128(1..=2);
                let h = (2 * r / slope_of_2.abs()).min(h);
                // 4 (x² + z²) ≤ (2 m + s y)², and 2 m − |s| h ≥ 0 since h ≤ 2 r / |s|.
                let m_of_2 = 2 * r;
                let cone = Form {
                    square: about(axis, -slope_of_2 * slope_of_2, 4),
                    half: about(axis, -m_of_2 * slope_of_2, 0),
                    constant: -m_of_2 * m_of_2,
                };
                let radius = |side: i128| (m_of_2 + side * slope_of_2.abs() * h) as f64 / (2.0 * UNIT as f64);
                let forms = [&[cone][..], &slab(axis, h)].concat();
                (Primitive::Cone { bottom: radius(-1), top: radius(1) }, vector([UNIT, h, UNIT]), forms)
            }
            7 => {
                let half = [r, s, h];
                let forms = (0..3).flat_map(|axis| slab(axis, half[axis])).collect();
                return Self { centre, forms, primitive: Primitive::Cube, turn: DMat3::IDENTITY, scale: size(r, s, h) };
            }
            8..10 => {
                const NORMALS: [Whole; 4] = [[2, 3, 6], [3, 4, 0], [1, 2, 2], [-6, 2, 3]];
                let normal = if rng.bool() { about(axis, up, 0) } else { NORMALS[rng.usize(0..4)] };
                let length = (dot(normal, normal) as f64).sqrt();
                let primitive =
                    Primitive::HalfSpace { normal: DVec3::from(normal.map(|n| n as f64)) / length, offset: 0.0 };
                return Self {
                    centre,
                    forms: vec![plane(normal, 0)],
                    primitive,
                    turn: DMat3::IDENTITY,
                    scale: DVec3::ONE,
                };
            }
            _ => {
                // The surfaces of other leaves as quadrics, or shapes that only quadrics have: two pieces, or an
                // outside.
                let form = match rng.u8(0..5) {
                    0 => ball,
                    1 => tube,
                    2 => Form { square: ball.square.map(|n| -n), constant: r * r, ..ball },
                    3 => Form { square: about(axis, -1, 1), ..ball },
                    _ => Form { square: about(axis, 0, 1), half: about(axis, -up * r, 0), constant: 0 },
                };
                let coefficients = QuadricCoefficients {
                    squares: DVec3::from(form.square.map(|n| n as f64)),
                    products: DVec3::ZERO,
                    linear: vector(form.half) * 2.0,
                    constant: form.constant as f64 / (UNIT * UNIT) as f64,
                };
                let primitive = Primitive::Quadric(coefficients);
                return Self { centre, forms: vec![form], primitive, turn: DMat3::IDENTITY, scale: DVec3::ONE };
            }
        };
        Self { centre, forms, primitive, turn, scale }
    }

    /// Moves the leaf away from all others.
    pub fn out_of_reach(mut self) -> Self {
        self.centre[0] += 64 * UNIT;
        self
    }

    /// The spans of the line inside the leaf.
    pub fn spans(&self, line: &Line) -> Result<Spans, GivenUp> {
        let Line { target, direction } = *line;
        let from: Whole = [0, 1, 2].map(|axis| target[axis] - self.centre[axis]);
        let mut spans = vec![[Place::FIRST, Place::LAST]];
        for Form { square, half, constant } in &self.forms {
            let a = dot(*square, times(direction, direction));
            let b = dot(times(*square, from), direction) + dot(*half, direction);
            let c = dot(times(*square, from), from) + 2 * dot(*half, from) + constant;
            let size = |whole: &Whole| whole.iter().map(|n| n.abs() as f64).sum::<f64>();
            let blur = 1e-9 * SIZE * (size(square) * SIZE + 2.0 * size(half));
            let of_form = below_zero(a, b, c, blur)?;
            let mut both = Vec::new();
            for within in &of_form {
                both.extend(clipped(&spans, within)?);
            }
            spans = both;
        }
        Ok(spans)
    }

    /// The leaf as a solid of the moved scene. Its map is computed in one of several ways, which are equal but round
    /// differently.
    pub fn placed(&self, rng: &mut Rng, motion: &DAffine3, tag: u32) -> Solid {
        let (at, scale, turn) = (vector(self.centre), DAffine3::from_scale(self.scale), self.turn);
        let aside = DVec3::new(rng.f64(), rng.f64(), rng.f64());
        let angle = rng.f64() * 6.0;
        let there = DAffine3::from_translation(at) * DAffine3::from_mat3(turn);
        let own = match rng.u8(0..5) {
            0 => DAffine3 { matrix3: turn * DMat3::from_diagonal(self.scale), translation: at },
            1 => {
                DAffine3::from_translation(at + aside)
                    * DAffine3::from_translation(-aside)
                    * DAffine3::from_mat3(turn)
                    * scale
            }
            2 => there * DAffine3::from_scale(self.scale / 3.0) * DAffine3::from_scale(DVec3::splat(3.0)),
            3 => there * DAffine3::from_rotation_y(angle) * DAffine3::from_rotation_y(-angle) * scale,
            _ => there * self.symmetry(rng, angle) * scale,
        };
        let scene_from_local = if rng.bool() {
            *motion * own
        } else {
            DAffine3 { matrix3: motion.matrix3 * own.matrix3, translation: motion.transform_point3(own.translation) }
        };
        Solid::Placed { primitive: self.primitive, scene_from_local, tag: MaterialTag(tag) }
    }

    /// A rotation that maps the leaf to itself.
    fn symmetry(&self, rng: &mut Rng, angle: f64) -> DAffine3 {
        match self.primitive {
            Primitive::Sphere if self.scale.x == self.scale.y => {
                DAffine3::from_mat3(rotation(DVec3::new(rng.f64(), rng.f64(), rng.f64()) * 360.0))
            }
            Primitive::Sphere | Primitive::Cylinder | Primitive::Cone { .. } => DAffine3::from_rotation_y(angle),
            Primitive::Cube => DAffine3::from_scale(DVec3::new(-1.0, 1.0, -1.0)),
            _ => DAffine3::IDENTITY,
        }
    }
}

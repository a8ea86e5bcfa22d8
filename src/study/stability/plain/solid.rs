//! Solids without any cleverness: the surfaces that bound a primitive, where a line meets them, and whether a point is
//! inside, by the inequalities of their definitions.

use crate::csg::{MaterialTag, Primitive, Solid};

use super::number::Number;
use super::vector::{ToLocal, Vector};

/// A solid of the scene with its leaves in order.
pub enum Plain<N> {
    Leaf(Leaf<N>),
    Union(Vec<Plain<N>>),
    Intersection(Vec<Plain<N>>),
    Difference(Vec<Plain<N>>),
}

/// A placed primitive: the points where none of its surfaces' functions is above 0.
pub struct Leaf<N> {
    pub tag: MaterialTag,
    /// Its number among the scene's leaves.
    pub index: usize,
    to_local: ToLocal<N>,
    surfaces: Vec<Surface<N>>,
}

/// A function of a point; where it is 0, there is the surface.
#[derive(Clone, Copy)]
enum Surface<N> {
    /// normal · p − offset
    Plane(Vector<N>, N),
    /// squares · p² + products · (xy, yz, zx) + linear · p + constant
    Quadric { squares: Vector<N>, products: Vector<N>, linear: Vector<N>, constant: N },
    /// (p² + 1 − r²)² − 4 (x² + z²), with the tube's radius r
    Torus(N),
}

/// Where a line meets a surface of a leaf.
#[derive(Clone, Copy, Debug)]
pub struct Meeting<N> {
    pub t: N,
    pub leaf: usize,
    pub surface: usize,
}

impl<N: Number> Plain<N> {
    /// Copies a solid; `leaves` counts the leaves.
    pub fn new(solid: &Solid, leaves: &mut usize) -> Self {
        let mut all = |solids: &[Solid]| solids.iter().map(|solid| Self::new(solid, leaves)).collect();
        match solid {
            Solid::Placed { primitive, scene_from_local, tag } => {
                *leaves += 1;
                let to_local = ToLocal::new(scene_from_local);
                Self::Leaf(Leaf { tag: *tag, index: *leaves - 1, to_local, surfaces: surfaces(primitive) })
            }
            Solid::Union(solids) => Self::Union(all(solids)),
            Solid::Intersection(solids) => Self::Intersection(all(solids)),
            Solid::Difference(solids) => Self::Difference(all(solids)),
        }
    }

    pub fn leaves(&self) -> Vec<&Leaf<N>> {
        match self {
            Self::Leaf(leaf) => vec![leaf],
            Self::Union(of) | Self::Intersection(of) | Self::Difference(of) => {
                of.iter().flat_map(Self::leaves).collect()
            }
        }
    }

    /// Whether a point is inside.
    pub fn contains(&self, point: Vector<N>) -> bool {
        match self {
            Self::Leaf(leaf) => leaf.contains(point),
            Self::Union(of) => of.iter().any(|solid| solid.contains(point)),
            Self::Intersection(of) => of.iter().all(|solid| solid.contains(point)),
            Self::Difference(of) => of[0].contains(point) && !of[1..].iter().any(|solid| solid.contains(point)),
        }
    }

    /// The leaf whose surface shows where a line crosses the solid's boundary between two points: of operands that
    /// coincide there the first.
    pub fn shown(&self, before: Vector<N>, after: Vector<N>) -> Option<&Leaf<N>> {
        let changes = |solid: &Self| solid.contains(before) != solid.contains(after);
        if !changes(self) {
            return None;
        }
        match self {
            Self::Leaf(leaf) => Some(leaf),
            Self::Union(of) | Self::Intersection(of) | Self::Difference(of) => {
                of.iter().find_map(|solid| solid.shown(before, after))
            }
        }
    }
}

impl<N: Number> Leaf<N> {
    pub fn contains(&self, point: Vector<N>) -> bool {
        let p = self.to_local.point(point);
        self.surfaces.iter().all(|surface| surface.at(p) <= N::from_f64(0.0))
    }

    /// Adds the places where a line meets any of its surfaces, inside the primitive or not.
    pub fn meet(&self, origin: Vector<N>, direction: Vector<N>, far: f64, meetings: &mut Vec<Meeting<N>>) {
        let (o, d) = (self.to_local.point(origin), self.to_local.vector(direction));
        for (surface, function) in self.surfaces.iter().enumerate() {
            let places = function.meet(o, d, N::from_f64(far));
            meetings.extend(places.into_iter().map(|t| Meeting { t, leaf: self.index, surface }));
        }
    }

    /// The outward unit normal at a point of one of its surfaces.
    pub fn normal(&self, surface: usize, point: Vector<N>) -> Vector<N> {
        self.to_local.gradient_to_scene(self.surfaces[surface].gradient(self.to_local.point(point))).normalize()
    }
}

fn surfaces<N: Number>(primitive: &Primitive) -> Vec<Surface<N>> {
    let n = N::from_f64;
    let vector = |x, y, z| Vector([n(x), n(y), n(z)]);
    let plane = |x, y, z| Surface::Plane(vector(x, y, z), n(1.0));
    let quadric =
        |squares, linear, constant| Surface::Quadric { squares, products: vector(0.0, 0.0, 0.0), linear, constant };
    let caps = [plane(0.0, -1.0, 0.0), plane(0.0, 1.0, 0.0)];
    match *primitive {
        Primitive::Sphere => vec![quadric(vector(1.0, 1.0, 1.0), vector(0.0, 0.0, 0.0), n(-1.0))],
        Primitive::HalfSpace { normal, offset } => vec![Surface::Plane(Vector::from_f64(normal), n(offset))],
        Primitive::Cube => vec![
            plane(-1.0, 0.0, 0.0),
            plane(1.0, 0.0, 0.0),
            plane(0.0, -1.0, 0.0),
            plane(0.0, 1.0, 0.0),
            plane(0.0, 0.0, -1.0),
            plane(0.0, 0.0, 1.0),
        ],
        Primitive::Cylinder => {
            let side = quadric(vector(1.0, 0.0, 1.0), vector(0.0, 0.0, 0.0), n(-1.0));
            vec![side, caps[0], caps[1]]
        }
        Primitive::Cone { bottom, top } => {
            // x² + z² − (middle + slope y)²
            let half = n(0.5);
            let (middle, slope) = ((n(bottom) + n(top)) * half, (n(top) - n(bottom)) * half);
            let squares = Vector([n(1.0), -(slope * slope), n(1.0)]);
            let linear = Vector([n(0.0), -(n(2.0) * middle * slope), n(0.0)]);
            vec![quadric(squares, linear, -(middle * middle)), caps[0], caps[1]]
        }
        Primitive::Torus { tube } => vec![Surface::Torus(n(tube))],
        Primitive::Quadric(q) => vec![Surface::Quadric {
            squares: Vector::from_f64(q.squares),
            products: Vector::from_f64(q.products),
            linear: Vector::from_f64(q.linear),
            constant: n(q.constant),
        }],
    }
}

impl<N: Number> Surface<N> {
    fn at(&self, p: Vector<N>) -> N {
        let [x, y, z] = p.0;
        match *self {
            Self::Plane(normal, offset) => normal.dot(p) - offset,
            Self::Quadric { squares, products, linear, constant } => {
                let square = Vector([x * x, y * y, z * z]);
                squares.dot(square) + products.dot(Vector([x * y, y * z, z * x])) + linear.dot(p) + constant
            }
            Self::Torus(tube) => {
                let sum = p.dot(p) + N::from_f64(1.0) - tube * tube;
                sum * sum - N::from_f64(4.0) * (x * x + z * z)
            }
        }
    }

    fn gradient(&self, p: Vector<N>) -> Vector<N> {
        let [x, y, z] = p.0;
        let two = N::from_f64(2.0);
        match *self {
            Self::Plane(normal, _) => normal,
            Self::Quadric { squares: s, products: q, linear, .. } => {
                let [xy, yz, zx] = q.0;
                let squares = Vector([two * s.0[0] * x, two * s.0[1] * y, two * s.0[2] * z]);
                squares + Vector([xy * y + zx * z, xy * x + yz * z, yz * y + zx * x]) + linear
            }
            Self::Torus(tube) => {
                let sum = p.dot(p) + N::from_f64(1.0) - tube * tube;
                Vector([x * (sum - two), y * sum, z * (sum - two)])
            }
        }
    }

    /// The places where the line meets the surface, up to the distance `far`: what is farther is parallel but for the
    /// rounding of the scene's numbers.
    fn meet(&self, o: Vector<N>, d: Vector<N>, far: N) -> Vec<N> {
        let n = N::from_f64;
        let is_near = |t: &N| t.abs() <= far;
        match *self {
            Self::Plane(normal, offset) => {
                let speed = normal.dot(d);
                if speed == n(0.0) { Vec::new() } else { vec![(offset - normal.dot(o)) / speed] }
            }
            Self::Quadric { squares: s, products: q, linear, .. } => {
                let [x, y, z] = d.0;
                let a = s.dot(Vector([x * x, y * y, z * z])) + q.dot(Vector([x * y, y * z, z * x]));
                let b = self.gradient(o).dot(d) * n(0.5);
                let c = self.at(o);
                let _ = linear;
                let discriminant = b * b - a * c;
                if discriminant <= n(0.0) {
                    return Vec::new();
                }
                let root = discriminant.sqrt();
                let q = if b < n(0.0) { root - b } else { -root - b };
                let first = if a == n(0.0) { None } else { Some(q / a) };
                first.into_iter().chain([c / q]).collect()
            }
            Self::Torus(tube) => torus(tube, o, d),
        }
        .into_iter()
        .filter(is_near)
        .collect()
    }
}

/// The places where a line meets a torus: the roots of a quartic, each enclosed between those of its derivative.
fn torus<N: Number>(tube: N, o: Vector<N>, d: Vector<N>) -> Vec<N> {
    let n = N::from_f64;
    // Relative to the point nearest to the centre, and in units of the direction's length.
    let speed = d.dot(d).sqrt();
    let d = d * (n(1.0) / speed);
    let shift = -o.dot(d);
    let o = o + d * shift;
    let reach = n(1.0) + tube;
    let square = o.dot(o);
    if square >= reach * reach {
        return Vec::new();
    }
    // (t² + k)² − 4 (a t² + 2 b t + c)
    let k = square + n(1.0) - tube * tube;
    let across = |p: Vector<N>, q: Vector<N>| p.0[0] * q.0[0] + p.0[2] * q.0[2];
    let (a, b, c) = (across(d, d), across(o, d), across(o, o));
    let quartic = [k * k - n(4.0) * c, n(-8.0) * b, n(2.0) * k - n(4.0) * a, n(0.0), n(1.0)];
    let bound = (reach * reach - square).sqrt() + n(1e-3);
    let roots = roots(&quartic, -bound, bound);
    roots.into_iter().map(|root| (root + shift) / speed).collect()
}

/// The roots of a polynomial between two numbers at which it changes its sign; coefficients from the constant on.
fn roots<N: Number>(polynomial: &[N], low: N, high: N) -> Vec<N> {
    let n = N::from_f64;
    let value = |t: N| polynomial.iter().rev().fold(n(0.0), |sum, &coefficient| sum * t + coefficient);
    if polynomial.len() <= 1 {
        return Vec::new();
    }
    let derivative: Vec<N> = (1..polynomial.len()).map(|power| n(power as f64) * polynomial[power]).collect();
    let mut bounds = vec![low];
    bounds.extend(roots(&derivative, low, high));
    bounds.push(high);
    let mut found = Vec::new();
    for pair in bounds.windows(2) {
        let (mut from, mut to) = (pair[0], pair[1]);
        let rises = value(from) < n(0.0);
        if (value(to) < n(0.0)) == rises {
            continue;
        }
        // Halving finds an f64, Newton's steps the rest.
        for _ in 0..50 {
            let middle = (from + to) * n(0.5);
            if (value(middle) < n(0.0)) == rises {
                from = middle;
            } else {
                to = middle;
            }
        }
        let slope = |t: N| derivative.iter().rev().fold(n(0.0), |sum, &coefficient| sum * t + coefficient);
        let mut root = (from + to) * n(0.5);
        for _ in 0..2 {
            let next = root - value(root) / slope(root);
            if (next - root).abs() <= (pair[1] - pair[0]) * n(1e-10) {
                root = next;
            }
        }
        found.push(root);
    }
    found
}

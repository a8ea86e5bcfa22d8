//! Primitives with their transforms folded in: each is stored in the coordinates in which its intersection with a ray
//! is cheapest.

use glam::{DAffine3, DMat3, DVec3};

use super::primitive::carry_half_space;
use super::quadratic::Intervals;
use super::span::{BOTTOM_CAP, CURVED, Spans};
use super::torus;
use super::{LeafIndex, MaterialTag, Primitive};
use crate::geometry::{Aabb, PARALLEL_COSINE, Ray, approach};

/// A face of a leaf of the compiled tree: what a ray hits, and where a secondary ray starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Surface {
    /// The leaf.
    pub leaf: LeafIndex,
    /// The face of the leaf: 0 is the curved one, if there is one; the others are flat.
    pub face: u8,
}

/// A primitive with its transform folded in.
#[derive(Clone, Debug)]
pub struct Leaf {
    shape: Shape,
    /// The caller's tag for its surface.
    pub tag: MaterialTag,
}

#[derive(Clone, Debug)]
enum Shape {
    Ball {
        centre: DVec3,
        radius: f64,
    },
    HalfSpace {
        normal: DVec3,
        offset: f64,
    },
    /// An axis-aligned box. Its faces are numbered −x, +x, −y, +y, −z, +z.
    Block(Aabb),
    /// Sphere, cube, cylinder, cone and torus are stored in local coordinates. The ray is transformed there; its
    /// direction is not normalised again, so that distances along it stay the same.
    Ellipsoid(LocalFrame),
    Cube(LocalFrame),
    Cylinder(LocalFrame),
    /// The radius at height y is `waist + slope (y − base)`. The base is the narrower end, which may be the apex:
    /// coordinates are taken relative to it, since near an apex all quantities that decide about a hit are small.
    Cone {
        frame: LocalFrame,
        base: f64,
        waist: f64,
        slope: f64,
    },
    Torus {
        frame: LocalFrame,
        tube: f64,
    },
    /// q · (square q) + 2 half_linear · q + constant ≤ 0, with q = p − centre.
    Quadric {
        centre: DVec3,
        square: DMat3,
        half_linear: DVec3,
        constant: f64,
        /// [`Magnitudes::greatest`].
        greatest: f64,
        magnitudes: Box<Magnitudes>,
    },
}

/// Bounds of the terms that the coefficients of a quadric are sums of: rounding errors are relative to these.
#[derive(Clone, Debug)]
struct Magnitudes {
    square: DMat3,
    half_linear: DVec3,
    /// Bound of the square term of any direction of length 1.
    greatest: f64,
}

#[derive(Clone, Debug)]
struct LocalFrame {
    local_from_scene: DAffine3,
    /// Outward unit normals of the faces at x = 1, y = 1, z = 1, in scene coordinates. Apart, since no intersection
    /// reads them.
    axis_normals: Box<[DVec3; 3]>,
}

impl Leaf {
    /// Folds the transform into the primitive. Also returns an axis-aligned box that contains it in spite of rounding.
    /// With `shapes`, balls and axis-aligned boxes are stored as such.
    pub(super) fn new(
        primitive: &Primitive,
        scene_from_local: &DAffine3,
        tag: MaterialTag,
        shapes: bool,
    ) -> (Self, Aabb) {
        let local_from_scene = scene_from_local.inverse();
        let to_local = local_from_scene.matrix3;
        let columns =
            [scene_from_local.matrix3.x_axis, scene_from_local.matrix3.y_axis, scene_from_local.matrix3.z_axis];
        let centre = scene_from_local.translation;
        let frame = || LocalFrame {
            local_from_scene,
            // Normals are transformed by the inverse transpose, whose columns are the rows of the inverse.
            axis_normals: Box::new([0, 1, 2].map(|axis| to_local.row(axis).normalize())),
        };
        let round = |a: DVec3, b: DVec3| (a * a + b * b).map(f64::sqrt);
        let about = |half: DVec3| Aabb { min: centre - half, max: centre + half };
        let (shape, bounds) = match *primitive {
            Primitive::Sphere => match uniform_scale(columns).filter(|_| shapes) {
                Some(radius) => (Shape::Ball { centre, radius }, about(DVec3::splat(radius))),
                None => {
                    let half = columns.iter().map(|&column| column * column).sum::<DVec3>().map(f64::sqrt);
                    (Shape::Ellipsoid(frame()), about(half))
                }
            },
            Primitive::HalfSpace { normal, offset } => {
                let (normal, offset) = carry_half_space(normal, offset, &local_from_scene);
                (Shape::HalfSpace { normal, offset }, half_space_bounds(normal, offset))
            }
            Primitive::Cube => {
                let bounds = Aabb::of_cube(scene_from_local);
                let along_axes = shapes && (0..3).all(|i| (0..3).all(|j| i == j || columns[i][j] == 0.0));
                (if along_axes { Shape::Block(bounds) } else { Shape::Cube(frame()) }, bounds)
            }
            Primitive::Cylinder => (Shape::Cylinder(frame()), about(columns[1].abs() + round(columns[0], columns[2]))),
            Primitive::Cone { bottom, top } => {
                let disc = |radius: f64, y: f64| {
                    let (middle, half) = (centre + columns[1] * y, round(columns[0], columns[2]) * radius);
                    Aabb { min: middle - half, max: middle + half }
                };
                let (base, waist) = if top < bottom { (1.0, top) } else { (-1.0, bottom) };
                (
                    Shape::Cone { frame: frame(), base, waist, slope: (top - bottom) / 2.0 },
                    disc(bottom, -1.0).union(disc(top, 1.0)),
                )
            }
            Primitive::Torus { tube } => {
                // The volume swept by a ball of the tube's radius along the circle.
                let [x, y, z] = columns;
                let ball = (x * x + y * y + z * z).map(f64::sqrt) * tube;
                (Shape::Torus { frame: frame(), tube }, about(round(x, z) + ball))
            }
            Primitive::Quadric(q) => {
                let square = q.square();
                let magnitudes = Box::new(Magnitudes::new(to_local, square, q.linear / 2.0));
                let shape = Shape::Quadric {
                    centre,
                    square: to_local.transpose() * square * to_local,
                    half_linear: to_local.transpose() * q.linear / 2.0,
                    constant: q.constant,
                    greatest: magnitudes.greatest,
                    magnitudes,
                };
                (shape, Aabb::ALL)
            }
        };
        (Self { shape, tag }, bounds.padded())
    }

    /// Computes the spans of the whole line inside the leaf. `start` is the face of this leaf on which the ray starts,
    /// if any: the root there is 0 by definition, whatever rounding did to the origin.
    #[inline(always)]
    pub(super) fn spans(&self, ray: &Ray, start: Option<u8>) -> Spans {
        match &self.shape {
            Shape::Ball { centre, radius } => {
                let f = ray.origin - *centre;
                let b = f.dot(ray.direction);
                let inside = if start.is_some() {
                    Intervals::from_surface(1.0, b)
                } else {
                    // Discriminant from the line's closest approach to the centre: accurate for far and for small balls
                    // (Haines, Günther and Akenine-Möller, *Ray Tracing Gems*, ch. 7).
                    let closest = f - ray.direction * b;
                    let squared = radius * radius;
                    Intervals::with_discriminant(
                        1.0,
                        b,
                        f.length_squared() - squared,
                        squared - closest.length_squared(),
                    )
                };
                Spans::curved(inside)
            }
            Shape::HalfSpace { normal, offset } => {
                let speed = approach(*normal, ray.direction);
                let height = if start.is_some() { 0.0 } else { normal.dot(ray.origin) - offset };
                Spans::curved(match speed {
                    _ if speed > 0.0 => Intervals::Between(f64::NEG_INFINITY, -height / speed),
                    _ if speed < 0.0 => Intervals::Between(-height / speed, f64::INFINITY),
                    _ if height < 0.0 => Intervals::Always,
                    _ => Intervals::Never,
                })
            }
            Shape::Block(block) => Spans::slabs(ray.origin, ray.direction, block.min, block.max, start),
            Shape::Cube(frame) => {
                let (o, d) = frame.ray_to_local(ray);
                Spans::slabs(o, d, DVec3::NEG_ONE, DVec3::ONE, start)
            }
            Shape::Ellipsoid(frame) => {
                let (o, d) = frame.ray_to_local(ray);
                let (a, b) = (d.length_squared(), o.dot(d));
                Spans::curved(if start.is_some() {
                    Intervals::from_surface(a, b)
                } else {
                    let closest = o - d * (b / a);
                    Intervals::with_discriminant(a, b, o.length_squared() - 1.0, a * (1.0 - closest.length_squared()))
                })
            }
            Shape::Cylinder(frame) => {
                let (o, d) = frame.ray_to_local(ray);
                let (a, b) = (d.x * d.x + d.z * d.z, o.x * d.x + o.z * d.z);
                let inside = if start == Some(CURVED) {
                    Intervals::from_surface(a, b)
                } else {
                    let across = o.x * d.z - o.z * d.x;
                    Intervals::with_discriminant(a, b, o.x * o.x + o.z * o.z - 1.0, a - across * across)
                };
                Spans::capped(inside, o.y, d.y, start)
            }
            Shape::Cone { frame, base, waist, slope } => {
                let (o, d) = frame.ray_to_local(ray);
                let from_base = o - DVec3::Y * *base;
                let rise = slope * d.y;
                let a = d.x * d.x + d.z * d.z - rise * rise;
                let half = |o: DVec3| o.x * d.x + o.z * d.z - rise * (waist + slope * o.y);
                let inside = if start == Some(CURVED) {
                    Intervals::from_surface(a, half(from_base))
                } else {
                    from_closest_approach(from_base, d, |o| {
                        let radius = waist + slope * o.y;
                        Intervals::solve(a, half(o), o.x * o.x + o.z * o.z - radius * radius)
                    })
                };
                Spans::capped(inside, o.y, d.y, start)
            }
            Shape::Torus { frame, tube } => {
                let (o, d) = frame.ray_to_local(ray);
                torus::spans(*tube, o, d, start.is_some())
            }
            Shape::Quadric { centre, square, half_linear, constant, greatest, magnitudes } => {
                let (o, d) = (ray.origin - *centre, ray.direction);
                let along = *square * d;
                let a = along.dot(d);
                let a = if a.abs() <= PARALLEL_COSINE * greatest { magnitudes.square_term(a, d) } else { a };
                let half = |o: DVec3| {
                    let b = along.dot(o) + half_linear.dot(d);
                    if a == 0.0 { magnitudes.linear_term(b, o, d) } else { b }
                };
                Spans::curved(if start.is_some() {
                    Intervals::from_surface(a, half(o))
                } else {
                    from_closest_approach(o, d, |o| {
                        let c = (*square * o + 2.0 * *half_linear).dot(o) + constant;
                        Intervals::solve(a, half(o), c)
                    })
                })
            }
        }
    }

    /// Counts the crossings of the leaf's boundary by the ray's whole line.
    pub(crate) fn count_crossings(&self, ray: &Ray) -> u64 {
        let Spans { first, second } = self.spans(ray, None);
        2 * (u64::from(first.is_some()) + u64::from(second.is_some()))
    }

    /// The distances at which the ray's whole line enters and leaves a leaf that is convex.
    pub(crate) fn first_span(&self, ray: &Ray) -> Option<[f64; 2]> {
        self.spans(ray, None).first.map(|span| [span.from, span.to])
    }

    /// The name of the shape that the primitive has become.
    pub fn kind(&self) -> &'static str {
        match &self.shape {
            Shape::Ball { .. } => "ball",
            Shape::HalfSpace { .. } => "half-space",
            Shape::Block(_) => "box along the axes",
            Shape::Ellipsoid(_) => "ellipsoid",
            Shape::Cube(_) => "box",
            Shape::Cylinder(_) => "cylinder",
            Shape::Cone { .. } => "cone",
            Shape::Torus { .. } => "torus",
            Shape::Quadric { .. } => "quadric",
        }
    }

    /// Whether every ray has at most one span inside.
    pub(super) fn is_convex(&self) -> bool {
        !matches!(self.shape, Shape::Quadric { .. } | Shape::Torus { .. })
    }

    /// Whether a face of this leaf may coincide with one of another, as far as that is seen without much work.
    pub(super) fn may_share_face(&self, other: &Self) -> bool {
        const ROOM: f64 = 1e-9;
        let [planes, others] = [self, other].map(Self::planes);
        let coincide = |&(normal, offset): &(DVec3, f64), &(other, other_offset): &(DVec3, f64)| {
            let side = normal.dot(other).signum();
            (normal - other * side).length() < ROOM
                && (offset - other_offset * side).abs() <= ROOM * (1.0 + offset.abs())
        };
        if planes.iter().any(|plane| others.iter().any(|other| coincide(plane, other))) {
            return true;
        }
        match (&self.shape, &other.shape) {
            (Shape::Ball { centre, radius }, Shape::Ball { centre: other, radius: other_radius }) => {
                (*centre - *other).length() + (radius - other_radius).abs() <= ROOM * (1.0 + centre.length())
            }
            (Shape::HalfSpace { .. } | Shape::Block(_) | Shape::Cube(_), _)
            | (_, Shape::HalfSpace { .. } | Shape::Block(_) | Shape::Cube(_)) => false,
            (Shape::Quadric { .. }, _) | (_, Shape::Quadric { .. }) => true,
            (one, other) => std::mem::discriminant(one) == std::mem::discriminant(other),
        }
    }

    /// The planes of its flat faces: normals of length 1, and offsets.
    fn planes(&self) -> Vec<(DVec3, f64)> {
        let of_frame = |frame: &LocalFrame, axis: usize| {
            [1.0, -1.0].map(|side| {
                let normal = frame.axis_normals[axis] * side;
                let local = DVec3::AXES[axis] * side;
                (normal, normal.dot(frame.local_from_scene.inverse().transform_point3(local)))
            })
        };
        match &self.shape {
            Shape::HalfSpace { normal, offset } => vec![(*normal, *offset)],
            Shape::Block(block) => {
                let sides =
                    |axis: usize| [(DVec3::AXES[axis], block.max[axis]), (-DVec3::AXES[axis], -block.min[axis])];
                (0..3).flat_map(sides).collect()
            }
            Shape::Cube(frame) => (0..3).flat_map(|axis| of_frame(frame, axis)).collect(),
            Shape::Cylinder(frame) | Shape::Cone { frame, .. } => of_frame(frame, 1).to_vec(),
            Shape::Ball { .. } | Shape::Ellipsoid(_) | Shape::Torus { .. } | Shape::Quadric { .. } => Vec::new(),
        }
    }

    /// Whether a point lies in the leaf, which is convex.
    pub(super) fn contains(&self, point: DVec3) -> bool {
        match &self.shape {
            Shape::Ball { centre, radius } => (point - *centre).length_squared() <= radius * radius,
            Shape::HalfSpace { normal, offset } => normal.dot(point) <= *offset,
            Shape::Block(block) => (block.min.cmple(point) & point.cmple(block.max)).all(),
            Shape::Ellipsoid(frame) => Primitive::Sphere.contains(frame.point_to_local(point)),
            Shape::Cube(frame) => Primitive::Cube.contains(frame.point_to_local(point)),
            Shape::Cylinder(frame) => Primitive::Cylinder.contains(frame.point_to_local(point)),
            Shape::Cone { frame, base, waist, slope } => {
                let q = frame.point_to_local(point);
                let radius = waist + slope * (q.y - base);
                q.x * q.x + q.z * q.z <= radius * radius && q.y.abs() <= 1.0
            }
            Shape::Torus { .. } | Shape::Quadric { .. } => false,
        }
    }

    /// The outward unit normal at a point of one of the faces.
    pub fn normal(&self, face: u8, point: DVec3) -> DVec3 {
        match &self.shape {
            Shape::Ball { centre, radius } => (point - *centre) / *radius,
            Shape::HalfSpace { normal, .. } => *normal,
            Shape::Block(_) => DVec3::AXES[usize::from(face / 2)] * face_sign(face),
            Shape::Cube(frame) => frame.axis_normals[usize::from(face / 2)] * face_sign(face),
            Shape::Cylinder(frame) | Shape::Cone { frame, .. } if face != CURVED => {
                frame.axis_normals[1] * face_sign(face - BOTTOM_CAP)
            }
            Shape::Ellipsoid(frame) => frame.normal_to_scene(frame.point_to_local(point)),
            Shape::Cylinder(frame) => {
                let q = frame.point_to_local(point);
                frame.normal_to_scene(DVec3::new(q.x, 0.0, q.z))
            }
            Shape::Cone { frame, base, waist, slope } => {
                let q = frame.point_to_local(point);
                frame.normal_to_scene(DVec3::new(q.x, -slope * (waist + slope * (q.y - base)), q.z))
            }
            Shape::Torus { frame, .. } => {
                let q = frame.point_to_local(point);
                // The direction from the nearest point of the circle.
                let outward = 1.0 - 1.0 / torus::axis_distance(q);
                frame.normal_to_scene(DVec3::new(q.x * outward, q.y, q.z * outward))
            }
            Shape::Quadric { centre, square, half_linear, .. } => {
                (*square * (point - *centre) + *half_linear).normalize_or(DVec3::Y)
            }
        }
    }
}

impl Magnitudes {
    /// The magnitudes for coefficients that are transformed by `to_local`.
    fn new(to_local: DMat3, square: DMat3, half_linear: DVec3) -> Self {
        let to_scene = to_local.abs().transpose();
        let square = to_scene * square.abs() * to_local.abs();
        let greatest = square.to_cols_array().iter().sum();
        Self { square, half_linear: to_scene * half_linear.abs(), greatest }
    }

    /// The square term `a` along `d`; exactly 0 if it is 0 but for rounding (see [`approach`]).
    #[cold]
    fn square_term(&self, a: f64, d: DVec3) -> f64 {
        if a.abs() <= PARALLEL_COSINE * (self.square * d.abs()).dot(d.abs()) { 0.0 } else { a }
    }

    /// Half the linear term `b` along `d` at `o`; exactly 0 if it is 0 but for rounding.
    #[cold]
    fn linear_term(&self, b: f64, o: DVec3, d: DVec3) -> f64 {
        let terms = (self.square * d.abs()).dot(o.abs()) + self.half_linear.dot(d.abs());
        if b.abs() <= PARALLEL_COSINE * terms { 0.0 } else { b }
    }
}

impl LocalFrame {
    fn ray_to_local(&self, ray: &Ray) -> (DVec3, DVec3) {
        (self.local_from_scene.transform_point3(ray.origin), self.local_from_scene.transform_vector3(ray.direction))
    }

    fn point_to_local(&self, point: DVec3) -> DVec3 {
        self.local_from_scene.transform_point3(point)
    }

    /// Transforms a normal from local to scene coordinates, by the inverse transpose of the transform of points.
    fn normal_to_scene(&self, normal: DVec3) -> DVec3 {
        // The zero vector belongs to the apex of a cone, where no normal is defined.
        (self.local_from_scene.matrix3.transpose() * normal).normalize_or(self.axis_normals[1])
    }
}

/// Solves relative to the line's closest approach to the origin instead of relative to `o`, which may be far away:
/// there the coefficients are small and their differences accurate. `d` need not have length 1.
#[inline(always)]
fn from_closest_approach(o: DVec3, d: DVec3, solve: impl Fn(DVec3) -> Intervals) -> Intervals {
    let shift = -o.dot(d) / d.length_squared();
    match solve(o + d * shift) {
        Intervals::Between(a, b) => Intervals::Between(a + shift, b + shift),
        Intervals::Beyond(a, b) => Intervals::Beyond(a + shift, b + shift),
        whole => whole,
    }
}

/// −1 for an even face, 1 for an odd one.
fn face_sign(face: u8) -> f64 {
    if face.is_multiple_of(2) { -1.0 } else { 1.0 }
}

/// The scale factor of a map with these columns, if it is the same in all directions.
fn uniform_scale(columns: [DVec3; 3]) -> Option<f64> {
    const ROUNDING: f64 = 1e-14;
    let squared = columns[0].length_squared();
    let [x, y, z] = columns;
    let skew = x.dot(y).abs().max(y.dot(z).abs()).max(z.dot(x).abs());
    let stretch = (y.length_squared() - squared).abs().max((z.length_squared() - squared).abs());
    (skew <= ROUNDING * squared && stretch <= ROUNDING * squared).then(|| squared.sqrt())
}

/// The bounds of a half-space: bounded on one side if its normal lies along an axis.
fn half_space_bounds(normal: DVec3, offset: f64) -> Aabb {
    let mut bounds = Aabb::ALL;
    for axis in 0..3 {
        if normal[axis] == 1.0 {
            bounds.max[axis] = offset;
        } else if normal[axis] == -1.0 {
            bounds.min[axis] = -offset;
        }
    }
    bounds
}

//! A ray's spans inside one leaf.

use glam::DVec3;

use super::quadratic::Intervals;

/// The curved face of a ball, cylinder, cone, torus or quadric.
pub(super) const CURVED: u8 = 0;
/// The lower cap of a cylinder or cone; the upper one follows.
pub(super) const BOTTOM_CAP: u8 = 1;

/// A span of a ray inside a leaf, from the face where it enters to the face where it leaves; distances along the ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    pub from: f64,
    pub from_face: u8,
    pub to: f64,
    pub to_face: u8,
}

/// The spans of a ray in a leaf, in order: at most two, as quadrics and tori may have.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Spans {
    pub first: Option<Span>,
    pub second: Option<Span>,
}

impl Spans {
    /// The spans in a leaf with a single, curved face.
    #[inline(always)]
    pub fn curved(inside: Intervals) -> Self {
        let span = |from: f64, to: f64| (from < to).then_some(Span { from, from_face: CURVED, to, to_face: CURVED });
        match inside {
            Intervals::Never => Self::default(),
            Intervals::Always => Self { first: span(f64::NEG_INFINITY, f64::INFINITY), second: None },
            Intervals::Between(from, to) => Self { first: span(from, to), second: None },
            Intervals::Beyond(first, last) => {
                Self { first: span(f64::NEG_INFINITY, first), second: span(last, f64::INFINITY) }
            }
        }
    }

    /// Clips `inside` to the slab between the caps at y = −1 and y = 1. The leaf is convex, so the result is one span:
    /// if rounding at an apex leaves two, the longer.
    #[inline(always)]
    pub fn capped(inside: Intervals, y: f64, speed: f64, start: Option<u8>) -> Self {
        let mut span = Span { from: f64::NEG_INFINITY, from_face: CURVED, to: f64::INFINITY, to_face: CURVED };
        if !span.clip_slab([-1.0, 1.0], y, speed, BOTTOM_CAP, start) {
            return Self::default();
        }
        let clip = |from: f64, to: f64| {
            let mut clipped = span;
            if from > clipped.from {
                (clipped.from, clipped.from_face) = (from, CURVED);
            }
            if to < clipped.to {
                (clipped.to, clipped.to_face) = (to, CURVED);
            }
            (clipped.from < clipped.to).then_some(clipped)
        };
        let first = match inside {
            Intervals::Never => None,
            Intervals::Always => clip(f64::NEG_INFINITY, f64::INFINITY),
            Intervals::Between(from, to) => clip(from, to),
            Intervals::Beyond(first, last) => match (clip(f64::NEG_INFINITY, first), clip(last, f64::INFINITY)) {
                (Some(a), Some(b)) => Some(if a.to - a.from < b.to - b.from { b } else { a }),
                (a, b) => a.or(b),
            },
        };
        Self { first, second: None }
    }

    /// The span in a box, in the coordinates of `o` and `d`.
    #[inline(always)]
    pub fn slabs(o: DVec3, d: DVec3, min: DVec3, max: DVec3, start: Option<u8>) -> Self {
        if start.is_some() || d.x == 0.0 || d.y == 0.0 || d.z == 0.0 {
            return Self::slabs_one_by_one(o, d, min, max, start);
        }
        // No branch: which face a ray meets first cannot be foretold.
        let (a, b) = ((min - o) / d, (max - o) / d);
        let mut span = Span { from: f64::NEG_INFINITY, from_face: 0, to: f64::INFINITY, to_face: 0 };
        for axis in 0..3 {
            let is_backwards = d[axis] < 0.0;
            let (near, far) = if is_backwards { (b[axis], a[axis]) } else { (a[axis], b[axis]) };
            let face = 2 * axis as u8;
            let is_last_entry = near > span.from;
            span.from = if is_last_entry { near } else { span.from };
            span.from_face = if is_last_entry { face + u8::from(is_backwards) } else { span.from_face };
            let is_first_exit = far < span.to;
            span.to = if is_first_exit { far } else { span.to };
            span.to_face = if is_first_exit { face + u8::from(!is_backwards) } else { span.to_face };
        }
        Self { first: (span.from < span.to).then_some(span), second: None }
    }

    /// Does the same for a ray along an axis, or from a face.
    #[cold]
    fn slabs_one_by_one(o: DVec3, d: DVec3, min: DVec3, max: DVec3, start: Option<u8>) -> Self {
        let mut span = Span { from: f64::NEG_INFINITY, from_face: 0, to: f64::INFINITY, to_face: 0 };
        for axis in 0..3 {
            if !span.clip_slab([min[axis], max[axis]], o[axis], d[axis], 2 * axis as u8, start) {
                return Self::default();
            }
        }
        Self { first: Some(span), second: None }
    }
}

impl Span {
    /// Clips the span to the slab between two parallel planes, whose faces are `face` and `face + 1`. Returns false if
    /// nothing is left.
    #[inline(always)]
    fn clip_slab(&mut self, planes: [f64; 2], position: f64, speed: f64, face: u8, start: Option<u8>) -> bool {
        if speed == 0.0 {
            return planes[0] < position && position < planes[1];
        }
        let distance = |side: u8| {
            if start == Some(face + side) { 0.0 } else { (planes[usize::from(side)] - position) / speed }
        };
        let (near, far) = if speed > 0.0 { (0, 1) } else { (1, 0) };
        let (from, to) = (distance(near), distance(far));
        if from > self.from {
            (self.from, self.from_face) = (from, face + near);
        }
        if to < self.to {
            (self.to, self.to_face) = (to, face + far);
        }
        self.from < self.to
    }
}

//! Up to eight boxes, tested by a ray at once.
//!
//! A test looks at as many boxes as the vectors hold that every processor of the kind has: to call code for longer
//! ones costs more than it saves (Wald, Benthin and Boulos, *Getting Rid of Packets*, 2008). The boxes and a copy of
//! the ray are in single precision, and the boxes are larger by more than all rounding. What they contain is tested in
//! double precision: so they save work, and never decide about a hit.

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f32x8};
use glam::DVec3;

use super::{Aabb, Ray, fast_max, fast_min};

/// The number of boxes in [`Boxes`].
pub const WIDTH: usize = 8;

/// A part of the size of everything. Boxes are larger by so much on each side: more than the rounding to single
/// precision of boxes, of rays that are within twice the size, and of what is computed from them.
const ROUNDING: f64 = 1.0 / (1 << 20) as f64;

/// The middle and the size of everything: coordinates in single precision are relative to these.
#[derive(Clone, Copy, Debug)]
pub struct BoxFrame {
    centre: DVec3,
    /// The greatest distance of a side from the centre.
    half: f64,
}

/// Up to eight boxes, by axis and then by number. What is no box is upside down, so that no ray meets it.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct Boxes {
    min: [[f32; WIDTH]; 3],
    max: [[f32; WIDTH]; 3],
}

/// A ray in single precision, for tests of boxes in one frame.
#[derive(Clone, Copy, Debug)]
pub struct BoxRay {
    /// The distance along the ray at which its copy starts: near the centre, where coordinates are small.
    skipped: f64,
    origin: [f32; 3],
    inverse: [f32; 3],
}

impl BoxFrame {
    /// The frame of boxes within `bounds`.
    pub fn new(bounds: Aabb) -> Self {
        let is_usable = bounds.is_finite() && !bounds.is_empty();
        let bounds = if is_usable { bounds } else { Aabb { min: DVec3::ZERO, max: DVec3::ZERO } };
        let (centre, half) = (bounds.centre(), ((bounds.max - bounds.min) * 0.5).max_element());
        // Of a box that is smaller than rounding at its place, the coordinates would be noise.
        Self { centre, half: fast_max(half, 1e-9 * centre.length()) }
    }

    /// The copy of a ray.
    #[inline(always)]
    pub fn ray(&self, ray: &Ray) -> BoxRay {
        const MAX_INVERSE: f64 = 1e30;
        // A ray that passes by the centre farther away than twice the size meets no box, however it is rounded.
        let skipped = (self.centre - ray.origin).dot(ray.direction);
        let origin = ray.at(skipped) - self.centre;
        let inverse = ray
            .inverse_direction
            .to_array()
            .map(|inverse| fast_min(fast_max(inverse, -MAX_INVERSE), MAX_INVERSE) as f32);
        BoxRay { skipped, origin: origin.as_vec3().to_array(), inverse }
    }
}

impl Boxes {
    /// No boxes.
    pub const NONE: Self = Self { min: [[f32::INFINITY; WIDTH]; 3], max: [[f32::NEG_INFINITY; WIDTH]; 3] };

    /// Adds a box. One that is not finite is met by every ray.
    ///
    /// # Panics
    /// If there are eight.
    pub fn add(&mut self, bounds: Aabb, frame: &BoxFrame) {
        let place = self.min[0].iter().position(|min| *min == f32::INFINITY).expect("there is room for a box");
        let bounds = if bounds.is_finite() { bounds } else { Aabb::ALL };
        let room = DVec3::splat(frame.half * ROUNDING);
        let (min, max) = (bounds.min - frame.centre - room, bounds.max - frame.centre + room);
        for axis in 0..3 {
            self.min[axis][place] = (min[axis] as f32).next_down();
            self.max[axis][place] = (max[axis] as f32).next_up();
        }
    }
}

impl BoxRay {
    /// Finds the boxes that the ray meets between two places: a bit for each, and in `entry` the place where it enters
    /// each of them.
    #[inline(always)]
    pub fn meets(&self, boxes: &Boxes, range: [f32; 2], entry: &mut [f32; WIDTH]) -> u64 {
        self.meets_at(Level::baseline(), boxes, range, entry)
    }

    /// Does the same in vectors of this `level`.
    #[inline(always)]
    pub(crate) fn meets_at(&self, level: Level, boxes: &Boxes, range: [f32; 2], entry: &mut [f32; WIDTH]) -> u64 {
        dispatch!(level, simd => meets(simd, self, boxes, range, entry))
    }

    /// A distance along the ray as a place, which is relative to the start of the ray's copy. Its rounding is less than
    /// the room around the boxes, unless it lies far behind all of them.
    #[inline(always)]
    pub fn place(&self, t: f64) -> f32 {
        (t - self.skipped) as f32
    }
}

/// The same as [`Aabb::entry`], for all boxes at once. No closures: code for a processor's vectors is not inlined into
/// them.
#[inline(always)]
fn meets<S: Simd>(simd: S, ray: &BoxRay, boxes: &Boxes, range: [f32; 2], entry: &mut [f32; WIDTH]) -> u64 {
    let (mut near, mut far) = (f32x8::splat(simd, range[0]), f32x8::splat(simd, range[1]));
    for axis in 0..3 {
        let (origin, inverse) = (ray.origin[axis], ray.inverse[axis]);
        let is_forwards = inverse >= 0.0;
        let (first, last) =
            if is_forwards { (&boxes.min[axis], &boxes.max[axis]) } else { (&boxes.max[axis], &boxes.min[axis]) };
        let first = (f32x8::from_slice(simd, first) - origin) * inverse;
        let last = (f32x8::from_slice(simd, last) - origin) * inverse;
        near = near.max(first);
        far = far.min(last);
    }
    near.store_slice(entry);
    near.simd_le(far).to_bitmask()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn vector(size: f64) -> impl Strategy<Value = DVec3> {
        let number = move || prop_oneof![-size..size, (-3..=3).prop_map(f64::from)];
        [number(), number(), number()].prop_map(DVec3::from)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(5000))]

        /// From near and from afar, at every level that this processor has.
        #[test]
        fn no_box_that_a_ray_meets_is_left_out(
            corners in prop::collection::vec((vector(5.0), [0.01..2.0f64, 0.01..2.0, 0.01..2.0]), 1..=WIDTH),
            origin in vector(5.0), way in vector(1.0), away in 0.0..7.0f64, shift in vector(1e4),
            range in [-9.0..9.0f64, 0.0..9.0],
        ) {
            let direction = way.normalize_or(DVec3::X);
            let away = 10f64.powf(away) - 1.0;
            let ray = Ray::new(origin + shift - direction * away, direction);
            let range = [away + range[0], away + range[0] + range[1]];
            let bounds: Vec<Aabb> = corners
                .into_iter()
                .map(|(corner, size)| Aabb { min: corner + shift, max: corner + shift + DVec3::from(size) })
                .collect();
            let all = bounds.iter().fold(Aabb::EMPTY, |all, &one| all.union(one));
            for level in [Level::new(), Level::baseline()] {
                let frame = BoxFrame::new(all);
                let mut boxes = Boxes::NONE;
                bounds.iter().for_each(|&one| boxes.add(one, &frame));
                let mut entry = [0.0; WIDTH];
                let single = frame.ray(&ray);
                let met = single.meets_at(level, &boxes, range.map(|t| single.place(t)), &mut entry);
                for (place, one) in bounds.iter().enumerate() {
                    if one.entry(&ray, range[0], range[1]).is_some() {
                        prop_assert!(met >> place & 1 == 1, "box {} of {:?}", place, one);
                    }
                }
            }
        }
    }
}

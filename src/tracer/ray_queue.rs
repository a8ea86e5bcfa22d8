//! The order in which the rays of a sample's tree are traced.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use glam::DVec3;

use super::media::Media;
use super::observer::RayKind;
use crate::csg::RayStart;
use crate::geometry::Ray;

/// A ray that waits to be traced.
#[derive(Clone, Copy, Debug)]
pub(super) struct QueuedRay {
    pub kind: RayKind,
    /// The factor of the ray's colour in the sample's colour, for red, green and blue.
    pub weight: DVec3,
    /// Its level in the tree of rays; 1 for a primary ray.
    pub level: u32,
    /// Its number among the sample's rays, in the order of tracing.
    pub number: u64,
    /// The number of its parent, the ray at whose end it starts.
    pub from: Option<u64>,
    pub ray: Ray,
    pub start: Option<RayStart>,
    /// The media that it starts in.
    pub media: Media,
}

impl QueuedRay {
    /// The greatest part of its weight: the ray's place in the order, and what it counts for the cutoff.
    #[inline(always)]
    fn greatest_weight(&self) -> f64 {
        self.weight.max_element()
    }
}

/// The greatest number of rays that wait in the order of their weights. Further rays are traced first, so that a sample
/// with any number of rays takes a few megabytes at most.
const MAX_WAITING_RAYS: usize = 1 << 16;

/// An overflowing ray is left out if its weight is at most this part of the weight that may still be left out:
/// otherwise each would be followed down to the last level.
const NEGLIGIBLE_PART: f64 = 1e-3;

/// The rays of a sample that wait to be traced.
///
/// The ray with the greatest weight is traced first, until the total weight of all that wait is at most the cutoff. So
/// the error has a bound. Ending each ray where it is weak (Hall and Greenberg, *A Testbed for Realistic Image
/// Synthesis*, 1983) gives no bound for the sum of many weak branches.
#[derive(Debug, Default)]
pub(super) struct RayQueue {
    waiting: BinaryHeap<Waiting>,
    /// The waiting rays, and free slots between them.
    slots: Vec<QueuedRay>,
    free_slots: Vec<u32>,
    /// Rays to be traced before those that wait, the last one first.
    overflow: Vec<QueuedRay>,
    /// The total weight of all rays in the queue and of those left out.
    weight: f64,
    /// The weight of overflowing rays that were left out: at most half the cutoff.
    left_out: f64,
    /// The number of overflowing rays that were left out.
    rays_left_out: u64,
    /// The number of rays that were traced.
    traced: u64,
}

/// A waiting ray: its weight, the number of its parent, and its slot.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Waiting(f64, Reverse<u64>, u32);

impl Eq for Waiting {}

impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> Ordering {
        // Of equal weights the ray with the older parent comes first, so that the order is always the same.
        self.0.total_cmp(&other.0).then(self.1.cmp(&other.1)).then(self.2.cmp(&other.2))
    }
}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl RayQueue {
    /// Empties the queue for a sample whose primary ray is traced now.
    pub fn restart(&mut self) {
        self.waiting.clear();
        self.slots.clear();
        self.free_slots.clear();
        self.overflow.clear();
        self.weight = 0.0;
        self.left_out = 0.0;
        self.rays_left_out = 0;
        self.traced = 1;
    }

    #[inline(always)]
    pub fn add(&mut self, ray: QueuedRay) {
        self.weight += ray.greatest_weight();
        if self.waiting.len() == MAX_WAITING_RAYS {
            self.overflow.push(ray);
            return;
        }
        let slot = self.free_slots.pop().unwrap_or(self.slots.len() as u32);
        match self.slots.get_mut(slot as usize) {
            Some(free) => *free = ray,
            None => self.slots.push(ray),
        }
        self.waiting.push(Waiting(ray.greatest_weight(), Reverse(ray.from.unwrap_or(0)), slot));
    }

    /// The next ray to be traced; none if the remaining weight is at most `cutoff`.
    #[inline(always)]
    pub fn next(&mut self, cutoff: f64) -> Option<QueuedRay> {
        if self.weight <= cutoff {
            return None;
        }
        let next = self.next_overflow(cutoff).or_else(|| {
            let Waiting(_, _, slot) = self.waiting.pop()?;
            self.free_slots.push(slot);
            Some(self.slots[slot as usize])
        })?;
        self.weight -= next.greatest_weight();
        let number = self.traced;
        self.traced += 1;
        Some(QueuedRay { number, ..next })
    }

    /// The total weight of the rays that were not traced.
    pub fn remaining_weight(&self) -> f64 {
        self.weight
    }

    /// The number of rays that were not traced.
    pub fn remaining_rays(&self) -> u64 {
        (self.waiting.len() + self.overflow.len()) as u64 + self.rays_left_out
    }

    #[inline(always)]
    fn next_overflow(&mut self, cutoff: f64) -> Option<QueuedRay> {
        while let Some(next) = self.overflow.pop() {
            let weight = next.greatest_weight();
            if weight > NEGLIGIBLE_PART * (cutoff / 2.0 - self.left_out) {
                return Some(next);
            }
            self.left_out += weight;
            self.rays_left_out += 1;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn ray_of(weight: f64) -> QueuedRay {
        let ray = Ray::new(DVec3::ZERO, DVec3::Y);
        let (kind, level, number) = (RayKind::Reflected, 2, 0);
        QueuedRay {
            kind,
            weight: DVec3::splat(weight),
            level,
            number,
            from: Some(0),
            ray,
            start: None,
            media: Media::default(),
        }
    }

    proptest! {
        #[test]
        fn heaviest_ray_is_first_and_remainder_is_below_cutoff(
            weights in prop::collection::vec(1e-6..1.0f64, 0..50), cutoff in 0.0..3.0f64
        ) {
            let mut queue = RayQueue::default();
            queue.restart();
            weights.iter().for_each(|&weight| queue.add(ray_of(weight)));
            let traced: Vec<f64> = std::iter::from_fn(|| queue.next(cutoff)).map(|ray| ray.weight.x).collect();
            prop_assert!(traced.is_sorted_by(|a, b| a >= b));
            let mut left = weights;
            left.sort_by(|a, b| b.total_cmp(a));
            prop_assert_eq!(&left[..traced.len()], &traced[..]);
            prop_assert!(left[traced.len()..].iter().sum::<f64>() <= cutoff + 1e-12);
            // With one ray less the remaining weight would exceed the cutoff.
            prop_assert!(traced.is_empty() || left[traced.len() - 1..].iter().sum::<f64>() > cutoff - 1e-12);
        }
    }

    #[test]
    fn many_rays_take_little_memory() {
        let mut queue = RayQueue::default();
        queue.restart();
        queue.add(ray_of(1.0));
        for _ in 0..1_000_000 {
            let next = queue.next(0.0).expect("more of them");
            queue.add(QueuedRay { level: next.level + 1, ..ray_of(next.weight.x * 0.6) });
            if next.level < 60 {
                queue.add(QueuedRay { level: next.level + 1, ..ray_of(next.weight.x * 0.4) });
            }
        }
        assert!(queue.slots.len() <= MAX_WAITING_RAYS && queue.overflow.len() < 100);
    }
}

//! The tree of rays of a sample: which of its rays is traced next.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use super::media::Media;
use super::observer::RayKind;
use crate::csg::RayStart;
use crate::geometry::Ray;

/// A ray of the tree of rays.
#[derive(Clone, Copy, Debug)]
pub(super) struct QueuedRay {
    pub kind: RayKind,
    /// What the sample keeps of the ray's colour.
    pub weight: f64,
    /// 1 for a primary ray.
    pub level: u32,
    /// Its number among the sample's rays, as they are traced.
    pub number: u64,
    /// That of the ray at whose end it starts.
    pub from: Option<u64>,
    pub ray: Ray,
    pub start: Option<RayStart>,
    /// What it is in.
    pub media: Media,
}

/// So many rays wait in the order of their weights at most; others are traced at once, so that however many rays a
/// sample needs, they take some megabytes at most.
const MAX_WAITING_RAYS: usize = 1 << 16;

/// Of those that are traced at once, one is left out that counts no more than this part of what may still be left out:
/// else each would be followed to the last level.
const NEGLIGIBLE_PART: f64 = 1e-3;

/// The rays of a sample that wait to be traced.
///
/// The ray that counts most is traced first, until all that wait together count no more than the cutoff. So what is lost
/// has a limit: to end each branch where it is weak (Hall and Greenberg, *A Testbed for Realistic Image Synthesis*, 1983)
/// says nothing of what many weak queue add up to.
#[derive(Debug, Default)]
pub(super) struct RayQueue {
    waiting: BinaryHeap<Waiting>,
    /// Where those that wait are, and slots that are free_slots.
    slots: Vec<QueuedRay>,
    free_slots: Vec<u32>,
    /// To be traced before those that wait, the last one first.
    overflow: Vec<QueuedRay>,
    /// What all of them count together, and what was left out already.
    weight: f64,
    /// What was left out of those to be traced at once: at most half of the cutoff.
    left_out: f64,
    /// How many rays these are.
    rays_left_out: u64,
    /// How many were traced.
    traced: u64,
}

/// A branch that waits: its weight, when it came, and its slot.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Waiting(f64, Reverse<u64>, u32);

impl Eq for Waiting {}

impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> Ordering {
        // Of equal ones that which starts at the older ray, so that the order is always the same.
        self.0.total_cmp(&other.0).then(self.1.cmp(&other.1)).then(self.2.cmp(&other.2))
    }
}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl RayQueue {
    /// Begins with a primary ray, which is traced now.
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
    pub fn add(&mut self, branch: QueuedRay) {
        self.weight += branch.weight;
        if self.waiting.len() == MAX_WAITING_RAYS {
            self.overflow.push(branch);
            return;
        }
        let slot = self.free_slots.pop().unwrap_or(self.slots.len() as u32);
        match self.slots.get_mut(slot as usize) {
            Some(free_slots) => *free_slots = branch,
            None => self.slots.push(branch),
        }
        self.waiting.push(Waiting(branch.weight, Reverse(branch.from.unwrap_or(0)), slot));
    }

    /// The next to be traced, unless what waits counts no more than `cutoff`.
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
        self.weight -= next.weight;
        let number = self.traced;
        self.traced += 1;
        Some(QueuedRay { number, ..next })
    }

    /// What all of them that were not traced count together.
    pub fn remaining_weight(&self) -> f64 {
        self.weight
    }

    /// How many of them were not traced.
    pub fn remaining_rays(&self) -> u64 {
        (self.waiting.len() + self.overflow.len()) as u64 + self.rays_left_out
    }

    #[inline(always)]
    fn next_overflow(&mut self, cutoff: f64) -> Option<QueuedRay> {
        while let Some(next) = self.overflow.pop() {
            if next.weight > NEGLIGIBLE_PART * (cutoff / 2.0 - self.left_out) {
                return Some(next);
            }
            self.left_out += next.weight;
            self.rays_left_out += 1;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use proptest::prelude::*;

    use super::*;

    fn branch(weight: f64) -> QueuedRay {
        let ray = Ray::new(DVec3::ZERO, DVec3::Y);
        let (kind, level, number) = (RayKind::Reflected, 2, 0);
        QueuedRay { kind, weight, level, number, from: Some(0), ray, start: None, media: Media::default() }
    }

    proptest! {
        #[test]
        fn what_counts_most_comes_first_and_what_is_left_counts_no_more_than_the_cutoff(
            weights in prop::collection::vec(1e-6..1.0f64, 0..50), cutoff in 0.0..3.0f64
        ) {
            let mut queue = RayQueue::default();
            queue.restart();
            weights.iter().for_each(|&weight| queue.add(branch(weight)));
            let traced: Vec<f64> = std::iter::from_fn(|| queue.next(cutoff)).map(|branch| branch.weight).collect();
            prop_assert!(traced.is_sorted_by(|a, b| a >= b));
            let mut left = weights;
            left.sort_by(|a, b| b.total_cmp(a));
            prop_assert_eq!(&left[..traced.len()], &traced[..]);
            prop_assert!(left[traced.len()..].iter().sum::<f64>() <= cutoff + 1e-12);
            // One ray less would not have been enough.
            prop_assert!(traced.is_empty() || left[traced.len() - 1..].iter().sum::<f64>() > cutoff - 1e-12);
        }
    }

    #[test]
    fn however_many_rays_there_are_they_take_little_memory() {
        let mut queue = RayQueue::default();
        queue.restart();
        queue.add(branch(1.0));
        for _ in 0..1_000_000 {
            let next = queue.next(0.0).expect("more of them");
            queue.add(QueuedRay { level: next.level + 1, ..branch(next.weight * 0.6) });
            if next.level < 60 {
                queue.add(QueuedRay { level: next.level + 1, ..branch(next.weight * 0.4) });
            }
        }
        assert!(queue.slots.len() <= MAX_WAITING_RAYS && queue.overflow.len() < 100);
    }
}

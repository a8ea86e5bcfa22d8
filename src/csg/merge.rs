//! The boolean operations on a ray's spans (Roth, *Ray Casting for Modeling Solids*, 1982).
//!
//! Spans are stored as sorted crossings: those with even index enter, those with odd index leave. Crossings of the two
//! operands that differ by less than the ray's tolerance are one crossing, and only a change of the combined state is
//! kept. So coincident faces, which rounding puts in any order, leave no slivers, neither of solid nor of void.

use super::Surface;
use crate::geometry::{Ray, fast_min};

/// A point where a ray enters or leaves a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Distance along the ray; infinite where the solid is unbounded.
    pub t: f64,
    /// The face that the ray crosses.
    pub surface: Surface,
}

/// A boolean operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// The points in at least one operand.
    Union,
    /// The points in all operands.
    Intersection,
    /// The points in the first operand and in none of the others.
    Difference,
}

/// Combines the operands `stack[first..second]` and `stack[second..]`, and replaces them by the result.
pub(super) fn merge(operation: Operation, stack: &mut Vec<Crossing>, first: usize, second: usize, ray: &Ray) {
    match (operation, first == second, second == stack.len()) {
        (_, false, false) => {}
        (Operation::Union, ..) | (Operation::Difference, _, true) => return,
        _ => return stack.truncate(first),
    }
    // The compiler makes a loop for each operation.
    match operation {
        Operation::Union => merge_by(|a, b| a | b, true, stack, first, second, ray),
        Operation::Intersection => merge_by(|a, b| a & b, false, stack, first, second, ray),
        Operation::Difference => merge_by(|a, b| a & !b, false, stack, first, second, ray),
    }
}

/// Does the same for the operation that `combine` computes.
#[inline(always)]
fn merge_by(
    combine: impl Fn(bool, bool) -> bool,
    is_union: bool,
    stack: &mut Vec<Crossing>,
    first: usize,
    second: usize,
    ray: &Ray,
) {
    let end = stack.len();
    let (mut a, mut b) = (first, second);
    let (mut in_a, mut in_b, mut state) = (false, false, false);
    let (mut next_a, mut next_b) = (stack[a].t, stack[b].t);
    // Without the first operand, only a union has crossings.
    while a < second || b < end && is_union {
        let nearest = fast_min(next_a, next_b);
        // Infinite for an infinite crossing only.
        let group = nearest + ray.tolerance(fast_min(nearest.abs(), f64::MAX));
        let (group_a, group_b) = (a, b);
        let (was_in_a, was_in_b) = (in_a, in_b);
        while next_a <= group && a < second {
            in_a = !in_a;
            a += 1;
            next_a = if a < second { stack[a].t } else { f64::INFINITY };
        }
        while next_b <= group && b < end {
            in_b = !in_b;
            b += 1;
            next_b = if b < end { stack[b].t } else { f64::INFINITY };
        }
        let now = combine(in_a, in_b);
        if now != state {
            state = now;
            // Of coincident faces the first operand's is seen, if it changed anything at all. A union's operands need
            // not be in scene order, but their leaves are numbered in it.
            let (changed_a, changed_b) = (in_a != was_in_a, in_b != was_in_b);
            let is_first = !changed_b || !is_union || stack[group_a].surface.leaf < stack[group_b].surface.leaf;
            let crossing = stack[if changed_a && is_first { group_a } else { group_b }];
            stack.push(crossing);
        }
    }
    stack.copy_within(end.., first);
    stack.truncate(first + stack.len() - end);
}

//! The boolean operations on a ray's spans (Roth, *Ray Casting for Modeling Solids*, 1982).
//!
//! Spans are stored as sorted crossings: those with even index enter, those with odd index leave. Crossings of the two
//! operands that differ by less than the ray's tolerance are one crossing, and only a change of the combined state is
//! kept. So coincident faces, which rounding puts in any order, leave no slivers, neither of solid nor of void.

use super::Surface;
use crate::geometry::Ray;

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

impl Operation {
    fn combine(self, a: bool, b: bool) -> bool {
        match self {
            Self::Union => a | b,
            Self::Intersection => a & b,
            Self::Difference => a & !b,
        }
    }
}

/// Combines the operands `stack[first..second]` and `stack[second..]`, and replaces them by the result.
pub(super) fn merge(operation: Operation, stack: &mut Vec<Crossing>, first: usize, second: usize, ray: &Ray) {
    let end = stack.len();
    match (first == second, second == end) {
        (true, _) if operation == Operation::Union => return,
        (_, true) if operation != Operation::Intersection => return,
        (true, _) | (_, true) => return stack.truncate(first),
        _ => {}
    }
    let (mut a, mut b) = (first, second);
    let (mut in_a, mut in_b, mut state) = (false, false, false);
    while a < second || b < end {
        let next = |at: usize, end: usize| if at < end { stack[at].t } else { f64::INFINITY };
        let nearest = next(a, second).min(next(b, end));
        let group = if nearest.is_finite() { nearest + ray.tolerance(nearest) } else { nearest };
        let (group_a, group_b) = (a, b);
        while a < second && stack[a].t <= group {
            in_a = !in_a;
            a += 1;
        }
        while b < end && stack[b].t <= group {
            in_b = !in_b;
            b += 1;
        }
        let now = operation.combine(in_a, in_b);
        if now != state {
            state = now;
            // Of coincident faces the first operand's is seen, if it changed anything at all. A union's operands need
            // not be in scene order, but their leaves are numbered in it.
            let (changed_a, changed_b) = ((a - group_a) % 2 == 1, (b - group_b) % 2 == 1);
            let is_first = !changed_b
                || operation != Operation::Union
                || stack[group_a].surface.leaf < stack[group_b].surface.leaf;
            let crossing = stack[if changed_a && is_first { group_a } else { group_b }];
            stack.push(crossing);
        }
        if a == second && !in_a && operation != Operation::Union {
            break;
        }
    }
    stack.copy_within(end.., first);
    stack.truncate(first + stack.len() - end);
}

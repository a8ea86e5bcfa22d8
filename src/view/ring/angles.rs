//! Angles, arcs and curves of the ring.

use std::f32::consts::{PI, TAU};

use crate::view::draw::display_list::Point;

/// Returns the angle of a node of `nodes` round the centre, in radians, clockwise from the right; node 0 is at the top.
pub(crate) fn direction(node: usize, nodes: usize) -> f32 {
    TAU * node as f32 / nodes.max(1) as f32 - PI / 2.0
}

/// Returns points on an arc round `centre`; clockwise if `sweep` is positive. Angles are in radians.
pub(crate) fn arc(centre: Point, radius: f32, start: f32, sweep: f32) -> Vec<Point> {
    let pieces = (sweep.abs() * radius.sqrt()).ceil().max(2.0) as usize;
    let at = |i: usize| {
        let angle = start + sweep * i as f32 / pieces as f32;
        [centre[0] + radius * angle.cos(), centre[1] + radius * angle.sin()]
    };
    (0..=pieces).map(at).collect()
}

/// Evaluates the quadratic Bézier curve from `from` to `to` with the control point `bend` at `t`, 0 to 1.
pub(crate) fn curve(from: Point, bend: Point, to: Point, t: f32) -> Point {
    let (a, b, c) = ((1.0 - t) * (1.0 - t), 2.0 * t * (1.0 - t), t * t);
    [a * from[0] + b * bend[0] + c * to[0], a * from[1] + b * bend[1] + c * to[1]]
}

/// Eases `t`, 0 to 1, with smoothstep: slow at both ends.
pub(crate) fn ease(t: f32) -> f32 {
    t * t * (3.0 - 2.0 * t)
}

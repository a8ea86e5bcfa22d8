//! Positions in the ring's drawing.

use std::f32::consts::{PI, TAU};

use super::angles::direction;
use super::labels::{LabelForm, Labels};
use crate::balance::{NodeId, Party};
use crate::language::Language;
use crate::view::draw::display_list::{Point, TextSize};

/// Positions and radii of the ring's parts, for a number of nodes and a size. Computed once a frame.
#[derive(Clone, Copy, Debug)]
pub struct RingLayout {
    /// Number of nodes.
    pub(crate) nodes: usize,
    /// Centre of the ring: the parent.
    pub(crate) centre: Point,
    /// Radius of the rail on which offers move.
    pub(crate) rail_radius: f32,
    /// Radius of the circle on which the nodes are.
    pub(crate) seat_radius: f32,
    /// Radius of a node at full speed.
    pub(crate) node_radius: f32,
    /// Radius of the parent.
    pub(crate) parent_radius: f32,
    /// Form of the labels.
    pub(crate) labels: Labels,
}

impl RingLayout {
    /// Radius of a node's progress arc, as a multiple of `node_radius`.
    pub(crate) const TRACK_RADIUS: f32 = 1.2;

    /// Lays out a ring of `nodes` in an area with its corner at 0, 0, in the units of the text sizes.
    pub fn new(nodes: usize, [width, height]: Point, language: Language) -> Self {
        let (labels, rail_radius) = Labels::fit(nodes, [width, height], language);
        let rail_radius = rail_radius.max(40.0);
        let half_chord = (PI / nodes.max(2) as f32).sin();
        // Two neighbours with their progress arcs fill at most three quarters of the chord between them.
        let node_radius = (rail_radius * 0.155).min(0.66 * rail_radius * half_chord / (1.0 + half_chord));
        let seat_radius = rail_radius - node_radius * 1.3 - 8.0;
        let centre = [width / 2.0, height / 2.0];
        let parent_radius = rail_radius * 0.22;
        Self { nodes, centre, rail_radius, seat_radius, node_radius, parent_radius, labels }
    }

    /// Returns the angle of an offer's path along the rail, anticlockwise: to the left neighbour, or further.
    pub(crate) fn offer_sweep(&self, from: NodeId, to: Party) -> f32 {
        let Party::Node(to) = to else { return self.node_step() };
        let nodes = self.nodes.max(1);
        let steps = (usize::from(from) + nodes - usize::from(to) % nodes) % nodes;
        self.node_step() * if steps == 0 { nodes } else { steps } as f32
    }

    /// Returns the width of a node's progress arc.
    pub(crate) fn track_width(&self) -> f32 {
        (self.node_radius * 0.13).max(2.0)
    }

    /// Returns the radius of a node with its progress arc and the margin round it.
    pub(crate) fn node_reach(&self) -> f32 {
        self.node_radius * Self::TRACK_RADIUS + self.track_width()
    }

    /// Returns the ends of the path between two nodes, or from the parent to a node. They are at the rims, so no
    /// message covers a number.
    pub(crate) fn path_ends(&self, from: Point, to: Point) -> (Point, Point) {
        let bend = self.bend(from, to);
        let towards = |start: Point, by: f32| {
            let way = [bend[0] - start[0], bend[1] - start[1]];
            let length = way[0].hypot(way[1]).max(1.0);
            [start[0] + way[0] * by / length, start[1] + way[1] * by / length]
        };
        let start = if from == self.centre { self.parent_radius } else { self.node_reach() };
        (towards(from, start), towards(to, self.node_reach()))
    }

    /// Whether nothing of the ring is ever drawn between these left, top, right and bottom sides.
    pub(crate) fn is_free(&self, [left, top, right, bottom]: [f32; 4], language: Language) -> bool {
        const GAP_PX: f32 = 4.0;
        let [x, y] = self.centre;
        let away = (left - x).max(x - right).max(0.0).hypot((top - y).max(y - bottom).max(0.0));
        let misses = |node: usize| {
            let angle = direction(node, self.nodes);
            let [from, above, to, below] = self.labels.bounds(angle, self.rail_radius, language);
            let [over, under] = [left - x - to, x + from - right].map(|gap| gap >= GAP_PX);
            over || under || top - y - below >= GAP_PX || y + above - bottom >= GAP_PX
        };
        let has_labels = self.labels.form != LabelForm::Nothing;
        away >= self.rail_radius + self.labels.gap() && (!has_labels || (0..self.nodes).all(misses))
    }

    /// Returns the radius of the free area inside the nodes.
    pub(crate) fn interior_radius(&self) -> f32 {
        self.seat_radius - self.node_reach()
    }

    /// Returns a node's angle round the centre, in radians, clockwise from the right.
    pub(crate) fn angle(&self, node: NodeId) -> f32 {
        direction(usize::from(node), self.nodes)
    }

    /// Returns the point at an angle and a distance from the centre.
    pub(crate) fn at(&self, angle: f32, radius: f32) -> Point {
        [self.centre[0] + radius * angle.cos(), self.centre[1] + radius * angle.sin()]
    }

    /// Returns the centre of a node.
    pub(crate) fn seat(&self, node: NodeId) -> Point {
        self.at(self.angle(node), self.seat_radius)
    }

    /// Returns the angle between neighbours.
    pub(crate) fn node_step(&self) -> f32 {
        TAU / self.nodes.max(1) as f32
    }

    /// Returns the control point of the curve between two points on the circle. It lies towards the centre, and the
    /// further to the side, the nearer the straight path comes to the parent. From the centre the path is straight.
    pub(crate) fn bend(&self, from: Point, to: Point) -> Point {
        let centre = self.centre;
        let middle = [(from[0] + to[0]) / 2.0 - centre[0], (from[1] + to[1]) / 2.0 - centre[1]];
        let chord = [to[0] - from[0], to[1] - from[1]];
        let (inward, aside) = if from == centre {
            (1.0, 0.0)
        } else {
            let (distance, half) = (middle[0].hypot(middle[1]), chord[0].hypot(chord[1]) / 2.0);
            let through = half / (half + distance).max(1.0);
            // The middle of a short way lies as deep inside the nodes as a box needs.
            let depth = self.interior_radius() - 0.5 * self.node_radius - 2.0 * TextSize::SMALL;
            let inward = ((2.0 * depth - distance) / distance.max(1.0)).clamp(0.3, 0.6);
            (inward, 0.45 * through * through)
        };
        // Square to the chord, away from the centre.
        let aside = if chord[0] * middle[1] < chord[1] * middle[0] { -aside } else { aside };
        [centre[0] + middle[0] * inward - chord[1] * aside, centre[1] + middle[1] * inward + chord[0] * aside]
    }
}

#[cfg(test)]
mod tests {
    use super::super::angles::curve;
    use super::*;

    const SIZE: Point = [520.0, 480.0];

    #[test]
    fn offer_moves_anticlockwise_to_left_neighbour() {
        let language = Language::English;
        let layout = RingLayout::new(8, SIZE, language);
        let top = layout.at(layout.angle(0) - layout.node_step() / 2.0, layout.rail_radius);
        assert!(top[0] < layout.centre[0] && top[1] < layout.centre[1]);
        let arrived = layout.at(layout.angle(0) - layout.node_step(), layout.rail_radius);
        let neighbour = layout.at(layout.angle(7), layout.rail_radius);
        assert!((arrived[0] - neighbour[0]).hypot(arrived[1] - neighbour[1]) < 0.01);
    }

    #[test]
    fn nodes_do_not_touch() {
        let language = Language::English;
        for nodes in 2..=48 {
            let layout = RingLayout::new(nodes, SIZE, language);
            let ([x, y], [u, v]) = (layout.seat(0), layout.seat(1));
            assert!((x - u).hypot(y - v) > 2.6 * layout.node_radius, "{nodes}");
        }
    }

    #[test]
    fn parcels_avoid_the_parent() {
        let language = Language::English;
        let layout = RingLayout::new(8, SIZE, language);
        for to in 1..8 {
            let (from, to) = (layout.seat(0), layout.seat(to));
            let bend = layout.bend(from, to);
            for i in 0..=20 {
                let [x, y] = curve(from, bend, to, i as f32 / 20.0);
                let apart = (x - layout.centre[0]).hypot(y - layout.centre[1]);
                assert!(apart > layout.parent_radius, "{apart}");
            }
        }
    }
}

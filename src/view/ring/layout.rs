//! Where everything in the ring is.

use std::f32::consts::{PI, TAU};

use super::angles::direction;
use super::labels::Labels;
use crate::balance::{NodeId, Party};
use crate::language::Language;
use crate::view::draw::display_list::Point;

/// Where everything is, for a number of nodes and a size.
#[derive(Clone, Copy, Debug)]
pub struct RingLayout {
    /// How many nodes there are.
    pub(crate) nodes: usize,
    /// Where the parent is.
    pub(crate) centre: Point,
    /// Radius of the rail on which offers run.
    pub(crate) rail: f32,
    /// Radius of the circle on which the nodes sit.
    pub(crate) seats: f32,
    /// Radius of a node at full speed.
    pub(crate) node: f32,
    /// Radius of the parent.
    pub(crate) parent: f32,
    /// How labels look.
    pub(crate) labels: Labels,
}

impl RingLayout {
    /// Radius of a node's progress arc, in radii of a node.
    pub(crate) const TRACK: f32 = 1.2;

    /// The plan for an area whose corner is at 0, 0; the text sizes are taken to be in its units.
    pub fn new(nodes: usize, [width, height]: Point, language: Language) -> Self {
        let (labels, rail) = Labels::fit(nodes, [width, height], language);
        let rail = rail.max(40.0);
        let apart = (PI / nodes.max(2) as f32).sin();
        // Two neighbours with their progress arcs fill at most three quarters of the chord between them.
        let node = (rail * 0.155).min(0.66 * rail * apart / (1.0 + apart));
        let seats = rail - node * 1.3 - 8.0;
        Self { nodes, centre: [width / 2.0, height / 2.0], rail, seats, node, parent: rail * 0.24, labels }
    }

    /// The angle of an offer's way along the rail, against the clock: to the left neighbour, or further.
    pub(crate) fn way(&self, from: NodeId, to: Party) -> f32 {
        let Party::Node(to) = to else { return self.step() };
        let nodes = self.nodes.max(1);
        let steps = (usize::from(from) + nodes - usize::from(to) % nodes) % nodes;
        self.step() * if steps == 0 { nodes } else { steps } as f32
    }

    /// How broad a node's progress arc is.
    pub(crate) fn track_width(&self) -> f32 {
        (self.node * 0.13).max(2.0)
    }

    /// Radius of a node with its progress arc and the ground round it.
    pub(crate) fn reach(&self) -> f32 {
        self.node * Self::TRACK + self.track_width()
    }

    /// The ends of the way between two nodes, or from the parent to a node: at their rims, so that nothing hides a
    /// number.
    pub(crate) fn between(&self, from: Point, to: Point) -> (Point, Point) {
        let bend = self.bend(from, to);
        let towards = |start: Point, by: f32| {
            let way = [bend[0] - start[0], bend[1] - start[1]];
            let length = way[0].hypot(way[1]).max(1.0);
            [start[0] + way[0] * by / length, start[1] + way[1] * by / length]
        };
        let start = if from == self.centre { self.parent } else { self.reach() };
        (towards(from, start), towards(to, self.reach()))
    }

    /// Radius of the room within the nodes.
    pub(crate) fn interior(&self) -> f32 {
        self.seats - self.reach()
    }

    /// A node's direction seen from the centre, clockwise from the right.
    pub(crate) fn angle(&self, node: NodeId) -> f32 {
        direction(usize::from(node), self.nodes)
    }

    /// A place by its direction and its distance from the centre.
    pub(crate) fn at(&self, angle: f32, radius: f32) -> Point {
        [self.centre[0] + radius * angle.cos(), self.centre[1] + radius * angle.sin()]
    }

    /// Where a node sits.
    pub(crate) fn seat(&self, node: NodeId) -> Point {
        self.at(self.angle(node), self.seats)
    }

    /// The angle between neighbours.
    pub(crate) fn step(&self) -> f32 {
        TAU / self.nodes.max(1) as f32
    }

    /// The control point of the curve between two places on the circle: towards the centre, but to the side of the
    /// parent the more the straight way would lead through it. From the centre itself the way is straight.
    pub(crate) fn bend(&self, from: Point, to: Point) -> Point {
        let centre = self.centre;
        let middle = [(from[0] + to[0]) / 2.0 - centre[0], (from[1] + to[1]) / 2.0 - centre[1]];
        let chord = [to[0] - from[0], to[1] - from[1]];
        let (inward, aside) = if from == centre {
            (1.0, 0.0)
        } else {
            let (distance, half) = (middle[0].hypot(middle[1]), chord[0].hypot(chord[1]) / 2.0);
            let through = half / (half + distance).max(1.0);
            (0.6, 0.45 * through * through)
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
    fn an_offer_runs_anticlockwise_to_the_left_neighbour() {
        let language = Language::English;
        let plan = RingLayout::new(8, SIZE, language);
        let top = plan.at(plan.angle(0) - plan.step() / 2.0, plan.rail);
        assert!(top[0] < plan.centre[0] && top[1] < plan.centre[1]);
        let arrived = plan.at(plan.angle(0) - plan.step(), plan.rail);
        let neighbour = plan.at(plan.angle(7), plan.rail);
        assert!((arrived[0] - neighbour[0]).hypot(arrived[1] - neighbour[1]) < 0.01);
    }

    #[test]
    fn nodes_do_not_touch() {
        let language = Language::English;
        for nodes in 2..=48 {
            let plan = RingLayout::new(nodes, SIZE, language);
            let ([x, y], [u, v]) = (plan.seat(0), plan.seat(1));
            assert!((x - u).hypot(y - v) > 2.6 * plan.node, "{nodes}");
        }
    }

    #[test]
    fn parcels_go_round_the_parent() {
        let language = Language::English;
        let plan = RingLayout::new(8, SIZE, language);
        for to in 1..8 {
            let (from, to) = (plan.seat(0), plan.seat(to));
            let bend = plan.bend(from, to);
            for i in 0..=20 {
                let [x, y] = curve(from, bend, to, i as f32 / 20.0);
                let apart = (x - plan.centre[0]).hypot(y - plan.centre[1]);
                assert!(apart > plan.parent, "{apart}");
            }
        }
    }
}

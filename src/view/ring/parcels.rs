//! Parcels of atoms on their way: bands from the parent, transfers from node to node.
//!
//! An arrow leads from the giver to the receiver, and a box with the number of atoms moves along it. Boxes stay in the
//! free area inside the nodes. Where two would meet, the smaller one gives way: it fades to a dot.

use super::angles::{curve, ease};
use super::emphasis::{HIGHLIGHT_BORDER_PX, HINT_ALPHA, MAX_DETAILED, visibility};
use super::layers::RingLayer;
use super::layout::RingLayout;
use crate::balance::{NodeId, Party};
use crate::time::Time;
use crate::view::draw::display_list::{Anchor, Hue, Mark, Point, TextSize};
use crate::view::state::flight::{Cargo, Flight};
use crate::view::state::run_state::RunState;
use crate::view::text::format::count;

/// Draws atoms on their way. The message with the id `highlighted` stands out.
pub(crate) fn draw(layout: &RingLayout, state: &RunState, now: Time, highlighted: Option<u64>, marks: &mut Vec<Mark>) {
    let parcels = parcels_shown(layout, state, now);
    for parcel in &parcels {
        parcel.draw_way(layout, now, marks);
    }
    for parcel in parcels.iter().rev() {
        parcel.draw_box(layout, now, highlighted.is_some_and(|id| parcel.carries(id)), marks);
    }
}

/// Finds the message of the parcel that is drawn at `point`, and its layer.
pub(crate) fn parcel_at<'a>(
    layout: &RingLayout,
    state: &'a RunState,
    now: Time,
    [x, y]: Point,
) -> Option<(RingLayer, &'a Flight)> {
    let covers = |parcel: &Parcel<'_>| {
        let ([u, v], half) = (parcel.centre, parcel.half);
        parcel.flight.shown().contains(&now) && (x - u).abs() <= half[0] && (y - v).abs() <= half[1]
    };
    parcels_shown(layout, state, now).into_iter().find(covers).map(|parcel| (RingLayer::Parcels, parcel.flight))
}

/// Drawing of a message that carries atoms, and of the later ones that it carries.
struct Parcel<'a> {
    flight: &'a Flight,
    /// The messages that it carries.
    others: Vec<&'a Flight>,
    from: Point,
    to: Point,
    /// The node in whose colour it is drawn: the giver, or the receiver of atoms from the parent.
    node: NodeId,
    /// The node that receives it.
    to_node: NodeId,
    /// Opacity, 0 to 1.
    alpha: f32,
    /// Whether it has an arrow.
    is_detailed: bool,
    /// Centre, and half the width and the height, of its box or dot.
    centre: Point,
    half: Point,
    /// Opacity of its box with the count, 0 to 1. Without it, the parcel is a dot.
    box_alpha: f32,
}

/// Returns the parcels to draw, the largest first; the largest is on top.
fn parcels_shown<'a>(layout: &RingLayout, state: &'a RunState, now: Time) -> Vec<Parcel<'a>> {
    let is_moving =
        |flight: &&Flight| flight.sent <= now && visibility(state, flight, now) > 0.0 && flight.cargo.atoms() > 0;
    let (carried, leading): (Vec<_>, Vec<_>) =
        state.flights().iter().filter(is_moving).partition(|flight| flight.carrier.is_some());
    let mut parcels: Vec<_> = leading
        .into_iter()
        .filter_map(|flight| {
            let others = carried.iter().filter(|other| other.carrier.is_some_and(|by| by.id == flight.id));
            Parcel::new(layout, (flight, others.copied().collect()), visibility(state, flight, now), now)
        })
        .collect();
    // The sort is stable, so equal parcels do not flicker.
    parcels.sort_by_key(|parcel| std::cmp::Reverse(parcel.atoms()));
    let (mut transfers, mut boxes) = (0, Vec::new());
    for parcel in &mut parcels {
        transfers += usize::from(!parcel.is_band());
        parcel.is_detailed = transfers <= MAX_DETAILED;
        parcel.alpha *= if parcel.is_detailed { 1.0 } else { HINT_ALPHA };
        if parcel.has_box(layout, now) {
            let (at, half) = (parcel.centre, parcel.box_half(layout));
            let at = keep_off_discs(layout, at, half);
            // Where there is no room between the discs, it fades too.
            let deepest = discs(layout).map(|disc| depth(disc, at, half).1).fold(0.0, f32::max);
            let gaps = boxes.iter().map(|&other| gap((at, half), other) / FADE_GAP_PX);
            parcel.box_alpha = gaps.fold(1.0 - deepest / 2.0, f32::min).clamp(0.0, 1.0);
            if parcel.box_alpha > 0.0 {
                (parcel.centre, parcel.half) = (at, half);
                boxes.push((at, half));
            }
        }
    }
    parcels
}

/// Number of transferred atoms in all parcels that are drawn on their way.
#[cfg(test)]
pub(super) fn atoms_drawn(layout: &RingLayout, state: &RunState, now: Time) -> u32 {
    let parcels = parcels_shown(layout, state, now).into_iter();
    let on_way = |parcel: &Parcel<'_>| !parcel.is_band() && parcel.flight.shown().contains(&now);
    parcels.filter(on_way).map(|parcel| parcel.atoms()).sum()
}

impl<'a> Parcel<'a> {
    /// Creates the drawing of a message and of those that it carries; `None` if it is not drawn as a parcel.
    fn new(
        layout: &RingLayout,
        (flight, others): (&'a Flight, Vec<&'a Flight>),
        alpha: f32,
        now: Time,
    ) -> Option<Self> {
        let (start, node, to_node) = match (flight.from, flight.to, &flight.cargo) {
            (Party::Parent, Party::Node(to), Cargo::Band(_) | Cargo::Again(_)) => (layout.centre, to, to),
            (Party::Node(from), Party::Node(to), Cargo::Transfer(_) | Cargo::Again(_)) => (layout.seat(from), from, to),
            _ => return None,
        };
        let (from, to) = layout.path_ends(start, layout.seat(to_node));
        let centre = curve(from, layout.bend(from, to), to, ease(flight.progress(now)));
        let half = [0.16 * layout.node_radius; 2];
        let (is_detailed, box_alpha) = (false, 0.0);
        Some(Self { flight, others, from, to, node, to_node, alpha, is_detailed, centre, half, box_alpha })
    }

    fn is_band(&self) -> bool {
        matches!(self.flight.cargo, Cargo::Band(_))
    }

    fn carries(&self, id: u64) -> bool {
        self.flight.id == id || self.others.iter().any(|other| other.id == id)
    }

    /// The atoms in it.
    fn atoms(&self) -> u32 {
        self.flight.cargo.atoms() + self.others.iter().map(|other| other.cargo.atoms()).sum::<u32>()
    }

    fn text(&self) -> String {
        format!("×{}", count(self.atoms()))
    }

    /// Half the width and the height of its box.
    fn box_half(&self, layout: &RingLayout) -> Point {
        let (size, letters) = (text_size(layout), self.text().chars().count());
        [size.width(letters) / 2.0 + 4.0, 0.55 * size.line() + 1.0]
    }

    /// Whether it has a box with its count, if no other box is in the way.
    fn has_box(&self, layout: &RingLayout, now: Time) -> bool {
        // All bands begin at the parent: their counts appear once the bands are apart, if there is room for all.
        let shows_band = || self.flight.progress(now) >= HEAP_PROGRESS && boxes_fit(layout, self.box_half(layout));
        self.is_detailed && self.flight.shown().contains(&now) && (!self.is_band() || shows_band())
    }

    /// Returns its point on the curve from the giver to the receiver.
    fn point(&self, layout: &RingLayout, part: f32) -> Point {
        curve(self.from, layout.bend(self.from, self.to), self.to, part)
    }

    /// Draws its arrow and its trail.
    fn draw_way(&self, layout: &RingLayout, now: Time, marks: &mut Vec<Mark>) {
        const PIECES: usize = 24;
        let here = ease(self.flight.progress(now));
        let upto = |end: f32| (0..=PIECES).map(|i| self.point(layout, end * i as f32 / PIECES as f32)).collect();
        let hue = Hue::Node(self.node);
        if self.is_detailed && !self.is_band() {
            let ink = hue.faint(0.5 * self.alpha);
            marks.push(Mark::Line { points: upto(1.0), width: 1.5, ink });
            let ([x, y], [u, v]) = (self.to, self.point(layout, 0.9));
            let (length, wing) = ((x - u).hypot(y - v).max(1.0), (0.3 * layout.node_radius).clamp(4.0, 8.0));
            let [along, aside] =
                [[(u - x) / length * wing, (v - y) / length * wing], [(v - y) / length, (x - u) / length]];
            let back =
                |side: f32| [x + along[0] + 0.7 * wing * side * aside[0], y + along[1] + 0.7 * wing * side * aside[1]];
            let ink = hue.faint(self.alpha);
            marks.push(Mark::Line { points: vec![back(-1.0), [x, y], back(1.0)], width: 2.0, ink });
        }
        marks.push(Mark::Trail {
            points: upto(here),
            width: layout.node_radius * 0.3,
            ink: hue.faint(0.6 * self.alpha),
        });
    }

    /// Draws its box, or its dot.
    fn draw_box(&self, layout: &RingLayout, now: Time, is_highlighted: bool, marks: &mut Vec<Mark>) {
        if !self.flight.shown().contains(&now) {
            return;
        }
        let (hue, round, alpha) = (Hue::Node(self.node), 6.0, self.alpha * self.box_alpha);
        if self.box_alpha < 1.0 {
            let (side, centre) = (0.16 * layout.node_radius, self.point(layout, ease(self.flight.progress(now))));
            marks.push(Mark::Box { centre, half: [side; 2], round: 0.5 * side, ink: hue.faint(self.alpha) });
        }
        if self.box_alpha == 0.0 {
            return;
        }
        let (centre, half) = (self.centre, self.half);
        let mut layer = |centre: Point, wide: f32, ink| {
            marks.push(Mark::Box { centre, half: half.map(|side| side + wide), round: round + wide, ink });
        };
        if matches!(self.flight.cargo, Cargo::Again(_)) {
            // Copies have a second box behind the first.
            let behind = [centre[0] + 4.0, centre[1] - 4.0];
            layer(behind, 2.0, Hue::Ground.faint(alpha));
            layer(behind, 0.0, hue.faint(0.6 * alpha));
        }
        // The border is in the colour of the receiver.
        let border = if is_highlighted { Hue::Text } else { Hue::Node(self.to_node) };
        layer(centre, HIGHLIGHT_BORDER_PX, if is_highlighted { border } else { Hue::Ground }.faint(alpha));
        if self.to_node != self.node {
            layer(centre, 0.0, border.faint(alpha));
            layer(centre, -BORDER_PX, Hue::Ground.faint(alpha));
            layer(centre, -BORDER_PX - 1.0, hue.faint(alpha));
        } else {
            layer(centre, 0.0, hue.faint(alpha));
        }
        let ink = Hue::OnNode(self.node).faint(alpha);
        let (text, size) = (self.text(), text_size(layout));
        marks.push(Mark::Label { at: centre, anchor: Anchor::Centre, text, size, ink });
    }
}

/// Returns the text size of a count.
fn text_size(layout: &RingLayout) -> TextSize {
    if layout.labels.are_small() { TextSize::Body(0.75) } else { TextSize::Body(0.9 * layout.labels.text_scale) }
}

/// Returns the discs that no box may touch: the parent and the nodes, each with centre and radius.
fn discs(layout: &RingLayout) -> impl Iterator<Item = (Point, f32)> + '_ {
    let nodes = (0..layout.nodes as NodeId).map(|node| (layout.seat(node), layout.node_reach()));
    nodes.chain([(layout.centre, layout.parent_radius + 1.0)])
}

/// Whether a box has room before each node.
fn boxes_fit(layout: &RingLayout, half: Point) -> bool {
    let place = |node| keep_off_discs(layout, layout.at(layout.angle(node), layout.interior_radius()), half);
    let is_free = |at: Point| discs(layout).all(|disc| depth(disc, at, half).1 < 0.5);
    let places: Vec<_> = (0..layout.nodes.min(MAX_NODES_WITH_BANDS) as NodeId).map(place).collect();
    let pairs = places.iter().zip(places.iter().cycle().skip(1)).take(places.len().max(2) - 1);
    layout.nodes <= MAX_NODES_WITH_BANDS
        && places.iter().all(|&at| is_free(at))
        && pairs.map(|(&one, &other)| gap((one, half), (other, half))).all(|gap| gap > FADE_GAP_PX)
}

/// In larger rings the boxes of bands have no room in any window.
const MAX_NODES_WITH_BANDS: usize = 16;

/// Moves a box the shortest way off the discs.
fn keep_off_discs(layout: &RingLayout, mut at: Point, half: Point) -> Point {
    // A move off one disc may lead to another, so it is done several times.
    for _ in 0..4 {
        for disc in discs(layout) {
            let ([dx, dy], depth) = depth(disc, at, half);
            if depth > 0.0 {
                at = [at[0] + dx * depth, at[1] + dy * depth];
            }
        }
    }
    at
}

/// Returns how deep a box with its border lies in a disc, negative outside, and the direction that leads out.
fn depth((centre, radius): (Point, f32), at: Point, half: Point) -> (Point, f32) {
    let from_centre = [at[0] - centre[0], at[1] - centre[1]];
    let nearest = [0, 1].map(|axis| {
        let side = half[axis] + HIGHLIGHT_BORDER_PX;
        from_centre[axis] - from_centre[axis].clamp(-side, side)
    });
    let away = nearest[0].hypot(nearest[1]);
    if away > 0.1 {
        return (nearest.map(|part| part / away), radius - away);
    }
    // The box covers the disc's centre: the way out is that of the box's own centre.
    let length = from_centre[0].hypot(from_centre[1]).max(0.1);
    (from_centre.map(|part| part / length), radius)
}

/// Returns the distance between two boxes, given by centre and half of width and height; negative if they overlap.
fn gap(([x, y], [w, h]): (Point, Point), ([u, v], [a, b]): (Point, Point)) -> f32 {
    ((x - u).abs() - w - a).max((y - v).abs() - h - b) - 2.0 * HIGHLIGHT_BORDER_PX
}

/// Width of the border in the receiver's colour.
const BORDER_PX: f32 = 2.5;
/// Distance between two boxes below which the smaller one fades.
const FADE_GAP_PX: f32 = 8.0;
/// Progress at which bands are apart, 0 to 1.
const HEAP_PROGRESS: f32 = 0.45;

//! The timeline: a lane for each node, and above them the share of the machines that trace.

pub mod conditions;
pub mod landmarks;
pub mod layout;
pub mod legend;
pub mod markers;
pub mod quads;
pub mod time_window;

use super::draw::display_list::{Hue, Ink};
use super::state::lane::{Lane, LanePhase};
use super::state::lanes::{Lanes, Load, Trip};
use crate::balance::{NodeId, Party};
use crate::time::Time;
use conditions::draw_conditions;
use landmarks::Subject;
use layout::{STRIP_TOP_PX, TimelineLayout};
use quads::{Quad, Timeline, add_to_columns, column_runs};
use time_window::TimeWindow;

/// Least mean width of the bars of single atoms; narrower bars are drawn as columns.
const MIN_BAR_WIDTH_PX: f64 = 3.0;

/// Maximum number of messages of a kind in the window: more would cover each other and the lanes.
const MAX_LINES: usize = 400;

/// Draws the part of the timeline in `window`, up to `head`, the present time of the run.
pub fn timeline(lanes: &Lanes, window: &TimeWindow, layout: &TimelineLayout, head: Time) -> Timeline {
    let mut drawn = Timeline::default();
    let mut used = vec![0.0; layout.width.max(0.0) as usize];
    for (node, lane) in (0..).zip(lanes.lanes()) {
        draw_phases(lane, node, window, layout, head, &mut drawn.quads);
        draw_bars(lane, node, window, layout, head, &mut drawn.quads, &mut used);
        draw_pauses(lane, node, window, layout, head, &mut drawn.quads);
        draw_conditions(lane, node, window, layout, head, &mut drawn);
    }
    if layout.header_height > 0.0 {
        draw_usage(&used, layout, &mut drawn.quads);
    }
    draw_messages(lanes, window, layout, &mut drawn.lines);
    drawn
}

/// Returns round times for the axis below the lanes, far enough apart for their words, and the precision of these
/// words, as a rate for [`TimeScale::at_rate`](super::text::format::TimeScale::at_rate).
pub fn axis(window: &TimeWindow, width: f32) -> (Vec<Time>, f64) {
    const MIN_TICK_DISTANCE_PX: f64 = 110.0;
    let length = (window.to().0 - window.from().0) as f64;
    let least = (length * MIN_TICK_DISTANCE_PX / f64::from(width.max(1.0))).max(1.0);
    let power = 10_f64.powf(least.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().map(|times| times * power).find(|&step| step >= least);
    let step = step.unwrap_or(10.0 * power).max(1.0) as u64;
    let first = window.from().0.div_ceil(step);
    let times = (first..)
        .map_while(|i| i.checked_mul(step).map(Time))
        .take_while(|&time| time <= window.to())
        .take(64)
        .collect();
    (times, (step as f64 * 1e-9 * 10.0).min(1.0))
}

/// Finds the subject at a point: a message or an atom's bar, or else the machine of the lane.
pub fn timeline_at(lanes: &Lanes, window: &TimeWindow, layout: &TimelineLayout, [x, y]: [f32; 2]) -> Option<Subject> {
    let node = layout.node_at(y)?;
    let time = window.at(f64::from(x / layout.width.max(1.0)));
    let lane = lanes.lanes().get(usize::from(node))?;
    let reach = |time: Time| (layout.x(window, time) - x).abs() < 4.0;
    let of = Party::Node(node);
    // A wide bar comes before a message, a narrow one after it.
    let is_near = |trip: &&Trip| {
        trip.load == Load::Atoms && (trip.from == of && reach(trip.sent) || trip.to == of && reach(trip.arrives))
    };
    let bar = lane.bar_at(time);
    let wide = bar.is_some_and(|bar| layout.x(window, bar.to) - layout.x(window, bar.from) >= MIN_BAR_WIDTH_PX as f32);
    if !wide && let Some(trip) = trips_in(lanes, window).filter(is_near).max_by_key(|trip| trip.atoms) {
        return Some(Subject::Message(trip.id));
    }
    bar.map_or(Some(Subject::Node(node)), |bar| Some(Subject::Atom(bar.atom)))
}

/// Draws the strip above the lanes: the share of the machines that trace, column by column.
fn draw_usage(used: &[f32], layout: &TimelineLayout, quads: &mut Vec<Quad>) {
    let (top, bottom) = (STRIP_TOP_PX, layout.header_height - 4.0);
    quads.push(Quad { place: [0.0, top, layout.width, bottom], ink: Hue::Hairline.faint(0.35) });
    for run in column_runs(used.iter().map(|share| (share / layout.lanes.max(1) as f32 * 16.0).round() as u8)) {
        let share = f32::from(run.level) / 16.0;
        let place = [run.start as f32, bottom - (bottom - top) * share, run.end as f32, bottom];
        quads.push(Quad { place, ink: Hue::Quiet.faint(0.7) });
    }
}

/// Draws the phases of a lane in which no atom is traced.
fn draw_phases(
    lane: &Lane,
    node: NodeId,
    window: &TimeWindow,
    layout: &TimelineLayout,
    head: Time,
    quads: &mut Vec<Quad>,
) {
    let middle = layout.middle(node);
    let first = lane.phases().partition_point(|(at, _)| *at <= window.from()).saturating_sub(1);
    for (i, &(from, stay)) in lane.phases().iter().enumerate().skip(first) {
        if from > window.to() {
            break;
        }
        let to = lane.phases().get(i + 1).map_or(head, |(next, _)| *next);
        let [left, right] = layout.span(window, from, to);
        let (half, ink) = match stay {
            LanePhase::NoBand | LanePhase::HasAtoms => continue,
            LanePhase::Offers => (2.5, Hue::Node(node).faint(0.45)),
            LanePhase::Receives => (2.5, Hue::Node(node).faint(0.75)),
            LanePhase::Retired | LanePhase::Asleep => (0.75, Hue::Quiet.faint(0.6)),
        };
        if right > left {
            quads.push(Quad { place: [left, middle - half, right, middle + half], ink });
        }
    }
}

/// Draws the traced atoms of a lane: a bar for each where there is room, else the share of each column.
fn draw_bars(
    lane: &Lane,
    node: NodeId,
    window: &TimeWindow,
    layout: &TimelineLayout,
    head: Time,
    quads: &mut Vec<Quad>,
    used: &mut [f32],
) {
    let [top, bottom] = layout.lane(node);
    let seen = lane.bars_in(window.from(), window.to());
    let open = lane.open().map(|(_, since)| (since, head.max(since)));
    let all = seen.iter().map(|bar| (bar.from, bar.to)).chain(open);
    let mut columns = vec![0.0_f32; used.len()];
    for (from, to) in all {
        add_to_columns(&mut columns, layout.x(window, from), layout.x(window, to));
    }
    used.iter_mut().zip(&columns).for_each(|(sum, column)| *sum += column.min(1.0));
    let pixels = f64::from(layout.width) / (window.to().0 - window.from().0).max(1) as f64;
    let mean = seen.iter().map(|bar| (bar.to.0 - bar.from.0) as f64).sum::<f64>() / seen.len().max(1) as f64;
    if mean * pixels >= MIN_BAR_WIDTH_PX {
        let ink = |i: usize| Hue::Node(node).faint(if i.is_multiple_of(2) { 0.95 } else { 0.75 });
        for bar in seen {
            // The shade depends on the atom, so that it stays while the window pans.
            let [left, right] = layout.span(window, bar.from, bar.to);
            quads.push(Quad { place: [left, top, right, bottom], ink: ink(bar.atom as usize) });
        }
        if let Some((from, to)) = open {
            let [left, right] = layout.span(window, from, to);
            quads.push(Quad { place: [left, top, right, bottom], ink: Hue::Node(node).faint(0.55) });
        }
        return;
    }
    for run in column_runs(columns.iter().map(|share| (share.min(1.0) * 8.0).round() as u8)) {
        let ink = Hue::Node(node).faint(0.9 * f32::from(run.level) / 8.0);
        quads.push(Quad { place: [run.start as f32, top, run.end as f32, bottom], ink });
    }
}

/// Draws a line through the lane while its machine is paused.
fn draw_pauses(
    lane: &Lane,
    node: NodeId,
    window: &TimeWindow,
    layout: &TimelineLayout,
    head: Time,
    quads: &mut Vec<Quad>,
) {
    let middle = layout.middle(node);
    for &(from, to) in lane.stops() {
        let [left, right] = layout.span(window, from, to.unwrap_or(head));
        if right > left {
            quads.push(Quad { place: [left, middle - 1.0, right, middle + 1.0], ink: Hue::Text.faint(0.9) });
        }
    }
}

/// Draws messages: offers from neighbour to neighbour, atoms between machines, and ticks for those from and to the
/// parent.
fn draw_messages(
    lanes: &Lanes,
    window: &TimeWindow,
    layout: &TimelineLayout,
    lines: &mut Vec<([f32; 2], [f32; 2], Ink)>,
) {
    for (load, alpha) in [(Load::Atoms, 0.7), (Load::Offer, 0.25)] {
        // Too many messages would cover the lanes; the ring shows them.
        if offers_and_transfers(lanes, window, load).count() > MAX_LINES {
            continue;
        }
        let is_inside = |node: &NodeId| usize::from(*node) < layout.lanes;
        for (trip, from, to) in offers_and_transfers(lanes, window, load) {
            if is_inside(&from) && is_inside(&to) {
                let start = [layout.x(window, trip.sent), layout.middle(from)];
                lines.push((start, [layout.x(window, trip.arrives), layout.middle(to)], Hue::Text.faint(alpha)));
            }
        }
    }
    let ticks: Vec<_> = parent_ticks(lanes, window).take(MAX_LINES + 1).collect();
    if ticks.len() <= MAX_LINES {
        lines.extend(ticks.into_iter().map(|(node, at)| {
            let ([_, bottom], x) = (layout.lane(node), layout.x(window, at));
            ([x, bottom - 5.0], [x, bottom], Hue::Text.faint(0.8))
        }));
    }
}

/// Returns the messages of a kind between machines in the window, with sender and receiver.
fn offers_and_transfers<'a>(
    lanes: &'a Lanes,
    window: &TimeWindow,
    load: Load,
) -> impl Iterator<Item = (&'a Trip, NodeId, NodeId)> {
    trips_in(lanes, window).filter(move |trip| trip.load == load).filter_map(|trip| match (trip.from, trip.to) {
        (Party::Node(from), Party::Node(to)) => Some((trip, from, to)),
        _ => None,
    })
}

/// Returns a tick for each message to or from the parent in the window: the machine, and the time at which it sends or
/// receives the message.
fn parent_ticks(lanes: &Lanes, window: &TimeWindow) -> impl Iterator<Item = (NodeId, Time)> {
    trips_in(lanes, window).filter_map(|trip| match (trip.from, trip.to) {
        _ if trip.load == Load::Notice => None,
        (Party::Node(node), Party::Parent) => Some((node, trip.sent)),
        (Party::Parent, Party::Node(node)) => Some((node, trip.arrives)),
        _ => None,
    })
}

/// Returns the messages that are on their way within the window.
fn trips_in<'a>(lanes: &'a Lanes, window: &TimeWindow) -> impl Iterator<Item = &'a Trip> {
    let (from, to) = (window.from(), window.to());
    // Messages are nearly in the order in which they were sent: at most a second out of order.
    let last = lanes.trips().partition_point(|trip| trip.sent <= to);
    lanes.trips()[..last].iter().filter(move |trip| trip.arrives >= from && trip.sent <= to)
}

#[cfg(test)]
mod tests;

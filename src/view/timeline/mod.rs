//! The timeline as things to draw: a lane a node, and above them how much of the machines' time is used.

pub mod conditions;
pub mod landmarks;
pub mod markers;
pub mod time_window;

use super::draw::display_list::{Hue, Ink};
use super::state::lane::{Lane, LanePhase};
use super::state::lanes::{Lanes, Load, Trip};
use crate::balance::{NodeId, Party};
use crate::time::Time;
use conditions::troubles;
use landmarks::Subject;
use time_window::TimeWindow;

/// A rectangle of one colour: left, top, right, bottom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quad {
    /// Where it is.
    pub place: [f32; 4],
    /// What it is filled with.
    pub ink: Ink,
}

/// Where things are in a timeline of some size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimelineLayout {
    /// All of its width.
    pub width: f32,
    /// The height of what stands above the lanes.
    pub head: f32,
    /// The height of the axis below the lanes.
    pub foot: f32,
    /// The height of a lane, the gap below it included.
    pub lane: f32,
    /// How many lanes there are.
    pub lanes: usize,
}

/// What is drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Timeline {
    /// What lies under the lines.
    pub quads: Vec<Quad>,
    /// Messages between lanes: from, to, and their ink.
    pub lines: Vec<([f32; 2], [f32; 2], Ink)>,
}

/// The height of the words above the lanes, and of the strip between both that shows how much of the machines is used.
const WORDS: f32 = 20.0;
const STRIP: f32 = 20.0;

/// Narrower than this, in pixels, atoms are not told apart.
const APART: f64 = 3.0;

/// More messages than this in the window hide each other and the lanes.
const MOST_LINES: usize = 400;

impl TimelineLayout {
    /// A plan for so many lanes in so much room.
    pub fn new(lanes: usize, width: f32, height: f32) -> Self {
        let (head, foot) = if height > 120.0 { (WORDS + STRIP, 18.0) } else { (0.0, 0.0) };
        let lane = ((height - head - foot) / lanes.max(1) as f32).min(26.0);
        Self { width, head, foot, lane, lanes }
    }

    /// The top and the bottom of a lane.
    pub fn lane(&self, node: NodeId) -> [f32; 2] {
        let top = self.head + f32::from(node) * self.lane;
        [top, top + self.lane - if self.lane > 8.0 { 2.0 } else { 1.0 }]
    }

    /// Which lane is at a height.
    pub fn node_at(&self, y: f32) -> Option<NodeId> {
        let lane = ((y - self.head) / self.lane).floor();
        (lane >= 0.0 && lane < self.lanes as f32).then_some(lane as NodeId)
    }

    /// Where the lanes end.
    pub fn bottom(&self) -> f32 {
        self.head + self.lane * self.lanes as f32
    }

    pub(super) fn x(&self, window: &TimeWindow, time: Time) -> f32 {
        (window.share(time).clamp(-1.0, 2.0) * f64::from(self.width)) as f32
    }

    /// Where what lasted from one time to another is seen: its left and its right.
    pub(super) fn span(&self, window: &TimeWindow, from: Time, to: Time) -> [f32; 2] {
        [self.x(window, from).max(0.0), self.x(window, to).min(self.width)]
    }

    pub(super) fn middle(&self, node: NodeId) -> f32 {
        let [top, bottom] = self.lane(node);
        (top + bottom) / 2.0
    }
}

/// The timeline of what `window` shows, until `head`, which the run has come to.
pub fn timeline(lanes: &Lanes, window: &TimeWindow, plan: &TimelineLayout, head: Time) -> Timeline {
    let mut drawn = Timeline::default();
    let mut used = vec![0.0; plan.width.max(0.0) as usize];
    for (node, lane) in (0..).zip(lanes.lanes()) {
        stays(lane, node, window, plan, head, &mut drawn.quads);
        bars(lane, node, window, plan, head, &mut drawn.quads, &mut used);
        pauses(lane, node, window, plan, head, &mut drawn.quads);
        troubles(lane, node, window, plan, head, &mut drawn);
    }
    if plan.head > 0.0 {
        usage(&used, plan, &mut drawn.quads);
    }
    messages(lanes, window, plan, &mut drawn.lines);
    drawn
}

/// Times for the axis below the lanes: round ones, far enough apart for their words, and how exactly they are to be told,
/// as a rate is for [`time_words`](super::text::format::time_words).
pub fn axis(window: &TimeWindow, width: f32) -> (Vec<Time>, f64) {
    const APART: f64 = 110.0;
    let length = (window.to().0 - window.from().0) as f64;
    let least = (length * APART / f64::from(width.max(1.0))).max(1.0);
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

/// What is pointed at: an atom's bar, else a message near the place, else the lane's machine.
pub fn timeline_at(lanes: &Lanes, window: &TimeWindow, plan: &TimelineLayout, [x, y]: [f32; 2]) -> Option<Subject> {
    let node = plan.node_at(y)?;
    let time = window.at(f64::from(x / plan.width.max(1.0)));
    let lane = lanes.lanes().get(usize::from(node))?;
    let reach = |time: Time| (plan.x(window, time) - x).abs() < 4.0;
    let of = Party::Node(node);
    // Where atoms stand apart they are what one points at; else a parcel is.
    let is_near = |trip: &&Trip| {
        trip.load == Load::Atoms && (trip.from == of && reach(trip.sent) || trip.to == of && reach(trip.arrives))
    };
    let bar = lane.bar_at(time);
    let wide = bar.is_some_and(|bar| plan.x(window, bar.to) - plan.x(window, bar.from) >= APART as f32);
    if !wide && let Some(trip) = trips_in(lanes, window).filter(is_near).max_by_key(|trip| trip.atoms) {
        return Some(Subject::Message(trip.id));
    }
    bar.map_or(Some(Subject::Node(node)), |bar| Some(Subject::Atom(bar.atom)))
}

/// How many of the machines' time is used, column by column.
fn usage(used: &[f32], plan: &TimelineLayout, quads: &mut Vec<Quad>) {
    let (top, bottom) = (WORDS, plan.head - 4.0);
    quads.push(Quad { place: [0.0, top, plan.width, bottom], ink: Hue::Hairline.faint(0.35) });
    for run in runs(used.iter().map(|share| (share / plan.lanes.max(1) as f32 * 16.0).round() as u8)) {
        let share = f32::from(run.level) / 16.0;
        let place = [run.start as f32, bottom - (bottom - top) * share, run.end as f32, bottom];
        quads.push(Quad { place, ink: Hue::Quiet.faint(0.7) });
    }
}

/// What a machine is about while it traces nothing.
fn stays(lane: &Lane, node: NodeId, window: &TimeWindow, plan: &TimelineLayout, head: Time, quads: &mut Vec<Quad>) {
    let middle = plan.middle(node);
    let first = lane.phases().partition_point(|(at, _)| *at <= window.from()).saturating_sub(1);
    for (i, &(from, stay)) in lane.phases().iter().enumerate().skip(first) {
        if from > window.to() {
            break;
        }
        let to = lane.phases().get(i + 1).map_or(head, |(next, _)| *next);
        let [left, right] = plan.span(window, from, to);
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

/// What a machine traced: atom by atom where there is room, else how much of each column.
fn bars(
    lane: &Lane,
    node: NodeId,
    window: &TimeWindow,
    plan: &TimelineLayout,
    head: Time,
    quads: &mut Vec<Quad>,
    used: &mut [f32],
) {
    let [top, bottom] = plan.lane(node);
    let seen = lane.bars_in(window.from(), window.to());
    let open = lane.open().map(|(_, since)| (since, head.max(since)));
    let all = seen.iter().map(|bar| (bar.from, bar.to)).chain(open);
    let mut columns = vec![0.0_f32; used.len()];
    for (from, to) in all {
        cover(&mut columns, plan.x(window, from), plan.x(window, to));
    }
    used.iter_mut().zip(&columns).for_each(|(sum, column)| *sum += column.min(1.0));
    let pixels = f64::from(plan.width) / (window.to().0 - window.from().0).max(1) as f64;
    let mean = seen.iter().map(|bar| (bar.to.0 - bar.from.0) as f64).sum::<f64>() / seen.len().max(1) as f64;
    if mean * pixels >= APART {
        let ink = |i: usize| Hue::Node(node).faint(if i.is_multiple_of(2) { 0.95 } else { 0.75 });
        for bar in seen {
            // Atoms keep their shade while one pans.
            let [left, right] = plan.span(window, bar.from, bar.to);
            quads.push(Quad { place: [left, top, right, bottom], ink: ink(bar.atom as usize) });
        }
        if let Some((from, to)) = open {
            let [left, right] = plan.span(window, from, to);
            quads.push(Quad { place: [left, top, right, bottom], ink: Hue::Node(node).faint(0.55) });
        }
        return;
    }
    for run in runs(columns.iter().map(|share| (share.min(1.0) * 8.0).round() as u8)) {
        let ink = Hue::Node(node).faint(0.9 * f32::from(run.level) / 8.0);
        quads.push(Quad { place: [run.start as f32, top, run.end as f32, bottom], ink });
    }
}

/// A worker that was made to stand still: the lane is struck out.
fn pauses(lane: &Lane, node: NodeId, window: &TimeWindow, plan: &TimelineLayout, head: Time, quads: &mut Vec<Quad>) {
    let middle = plan.middle(node);
    for &(from, to) in lane.stops() {
        let [left, right] = plan.span(window, from, to.unwrap_or(head));
        if right > left {
            quads.push(Quad { place: [left, middle - 1.0, right, middle + 1.0], ink: Hue::Text.faint(0.9) });
        }
    }
}

/// Offers from neighbour to neighbour, and atoms across.
fn messages(lanes: &Lanes, window: &TimeWindow, plan: &TimelineLayout, lines: &mut Vec<([f32; 2], [f32; 2], Ink)>) {
    let drawn = |load: Load| trips_in(lanes, window).filter(move |trip| trip.load == load);
    let mut draw = |trip: &Trip, alpha: f32| {
        let (Party::Node(from), Party::Node(to)) = (trip.from, trip.to) else { return };
        let inside = |node: NodeId| usize::from(node) < plan.lanes;
        if inside(from) && inside(to) {
            let start = [plan.x(window, trip.sent), plan.middle(from)];
            lines.push((start, [plan.x(window, trip.arrives), plan.middle(to)], Hue::Text.faint(alpha)));
        }
    };
    let between = |load: Load| {
        drawn(load).filter(|trip| matches!((trip.from, trip.to), (Party::Node(_), Party::Node(_)))).count()
    };
    // Where they are too many only the largest would be seen, and these the ring shows.
    if between(Load::Atoms) <= MOST_LINES {
        drawn(Load::Atoms).for_each(|trip| draw(trip, 0.7));
    }
    if between(Load::Offer) <= MOST_LINES {
        drawn(Load::Offer).for_each(|trip| draw(trip, 0.25));
    }
    // What is sent to the parent, and what comes from it, is a tick where it leaves or arrives.
    let of_parent = |trip: &Trip| match (trip.from, trip.to) {
        _ if trip.load == Load::Notice => None,
        (Party::Node(node), Party::Parent) => Some((node, trip.sent)),
        (Party::Parent, Party::Node(node)) => Some((node, trip.arrives)),
        _ => None,
    };
    let ticks: Vec<_> = trips_in(lanes, window).filter_map(of_parent).take(MOST_LINES + 1).collect();
    if ticks.len() <= MOST_LINES {
        lines.extend(ticks.into_iter().map(|(node, at)| {
            let ([_, bottom], x) = (plan.lane(node), plan.x(window, at));
            ([x, bottom - 5.0], [x, bottom], Hue::Text.faint(0.8))
        }));
    }
}

/// The messages that are under way within the window.
fn trips_in<'a>(lanes: &'a Lanes, window: &TimeWindow) -> impl Iterator<Item = &'a Trip> {
    let (from, to) = (window.from(), window.to());
    // About in the order in which they left: nobody is later than a second.
    let last = lanes.trips().partition_point(|trip| trip.sent <= to);
    lanes.trips()[..last].iter().filter(move |trip| trip.arrives >= from && trip.sent <= to)
}

/// Adds what lies between two places to each column.
fn cover(columns: &mut [f32], left: f32, right: f32) {
    let (left, right) = (left.max(0.0), right.min(columns.len() as f32));
    if right <= left {
        return;
    }
    let (first, last) = (left as usize, (right as usize).min(columns.len() - 1));
    if first == last {
        columns[first] += right - left;
        return;
    }
    columns[first] += (first + 1) as f32 - left;
    columns[first + 1..last].iter_mut().for_each(|column| *column += 1.0);
    columns[last] += right - last as f32;
}

struct DiagonalRun {
    start: usize,
    end: usize,
    level: u8,
}

/// Columns of the same level, one after the other, as one; those of level 0 are left out.
fn runs(levels: impl Iterator<Item = u8>) -> Vec<DiagonalRun> {
    let mut runs: Vec<DiagonalRun> = Vec::new();
    for (column, level) in levels.enumerate() {
        match runs.last_mut() {
            Some(run) if run.level == level && run.end == column => run.end += 1,
            _ => runs.push(DiagonalRun { start: column, end: column + 1, level }),
        }
    }
    runs.retain(|run| run.level > 0);
    runs
}

#[cfg(test)]
mod tests {
    use crate::language::Language;
    use proptest::prelude::*;

    use super::super::tests::sample_runs;
    use super::*;

    const WIDTH: f32 = 800.0;

    fn drawn(atoms: u32, zoom: f64) -> (Lanes, Timeline, TimeWindow, TimelineLayout) {
        let header = sample_runs::header(&[1.0, 1.0, 0.1], atoms);
        let mut lanes = Lanes::new(&header);
        let records = sample_runs::records(&header);
        records.iter().for_each(|record| lanes.apply(record));
        let end = records[records.len() - 1].at;
        let mut window = TimeWindow::default();
        window.fit(end);
        window.zoom(0.3, zoom);
        window.fit(end);
        let plan = TimelineLayout::new(3, WIDTH, 150.0);
        (lanes.clone(), timeline(&lanes, &window, &plan, end), window, plan)
    }

    proptest! {
        #[test]
        fn nothing_is_drawn_beyond_its_place(atoms in 1..600u32, zoom in 0.001..1.0f64) {
            let (_, drawn, _, plan) = drawn(atoms, zoom);
            for quad in &drawn.quads {
                let [left, top, right, bottom] = quad.place;
                prop_assert!(left >= 0.0 && right <= WIDTH + 0.5 && top >= 0.0 && bottom <= plan.bottom() + 0.5, "{quad:?}");
                prop_assert!(right - left >= 0.0 && bottom > top);
            }
        }

        #[test]
        fn columns_hold_what_bars_cover(left in -50.0..150.0f32, length in 0.0..90.0f32) {
            let mut columns = vec![0.0; 100];
            cover(&mut columns, left, left + length);
            let inside = (left + length).min(100.0) - left.max(0.0);
            prop_assert!((columns.iter().sum::<f32>() - inside.max(0.0)).abs() < 1e-3);
            prop_assert!(columns.iter().all(|column| (0.0..=1.0 + 1e-4).contains(column)));
        }
    }

    #[test]
    fn few_quads_show_many_atoms_and_each_atom_is_one_when_seen_from_near() {
        let (_, all, ..) = drawn(20_000, 1.0);
        assert!(all.quads.len() < 3_000, "{}", all.quads.len());
        let (lanes, near, window, plan) = drawn(20_000, 0.002);
        let seen = |node: usize| lanes.lanes()[node].bars_in(window.from(), window.to()).len();
        let of = |node: NodeId| {
            let [top, bottom] = plan.lane(node);
            near.quads.iter().filter(|quad| quad.place[1] == top && quad.place[3] == bottom).count()
        };
        assert!(seen(0) > 5 && of(0) == seen(0), "{} {}", of(0), seen(0));
    }

    #[test]
    fn the_axis_has_round_times_that_are_seen() {
        let language = Language::English;
        let (_, _, window, _) = drawn(600, 0.05);
        let (times, rate) = axis(&window, WIDTH);
        assert!((3..=8).contains(&times.len()) && rate < 1.0, "{times:?}");
        assert!(times.iter().all(|&time| window.from() <= time && time <= window.to()));
        let words: Vec<_> = times.iter().map(|&time| crate::view::time_words(time, rate, language)).collect();
        assert!(words.windows(2).all(|pair| pair[0] != pair[1]), "{words:?}");
    }

    #[test]
    fn what_is_pointed_at_is_what_is_there() {
        let (lanes, _, window, plan) = drawn(600, 0.05);
        let bar = lanes.lanes()[0].bars_in(window.from(), window.to())[2];
        let x = (plan.x(&window, bar.from) + plan.x(&window, bar.to)) / 2.0;
        assert_eq!(timeline_at(&lanes, &window, &plan, [x, plan.middle(0)]), Some(Subject::Atom(bar.atom)));
        assert_eq!(timeline_at(&lanes, &window, &plan, [x, plan.bottom() + 9.0]), None);
    }
}

//! Drawings of a run for paper: the ring at a time, and the timeline, each with a heading, so that it can be read
//! alone.

use std::time::Duration;

use super::analysis::summary::Summary;
use super::analysis::time_budget::TimeBudget;
use super::charts::time_budget_chart::{time_budget_height, time_budget_marks};
use super::draw::display_list::{Anchor, Hue, Mark, Point, TextSize};
use super::playback::snapshots::Snapshot;
use super::ring::layout::RingLayout;
use super::ring::legend::ring_legend;
use super::ring::{RingOverlay, ring};
use super::state::lanes::Lanes;
use super::text::format::{TimeScale, duration, fraction, node_name, time_words};
use super::timeline::layout::TimelineLayout;
use super::timeline::legend::timeline_legend;
use super::timeline::time_window::TimeWindow;
use super::timeline::{axis, timeline};
use crate::language::Language;
use crate::runlog::{RunLog, text_lines};
use crate::sentence::shown;
use crate::time::Time;

/// A drawing for a sheet of paper.
#[derive(Clone, Debug, PartialEq)]
pub struct PrintedDrawing {
    /// Its marks.
    pub marks: Vec<Mark>,
    /// Width and height.
    pub size: Point,
}

/// Margin of all sheets.
const MARGIN: f32 = 28.0;

/// Letters of a title or a memo that are shown; the run's file may have more than a line.
const MAX_TITLE_LETTERS: usize = 150;

/// Lines of a memo that are shown.
const MAX_MEMO_LINES: usize = 12;

/// Size of the ring's sheet, without its legend.
const RING_SIZE: Point = [900.0, 760.0];

/// Width of the timeline's sheet.
const TIMELINE_WIDTH: f32 = 1200.0;
/// Width of the labels to the left of its lanes.
const LANE_LABEL_WIDTH: f32 = 96.0;

impl PrintedDrawing {
    /// Draws the ring of a run at a time, with the sentence at that time, or the result if the picture was complete. A
    /// time after the end counts as the end.
    pub fn ring(log: &RunLog, at: Time, language: Language) -> Self {
        /// Longer than the last message stays visible: at the end nothing moves.
        const LINGER: Duration = Duration::from_secs(5);
        let at = at.min(log.end());
        let mut snapshot = Snapshot::new(&log.header);
        log.records()[..log.until(at)].iter().for_each(|record| snapshot.apply(record));
        let state = &snapshot.state;
        let summary = Summary::of(log).filter(|_| state.finished().is_some());
        let is_over = summary.is_some() && at == log.end();
        let drawn_at = if is_over { at + LINGER } else { at };
        let [width, height] = RING_SIZE;
        let mut marks = Vec::new();
        let top = heading(log, summary.as_ref(), width, &mut marks, language);
        let overlay = RingOverlay { summary, ..RingOverlay::default() };
        let room = [width - 2.0 * MARGIN, height - top - 2.5 * MARGIN];
        let layout = RingLayout::new(state.nodes().len(), room, language);
        let drawn = ring(&layout, state, &overlay, drawn_at, language);
        marks.extend(drawn.into_iter().map(|mark| mark.moved([MARGIN, top])));
        let sentence = format!(
            "At {}: {}",
            time_words(at, TimeScale::of_length(log.end()), language),
            snapshot.narrator.sentence(state, at, language)
        );
        let size = fitting(&sentence, TextSize::BODY, width - 2.0 * MARGIN);
        marks.push(label([width / 2.0, height - MARGIN], Anchor::Centre, sentence, size, Hue::Text));
        let legend = ring_legend(&layout, state, &overlay, drawn_at, language);
        let bottom = draw_legend(&legend, [MARGIN, height], width - 2.0 * MARGIN, &mut marks);
        Self { marks, size: [width, bottom + MARGIN] }
    }

    /// Draws the timeline of a whole run: a lane for each machine, with its number and its first speed.
    pub fn timeline(log: &RunLog, language: Language) -> Self {
        let lanes = Lanes::of(log);
        let nodes = log.header.speeds.len();
        let mut marks = Vec::new();
        let top = heading(log, Summary::of(log).as_ref(), TIMELINE_WIDTH, &mut marks, language);
        let lane_height = (640.0 / nodes as f32).clamp(4.0, 26.0);
        // Enough for the strip above the lanes and the axis below.
        let room = (58.0 + lane_height * nodes as f32).max(121.0);
        let layout = TimelineLayout {
            lane_height,
            ..TimelineLayout::new(nodes, TIMELINE_WIDTH - LANE_LABEL_WIDTH - MARGIN, room)
        };
        let end = log.end();
        let mut window = TimeWindow::default();
        window.fit(end);
        let mut drawn = Vec::new();
        let made = timeline(&lanes, &window, &layout, end);
        drawn.extend(made.quads.into_iter().map(|quad| {
            let [left, top, right, bottom] = quad.place;
            let (centre, half) =
                ([(left + right) / 2.0, (top + bottom) / 2.0], [(right - left) / 2.0, (bottom - top) / 2.0]);
            Mark::Box { centre, half, round: 0.0, ink: quad.ink }
        }));
        let within = |[x, y]: Point, [u, v]: Point| {
            // A message that is on its way at the end is cut at the edge.
            let part = if u > layout.width { (layout.width - x) / (u - x) } else { 1.0 };
            [x + part * (u - x), y + part * (v - y)]
        };
        drawn.extend(made.lines.into_iter().map(|(from, to, ink)| {
            let points = vec![from, within(from, to)];
            Mark::Line { points, width: 1.0, ink }
        }));
        lane_labels(log, &layout, &mut drawn);
        time_axis(log, &window, &layout, &mut drawn, language);
        marks.extend(drawn.into_iter().map(|mark| mark.moved([LANE_LABEL_WIDTH, top])));
        let foot = top + layout.bottom() + layout.axis_height + 18.0;
        let legend = timeline_legend(&lanes, &window, language);
        let bottom = draw_legend(&legend, [LANE_LABEL_WIDTH, foot], layout.width, &mut marks);
        Self { marks, size: [TIMELINE_WIDTH, bottom + MARGIN] }
    }
}

impl PrintedDrawing {
    /// Draws the time budgets of several runs.
    pub fn comparison(title: &str, runs: &[(&str, &TimeBudget)], language: Language) -> Self {
        const TOP: f32 = MARGIN + 36.0;
        let room = TIMELINE_WIDTH - 2.0 * MARGIN;
        let title = shown(title, MAX_TITLE_LETTERS);
        let size = fitting(&title, 1.5 * TextSize::BODY, room);
        let mut marks = vec![label([MARGIN, MARGIN + 6.0], Anchor::Left, title, size, Hue::Text)];
        marks.extend(time_budget_marks(runs, room, language).into_iter().map(|mark| mark.moved([MARGIN, TOP])));
        Self { marks, size: [TIMELINE_WIDTH, TOP + time_budget_height(runs.len()) + MARGIN] }
    }
}

/// Draws number and speed of the machines, as many as there is room for, and the caption of the strip above them.
fn lane_labels(log: &RunLog, layout: &TimelineLayout, marks: &mut Vec<Mark>) {
    let is_low = layout.lane_height < TextSize::BODY;
    for node in layout.numbered(if is_low { TextSize::BODY } else { 0.0 }) {
        let [top, bottom] = layout.lane(node);
        let (y, size) = ((top + bottom) / 2.0, TextSize::Small(if is_low { 0.8 } else { 1.0 }));
        let speed = &log.header.speeds[usize::from(node)];
        marks.push(label([-56.0, y], Anchor::Right, node_name(node).to_string(), TextSize::Body(0.9), Hue::Text));
        marks.push(label([-8.0, y], Anchor::Right, fraction(*speed), size, Hue::Quiet));
    }
    if layout.header_height > 0.0 {
        marks.push(label(
            [-8.0, layout.header_height - 14.0],
            Anchor::Right,
            "tracing".into(),
            TextSize::Small(0.9),
            Hue::Quiet,
        ));
    }
}

/// Draws the axis below the lanes.
fn time_axis(log: &RunLog, window: &TimeWindow, layout: &TimelineLayout, marks: &mut Vec<Mark>, language: Language) {
    let ink = Hue::Quiet.full();
    let y = layout.bottom() + 2.0;
    marks.push(Mark::Line { points: vec![[0.0, y], [layout.width, y]], width: 1.0, ink });
    let (times, rate) = axis(window, layout.width);
    for time in times {
        let x = layout.width * window.share(time) as f32;
        marks.push(Mark::Line { points: vec![[x, y], [x, y + 5.0]], width: 1.0, ink });
        let words = time_words(time, TimeScale::of_length(log.end()).at_rate(rate), language);
        let half = TextSize::Small(1.0).width(words.chars().count()) / 2.0;
        let x = x.clamp(half.min(0.0), layout.width - half);
        let anchor = if x < half { Anchor::Left } else { Anchor::Centre };
        marks.push(label([x, y + 14.0], anchor, words, TextSize::Small(1.0), Hue::Quiet));
    }
}

/// Draws the sentences of a legend in as many lines as they need; returns the y of the last line.
fn draw_legend(sentences: &[&str], [x, y]: Point, room: f32, marks: &mut Vec<Mark>) -> f32 {
    const SIZE: TextSize = TextSize::Small(0.9);
    const LINE_STEP: f32 = 17.0;
    let mut lines: Vec<String> = Vec::new();
    // A sentence is not broken.
    for sentence in sentences {
        let fits = |line: &String| SIZE.width(line.chars().count() + 1 + sentence.chars().count()) <= room;
        match lines.last_mut().filter(|line| fits(line)) {
            Some(line) => *line += &format!(" {sentence}"),
            None => lines.push((*sentence).to_owned()),
        }
    }
    let last = lines.len().saturating_sub(1);
    for (i, line) in lines.into_iter().enumerate() {
        marks.push(label([x, y + LINE_STEP * i as f32], Anchor::Left, line, SIZE, Hue::Quiet));
    }
    y + LINE_STEP * last as f32
}

/// Draws the title of a run, its header in words, and its memo; returns the y below them.
fn heading(log: &RunLog, summary: Option<&Summary>, width: f32, marks: &mut Vec<Mark>, language: Language) -> f32 {
    let (header, room) = (&log.header, width - 2.0 * MARGIN);
    let nodes = header.speeds.len();
    let plural = if nodes == 1 { "" } else { "s" };
    let mut what = format!("{}: {}, {nodes} machine{plural}", header.size, header.scheduler().name());
    if header.title() != header.scene {
        what = format!("{}, {what}", header.scene);
    }
    if let Some(summary) = summary {
        what += &format!("; {}, efficiency {}", duration(summary.makespan, language), fraction(summary.efficiency));
    }
    let caption = &header.caption;
    let memo = text_lines(&caption.memo).take(MAX_MEMO_LINES);
    let lines = [(what, Hue::Text)].into_iter().chain(memo.map(|line| (line, Hue::Quiet)));
    let lines = lines.chain([(caption.machine.clone(), Hue::Quiet)]);
    let title = shown(&text_lines(header.title()).collect::<Vec<_>>().join(" "), MAX_TITLE_LETTERS);
    let mut y = MARGIN + 6.0;
    let size = fitting(&title, 1.5 * TextSize::BODY, room);
    marks.push(label([MARGIN, y], Anchor::Left, title, size, Hue::Text));
    y += 8.0;
    for (line, hue) in lines.filter(|(line, _)| !line.is_empty()) {
        y += 18.0;
        let line = shown(&line, MAX_TITLE_LETTERS);
        let size = fitting(&line, TextSize::SMALL, room).units() / TextSize::SMALL;
        marks.push(label([MARGIN, y], Anchor::Left, line, TextSize::Small(size), hue));
    }
    y + 20.0
}

/// Returns the text size, at most `size`, at which a text is at most `width` wide.
fn fitting(text: &str, size: f32, width: f32) -> TextSize {
    let broad = TextSize::Fit(size).width(text.chars().count());
    TextSize::Fit(size * (width / broad.max(1.0)).min(1.0))
}

fn label(at: Point, anchor: Anchor, text: String, size: TextSize, hue: Hue) -> Mark {
    Mark::Label { at, anchor, text, size, ink: hue.full() }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::tests::sample_runs;
    use super::*;
    use crate::balance::{Condition, Strategy};
    use crate::runlog::{Header, Metadata};
    use crate::scenario::Command;
    use crate::sim::Sim;

    fn texts(paper: &PrintedDrawing) -> Vec<&str> {
        let text = |mark: &'_ Mark| matches!(mark, Mark::Label { .. });
        let labels = paper.marks.iter().filter(|mark| text(mark));
        labels.filter_map(|mark| if let Mark::Label { text, .. } = mark { Some(&**text) } else { None }).collect()
    }

    proptest! {
        #[test]
        fn marks_stay_inside_the_sheet(
            speeds in prop::collection::vec(0.05..1.0f64, 1..40), atoms in 1..400u32, at in 0.0..20.0f64, title in ".{0,300}",
        ) {
            let language = Language::English;
            let mut log = sample_runs::log(&speeds, atoms);
            log.header.caption.title = title;
            for paper in [PrintedDrawing::ring(&log, Time::from_secs(at), language), PrintedDrawing::timeline(&log, language)] {
                let [width, height] = paper.size;
                let inside = |[x, y]: Point| (0.0..=width).contains(&x) && (0.0..=height).contains(&y);
                for mark in &paper.marks {
                    let within = match mark {
                        Mark::Disc { centre, .. } | Mark::Box { centre, .. } => inside(*centre),
                        Mark::Line { points, .. } | Mark::Trail { points, .. } => points.iter().copied().all(inside),
                        Mark::Label { at, anchor, text, size, .. } => {
                            let broad = size.width(text.chars().count());
                            let left = anchor.left(at[0], broad);
                            inside(*at) && left >= -0.1 && left + broad <= width + 0.1
                        }
                    };
                    prop_assert!(within, "{:?}: {mark:?}", paper.size);
                }
            }
        }
    }

    #[test]
    fn sheet_has_a_heading() {
        let language = Language::English;
        let log = sample_runs::log(&[1.0, 1.0, 0.1], 300);
        let caption = Metadata { title: "A slow third".into(), memo: "for a talk".into(), machine: "some CPU".into() };
        let mut named = RunLog::new(Header { caption, ..log.header.clone() });
        named.add(log.records().to_vec());
        for paper in
            [PrintedDrawing::ring(&named, Time::from_secs(1.0), language), PrintedDrawing::timeline(&named, language)]
        {
            let texts = texts(&paper);
            for said in ["A slow third", "for a talk", "some CPU", "3", "10 %"] {
                assert!(texts.iter().any(|text| text.contains(said)), "{said}: {texts:?}");
            }
        }
        assert!(
            texts(&PrintedDrawing::timeline(&log, language)).contains(&"sample"),
            "without a title it shows the scene"
        );
    }

    /// A run of a tiny picture lasts milliseconds, or less.
    #[test]
    fn times_of_short_runs_can_be_told_apart() {
        for (cost, unit) in [(Duration::from_micros(10), "ms"), (Duration::from_nanos(30), "µs")] {
            let mut header = sample_runs::header(&[1.0, 0.5, 0.1], 300);
            header.link.latency = cost;
            let (mut log, mut records) = (RunLog::new(header.clone()), Vec::new());
            Sim::new(&header, &[], move |_| cost).run(&mut |record| records.push(record));
            log.add(records);
            for language in [Language::English, Language::Portuguese] {
                let timeline = PrintedDrawing::timeline(&log, language);
                let times: Vec<_> =
                    texts(&timeline).into_iter().filter(|text| text.ends_with(&format!(" {unit}"))).collect();
                let distinct: std::collections::BTreeSet<_> = times.iter().collect();
                assert!(times.len() > 3 && distinct.len() == times.len(), "{:?}", texts(&timeline));
                let ring = PrintedDrawing::ring(&log, Time(log.end().0 / 2), language);
                for text in texts(&timeline).into_iter().chain(texts(&ring)) {
                    assert!(!text.contains("0.0 s") && !text.contains("0,0 s"), "{text}");
                }
            }
        }
    }

    #[test]
    fn memo_has_the_lines_that_were_typed() {
        let mut log = sample_runs::log(&[1.0, 0.1], 30);
        log.header.caption.memo = "first\\nsecond\n\n third ".into();
        let texts = |paper: &PrintedDrawing| texts(paper).into_iter().map(str::to_owned).collect::<Vec<_>>();
        for paper in [
            PrintedDrawing::ring(&log, Time(u64::MAX), Language::English),
            PrintedDrawing::timeline(&log, Language::English),
        ] {
            let texts = texts(&paper);
            let at = texts.iter().position(|text| text == "first").expect("the first line");
            assert_eq!(texts[at..at + 3], ["first", "second", "third"]);
        }
    }

    /// What is drawn and what is not is known from how the run was made.
    #[test]
    fn legend_names_what_is_drawn_and_nothing_else() {
        let language = Language::English;
        let said = |log: &RunLog, at: f64| {
            let papers =
                [PrintedDrawing::ring(log, Time::from_secs(at), language), PrintedDrawing::timeline(log, language)];
            papers.map(|paper| texts(&paper).join(" "))
        };
        let [ring, timeline] = said(&sample_runs::log(&[1.0, 1.0, 0.1], 300), 1e-3);
        assert!(ring.contains("way of offers") && !ring.contains("a request") && !ring.contains("paused"), "{ring}");
        assert!(timeline.contains("offers") && timeline.contains("no longer needed"), "{timeline}");
        assert!(!timeline.contains("off.") && !timeline.contains("paused"), "{timeline}");
        let mut header = sample_runs::header(&[1.0; 3], 300);
        header.rules.strategy = Strategy::Adaptive;
        let at = Time::from_secs;
        let script = [
            (at(0.5), Command::Pause { node: 0, paused: true }),
            (at(0.6), Command::Condition { node: 1, condition: Condition::Hung }),
            (at(0.7), Command::Condition { node: 2, condition: Condition::Off }),
            (at(4.0), Command::Pause { node: 0, paused: false }),
            (at(4.0), Command::Condition { node: 1, condition: Condition::Well }),
        ];
        let (mut log, mut records) = (RunLog::new(header.clone()), Vec::new());
        Sim::new(&header, &script, |_| sample_runs::COST).run(&mut |record| records.push(record));
        log.add(records);
        let [ring, timeline] = said(&log, 2.0);
        for words in ["Two bars: paused", "Hourglass: hung", "Power switch: off"] {
            assert!(ring.contains(words), "{words}: {ring}");
        }
        for words in ["Black line in a lane: paused", "dashes: hung", "pale lane: off"] {
            assert!(timeline.contains(words), "{words}: {timeline}");
        }
        assert!(!timeline.contains("cut off"), "{timeline}");
    }

    #[test]
    fn ring_shows_its_time() {
        let language = Language::English;
        let log = sample_runs::log(&[1.0, 1.0, 0.1], 300);
        let at = |secs| texts(&PrintedDrawing::ring(&log, Time::from_secs(secs), language)).join("\n");
        assert!(at(0.0).contains("0 %") && at(0.0).contains("At 0.0"), "{}", at(0.0));
        assert!(at(1e6).contains("efficiency") && !at(1.0).contains("start to finish"), "{}", at(1e6));
    }
}

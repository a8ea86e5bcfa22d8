//! Uses a loaded run in every way that the program does.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use anel::balance::{NodeId, Strategy};
use anel::driver::{Retrace, RunError, Update};
use anel::gui::Settings;
use anel::language::Language;
use anel::picture::{Colour, Frame};
use anel::runlog::{Header, Metrics, RunLog};
use anel::sim::Sim;
use anel::time::Time;
use anel::tracer::Scratch;
use anel::view::{
    Details, Layer, Narrator, RingLayout, RingOverlay, RunState, RunView, Snapshot, SnapshotCache, StepUnit, Summary,
    TimeScale, TimeWindow, TimelineLayout, atom_words, axis, disturbance, drawing_notes, flight_words, landmarks,
    node_rows, node_shares, node_words, parent_words, picture_pixels, record_words, result_words, ring, step,
    time_words, timeline, timeline_at, work_split_words,
};

use super::assert_sentence;

/// Atoms or pixels of the largest run that is simulated and traced; larger ones are valid but slow.
const MAX_SIZE: u32 = 10_000;

/// Loads a run and uses it in every way. Returns whether it could be loaded.
pub fn show(file: &Path) -> bool {
    let language = Language::English;
    let log = match RunLog::load(file) {
        Ok(log) => log,
        Err(error) => {
            assert_sentence(&error.to_string());
            return false;
        }
    };
    let outcome = metrics(&log);
    view(&log, outcome, language);
    go_through(&log, language);
    if log.header.division.atoms() <= MAX_SIZE {
        simulate(&log, language);
        retrace(log);
    }
    true
}

/// The figures of a finished run.
fn metrics(log: &RunLog) -> Option<Summary> {
    let metrics = Metrics::of(log);
    assert!(metrics.tail_idle().is_none_or(f64::is_finite));
    let traced: u64 = metrics.atoms_by_node().into_iter().map(u64::from).sum();
    assert!(traced <= log.records().len() as u64);
    let (makespan, ideal, efficiency) = (metrics.makespan()?, metrics.ideal()?, metrics.efficiency()?);
    assert!(efficiency.is_finite() && efficiency >= 0.0);
    Some(Summary { makespan, ideal, efficiency, spread: metrics.finish_spread(), disturbance: disturbance(log) })
}

/// Makes all texts and drawings, in the middle and at the end of the run.
fn view(log: &RunLog, outcome: Option<Summary>, language: Language) {
    let (mut state, mut narrator) = (RunState::new(&log.header), Narrator::default());
    let middle = log.records().len() / 2;
    for (index, record) in log.records().iter().enumerate() {
        state.apply(record);
        narrator.apply(record, &state);
        if index == middle {
            draw(&state, &narrator, None, record.at, language);
        }
    }
    draw(&state, &narrator, outcome, state.head(), language);
    draw(&state, &narrator, outcome, Time(u64::MAX), language);
    if log.header.size.pixels() <= MAX_SIZE {
        let frame = Frame::new(log.header.size);
        let colours = vec![[200; 3]; log.header.speeds.len()];
        let pixels = picture_pixels(&frame, &state, &colours, (Layer::Costs, 0.5));
        assert_eq!(pixels.len(), 3 * log.header.size.pixels() as usize);
    }
}

/// Moves to several times of the run, draws its timeline at several zooms, and asks for all details.
fn go_through(log: &RunLog, language: Language) {
    let known = RunView::of(log);
    let (mut past, mut moment) = (SnapshotCache::default(), Snapshot::new(&log.header));
    let records = log.records().len();
    let mut said = String::new();
    for there in [records / 2, records, records / 3, 0] {
        past.seek(log, there, &mut moment);
        assert_eq!(moment.records(), there);
        for by in StepUnit::ALL {
            for forward in [true, false] {
                let to = step(log, there, by, forward);
                assert!(to.is_none_or(|to| to <= records && (to > there) == forward));
                said += &to
                    .and_then(|to| to.checked_sub(1))
                    .map_or(String::new(), |last| record_words(&log.records()[last], &moment.state, language));
            }
        }
    }
    for mark in landmarks(log, language) {
        let details = Details::of(mark.subject, log, &known.lanes, &mut past, language);
        said += &format!(
            "{:?}{:?}",
            details.words(&moment.state, mark.at, TimeScale::of_length(mark.at), language),
            details.highlight(&moment.state)
        );
    }
    let end = log.records().last().map_or(Time::ZERO, |last| last.at);
    said += &format!("{:?}", known.lanes.usage(end));
    let plan = TimelineLayout::new(log.header.speeds.len(), 300.0, 200.0);
    let mut window = TimeWindow::default();
    window.fit(end);
    for _ in 0..3 {
        let drawn = timeline(&known.lanes, &window, &plan, end);
        assert!(drawn.quads.iter().all(|quad| quad.place.iter().all(|side| side.is_finite())));
        let (times, rate) = axis(&window, 300.0);
        said += &times
            .into_iter()
            .map(|time| time_words(time, TimeScale::of_length(time).at_rate(rate), language))
            .collect::<String>();
        for y in [0.0, 60.0, 150.0] {
            said += &format!("{:?}", timeline_at(&known.lanes, &window, &plan, [120.0, y]));
        }
        window.zoom(0.4, 0.01);
        window.fit(end);
    }
    assert!(!said.contains("NaN") && !said.contains("inf"), "{said}");
}

fn draw(state: &RunState, narrator: &Narrator, outcome: Option<Summary>, now: Time, language: Language) {
    let layout = RingLayout::new(state.nodes().len(), [400.0, 300.0], language);
    let overlay = RingOverlay { summary: outcome, selected: Some(0), ..RingOverlay::default() };
    let marks = ring(&layout, state, &overlay, now, language);
    let mut said = format!("{marks:?}");
    for node in 0..state.nodes().len().min(40) as NodeId {
        said += &format!("{:?}", node_words(state, node, now, language));
    }
    for atom in 0..state.atoms().min(40) {
        said += &atom_words(state, atom, now, language);
    }
    state.flights().iter().take(40).for_each(|flight| said += &flight_words(flight, language));
    said += &format!(
        "{:?}{:?}{:?}",
        parent_words(state, now, language),
        drawing_notes(state, language),
        work_split_words(state, language)
    );
    said += &narrator.sentence(state, now, language);
    narrator.other_events(state, now).for_each(|(_, event)| said += &event.sentence(language));
    said += &outcome.map(|outcome| result_words(state, &outcome, language)).unwrap_or_default();
    assert!(!said.contains("NaN") && !said.contains("inf,"), "{said}");
    assert_eq!(node_rows(state, now).len(), state.nodes().len());
    assert_eq!(node_shares(state).len(), state.nodes().len());
}

/// Simulates a run with the recorded costs, as `anel render --costs` does, and checks its settings, as the window does
/// to make it live.
fn simulate(log: &RunLog, language: Language) {
    let speeds = vec![1.0, 0.5];
    let plain = Header::plain(log.header.size, log.header.division.atom_pixels(), Strategy::StaticEstimate, speeds);
    if let Ok(mut sim) = Sim::measured(&plain, log) {
        let mut records = 0;
        sim.run(&mut |_| records += 1);
        assert!(records > log.header.division.atoms());
    }
    let settings = Settings::of(&log.header, Settings::default().pace);
    if let Err(why) = settings.check(language) {
        assert_sentence(&why);
    }
}

/// Starts a retrace and stops it at once.
fn retrace(log: RunLog) {
    let black = |pixels: Range<u32>, _: &mut Scratch, out: &mut Vec<Colour>| out.extend(pixels.map(|_| [0.0; 3]));
    let retrace = Retrace::start_with(black, Arc::new(log));
    retrace.stop();
    match retrace.updates().iter().last() {
        Some(Update::Finished) => {}
        Some(Update::Failed(RunError::Stopped)) => {}
        other => panic!("the retrace ends with {other:?}"),
    }
}

//! Tests of the Portuguese texts: all texts of whole runs are compared with the English ones, sentence by sentence.

use std::time::Duration;

use super::faults::faults;
use super::sample_runs;
use crate::balance::{Condition, NodeId, Party, Rules, Scheduler, Strategy};
use crate::language::Language;
use crate::picture::{Difference, Quality, Size};
use crate::record::RecordKind;
use crate::runlog::{Driver, Header, Metrics, RunLog};
use crate::scenario::Command;
use crate::scene::{SMALL_BUILT_IN, Scene};
use crate::sim::Sim;
use crate::time::Time;
use crate::tracer::Tracer;
use crate::view::analysis::summary::{Summary, result_words, summary_figures};
use crate::view::charts::tradeoff::Tradeoff;
use crate::view::draw::display_list::Mark;
use crate::view::inspect::Inspected;
use crate::view::narration::record_sentences::record_words;
use crate::view::narration::status::status_sentence;
use crate::view::picture::overlay::Layer;
use crate::view::playback::clock::{RATES, rate_of_time_words, short_rate_words};
use crate::view::playback::details::Details;
use crate::view::playback::run_view::RunView;
use crate::view::playback::snapshots::{Snapshot, SnapshotCache};
use crate::view::ring::labels;
use crate::view::ring::layout::RingLayout;
use crate::view::ring::{RingOverlay, ring};
use crate::view::state::node_rows::node_rows;
use crate::view::state::node_state::Activity;
use crate::view::text::format::{TimeScale, activity_word, row_words};
use crate::view::text::quality::{measured_lines, quality_words, times_words};
use crate::view::text::scene_stats::{needs_lines, needs_warnings};
use crate::view::text::tooltips::{atom_words, drawing_notes, flight_words, node_words, parent_words};
use crate::view::timeline::landmarks::{StepUnit, Subject, landmarks};

/// Room for a text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Room {
    /// A sentence that is read while the run goes on.
    Heard,
    /// About as much as for the English text.
    Same,
    /// A line that may become two.
    Some,
}

/// Texts, and the room for each.
pub(super) type Said = Vec<(Room, String)>;

/// English words that no Portuguese sentence has.
const ENGLISH: [&str; 40] = [
    " the ",
    "The ",
    " is ",
    " are ",
    " and ",
    " of ",
    " to ",
    " its ",
    " with ",
    " has ",
    " have ",
    " for ",
    " from ",
    " by ",
    " at ",
    " it ",
    " on ",
    " in ",
    " not ",
    "machine",
    "Machine",
    " atom",
    "Atom",
    "parent",
    "Parent",
    "offer ",
    "offers",
    "picture",
    "Picture",
    "nobody",
    "wait",
    "trace",
    "speed",
    "slow",
    "fast",
    "light",
    "sample",
    "pixels per",
    "nothing",
    "stopped",
];

/// Makes the texts in both languages, compares them, and looks for faults in both.
pub(super) fn compare(say: impl Fn(Language) -> Said) {
    let [english, portuguese] = [Language::English, Language::Portuguese].map(say);
    assert_eq!(english.len(), portuguese.len());
    let mut wrong = Vec::new();
    for ((room, english), (_, portuguese)) in english.iter().zip(&portuguese) {
        wrong.extend(faults(english, Language::English).into_iter().chain(faults(portuguese, Language::Portuguese)));
        let length = portuguese.chars().count();
        let most = english.chars().count() as f64;
        let most = match room {
            Room::Heard => (1.35 * most + 8.0).min(115.0),
            Room::Same => 1.35 * most + 8.0,
            Room::Some => 1.5 * most + 20.0,
        } as usize;
        if length > most {
            wrong.push(format!("{length} letters, {most} at most: {portuguese}"));
        }
        let padded = format!(" {portuguese} ");
        if let Some(word) = ENGLISH.iter().find(|word| padded.contains(**word)) {
            wrong.push(format!("{word:?} in {portuguese}"));
        }
        let letters: Vec<char> = portuguese.chars().collect();
        if letters.windows(3).any(|three| three[0].is_ascii_digit() && three[1] == '.' && three[2].is_ascii_digit()) {
            wrong.push(format!("point: {portuguese}"));
        }
    }
    wrong.sort();
    wrong.dedup();
    assert!(wrong.is_empty(), "{} are wrong:\n{}", wrong.len(), wrong.join("\n"));
}

/// Whole runs of all strategies, with changes by the user.
fn runs() -> Vec<RunLog> {
    let ways = Strategy::ALL.into_iter().map(|strategy| (strategy, Driver::Sim));
    let ways = ways.chain([(Strategy::Ring, Driver::WorkStealing)]);
    let becomes = |node, condition| Command::Condition { node, condition };
    let failures = [
        (0.5, becomes(1, Condition::Off)),
        (1.4, becomes(1, Condition::Well)),
        (1.6, becomes(2, Condition::CutOff)),
        (2.2, becomes(0, Condition::Hung)),
        (2.9, becomes(0, Condition::Well)),
        (3.2, becomes(2, Condition::Well)),
        (3.4, becomes(0, Condition::Off)),
        (4.4, becomes(0, Condition::Well)),
    ];
    let hands: [&[(f64, Command)]; 4] = [
        &failures,
        &[],
        &[
            (1.0, Command::Speed { node: 1, speed: 0.4 }),
            (2.0, Command::Pause { node: 0, paused: true }),
            (2.2, Command::Speed { node: 0, speed: 0.6 }),
            (2.5, Command::Latency(Duration::from_millis(7))),
            (3.0, Command::Pause { node: 0, paused: false }),
            (3.5, Command::Latency(Duration::ZERO)),
            (3.6, Command::OwnLatency { party: Party::Node(0), latency: Some(Duration::from_millis(50)) }),
            (3.7, Command::OwnLatency { party: Party::Node(0), latency: None }),
            (3.8, Command::OwnLatency { party: Party::Parent, latency: Some(Duration::from_millis(5)) }),
            (4.0, Command::Speed { node: 1, speed: 1.0 }),
            (5.0, Command::Speed { node: 2, speed: 0.0 }),
            (9.0, Command::Pause { node: 1, paused: true }),
            (40.0, Command::Speed { node: 2, speed: 0.8 }),
            (41.0, Command::Pause { node: 1, paused: false }),
        ],
        &[
            (0.5, Command::Speed { node: 0, speed: 0.0 }),
            (0.6, Command::Speed { node: 1, speed: 0.0 }),
            (0.7, Command::Pause { node: 2, paused: true }),
            (30.0, Command::Pause { node: 2, paused: false }),
            (50.0, Command::Speed { node: 0, speed: 1.0 }),
        ],
    ];
    let mut logs = Vec::new();
    for (strategy, driver) in ways {
        for (speeds, handling) in [(&[1.0, 1.0, 0.1][..], 0), (&[1.0, 0.7, 0.9, 0.5, 0.1, 1.0, 1.0], 30), (&[0.8], 0)] {
            for script in hands {
                let plain = sample_runs::header(speeds, 900);
                let part = strategy.usual_part(plain.division, speeds.len());
                let handling = Duration::from_millis(handling);
                // With more beats a slow parent would have no time for requests.
                let beat = Rules::beat_for(handling, speeds.len());
                let rules = Rules { strategy: strategy.clone(), part, beat, ..plain.rules };
                let header = Header { rules, driver, handling, ..plain };
                let script: Vec<_> = script.iter().map(|&(at, command)| (Time::from_secs(at), command)).collect();
                let fits = |(_, command): &&(Time, Command)| match command {
                    Command::Speed { node, .. } | Command::Pause { node, .. } | Command::Condition { node, .. } => {
                        usize::from(*node) < speeds.len()
                    }
                    Command::Delay { .. } | Command::Latency(_) | Command::OwnLatency { .. } | Command::Link { .. } => {
                        true
                    }
                };
                let script: Vec<_> = script.iter().filter(fits).copied().collect();
                let mut records = Vec::new();
                Sim::new(&header, &script, |atom| sample_runs::COST + Duration::from_micros(u64::from(atom % 9) * 90))
                    .run(&mut |record| records.push(record));
                let mut log = RunLog::new(header);
                log.add(records);
                logs.push(log);
            }
        }
    }
    logs
}

/// Sentences of a run while it goes on.
pub(super) fn sentences_while_it_runs(log: &RunLog, language: Language) -> Said {
    let mut said = Vec::new();
    let mut snapshot = Snapshot::new(&log.header);
    said.push((Room::Heard, snapshot.narrator.sentence(&snapshot.state, Time::ZERO, language)));
    for (index, record) in log.records().iter().enumerate() {
        snapshot.apply(record);
        let (state, narrator, now) = (&snapshot.state, &snapshot.narrator, record.at);
        said.push((Room::Some, record_words(record, state, language)));
        said.push((Room::Heard, narrator.sentence(state, now, language)));
        if !matches!(record.kind, RecordKind::AtomStarted { .. }) {
            said.push((Room::Heard, status_sentence(state, language)));
            said.extend(narrator.events().last().map(|(_, event)| (Room::Same, event.sentence(language))));
        }
        if index % 37 == 0 {
            said.extend(pointed_words(&snapshot, now, language));
        }
    }
    said
}

/// Labels of a drawing.
fn labels_of(marks: Vec<Mark>) -> impl Iterator<Item = String> {
    marks.into_iter().filter_map(|mark| match mark {
        Mark::Label { text, .. } => Some(text),
        _ => None,
    })
}

/// Texts under the pointer, and labels of the ring.
fn pointed_words(snapshot: &Snapshot, now: Time, language: Language) -> Said {
    let (state, mut said) = (&snapshot.state, Vec::new());
    let nodes = 0..state.nodes().len() as NodeId;
    for (what, words) in
        nodes.flat_map(|node| node_words(state, node, now, language)).chain(parent_words(state, now, language))
    {
        said.extend([(Room::Same, what.to_owned()), (Room::Same, words)]);
    }
    // The ring has as many labels in both languages, but for the numbers of messages that give way to each other.
    let layout = RingLayout::new(state.nodes().len(), [1200.0, 1200.0], language);
    let drawn = ring(&layout, state, &RingOverlay::default(), now, language);
    let is_word = |words: &String| !words.starts_with('×') && words.parse::<u32>().is_err();
    said.extend(labels_of(drawn).filter(is_word).map(|words| (Room::Same, words)));
    said.extend((0..state.atoms()).step_by(97).map(|atom| (Room::Same, atom_words(state, atom, now, language))));
    said.extend(state.flights().iter().map(|flight| (Room::Some, flight_words(flight, language))));
    said.extend(drawing_notes(state, language).into_iter().map(|line| (Room::Same, line)));
    said
}

/// Sentences of a run after its end.
pub(super) fn sentences_after_it(log: &RunLog, language: Language) -> Said {
    let mut said = Vec::new();
    let RunView { latest: snapshot, markers, lanes, .. } = RunView::of(log);
    let (state, mut cache) = (&snapshot.state, SnapshotCache::default());
    said.extend(markers.all().iter().map(|marker| (Room::Same, marker.happening.sentence(language))));
    let found = landmarks(log, language);
    let subjects =
        found.iter().map(|mark| mark.subject).chain([Subject::Node(0), Subject::Atom(3), Subject::Message(u64::MAX)]);
    for subject in subjects.collect::<Vec<_>>() {
        let scale = TimeScale::of_length(log.end());
        let (title, more) =
            Details::of(subject, log, &lanes, &mut cache, language).words(state, state.head(), scale, language);
        said.extend([(Room::Some, title), (Room::Some, more)]);
    }
    said.extend(found.into_iter().map(|mark| (Room::Same, mark.words)));
    let metrics = Metrics::of(log);
    said.extend(node_rows(state, log.end()).iter().map(|row| (Room::Same, row_words(row, language))));
    if let (Some(makespan), Some(ideal), Some(efficiency)) = (metrics.makespan(), metrics.ideal(), metrics.efficiency())
    {
        let summary = Summary { makespan, ideal, efficiency, spread: metrics.finish_spread(), disturbance: 0.3 };
        said.push((Room::Same, result_words(state, &summary, language)));
        said.extend(
            summary_figures(&summary, language)
                .into_iter()
                .map(|(value, what)| (Room::Same, format!("{value} {}", what.name(language)))),
        );
    }
    said
}

#[test]
fn sentences_of_runs_are_portuguese() {
    let runs = runs();
    assert!(runs.iter().filter(|log| Metrics::of(log).makespan().is_some()).count() > 30);
    compare(|language| runs.iter().flat_map(|log| sentences_while_it_runs(log, language)).collect());
    compare(|language| runs.iter().flat_map(|log| sentences_after_it(log, language)).collect());
}

#[test]
fn names_and_numbers_are_portuguese() {
    compare(|language| {
        let mut said: Vec<String> = Vec::new();
        for scheduler in Scheduler::ALL {
            said.extend([
                scheduler.title(language).to_owned(),
                scheduler.hint(language).to_owned(),
                scheduler.machines(8, language),
                scheduler.machines(1, language),
            ]);
        }
        said.extend(
            RATES.into_iter().flat_map(|rate| [rate_of_time_words(rate, language), short_rate_words(rate, language)]),
        );
        said.extend(
            Layer::ALL
                .into_iter()
                .flat_map(|layer| [layer.name(language), layer.ends(language).map_or("", |ends| ends[1])])
                .map(str::to_owned),
        );
        said.extend(StepUnit::ALL.map(|step| step.name(language).to_owned()));
        said.extend([0.4, 1.0, 2.5].map(|times| times_words(times, 1.0, language)));
        let adaptive = Quality { samples: 4, threshold: 0.02, cutoff: 0.001, ..Quality::default() };
        said.extend([Quality::default(), adaptive].iter().map(|quality| quality_words(quality, language)));
        let size = Size::new(640, 480).expect("a possible size");
        let difference = Difference { rmse: 0.0123, wrong_pixels: 1000, worst_ssim: 0.5 };
        let lines = measured_lines(Duration::from_millis(1234), size, &difference, size, language);
        said.extend(lines.into_iter().flat_map(|(what, words)| [what.to_owned(), words]));
        let tradeoff = Tradeoff {
            points: vec![(0.5, 0.1), (2.0, 0.02)],
            front: vec![0, 1],
            floor: 0.004,
            present: Some(0),
            ..Tradeoff::default()
        };
        said.extend(labels_of(tradeoff.drawn([640.0, 480.0], language).marks));
        said.into_iter().map(|words| (Room::Same, words)).collect()
    });
}

#[test]
fn states_fit_below_a_machine() {
    let all = [
        Activity::NoBand,
        Activity::Tracing,
        Activity::SpeedZero,
        Activity::Paused,
        Activity::Offering,
        Activity::Asking,
        Activity::InLine,
        Activity::Receiving,
        Activity::Idle,
        Activity::Retired,
        Activity::Asleep,
        Activity::NoMore,
        Activity::Hung,
        Activity::CutOff,
        Activity::Off,
        Activity::Spare,
        Activity::Done,
    ];
    compare(|language| all.map(|activity| (Room::Same, activity_word(activity, language).to_owned())).to_vec());
    let short = |activity| {
        activity_word(activity, Language::Portuguese).chars().count()
            <= labels::second_line_letters(Language::Portuguese)
    };
    assert!(all.iter().all(|activity| short(*activity)));
}

#[test]
fn texts_of_scenes_and_pixels_are_portuguese() {
    let size = Size::new(24, 18).expect("a small picture");
    compare(|language| {
        let mut said = Vec::new();
        for (_, text) in SMALL_BUILT_IN {
            let scene = Scene::parse(text).expect("a built-in scene");
            let tracer = Tracer::new(&scene, size, Quality::default());
            let lines = needs_lines(&tracer.scene_stats(), &tracer.levels(), language);
            said.extend(lines.into_iter().flat_map(|(what, words)| [what.to_owned(), words]));
            said.extend(needs_warnings(&tracer.scene_stats(), language));
            for pixel in (0..size.pixels()).step_by(41) {
                let place = [pixel % size.width(), pixel / size.width()];
                let pixel = Inspected::new(&tracer, &scene, place).expect("a pixel of the picture");
                said.extend(pixel.sentences(language).into_iter().chain(pixel.ray_sentences(language)));
                said.extend([pixel.term_words(language), pixel.span_words(language)]);
                let tree = pixel.ray_tree(300.0, language);
                said.extend(tree.spots.into_iter().map(|spot| spot.name));
                let marks = tree
                    .marks
                    .into_iter()
                    .chain(pixel.spans(400.0, 9, language).marks)
                    .chain(pixel.draw_terms(400.0, language).marks);
                said.extend(labels_of(marks.collect()));
            }
        }
        // Names of materials come from the scene.
        said.into_iter().map(|words| (Room::Some, words.replace("section of", "section"))).collect()
    });
}

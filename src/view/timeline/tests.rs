//! Tests of the timeline's drawing as a whole.

use proptest::prelude::*;

use super::*;
use crate::language::Language;
use crate::view::tests::sample_runs;

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
    let layout = TimelineLayout::new(3, WIDTH, 150.0);
    (lanes.clone(), timeline(&lanes, &window, &layout, end), window, layout)
}

proptest! {
    #[test]
    fn quads_stay_inside_the_timeline(atoms in 1..600u32, zoom in 0.001..1.0f64) {
        let (_, drawn, _, layout) = drawn(atoms, zoom);
        for quad in &drawn.quads {
            let [left, top, right, bottom] = quad.place;
            prop_assert!(left >= 0.0 && right <= WIDTH + 0.5 && top >= 0.0 && bottom <= layout.bottom() + 0.5, "{quad:?}");
            prop_assert!(right - left >= 0.0 && bottom > top);
        }
    }
}

#[test]
fn many_atoms_are_few_quads_and_zoomed_in_each_atom_is_one() {
    let (_, all, ..) = drawn(20_000, 1.0);
    assert!(all.quads.len() < 3_000, "{}", all.quads.len());
    let (lanes, near, window, layout) = drawn(20_000, 0.002);
    let seen = |node: usize| lanes.lanes()[node].bars_in(window.from(), window.to()).len();
    let of = |node: NodeId| {
        let [top, bottom] = layout.lane(node);
        near.quads.iter().filter(|quad| quad.place[1] == top && quad.place[3] == bottom).count()
    };
    assert!(seen(0) > 5 && of(0) == seen(0), "{} {}", of(0), seen(0));
}

#[test]
fn axis_has_round_times_inside_the_window() {
    let language = Language::English;
    let (_, _, window, _) = drawn(600, 0.05);
    let (times, rate) = axis(&window, WIDTH);
    assert!((3..=8).contains(&times.len()) && rate < 1.0, "{times:?}");
    assert!(times.iter().all(|&time| window.from() <= time && time <= window.to()));
    let scale = crate::view::TimeScale::of_length(window.to()).at_rate(rate);
    let words: Vec<_> = times.iter().map(|&time| crate::view::time_words(time, scale, language)).collect();
    assert!(words.windows(2).all(|pair| pair[0] != pair[1]), "{words:?}");
}

#[test]
fn subject_under_the_pointer_is_found() {
    let (lanes, _, window, layout) = drawn(600, 0.05);
    let bar = lanes.lanes()[0].bars_in(window.from(), window.to())[2];
    let x = (layout.x(&window, bar.from) + layout.x(&window, bar.to)) / 2.0;
    assert_eq!(timeline_at(&lanes, &window, &layout, [x, layout.middle(0)]), Some(Subject::Atom(bar.atom)));
    assert_eq!(timeline_at(&lanes, &window, &layout, [x, layout.bottom() + 9.0]), None);
}

//! Conditions of a machine in its lane: a pattern over the time for which it was hung, cut off or off, and a symbol at
//! the beginning.

use super::layout::TimelineLayout;
use super::quads::{Quad, Timeline};
use super::time_window::TimeWindow;
use crate::balance::{Condition, NodeId};
use crate::time::Time;
use crate::view::draw::display_list::Hue;
use crate::view::state::lane::Lane;

/// Length of a dash, and of the gap after it.
const DASH_AND_GAP_PX: [f32; 2] = [6.0, 4.0];
/// Maximum number of dashes: a longer line has longer dashes.
const MAX_DASHES: usize = 400;

/// Draws the conditions of a machine: an empty lane with a cross while it is off, a dashed line while it hangs, two
/// dashed lines with a cut wire while it is cut off.
pub(crate) fn draw_conditions(
    lane: &Lane,
    node: NodeId,
    window: &TimeWindow,
    layout: &TimelineLayout,
    head: Time,
    drawn: &mut Timeline,
) {
    let conditions = lane.conditions();
    for (i, &(from, condition)) in conditions.iter().enumerate() {
        let to = conditions.get(i + 1).map_or(head, |(next, _)| *next);
        let [left, right] = layout.span(window, from, to);
        if condition == Condition::Well || right <= left {
            continue;
        }
        let (middle, [top, bottom]) = (layout.middle(node), layout.lane(node));
        match condition {
            Condition::Off => {
                let place = [left, top, right, bottom];
                drawn.quads.push(Quad { place, ink: Hue::Hairline.faint(0.45) });
            }
            Condition::Hung => dashes([left, right], [middle - 1.5, middle + 1.5], &mut drawn.quads),
            Condition::CutOff => {
                for edge in [[top, top + 1.5], [bottom - 1.5, bottom]] {
                    dashes([left, right], edge, &mut drawn.quads);
                }
            }
            Condition::Well => {}
        }
        let (x, reach) = (layout.x(window, from), ((bottom - top) / 2.0 - 1.0).min(6.0));
        if (0.0..=layout.width).contains(&x) && reach > 2.0 {
            let [x, y] = [(x + reach + 2.0).min(layout.width - reach), middle];
            let at = |[u, v]: [f32; 2]| [x + u * reach, y + v * reach];
            let strokes = condition_strokes(condition).iter();
            drawn.lines.extend(strokes.map(|&[from, to]| (at(from), at(to), Hue::Text.full())));
        }
    }
}

fn dashes([left, right]: [f32; 2], [top, bottom]: [f32; 2], quads: &mut Vec<Quad>) {
    let ink = Hue::Text.faint(0.9);
    let step = (DASH_AND_GAP_PX[0] + DASH_AND_GAP_PX[1]).max((right - left) / MAX_DASHES as f32);
    let count = ((right - left) / step).ceil() as usize;
    for i in 0..count.min(MAX_DASHES) {
        let start = left + i as f32 * step;
        let end = (start + DASH_AND_GAP_PX[0] * step / (DASH_AND_GAP_PX[0] + DASH_AND_GAP_PX[1])).min(right);
        if end > start {
            quads.push(Quad { place: [start, top, end, bottom], ink });
        }
    }
}

/// Returns the strokes of a condition's symbol, within 1.3 of its centre. They are those of the badge in the ring,
/// except for a cross instead of the switch, and a tick for a machine that is well.
pub fn condition_strokes(condition: Condition) -> &'static [[[f32; 2]; 2]] {
    match condition {
        Condition::Well => &[[[-1.0, -0.1], [-0.3, 0.7]], [[-0.3, 0.7], [1.1, -1.1]]],
        Condition::Off => &[[[-1.0, -1.0], [1.0, 1.0]], [[-1.0, 1.0], [1.0, -1.0]]],
        Condition::Hung => &[
            [[-0.8, -1.0], [0.8, -1.0]],
            [[0.8, -1.0], [-0.8, 1.0]],
            [[-0.8, 1.0], [0.8, 1.0]],
            [[0.8, 1.0], [-0.8, -1.0]],
        ],
        Condition::CutOff => &[[[-1.3, 0.0], [-0.5, 0.0]], [[0.5, 0.0], [1.3, 0.0]], [[-0.3, 0.9], [0.3, -0.9]]],
    }
}

#[cfg(test)]
mod tests {
    use super::super::timeline;
    use super::*;
    use crate::record::{Record, RecordKind};
    use crate::view::state::lanes::Lanes;
    use crate::view::tests::sample_runs;

    /// How many quads and lines are added to three lanes if the second machine gets this condition at 1 s.
    fn marks_added(condition: Condition) -> (usize, usize) {
        let header = sample_runs::header(&[1.0; 3], 300);
        let draw = |kinds: &[RecordKind]| {
            let mut lanes = Lanes::new(&header);
            let at = Time::from_secs(1.0);
            kinds.iter().for_each(|kind| lanes.apply(&Record { at, kind: kind.clone() }));
            let (mut window, end) = (TimeWindow::default(), Time::from_secs(2.0));
            window.fit(end);
            let drawn = timeline(&lanes, &window, &TimelineLayout::new(3, 800.0, 150.0), end);
            (drawn.quads.len(), drawn.lines.len())
        };
        let (before, after) = (draw(&[]), draw(&[RecordKind::Condition { node: 1, condition }]));
        (after.0 - before.0, after.1 - before.1)
    }

    #[test]
    fn each_condition_has_its_own_symbol() {
        let [well, off, hung, cut] =
            [Condition::Well, Condition::Off, Condition::Hung, Condition::CutOff].map(marks_added);
        assert_eq!(well, (0, 0));
        assert_eq!([off.1, hung.1, cut.1], [2, 4, 3], "strokes");
        assert!(hung.0 > 20 && cut.0 > 2 * hung.0 - 20, "dashes {hung:?} {cut:?}");
    }

    #[test]
    fn spare_machine_is_off_from_the_beginning() {
        let header = crate::runlog::Header { spares: 1, ..sample_runs::header(&[1.0; 3], 300) };
        let lanes = Lanes::new(&header);
        let off: Vec<_> = lanes.lanes().iter().map(|lane| lane.conditions().len()).collect();
        assert_eq!(off, [0, 0, 1]);
    }
}

//! The lower corners of the ring's area: what the signs mean on the left, notes on the drawing on the right.

use std::f32::consts::{FRAC_PI_2, TAU};

use super::angles::arc;
use super::layout::RingLayout;
use super::machine::MIN_PIPE_RADIUS_PX;
use crate::language::{Language, word};
use crate::view::draw::display_list::{Anchor, Hue, Mark, Point, TextSize};
use crate::view::state::run_state::RunState;
use crate::view::text::glossary::Definition;
use crate::view::text::tooltips::drawing_notes;

const SIZE: TextSize = TextSize::Small(1.0);
const LINE_STEP_PX: f32 = 17.0;
/// Mean width of a letter, estimated rather too large than too small.
const LETTER_WIDTH_PX: f32 = 0.5 * TextSize::SMALL;
/// Width of the signs left of their meanings.
const SIGN_WIDTH_PX: f32 = 22.0;

/// Explains the signs in the lower left corner and notes in the lower right one how the ring is drawn: as many lines as
/// lie beside the ring and its labels. `size` is that of the whole area.
pub fn ring_corners(layout: &RingLayout, state: &RunState, size: Point, language: Language) -> Vec<Mark> {
    let (mut marks, mut widths) = (Vec::new(), Vec::new());
    for (sign, text) in key(layout, state, language).into_iter().rev() {
        let width = SIGN_WIDTH_PX + width_of(text);
        if let Some(y) = free_line(layout, [0.0, width], widths.len(), size, language) {
            sign.draw([8.0, y], &mut marks);
            marks.push(label([SIGN_WIDTH_PX, y], Anchor::Left, text.to_owned()));
            widths.push(width);
        }
    }
    let mut line = 0;
    for text in drawing_notes(state, language).into_iter().rev() {
        let left = size[0] - width_of(&text);
        let meets = widths.get(line).is_some_and(|&width| width > left);
        if let Some(y) = free_line(layout, [left, size[0]], line, size, language).filter(|_| !meets) {
            marks.push(label([size[0], y], Anchor::Right, text));
            line += 1;
        }
    }
    marks
}

/// Returns the middle height of the line with this number from below, if it is free from left to right.
fn free_line(
    layout: &RingLayout,
    [left, right]: [f32; 2],
    line: usize,
    [width, height]: Point,
    language: Language,
) -> Option<f32> {
    let y = height - LINE_STEP_PX * (line as f32 + 0.5);
    let sides = [left, y - LINE_STEP_PX / 2.0, right, y + LINE_STEP_PX / 2.0];
    (left >= 0.0 && right <= width && layout.is_free(sides, language)).then_some(y)
}

fn width_of(text: &str) -> f32 {
    LETTER_WIDTH_PX * text.chars().count() as f32
}

fn label(at: Point, anchor: Anchor, text: String) -> Mark {
    Mark::Label { at, anchor, text, size: SIZE, ink: Hue::Quiet.full() }
}

/// Finds the definition of the sign that [`ring_corners`] explains at a point, and the area of the explanation (left,
/// top, right, bottom).
pub fn ring_corner_at(
    layout: &RingLayout,
    state: &RunState,
    size: Point,
    [x, y]: Point,
    language: Language,
) -> Option<(Definition, [f32; 4])> {
    let mut line = 0;
    for (sign, text) in key(layout, state, language).into_iter().rev() {
        let width = SIGN_WIDTH_PX + width_of(text);
        let Some(middle) = free_line(layout, [0.0, width], line, size, language) else { continue };
        line += 1;
        let (top, bottom) = (middle - LINE_STEP_PX / 2.0, middle + LINE_STEP_PX / 2.0);
        if (0.0..width).contains(&x) && (top..bottom).contains(&y) {
            return Some((sign.definition(), [0.0, top, width, bottom]));
        }
    }
    None
}

/// A sign of the drawing.
#[derive(Clone, Copy)]
enum Sign {
    /// The arc round a machine.
    Arc,
    /// A hollow disc: an offer.
    Offer,
    /// A box with an arrow: a parcel.
    Parcel,
    /// Two squares: the pipe.
    Pipe,
    /// Three dots on a spoke: results.
    Results,
    /// A filled disc: a request.
    Request,
    /// A box: the answer to a request.
    Part,
}

/// Returns the signs of a run, with their meanings. The shortest comes first: it is the highest, beside the widest part
/// of the ring.
fn key(layout: &RingLayout, state: &RunState, language: Language) -> Vec<(Sign, &'static str)> {
    let arc = (Sign::Arc, word!(language, "atoms left", "átomos que restam"));
    let results = (Sign::Results, word!(language, "results to the parent", "resultados ao pai"));
    let mut key = vec![arc];
    if state.scheduler().is_ring() {
        key.extend([
            (Sign::Offer, word!(language, "offer of help", "oferta de ajuda")),
            results,
            (Sign::Parcel, word!(language, "atoms, giver to receiver", "átomos, de quem dá a quem recebe")),
        ]);
        if layout.node_radius >= MIN_PIPE_RADIUS_PX {
            key.push((
                Sign::Pipe,
                word!(language, "last two atoms, which it keeps", "dois últimos átomos, que ficam com ela"),
            ));
        }
    } else if state.scheduler().is_farm() {
        key.extend([
            (Sign::Request, word!(language, "request for atoms", "pedido de átomos")),
            (Sign::Part, word!(language, "answer of n atoms", "resposta de n átomos")),
            results,
        ]);
    } else {
        key.push(results);
    }
    key
}

impl Sign {
    fn definition(self) -> Definition {
        match self {
            Self::Arc => Definition::LEFT,
            Self::Offer => Definition::OFFER,
            Self::Parcel => Definition::PARCEL,
            Self::Pipe => Definition::PIPE,
            Self::Results => Definition::MESSAGES_WITH_RESULTS,
            Self::Request => Definition::REQUEST,
            Self::Part => Definition::PART,
        }
    }

    /// Draws it round a point, in at most 16 × 14.
    fn draw(self, [x, y]: Point, marks: &mut Vec<Mark>) {
        let ink = Hue::Quiet.full();
        let disc = |radius| Mark::Disc { centre: [x, y], radius, ink };
        let square = |x, half: Point| Mark::Box { centre: [x, y], half, round: 1.5, ink };
        let line = |points| Mark::Line { points, width: 1.5, ink };
        match self {
            Self::Arc => marks.extend([
                Mark::Line { points: arc([x, y], 5.5, 0.0, TAU), width: 2.0, ink: Hue::Quiet.faint(0.3) },
                Mark::Line { points: arc([x, y], 5.5, -FRAC_PI_2, 0.6 * TAU), width: 2.0, ink },
            ]),
            Self::Offer => marks.push(Mark::Line { points: arc([x, y], 5.0, 0.0, TAU), width: 1.5, ink }),
            Self::Parcel => marks.extend([
                square(x - 3.5, [3.5, 3.5]),
                line(vec![[x, y], [x + 7.0, y]]),
                line(vec![[x + 4.0, y - 3.0], [x + 7.0, y], [x + 4.0, y + 3.0]]),
            ]),
            Self::Results => {
                marks.extend([-5.0, 0.0, 5.0].map(|dx| Mark::Disc { centre: [x + dx, y], radius: 1.5, ink }))
            }
            Self::Pipe => marks.extend([square(x - 3.5, [2.5; 2]), square(x + 3.5, [2.5; 2])]),
            Self::Request => marks.extend([
                disc(6.0),
                Mark::Label {
                    at: [x, y],
                    anchor: Anchor::Centre,
                    text: "?".into(),
                    size: TextSize::Fit(10.0),
                    ink: Hue::Ground.full(),
                },
            ]),
            Self::Part => marks.extend([
                square(x, [8.0, 6.5]),
                Mark::Label {
                    at: [x, y],
                    anchor: Anchor::Centre,
                    text: "×n".into(),
                    size: TextSize::Fit(10.0),
                    ink: Hue::Ground.full(),
                },
            ]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::tests::sample_runs;

    #[test]
    fn corners_never_meet_the_ring_or_its_labels() {
        for nodes in [1, 2, 8, 12, 16, 32] {
            let state = RunState::new(&sample_runs::header(&vec![1.0; nodes], 90));
            for size in [[240.0, 240.0], [737.0, 428.0], [720.0, 380.0], [560.0, 250.0], [1130.0, 640.0]] {
                let (mut lines, language) = (0, Language::English);
                let layout = RingLayout::new(nodes, size, language);
                for mark in ring_corners(&layout, &state, size, language) {
                    let Mark::Label { at: [x, y], anchor, text, size: letters, .. } = mark else { continue };
                    let width = width_of(&text);
                    let (left, half) = (anchor.left(x, width), letters.line() / 2.0);
                    let sides = [left, y - half, left + width, y + half];
                    assert!(layout.is_free(sides, language), "{text:?} of {nodes} machines in {size:?}");
                    assert!(left >= 0.0 && left + width <= size[0] && y - half >= 0.0 && y + half <= size[1] + 0.01);
                    lines += 1;
                }
                assert!(lines >= 3 || size[0] < 700.0, "{lines} lines beside {nodes} machines in {size:?}");
            }
        }
    }
}

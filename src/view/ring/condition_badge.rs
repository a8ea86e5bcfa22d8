//! Badge at a machine's upper right that shows its condition without colour.

use std::f32::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

use super::layout::RingLayout;
use crate::view::draw::display_list::{Anchor, Hue, Mark, Point, TextSize};
use crate::view::state::node_state::Activity;

/// A badge, by the condition that it shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Badge {
    /// Two bars: paused.
    Paused,
    /// The letter z: asleep.
    Asleep,
    /// An hourglass: hung.
    Hung,
    /// A cut wire: cut off.
    CutOff,
    /// A power switch: off.
    Off,
}

impl Badge {
    /// Chooses the badge of a machine; `None` for a machine that works as usual.
    pub(crate) fn of(activity: Activity, paused: bool) -> Option<Self> {
        match activity {
            Activity::Hung => Some(Self::Hung),
            Activity::CutOff => Some(Self::CutOff),
            Activity::Off => Some(Self::Off),
            Activity::Done | Activity::Spare => None,
            _ if paused => Some(Self::Paused),
            Activity::Asleep => Some(Self::Asleep),
            _ => None,
        }
    }

    /// Draws the badge of the machine whose centre is at `x`, `y`.
    pub(crate) fn draw(self, layout: &RingLayout, [x, y]: Point, marks: &mut Vec<Mark>) {
        let radius = 0.34 * layout.node_radius;
        let away = layout.node_reach() - radius;
        let centre = [x + away * FRAC_PI_4.cos(), y - away * FRAC_PI_4.sin()];
        marks.push(Mark::Disc { centre, radius, ink: Hue::Ground.full() });
        marks.push(Mark::Disc { centre, radius: 0.87 * radius, ink: Hue::Text.full() });
        self.glyph(centre, radius, marks);
    }

    /// Draws the symbol within `radius` of the badge's centre.
    fn glyph(self, [x, y]: Point, radius: f32, marks: &mut Vec<Mark>) {
        let ink = Hue::Ground.full();
        let at = |[u, v]: Point| [x + u * radius, y + v * radius];
        let mut line = |points: &[Point]| {
            let points = points.iter().map(|&point| at(point)).collect();
            marks.push(Mark::Line { points, width: (0.16 * radius).max(1.0), ink });
        };
        match self {
            Self::Paused => {
                for side in [-1.0, 1.0] {
                    let (centre, half) = ([x + side * 0.25 * radius, y], [0.12 * radius, 0.4 * radius]);
                    marks.push(Mark::Box { centre, half, round: 0.05 * radius, ink });
                }
            }
            Self::Asleep => {
                let (text, size) = ("z".into(), TextSize::Fit(1.4 * radius));
                marks.push(Mark::Label { at: [x, y - 0.08 * radius], anchor: Anchor::Centre, text, size, ink });
            }
            Self::Hung => {
                line(&[[-0.36, -0.46], [0.36, -0.46], [-0.36, 0.46], [0.36, 0.46], [-0.36, -0.46]]);
            }
            Self::CutOff => {
                line(&[[-0.62, 0.0], [-0.22, 0.0]]);
                line(&[[0.22, 0.0], [0.62, 0.0]]);
                line(&[[-0.12, 0.42], [0.12, -0.42]]);
            }
            Self::Off => {
                line(&[[0.0, -0.58], [0.0, -0.06]]);
                let turn = |i: u8| {
                    let angle = -FRAC_PI_2 + 0.7 + f32::from(i) / 16.0 * (TAU - 1.4);
                    [0.46 * angle.cos(), 0.06 + 0.46 * angle.sin()]
                };
                line(&(0..=16).map(turn).collect::<Vec<_>>());
            }
        }
    }
}

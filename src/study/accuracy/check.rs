//! Checks that the automatic choice keeps its limit.

use super::{Point, Reference, fastest_within, front, measure};
use crate::cancel::CancelToken;
use crate::picture::Quality;
use crate::scene::Scene;

/// Number of greatest errors for which a choice is checked.
const LIMITS: usize = 8;

/// Pattern of samples for the second measurement; neither the reference nor any other point has it.
const REMEASURED_PATTERN: u32 = 3;

/// Check of one choice: the fastest point within a limit of the error.
#[derive(Clone, Copy, Debug)]
pub(super) struct ChoiceCheck {
    /// The limit of the error.
    pub error: f64,
    /// The choice from all points.
    pub chosen: Point,
    /// The same quality measured again, with other samples.
    pub remeasured: Point,
    /// CPU time of the choice from every other point over that of the choice from all, the worse of the two halves;
    /// `None` if a half has no point within the limit.
    pub half_over_all: Option<f64>,
}

impl ChoiceCheck {
    /// Returns the error of the second measurement over the limit.
    pub fn overshoot(&self) -> f64 {
        self.remeasured.rmse() / self.error
    }
}

/// Checks choices for limits from the fastest point's error to the best one's, spaced evenly on a logarithmic scale.
pub(super) fn check(scene: &Scene, reference: &Reference, points: &[Point]) -> Vec<ChoiceCheck> {
    let front = front(points);
    let (Some(fastest), Some(best)) = (front.first(), front.last()) else { return Vec::new() };
    let half = |first: usize| points.iter().skip(first).step_by(2).copied().collect::<Vec<Point>>();
    let halves = [half(0), half(1)];
    let limit = |i: usize| fastest.rmse() * (best.rmse() / fastest.rmse()).powf(i as f64 / (LIMITS - 1) as f64);
    // Rounding must not put the last limit below the best point.
    let limits = (0..LIMITS).map(|i| limit(i).max(best.rmse()));
    let chosen: Vec<(f64, Point)> = limits.filter_map(|error| Some((error, *fastest_within(points, error)?))).collect();
    let qualities: Vec<Quality> =
        chosen.iter().map(|(_, point)| Quality { pattern: REMEASURED_PATTERN, ..point.quality }).collect();
    let remeasured =
        measure(scene, reference, &qualities, &CancelToken::default(), &mut |_, _, _| {}).unwrap_or_default();
    let choice = |((error, chosen), remeasured): ((f64, Point), Point)| {
        let over = |half: &Vec<Point>| Some(fastest_within(half, error)?.cpu_s / chosen.cpu_s);
        let half_over_all = over(&halves[0]).zip(over(&halves[1])).map(|(one, other)| one.max(other));
        ChoiceCheck { error, chosen, remeasured, half_over_all }
    };
    chosen.into_iter().zip(remeasured).map(choice).collect()
}

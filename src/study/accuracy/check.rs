//! Whether the automatic choice keeps what it promises.

use super::{Point, Reference, fastest_within, front, measure};
use crate::cancel::CancelToken;
use crate::picture::Quality;
use crate::scene::Scene;

/// So many limits of the error are tried.
const LIMITS: usize = 8;

/// The pattern of samples of what is measured anew; neither the reference nor any other point has it.
const OTHER_PATTERN: u32 = 3;

/// What came of one choice: the fastest within a limit of the error.
#[derive(Clone, Copy, Debug)]
pub(super) struct Landing {
    /// The limit.
    pub error: f64,
    /// What was chosen from all points.
    pub chosen: Point,
    /// The same measured anew, with other samples.
    pub anew: Point,
    /// How much longer than this takes what is chosen where every other point is missing, the worse of both halves;
    /// `None` if a half has nothing within the limit.
    pub half_over_all: Option<f64>,
}

impl Landing {
    /// The error as measured anew over the limit.
    pub fn overshoot(&self) -> f64 {
        self.anew.rmse() / self.error
    }
}

/// Chooses at limits from the fastest point's error to the best one's, equally far apart on a logarithmic scale.
pub(super) fn check(scene: &Scene, reference: &Reference, points: &[Point]) -> Vec<Landing> {
    let front = front(points);
    let (Some(fastest), Some(best)) = (front.first(), front.last()) else { return Vec::new() };
    let half = |first: usize| points.iter().skip(first).step_by(2).copied().collect::<Vec<Point>>();
    let halves = [half(0), half(1)];
    let limit = |i: usize| fastest.rmse() * (best.rmse() / fastest.rmse()).powf(i as f64 / (LIMITS - 1) as f64);
    // Rounding must not put the last limit below the best point.
    let limits = (0..LIMITS).map(|i| limit(i).max(best.rmse()));
    let chosen: Vec<(f64, Point)> = limits.filter_map(|error| Some((error, *fastest_within(points, error)?))).collect();
    let qualities: Vec<Quality> =
        chosen.iter().map(|(_, point)| Quality { pattern: OTHER_PATTERN, ..point.quality }).collect();
    let anew = measure(scene, reference, &qualities, &CancelToken::default(), &mut |_, _, _| {}).unwrap_or_default();
    let landing = |((error, chosen), anew): ((f64, Point), Point)| {
        let over = |half: &Vec<Point>| Some(fastest_within(half, error)?.cpu_s / chosen.cpu_s);
        let half_over_all = over(&halves[0]).zip(over(&halves[1])).map(|(one, other)| one.max(other));
        Landing { error, chosen, anew, half_over_all }
    };
    chosen.into_iter().zip(anew).map(landing).collect()
}

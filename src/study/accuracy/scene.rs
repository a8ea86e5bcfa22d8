//! Measurements of one scene: every knob alone, combinations, and the automatic choice.

use super::check::{ChoiceCheck, check};
use super::knobs::{Knob, MAX_SAMPLES_PER_SIDE, combinations, size_for};
use super::{Point, Reference, measure};
use crate::cancel::CancelToken;
use crate::picture::{Difference, Frame, Quality, Size};
use crate::scene::Opened;
use crate::study::StudyError;
use crate::study::progress::Progress;

/// Results for one scene.
pub(super) struct SceneAccuracy {
    pub scene: String,
    pub size: Size,
    /// Error of the reference itself.
    pub floor: f64,
    /// Difference of the reference from a picture with as many samples at the default depth and cutoff.
    pub beyond_limits: f64,
    pub measured: Vec<MeasuredPoint>,
    pub choices: Vec<ChoiceCheck>,
}

/// A point, and the reason why it was measured.
pub(super) struct MeasuredPoint {
    /// The knob that is turned alone; `None` for a combination.
    pub knob: Option<Knob>,
    /// The value of that knob.
    pub value: Option<f64>,
    pub point: Point,
    /// The error of this knob alone. Samples and threshold: against very many samples, all else being equal. Depth and
    /// cutoff: against the same samples without that limit. `None` for the point without a limit, and for combinations.
    pub alone: Option<f64>,
}

/// Number of steps that [`SceneAccuracy::of`] takes.
pub(super) fn steps() -> usize {
    Reference::STEPS + Knob::ALL.iter().map(|knob| knob.values().len()).sum::<usize>() + combinations().len() + 1
}

impl SceneAccuracy {
    /// Measures a scene, in a picture within `most`.
    ///
    /// # Errors
    /// [`StudyError::Run`], if a thread cannot be started or panics.
    pub fn of(opened: &Opened, most: Size, progress: &mut Progress<'_>) -> Result<Self, StudyError> {
        let (name, scene) = (&opened.name, &opened.scene);
        let size = size_for(scene, most);
        let mut begin = || progress.next(&format!("{name}: the reference"));
        let reference = Reference::trace(scene, size, MAX_SAMPLES_PER_SIDE, &mut begin, &CancelToken::default())?;
        let reference = reference.ok_or(StudyError::Cancelled)?;
        let mut measured = Vec::new();
        for knob in Knob::ALL {
            let qualities: Vec<Quality> = knob.values().iter().map(|&value| knob.quality(value)).collect();
            let (points, frames) = at(opened, &reference, &qualities, knob.name(), progress)?;
            let without = if knob.limits_samples() { &reference.sampled } else { &frames[frames.len() - 1] };
            for ((&value, point), frame) in knob.values().iter().zip(points).zip(&frames) {
                let alone = Difference::of(frame, without).rmse;
                let alone = (!std::ptr::eq(frame, without)).then_some(alone);
                measured.push(MeasuredPoint { knob: Some(knob), value: Some(value), point, alone });
            }
        }
        let (points, _) = at(opened, &reference, &combinations(), "all together", progress)?;
        measured.extend(points.into_iter().map(|point| MeasuredPoint { knob: None, value: None, point, alone: None }));
        progress.next(&format!("{name}: the choice"));
        let points: Vec<Point> = measured.iter().map(|entry| entry.point).collect();
        let choices = check(scene, &reference, &points);
        let beyond_limits = Difference::of(&reference.sampled, &reference.picture).rmse;
        Ok(Self { scene: name.clone(), size, floor: reference.floor, beyond_limits, measured, choices })
    }

    /// Returns all measured points.
    pub fn points(&self) -> Vec<Point> {
        self.measured.iter().map(|entry| entry.point).collect()
    }

    /// Returns the measurements of one knob alone, the best last; of the combinations, if `None`.
    pub fn of_knob(&self, knob: Option<Knob>) -> impl Iterator<Item = &MeasuredPoint> {
        self.measured.iter().filter(move |entry| entry.knob == knob)
    }
}

/// Measures qualities and returns their points and pictures.
fn at(
    opened: &Opened,
    reference: &Reference,
    qualities: &[Quality],
    what: &str,
    progress: &mut Progress<'_>,
) -> Result<(Vec<Point>, Vec<Frame>), StudyError> {
    let mut frames: Vec<Frame> = Vec::new();
    let points = measure(&opened.scene, reference, qualities, &CancelToken::default(), &mut |place, _, frame| {
        if place == frames.len() {
            progress.next(&format!("{}: {what}", opened.name));
            frames.push(frame.clone());
        }
    });
    Ok((points.ok_or(StudyError::Cancelled)?, frames))
}

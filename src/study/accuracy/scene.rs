//! What is found of one scene: every knob alone, their combinations, and where the automatic choice lands.

use super::check::{Landing, check};
use super::knobs::{Knob, MOST, combinations, size_for};
use super::{Point, Reference, measure};
use crate::picture::{Difference, Frame, Quality, Size};
use crate::scene::Opened;
use crate::study::StudyError;
use crate::study::progress::Progress;

/// What is found of one scene.
pub(super) struct Found {
    pub scene: String,
    pub size: Size,
    /// The error of the reference itself.
    pub floor: f64,
    /// How far the reference is from a picture of as many samples at the default depth and cutoff.
    pub beyond_limits: f64,
    pub entries: Vec<MeasuredPoint>,
    pub landings: Vec<Landing>,
}

/// A point, and why it was measured.
pub(super) struct MeasuredPoint {
    /// The knob that is turned alone; `None` where all are.
    pub knob: Option<Knob>,
    /// What that is set to.
    pub value: Option<f64>,
    pub point: Point,
    /// The error for this knob alone: samples and threshold against very many samples, everything else being the same;
    /// depth and cutoff against the same samples without that limit. `None` of that without a limit, and of combinations.
    pub alone: Option<f64>,
}

/// How many steps [`Found::of`] takes.
pub(super) fn steps() -> usize {
    Reference::STEPS + Knob::ALL.iter().map(|knob| knob.values().len()).sum::<usize>() + combinations().len() + 1
}

impl Found {
    /// Measures a scene, in a picture of no more than `most`.
    ///
    /// # Errors
    /// A sentence, if a thread could not be started, or failed.
    pub fn of(opened: &Opened, most: Size, progress: &mut Progress<'_>) -> Result<Self, StudyError> {
        let (name, scene) = (&opened.name, &opened.scene);
        let size = size_for(scene, most);
        let mut begin = || progress.next(&format!("{name}: the reference"));
        let reference = Reference::trace(scene, size, MOST, &mut begin, &|| false)?;
        let reference = reference.ok_or(StudyError::Cancelled)?;
        let mut entries = Vec::new();
        for knob in Knob::ALL {
            let qualities: Vec<Quality> = knob.values().iter().map(|&value| knob.quality(value)).collect();
            let (points, frames) = at(opened, &reference, &qualities, knob.name(), progress)?;
            let without = if knob.is_of_sampling() { &reference.sampled } else { &frames[frames.len() - 1] };
            for ((&value, point), frame) in knob.values().iter().zip(points).zip(&frames) {
                let alone = Difference::of(frame, without).rmse;
                let alone = (!std::ptr::eq(frame, without)).then_some(alone);
                entries.push(MeasuredPoint { knob: Some(knob), value: Some(value), point, alone });
            }
        }
        let (points, _) = at(opened, &reference, &combinations(), "all together", progress)?;
        entries.extend(points.into_iter().map(|point| MeasuredPoint { knob: None, value: None, point, alone: None }));
        progress.next(&format!("{name}: the choice"));
        let points: Vec<Point> = entries.iter().map(|entry| entry.point).collect();
        let landings = check(scene, &reference, &points);
        let beyond_limits = Difference::of(&reference.sampled, &reference.picture).rmse;
        Ok(Self { scene: name.clone(), size, floor: reference.floor, beyond_limits, entries, landings })
    }

    /// All that was measured.
    pub fn points(&self) -> Vec<Point> {
        self.entries.iter().map(|entry| entry.point).collect()
    }

    /// What was measured of one knob alone, the best last; of all together, if none.
    pub fn of_knob(&self, knob: Option<Knob>) -> impl Iterator<Item = &MeasuredPoint> {
        self.entries.iter().filter(move |entry| entry.knob == knob)
    }
}

/// The points of these qualities, and their pictures.
fn at(
    opened: &Opened,
    reference: &Reference,
    qualities: &[Quality],
    what: &str,
    progress: &mut Progress<'_>,
) -> Result<(Vec<Point>, Vec<Frame>), StudyError> {
    let mut frames: Vec<Frame> = Vec::new();
    let points = measure(&opened.scene, reference, qualities, &|| false, &mut |place, _, frame| {
        if place == frames.len() {
            progress.next(&format!("{}: {what}", opened.name));
            frames.push(frame.clone());
        }
    });
    Ok((points.ok_or(StudyError::Cancelled)?, frames))
}

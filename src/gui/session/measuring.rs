//! The job that measures speed against accuracy.

use std::sync::Arc;

use super::Session;
use super::job_result::{Finding, JobResult, Prepared};
use super::jobs::Jobs;
use crate::cancel::{CancelOnDrop, CancelToken};
use crate::language::Language;
use crate::picture::{Quality, Size};
use crate::scene::Scene;
use crate::study::accuracy::{MAX_SAMPLES_PER_SIDE, Reference, measure, size_for};

impl Session {
    /// Measures what qualities of the scene cost, in place of what was measured before; returns the job's number.
    pub fn measure(&mut self, prepared: &Prepared, qualities: Vec<Quality>) -> u64 {
        let language = self.language;
        self.measurements += 1;
        self.jobs.measure(prepared, qualities, language)
    }

    /// Gives up what is being measured, if something is.
    pub fn stop_measuring(&mut self) {
        self.jobs.stop_measuring();
    }
}

impl Jobs {
    /// Measures these qualities in a small picture, in place of what was measured before; returns the job's number.
    pub fn measure(&mut self, prepared: &Prepared, qualities: Vec<Quality>, language: Language) -> u64 {
        let number = self.number();
        // Replacing the owner cancels the measurement before.
        let owner = CancelOnDrop::default();
        let cancel = owner.token();
        self.measuring = Some(owner);
        let (opened, tracer, whole) = (Arc::clone(&prepared.opened), Arc::clone(&prepared.tracer), prepared.size);
        let failed = move |why| JobResult::Found(number, Finding::Over(Err(why)));
        self.start_many(language, "measure", failed, move |tell| {
            let tell = |finding| tell(JobResult::Found(number, finding));
            tell(Finding::Needs(tracer.scene_stats(), tracer.levels()));
            tell(Finding::Over(found(&opened.scene, whole, &qualities, &cancel, &tell)));
        });
        number
    }

    /// Gives up what is being measured, if something is.
    pub fn stop_measuring(&mut self) {
        self.measuring = None;
    }
}

/// Measures all qualities, unless cancelled, and tells the findings.
fn found(
    scene: &Scene,
    whole: Size,
    qualities: &[Quality],
    cancel: &CancelToken,
    tell: &dyn Fn(Finding),
) -> Result<(), String> {
    let size = size_for(scene, small(whole)?);
    let mut begun = 0;
    let mut begin = || {
        begun += 1;
        tell(Finding::Begun(begun));
    };
    let reference =
        Reference::trace(scene, size, MAX_SAMPLES_PER_SIDE, &mut begin, cancel).map_err(|error| error.to_string())?;
    let Some(reference) = reference else { return Ok(()) };
    tell(Finding::Reference(reference.clone()));
    let mut known = 0;
    measure(scene, &reference, qualities, cancel, &mut |place, point, frame| {
        // Each comes for the first time in its turn.
        let is_new = place == known;
        known += usize::from(is_new);
        tell(Finding::Point(place, *point, is_new.then(|| frame.clone())));
    });
    Ok(())
}

/// A picture as high and broad as this one is to the other, but with few pixels, so that nobody waits for long.
fn small(whole: Size) -> Result<Size, String> {
    const PIXELS: f64 = 160.0 * 120.0;
    let part = (PIXELS / f64::from(whole.pixels())).sqrt().min(1.0);
    let side = |side: u32| ((f64::from(side) * part).round() as u32).max(1);
    Ok(Size::new(side(whole.width()), side(whole.height()))?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_picture_has_the_shape_of_the_whole_and_is_never_larger() {
        for (width, height) in [(640, 480), (2048, 64), (16, 16), (160, 120), (1920, 1080)] {
            let whole = Size::new(width, height).unwrap();
            let small = small(whole).unwrap();
            assert!(small.width() <= width && small.height() <= height && small.pixels() < 20_000, "{small}");
            let shape = |size: Size| f64::from(size.width()) / f64::from(size.height());
            assert!((shape(small) / shape(whole) - 1.0).abs() < 0.05, "{small} of {whole}");
        }
    }
}

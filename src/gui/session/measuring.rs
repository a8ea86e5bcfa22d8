//! The job of the Accuracy page: it measures speed and accuracy of qualities.

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
    /// Starts the measurement of these qualities; it replaces the present one. Returns the job's number.
    pub fn measure(&mut self, prepared: &Prepared, qualities: Vec<Quality>) -> u64 {
        let language = self.language;
        self.measurements += 1;
        self.jobs.measure(prepared, qualities, language)
    }

    /// Cancels the measurement, if one is in progress.
    pub fn stop_measuring(&mut self) {
        self.jobs.stop_measuring();
    }
}

impl Jobs {
    /// Starts the measurement of these qualities in a small picture; it replaces the present one. Returns the job's
    /// number.
    pub fn measure(&mut self, prepared: &Prepared, qualities: Vec<Quality>, language: Language) -> u64 {
        let number = self.number();
        // Replacing the owner cancels the earlier measurement.
        let owner = CancelOnDrop::default();
        let cancel = owner.token();
        self.measuring = Some(owner);
        let (opened, tracer, whole) = (Arc::clone(&prepared.opened), Arc::clone(&prepared.tracer), prepared.size);
        let failed = move |why| JobResult::Found(number, Finding::Over(Err(why)));
        self.start_many(language, "measure", failed, move |send| {
            let send = |finding| send(JobResult::Found(number, finding));
            send(Finding::Needs(tracer.scene_stats(), tracer.levels()));
            send(Finding::Over(measure_all(&opened.scene, whole, &qualities, &cancel, &send)));
        });
        number
    }

    /// Cancels the measurement, if one is in progress.
    pub fn stop_measuring(&mut self) {
        self.measuring = None;
    }
}

/// Measures all qualities, unless cancelled, and sends each result.
fn measure_all(
    scene: &Scene,
    whole: Size,
    qualities: &[Quality],
    cancel: &CancelToken,
    send: &dyn Fn(Finding),
) -> Result<(), String> {
    let size = size_for(scene, shrink(whole)?);
    let mut begun = 0;
    let mut begin = || {
        begun += 1;
        send(Finding::Begun(begun));
    };
    let reference =
        Reference::trace(scene, size, MAX_SAMPLES_PER_SIDE, &mut begin, cancel).map_err(|error| error.to_string())?;
    let Some(reference) = reference else { return Ok(()) };
    send(Finding::Reference(reference.clone()));
    let mut measured = 0;
    measure(scene, &reference, qualities, cancel, &mut |index, point, frame| {
        // First measurements come in the order of the qualities.
        let is_first = index == measured;
        measured += usize::from(is_first);
        send(Finding::Point(index, *point, is_first.then(|| frame.clone())));
    });
    Ok(())
}

/// Returns a size of the same shape with at most about 160 × 120 pixels, so that the measurement does not take long.
fn shrink(whole: Size) -> Result<Size, String> {
    const MAX_PIXELS: f64 = 160.0 * 120.0;
    let scale = (MAX_PIXELS / f64::from(whole.pixels())).sqrt().min(1.0);
    let side = |side: u32| ((f64::from(side) * scale).round() as u32).max(1);
    Ok(Size::new(side(whole.width()), side(whole.height()))?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shrunk_size_keeps_the_shape_and_is_never_larger() {
        for (width, height) in [(640, 480), (2048, 64), (16, 16), (160, 120), (1920, 1080)] {
            let whole = Size::new(width, height).unwrap();
            let small = shrink(whole).unwrap();
            assert!(small.width() <= width && small.height() <= height && small.pixels() < 20_000, "{small}");
            let shape = |size: Size| f64::from(size.width()) / f64::from(size.height());
            assert!((shape(small) / shape(whole) - 1.0).abs() < 0.05, "{small} of {whole}");
        }
    }
}

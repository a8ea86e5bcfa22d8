//! Coarse pictures of a scene, made before its run begins.

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::job_result::Thumbnail;
use crate::cancel::CancelToken;
use crate::palette::Rgb;
use crate::parallel::cores;
use crate::picture::{Colour, Frame, Quality, Size, srgb8};
use crate::scene::Scene;
use crate::tracer::{Scratch, Tracer};

/// Time limit of the preview before a run.
pub(super) const PREVIEW_TIME: Duration = Duration::from_millis(200);

/// Finest step of the preview before a run, in pixels: a finer one would anticipate the run's work.
pub(super) const PREVIEW_STEP: u32 = 4;

/// Gives the tracer a preview, refined until it has every `finest`th pixel or the next step would take longer than
/// `limit`.
#[expect(clippy::disallowed_methods, reason = "the user's waiting time is not on the run's clock")]
pub(super) fn with_preview(mut tracer: Tracer, finest: u32, limit: Duration) -> Tracer {
    let begun = Instant::now();
    let mut before = Duration::ZERO;
    loop {
        tracer.refine(cores());
        let is_fine = tracer.preview().is_none_or(|preview| preview.step() <= finest);
        let now = begun.elapsed();
        // The next step has four times the pixels of this one.
        if is_fine || now + 4 * (now - before) > limit {
            return tracer;
        }
        before = now;
    }
}

/// Returns all pixels of the preview in scan order; empty if the tracer has none.
pub(super) fn preview_pixels(tracer: &Tracer) -> Arc<[Rgb]> {
    let (width, height) = (tracer.size().width(), tracer.size().height());
    let Some(preview) = tracer.preview() else { return Arc::default() };
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    pixels.map(|(x, y)| srgb8(preview.interpolate(x, y))).collect()
}

/// Traces the thumbnail of a scene for the Scenes page, with antialiasing if that is quick; `None` if it is cancelled.
#[expect(clippy::disallowed_methods, reason = "the user's waiting time is not on the run's clock")]
pub(super) fn thumbnail(scene: &Scene, cancel: &CancelToken) -> Option<Thumbnail> {
    /// With 2 × 2 samples a pixel the thumbnail takes four times as long.
    const MAX_TIME_WITHOUT_ANTIALIASING: Duration = Duration::from_millis(500);
    // Size::new fails only for an empty or a huge picture.
    let size = Size::new(400, 300).expect("a possible size");
    let begun = Instant::now();
    let mut pixels = picture(scene, size, 1, cancel)?;
    if begun.elapsed() < MAX_TIME_WITHOUT_ANTIALIASING {
        pixels = picture(scene, size, 2, cancel)?;
    }
    Some(Thumbnail { size, rgb: Frame::of(size, &pixels).to_srgb8() })
}

fn picture(scene: &Scene, size: Size, samples: u32, cancel: &CancelToken) -> Option<Vec<Colour>> {
    let tracer = Tracer::new(scene, size, Quality { samples, ..Quality::default() });
    let (mut pixels, mut scratch) = (Vec::new(), Scratch::default());
    for row in 0..size.height() {
        if cancel.is_cancelled() {
            return None;
        }
        tracer.trace(row * size.width()..(row + 1) * size.width(), &mut scratch, &mut pixels);
    }
    Some(pixels)
}

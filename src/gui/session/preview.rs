//! Coarse pictures of a scene, ready before its run begins.

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::job_result::Thumbnail;
use crate::palette::Rgb;
use crate::picture::{Frame, Quality, Size, srgb8};
use crate::scene::Scene;
use crate::tracer::{Scratch, Tracer};

/// How long a preview may take, so that it does not keep its user waiting.
pub(super) const PREVIEW: Duration = Duration::from_millis(200);

/// Where most of the picture is known beforehand, there is little for the nodes to do.
pub(super) const FINEST: u32 = 4;

/// With a preview that is begun, and made finer until it has every `finest`th pixel or takes longer than `limit`.
#[expect(clippy::disallowed_methods, reason = "how long a user waits is no matter of the run's clock")]
pub(super) fn with_preview(mut tracer: Tracer, finest: u32, limit: Duration) -> Tracer {
    let begun = Instant::now();
    loop {
        tracer.refine();
        let is_fine = tracer.preview().is_none_or(|preview| preview.step() <= finest);
        // The next step takes three times as long as all before it.
        if is_fine || 4 * begun.elapsed() > limit {
            return tracer;
        }
    }
}

/// All pixels as the preview has them.
pub(super) fn guess(tracer: &Tracer) -> Arc<[Rgb]> {
    let (width, height) = (tracer.size().width(), tracer.size().height());
    let Some(preview) = tracer.preview() else { return Arc::default() };
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    places.map(|(x, y)| srgb8(preview.interpolate(x, y))).collect()
}

/// Traces a small picture of `scene` for the gallery.
pub(super) fn thumbnail(scene: &Scene) -> Thumbnail {
    // Neither side is 0, and there are few pixels.
    let size = Size::new(400, 300).expect("a possible size");
    let tracer = Tracer::new(scene, size, Quality { samples: 2, ..Quality::default() });
    let mut pixels = Vec::new();
    tracer.trace(0..size.pixels(), &mut Scratch::default(), &mut pixels);
    Thumbnail { size, rgb: Frame::of(size, &pixels).to_srgb8() }
}

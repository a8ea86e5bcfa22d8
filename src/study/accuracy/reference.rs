//! The reference pictures are compared with.

use std::sync::Arc;

use crate::cancel::CancelToken;
use crate::driver::TracedPicture;
use crate::picture::{Colour, Difference, Division, Frame, Quality, Size};
use crate::scene::Scene;
use crate::study::StudyError;
use crate::tracer::Tracer;

/// A nearly exact picture, with its own error.
///
/// Without any cutoff a tree of 50 levels may have 2⁵⁰ rays, and many samples of trees even a little smaller take too
/// long. So two pictures are added (multilevel Monte Carlo: S. Heinrich, *Multilevel Monte Carlo Methods*, 2001, and M.
/// B. Giles, 2008): one of very many samples at the default limits; and the light beyond these limits, as the
/// difference of two pictures with the same few samples. Both are means over two patterns of samples, which no measured
/// picture has.
#[derive(Clone, Debug)]
pub struct Reference {
    /// The picture, with a tree of [`Reference::DEPTH`] levels and a cutoff of [`Reference::CUTOFF`].
    pub picture: Frame,
    /// The picture at the default depth and cutoff: the limit of ever more samples.
    pub sampled: Frame,
    /// Error of [`Reference::picture`]: half of the root mean square difference of its two patterns, in linear light.
    /// Smaller errors cannot be distinguished from none.
    pub floor: f64,
}

/// Patterns of samples of the reference; measured pictures have others.
const PATTERNS: [u32; 2] = [1, 2];

impl Reference {
    /// Limit of the tree of rays.
    pub const DEPTH: u32 = 50;
    /// Most that all rays left out count together: invisible beside any other error here.
    pub const CUTOFF: f64 = 1e-5;
    /// Number of pictures traced for a reference.
    pub const STEPS: usize = 3 * PATTERNS.len();

    /// Traces a reference on all cores, with 18 times as many samples as `samples` × `samples` a pixel, and calls
    /// `begin` before each of its pictures. `None` if cancelled before the end.
    ///
    /// # Errors
    /// [`StudyError::Run`], if a thread cannot be started or panics.
    pub fn trace(
        scene: &Scene,
        size: Size,
        samples: u32,
        begin: &mut dyn FnMut(),
        cancel: &CancelToken,
    ) -> Result<Option<Self>, StudyError> {
        let default = Quality::default();
        let many = (3 * samples).min(Quality::MAX_SAMPLES);
        // A single sample would be in the middle of its pixel, whatever the pattern.
        let few = (samples / 2).max(2);
        let (mut sampled, mut pictures) = (Vec::new(), Vec::new());
        for pattern in PATTERNS {
            let mut trace = |samples, max_depth, cutoff| {
                begin();
                let quality = Quality { samples, max_depth, cutoff, pattern, ..default };
                let tracer = Arc::new(Tracer::new(scene, size, quality));
                let whole = TracedPicture::unless_cancelled(&tracer, Division::new(size.pixels(), 16), &|_| {}, cancel)
                    .map_err(StudyError::run)?;
                Ok::<_, StudyError>(whole.map(|whole| whole.pixels))
            };
            let Some(main) = trace(many, default.max_depth, default.cutoff)? else { return Ok(None) };
            let Some(short) = trace(few, default.max_depth, default.cutoff)? else { return Ok(None) };
            let Some(far) = trace(few, Self::DEPTH, Self::CUTOFF)? else { return Ok(None) };
            pictures.push(combined(size, &[(1.0, &main), (1.0, &far), (-1.0, &short)]));
            sampled.push(combined(size, &[(1.0, &main)]));
        }
        let mean = |frames: &[Frame]| {
            let each = 1.0 / frames.len() as f64;
            let parts: Vec<(f64, &[Colour])> = frames.iter().map(|frame| (each, frame.pixels())).collect();
            combined(size, &parts)
        };
        let floor = Difference::of(&pictures[0], &pictures[1]).rmse / 2.0;
        Ok(Some(Self { picture: mean(&pictures), sampled: mean(&sampled), floor }))
    }
}

/// Returns the weighted sum of pictures.
fn combined(size: Size, parts: &[(f64, &[Colour])]) -> Frame {
    let channel = |pixel: usize, channel: usize| {
        parts.iter().map(|(factor, pixels)| factor * f64::from(pixels[pixel][channel])).sum::<f64>() as f32
    };
    let pixels: Vec<Colour> = (0..size.pixels() as usize).map(|pixel| [0, 1, 2].map(|of| channel(pixel, of))).collect();
    Frame::of(size, &pixels)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::driver::TimedPicture;
    use crate::scene::Opened;

    #[test]
    fn reference_is_closer_to_truth_than_measured_pictures() {
        let (scene, size) = (Opened::new("glass").unwrap().scene, Size::new(16, 12).unwrap());
        let reference = Reference::trace(&scene, size, 2, &mut || {}, &CancelToken::default()).unwrap().unwrap();
        let with =
            |quality| TimedPicture::of(&Tracer::new(&scene, size, quality), &CancelToken::default()).unwrap().frame;
        let best = Quality { samples: 12, max_depth: Reference::DEPTH, cutoff: 1e-4, pattern: 9, ..Quality::default() };
        let truth = with(best);
        let error = Difference::of(&reference.picture, &truth).rmse;
        let compared = with(Quality { samples: 2, ..Quality::default() });
        assert!(error < 0.5 * Difference::of(&compared, &truth).rmse, "{error}");
        // Light beyond the default limits is missing from the samples alone.
        let light = |frame: &Frame| frame.pixels().as_flattened().iter().map(|&light| f64::from(light)).sum::<f64>();
        let lost = |frame| (light(&truth) - light(frame)).abs();
        assert!(lost(&reference.picture) < 0.5 * lost(&reference.sampled));
        // Its error is known as far as two patterns can tell.
        assert!((0.5..2.0).contains(&(error / reference.floor)), "{error} and {}", reference.floor);
    }

    #[test]
    fn cancelled_reference_is_none() {
        let (scene, size) = (Opened::new("csg-primer").unwrap().scene, Size::new(24, 18).unwrap());
        let mut begun = 0;
        let cancel = CancelToken::default();
        cancel.cancel();
        assert!(Reference::trace(&scene, size, 2, &mut || begun += 1, &cancel).unwrap().is_none());
        assert_eq!(begun, 1);
    }
}

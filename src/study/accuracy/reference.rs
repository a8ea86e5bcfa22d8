//! What pictures are compared with.

use std::sync::Arc;

use crate::driver::TracedPicture;
use crate::picture::{Colour, Difference, Division, Frame, Quality, Size};
use crate::scene::Scene;
use crate::study::StudyError;
use crate::tracer::Tracer;

/// A picture that is as good as true, and how good that is.
///
/// Without any cutoff a tree of 50 levels may have 2⁵⁰ rays, and many samples of trees even a little smaller take too long.
/// So two pictures are added (as S. Heinrich, *Multilevel Monte Carlo Methods*, 2001, and M. B. Giles, 2008): one of very many
/// samples at the default limits; and what lies beyond these limits, as the difference of two pictures of a few samples, the
/// same ones. Both are means over two patterns of samples, of which no measured picture has one.
#[derive(Clone, Debug)]
pub struct Reference {
    /// The picture, of a tree of [`Reference::DEPTH`] levels and a cutoff of [`Reference::CUTOFF`].
    pub picture: Frame,
    /// The same at the default depth and cutoff: what samples alone come near.
    pub sampled: Frame,
    /// The error of [`Reference::picture`], half of what its two patterns are apart: a root of a mean square in linear light.
    /// No error below it is told from none.
    pub floor: f64,
}

/// Of the reference; those of what is measured are others.
const PATTERNS: [u32; 2] = [1, 2];

impl Reference {
    /// The limit of its tree of rays.
    pub const DEPTH: u32 = 50;
    /// What its rays that are not followed count at most: less than can be seen by any other error here.
    pub const CUTOFF: f64 = 1e-5;
    /// Pictures that are traced for it.
    pub const STEPS: usize = 3 * PATTERNS.len();

    /// Traces it on all cores, with 18 times as many samples as `samples` × `samples` a pixel, and tells `begin` of each of
    /// its pictures. `None` if it `is_over` before.
    ///
    /// # Errors
    /// A sentence, if a thread could not be started, or failed.
    pub fn trace(
        scene: &Scene,
        size: Size,
        samples: u32,
        begin: &mut dyn FnMut(),
        is_over: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Self>, StudyError> {
        let usual = Quality::default();
        let many = (3 * samples).min(Quality::MOST_SAMPLES);
        // A single sample would lie in the middle of its pixel, whatever the pattern.
        let few = (samples / 2).max(2);
        let (mut sampled, mut pictures) = (Vec::new(), Vec::new());
        for pattern in PATTERNS {
            let mut trace = |samples, max_depth, cutoff| {
                begin();
                let quality = Quality { samples, max_depth, cutoff, pattern, ..usual };
                let tracer = Arc::new(Tracer::new(scene, size, quality));
                let whole = TracedPicture::unless(&tracer, Division::new(size.pixels(), 16), &|_| {}, is_over)
                    .map_err(StudyError::run)?;
                Ok::<_, StudyError>(whole.map(|whole| whole.pixels))
            };
            let Some(main) = trace(many, usual.max_depth, usual.cutoff)? else { return Ok(None) };
            let Some(short) = trace(few, usual.max_depth, usual.cutoff)? else { return Ok(None) };
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

/// The sum of pictures, each so many times.
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
    fn a_reference_is_nearer_to_the_truth_than_what_is_compared_with_it() {
        let (scene, size) = (Opened::new("glass").unwrap().scene, Size::new(16, 12).unwrap());
        let reference = Reference::trace(&scene, size, 2, &mut || {}, &|| false).unwrap().unwrap();
        let with = |quality| TimedPicture::of(&Tracer::new(&scene, size, quality), &|| false).unwrap().frame;
        let best = Quality { samples: 12, max_depth: Reference::DEPTH, cutoff: 1e-4, pattern: 9, ..Quality::default() };
        let truth = with(best);
        let error = Difference::of(&reference.picture, &truth).rmse;
        let compared = with(Quality { samples: 2, ..Quality::default() });
        assert!(error < 0.5 * Difference::of(&compared, &truth).rmse, "{error}");
        // What lies beyond the default limits is light that the samples alone have lost.
        let light = |frame: &Frame| frame.pixels().as_flattened().iter().map(|&light| f64::from(light)).sum::<f64>();
        let lost = |frame| (light(&truth) - light(frame)).abs();
        assert!(lost(&reference.picture) < 0.5 * lost(&reference.sampled));
        // Its error is known as far as two patterns can tell.
        assert!((0.5..2.0).contains(&(error / reference.floor)), "{error} and {}", reference.floor);
    }

    #[test]
    fn who_no_longer_wants_it_gets_none() {
        let (scene, size) = (Opened::new("csg-primer").unwrap().scene, Size::new(24, 18).unwrap());
        let mut begun = 0;
        assert!(Reference::trace(&scene, size, 2, &mut || begun += 1, &|| true).unwrap().is_none());
        assert_eq!(begun, 1);
    }
}

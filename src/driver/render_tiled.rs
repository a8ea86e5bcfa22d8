//! Traces a picture of any size on all cores, without ever holding all of it in linear light.

use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::error::ThreadError;
use super::{TracePixels, TracedPicture};
use crate::cancel::CancelToken;
use crate::picture::{Colour, Coverage, Division, srgb8};
use crate::tracer::{Scratch, Tracer};

/// Pixels in a strip; strips are traced one after the other. Enough to keep all cores busy, and 12 MB in linear light.
const STRIP_PIXELS: u32 = 1 << 20;

/// Pixels in an atom of a strip.
const ATOM_PIXELS: u32 = 256;

/// Traces a picture. Returns its pixels in sRGB, three bytes each, or four with alpha if it is `transparent` where no
/// solid is; `None` if cancelled before the end. Tells `done` from time to time the part that is traced, 0 to 1.
///
/// # Errors
/// If a thread cannot be started, or panics.
pub fn trace_strips(
    tracer: &Arc<Tracer>,
    transparent: bool,
    done: &(dyn Fn(f64) + Sync),
    cancel: &CancelToken,
) -> Result<Option<Vec<u8>>, ThreadError> {
    let pixels = tracer.size().pixels();
    let mut bytes = Vec::with_capacity(if transparent { 4 } else { 3 } * pixels as usize);
    let traced = AtomicU64::new(0);
    for start in (0..pixels).step_by(STRIP_PIXELS as usize) {
        let strip_pixels = STRIP_PIXELS.min(pixels - start);
        let division = Division::new(strip_pixels, ATOM_PIXELS);
        let coverage = transparent.then(|| Arc::new(Coverage::new(strip_pixels)));
        let (tracer, its_coverage) = (Arc::clone(tracer), coverage.clone());
        let trace = move |within: Range<u32>, scratch: &mut Scratch, out: &mut Vec<Colour>| {
            let pixels = start + within.start..start + within.end;
            match &its_coverage {
                None => tracer.trace(pixels, scratch, out),
                Some(coverage) => {
                    tracer.trace_transparent(pixels, scratch, out, |pixel, share| coverage.set(pixel - start, share));
                }
            }
        };
        let more = |atoms: u32| {
            let more = u64::from(atoms) * u64::from(ATOM_PIXELS);
            let sum = traced.fetch_add(more, Ordering::Relaxed) + more;
            // The last piece may be shorter.
            done((sum as f64 / f64::from(pixels)).min(1.0));
        };
        let trace: &TracePixels = &trace;
        let Some(strip) = TracedPicture::trace(division, trace, &more, cancel)? else { return Ok(None) };
        match coverage {
            None => bytes.extend(strip.pixels.into_iter().flat_map(srgb8)),
            Some(coverage) => bytes.extend(coverage.to_srgba8(&strip.pixels)),
        }
    }
    Ok(Some(bytes))
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use super::*;
    use crate::picture::{Frame, Quality, Size};
    use crate::scene::{Scene, built_in};

    fn tracer(size: Size) -> Arc<Tracer> {
        let scene = Scene::parse(built_in("csg-primer").expect("it is built in")).expect("a scene");
        Arc::new(Tracer::new(&scene, size, Quality::default()))
    }

    #[test]
    fn strips_make_the_same_picture_as_one_trace() {
        // A little more than one strip.
        let size = Size::new(1031, 1019).unwrap();
        let tracer = tracer(size);
        let told = Mutex::new(Vec::new());
        let strips = trace_strips(&tracer, false, &|part| told.lock().unwrap().push(part), &CancelToken::default());
        let strips = strips.unwrap().unwrap();
        let whole = TracedPicture::of(&tracer, Division::new(size.pixels(), 50), &|_| {}).unwrap();
        assert!(strips == Frame::of(size, &whole.pixels).to_srgb8());
        let told = told.into_inner().unwrap();
        assert!(told.iter().all(|part| (0.0..=1.0).contains(part)) && told.contains(&1.0), "{told:?}");
        // The scene covers the whole picture with solids or not; where it does, the colours are the same.
        let with_alpha = trace_strips(&tracer, true, &|_| {}, &CancelToken::default()).unwrap().unwrap();
        assert_eq!(with_alpha.len(), 4 * size.pixels() as usize);
        let opaque = with_alpha.chunks(4).zip(strips.chunks(3)).filter(|(pixel, _)| pixel[3] == 255);
        assert!(opaque.clone().count() > 100_000 && opaque.clone().all(|(pixel, strip)| pixel[..3] == *strip));
    }

    #[test]
    fn cancelled_trace_returns_nothing() {
        let (tracer, cancel) = (tracer(Size::new(300, 300).unwrap()), CancelToken::default());
        cancel.cancel();
        assert_eq!(trace_strips(&tracer, false, &|_| {}, &cancel).unwrap(), None);
    }
}

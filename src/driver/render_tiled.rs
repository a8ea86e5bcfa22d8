//! A picture of any size, on all cores, without ever holding all of it in linear light.

use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::{TracePixels, TracedPicture};
use crate::picture::{Colour, Division, srgb8};
use crate::tracer::{Scratch, Tracer};

/// So many pixels are traced one strip after the other: enough to keep all cores busy, and 12 MB in linear light.
const STRIP: u32 = 1 << 20;

/// Pixels that are traced together.
const PIECE: u32 = 256;

/// Traces a picture: its pixels as they are saved, three bytes each. `done` is told from time to time what part of it is
/// traced, 0 to 1; `None` if it `is_over` before.
///
/// # Errors
/// A sentence, if a thread could not be started, or failed.
pub fn trace_strips(
    tracer: &Arc<Tracer>,
    done: &(dyn Fn(f64) + Sync),
    is_over: &(dyn Fn() -> bool + Sync),
) -> Result<Option<Vec<u8>>, String> {
    let pixels = tracer.size().pixels();
    let mut rgb = Vec::with_capacity(3 * pixels as usize);
    let traced = AtomicU64::new(0);
    for start in (0..pixels).step_by(STRIP as usize) {
        let division = Division::new(STRIP.min(pixels - start), PIECE);
        let tracer = Arc::clone(tracer);
        let trace = move |within: Range<u32>, scratch: &mut Scratch, out: &mut Vec<Colour>| {
            tracer.trace(start + within.start..start + within.end, scratch, out);
        };
        let more = |atoms: u32| {
            let more = u64::from(atoms) * u64::from(PIECE);
            let sum = traced.fetch_add(more, Ordering::Relaxed) + more;
            // The last piece may be shorter.
            done((sum as f64 / f64::from(pixels)).min(1.0));
        };
        let trace: &TracePixels = &trace;
        let Some(strip) = TracedPicture::trace(division, trace, &more, is_over)? else { return Ok(None) };
        rgb.extend(strip.pixels.into_iter().flat_map(srgb8));
    }
    Ok(Some(rgb))
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
    fn strips_make_the_picture_that_is_traced_at_once() {
        // A little more than one strip.
        let size = Size::new(1031, 1019).unwrap();
        let tracer = tracer(size);
        let told = Mutex::new(Vec::new());
        let strips = trace_strips(&tracer, &|part| told.lock().unwrap().push(part), &|| false).unwrap().unwrap();
        let whole = TracedPicture::of(&tracer, Division::new(size.pixels(), 50), &|_| {}).unwrap();
        assert!(strips == Frame::of(size, &whole.pixels).to_srgb8());
        let told = told.into_inner().unwrap();
        assert!(told.iter().all(|part| (0.0..=1.0).contains(part)) && told.contains(&1.0), "{told:?}");
    }

    #[test]
    fn what_is_over_comes_to_nothing() {
        let tracer = tracer(Size::new(300, 300).unwrap());
        assert_eq!(trace_strips(&tracer, &|_| {}, &|| true).unwrap(), None);
    }
}

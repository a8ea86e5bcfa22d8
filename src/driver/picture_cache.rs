//! The pictures that were traced last for runs in virtual time.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::error::ThreadError;
use super::render_all::CostedPicture;
use crate::cancel::CancelToken;
use crate::picture::{Quality, Size};
use crate::tracer::Tracer;

/// The pictures that were traced last. A picture depends on the scene, its camera included, the size and the quality,
/// and not on machines, strategy or network, so most runs find theirs here.
#[derive(Debug, Default)]
pub struct PictureCache {
    /// The latest first.
    kept: Mutex<Vec<(Key, Arc<CostedPicture>)>>,
}

/// What a picture depends on.
#[derive(Debug, PartialEq)]
struct Key {
    scene_text: String,
    size: Size,
    quality: Quality,
}

/// Most pixels of all pictures together: 80 MB, or thirteen pictures of 640 × 480. The latest picture is kept even if
/// it is larger.
const MAX_PIXELS: u32 = 4_000_000;

impl PictureCache {
    /// Returns the picture if it is kept. `scene_text` is the text of the scene of `tracer`, which traces the whole
    /// picture.
    pub fn get(&self, scene_text: &str, tracer: &Tracer) -> Option<Arc<CostedPicture>> {
        let mut kept = self.kept();
        let is_it =
            |key: &Key| key.scene_text == scene_text && (key.size, key.quality) == (tracer.size(), tracer.quality());
        let index = kept.iter().position(|(key, _)| is_it(key))?;
        kept[..=index].rotate_right(1);
        Some(Arc::clone(&kept[0].1))
    }

    /// Returns the picture, and traces it on all cores if it is not kept. Tells `done` from time to time how many more
    /// pixels are there. Returns `None` if cancelled before the end.
    ///
    /// # Errors
    /// If a thread cannot be started, or panics.
    pub fn get_or_trace(
        &self,
        scene_text: &str,
        tracer: &Arc<Tracer>,
        done: &(dyn Fn(u32) + Sync),
        cancel: &CancelToken,
    ) -> Result<Option<Arc<CostedPicture>>, ThreadError> {
        if let Some(picture) = self.get(scene_text, tracer) {
            done(tracer.size().pixels());
            return Ok(Some(picture));
        }
        let Some(picture) = CostedPicture::trace(tracer, done, cancel)?.map(Arc::new) else { return Ok(None) };
        let key = Key { scene_text: scene_text.to_owned(), size: tracer.size(), quality: tracer.quality() };
        let mut kept = self.kept();
        // Another job may have traced it meanwhile.
        kept.retain(|(other, _)| *other != key);
        kept.insert(0, (key, Arc::clone(&picture)));
        let mut pixels = 0_u64;
        let fits = kept.iter().take_while(|(key, _)| {
            pixels += u64::from(key.size.pixels());
            pixels <= MAX_PIXELS.into()
        });
        let fitting = fits.count().max(1);
        kept.truncate(fitting);
        Ok(Some(picture))
    }

    /// Takes the lock, also after a panic of another thread: no panic leaves the list half changed.
    fn kept(&self) -> MutexGuard<'_, Vec<(Key, Arc<CostedPicture>)>> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicU32, Ordering};

    use super::*;
    use crate::scene::{Scene, built_in};

    #[test]
    fn keeps_the_latest_pictures_that_fit() {
        let text = built_in("ten-objects").unwrap();
        let scene = Scene::parse(text).unwrap();
        let tracer = |width, samples| {
            let quality = Quality { samples, ..Quality::default() };
            Arc::new(Tracer::new(&scene, Size::new(width, 8).unwrap(), quality))
        };
        let (cache, traced) = (PictureCache::default(), AtomicU32::new(0));
        let get = |text: &str, tracer: &Arc<Tracer>| {
            let done = |more| _ = traced.fetch_add(more, Ordering::Relaxed);
            cache.get_or_trace(text, tracer, &done, &CancelToken::default()).unwrap().unwrap()
        };
        let first = get(text, &tracer(16, 1));
        assert_eq!((first.pixels.len(), first.counts.primary), (128, 128));
        assert!(Arc::ptr_eq(&first, &get(text, &tracer(16, 1))), "traced twice");
        assert_eq!(traced.load(Ordering::Relaxed), 256, "a kept picture counts as done");
        for (text, other) in [("another camera", tracer(16, 1)), (text, tracer(8, 1)), (text, tracer(16, 2))] {
            assert!(cache.get(text, &other).is_none());
            get(text, &other);
        }
        assert!(Arc::ptr_eq(&first, &cache.get(text, &tracer(16, 1)).unwrap()), "small pictures stay");
        let cancelled = CancelToken::default();
        cancelled.cancel();
        assert!(cache.get_or_trace("no picture", &tracer(16, 1), &|_| {}, &cancelled).unwrap().is_none());
    }
}

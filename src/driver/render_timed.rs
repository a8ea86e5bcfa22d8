//! Traces the whole picture on one thread and measures the CPU time.

use std::time::Duration;

use super::meter::Meter;
use crate::cancel::CancelToken;
use crate::picture::Frame;
use crate::tracer::{RayCounts, Scratch, Tracer};

/// Pixels between two looks at the cancel token.
const PIECE_PIXELS: usize = 256;

/// A traced picture with its cost.
#[derive(Clone, Debug)]
pub struct TimedPicture {
    /// The picture.
    pub frame: Frame,
    /// The CPU time of the thread that traced it.
    pub cpu: Duration,
    /// The number of its rays, by kind.
    pub counts: RayCounts,
}

impl TimedPicture {
    /// Traces the picture on this thread. Returns `None` if cancelled before the end.
    pub fn of(tracer: &Tracer, cancel: &CancelToken) -> Option<Self> {
        let (mut frame, mut scratch, mut pixels) = (Frame::new(tracer.size()), Scratch::default(), Vec::new());
        let mut meter = Meter::new();
        let all = 0..tracer.size().pixels();
        for start in all.clone().step_by(PIECE_PIXELS) {
            if cancel.is_cancelled() {
                return None;
            }
            tracer.trace(start..all.end.min(start + PIECE_PIXELS as u32), &mut scratch, &mut pixels);
        }
        let cpu = meter.lap();
        frame.place(all, &pixels);
        Some(Self { frame, cpu, counts: scratch.rays })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::{Quality, Size};
    use crate::scene::{Scene, built_in};

    #[test]
    fn returns_the_picture_or_nothing_if_cancelled() {
        let scene = Scene::parse(built_in("ten-objects").unwrap()).unwrap();
        let tracer = Tracer::new(&scene, Size::new(30, 20).unwrap(), Quality::default());
        let (mut scratch, mut pixels) = (Scratch::default(), Vec::new());
        tracer.trace(0..600, &mut scratch, &mut pixels);
        let found = TimedPicture::of(&tracer, &CancelToken::default()).unwrap();
        assert_eq!((found.frame.pixels(), found.counts), (&pixels[..], scratch.rays));
        assert!(found.cpu > Duration::ZERO);
        let cancel = CancelToken::default();
        cancel.cancel();
        assert!(TimedPicture::of(&tracer, &cancel).is_none());
    }
}

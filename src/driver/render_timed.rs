//! The whole picture on one thread, and what that takes.

use std::time::Duration;

use super::meter::Meter;
use crate::picture::Frame;
use crate::tracer::{RayCounts, Scratch, Tracer};

/// Whether it is over is asked after at most this many pixels.
const PIECE: usize = 256;

/// A picture that is traced, and what that took.
#[derive(Clone, Debug)]
pub struct TimedPicture {
    /// The picture.
    pub frame: Frame,
    /// The CPU time of the thread that traced it.
    pub cpu: Duration,
    /// All its rays.
    pub counts: RayCounts,
}

impl TimedPicture {
    /// Traces the picture on this thread. `None` if it `is_over` before.
    pub fn of(tracer: &Tracer, is_over: &dyn Fn() -> bool) -> Option<Self> {
        let (mut frame, mut scratch, mut pixels) = (Frame::new(tracer.size()), Scratch::default(), Vec::new());
        let mut meter = Meter::new();
        let all = 0..tracer.size().pixels();
        for start in all.clone().step_by(PIECE) {
            if is_over() {
                return None;
            }
            tracer.trace(start..all.end.min(start + PIECE as u32), &mut scratch, &mut pixels);
        }
        let cpu = meter.lap();
        frame.place(all, &pixels);
        Some(Self { frame, cpu, counts: scratch.rays })
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;
    use crate::picture::{Quality, Size};
    use crate::scene::{Scene, built_in};

    #[test]
    fn it_is_the_picture_or_nothing() {
        let scene = Scene::parse(built_in("ten-objects").unwrap()).unwrap();
        let tracer = Tracer::new(&scene, Size::new(30, 20).unwrap(), Quality::default());
        let (mut scratch, mut pixels) = (Scratch::default(), Vec::new());
        tracer.trace(0..600, &mut scratch, &mut pixels);
        let found = TimedPicture::of(&tracer, &|| false).unwrap();
        assert_eq!((found.frame.pixels(), found.counts), (&pixels[..], scratch.rays));
        assert!(found.cpu > Duration::ZERO);
        let asked = Cell::new(0);
        let is_over = || asked.replace(asked.get() + 1) == 2;
        assert!(TimedPicture::of(&tracer, &is_over).is_none());
    }
}

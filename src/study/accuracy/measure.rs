//! Measures the cost of qualities and the error of their pictures.

use super::Reference;
use crate::cancel::CancelToken;
use crate::driver::TimedPicture;
use crate::picture::{Difference, Frame, Quality, Size};
use crate::scene::Scene;
use crate::study::median;
use crate::tracer::Tracer;

/// A quality with its cost and its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// The knobs.
    pub quality: Quality,
    /// CPU time on one thread in seconds: the median of the turns so far.
    pub cpu_s: f64,
    /// Rays of all kinds.
    pub rays: u64,
    /// Difference of its picture from the reference.
    pub difference: Difference,
}

impl Point {
    /// Returns the error: [`Difference::rmse`].
    pub fn rmse(&self) -> f64 {
        self.difference.rmse
    }
}

/// How often a short measurement is repeated.
const TURNS: usize = 3;

/// CPU time in seconds above which noise does not matter and a measurement is not repeated.
const LONG_S: f64 = 0.2;

/// Measures the qualities on this thread. They take turns, so that a disturbance of the computer affects all alike.
/// `each` gets the index of each point with its picture as soon as it is measured, and again when its time is more
/// exact. `None` if `is_over` before the end.
pub fn measure(
    scene: &Scene,
    reference: &Reference,
    qualities: &[Quality],
    cancel: &CancelToken,
    each: &mut dyn FnMut(usize, &Point, &Frame),
) -> Option<Vec<Point>> {
    let size: Size = reference.picture.size();
    let mut points: Vec<Point> = Vec::new();
    let mut times: Vec<Vec<f64>> = vec![Vec::new(); qualities.len()];
    for turn in 0..TURNS {
        for (place, &quality) in qualities.iter().enumerate() {
            if times[place].iter().any(|&time| time > LONG_S) {
                continue;
            }
            let found = TimedPicture::of(&Tracer::new(scene, size, quality), cancel)?;
            times[place].push(found.cpu.as_secs_f64());
            if turn == 0 {
                let difference = Difference::of(&found.frame, &reference.picture);
                points.push(Point { quality, cpu_s: 0.0, rays: found.counts.total(), difference });
            }
            points[place].cpu_s = median(&mut times[place]);
            each(place, &points[place], &found.frame);
        }
    }
    Some(points)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Opened;

    fn subject() -> (Scene, Reference) {
        let (scene, size) = (Opened::new("csg-primer").unwrap().scene, Size::new(24, 18).unwrap());
        let reference = Reference::trace(&scene, size, 2, &mut || {}, &CancelToken::default()).unwrap().unwrap();
        (scene, reference)
    }

    #[test]
    fn points_are_reported_in_turns() {
        let (scene, reference) = subject();
        let qualities = [1, 2, 4].map(|samples| Quality { samples, ..Quality::default() });
        let mut told = Vec::new();
        let points = measure(&scene, &reference, &qualities, &CancelToken::default(), &mut |place, point, frame| {
            assert_eq!((point.quality, frame.size()), (qualities[place], reference.picture.size()));
            assert!(point.cpu_s > 0.0 && point.difference == Difference::of(frame, &reference.picture));
            told.push(place);
        });
        assert_eq!(told, [0, 1, 2, 0, 1, 2, 0, 1, 2]);
        let points = points.unwrap();
        assert!(points.is_sorted_by(|a, b| a.rays < b.rays && a.rmse() > b.rmse()), "{points:?}");
    }

    #[test]
    fn measurement_stops_when_cancelled() {
        let (scene, reference) = subject();
        let (mut told, cancel) = (0, CancelToken::default());
        let qualities = [Quality::default(); 3];
        let points = measure(&scene, &reference, &qualities, &cancel, &mut |_, _, _| {
            told += 1;
            if told == 2 {
                cancel.cancel();
            }
        });
        assert!(points.is_none() && told == 2);
    }
}

//! Results of the measurement of speed and accuracy.

use std::sync::Arc;
use std::time::Duration;

use crate::gui::session::{Finding, Prepared};
use crate::language::{Language, say};
use crate::picture::{Frame, Quality, Size};
use crate::scene::Opened;
use crate::study::accuracy::{Point, Reference, best_within, combinations, fastest_within, front};
use crate::tracer::SceneStats;
use crate::view::Tradeoff;

/// Results for one scene so far.
pub struct AccuracyFindings {
    /// Number of the job.
    pub job: u64,
    opened: Arc<Opened>,
    /// Size of the run's picture, to which times are scaled.
    pub whole: Size,
    /// Qualities to measure; the present one comes first.
    pub qualities: Vec<Quality>,
    /// Statistics of the compiled scene, and the number of rays on each level.
    pub needs: Option<(SceneStats, Vec<u64>)>,
    /// Number of the reference's pictures that have been begun.
    begun: usize,
    /// The reference picture.
    pub reference: Option<Reference>,
    /// Measured points, with the times of the small picture.
    points: Vec<Point>,
    /// Picture of each point.
    pub frames: Vec<Frame>,
    /// Number of repeated measurements.
    again: usize,
    /// Result at the end; a sentence, if the measurement failed.
    pub over: Option<Result<(), String>>,
}

/// How a quality is chosen. Times are CPU seconds on one core for the run's picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Choice {
    /// The point at this index.
    Point(usize),
    /// The fastest point with at most this error.
    Error(f64),
    /// The point of the least error with at most this time.
    Time(f64),
}

impl AccuracyFindings {
    /// Index of the present quality.
    pub const PRESENT: usize = 0;

    /// Creates empty results; the caller starts the job for [`AccuracyFindings::qualities`].
    pub fn new(opened: &Arc<Opened>, whole: Size, present: Quality) -> Self {
        let mut qualities = combinations();
        qualities.retain(|quality| *quality != present);
        qualities.insert(Self::PRESENT, present);
        Self {
            job: 0,
            opened: Arc::clone(opened),
            whole,
            qualities,
            needs: None,
            begun: 0,
            reference: None,
            points: Vec::new(),
            frames: Vec::new(),
            again: 0,
            over: None,
        }
    }

    /// Whether the results belong to this scene, size and quality.
    pub fn are_of(&self, prepared: &Prepared) -> bool {
        let present = self.qualities[Self::PRESENT];
        Arc::ptr_eq(&self.opened, &prepared.opened) && (self.whole, present) == (prepared.size, prepared.quality)
    }

    /// Adds a part of the results.
    pub fn take(&mut self, finding: Finding) {
        match finding {
            Finding::Needs(compiled, levels) => self.needs = Some((compiled, levels)),
            Finding::Begun(pictures) => self.begun = pictures,
            Finding::Reference(reference) => self.reference = Some(reference),
            Finding::Point(_, point, Some(frame)) => {
                self.points.push(point);
                self.frames.push(frame);
            }
            Finding::Point(index, point, None) => {
                self.again += 1;
                if let Some(old) = self.points.get_mut(index) {
                    *old = point;
                }
            }
            Finding::Over(result) => self.over = Some(result),
        }
    }

    /// Returns the number of measured points.
    pub fn count(&self) -> usize {
        self.points.len()
    }

    /// Returns the point at an index, with its time scaled to the run's picture.
    pub fn point(&self, index: usize) -> Option<Point> {
        let point = self.points.get(index)?;
        Some(Point { cpu_s: point.cpu_s * self.scale(), ..*point })
    }

    /// Returns the time of the point at an index, scaled to the run's picture.
    pub fn time(&self, index: usize) -> Duration {
        Duration::try_from_secs_f64(self.point(index).map_or(0.0, |point| point.cpu_s)).unwrap_or_default()
    }

    /// Returns the index of the chosen point, if there is one.
    pub fn chosen(&self, choice: Choice) -> Option<usize> {
        let point = match choice {
            Choice::Point(index) => return Some(index).filter(|index| *index < self.points.len()),
            Choice::Error(error) => fastest_within(&self.points, error)?,
            Choice::Time(time) => best_within(&self.points, time / self.scale())?,
        };
        self.index_of(point)
    }

    /// Returns the Pareto front, the fastest point first, with times scaled to the run's picture.
    pub fn front(&self) -> Vec<Point> {
        self.front_indices().into_iter().filter_map(|index| self.point(index)).collect()
    }

    /// Returns the data of the chart.
    pub fn tradeoff(&self, chosen: Option<usize>, language: Language) -> Tradeoff {
        let shown = (0..self.count()).filter_map(|index| self.point(index));
        let (width, height) = (self.whole.width(), self.whole.height());
        Tradeoff {
            points: shown.map(|point| (point.cpu_s, point.rmse())).collect(),
            front: self.front_indices(),
            floor: self.reference.as_ref().map_or(0.0, |reference| reference.floor),
            present: Some(Self::PRESENT),
            chosen,
            time: say!(
                language,
                "CPU seconds on one core, for {width} × {height} pixels",
                "segundos de CPU num núcleo, para {width} × {height} pixels"
            ),
        }
    }

    /// Describes the progress of the measurement.
    pub fn progress(&self, language: Language) -> String {
        let (points, all) = (self.count(), self.qualities.len());
        let (begun, steps) = (self.begun.max(1), Reference::STEPS);
        match (&self.over, &self.reference) {
            (Some(Ok(())), _) => say!(language, "{points} points", "{points} pontos"),
            (Some(Err(why)), _) => {
                say!(language, "The measurement has failed: {why}", "A medição falhou: {why}")
            }
            (None, None) => {
                say!(
                    language,
                    "Tracing the reference: {begun} of {steps}",
                    "Calculando a referência: {begun} de {steps}"
                )
            }
            (None, Some(_)) if points < all => say!(language, "{points} of {all} points", "{points} de {all} pontos"),
            (None, Some(_)) => say!(
                language,
                "{points} points; measuring their times again",
                "{points} pontos; medindo seus tempos de novo"
            ),
        }
    }

    /// Returns the share that is done, 0 to 1. The reference counts half.
    pub fn share(&self) -> f32 {
        let all = self.qualities.len() as f32;
        let reference = self.begun.saturating_sub(1) as f32 / Reference::STEPS as f32;
        let reference = if self.reference.is_some() { 1.0 } else { reference };
        let points = 0.9 * self.points.len() as f32 / all + 0.05 * self.again as f32 / all;
        if self.over.is_some() { 1.0 } else { 0.5 * reference + 0.5 * points }
    }

    fn front_indices(&self) -> Vec<usize> {
        front(&self.points).into_iter().filter_map(|point| self.index_of(point)).collect()
    }

    fn index_of(&self, point: &Point) -> Option<usize> {
        self.points.iter().position(|other| other.quality == point.quality)
    }

    /// Returns pixels of the run's picture / pixels of the measured pictures.
    fn scale(&self) -> f64 {
        let measured = self.reference.as_ref().map_or(self.whole, |reference| reference.picture.size());
        f64::from(self.whole.pixels()) / f64::from(measured.pixels())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Difference;

    fn size(width: u32, height: u32) -> Size {
        Size::new(width, height).unwrap()
    }

    /// Results for a picture of 64 × 48 pixels, measured at a quarter of its pixels: seconds and error of the first
    /// points.
    fn findings(points: &[(f64, f64)]) -> AccuracyFindings {
        let opened = Arc::new(Opened::new("csg-primer").unwrap());
        let mut findings = AccuracyFindings::new(&opened, size(64, 48), Quality { samples: 7, ..Quality::default() });
        let frame = Frame::new(size(32, 24));
        findings.take(Finding::Reference(Reference { picture: frame.clone(), sampled: frame.clone(), floor: 0.001 }));
        for (index, &(cpu_s, rmse)) in points.iter().enumerate() {
            let difference = Difference { rmse, wrong_pixels: 0, worst_ssim: 1.0 };
            let point = Point { quality: findings.qualities[index], cpu_s, rays: 1, difference };
            findings.take(Finding::Point(index, point, Some(frame.clone())));
        }
        findings
    }

    #[test]
    fn present_quality_is_measured_first_and_once() {
        let found = findings(&[]);
        assert_eq!(found.qualities[AccuracyFindings::PRESENT].samples, 7);
        for (index, quality) in found.qualities.iter().enumerate() {
            assert!(!found.qualities[..index].contains(quality), "{quality:?}");
        }
    }

    #[test]
    fn times_and_limits_are_scaled_to_the_runs_picture() {
        let language = Language::English;
        let found = findings(&[(1.0, 0.1), (2.0, 0.05), (3.0, 0.2)]);
        assert_eq!(found.time(1), Duration::from_secs(8));
        assert_eq!(found.tradeoff(None, language).points, [(4.0, 0.1), (8.0, 0.05), (12.0, 0.2)]);
        assert_eq!(found.tradeoff(None, language).front, [0, 1]);
        let chosen = [Choice::Time(3.9), Choice::Time(4.1), Choice::Time(100.0)].map(|choice| found.chosen(choice));
        assert_eq!(chosen, [None, Some(0), Some(1)]);
        let chosen = [Choice::Error(0.04), Choice::Error(0.06), Choice::Error(0.3)].map(|choice| found.chosen(choice));
        assert_eq!(chosen, [None, Some(1), Some(0)]);
        assert_eq!([Choice::Point(2), Choice::Point(3)].map(|choice| found.chosen(choice)), [Some(2), None]);
    }

    #[test]
    fn progress_only_grows() {
        let language = Language::English;
        let opened = Arc::new(Opened::new("csg-primer").unwrap());
        let mut found = AccuracyFindings::new(&opened, size(64, 48), Quality::default());
        found.take(Finding::Begun(2));
        assert_eq!(found.progress(language), "Tracing the reference: 2 of 6");
        let mut found = findings(&[(1.0, 0.1)]);
        assert_eq!(found.progress(language), format!("1 of {} points", found.qualities.len()));
        let before = found.share();
        let known = found.point(0).unwrap();
        found.take(Finding::Point(0, Point { cpu_s: 0.5, ..known }, None));
        assert!(before >= 0.5 && found.share() > before && found.time(0) == Duration::from_secs(2));
        found.take(Finding::Over(Err("no memory".into())));
        assert_eq!((found.progress(language), found.share()), ("The measurement has failed: no memory".into(), 1.0));
    }
}

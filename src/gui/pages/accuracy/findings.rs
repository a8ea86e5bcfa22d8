//! What has been found out about the scene at hand so far.

use std::sync::Arc;
use std::time::Duration;

use crate::gui::session::{Finding, Prepared};
use crate::language::{Language, say};
use crate::picture::{Frame, Quality, Size};
use crate::scene::Opened;
use crate::study::accuracy::{Point, Reference, best_within, combinations, fastest_within, front};
use crate::tracer::SceneStats;
use crate::view::Tradeoff;

/// What has been found out about one scene so far.
pub struct AccuracyFindings {
    /// The job that finds it out.
    pub job: u64,
    opened: Arc<Opened>,
    /// The size of the picture that times are told for.
    pub whole: Size,
    /// What is measured; what is set comes first.
    pub qualities: Vec<Quality>,
    /// What the scene needs, and how many rays there are on each level.
    pub needs: Option<(SceneStats, Vec<u64>)>,
    /// Pictures of the reference that have been begun.
    begun: usize,
    /// What pictures are compared with.
    pub reference: Option<Reference>,
    points: Vec<Point>,
    /// The picture of each point.
    pub frames: Vec<Frame>,
    /// Measurements of points that are known already.
    again: usize,
    /// Once nothing more comes: a sentence, if that was too soon.
    pub over: Option<Result<(), String>>,
}

/// How a quality is chosen. Times are in seconds, of one core, for the whole picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Choice {
    /// The one at this place.
    Place(usize),
    /// The fastest with an error of so much at most.
    Error(f64),
    /// The best that takes so long at most.
    Time(f64),
}

impl AccuracyFindings {
    /// The place of what is set.
    pub const PRESENT: usize = 0;

    /// Nothing yet; a job is to be started for [`AccuracyFindings::qualities`].
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

    /// Whether they are, or will be, about this.
    pub fn are_of(&self, prepared: &Prepared) -> bool {
        let present = self.qualities[Self::PRESENT];
        Arc::ptr_eq(&self.opened, &prepared.opened) && (self.whole, present) == (prepared.size, prepared.quality)
    }

    /// Takes in what the job tells.
    pub fn take(&mut self, finding: Finding) {
        match finding {
            Finding::Needs(compiled, levels) => self.needs = Some((compiled, levels)),
            Finding::Begun(pictures) => self.begun = pictures,
            Finding::Reference(reference) => self.reference = Some(reference),
            Finding::Point(_, point, Some(frame)) => {
                self.points.push(point);
                self.frames.push(frame);
            }
            Finding::Point(place, point, None) => {
                self.again += 1;
                if let Some(known) = self.points.get_mut(place) {
                    *known = point;
                }
            }
            Finding::Over(how) => self.over = Some(how),
        }
    }

    /// How many points are measured.
    pub fn count(&self) -> usize {
        self.points.len()
    }

    /// The point at a place, its time for the whole picture.
    pub fn point(&self, place: usize) -> Option<Point> {
        let point = self.points.get(place)?;
        Some(Point { cpu_s: point.cpu_s * self.scale(), ..*point })
    }

    /// The time of the point at a place, for the whole picture.
    pub fn time(&self, place: usize) -> Duration {
        Duration::try_from_secs_f64(self.point(place).map_or(0.0, |point| point.cpu_s)).unwrap_or_default()
    }

    /// The place of what is chosen; `None` if there is no such point.
    pub fn chosen(&self, choice: Choice) -> Option<usize> {
        let point = match choice {
            Choice::Place(place) => return Some(place).filter(|place| *place < self.points.len()),
            Choice::Error(error) => fastest_within(&self.points, error)?,
            Choice::Time(time) => best_within(&self.points, time / self.scale())?,
        };
        self.place_of(point)
    }

    /// The points that are the best for their time, the fastest first, with their times for the whole picture.
    pub fn front(&self) -> Vec<Point> {
        self.front_places().into_iter().filter_map(|place| self.point(place)).collect()
    }

    /// What a chart shows of it.
    pub fn tradeoff(&self, chosen: Option<usize>, language: Language) -> Tradeoff {
        let shown = (0..self.count()).filter_map(|place| self.point(place));
        let (width, height) = (self.whole.width(), self.whole.height());
        Tradeoff {
            points: shown.map(|point| (point.cpu_s, point.rmse())).collect(),
            front: self.front_places(),
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

    /// How far the measurement is, in words.
    pub fn progress(&self, language: Language) -> String {
        let (points, all) = (self.count(), self.qualities.len());
        let (begun, steps) = (self.begun.max(1), Reference::STEPS);
        match (&self.over, &self.reference) {
            (Some(Ok(())), _) => say!(language, "{points} points", "{points} pontos"),
            (Some(Err(why)), _) => {
                say!(language, "This could not be measured: {why}", "Isto não pôde ser medido: {why}")
            }
            (None, None) => {
                say!(
                    language,
                    "What pictures are compared with: {begun} of {steps}",
                    "Imagem de comparação: {begun} de {steps}"
                )
            }
            (None, Some(_)) if points < all => say!(language, "{points} of {all} points", "{points} de {all} pontos"),
            (None, Some(_)) => say!(
                language,
                "{points} points; their times are measured once more",
                "{points} pontos; seus tempos são medidos mais uma vez"
            ),
        }
    }

    /// How far it is, from 0 to 1. Most of the time goes into the reference.
    pub fn share(&self) -> f32 {
        let all = self.qualities.len() as f32;
        let reference = self.begun.saturating_sub(1) as f32 / Reference::STEPS as f32;
        let reference = if self.reference.is_some() { 1.0 } else { reference };
        let points = 0.9 * self.points.len() as f32 / all + 0.05 * self.again as f32 / all;
        if self.over.is_some() { 1.0 } else { 0.5 * reference + 0.5 * points }
    }

    fn front_places(&self) -> Vec<usize> {
        front(&self.points).into_iter().filter_map(|point| self.place_of(point)).collect()
    }

    fn place_of(&self, point: &Point) -> Option<usize> {
        self.points.iter().position(|other| other.quality == point.quality)
    }

    /// How many times as many pixels the whole picture has as those that are measured.
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

    /// Qualities of a picture of 64 × 48 pixels, of which the first took these seconds and have these errors in a quarter
    /// of it.
    fn findings(points: &[(f64, f64)]) -> AccuracyFindings {
        let opened = Arc::new(Opened::new("csg-primer").unwrap());
        let mut findings = AccuracyFindings::new(&opened, size(64, 48), Quality { samples: 7, ..Quality::default() });
        let frame = Frame::new(size(32, 24));
        findings.take(Finding::Reference(Reference { picture: frame.clone(), sampled: frame.clone(), floor: 0.001 }));
        for (place, &(cpu_s, rmse)) in points.iter().enumerate() {
            let difference = Difference { rmse, wrong_pixels: 0, worst_ssim: 1.0 };
            let point = Point { quality: findings.qualities[place], cpu_s, rays: 1, difference };
            findings.take(Finding::Point(place, point, Some(frame.clone())));
        }
        findings
    }

    #[test]
    fn what_is_set_is_measured_first_and_once() {
        let found = findings(&[]);
        assert_eq!(found.qualities[AccuracyFindings::PRESENT].samples, 7);
        for (place, quality) in found.qualities.iter().enumerate() {
            assert!(!found.qualities[..place].contains(quality), "{quality:?}");
        }
    }

    #[test]
    fn times_are_those_of_the_whole_picture_and_limits_too() {
        let language = Language::English;
        let found = findings(&[(1.0, 0.1), (2.0, 0.05), (3.0, 0.2)]);
        assert_eq!(found.time(1), Duration::from_secs(8));
        assert_eq!(found.tradeoff(None, language).points, [(4.0, 0.1), (8.0, 0.05), (12.0, 0.2)]);
        assert_eq!(found.tradeoff(None, language).front, [0, 1]);
        let chosen = [Choice::Time(3.9), Choice::Time(4.1), Choice::Time(100.0)].map(|choice| found.chosen(choice));
        assert_eq!(chosen, [None, Some(0), Some(1)]);
        let chosen = [Choice::Error(0.04), Choice::Error(0.06), Choice::Error(0.3)].map(|choice| found.chosen(choice));
        assert_eq!(chosen, [None, Some(1), Some(0)]);
        assert_eq!([Choice::Place(2), Choice::Place(3)].map(|choice| found.chosen(choice)), [Some(2), None]);
    }

    #[test]
    fn how_far_it_is_only_grows_and_is_told() {
        let language = Language::English;
        let opened = Arc::new(Opened::new("csg-primer").unwrap());
        let mut found = AccuracyFindings::new(&opened, size(64, 48), Quality::default());
        found.take(Finding::Begun(2));
        assert_eq!(found.progress(language), "What pictures are compared with: 2 of 6");
        let mut found = findings(&[(1.0, 0.1)]);
        assert_eq!(found.progress(language), format!("1 of {} points", found.qualities.len()));
        let before = found.share();
        let known = found.point(0).unwrap();
        found.take(Finding::Point(0, Point { cpu_s: 0.5, ..known }, None));
        assert!(before >= 0.5 && found.share() > before && found.time(0) == Duration::from_secs(2));
        found.take(Finding::Over(Err("no memory".into())));
        assert_eq!((found.progress(language), found.share()), ("This could not be measured: no memory".into(), 1.0));
    }
}

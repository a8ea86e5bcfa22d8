//! Executes the runs of a lesson in virtual time.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;

use super::{Lesson, LessonError, RunPlan};
use crate::balance::Rules;
use crate::cancel::CancelToken;
use crate::driver::{CostedPicture, PictureCache};
use crate::picture::Quality;
use crate::runlog::{Header, LinkSettings, RunLog};
use crate::scene::{Opened, built_in};
use crate::sim::{PixelCosts, Trial};
use crate::tracer::Tracer;

/// A finished run of a lesson.
#[derive(Clone)]
pub struct LessonRun {
    /// Its scene.
    pub opened: Arc<Opened>,
    /// The scene, compiled for the size of the picture.
    pub tracer: Arc<Tracer>,
    /// The records of the run.
    pub log: Arc<RunLog>,
}

/// A scene traced at one size.
struct TracedScene {
    opened: Arc<Opened>,
    tracer: Arc<Tracer>,
    picture: Arc<CostedPicture>,
}

impl Lesson {
    /// Executes all runs in virtual time. Takes their pictures from `kept`, or traces them; calls `done` with the
    /// number of pixels that are newly there. Returns `None` if cancelled before the end.
    ///
    /// # Errors
    /// [`LessonError::Scene`] if a scene cannot be opened, [`LessonError::Trace`] if a thread fails.
    pub fn perform(
        &self,
        kept: &PictureCache,
        done: &(dyn Fn(u32) + Sync),
        cancel: &CancelToken,
    ) -> Result<Option<Vec<(String, LessonRun)>>, LessonError> {
        // Runs with the same scene and size share one traced picture.
        let mut pictures: BTreeMap<(&str, u32, u32), TracedScene> = BTreeMap::new();
        let mut performed = Vec::new();
        for (name, plan) in &self.runs {
            let traced = match pictures.entry(plan.picture()) {
                Entry::Occupied(traced) => traced.into_mut(),
                Entry::Vacant(place) => {
                    let Some(traced) = trace(name, plan, &self.directory, (kept, done, cancel))? else {
                        return Ok(None);
                    };
                    place.insert(traced)
                }
            };
            let costs = &traced.picture.costs;
            let log = Arc::new(plan.trial(&traced.opened, costs).run(costs));
            let (opened, tracer) = (Arc::clone(&traced.opened), Arc::clone(&traced.tracer));
            performed.push((name.clone(), LessonRun { opened, tracer, log }));
        }
        Ok(Some(performed))
    }

    /// The number of pixels of the pictures that [`Lesson::perform`] needs.
    pub fn pixels(&self) -> u32 {
        let pictures: BTreeSet<_> = self.runs.values().map(RunPlan::picture).collect();
        pictures.iter().map(|(_, width, height)| width * height).sum()
    }
}

impl RunPlan {
    /// The picture of the run: scene, width and height.
    fn picture(&self) -> (&str, u32, u32) {
        (&self.scene, self.size.width(), self.size.height())
    }

    /// The run, at a pace that gives the planned makespan if the work is shared perfectly.
    fn trial(&self, opened: &Opened, costs: &PixelCosts) -> Trial {
        let plain = Header::plain(self.size, self.atom, self.strategy.clone(), self.speeds.clone());
        // A speed may be 0. If all are 0, the limit keeps the pace finite.
        let own = self.speeds.len() - usize::from(self.spares);
        let power: f64 = self.speeds[..own].iter().sum::<f64>().max(1e-3);
        let pace = costs.whole().as_secs_f64() / (self.lasts.as_secs_f64() * power);
        let mut link = LinkSettings::default();
        link.set_latencies(&self.latencies);
        let header = Header {
            scene: opened.name.clone(),
            scene_text: opened.text.clone(),
            rules: Rules {
                part: self.part.unwrap_or(plain.rules.part),
                batch: Some(Rules::batch_for(self.handling, self.speeds.len())),
                beat: Rules::beat_for(self.handling, self.speeds.len()),
                remedies: self.remedies,
                ..plain.rules
            },
            spares: self.spares,
            pace: pace.clamp(1e-9, 1.0),
            link,
            handling: self.handling,
            ..plain
        };
        Trial::new(header, self.script.clone())
    }
}

/// Traces the picture of the run `name` pixel by pixel.
fn trace(
    name: &str,
    plan: &RunPlan,
    directory: &Path,
    (kept, done, cancel): (&PictureCache, &(dyn Fn(u32) + Sync), &CancelToken),
) -> Result<Option<TracedScene>, LessonError> {
    let is_built_in = built_in(&plan.scene).is_some();
    let path = if is_built_in { plan.scene.clone().into() } else { directory.join(&plan.scene) };
    let opened = Opened::new(path).map_err(|source| LessonError::Scene { run: name.to_owned(), source })?;
    let opened = Arc::new(opened);
    let tracer = Arc::new(Tracer::new(&opened.scene, plan.size, Quality::default()));
    let picture = kept
        .get_or_trace(&opened.text, &tracer, done, cancel)
        .map_err(|source| LessonError::Trace { run: name.to_owned(), source })?;
    Ok(picture.map(|picture| TracedScene { opened, tracer, picture }))
}

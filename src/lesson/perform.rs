//! Runs a lesson's runs.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;

use super::{Lesson, RunPlan};
use crate::balance::Rules;
use crate::cancel::CancelToken;
use crate::driver::TracedPicture;
use crate::picture::Quality;
use crate::runlog::{Header, LinkSettings, RunLog};
use crate::scene::{Opened, built_in};
use crate::sim::{PixelCosts, Trial};
use crate::tracer::Tracer;

/// A run of a lesson that has been run.
#[derive(Clone)]
pub struct LessonRun {
    /// Its scene.
    pub opened: Arc<Opened>,
    /// The scene, compiled for its picture.
    pub tracer: Arc<Tracer>,
    /// All that happened.
    pub log: Arc<RunLog>,
}

/// A scene's picture at a size, and what its pixels cost.
struct TracedPixels {
    opened: Arc<Opened>,
    tracer: Arc<Tracer>,
    costs: PixelCosts,
}

impl Lesson {
    /// Runs all runs in virtual time, and tells `done` how many more pixels are traced. `None` if cancelled before the end.
    ///
    /// # Errors
    /// A sentence that names the run.
    pub fn perform(
        &self,
        done: &(dyn Fn(u32) + Sync),
        cancel: &CancelToken,
    ) -> Result<Option<Vec<(String, LessonRun)>>, String> {
        // Each scene is traced once at each size.
        let mut known: BTreeMap<(&str, u32, u32), TracedPixels> = BTreeMap::new();
        let mut performed = Vec::new();
        for (name, plan) in &self.runs {
            let traced = match known.entry(plan.picture()) {
                Entry::Occupied(traced) => traced.into_mut(),
                Entry::Vacant(place) => {
                    let traced = trace(plan, &self.directory, done, cancel);
                    let Some(traced) = traced.map_err(|why| format!("the run `{name}`: {why}"))? else {
                        return Ok(None);
                    };
                    place.insert(traced)
                }
            };
            let log = Arc::new(plan.trial(&traced.opened, &traced.costs).run(&traced.costs));
            let (opened, tracer) = (Arc::clone(&traced.opened), Arc::clone(&traced.tracer));
            performed.push((name.clone(), LessonRun { opened, tracer, log }));
        }
        Ok(Some(performed))
    }

    /// How many pixels are traced to run all runs.
    pub fn pixels(&self) -> u32 {
        let pictures: BTreeSet<_> = self.runs.values().map(RunPlan::picture).collect();
        pictures.iter().map(|(_, width, height)| width * height).sum()
    }
}

impl RunPlan {
    /// The picture that is to be traced: its scene, width and height.
    fn picture(&self) -> (&str, u32, u32) {
        (&self.scene, self.size.width(), self.size.height())
    }

    /// The run, on machines so fast that it would last as long as planned.
    fn trial(&self, opened: &Opened, costs: &PixelCosts) -> Trial {
        let plain = Header::plain(self.size, self.atom, self.strategy, self.speeds.clone());
        // Some machines may stand still, but not all.
        let own = self.speeds.len() - usize::from(self.spares);
        let power: f64 = self.speeds[..own].iter().sum::<f64>().max(1e-3);
        let pace = costs.whole().as_secs_f64() / (self.lasts.as_secs_f64() * power);
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
            link: LinkSettings { latency: self.latency, ..plain.link },
            handling: self.handling,
            ..plain
        };
        Trial::new(header, self.script.clone())
    }
}

fn trace(
    plan: &RunPlan,
    directory: &Path,
    done: &(dyn Fn(u32) + Sync),
    cancel: &CancelToken,
) -> Result<Option<TracedPixels>, String> {
    let beside = directory.join(&plan.scene);
    let argument =
        if built_in(&plan.scene).is_some() { plan.scene.clone() } else { beside.to_string_lossy().into_owned() };
    let opened = Arc::new(Opened::new(&argument).map_err(|error| error.to_string())?);
    let tracer = Arc::new(Tracer::new(&opened.scene, plan.size, Quality::default()));
    let traced = TracedPicture::by_pixel(&tracer, done, cancel).map_err(|error| error.to_string())?;
    let Some((_, costs)) = traced else { return Ok(None) };
    Ok(Some(TracedPixels { opened, tracer, costs }))
}

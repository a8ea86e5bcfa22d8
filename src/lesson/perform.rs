//! Runs a lesson's runs.

use std::path::Path;
use std::sync::Arc;

use super::{Lesson, Plan};
use crate::balance::Rules;
use crate::driver::Whole;
use crate::picture::{Quality, Size};
use crate::runlog::{Header, Link, RunLog};
use crate::scene::{Opened, built_in};
use crate::sim::{PixelCosts, Trial};
use crate::tracer::Tracer;

/// A run of a lesson that has been run.
#[derive(Clone)]
pub struct Performed {
    /// Its scene.
    pub opened: Arc<Opened>,
    /// The scene, compiled for its picture.
    pub tracer: Arc<Tracer>,
    /// All that happened.
    pub log: Arc<RunLog>,
}

/// A scene's picture at a size, and what its pixels cost.
struct Traced {
    opened: Arc<Opened>,
    tracer: Arc<Tracer>,
    costs: PixelCosts,
}

impl Lesson {
    /// Runs all runs in virtual time. Scenes that are files stand in `directory`; `done` is told how many more pixels are
    /// traced. `None` if it `is_over` before.
    ///
    /// # Errors
    /// A sentence that names the run.
    pub fn perform(
        &self,
        directory: &Path,
        done: &(dyn Fn(u32) + Sync),
        is_over: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Vec<(String, Performed)>>, String> {
        let mut known: Vec<(String, Size, Traced)> = Vec::new();
        let mut performed = Vec::new();
        for (name, plan) in &self.runs {
            let is_it = |(scene, size, _): &&(String, Size, Traced)| (scene, size) == (&plan.scene, &plan.size);
            if known.iter().find(is_it).is_none() {
                let traced = trace(plan, directory, done, is_over).map_err(|why| format!("the run `{name}`: {why}"))?;
                let Some(traced) = traced else { return Ok(None) };
                known.push((plan.scene.clone(), plan.size, traced));
            }
            let Some((.., traced)) = known.iter().find(is_it) else { continue };
            let log = Arc::new(plan.trial(&traced.opened, &traced.costs).run(&traced.costs));
            let (opened, tracer) = (Arc::clone(&traced.opened), Arc::clone(&traced.tracer));
            performed.push((name.clone(), Performed { opened, tracer, log }));
        }
        Ok(Some(performed))
    }

    /// How many pixels are traced to run all runs.
    pub fn pixels(&self) -> u32 {
        let mut known: Vec<(&str, Size)> = self.runs.values().map(|plan| (&*plan.scene, plan.size)).collect();
        known.sort_by_key(|(scene, size)| (*scene, size.width(), size.height()));
        known.dedup();
        known.iter().map(|(_, size)| size.pixels()).sum()
    }
}

impl Plan {
    /// The run, on machines so fast that it would last as long as planned.
    fn trial(&self, opened: &Opened, costs: &PixelCosts) -> Trial {
        let plain = Header::plain(self.size, self.atom, self.strategy, self.speeds.clone());
        // Some machines may stand still, but not all.
        let power: f64 = self.speeds.iter().sum::<f64>().max(1e-3);
        let pace = costs.whole().as_secs_f64() / (self.lasts.as_secs_f64() * power);
        let header = Header {
            scene: opened.name.clone(),
            scene_text: opened.text.clone(),
            rules: Rules {
                part: self.part.unwrap_or(plain.rules.part),
                batch: Some(Rules::batch_for(self.handling, self.speeds.len())),
                ..plain.rules
            },
            pace: pace.clamp(1e-9, 1.0),
            link: Link { latency: self.latency, ..plain.link },
            handling: self.handling,
            ..plain
        };
        Trial::new(header, self.script.clone())
    }
}

fn trace(
    plan: &Plan,
    directory: &Path,
    done: &(dyn Fn(u32) + Sync),
    is_over: &(dyn Fn() -> bool + Sync),
) -> Result<Option<Traced>, String> {
    let beside = directory.join(&plan.scene);
    let argument =
        if built_in(&plan.scene).is_some() { plan.scene.clone() } else { beside.to_string_lossy().into_owned() };
    let opened = Arc::new(Opened::new(&argument).map_err(|error| error.to_string())?);
    let tracer = Arc::new(Tracer::new(&opened.scene, plan.size, Quality::default()));
    let Some((_, costs)) = Whole::by_pixel(&tracer, done, is_over)? else { return Ok(None) };
    Ok(Some(Traced { opened, tracer, costs }))
}

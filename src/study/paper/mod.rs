//! The article's comparison, Figures 5 to 9, and a verdict on each of its claims.

mod article;
mod charts;
mod claims;
mod division;
mod measure;
mod report;
mod rows;

use std::time::Duration;

use super::progress::Progress;
use super::workbench::Workbench;
use super::{Study, Tell};
use crate::driver::probe;
use crate::picture::{Division, Size};
use crate::scene::Opened;
use crate::tracer::{Quality, Tracer};
use measure::{Measuring, pace};

/// Figures 5 to 9 on threads and in virtual time, without a network and on a modelled one; what else one wants to know of
/// the strategies; and a verdict on each claim of §7, §10 and §11.
///
/// # Errors
/// A sentence, if a run failed.
pub fn paper(scene: &Opened, tell: Tell<'_>) -> Result<Study, String> {
    let mut progress = Progress::new(3 + Measuring::THREAD_STEPS + Measuring::COMPETING_STEPS, tell);
    progress.next("what the picture costs");
    let size = Size::new(640, 480)?;
    let (samples, work) = long_enough(scene, size);
    let bench = Workbench::new(scene, size, samples)?;
    let mut measuring = Measuring::new(&bench, work);
    progress.next("virtual time");
    measuring.simulated();
    measuring.sizes();
    measuring.swings();
    let handling = measuring.handling();
    measuring.threads(&mut progress)?;
    let competing = measuring.competing(&mut progress)?;
    progress.next("rays that change hands");
    let divisions = division::count(&bench.tracer);
    let rows = measuring.rows;
    let mut study = Study::new("paper");
    study.add_rows(&rows)?;
    for (name, marks) in charts::all(&rows, &handling) {
        study.add_chart(name, &marks);
    }
    study.add_report(report::report(&bench, &rows, &handling, competing, &divisions));
    Ok(study)
}

/// How many samples a pixel make a run of four machines last more than a second, and what CPU time the picture then takes.
fn long_enough(scene: &Opened, size: Size) -> (u32, Duration) {
    let work = |samples| {
        let tracer = Tracer::new(&scene.scene, size, Quality { samples, ..Quality::default() });
        probe(&tracer, Division::new(size.pixels(), article::ATOM), Duration::from_millis(300)).whole
    };
    let least = Duration::from_secs_f64(1.2 * 4.0 * pace());
    // An average computer needs two.
    let found = (1..=8).map(|samples| (samples, work(samples))).find(|(_, work)| *work >= least);
    found.unwrap_or_else(|| (8, work(8)))
}

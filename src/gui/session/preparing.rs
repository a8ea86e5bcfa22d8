//! The job that reads and compiles a scene, a run or a lesson.

use std::sync::Arc;
use std::time::Duration;

use super::super::settings::Settings;
use super::job_result::{JobResult, Prepared, Ready, Recorded};
use super::jobs::Jobs;
use super::opening::{Opening, unreadable_scene};
use super::preview::{PREVIEW_STEP, PREVIEW_TIME, preview_pixels, with_preview};
use super::tracing::TracingJob;
use crate::driver::{PictureCache, RAY_COST, probe};
use crate::language::{Language, say};
use crate::picture::Size;
use crate::runlog::Driver;
use crate::scene::Opened;
use crate::tracer::Tracer;
use crate::view::RunView;

impl Jobs {
    /// Starts the job that reads with `read` and compiles the result. For settings in virtual time it traces the
    /// picture of a scene too. Returns the job's number.
    pub(super) fn prepare(
        &mut self,
        read: impl FnOnce() -> Result<Opening, String> + Send + 'static,
        settings: &Settings,
        (kept, tracing): (Arc<PictureCache>, TracingJob),
        language: Language,
    ) -> u64 {
        let number = self.number();
        let (size, quality, division) = (settings.size, settings.quality, settings.division());
        let is_virtual = settings.driver == Driver::Sim;
        self.start(language, "prepare", move || {
            let ready = read().and_then(|opening| match opening {
                Opening::Scene(opened) => {
                    let tracer = Tracer::new(&opened.scene, size, quality);
                    let tracer = Arc::new(with_preview(tracer, PREVIEW_STEP, PREVIEW_TIME));
                    let estimate = probe(&tracer, division, PROBE_TIME);
                    let cpu = estimate.whole_with_rests(&tracer, division);
                    let virtual_time = RAY_COST.mul_f64(estimate.rays as f64);
                    let preview = preview_pixels(&tracer);
                    if is_virtual {
                        let done = |more| tracing.add(more);
                        // If cancelled, the run begins in real time, or nobody waits for the result.
                        let traced = kept.get_or_trace(&opened.text, &tracer, &done, &tracing.cancel);
                        traced.map_err(|error| error.to_string())?;
                    }
                    Ok(Ready::Scene(Prepared { opened, tracer, preview, size, quality, cpu, virtual_time }))
                }
                Opening::Run(log) => {
                    check_size(log.header.size, language)?;
                    let opened = Opened::from_text(&log.header.scene, &log.header.scene_text);
                    let opened = opened.map_err(|error| unreadable_scene(&error, language))?;
                    let tracer = Tracer::new(&opened.scene, log.header.size, log.header.quality);
                    let tracer = Arc::new(with_preview(tracer, PREVIEW_STEP, PREVIEW_TIME));
                    let view = Arc::new(RunView::of(&log));
                    let preview = preview_pixels(&tracer);
                    Ok(Ready::Run(Recorded { log, opened: Arc::new(opened), tracer, preview, view }))
                }
                Opening::Lesson(lesson) => Ok(Ready::Lesson(lesson)),
            });
            JobResult::Ready(number, ready)
        });
        number
    }
}

/// Time for which a picture is traced to estimate the cost of the whole.
const PROBE_TIME: Duration = Duration::from_millis(120);

/// Checks that the window can show a recorded picture of this size.
fn check_size(size: Size, language: Language) -> Result<(), String> {
    let max = Settings::MAX_SIDE_PX * Settings::MAX_SIDE_PX;
    if size.pixels() <= max {
        return Ok(());
    }
    Err(say!(
        language,
        "The run's picture has {size} pixels; the window shows up to {max}. Record the run with a smaller picture",
        "A imagem da execução tem {size} pixels; a janela mostra até {max}. Grave a execução com uma imagem menor"
    ))
}

//! The job that reads and compiles what is to be shown.

use std::sync::Arc;
use std::time::Duration;

use super::super::settings::Settings;
use super::job_result::{JobResult, Prepared, Ready, Recorded};
use super::jobs::Jobs;
use super::opening::Opening;
use super::preview::{FINEST, PREVIEW, guess, with_preview};
use crate::driver::{RAY_COST, probe};
use crate::language::{Language, say};
use crate::picture::Size;
use crate::scene::Opened;
use crate::tracer::Tracer;
use crate::view::RunView;

impl Jobs {
    /// Reads and compiles what `read` gives; returns the job's number.
    pub fn prepare(
        &mut self,
        read: impl FnOnce() -> Result<Opening, String> + Send + 'static,
        settings: &Settings,
        language: Language,
    ) -> u64 {
        let number = self.number();
        let (size, quality, division) = (settings.size, settings.quality, settings.division());
        self.start(language, "prepare", move || {
            let ready = read().and_then(|opening| match opening {
                Opening::Scene(opened) => {
                    let tracer = Arc::new(with_preview(Tracer::new(&opened.scene, size, quality), FINEST, PREVIEW));
                    let found = probe(&tracer, division, PROBE);
                    let cpu = found.whole_with_rests(&tracer, division);
                    let virtual_time = RAY_COST.mul_f64(found.rays as f64);
                    let preview = guess(&tracer);
                    Ok(Ready::Scene(Prepared { opened, tracer, preview, size, quality, cpu, virtual_time }))
                }
                Opening::Run(log) => {
                    check_size(log.header.size, language)?;
                    let opened = Opened::from_text(&log.header.scene, &log.header.scene_text);
                    let unread = |error| {
                        say!(
                            language,
                            "The run's own scene cannot be read: {error}",
                            "A cena da própria execução não pode ser lida: {error}"
                        )
                    };
                    let opened = opened.map_err(unread)?;
                    let tracer = Tracer::new(&opened.scene, log.header.size, log.header.quality);
                    let tracer = Arc::new(with_preview(tracer, FINEST, PREVIEW));
                    let known = Arc::new(RunView::of(&log));
                    let preview = guess(&tracer);
                    Ok(Ready::Run(Recorded { log, opened: Arc::new(opened), tracer, preview, known }))
                }
                Opening::Lesson(lesson) => Ok(Ready::Lesson(lesson)),
            });
            JobResult::Ready(number, ready)
        });
        number
    }
}

/// How much of a picture is traced to know what the whole will cost.
const PROBE: Duration = Duration::from_millis(120);

/// Whether a window can hold a recorded picture.
fn check_size(size: Size, language: Language) -> Result<(), String> {
    let most = Settings::LONGEST_SIDE * Settings::LONGEST_SIDE;
    if size.pixels() <= most {
        return Ok(());
    }
    Err(say!(
        language,
        "This run's picture of {size} pixels is too large for the window, which shows up to {most} pixels",
        "A imagem desta execução, de {size} pixels, é grande demais para a janela, que mostra até {most} pixels"
    ))
}

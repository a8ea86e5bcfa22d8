//! `anel lesson`: prints the steps of a lesson and checks its claims.

use std::path::Path;

use super::{Failure, print, progress};
use crate::cancel::CancelToken;
use crate::driver::PictureCache;
use crate::language::Language;
use crate::lesson::{BUILT_IN, Lesson};
use crate::time::Time;
use crate::view::{TimeScale, time_words};

/// Plays the lesson `argument`; without one, lists the built-in lessons.
pub(super) fn lesson(argument: Option<&Path>) -> Result<(), Failure> {
    let Some(argument) = argument else {
        for (name, _) in BUILT_IN {
            let lesson = Lesson::open(name).map_err(|error| Failure::Failed(error.to_string()))?;
            print(&format!(
                "{name:14} {}: {}",
                lesson.title.in_language(Language::English),
                lesson.about.in_language(Language::English)
            ))?;
        }
        return Ok(());
    };
    play(&Lesson::open(argument).map_err(|error| Failure::Refused(error.to_string()))?)
}

/// Executes the runs of a lesson in virtual time, and prints its steps and its claims. Fails if a claim is not true.
pub(super) fn play(lesson: &Lesson) -> Result<(), Failure> {
    let bar = progress(lesson.pixels().into(), "{percent:>3} %  tracing");
    let performed = lesson.perform(&PictureCache::default(), &|more| bar.inc(more.into()), &CancelToken::default());
    bar.finish_and_clear();
    let performed = performed.map_err(|error| Failure::Refused(error.to_string()))?.unwrap_or_default();
    for (number, step) in (1..).zip(&lesson.steps) {
        let run = performed.iter().find(|(name, _)| *name == step.run);
        let at = run.zip(step.until).and_then(|((_, run), until)| Some((run, until.of(&run.log)?.0)));
        let at = at.and_then(|(run, records)| Some(run.log.records().get(records.checked_sub(1)?)?.at));
        let scale = TimeScale::of_length(run.map_or(Time::ZERO, |(_, run)| run.log.end()));
        let words = |at| format!(" to {}", time_words(at, scale.finer(1), Language::English));
        let at = at.map_or_else(String::new, words);
        print(&format!("{number}. [{}{at}] {}", step.run, step.say.in_language(Language::English)))?;
    }
    let claims = lesson.check(&performed);
    for (claim, is_true) in &claims {
        print(&format!("{} {claim}", if *is_true { "true: " } else { "FALSE:" }))?;
    }
    match claims.iter().filter(|(_, is_true)| !is_true).count() {
        0 => Ok(()),
        false_ones => Err(Failure::Failed(format!("{false_ones} of {} claims are not true", claims.len()))),
    }
}

//! Commands on the shown time: pause, drag, step.

use super::{Phase, Session, Stage};
use crate::language::{say, word};
use crate::time::Time;
use crate::view::StepUnit;

impl Stage {
    /// Returns the length of the run as the window shows it: so far, or, while later moments are hidden, up to the
    /// latest shown moment, but at least one second so that the line has a length.
    pub fn shown_length(&self) -> Time {
        const MIN_LENGTH_S: f64 = 1.0;
        let told = self.time.reached().max(Time::from_secs(MIN_LENGTH_S));
        if self.hides_later { told.min(self.length()) } else { self.length() }
    }
}

impl Session {
    /// Pauses or resumes the run while it is followed, else the shown time. At the end it starts from the beginning.
    pub fn toggle_pause(&mut self) {
        let stage = &mut self.stage;
        if stage.phase == Phase::Preparing {
            // There is no run yet.
        } else if stage.phase == Phase::Running && stage.is_live() {
            self.set_run_paused(!self.stage.paused);
        } else if stage.is_at_end() {
            stage.seek(Time::ZERO, false);
        } else {
            stage.time.set_paused(stage.goes_on());
        }
    }

    /// Pauses or resumes the run itself.
    pub fn set_run_paused(&mut self, paused: bool) {
        if self.stage.phase == Phase::Running {
            self.stage.paused = paused;
            self.stage.source.set_paused(paused);
        }
    }

    /// Shows the moment to which the time is dragged; it is stopped meanwhile.
    pub fn drag_to(&mut self, time: Time, paused: bool) {
        if self.dragged_from.is_none() && paused {
            self.dragged_from = Some(self.stage.time.is_paused() && !self.stage.is_live());
        }
        self.stage.seek(time, paused);
    }

    /// Ends a drag of the time: it advances again if it did before.
    pub fn let_time_go(&mut self) {
        if let Some(stood) = self.dragged_from.take() {
            self.stage.time.set_paused(stood);
        }
    }

    /// Shows the next or the last event, atom or lap and stops there. The run is paused if it is followed.
    pub fn step(&mut self, by: StepUnit, forward: bool) {
        let language = self.language;
        // Else events would pass between two steps.
        if self.stage.is_live() {
            self.set_run_paused(true);
        }
        if !self.stage.step(by, forward) {
            let name = by.name(language);
            self.note(if forward {
                say!(language, "There is no later {name}", "Não há {name} depois daqui")
            } else {
                say!(language, "There is no earlier {name}", "Não há {name} antes daqui")
            });
        }
    }

    /// Shows the present of a live run, or the end of a finished one, so that the user sees the effect of a change.
    pub(super) fn return_to_present(&mut self) {
        let language = self.language;
        if self.stage.phase == Phase::Running && !self.stage.is_live() {
            self.stage.follow();
            self.note(word!(
                language,
                "Back in the present: changes act on the run as it is now",
                "De volta ao presente: as mudanças valem para a execução como está agora"
            ));
        } else if self.stage.phase == Phase::Finished && !self.stage.shows_end() {
            self.stage.follow();
            self.note(word!(
                language,
                "The run has ended: the change is for the next one",
                "A execução terminou: a mudança vale para a próxima"
            ));
        }
    }
}

//! The run's time in the user's hand.

use super::{Phase, Session, Stage};
use crate::language::{say, word};
use crate::time::Time;
use crate::view::StepUnit;

impl Stage {
    /// How long a run is told to be: so far, or while what comes later is hidden, as far as it was shown, but not so short
    /// that nothing of it could be seen.
    pub fn told_length(&self) -> Time {
        const LEAST: f64 = 1.0;
        let told = self.time.reached().max(Time::from_secs(LEAST));
        if self.hides_later { told.min(self.length()) } else { self.length() }
    }
}

impl Session {
    /// Lets what is seen go on or stand still: the run itself while it is followed, else the shown time. From the end it
    /// goes on at the beginning.
    pub fn toggle_pause(&mut self) {
        let stage = &mut self.stage;
        if stage.phase == Phase::Preparing {
            // There is nothing yet that could.
        } else if stage.phase == Phase::Running && stage.is_live() {
            self.set_run_paused(!self.stage.paused);
        } else if stage.is_at_end() {
            stage.seek(Time::ZERO, false);
        } else {
            stage.time.set_paused(stage.goes_on());
        }
    }

    /// Lets the run itself stand still or go on.
    pub fn set_run_paused(&mut self, paused: bool) {
        if self.stage.phase == Phase::Running {
            self.stage.paused = paused;
            self.stage.performer.set_paused(paused);
        }
    }

    /// Shows the moment that a hand drags along the run's time; meanwhile time stands still.
    pub fn drag_to(&mut self, time: Time, stands: bool) {
        if self.dragged_from.is_none() && stands {
            self.dragged_from = Some(self.stage.time.is_paused() && !self.stage.is_live());
        }
        self.stage.seek(time, stands);
    }

    /// The hand lets go: time goes on if it did before.
    pub fn let_time_go(&mut self) {
        if let Some(stood) = self.dragged_from.take() {
            self.stage.time.set_paused(stood);
        }
    }

    /// Shows what happened next or before, and stands still there.
    pub fn step(&mut self, by: StepUnit, forward: bool) {
        let language = self.language;
        // Whoever makes steps wants to see them all.
        if self.stage.is_live() {
            self.set_run_paused(true);
        }
        if !self.stage.step(by, forward) {
            let name = by.name(language);
            self.note(if forward {
                say!(language, "There is no later {name}", "Depois daqui: nenhum passo por {name}")
            } else {
                say!(language, "There is no earlier {name}", "Antes daqui: nenhum passo por {name}")
            });
        }
    }

    /// Whoever takes a hand in a run that goes on sees what comes of it.
    pub(super) fn return_to_present(&mut self) {
        let language = self.language;
        if self.stage.phase == Phase::Running && !self.stage.is_live() {
            self.stage.follow();
            self.note(word!(
                language,
                "Back in the present: what you change, you change in the run as it is now",
                "De volta ao presente: o que se muda, muda na execução como está agora"
            ));
        }
    }
}

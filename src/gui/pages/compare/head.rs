//! The line above the compared runs: title, playback, and the buttons to add a run and to close.

use std::time::Duration;

use egui::{Align, Label, Layout, RichText, Sense, Ui, UiBuilder, vec2};

use super::{Compare, CompareColumn, MAX_RUNS, adding};
use crate::balance::Strategy;
use crate::gui::input::keys::UserCommand;
use crate::gui::input::rate_menu;
use crate::gui::session::{Session, TracedShare};
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button, button_with_room, progress, text_width};
use crate::language::{Language, word};
use crate::view::{TimeScale, time_words};

impl Compare {
    /// Shows the line.
    pub(super) fn heading(&mut self, ui: &mut Ui, session: &mut Session, look: Look) {
        let language = session.language();
        ui.horizontal(|ui| {
            ui.set_height(4.0 * GRID);
            ui.label(
                RichText::new(word!(language, "Compare", "Comparar"))
                    .font(theme::strong(theme::LARGE))
                    .color(look.text),
            );
            ui.add_space(GRID);
            self.play(ui, look, language);
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let close = word!(language, "Close the comparison", "Fechar a comparação");
                if button(ui, Some(Icon::Close), close, false, Emphasis::Quiet).clicked() {
                    self.close(session);
                }
                // A job for one more run would trace the picture from its beginning.
                if (self.is_traced && self.columns.len() < MAX_RUNS)
                    && let Some(change) = adding::strategies(ui, &self.strategies(), look, language)
                {
                    self.add(vec![change]);
                    self.run(session);
                }
                if self.trouble.is_none() && self.progress(ui, session, look) {
                    self.close(session);
                }
                let (text, colour) = match &self.trouble {
                    Some(why) => (why.as_str(), look.trouble),
                    None => (
                        word!(
                            language,
                            "The same picture and machines, in virtual time",
                            "A mesma imagem e as mesmas máquinas, em tempo virtual"
                        ),
                        look.quiet,
                    ),
                };
                let text = RichText::new(text).font(theme::regular(theme::SMALL)).color(colour);
                let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 4.0 * GRID), Sense::hover());
                // An error is shown even if it is cut off.
                if self.trouble.is_some() || rect.width() > 48.0 * GRID {
                    let right = UiBuilder::new().max_rect(rect).layout(Layout::right_to_left(Align::Center));
                    let label = ui.scope_builder(right, |ui| ui.add(Label::new(text).truncate())).inner;
                    if self.trouble.is_none() {
                        label.on_hover_text(virtual_time_hint(language));
                    }
                }
            });
        });
    }

    /// Shows the progress of the picture, which is traced once for all runs, and the button that cancels the
    /// comparison. Returns whether the button was pressed.
    fn progress(&self, ui: &mut Ui, session: &Session, look: Look) -> bool {
        let language = session.language();
        let is_waiting = self.columns.iter().any(|column| column.run.is_none());
        let Some(tracing) = self.tracing.as_ref().filter(|_| is_waiting) else { return false };
        ui.ctx().request_repaint_after(Duration::from_millis(250));
        let TracedShare { share, elapsed_s } = session.traced_share(tracing);
        let is_cancelled = button(ui, None, word!(language, "Cancel", "Cancelar"), true, Emphasis::Quiet).clicked();
        let text = RichText::new(progress::words(share, elapsed_s, language));
        ui.label(text.font(theme::regular(theme::SMALL)).color(look.quiet));
        progress::bar(ui, share, word!(language, "Tracing the picture", "Calculando a imagem"));
        is_cancelled
    }

    /// Shows the buttons of the playback and the shown time.
    fn play(&mut self, ui: &mut Ui, look: Look, language: Language) {
        let is_over = self.time.now() >= self.length();
        let names = word!(language, ["Play again", "Resume", "Pause"], ["Repetir", "Continuar", "Pausar"]);
        let (icon, name) = match self.time.is_paused() {
            _ if is_over => (Icon::Restart, names[0]),
            true => (Icon::Play, names[1]),
            false => (Icon::Pause, names[2]),
        };
        let room = names.map(|name| text_width(ui, name)).into_iter().fold(0.0, f32::max);
        if button_with_room(ui, icon, name, room, Emphasis::Primary).clicked() {
            self.handle_command(UserCommand::Pause);
        }
        ui.spacing_mut().item_spacing.x = GRID / 2.0;
        if let Some(command) = rate_menu::show(ui, self.time.rate(), language) {
            self.handle_command(command);
        }
        ui.add_space(GRID);
        let shown = time_words(self.time.now(), TimeScale::of_length(self.length()), language);
        ui.label(RichText::new(shown).font(theme::strong(theme::LARGE)).color(look.text));
    }

    /// Returns the strategies that no unchanged run of the comparison has.
    fn strategies(&self) -> Vec<Strategy> {
        let is_missing = |strategy: &Strategy| {
            let has_it = |column: &CompareColumn| column.trial.header.rules.strategy == *strategy && !column.is_fork();
            !self.columns.iter().any(has_it)
        };
        Strategy::ALL.into_iter().filter(is_missing).collect()
    }
}

/// Explains why the times differ from those of the run on the stage.
fn virtual_time_hint(language: Language) -> &'static str {
    word!(
        language,
        "In virtual time a machine has exactly its set speed, and the cost of an atom is computed from its rays. In a \
        real run the cost of an atom is CPU time of this computer, and other programs delay it. So the times differ",
        "Em tempo virtual, uma máquina tem exatamente sua velocidade, e o custo de um átomo é calculado de seus raios. \
        Numa execução real, o custo de um átomo é tempo de CPU deste computador, e outros programas o atrasam. Por isso \
        os tempos diferem"
    )
}

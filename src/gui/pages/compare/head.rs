//! The line above the compared runs: title, playback, and the buttons to add a run and to close.

use std::time::Duration;

use egui::{Align, Label, Layout, ProgressBar, RichText, Role, Sense, Ui, UiBuilder, WidgetInfo, vec2};

use super::{Compare, CompareColumn, MAX_RUNS, adding};
use crate::balance::Strategy;
use crate::gui::input::keys::UserCommand;
use crate::gui::input::rate_menu;
use crate::gui::session::Session;
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button};
use crate::language::{Language, word};
use crate::view::{TimeScale, fraction, time_words};

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
                if self.columns.len() < MAX_RUNS
                    && let Some(change) = adding::strategies(ui, &self.strategies(), look, language)
                {
                    self.add(vec![change]);
                    self.run(session);
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
                if self.trouble.is_none() {
                    self.progress(ui, look, language);
                }
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

    /// Shows the progress of the picture, which is traced once for all runs.
    fn progress(&self, ui: &mut Ui, look: Look, language: Language) {
        let is_waiting = self.columns.iter().any(|column| column.run.is_none());
        let Some(subject) = self.subject.as_ref().filter(|_| is_waiting) else { return };
        let share = match self.picture {
            Some(_) => 1.0,
            None => self.tracing.done() as f32 / subject.trial.header.size.pixels() as f32,
        };
        let bar =
            ui.add(ProgressBar::new(share).desired_width(16.0 * GRID).desired_height(0.75 * GRID).fill(look.accent));
        bar.widget_info(|| {
            let text = word!(language, "of the picture is traced", "da imagem estão calculados");
            WidgetInfo::labeled(Role::ProgressIndicator, true, format!("{} {text}", fraction(share.into())))
        });
        ui.ctx().request_repaint_after(Duration::from_millis(100));
    }

    /// Shows the buttons of the playback and the shown time.
    fn play(&mut self, ui: &mut Ui, look: Look, language: Language) {
        let is_over = self.time.now() >= self.length();
        let (icon, name) = match self.time.is_paused() {
            _ if is_over => (Icon::Restart, word!(language, "Play again", "Repetir")),
            true => (Icon::Play, word!(language, "Resume", "Continuar")),
            false => (Icon::Pause, word!(language, "Pause", "Pausar")),
        };
        if button(ui, Some(icon), name, true, Emphasis::Primary).clicked() {
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

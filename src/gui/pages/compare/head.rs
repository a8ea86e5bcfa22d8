//! The line above the runs: what the page is about, its time, what can be added, and the way out.

use std::time::Duration;

use egui::{Align, Label, Layout, ProgressBar, RichText, Role, Sense, Ui, UiBuilder, WidgetInfo, vec2};

use super::{Compare, CompareColumn, MOST, adding};
use crate::balance::Strategy;
use crate::gui::input::keys::UserCommand;
use crate::gui::input::rate_menu;
use crate::gui::session::Session;
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button};
use crate::language::{Language, word};
use crate::view::{fraction, time_words};

impl Compare {
    /// What the page is about, its time, and the way out.
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
                if self.entries.len() < MOST
                    && let Some(change) = adding::strategies(ui, &self.strategies(), look, language)
                {
                    self.add(vec![change]);
                    self.run(session);
                }
                let (said, colour) = match &self.trouble {
                    Some(why) => (why.as_str(), look.trouble),
                    None => (
                        word!(
                            language,
                            "The same picture, the same machines, in virtual time",
                            "A mesma imagem, as mesmas máquinas, em tempo virtual"
                        ),
                        look.quiet,
                    ),
                };
                if self.trouble.is_none() {
                    self.progress(ui, look, language);
                }
                let said = RichText::new(said).font(theme::regular(theme::SMALL)).color(colour);
                let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 4.0 * GRID), Sense::hover());
                // What went wrong is told in any case.
                if self.trouble.is_some() || rect.width() > 48.0 * GRID {
                    let right = UiBuilder::new().max_rect(rect).layout(Layout::right_to_left(Align::Center));
                    let label = ui.scope_builder(right, |ui| ui.add(Label::new(said).truncate())).inner;
                    if self.trouble.is_none() {
                        label.on_hover_text(virtual_time(language));
                    }
                }
            });
        });
    }

    /// How far the picture is, on which all runs wait; it is traced once for all of them.
    fn progress(&self, ui: &mut Ui, look: Look, language: Language) {
        let is_waiting = self.entries.iter().any(|entry| entry.contender.is_none());
        let Some(subject) = self.subject.as_ref().filter(|_| is_waiting) else { return };
        let share = match self.pictured {
            Some(_) => 1.0,
            None => self.tracing.done() as f32 / subject.trial.header.size.pixels() as f32,
        };
        let bar =
            ui.add(ProgressBar::new(share).desired_width(16.0 * GRID).desired_height(0.75 * GRID).fill(look.accent));
        bar.widget_info(|| {
            let words = word!(language, "of the picture is traced", "da imagem estão calculados");
            WidgetInfo::labeled(Role::ProgressIndicator, true, format!("{} {words}", fraction(share.into())))
        });
        ui.ctx().request_repaint_after(Duration::from_millis(100));
    }

    /// Whether time goes on, and how fast.
    fn play(&mut self, ui: &mut Ui, look: Look, language: Language) {
        let over = self.time.now() >= self.length();
        let (icon, name) = match self.time.is_paused() {
            _ if over => (Icon::Restart, word!(language, "Play again", "Repetir")),
            true => (Icon::Play, word!(language, "Go on", "Continuar")),
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
        let shown = time_words(self.time.now(), 1.0, language);
        ui.label(RichText::new(shown).font(theme::strong(theme::LARGE)).color(look.text));
    }

    /// The strategies that no run has without other changes.
    fn strategies(&self) -> Vec<Strategy> {
        let plain = |strategy| {
            let is_it = |entry: &CompareColumn| entry.trial.header.rules.strategy == strategy && !entry.is_fork();
            !self.entries.iter().any(is_it)
        };
        Strategy::ALL.into_iter().filter(|&strategy| plain(strategy)).collect()
    }
}

/// Why its seconds are not those of the run on the stage.
fn virtual_time(language: Language) -> &'static str {
    word!(
        language,
        "In virtual time a machine is exactly as fast as its speed says, and an atom costs what its rays are counted for. A run \
         on this computer takes other seconds: there an atom costs the time of its processor, and other work delays it",
        "Em tempo virtual, uma máquina é tão rápida quanto diz sua velocidade, e um átomo custa o que valem seus raios. Uma \
         execução neste computador leva outros segundos: ali um átomo custa o tempo do processador, e outras tarefas o \
         atrasam"
    )
}

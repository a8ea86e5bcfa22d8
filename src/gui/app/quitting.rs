//! Closing of the window: while a file is being written, the window finishes it first, or asks.

use egui::{Context, Id, Label, Modal, ProgressBar, RichText, ViewportCommand};

use super::App;
use crate::cancel::CancelToken;
use crate::gui::session::{ExportProgress, NoticeKind, Session};
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button, popup_frame};
use crate::interrupt::EndsEarly;
use crate::language::{say, word};
use crate::view::fraction;

/// Whether the window closes.
#[derive(Debug, Default)]
pub(super) struct Quitting {
    state: QuitState,
    /// Cancelled by a signal.
    signal: Option<(CancelToken, EndsEarly)>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum QuitState {
    #[default]
    Open,
    /// The window closes once all files are written.
    Waiting,
    /// The window closes in the next frame.
    Closing,
}

/// Answer to the question.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum QuitAnswer {
    QuitNow,
    Stay,
}

impl App {
    /// Lets the first signal close the window, without a question.
    pub fn close_on_signal(&mut self, ctx: &Context) {
        let (token, ctx) = (CancelToken::default(), ctx.clone());
        let its_token = token.clone();
        let ends_early = EndsEarly::new(move || {
            its_token.cancel();
            ctx.request_repaint();
        });
        self.quitting.signal = Some((token, ends_early));
    }

    /// Closes the window when that is asked for and no file is being written.
    pub(super) fn close_when_written(&mut self, ctx: &Context) {
        let is_writing = self.session.exports().next().is_some();
        if self.quitting.signal.as_ref().is_some_and(|(token, _)| token.is_cancelled()) {
            self.close_now(ctx);
        } else if ctx.input(|input| input.viewport().close_requested()) && is_writing {
            if self.quitting.state != QuitState::Closing {
                ctx.send_viewport_cmd(ViewportCommand::CancelClose);
                self.quitting.state = QuitState::Waiting;
            }
        } else if self.is_waiting_to_quit() && !is_writing {
            // The reason why a file could not be written must be read.
            if self.session.notice().is_some_and(|notice| notice.kind == NoticeKind::Trouble) {
                self.stay_open();
            } else {
                self.close_now(ctx);
            }
        }
    }

    /// Shows the progress of the files for which the window waits, and the question.
    pub(super) fn ask_to_quit(&mut self, ctx: &Context) {
        if !self.is_waiting_to_quit() {
            return;
        }
        match question(ctx, &self.session) {
            Some(QuitAnswer::QuitNow) => self.close_now(ctx),
            Some(QuitAnswer::Stay) => self.stay_open(),
            None => {}
        }
    }

    /// Whether the window closes once all files are written.
    pub(super) fn is_waiting_to_quit(&self) -> bool {
        self.quitting.state == QuitState::Waiting
    }

    /// Stops waiting: the window stays open.
    pub(super) fn stay_open(&mut self) {
        self.quitting.state = QuitState::Open;
    }

    fn close_now(&mut self, ctx: &Context) {
        if self.quitting.state != QuitState::Closing {
            self.quitting.state = QuitState::Closing;
            ctx.send_viewport_cmd(ViewportCommand::Close);
        }
    }
}

fn question(ctx: &Context, session: &Session) -> Option<QuitAnswer> {
    let language = session.language();
    let look = Look::of(ctx);
    let modal = Modal::new(Id::unique("quit")).frame(popup_frame(ctx).inner_margin(2.0 * GRID));
    let shown = modal.show(ctx, |ui| {
        ui.set_width(52.0 * GRID);
        for ExportProgress { name, done, .. } in session.exports() {
            let text = say!(language, "{name} is still being written", "{name} ainda está sendo gravado");
            ui.add(Label::new(RichText::new(text).font(theme::strong(theme::BODY)).color(look.text)).wrap());
            if let Some((_, share)) = done {
                ui.horizontal(|ui| {
                    ui.visuals_mut().extreme_bg_color = look.hairline;
                    let bar = ProgressBar::new(share as f32).desired_width(40.0 * GRID).desired_height(GRID);
                    ui.add(bar.fill(look.accent));
                    let share = RichText::new(fraction(share)).font(theme::regular(theme::BODY));
                    ui.label(share.color(look.quiet));
                });
            }
        }
        let text =
            word!(language, "The window closes when it is complete.", "A janela fecha quando a gravação terminar.");
        ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(look.quiet));
        ui.add_space(GRID);
        ui.horizontal(|ui| {
            let stay = word!(language, "Do not quit", "Não sair");
            let now = word!(language, "Quit without the file", "Sair sem o arquivo");
            if button(ui, None, stay, true, Emphasis::Primary).clicked() {
                return Some(QuitAnswer::Stay);
            }
            button(ui, None, now, true, Emphasis::Quiet).clicked().then_some(QuitAnswer::QuitNow)
        })
        .inner
    });
    let leaves = shown.should_close().then_some(QuitAnswer::Stay);
    shown.inner.or(leaves)
}

//! A sentence that floats below the top bar: what was done, what went wrong, what can be done about it.

use egui::{Align2, Area, Context, Frame, Id, Label, LayerId, Order, ProgressBar, RichText, Stroke, Ui};

use super::icons::Icon;
use super::theme::{self, GRID, Look};
use super::widgets::{Weight, button};
use crate::language::{say, word};
use crate::view::fraction;

/// What is to be read.
#[derive(Clone, Debug, PartialEq)]
pub struct Notice {
    text: String,
    kind: Kind,
    /// When it came, by egui's clock in seconds.
    since: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// It goes away by itself.
    Note,
    /// It stays until it is closed.
    Trouble,
    /// The scene's file has changed: it can be read again.
    Changed,
}

/// What was pressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Click {
    /// Away with it.
    Close,
    /// Read the scene's file again.
    Reload,
}

impl Notice {
    /// For how long a note can be read, in seconds.
    const READ: f64 = 8.0;

    /// Something was done.
    pub fn note(text: impl Into<String>, since: f64) -> Self {
        Self { text: text.into(), kind: Kind::Note, since }
    }

    /// Something cannot be done.
    pub fn trouble(text: impl Into<String>, since: f64) -> Self {
        Self { text: text.into(), kind: Kind::Trouble, since }
    }

    /// The file of the scene has changed.
    pub fn changed(text: impl Into<String>, since: f64) -> Self {
        Self { text: text.into(), kind: Kind::Changed, since }
    }

    /// What it says.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// For how many more seconds it is to be shown; `None` if until it is closed.
    pub fn remains(&self, now: f64) -> Option<f64> {
        (self.kind == Kind::Note).then(|| (self.since + Self::READ - now).max(0.0))
    }

    /// Shows it, and returns what was pressed.
    pub fn show(&self, ctx: &Context) -> Option<Click> {
        let look = Look::of(ctx);
        floating(ctx, |ui| {
            let colour = if self.kind == Kind::Trouble { look.trouble } else { look.text };
            let text = RichText::new(&self.text).font(theme::regular(theme::BODY)).color(colour);
            ui.scope(|ui| {
                let buttons = if self.kind == Kind::Changed { 17.0 } else { 6.0 };
                ui.set_max_width(widest(ui) - buttons * GRID);
                ui.add(Label::new(text).wrap());
            });
            let name = word!("Reload", "Recarregar");
            let reload = self.kind == Kind::Changed && button(ui, None, name, true, Weight::Primary).clicked();
            let close = word!("Close notice", "Fechar aviso");
            let close = button(ui, Some(Icon::Close), close, false, Weight::Quiet).clicked();
            if reload { Some(Click::Reload) } else { close.then_some(Click::Close) }
        })
    }
}

/// Says that something is being read and compiled.
pub fn loading(ctx: &Context, name: &str) {
    let look = Look::of(ctx);
    floating(ctx, |ui| {
        ui.add(egui::Spinner::new().size(2.0 * GRID).color(look.accent));
        let text = say!("{name} is being read and compiled …", "{name} está sendo lida e compilada …");
        ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(look.text));
    });
}

/// Says what is being made and how far it is; returns whether that is to end.
pub fn making(ctx: &Context, name: &str, part: f64) -> bool {
    let look = Look::of(ctx);
    floating(ctx, |ui| {
        let text = say!("{name} is being made", "{name} está sendo feito");
        ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(look.text));
        let percent = fraction(part);
        ui.visuals_mut().extreme_bg_color = look.hairline;
        let bar = ProgressBar::new(part as f32).desired_width(16.0 * GRID).desired_height(GRID).fill(look.accent);
        ui.add(bar);
        ui.label(RichText::new(percent).font(theme::regular(theme::BODY)).color(look.quiet));
        button(ui, None, word!("Cancel", "Cancelar"), true, Weight::Quiet).clicked()
    })
}

/// Over everything else, so that nothing moves away under somebody's hand when it comes or goes.
fn floating<T>(ctx: &Context, content: impl FnOnce(&mut Ui) -> T) -> T {
    let look = Look::of(ctx);
    let frame = Frame::NONE.fill(look.raised).stroke(Stroke::new(1.0, look.hairline)).corner_radius(8.0);
    let area = Area::new(Id::unique("notice")).order(Order::Foreground).anchor(Align2::CENTER_TOP, [0.0, 8.0 * GRID]);
    let shown = area.show(ctx, |ui| {
        frame.inner_margin(egui::vec2(1.5 * GRID, GRID)).show(ui, |ui| ui.horizontal(content).inner).inner
    });
    shown.inner
}

/// How wide a notice can be.
fn widest(ui: &Ui) -> f32 {
    (ui.ctx().content_rect().width() - 8.0 * GRID).min(110.0 * GRID)
}

/// Says, over everything, that a file can be dropped.
pub fn drop_here(ui: &Ui) {
    let look = Look::of(ui.ctx());
    let painter = ui.ctx().layer_painter(LayerId::new(Order::Foreground, Id::unique("drop")));
    let area = ui.ctx().content_rect();
    painter.rect_filled(area, 0.0, look.ground.gamma_multiply(0.85));
    let frame = area.shrink(3.0 * GRID);
    painter.rect_stroke(frame, 12.0, Stroke::new(2.0, look.accent), egui::StrokeKind::Inside);
    let text = word!("Drop a scene or a recorded run", "Soltar uma cena ou uma execução gravada");
    painter.text(area.center(), Align2::CENTER_CENTER, text, theme::strong(theme::LARGE), look.text);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn notes_go_away_and_troubles_stay() {
        let note = Notice::note("Saved", 10.0);
        assert_eq!([note.remains(10.0), note.remains(15.0), note.remains(99.0)], [Some(8.0), Some(3.0), Some(0.0)]);
        assert_eq!(Notice::trouble("No", 10.0).remains(99.0), None);
    }
}

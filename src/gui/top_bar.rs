//! The bar at the top: what runs, how long, and the few things to press.

use egui::{Align, Color32, Label, Layout, RichText, Ui};

use super::session::{Phase, Session};
use super::theme::{self, GRID, Look};
use super::widgets::{Icon, button};
use crate::view::count;

/// What was pressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Click {
    /// Stand still, or go on.
    Pause,
    /// From the beginning.
    Restart,
    /// Into a file.
    Save,
    /// Dark or light.
    Theme,
}

/// Shows the bar and returns what was pressed.
pub fn show(ui: &mut Ui, session: &Session) -> Option<Click> {
    let look = Look::of(ui.ctx());
    let wide = ui.available_width() > 760.0;
    ui.horizontal(|ui| {
        ui.set_min_height(5.0 * GRID);
        ui.label(RichText::new("anel").font(theme::strong(theme::LARGE)).color(look.text));
        ui.add_space(GRID);
        let from_right = Layout::right_to_left(Align::Center);
        ui.with_layout(from_right, |ui| {
            let clicked = buttons(ui, session, wide);
            ui.add_space(2.0 * GRID);
            let time = format!("{:.1} s", session.lasted().secs());
            ui.label(RichText::new(time).font(theme::strong(theme::LARGE)).color(look.text));
            if session.is_paused() {
                ui.label(quiet("paused at".into(), look.quiet));
            }
            ui.add_space(2.0 * GRID);
            // What is left over between name and time.
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                let what = what(ui, session);
                ui.add(Label::new(quiet(what, look.quiet)).truncate());
            });
            clicked
        })
        .inner
    })
    .inner
}

/// From right to left.
fn buttons(ui: &mut Ui, session: &Session, words: bool) -> Option<Click> {
    let mut clicked = None;
    let mut press = |icon, name, words, primary, click, hint: &str| {
        if button(ui, Some(icon), name, words, primary).on_hover_text(hint).clicked() {
            clicked = Some(click);
        }
    };
    press(Icon::Contrast, "Dark or light", false, false, Click::Theme, "Dark or light");
    press(Icon::Save, "Save PNG", words, false, Click::Save, "Save the render (S)");
    let over = *session.phase() != Phase::Running;
    press(Icon::Restart, "Restart", words, over, Click::Restart, "From the beginning, with these speeds (R)");
    if !over {
        let (icon, name) = if session.is_paused() { (Icon::Play, "Go on") } else { (Icon::Pause, "Pause") };
        press(icon, name, words, true, Click::Pause, "Stand still or go on (space)");
    }
    clicked
}

/// What runs, in as many words as fit.
fn what(ui: &Ui, session: &Session) -> String {
    let header = session.header();
    let scene = header.scene.clone();
    let machines = format!("{scene} · {} machines in a ring", header.speeds.len());
    let (width, height) = (header.size.width(), header.size.height());
    let all = format!("{machines} · {width} × {height} pixels in {} atoms", count(header.division.atoms()));
    let fits = |text: &String| {
        let galley = ui.painter().layout_no_wrap(text.clone(), theme::regular(theme::BODY), Color32::PLACEHOLDER);
        galley.size().x <= ui.available_width()
    };
    [all, machines].into_iter().find(fits).unwrap_or(scene)
}

fn quiet(text: String, colour: Color32) -> RichText {
    RichText::new(text).font(theme::regular(theme::BODY)).color(colour)
}

//! The window's content: which panel goes where, and which key does what.

use std::time::Duration;

use egui::{Align, Frame, Key, Layout, Margin, Modifiers, Panel, Rect, Theme, Ui, UiBuilder, ViewportCommand};

use super::picture_panel::{self, PicturePanel};
use super::save_bar::SaveBar;
use super::session::{Phase, Session};
use super::theme::{self, GRID, Look};
use super::top_bar::Click;
use super::{Launch, nodes_panel, places, ring_panel, top_bar, words_panel, zoom};

/// The window's content.
pub struct App {
    session: Session,
    picture: PicturePanel,
    save_bar: SaveBar,
}

impl App {
    /// The window's content; the run starts at once.
    pub fn new(ctx: &egui::Context, launch: &Launch) -> Self {
        theme::install(ctx);
        places::install(ctx);
        zoom::install(ctx);
        let ground = theme::rgb(Look::of(ctx).ground);
        Self { session: Session::start(launch, ground), picture: PicturePanel::default(), save_bar: SaveBar::default() }
    }

    /// The run that is shown, for tests.
    pub fn session(&self) -> &Session {
        &self.session
    }

    fn keys(&mut self, ui: &Ui) {
        if ui.input_mut(|input| input.consume_key(Modifiers::COMMAND, Key::Q)) {
            ui.ctx().send_viewport_cmd(ViewportCommand::Close);
        }
        zoom::keys(ui.ctx());
        // Whoever is about to type a path means letters, wherever the focus is just then.
        if self.save_bar.is_open() || ui.ctx().egui_wants_keyboard_input() {
            return;
        }
        let pressed = |key| ui.input(|input| input.key_pressed(key) && input.modifiers.is_none());
        if pressed(Key::Space) && ui.ctx().memory(|memory| memory.focused().is_none()) {
            self.click(Click::Pause, ui);
        }
        if pressed(Key::R) {
            self.click(Click::Restart, ui);
        }
        if pressed(Key::S) {
            self.click(Click::Save, ui);
        }
    }

    fn click(&mut self, click: Click, ui: &Ui) {
        match click {
            Click::Pause => self.session.toggle_pause(),
            Click::Restart => self.session.restart(),
            Click::Save => self.save_bar.toggle(&self.session),
            Click::Theme => {
                let other = if ui.ctx().theme() == Theme::Dark { Theme::Light } else { Theme::Dark };
                ui.ctx().set_theme(other);
            }
        }
    }

    /// Motion only while something moves: at rest nothing is drawn anew.
    fn schedule_repaint(&self, ctx: &egui::Context) {
        const FRAME: Duration = Duration::from_millis(33);
        // For the clock, and in order to learn when something moves again.
        const LOOK_IN: Duration = Duration::from_millis(250);
        let session = &self.session;
        let moves = session.state().moves(session.now());
        match session.phase() {
            Phase::Running if session.is_paused() => {}
            Phase::Running => ctx.request_repaint_after(if moves { FRAME } else { LOOK_IN }),
            Phase::Finished if moves => ctx.request_repaint_after(FRAME),
            Phase::Finished | Phase::Failed(_) => {}
        }
    }
}

impl eframe::App for App {
    fn logic(&mut self, ctx: &egui::Context, _frame: &mut eframe::Frame) {
        for done in self.session.tick() {
            self.save_bar.take_in(done);
        }
        self.schedule_repaint(ctx);
    }

    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        self.keys(ui);
        ui.painter().rect_filled(ui.max_rect(), 0.0, Look::of(ui.ctx()).ground);
        let side = 2 * GRID as i8;
        let panel = |top: i8, bottom: i8| Frame::NONE.inner_margin(Margin { left: side, right: side, top, bottom });
        let clicked = Panel::top("top bar").frame(panel(8, 8)).show(ui, |ui| top_bar::show(ui, &self.session)).inner;
        if let Some(click) = clicked {
            self.click(click, ui);
        }
        if self.save_bar.is_open() {
            let bar = |ui: &mut Ui| self.save_bar.show(ui, &self.session);
            Panel::top("save bar").frame(panel(8, 8)).show(ui, bar);
        }
        let height = nodes_panel::height(ui, self.session.state().nodes().len());
        let nodes = Panel::bottom("nodes").frame(panel(4, 8)).exact_size(height + 14.0);
        nodes.show(ui, |ui| nodes_panel::show(ui, &mut self.session));
        Panel::bottom("words").frame(panel(8, 12)).show(ui, |ui| words_panel::show(ui, &self.session));
        let area = ui.available_rect_before_wrap().shrink2(egui::vec2(2.0 * GRID, GRID));
        let size = self.session.header().size;
        let (left, right) = heroes(area, size.width() as f32 / size.height() as f32);
        let within = |rect: Rect| UiBuilder::new().max_rect(rect).layout(Layout::top_down(Align::Min));
        ui.scope_builder(within(left), |ui| self.picture.show(ui, &mut self.session));
        ui.scope_builder(within(right), |ui| ring_panel::show(ui, &self.session));
    }

    #[cfg(feature = "glow")]
    fn on_exit(&mut self, _gl: Option<&eframe::glow::Context>) {
        self.session.keep_log();
    }

    #[cfg(not(feature = "glow"))]
    fn on_exit(&mut self) {
        self.session.keep_log();
    }
}

/// Where the picture and the ring go: beside each other, as large as they get. `aspect` is the picture's width
/// divided by its height.
fn heroes(area: Rect, aspect: f32) -> (Rect, Rect) {
    const GAP: f32 = 3.0 * GRID;
    // The ring wants a little more breadth than height, for its labels.
    const RING: f32 = 1.15;
    let fair = (area.width() - GAP).max(0.0) * aspect / (aspect + RING);
    let highest = (area.height() - picture_panel::BELOW).max(0.0) * aspect;
    let split = area.left() + fair.min(highest);
    (area.with_max_x(split), area.with_min_x((split + GAP).min(area.right())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn picture_and_ring_share_the_area() {
        for size in [[1248.0, 470.0], [1888.0, 800.0], [650.0, 180.0], [300.0, 900.0], [10.0, 10.0]] {
            let area = Rect::from_min_size(egui::pos2(16.0, 60.0), size.into());
            let (picture, ring) = heroes(area, 4.0 / 3.0);
            assert!(area.contains_rect(picture) && area.contains_rect(ring), "{size:?}");
            assert!(picture.right() < ring.left() || ring.width() < 1.0);
            assert!(picture.width() * 0.75 <= (area.height() - picture_panel::BELOW).max(0.0) + 0.1);
        }
    }
}

//! The place of the save sheet: beside the panels of the run, or over a page or a narrow window.

use egui::{Area, Context, Frame, Id, Order, Panel, Rect, Stroke, Ui};

use super::{App, panel};
use crate::gui::panels::save_sheet::{self, SaveSubject};
use crate::gui::panels::setup;
use crate::gui::widgets::theme::{GRID, Look};

/// Least width of the panels of the run beside the sheet, in points.
const MIN_RUN_WIDTH_PT: f32 = 68.0 * GRID;
/// Window width below which the sheet covers all of the window, in points.
const NARROW_WINDOW_PT: f32 = 110.0 * GRID;

impl App {
    /// Whether the panels of the run have room beside the sheet. A page keeps its width, and the sheet lies over it.
    pub(super) fn has_room_for_sheet(&self, area: Rect) -> bool {
        let others = save_sheet::width(area.width()) + if self.setup.open { setup::WIDTH_PT + 4.0 * GRID } else { 0.0 };
        !self.shows_page() && area.width() - others >= MIN_RUN_WIDTH_PT
    }

    /// Closes the settings or the sheet, the one that was open before, where both have no room beside the run.
    pub(super) fn make_room_for_run(&mut self, ctx: &Context, keeps_sheet: bool) {
        let both = self.setup.open && self.save_sheet.is_open() && !self.shows_page();
        if !both || self.has_room_for_sheet(ctx.content_rect()) {
            return;
        }
        if keeps_sheet {
            self.setup.open = false;
        } else {
            self.save_sheet.close();
        }
    }

    /// Shows the sheet at the right of the other panels. Returns its width.
    pub(super) fn sheet_beside(&mut self, ui: &mut Ui) -> f32 {
        let width = save_sheet::width(ui.available_width());
        let place = Panel::right("save").frame(panel(8, 8)).exact_size(width).resizable(false);
        place.show(ui, |ui| self.sheet(ui));
        width
    }

    /// Shows the sheet over what is at the right of the area, or all of it in a narrow window.
    pub(super) fn sheet_over(&mut self, ctx: &Context, area: Rect) {
        let look = Look::of(ctx);
        let is_narrow = area.width() < NARROW_WINDOW_PT;
        let width = if is_narrow { area.width() } else { save_sheet::width(area.width()) };
        let rect = area.with_min_x(area.right() - width);
        let place = Area::new(Id::unique("save")).order(Order::Middle).fixed_pos(rect.min).constrain(false);
        place.default_size(rect.size()).show(ctx, |ui| {
            ui.painter().rect_filled(rect, 0.0, look.ground);
            ui.painter().vline(rect.left(), rect.y_range(), Stroke::new(1.0, look.hairline));
            let margin = Frame::NONE.inner_margin(panel(8, 8).inner_margin);
            margin.show(ui, |ui| {
                ui.set_min_size(rect.size() - margin.inner_margin.sum());
                ui.set_max_size(rect.size() - margin.inner_margin.sum());
                self.sheet(ui);
            });
        });
    }

    fn sheet(&mut self, ui: &mut Ui) {
        let subject = match self.compare.is_open() {
            true => SaveSubject::Comparison(self.compare.comparison()),
            false => SaveSubject::Run(self.picture.shown()),
        };
        if let Some(command) = self.save_sheet.show(ui, &mut self.session, &subject) {
            self.handle_command(command, ui.ctx());
        }
    }
}

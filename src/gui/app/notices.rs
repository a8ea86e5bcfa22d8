//! The place of the messages: nothing else is there.

use egui::{Panel, Rect, Ui};

use super::{App, panel};
use crate::gui::panels::notice::{self, NoticeAction};
use crate::gui::widgets::theme::GRID;

impl App {
    /// Returns the height that the messages need in a panel below others; 0 if there is none.
    pub(super) fn notice_height(&self, ui: &Ui) -> f32 {
        notice::height(ui, ui.available_width() - 4.0 * GRID, &self.session, self.lists_exports())
    }

    /// Shows the messages, if there are any, in a panel below the others.
    pub(super) fn notice_panel(&mut self, ui: &mut Ui) {
        let height = self.notice_height(ui);
        if height > 0.0 {
            let place = Panel::bottom("notice").frame(panel(6, 6)).exact_size(height + 12.0);
            place.show(ui, |ui| self.notices(ui, ui.available_rect_before_wrap()));
        }
    }

    /// Shows the messages in this area.
    pub(super) fn notices(&mut self, ui: &mut Ui, area: Rect) {
        match notice::show(ui, area, &self.session, self.lists_exports()) {
            Some(NoticeAction::Close) => self.session.close_notice(),
            Some(NoticeAction::Reload) => self.session.reload(),
            Some(NoticeAction::AlwaysReload) => {
                self.session.set_always_reload(true);
                self.session.reload();
            }
            Some(NoticeAction::CancelExport(job)) => self.session.cancel_export(job),
            Some(NoticeAction::CancelLoading) => self.session.cancel_loading(),
            None => {}
        }
    }

    /// Whether the progress of saving is one of the messages; the save sheet shows it otherwise.
    fn lists_exports(&self) -> bool {
        !self.save_sheet.is_open()
    }
}

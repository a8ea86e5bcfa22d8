//! The content of the window: places panels and pages, and passes commands and job results to them.

mod commands;
mod launch;
mod main_area_layout;
mod notices;
mod open_stack;
mod quitting;
mod repaint_schedule;
mod saving;
mod stored_path;
mod stored_state;

use std::time::Duration;

use eframe::Storage;
use egui::{Align, Context, Frame, Layout, Margin, Panel, Ui, UiBuilder};

use super::input::keys::{self, UserCommand};
use super::input::selection::Selection;
use super::input::{tab_order, zoom};
use super::pages::accuracy::Accuracy;
use super::pages::compare::Compare;
use super::pages::gallery::Gallery;
use super::pages::help::{self, HelpTab};
use super::pages::learn::Learn;
use super::panels::picture::PicturePanel;
use super::panels::save_sheet::SaveSheet;
use super::panels::setup::{self, SetupPanel};
use super::panels::time::{self, TimePanel};
use super::panels::timeline::{self, TimelinePanel};
use super::panels::{inspector, narration, nodes, notice, ring, top_bar};
use super::session::{DEMONSTRATION, JobResult, Purpose, Session};
use super::settings::Settings;
use super::widgets::number::RefusedNumber;
use super::widgets::test_positions;
use super::widgets::theme::{self, GRID, Look};
use crate::balance::NodeId;
use crate::language::say;
use crate::time::Time;
use crate::view::{Details, Highlight, Subject};
pub use launch::Launch;
use main_area_layout::{Split, split_main_area};
pub use open_stack::Closable;
use open_stack::OpenStack;
use quitting::Quitting;
use stored_state::StoredState;

/// The content of the window.
pub struct App {
    session: Session,
    picture: PicturePanel,
    time: TimePanel,
    save_sheet: SaveSheet,
    setup: SetupPanel,
    gallery: Gallery,
    accuracy: Accuracy,
    compare: Compare,
    learn: Learn,
    /// The open tab of the Help page.
    help: Option<HelpTab>,
    timeline: TimelinePanel,
    /// Whether the timeline replaces the table of machines, or in a lesson the ring.
    shows_timeline: bool,
    split: Split,
    selection: Selection,
    /// Details of the hovered subject.
    hovered: Option<Details>,
    /// Details of the selected subject.
    selected: Option<Details>,
    highlight: Highlight,
    /// While a lesson is open: whether the timeline was shown before it.
    timeline_before_lesson: Option<bool>,
    /// `Session::runs_begun` at the last frame.
    runs_begun: usize,
    /// Presentation mode: large text, strong colours, no controls.
    projector: bool,
    quitting: Quitting,
    open_stack: OpenStack,
}

/// Key of [`StoredState`] in eframe's storage.
const STORAGE_KEY: &str = "anel";

impl App {
    /// Restores the state from `storage` and opens a scene; its run starts as soon as the scene is compiled.
    pub fn new(ctx: &Context, storage: Option<&dyn Storage>, launch: Launch) -> Self {
        let stored: StoredState =
            storage.and_then(|storage| eframe::get_value(storage, STORAGE_KEY)).unwrap_or_default();
        let language = stored.language.unwrap_or(launch.language);
        theme::install(ctx);
        test_positions::install(ctx);
        zoom::install(ctx);
        tab_order::install(ctx);
        Look::set_strong(ctx, stored.projector);
        let settings = if stored.settings.check(language).is_ok() { stored.settings } else { Settings::default() };
        let mut session = Session::new(settings, launch.log, ctx, theme::rgb(Look::of(ctx).ground));
        session.set_language(language);
        session.set_always_reload(stored.always_reload);
        session.set_recent(stored.recent.iter().map(|path| stored_path::read(path)).collect());
        match (launch.opening, &stored.scene) {
            (Some(opening), _) => session.show(opening),
            (None, Some(scene)) => session.open(stored_path::read(scene)),
            (None, None) => session.open(DEMONSTRATION),
        }
        let mut picture = PicturePanel::default();
        picture.blend = stored.blend.unwrap_or(picture.blend).clamp(0.0, 100.0);
        Self {
            session,
            picture,
            time: TimePanel::default(),
            save_sheet: SaveSheet::new(stored.film),
            setup: SetupPanel::new(stored.is_setup_open),
            gallery: Gallery::default(),
            accuracy: Accuracy::default(),
            compare: Compare::default(),
            learn: Learn::default(),
            help: None,
            timeline: TimelinePanel::default(),
            shows_timeline: stored.shows_timeline,
            split: Split { share: stored.split.filter(|share| (0.0..1.0).contains(share)) },
            selection: Selection::default(),
            hovered: None,
            selected: None,
            highlight: Highlight::default(),
            timeline_before_lesson: None,
            runs_begun: 0,
            projector: stored.projector,
            quitting: Quitting::default(),
            open_stack: OpenStack::default(),
        }
    }

    /// Returns the session, for tests.
    pub fn session(&self) -> &Session {
        &self.session
    }

    /// Returns how many qualities the Accuracy page has measured, for tests.
    pub fn points_measured(&self) -> usize {
        self.accuracy.points()
    }

    /// Returns names and makespans of the compared runs, for tests.
    pub fn compared(&self) -> Vec<(String, Option<Duration>)> {
        self.compare.runs()
    }

    /// Returns the open lesson and its step, for tests.
    pub fn lesson(&self) -> Option<(&str, usize)> {
        self.learn.step()
    }

    /// Returns the selected machine, for tests.
    pub fn selected(&self) -> Option<NodeId> {
        self.selection.node()
    }

    /// Shows the run at `time`, for tests.
    pub fn seek(&mut self, time: Time) {
        self.session.stage_mut().seek(time, true);
    }

    /// Returns the selected subject, for tests.
    pub fn selection(&self) -> Option<Subject> {
        self.selection.selected
    }

    /// Opens the first file that was dropped on the window.
    fn take_dropped(&mut self, ctx: &Context) {
        let language = self.session.language();
        let dropped = ctx.input(|input| input.raw.dropped_files.clone());
        let Some(first) = dropped.first().map(|file| file.path().to_owned()) else { return };
        self.gallery.close();
        self.session.open(&first);
        if dropped.len() > 1 {
            let name = first.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let count = dropped.len();
            self.session.note(say!(
                language,
                "Only the first of {count} files is opened: {name}",
                "Só o primeiro de {count} arquivos é aberto: {name}"
            ));
        }
    }

    /// Shows the top bar and, below it, the open page or the panels of the run, and the save sheet if it is open.
    fn panels(&mut self, ui: &mut Ui) {
        self.session.stage_mut().hides_later = self.learn.is_on();
        self.bar(ui);
        let area = ui.available_rect_before_wrap();
        if !self.save_sheet.is_open() {
            self.page_or_run(ui, 0.0);
        } else if self.has_room_for_sheet(area) {
            let width = self.sheet_beside(ui);
            self.page_or_run(ui, width);
        } else {
            self.page_or_run(ui, 0.0);
            self.sheet_over(ui.ctx(), area);
        }
    }

    /// Shows the open page, or the panels of the run beside a save sheet of this width.
    fn page_or_run(&mut self, ui: &mut Ui, sheet: f32) {
        let language = self.session.language();
        if self.shows_page() {
            self.notice_panel(ui);
            let area = ui.available_rect_before_wrap().shrink2(egui::vec2(2.0 * GRID, GRID));
            ui.scope_builder(UiBuilder::new().max_rect(area), |ui| {
                if self.gallery.is_open() {
                    self.gallery.show(ui, &mut self.session);
                } else if self.learn.is_open() {
                    if self.learn.show(ui, &mut self.session, self.projector) {
                        self.handle_command(UserCommand::Projector, ui.ctx());
                    }
                } else if self.compare.is_open() {
                    self.compare.show(ui, &mut self.session);
                } else {
                    self.accuracy.show(ui, &mut self.session);
                }
            });
            return;
        }
        if self.setup.open {
            let panel = Panel::left("setup").frame(panel(8, 8)).exact_size(setup::WIDTH_PT).resizable(false);
            panel.show(ui, |ui| self.setup.show(ui, &mut self.session));
        }
        self.update_highlight();
        let lesson = self.learn.height(ui, ui.available_width() - 4.0 * GRID, language);
        let notice = self.notice_height(ui);
        let words = |notice: f32| lesson.unwrap_or_else(|| narration::height(ui, notice));
        let (height, usual) = (words(notice), words(0.0));
        // The audience of a projector only looks; its presenter uses keys.
        if (self.shows_timeline || !self.projector) && lesson.is_none() {
            self.machines(ui, ui.available_height() - usual - time::HEIGHT_PT, sheet);
        }
        let words = Panel::bottom("words").frame(panel(8, 10)).exact_size(height + 18.0);
        let command = words.show(ui, |ui| {
            if lesson.is_some() {
                self.learn.show_step(ui, &mut self.session);
                return None;
            }
            let (place, command) = narration::show(ui, &self.session, self.selected.as_ref(), notice);
            self.notices(ui, place);
            command
        });
        if let Some(command) = command.inner {
            self.handle_command(command, ui.ctx());
        }
        if lesson.is_some() {
            self.notice_panel(ui);
        }
        // A low window has no room for the time bar beside a lesson, and a lesson has its own buttons.
        let is_tight = lesson.is_some() && ui.ctx().content_rect().height() < 560.0;
        if !(self.projector || is_tight) || self.time.is_finding() {
            let time = Panel::bottom("time").frame(panel(4, 4)).exact_size(time::HEIGHT_PT + 8.0);
            let row = |ui: &mut Ui| self.time.show(ui, &mut self.session, self.shows_timeline);
            if let Some(command) = time.show(ui, row).inner {
                self.handle_command(command, ui.ctx());
            }
        }
        self.main_area(ui, sheet);
    }

    /// Shows the top bar.
    fn bar(&mut self, ui: &mut Ui) {
        if !self.projector {
            let open = top_bar::OpenPages {
                scenes: self.gallery.is_open(),
                accuracy: self.accuracy.is_open(),
                compare: self.compare.is_open(),
                learn: self.learn.is_open() || self.learn.is_on(),
                setup: self.setup.open,
                save: self.save_sheet.is_open(),
            };
            let bar = |ui: &mut Ui| top_bar::show(ui, &self.session, open);
            if let Some(command) = Panel::top("top bar").frame(panel(8, 8)).show(ui, bar).inner {
                self.handle_command(command, ui.ctx());
            }
        }
    }

    /// Shows the table of machines, or the timeline. `room` is the height for it and for picture and ring, `sheet` the
    /// width of the save sheet beside them.
    fn machines(&mut self, ui: &mut Ui, room: f32, sheet: f32) {
        /// Margins of all panels.
        const MARGINS_PT: f32 = 58.0;
        /// Margins of this panel.
        const OWN_MARGINS_PT: f32 = 14.0;
        let (room, whole) = (room - MARGINS_PT, ui.ctx().content_rect().height());
        let nodes = self.session.header().speeds.len();
        let usual = if self.shows_timeline {
            timeline::height(ui, nodes)
        } else {
            // The save sheet does not change the height, so that the picture stays where it is.
            nodes::height(ui, ui.available_width() + sheet, nodes, room - 0.5 * whole)
        };
        let usual = usual + OWN_MARGINS_PT;
        let height = self.split.height(ui, usual, room + OWN_MARGINS_PT);
        let below = Panel::bottom("nodes").frame(panel(4, 8)).exact_size(height);
        let below = below.show(ui, |ui| {
            if self.shows_timeline {
                self.timeline(ui);
            } else {
                nodes::show(ui, &mut self.session, &mut self.selection, &self.highlight);
            }
        });
        self.split.drag(ui, below.response.rect, self.session.language());
    }

    /// Leaves the camera alone in a lesson, whose runs are recorded, and brings the table of machines back after it.
    fn begin_or_end_lesson(&mut self) {
        if !self.learn.is_on() {
            self.shows_timeline = self.timeline_before_lesson.take().unwrap_or(self.shows_timeline);
        } else if self.timeline_before_lesson.is_none() {
            self.timeline_before_lesson = Some(self.shows_timeline);
            self.picture.moves_camera = false;
        }
    }

    fn timeline(&mut self, ui: &mut Ui) {
        let hovered = self.hovered.as_ref();
        self.timeline.show(ui, &mut self.session, &mut self.selection, &self.highlight, hovered);
    }

    /// Looks up the hovered and the selected subject, and what to highlight for them in this frame.
    fn update_highlight(&mut self) {
        let language = self.session.language();
        let nodes = self.session.header().speeds.len();
        if self.runs_begun != self.session.runs_begun() {
            self.runs_begun = self.session.runs_begun();
            self.timeline.reset();
            (self.hovered, self.selected) = (None, None);
            // The next run has the same machines, but other atoms and messages.
            self.selection.selected =
                self.selection.node().filter(|node| usize::from(*node) < nodes).map(Subject::Node);
        }
        self.selection.begin_frame();
        let stage = self.session.stage_mut();
        let pairs = [(&mut self.hovered, self.selection.hovered()), (&mut self.selected, self.selection.selected)];
        for (details, subject) in pairs {
            // Details change until the subject's atom is traced or its message has arrived.
            let is_final = |details: &Details| Some(details.subject) == subject && details.is_complete();
            if !details.as_ref().is_some_and(is_final) {
                *details = subject.map(|subject| stage.details(subject, language));
            }
        }
        let details = self.hovered.as_ref().or(self.selected.as_ref());
        self.highlight = details.map(|details| details.highlight(stage.state())).unwrap_or_default();
    }

    /// Shows the picture and, beside it, the ring or the inspector. In a lesson the timeline takes the place of the
    /// ring: a lesson's text leaves no room below the picture, and its machines have nothing to set.
    fn main_area(&mut self, ui: &mut Ui, sheet: f32) {
        let area = ui.available_rect_before_wrap().shrink2(egui::vec2(2.0 * GRID, GRID));
        // In less height both would be cut off.
        if area.height() < 7.0 * GRID {
            return;
        }
        let size = self.session.header().size;
        let (left, right) = split_main_area(area, size.width() as f32 / size.height() as f32, sheet);
        let within = |rect| UiBuilder::new().max_rect(rect).layout(Layout::top_down(Align::Min));
        ui.scope_builder(within(left), |ui| {
            self.picture.show(ui, &mut self.session, &mut self.selection, &self.highlight)
        });
        if let Some(right) = right {
            ui.scope_builder(within(right), |ui| match self.session.inspected_pixel() {
                Some(pixel) => inspector::show(ui, pixel, &mut self.session),
                None if self.shows_timeline && self.learn.is_on() => self.timeline(ui),
                None => ring::show(ui, &mut self.session, &mut self.selection, &self.highlight),
            });
        }
    }
}

impl eframe::App for App {
    fn logic(&mut self, ctx: &Context, frame: &mut eframe::Frame) {
        let language = self.session.language();
        self.take_dropped(ctx);
        for done in self.session.tick(ctx.input(|input| input.time)) {
            match done {
                JobResult::Chosen(Purpose::Save, chosen) => self.save_sheet.take_chosen(chosen, language),
                JobResult::Chosen(Purpose::Learn, chosen) => self.learn.take_chosen(chosen, &mut self.session),
                JobResult::Chosen(Purpose::Open, chosen) => self.gallery.take_chosen(chosen, &mut self.session),
                JobResult::Found(job, finding) => self.accuracy.take(job, finding, &mut self.session),
                JobResult::LessonOpened(lesson) => self.learn.open(lesson, &mut self.session),
                JobResult::LessonPrepared(job, prepared) => self.learn.take(job, prepared, &mut self.session),
                JobResult::Compared(job, result) => self.compare.take(job, result),
                JobResult::ExportPreviewed(job, made) => self.save_sheet.take_preview(ctx, job, made),
                JobResult::Thumbnail(scene, made) => self.gallery.take_thumbnail(ctx, &scene, made),
                _ => {}
            }
        }
        self.close_when_written(ctx);
        self.begin_or_end_lesson();
        if let Some(selected) = self.learn.tick(&mut self.session) {
            self.selection.selected = selected;
            self.shows_timeline = self.learn.wants_timeline().unwrap_or(self.shows_timeline);
        }
        if !ctx.input(|input| input.pointer.any_down()) {
            self.session.end_gesture();
        }
        repaint_schedule::schedule(ctx, &self.session, frame.info().cpu_usage);
    }

    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        let language = self.session.language();
        zoom::update(ui.ctx(), self.projector);
        // While the save sheet is open, letters belong to its field, even if it does not have the focus.
        let is_typing = ui.ctx().text_edit_focused() || self.save_sheet.is_open();
        for command in keys::pressed(ui.ctx(), is_typing) {
            self.handle_command(command, ui.ctx());
        }
        ui.painter().rect_filled(ui.max_rect(), 0.0, Look::of(ui.ctx()).ground);
        self.panels(ui);
        if let Some(refused) = RefusedNumber::take(ui.ctx()) {
            self.session.trouble(refused.sentence(language));
        }
        self.ask_to_quit(ui.ctx());
        if self.help.as_mut().is_some_and(|tab| help::show(ui.ctx(), tab, language)) {
            self.help = None;
        }
        if !ui.input(|input| input.raw.hovered_files.is_empty()) {
            notice::drop_here(ui, language);
        }
        self.update_open_stack(ui.ctx());
    }

    fn save(&mut self, storage: &mut dyn Storage) {
        eframe::set_value(storage, STORAGE_KEY, &self.stored());
    }

    #[cfg(feature = "glow")]
    fn on_exit(&mut self, _gl: Option<&eframe::glow::Context>) {
        self.session.save_log_on_exit();
    }

    #[cfg(not(feature = "glow"))]
    fn on_exit(&mut self) {
        self.session.save_log_on_exit();
    }
}

/// Returns the frame of a panel with these margins above and below its content, in points.
fn panel(top: i8, bottom: i8) -> Frame {
    let side = 2 * GRID as i8;
    Frame::NONE.inner_margin(Margin { left: side, right: side, top, bottom })
}

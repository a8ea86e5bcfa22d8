//! The window's content: which panel goes where.

pub(crate) mod repaint_schedule;

mod commands;
mod main_area_layout;
mod notices;

use std::time::Duration;

use eframe::Storage;
use egui::{Align, Context, Frame, Layout, Margin, Panel, Rect, Ui, UiBuilder};
use serde::{Deserialize, Serialize};

use super::Launch;
use super::input::keys;
use super::input::selection::Selection;
use super::input::zoom;
use super::pages::accuracy::Accuracy;
use super::pages::compare::Compare;
use super::pages::gallery::Gallery;
use super::pages::help;
use super::pages::learn::Learn;
use super::panels::picture::PicturePanel;
use super::panels::save_bar::{SaveBar, SaveSubject};
use super::panels::setup::{self, SetupPanel};
use super::panels::time::{self, TimePanel};
use super::panels::timeline::{self, TimelinePanel};
use super::panels::{inspector, narration, nodes, notice, ring, top_bar};
use super::session::{JobResult, Purpose, Session};
use super::settings::Settings;
use super::widgets::test_positions;
use super::widgets::theme::{self, GRID, Look};
use crate::balance::NodeId;
use crate::language::{Language, say};
use crate::time::Time;
use crate::view::{Details, Highlight, Subject};
use main_area_layout::heroes;

/// The window's content.
pub struct App {
    session: Session,
    picture: PicturePanel,
    time: TimePanel,
    save_bar: SaveBar,
    setup: SetupPanel,
    gallery: Gallery,
    accuracy: Accuracy,
    compare: Compare,
    learn: Learn,
    help: bool,
    timeline: TimelinePanel,
    /// The timeline stands in the machines' place.
    shows_timeline: bool,
    focus: Selection,
    /// Of what the pointer is on, and of what is selected.
    hovered: Option<Details>,
    selected: Option<Details>,
    lit: Highlight,
    /// Where words about the run stand, if they do in this frame.
    words: Option<Rect>,
    begun: usize,
    /// Large, in strong colours, and nothing but what is looked at.
    projector: bool,
}

/// What is remembered from one window to the next, beside what egui itself remembers.
#[derive(Default, Serialize, Deserialize)]
#[serde(default)]
struct Remembered {
    settings: Settings,
    scene: Option<String>,
    recent: Vec<String>,
    blend: Option<f64>,
    setup: bool,
    timeline: bool,
    language: Option<Language>,
    projector: bool,
}

const REMEMBERED: &str = "anel";

impl App {
    /// The window's content, with what `storage` remembers; a run starts as soon as its scene is compiled.
    pub fn new(ctx: &Context, storage: Option<&dyn Storage>, launch: Launch) -> Self {
        let remembered: Remembered =
            storage.and_then(|storage| eframe::get_value(storage, REMEMBERED)).unwrap_or_default();
        let language = remembered.language.unwrap_or(launch.language);
        theme::install(ctx);
        test_positions::install(ctx);
        zoom::install(ctx);
        Look::set_strong(ctx, remembered.projector);
        let settings =
            if remembered.settings.check(language).is_ok() { remembered.settings } else { Settings::default() };
        let mut session = Session::new(settings, launch.log, ctx, theme::rgb(Look::of(ctx).ground));
        session.set_language(language);
        session.set_recent(remembered.recent);
        match (launch.opening, &remembered.scene) {
            (Some(opening), _) => session.show(opening),
            (None, Some(scene)) => session.open(scene),
            (None, None) => session.open("ten-objects"),
        }
        let mut picture = PicturePanel::default();
        picture.blend = remembered.blend.unwrap_or(picture.blend).clamp(0.0, 100.0);
        Self {
            session,
            picture,
            time: TimePanel::default(),
            save_bar: SaveBar::default(),
            setup: SetupPanel::new(remembered.setup),
            gallery: Gallery::default(),
            accuracy: Accuracy::default(),
            compare: Compare::default(),
            learn: Learn::default(),
            help: false,
            timeline: TimelinePanel::default(),
            shows_timeline: remembered.timeline,
            focus: Selection::default(),
            hovered: None,
            selected: None,
            lit: Highlight::default(),
            words: None,
            begun: 0,
            projector: remembered.projector,
        }
    }

    /// What is shown, for tests.
    pub fn session(&self) -> &Session {
        &self.session
    }

    /// Of how many qualities it is known what they cost, for tests.
    pub fn points_measured(&self) -> usize {
        self.accuracy.points()
    }

    /// What is compared, for tests.
    pub fn compared(&self) -> Vec<(String, Option<Duration>)> {
        self.compare.runs()
    }

    /// The lesson that is taken and its step, for tests.
    pub fn lesson(&self) -> Option<(&str, usize)> {
        self.learn.step()
    }

    /// The selected machine, for tests.
    pub fn selected(&self) -> Option<NodeId> {
        self.focus.node()
    }

    /// Shows another moment, for tests.
    pub fn seek(&mut self, time: Time) {
        self.session.stage_mut().seek(time, true);
    }

    /// What is selected, for tests.
    pub fn focus(&self) -> Option<Subject> {
        self.focus.selected
    }

    fn take_dropped(&mut self, ctx: &Context) {
        let language = self.session.language();
        let dropped = ctx.input(|input| input.raw.dropped_files.clone());
        let Some(first) = dropped.first().map(|file| file.path().to_owned()) else { return };
        self.gallery.close();
        self.session.open(&first.to_string_lossy());
        if dropped.len() > 1 {
            let name = first.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let many = dropped.len();
            self.session.note(say!(
                language,
                "{many} files were dropped; {name} is opened",
                "{many} arquivos foram soltos; {name} é aberto"
            ));
        }
    }

    fn panels(&mut self, ui: &mut Ui) {
        let language = self.session.language();
        self.session.stage_mut().hides_later = self.learn.is_on();
        self.words = None;
        self.bars(ui);
        if self.shows_page() {
            let area = ui.available_rect_before_wrap().shrink2(egui::vec2(2.0 * GRID, GRID));
            ui.scope_builder(UiBuilder::new().max_rect(area), |ui| {
                if self.gallery.is_open() {
                    self.gallery.show(ui, &mut self.session);
                } else if self.learn.is_open() {
                    self.learn.show(ui, &mut self.session);
                } else if self.compare.is_open() {
                    self.compare.show(ui, &mut self.session);
                } else {
                    self.accuracy.show(ui, &mut self.session);
                }
            });
            return;
        }
        if self.setup.open {
            let panel = Panel::left("setup").frame(panel(8, 8)).exact_size(setup::WIDTH).resizable(false);
            panel.show(ui, |ui| self.setup.show(ui, &mut self.session));
        }
        self.light();
        // What stands on a wall is looked at; hands are at the keys.
        if self.shows_timeline || !self.projector {
            self.machines(ui);
        }
        let lesson = self.learn.height(ui, ui.available_width() - 4.0 * GRID, language);
        let height = lesson.unwrap_or_else(|| narration::height(ui));
        let words = Panel::bottom("words").frame(panel(8, 10)).exact_size(height + 18.0);
        let words = words.show(ui, |ui| {
            if lesson.is_some() {
                self.learn.show_step(ui, &mut self.session);
            } else {
                narration::show(ui, &self.session, self.selected.as_ref());
            }
        });
        self.words = Some(words.response.rect);
        // Beside a lesson a low window has no room for it, and the lesson's own buttons lead on.
        let is_tight = lesson.is_some() && ui.ctx().content_rect().height() < 560.0;
        if !(self.projector || is_tight) || self.time.is_finding() {
            let time = Panel::bottom("time").frame(panel(4, 4)).exact_size(time::HEIGHT + 8.0);
            let row = |ui: &mut Ui| self.time.show(ui, &mut self.session, self.shows_timeline);
            if let Some(command) = time.show(ui, row).inner {
                self.handle_command(command, ui.ctx());
            }
        }
        self.heroes(ui);
    }

    /// The bar at the top, and what is opened from there.
    fn bars(&mut self, ui: &mut Ui) {
        if !self.projector {
            let open = top_bar::Open {
                scenes: self.gallery.is_open(),
                accuracy: self.accuracy.is_open(),
                compare: self.compare.is_open(),
                learn: self.learn.is_open() || self.learn.is_on(),
                setup: self.setup.open,
                save: self.save_bar.is_open(),
            };
            let bar = |ui: &mut Ui| top_bar::show(ui, &self.session, open);
            if let Some(command) = Panel::top("top bar").frame(panel(8, 8)).show(ui, bar).inner {
                self.handle_command(command, ui.ctx());
            }
        }
        if self.save_bar.is_open() {
            let subject = match self.compare.is_open() {
                true => SaveSubject::Comparison(self.compare.comparison()),
                false => SaveSubject::Run(self.picture.shown()),
            };
            let bar = |ui: &mut Ui| self.save_bar.show(ui, &mut self.session, &subject);
            if let Some(command) = Panel::top("save bar").frame(panel(8, 8)).show(ui, bar).inner {
                self.handle_command(command, ui.ctx());
            }
        }
    }

    /// Machines, or their timeline.
    fn machines(&mut self, ui: &mut Ui) {
        let nodes = self.session.header().speeds.len();
        let height = if self.shows_timeline {
            timeline::height(ui, nodes, self.learn.is_on())
        } else {
            nodes::height(ui, nodes)
        };
        let below = Panel::bottom("nodes").frame(panel(4, 8)).exact_size(height + 14.0);
        below.show(ui, |ui| {
            if self.shows_timeline {
                let hovered = self.hovered.as_ref();
                self.timeline.show(ui, &mut self.session, &mut self.focus, &self.lit, hovered);
            } else {
                nodes::show(ui, &mut self.session, &mut self.focus, &self.lit);
            }
        });
    }

    /// Finds what stands out in this frame.
    fn light(&mut self) {
        let language = self.session.language();
        let nodes = self.session.header().speeds.len();
        if self.begun != self.session.runs_begun() {
            self.begun = self.session.runs_begun();
            self.timeline.begin();
            (self.hovered, self.selected) = (None, None);
            // A machine is the same one in the next run; atoms and messages are others.
            self.focus.selected = self.focus.node().filter(|node| usize::from(*node) < nodes).map(Subject::Node);
        }
        self.focus.begin();
        let stage = self.session.stage_mut();
        let known = [(&mut self.hovered, self.focus.hovered()), (&mut self.selected, self.focus.selected)];
        for (dossier, about) in known {
            // What is not over yet is looked up again.
            let is_known = |dossier: &Details| Some(dossier.subject) == about && dossier.is_complete();
            if !dossier.as_ref().is_some_and(is_known) {
                *dossier = about.map(|about| stage.dossier(about, language));
            }
        }
        let lit = self.hovered.as_ref().or(self.selected.as_ref());
        self.lit = lit.map(|dossier| dossier.highlight(stage.state())).unwrap_or_default();
    }

    fn heroes(&mut self, ui: &mut Ui) {
        let area = ui.available_rect_before_wrap().shrink2(egui::vec2(2.0 * GRID, GRID));
        // Rather not at all than cut.
        if area.height() < 7.0 * GRID {
            return;
        }
        let size = self.session.header().size;
        let (left, right) = heroes(area, size.width() as f32 / size.height() as f32);
        let within = |rect: Rect| UiBuilder::new().max_rect(rect).layout(Layout::top_down(Align::Min));
        ui.scope_builder(within(left), |ui| self.picture.show(ui, &mut self.session, &mut self.focus, &self.lit));
        ui.scope_builder(within(right), |ui| match self.session.inspected_place() {
            Some(place) => inspector::show(ui, place, &mut self.session),
            None => ring::show(ui, &mut self.session, &mut self.focus, &self.lit),
        });
    }
}

impl eframe::App for App {
    fn logic(&mut self, ctx: &Context, frame: &mut eframe::Frame) {
        let language = self.session.language();
        self.take_dropped(ctx);
        for done in self.session.tick(ctx.input(|input| input.time)) {
            match done {
                JobResult::Chosen(Purpose::Save, chosen) => self.save_bar.take_in(chosen, language),
                JobResult::Chosen(Purpose::Learn, chosen) => self.learn.take_chosen(chosen, &mut self.session),
                JobResult::Chosen(Purpose::Open, chosen) => self.gallery.take_chosen(chosen, &mut self.session),
                JobResult::Found(job, finding) => self.accuracy.take(job, finding, &mut self.session),
                JobResult::ToTeach(lesson) => self.learn.open(lesson, &mut self.session),
                JobResult::Lesson(job, taught) => self.learn.take(job, taught, &mut self.session),
                JobResult::CompareResult(job, compared) => self.compare.take(job, compared),
                JobResult::Thumbnail(scene, made) => self.gallery.take_thumbnail(ctx, &scene, made),
                _ => {}
            }
        }
        if let Some(points) = self.learn.tick(&mut self.session) {
            self.focus.selected = points;
            self.shows_timeline = self.learn.wants_timeline().unwrap_or(self.shows_timeline);
        }
        if !ctx.input(|input| input.pointer.any_down()) {
            self.session.let_go();
        }
        repaint_schedule::schedule(ctx, &self.session, frame.info().cpu_usage);
    }

    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        let language = self.session.language();
        zoom::keys(ui.ctx());
        let types = ui.ctx().text_edit_focused();
        // Whoever is about to type a path means letters, wherever the focus is just then.
        let types = types || self.save_bar.is_open() || self.gallery.is_open();
        for command in keys::pressed(ui.ctx(), types) {
            self.handle_command(command, ui.ctx());
        }
        ui.painter().rect_filled(ui.max_rect(), 0.0, Look::of(ui.ctx()).ground);
        self.panels(ui);
        self.notices(ui.ctx());
        if self.help && help::show(ui.ctx(), language) {
            self.help = false;
        }
        if !ui.input(|input| input.raw.hovered_files.is_empty()) {
            notice::drop_here(ui, language);
        }
    }

    fn save(&mut self, storage: &mut dyn Storage) {
        let scene = self.session.opened().and_then(|opened| match &opened.path {
            Some(path) => std::path::absolute(path).ok().map(|path| path.to_string_lossy().into_owned()),
            None => crate::scene::built_in(&opened.name).map(|_| opened.name.clone()),
        });
        let remembered = Remembered {
            settings: self.session.settings().clone(),
            scene,
            recent: self.session.recent().to_vec(),
            blend: Some(self.picture.blend),
            setup: self.setup.open,
            timeline: self.shows_timeline,
            language: Some(self.session.language()),
            projector: self.projector,
        };
        eframe::set_value(storage, REMEMBERED, &remembered);
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

/// A panel's frame, with so much room above and below.
fn panel(top: i8, bottom: i8) -> Frame {
    let side = 2 * GRID as i8;
    Frame::NONE.inner_margin(Margin { left: side, right: side, top, bottom })
}

//! What happens when something is asked for, by a key or by a button.

use egui::{Context, Theme, ViewportCommand};

use super::App;
use crate::gui::input::keys::UserCommand;
use crate::gui::settings::undo::Gesture;
use crate::gui::widgets::theme::Look;
use crate::language::{say, word};
use crate::time::Time;
use crate::view::{StepUnit, Subject, node_name};

impl App {
    pub(super) fn handle_command(&mut self, command: UserCommand, ctx: &Context) {
        let language = self.session.language();
        // A clicker knows forward and back.
        if let (true, false, UserCommand::Dolly(back)) = (self.projector, self.learn.is_on(), command) {
            let forward = if back { UserCommand::Beginning } else { UserCommand::Pause };
            return self.handle_command(forward, ctx);
        }
        if self.compare.is_open() && !self.gallery.is_open() && self.compare.handle_command(command) {
            return;
        }
        let covers_lessons = self.gallery.is_open() || self.accuracy.is_open() || self.compare.is_open();
        if !covers_lessons && self.learn.handle_command(command, &mut self.session) {
            return;
        }
        if let (true, UserCommand::Select(number)) = (self.time.is_finding(), command) {
            if let Some(jump) = self.time.choose(number.into()) {
                self.handle_command(jump, ctx);
            }
            return;
        }
        let session = &mut self.session;
        match command {
            UserCommand::Pause => session.toggle_pause(),
            UserCommand::Restart => {
                session.restart();
                session.end_notice();
            }
            UserCommand::StepUnit(by, forward) => session.step(by, forward),
            UserCommand::Rate(faster) => session.stage_mut().change_rate(if faster { 1 } else { -1 }),
            UserCommand::SetRate(index) => session.stage_mut().set_rate(index),
            UserCommand::Live => {
                session.stage_mut().follow();
                // What was looked at is past, and what happens now is to be read.
                self.focus.selected = self.focus.node().map(Subject::Node);
            }
            UserCommand::Beginning => session.stage_mut().seek(Time::ZERO, true),
            UserCommand::Find => self.time.toggle_find(),
            UserCommand::Jump(records, about) => {
                session.stage_mut().show_after(records);
                self.focus.selected = Some(about);
            }
            UserCommand::Timeline => self.shows_timeline = !self.shows_timeline,
            UserCommand::Zoom(nearer) => {
                self.shows_timeline = true;
                self.timeline.zoom(if nearer { 0.5 } else { 2.0 }, self.session.stage().lasted());
            }
            UserCommand::Copy => {
                ctx.copy_image(session.copied_picture(self.picture.shown()));
                session.note(word!(
                    language,
                    "The picture is in the clipboard",
                    "A imagem está na área de transferência"
                ));
            }
            UserCommand::Save => self.save_bar.toggle(session),
            UserCommand::SaveRun => self.save_bar.open_for_run(session),
            UserCommand::Scenes => {
                self.accuracy.close(session);
                self.compare.close(session);
                self.learn.close();
                self.gallery.toggle(session);
            }
            UserCommand::Accuracy => {
                self.gallery.close();
                self.learn.close();
                self.compare.close(session);
                self.accuracy.toggle(session);
            }
            UserCommand::Learn => {
                self.gallery.close();
                self.accuracy.close(session);
                self.compare.close(session);
                self.learn.toggle();
            }
            UserCommand::Compare => {
                self.learn.close();
                self.gallery.close();
                self.accuracy.close(session);
                self.compare.toggle(session);
            }
            UserCommand::Reload => session.reload(),
            UserCommand::Setup => self.setup.open = !self.setup.open,
            UserCommand::Undo => session.undo(),
            UserCommand::Redo => session.redo(),
            UserCommand::Select(node) if usize::from(node) < session.header().speeds.len() => {
                self.focus.toggle(Subject::Node(node));
            }
            UserCommand::Select(node) => {
                let name = node_name(node);
                session.note(say!(language, "There is no machine {name}", "Não há máquina {name}"));
            }
            UserCommand::Faster | UserCommand::Slower | UserCommand::PauseNode | UserCommand::Put(_) => {
                self.obey_for_node(command)
            }
            UserCommand::Camera => self.picture.moves_camera = !self.picture.moves_camera,
            UserCommand::CameraHome => session.camera_home(),
            UserCommand::Dolly(nearer) => {
                session.move_camera(|camera| camera.dolly(if nearer { 0.9 } else { 1.0 / 0.9 }))
            }
            UserCommand::Arrow([right, down]) if self.picture.moves_camera => {
                session.move_camera(|camera| camera.orbit(f64::from(5 * right), f64::from(-5 * down)));
            }
            UserCommand::Arrow(by) if session.inspected_place().is_some() => session.inspect_beside(by),
            UserCommand::Arrow([right, 0]) => session.step(StepUnit::Event, right > 0),
            UserCommand::Arrow(_) => {}
            UserCommand::Layer => self.picture.next_layer(),
            UserCommand::Outlines => self.picture.outlines = !self.picture.outlines,
            UserCommand::Theme => {
                ctx.set_theme(if ctx.theme() == Theme::Dark { Theme::Light } else { Theme::Dark });
            }
            UserCommand::Language => {
                session.set_language(session.language().other());
                // Their texts are in the other language.
                (self.hovered, self.selected) = (None, None);
            }
            UserCommand::FullScreen => {
                let full = ctx.input(|input| input.viewport().fullscreen.unwrap_or(false));
                ctx.send_viewport_cmd(ViewportCommand::Fullscreen(!full));
            }
            UserCommand::Projector => self.project(!self.projector, ctx),
            UserCommand::Help => self.help = !self.help,
            UserCommand::Back => self.back(ctx),
            UserCommand::Quit => ctx.send_viewport_cmd(ViewportCommand::Close),
        }
    }

    /// Whether a page lies over the picture and the ring.
    pub(super) fn shows_page(&self) -> bool {
        self.gallery.is_open() || self.accuracy.is_open() || self.compare.is_open() || self.learn.is_open()
    }

    /// Shows it for a room, or for whoever sits before it.
    fn project(&mut self, projector: bool, ctx: &Context) {
        /// How much larger everything is for a room.
        const LARGER: f32 = 1.5;
        self.projector = projector;
        self.session.end_notice();
        if projector {
            // What is asked for from now on is shown nevertheless.
            self.setup.open = false;
            self.save_bar.close();
        }
        Look::set_strong(ctx, projector);
        let zoom = ctx.zoom_factor();
        ctx.set_zoom_factor(if projector { zoom * LARGER } else { zoom / LARGER });
        ctx.send_viewport_cmd(ViewportCommand::Fullscreen(projector));
    }

    fn obey_for_node(&mut self, command: UserCommand) {
        let language = self.session.language();
        let Some(node) = self.focus.node() else {
            return self.session.note(word!(
                language,
                "First select a machine: press its number, or click it",
                "Selecionar antes uma máquina: pressionar seu número, ou clicar nela"
            ));
        };
        if command == UserCommand::PauseNode {
            return self.session.toggle_node_pause(node);
        }
        if let UserCommand::Put(condition) = command {
            return self.session.toggle_condition(node, condition);
        }
        let now = self.session.speed(node);
        // To the next tenth, or to one of the low speeds at which a machine is felt.
        let mut steps = [0.0, 0.01, 0.05].into_iter().chain((1..=10).map(|tenth| f64::from(tenth) / 10.0));
        let speed = match command {
            UserCommand::Faster => steps.find(|&step| step > now + 0.001).unwrap_or(1.0),
            _ => steps.take_while(|&step| step < now - 0.001).last().unwrap_or(0.0),
        };
        self.session.change(Gesture::Once, |settings| settings.set_speed(node, speed));
    }

    /// Whatever was opened last goes away.
    fn back(&mut self, ctx: &Context) {
        if self.help {
            self.help = false;
        } else if self.time.is_finding() {
            self.time.toggle_find();
        } else if self.gallery.is_open() {
            self.gallery.close();
        } else if self.accuracy.is_open() {
            self.accuracy.close(&mut self.session);
        } else if self.compare.is_open() {
            self.compare.close(&mut self.session);
        } else if self.learn.is_open() {
            self.learn.close();
        } else if self.save_bar.is_open() {
            self.save_bar.close();
        } else if self.session.notice().is_some() {
            self.session.close_notice();
        } else if self.session.inspected_place().is_some() {
            self.session.stop_inspecting();
        } else if self.projector {
            self.project(false, ctx);
        } else if self.picture.moves_camera {
            self.picture.moves_camera = false;
        } else if self.picture.is_zoomed() {
            self.picture.show_all();
        } else if self.focus.selected.is_some() {
            self.focus.selected = None;
        } else {
            self.learn.leave(&mut self.session);
        }
    }
}

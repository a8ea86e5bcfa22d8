//! What happens when something is asked for, by a key or by a button.

use egui::{Context, Theme, ViewportCommand};

use super::App;
use crate::gui::input::keys::Command;
use crate::gui::settings::undo::Gesture;
use crate::gui::widgets::theme::Look;
use crate::language::{say, word};
use crate::time::Time;
use crate::view::{About, Step, node_name};

impl App {
    pub(super) fn obey(&mut self, command: Command, ctx: &Context) {
        // A clicker knows forward and back.
        if let (true, false, Command::Dolly(back)) = (self.projector, self.learn.is_on(), command) {
            let forward = if back { Command::Beginning } else { Command::Pause };
            return self.obey(forward, ctx);
        }
        if self.compare.is_open() && !self.gallery.is_open() && self.compare.obey(command) {
            return;
        }
        let covers_lessons = self.gallery.is_open() || self.accuracy.is_open() || self.compare.is_open();
        if !covers_lessons && self.learn.obey(command, &mut self.session) {
            return;
        }
        if let (true, Command::Select(number)) = (self.time.is_finding(), command) {
            if let Some(jump) = self.time.choose(number.into()) {
                self.obey(jump, ctx);
            }
            return;
        }
        let session = &mut self.session;
        match command {
            Command::Pause => session.toggle_pause(),
            Command::Restart => {
                session.restart();
                session.end_notice();
            }
            Command::Step(by, forward) => session.step(by, forward),
            Command::Rate(faster) => session.stage_mut().change_rate(if faster { 1 } else { -1 }),
            Command::SetRate(index) => session.stage_mut().set_rate(index),
            Command::Live => {
                session.stage_mut().follow();
                // What was looked at is past, and what happens now is to be read.
                self.focus.selected = self.focus.node().map(About::Node);
            }
            Command::Beginning => session.stage_mut().seek(Time::ZERO, true),
            Command::Find => self.time.toggle_find(),
            Command::Jump(records, about) => {
                session.stage_mut().show_after(records);
                self.focus.selected = Some(about);
            }
            Command::Timeline => self.shows_timeline = !self.shows_timeline,
            Command::Zoom(nearer) => {
                self.shows_timeline = true;
                self.timeline.zoom(if nearer { 0.5 } else { 2.0 }, self.session.stage().lasted());
            }
            Command::Copy => {
                ctx.copy_image(session.copied_picture(self.picture.shown()));
                session.note(word!("The picture is in the clipboard", "A imagem está na área de transferência"));
            }
            Command::Save => self.save_bar.toggle(session),
            Command::SaveRun => self.save_bar.open_for_run(session),
            Command::Scenes => {
                self.accuracy.close(session);
                self.compare.close(session);
                self.learn.close();
                self.gallery.toggle(session);
            }
            Command::Accuracy => {
                self.gallery.close();
                self.learn.close();
                self.compare.close(session);
                self.accuracy.toggle(session);
            }
            Command::Learn => {
                self.gallery.close();
                self.accuracy.close(session);
                self.compare.close(session);
                self.learn.toggle();
            }
            Command::Compare => {
                self.learn.close();
                self.gallery.close();
                self.accuracy.close(session);
                self.compare.toggle(session);
            }
            Command::Reload => session.reload(),
            Command::Setup => self.setup.open = !self.setup.open,
            Command::Undo => session.undo(),
            Command::Redo => session.redo(),
            Command::Select(node) if usize::from(node) < session.header().speeds.len() => {
                self.focus.toggle(About::Node(node));
            }
            Command::Select(node) => {
                let name = node_name(node);
                session.note(say!("There is no machine {name}", "Não há máquina {name}"));
            }
            Command::Faster | Command::Slower | Command::PauseNode | Command::Put(_) => self.obey_for_node(command),
            Command::Camera => self.picture.moves_camera = !self.picture.moves_camera,
            Command::CameraHome => session.camera_home(),
            Command::Dolly(nearer) => session.move_camera(|camera| camera.dolly(if nearer { 0.9 } else { 1.0 / 0.9 })),
            Command::Arrow([right, down]) if self.picture.moves_camera => {
                session.move_camera(|camera| camera.orbit(f64::from(5 * right), f64::from(-5 * down)));
            }
            Command::Arrow(by) if session.inspected_place().is_some() => session.inspect_beside(by),
            Command::Arrow([right, 0]) => session.step(Step::Event, right > 0),
            Command::Arrow(_) => {}
            Command::Layer => self.picture.next_layer(),
            Command::Outlines => self.picture.outlines = !self.picture.outlines,
            Command::Theme => {
                ctx.set_theme(if ctx.theme() == Theme::Dark { Theme::Light } else { Theme::Dark });
            }
            Command::Language => {
                self.language = self.language.other();
                self.language.speak();
                // They are told anew.
                (self.hovered, self.selected) = (None, None);
            }
            Command::FullScreen => {
                let full = ctx.input(|input| input.viewport().fullscreen.unwrap_or(false));
                ctx.send_viewport_cmd(ViewportCommand::Fullscreen(!full));
            }
            Command::Projector => self.project(!self.projector, ctx),
            Command::Help => self.help = !self.help,
            Command::Back => self.back(ctx),
            Command::Quit => ctx.send_viewport_cmd(ViewportCommand::Close),
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

    fn obey_for_node(&mut self, command: Command) {
        let Some(node) = self.focus.node() else {
            return self.session.note(word!(
                "First select a machine: press its number, or click it",
                "Selecionar antes uma máquina: pressionar seu número, ou clicar nela"
            ));
        };
        if command == Command::PauseNode {
            return self.session.toggle_node_pause(node);
        }
        if let Command::Put(condition) = command {
            return self.session.toggle_condition(node, condition);
        }
        let now = self.session.speed(node);
        // To the next tenth, or to one of the low speeds at which a machine is felt.
        let mut steps = [0.0, 0.01, 0.05].into_iter().chain((1..=10).map(|tenth| f64::from(tenth) / 10.0));
        let speed = match command {
            Command::Faster => steps.find(|&step| step > now + 0.001).unwrap_or(1.0),
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

//! Executes the commands of keys and buttons.

use egui::{Context, Theme, ViewportCommand};

use super::App;
use crate::gui::input::keys::UserCommand;
use crate::gui::pages::help::HelpTab;
use crate::gui::settings::speed_steps::next_speed;
use crate::gui::settings::undo::Gesture;
use crate::gui::widgets::theme::Look;
use crate::language::{say, word};
use crate::time::Time;
use crate::view::{StepUnit, Subject, node_name};

impl App {
    /// Executes a command; an open page or lesson gets it first.
    pub(super) fn handle_command(&mut self, command: UserCommand, ctx: &Context) {
        let language = self.session.language();
        // While the list of keys is open, any other key closes it and does what the list says.
        let is_of_help = matches!(command, UserCommand::Help | UserCommand::Words);
        if !is_of_help && !matches!(command, UserCommand::Back | UserCommand::Quit) {
            self.help = None;
        }
        // A presenter's remote control sends only Page Down and Page Up.
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
                session.end_notices();
            }
            UserCommand::RestartRecovering => session.restart_recovering(),
            UserCommand::Step(by, forward) => session.step(by, forward),
            UserCommand::Rate(faster) => session.stage_mut().change_rate(if faster { 1 } else { -1 }),
            UserCommand::SetRate(index) => session.stage_mut().set_rate(index),
            UserCommand::Live => {
                session.stage_mut().follow();
                // A selected atom or message belongs to the past; its text would hide the narration of the present.
                self.selection.selected = self.selection.node().map(Subject::Node);
            }
            UserCommand::Beginning => session.stage_mut().seek(Time::ZERO, true),
            UserCommand::Find => self.time.toggle_find(),
            UserCommand::Jump(records, subject) => {
                session.stage_mut().show_after(records);
                self.selection.selected = Some(subject);
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
                    "The picture is copied to the clipboard",
                    "A imagem foi copiada para a área de transferência"
                ));
            }
            UserCommand::Save => {
                self.save_sheet.toggle(session);
                self.make_room_for_run(ctx, true);
            }
            UserCommand::SaveRun => {
                self.save_sheet.open_for_run(session);
                self.make_room_for_run(ctx, true);
            }
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
            UserCommand::Setup => {
                self.setup.open = !self.setup.open;
                self.make_room_for_run(ctx, false);
            }
            UserCommand::Undo => session.undo(),
            UserCommand::Redo => session.redo(),
            UserCommand::Select(node) if usize::from(node) < session.header().speeds.len() => {
                self.selection.toggle(Subject::Node(node));
            }
            UserCommand::Select(node) => {
                let name = node_name(node);
                session.note(say!(
                    language,
                    "This run has no machine {name}",
                    "Esta execução não tem a máquina {name}"
                ));
            }
            UserCommand::Faster | UserCommand::Slower | UserCommand::PauseNode | UserCommand::ToggleCondition(_) => {
                self.handle_machine_command(command)
            }
            UserCommand::Camera => self.picture.moves_camera = !self.picture.moves_camera,
            UserCommand::CameraHome => session.reset_camera(),
            UserCommand::Dolly(nearer) => {
                session.move_camera(|camera| camera.dolly(if nearer { 0.9 } else { 1.0 / 0.9 }))
            }
            UserCommand::Arrow([right, down]) if self.picture.moves_camera => {
                session.move_camera(|camera| camera.orbit(f64::from(5 * right), f64::from(-5 * down)));
            }
            UserCommand::Arrow(by) if session.inspected_pixel().is_some() => session.inspect_beside(by),
            UserCommand::Arrow([right, 0]) => session.step(StepUnit::Event, right > 0),
            UserCommand::Arrow(_) => {}
            UserCommand::Layer => self.picture.next_layer(),
            UserCommand::Outlines => self.picture.outlines = !self.picture.outlines,
            UserCommand::Theme => {
                ctx.set_theme(if ctx.theme() == Theme::Dark { Theme::Light } else { Theme::Dark });
            }
            UserCommand::Language => {
                session.set_language(session.language().other());
                // Their texts are still in the old language.
                (self.hovered, self.selected) = (None, None);
            }
            UserCommand::FullScreen => {
                let full = ctx.input(|input| input.viewport().fullscreen.unwrap_or(false));
                ctx.send_viewport_cmd(ViewportCommand::Fullscreen(!full));
            }
            UserCommand::Projector => self.set_projector(!self.projector, ctx),
            UserCommand::Help => self.toggle_help(HelpTab::Keys),
            UserCommand::Words => self.toggle_help(HelpTab::Words),
            UserCommand::Back => self.close_innermost(ctx),
            UserCommand::Quit => ctx.send_viewport_cmd(ViewportCommand::Close),
        }
    }

    /// Opens the Help page with this tab, or closes it if it shows the tab.
    fn toggle_help(&mut self, tab: HelpTab) {
        self.help = (self.help != Some(tab)).then_some(tab);
    }

    /// Whether a page replaces the picture and the ring.
    pub(super) fn shows_page(&self) -> bool {
        self.gallery.is_open() || self.accuracy.is_open() || self.compare.is_open() || self.learn.is_open()
    }

    /// Switches presentation mode on or off.
    pub(super) fn set_projector(&mut self, projector: bool, ctx: &Context) {
        self.projector = projector;
        self.session.end_notices();
        if projector {
            // They can be opened again in presentation mode.
            self.setup.open = false;
            self.save_sheet.close();
        }
        Look::set_strong(ctx, projector);
        ctx.send_viewport_cmd(ViewportCommand::Fullscreen(projector));
    }

    /// Executes a command for the selected machine.
    fn handle_machine_command(&mut self, command: UserCommand) {
        let language = self.session.language();
        let Some(node) = self.selection.node() else {
            return self.session.note(word!(
                language,
                "First select a machine: press its number or click it",
                "Primeiro selecione uma máquina: pressione seu número ou clique nela"
            ));
        };
        if command == UserCommand::PauseNode {
            return self.session.toggle_node_pause(node);
        }
        if let UserCommand::ToggleCondition(condition) = command {
            return self.session.toggle_condition(node, condition);
        }
        let now = self.session.speed(node);
        let speed = next_speed(now, command == UserCommand::Faster);
        self.session.change(Gesture::Once, |settings| settings.set_speed(node, speed));
    }
}

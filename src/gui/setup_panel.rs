//! What can be set, at the left: what acts at once, and what starts the run anew.

use egui::{ComboBox, Label, RichText, ScrollArea, Ui, WidgetInfo};

use super::history::Gesture;
use super::session::Session;
use super::settings::{Preset, Settings, Tempo};
use super::theme::{self, GRID, Look};
use super::widgets::{Weight, button, choice, number, slider};
use crate::balance::Strategy;
use crate::picture::Size;
use crate::view::count;

/// How wide the panel is, in points.
pub const WIDTH: f32 = 36.0 * GRID;

/// The sizes that are offered; any other can be typed.
const SIZES: [(u32, u32); 6] = [(320, 240), (640, 480), (800, 600), (1280, 960), (1280, 720), (1920, 1080)];

/// The panel.
pub struct SetupPanel {
    /// Whether it is shown.
    pub open: bool,
    /// What is set, with what the hand has changed and not let go of yet.
    draft: Option<Settings>,
}

impl SetupPanel {
    /// The panel, shown or not.
    pub fn new(open: bool) -> Self {
        Self { open, draft: None }
    }

    /// Shows the panel.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session) {
        let look = Look::of(ui.ctx());
        if session.is_recorded() {
            return recorded(ui, session, look);
        }
        let mut draft = self.draft.take().unwrap_or_else(|| session.settings().clone());
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            ui.set_width(ui.available_width() - GRID);
            ui.spacing_mut().item_spacing.y = GRID / 2.0;
            heading(ui, "Takes effect at once", look);
            at_once(ui, &mut draft, look);
            ui.add_space(GRID);
            heading(ui, "Starts the run anew", look);
            anew(ui, &mut draft, look);
            ui.add_space(GRID);
            if button(ui, None, "Back to the demonstration", true, Weight::Quiet)
                .on_hover_text("Everything here as it was at first")
                .clicked()
            {
                draft = Settings::default();
            }
        });
        // What needs a restart waits until the hand lets go of it.
        let busy = ui.input(|input| input.pointer.any_down()) || ui.ctx().egui_wants_keyboard_input();
        if busy && draft.needs_restart(session.settings()) {
            self.draft = Some(draft);
        } else if draft != *session.settings() {
            let gesture = if draft.latency == session.settings().latency { Gesture::Once } else { Gesture::Latency };
            session.change(gesture, |settings| *settings = draft);
        }
    }
}

/// Of a recorded run nothing can be changed.
fn recorded(ui: &mut Ui, session: &mut Session, look: Look) {
    heading(ui, "A recorded run", look);
    let text = "It is played as it was recorded. Made live, its scene is traced anew with what was set then, and everything \
                can be changed.";
    ui.add(Label::new(RichText::new(text).font(theme::regular(theme::BODY)).color(look.quiet)).wrap());
    if button(ui, None, "Make it live", true, Weight::Primary).clicked() {
        session.make_live();
    }
}

/// The width of an exact value.
const VALUE: f32 = 12.0 * GRID;

fn at_once(ui: &mut Ui, draft: &mut Settings, look: Look) {
    let width = ui.available_width();
    let on = Preset::ALL.into_iter().find(|preset| draft.has_preset(*preset));
    egui::Grid::new("presets").spacing([GRID / 2.0, GRID / 2.0]).show(ui, |ui| {
        for (i, preset) in Preset::ALL.into_iter().enumerate() {
            let weight = if on == Some(preset) { Weight::On } else { Weight::Quiet };
            if button(ui, None, preset.name(), true, weight).on_hover_text(preset.hint()).clicked() {
                draft.set_preset(preset);
            }
            if i % 2 == 1 {
                ui.end_row();
            }
        }
    });
    line(ui, "Random seed", look, |ui| {
        let before = draft.seed;
        number(ui, &mut draft.seed, 0..=999_999, "", VALUE, "Seed");
        if draft.seed != before {
            draft.set_preset(Preset::Random);
        }
    });
    line(ui, "Latency of a hop", look, |ui| {
        number(ui, &mut draft.latency, 0..=Settings::MOST_LATENCY, " ms", VALUE, "Latency in milliseconds");
    });
    // Most of what is of interest lies below half a second.
    let mut root = f64::from(draft.latency).sqrt();
    let most = f64::from(Settings::MOST_LATENCY).sqrt();
    if slider(ui, &mut root, (0.0..=most, false), width - GRID, look.accent, "Latency slider").changed() {
        draft.latency = (root * root).round() as u32;
    }
}

fn anew(ui: &mut Ui, draft: &mut Settings, look: Look) {
    let width = ui.available_width();
    let mut nodes = draft.speeds.len() as u32;
    line(ui, "Machines", look, |ui| {
        number(ui, &mut nodes, 1..=Settings::MOST_NODES as u32, "", VALUE, "Number of machines");
    });
    let mut dragged = f64::from(nodes);
    slider(ui, &mut dragged, (1.0..=Settings::MOST_NODES as f64, true), width - GRID, look.accent, "Machines slider");
    nodes = dragged as u32;
    if nodes as usize != draft.speeds.len() {
        draft.set_nodes(nodes as usize);
    }
    line(ui, "Strategy", look, |ui| {
        let all = [
            // From right to left.
            (Strategy::Serial, "Serial", "The first machine traces all; the others do nothing"),
            (Strategy::Ring, "Ring", "Whoever is done offers help round the ring"),
        ];
        if let Some(strategy) = choice(ui, draft.strategy, &all) {
            draft.strategy = strategy;
        }
    });
    ui.add_enabled_ui(draft.strategy == Strategy::Ring, |ui| {
        line(ui, "Smallest parcel", look, |ui| {
            let suffix = if draft.part == 1 { " atom" } else { " atoms" };
            number(ui, &mut draft.part, 1..=10_000, suffix, VALUE, "Least atoms worth sending");
        });
    });
    line(ui, "Size", look, |ui| {
        // From right to left.
        let combo = ComboBox::from_id_salt("size").selected_text("usual").width(0.0);
        let combo = combo.show_ui(ui, |ui| {
            for (width, height) in SIZES {
                let size = Size::new(width, height).unwrap_or(draft.size);
                ui.selectable_value(&mut draft.size, size, size.to_string());
            }
        });
        combo.response.widget_info(|| WidgetInfo::labeled(egui::Role::ComboBox, true, "Usual sizes"));
        let (mut width, mut height) = (draft.size.width(), draft.size.height());
        number(ui, &mut height, 16..=Settings::LONGEST_SIDE, "", 6.0 * GRID, "Height in pixels");
        ui.label(RichText::new("×").font(theme::regular(theme::BODY)).color(look.quiet));
        number(ui, &mut width, 16..=Settings::LONGEST_SIDE, "", 6.0 * GRID, "Width in pixels");
        if let Ok(size) = Size::new(width, height) {
            draft.size = size;
        }
    });
    line(ui, "Samples a pixel", look, |ui| {
        let suffix = format!(" × {}", draft.samples);
        number(ui, &mut draft.samples, 1..=Settings::MOST_SAMPLES, &suffix, VALUE, "Samples");
    });
    line(ui, "An atom is", look, |ui| {
        number(ui, &mut draft.atom, 1..=100_000, " pixels", VALUE, "Pixels in an atom");
    });
    line(ui, "That makes", look, |ui| {
        let text = format!("{} atoms", count(draft.division().atoms()));
        ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(look.text));
    });
    line(ui, "Pace", look, |ui| {
        let seconds = if let Tempo::Lasts(seconds) = draft.tempo { seconds } else { 20 };
        let all = [
            (Tempo::Full, "Full speed", "As fast as this computer can: a machine at 100 % never waits"),
            (Tempo::Lasts(seconds), "Slowly", "So that everybody can follow"),
        ];
        if let Some(tempo) = choice(ui, draft.tempo, &all) {
            draft.tempo = tempo;
        }
    });
    if let Tempo::Lasts(seconds) = &mut draft.tempo {
        line(ui, "The run takes about", look, |ui| {
            number(ui, seconds, 1..=Settings::LONGEST_RUN, " s", VALUE, "Seconds of the run");
        });
    }
}

fn heading(ui: &mut Ui, text: &str, look: Look) {
    ui.label(RichText::new(text).font(theme::strong(theme::BODY)).color(look.text));
}

/// A line of a name and, at its right end, what is called so.
fn line(ui: &mut Ui, name: &str, look: Look, content: impl FnOnce(&mut Ui)) {
    ui.horizontal(|ui| {
        ui.label(RichText::new(name).font(theme::regular(theme::BODY)).color(look.quiet));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), content);
    });
}

//! The settings at the left: machines, network, and picture.

mod own_links;
mod sharing;

use egui::{ComboBox, Event, Key, Label, Popup, PopupCloseBehavior, RichText, ScrollArea, Ui, WidgetInfo};

use crate::gui::session::Session;
use crate::gui::settings::Settings;
use crate::gui::settings::latency_steps::{next_latency, round_latency};
use crate::gui::settings::pace::Pace;
use crate::gui::settings::speed_preset::SpeedPreset;
use crate::gui::settings::undo::Gesture;
use crate::gui::widgets::explained::explained;
use crate::gui::widgets::slider::{Scale, slider, wheel_steps};
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button, choice_buttons, number_field, popup_frame};
use crate::language::{Language, comma, say, word};
use crate::picture::{Quality, Size};
use crate::view::{Definition, count, two_digits};

/// Width of the panel, in points.
pub const WIDTH_PT: f32 = 36.0 * GRID;

/// Usual sizes of the picture; others can be typed.
const SIZES: [(u32, u32); 6] = [(320, 240), (640, 480), (800, 600), (1280, 960), (1280, 720), (1920, 1080)];

/// Thresholds of the list: a pixel gets no more samples when its estimated error is at most this; with 0 it gets all.
const THRESHOLDS: [f64; 6] = [0.0, 0.05, 0.02, 0.01, 0.005, 0.002];

/// Cutoffs of the list: greatest sum of the weights of the rays that are left out of a sample.
const CUTOFFS: [f64; 6] = [0.0, 1e-4, 1e-3, 1.0 / 255.0, 0.02, 0.1];

/// The settings panel.
pub struct SetupPanel {
    /// Whether it is open.
    pub open: bool,
    /// The settings with a change whose gesture has not ended.
    draft: Option<Settings>,
    /// When the gesture of the wheel or of the arrow keys ends, by egui's clock in seconds.
    ends_at: f64,
    /// Whether the panel scrolls, so that the wheel does not change a number under the mouse.
    scrolls: bool,
}

/// Seconds after the last step of the wheel or of an arrow key until its change restarts the run.
const STEPS_END_S: f64 = 0.4;

impl SetupPanel {
    /// Creates the panel, open or closed.
    pub fn new(open: bool) -> Self {
        Self { open, draft: None, ends_at: 0.0, scrolls: false }
    }

    /// Shows the panel.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session) {
        let language = session.language();
        let look = Look::of(ui.ctx());
        if session.is_recorded() {
            return recorded(ui, session, look);
        }
        let mut is_demonstration = false;
        let mut draft = self.draft.take().unwrap_or_else(|| session.settings().clone());
        let (takes_wheel, before) = (!self.scrolls, draft.clone());
        let area = ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            ui.set_width(ui.available_width() - GRID);
            // With these distances everything is visible in a window of 1280 × 800.
            ui.spacing_mut().item_spacing.y = 2.0;
            ui.spacing_mut().interact_size.y = 3.5 * GRID;
            machines(ui, &mut draft, takes_wheel, look, language);
            ui.add_space(0.5 * GRID);
            network(ui, &mut draft, takes_wheel, look, language);
            ui.add_space(0.5 * GRID);
            let restarts = word!(language, "restarts the run", "reinicia a execução");
            heading(ui, word!(language, "The picture", "A imagem"), restarts, look);
            picture(ui, &mut draft, look, language);
            pace(ui, &mut draft, look, language);
            if session.always_reloads() {
                always_reload(ui, session, look, language);
            }
            ui.add_space(GRID);
            let name = word!(language, "Back to the demonstration", "Voltar à demonstração");
            let hint = word!(
                language,
                "Restore the first settings, scene and camera",
                "Restaurar os primeiros ajustes, a cena e a câmera"
            );
            is_demonstration = button(ui, None, name, true, Emphasis::Quiet).on_hover_text(hint).clicked();
        });
        self.scrolls = area.content_size.y > area.inner_rect.height() + 1.0;
        if is_demonstration {
            return session.show_demonstration();
        }
        // A change that needs a restart waits for the end of its gesture.
        let now = ui.input(|input| input.time);
        if draft != before && ui.input(|input| input.events.iter().any(is_step)) {
            self.ends_at = now + STEPS_END_S;
            ui.ctx().request_repaint_after_secs(STEPS_END_S as f32);
        }
        let is_busy = ui.input(|input| input.pointer.any_down()) || now < self.ends_at;
        if is_busy && draft.needs_restart(session.settings()) {
            self.draft = Some(draft);
        } else if draft != *session.settings() {
            let of = |settings: &Settings| (settings.latency, settings.own_links.clone(), settings.parent_link);
            let gesture = if of(&draft) == of(session.settings()) { Gesture::Once } else { Gesture::Latency };
            session.change(gesture, |settings| *settings = draft);
        }
    }
}

/// Whether this is a step of the wheel or of an arrow key, which others may follow.
fn is_step(event: &Event) -> bool {
    match event {
        Event::MouseWheel { .. } => true,
        Event::Key { key, pressed, .. } => {
            *pressed && matches!(key, Key::ArrowUp | Key::ArrowDown | Key::ArrowLeft | Key::ArrowRight)
        }
        _ => false,
    }
}

/// Shows the check box that takes back the answer *Always* to a changed scene.
fn always_reload(ui: &mut Ui, session: &mut Session, look: Look, language: Language) {
    let mut always = true;
    let text = word!(language, "Reload a changed scene at once", "Recarregar a cena que mudou");
    ui.checkbox(&mut always, RichText::new(text).font(theme::regular(theme::SMALL)).color(look.quiet));
    session.set_always_reload(always);
}

/// Shows the panel for a recorded run, whose settings are fixed.
fn recorded(ui: &mut Ui, session: &mut Session, look: Look) {
    let language = session.language();
    heading(ui, word!(language, "A recorded run", "Uma execução gravada"), "", look);
    let text = word!(
        language,
        "A recorded run cannot be changed. Make it live: then its scene is traced again with the same settings, and \
        you can change all of them.",
        "Uma execução gravada não pode ser mudada. Execute-a ao vivo: sua cena é calculada de novo com os mesmos \
        ajustes, e todos podem ser mudados."
    );
    ui.add(Label::new(RichText::new(text).font(theme::regular(theme::BODY)).color(look.quiet)).wrap());
    if button(ui, None, word!(language, "Make it live", "Executar ao vivo"), true, Emphasis::Primary).clicked() {
        session.make_live();
    }
}

/// Width of a number field, in points.
const VALUE_WIDTH_PT: f32 = 12.0 * GRID;

/// Shows the settings of the machines: their speeds, their number, and how they share the work.
fn machines(ui: &mut Ui, draft: &mut Settings, takes_wheel: bool, look: Look, language: Language) {
    let (name, at_once) =
        word!(language, ("Machines", "speeds at once, rest restarts"), ("Máquinas", "velocidade já, resto reinicia"));
    heading(ui, name, at_once, look);
    let on = SpeedPreset::ALL.into_iter().find(|preset| draft.has_preset(*preset));
    egui::Grid::new("presets").spacing([GRID / 2.0, GRID / 2.0]).show(ui, |ui| {
        for (i, preset) in SpeedPreset::ALL.into_iter().enumerate() {
            let emphasis = if on == Some(preset) { Emphasis::On } else { Emphasis::Quiet };
            if button(ui, None, preset.name(language), true, emphasis).on_hover_text(preset.hint(language)).clicked() {
                draft.set_preset(preset);
            }
            if i % 2 == 1 {
                ui.end_row();
            }
        }
    });
    labelled_row(ui, word!(language, "Random seed", "Semente aleatória"), look, |ui| {
        let before = draft.seed;
        number_field(
            ui,
            &mut draft.seed,
            0..=999_999,
            "",
            VALUE_WIDTH_PT,
            (word!(language, "Seed", "Semente"), language),
        );
        if draft.seed != before {
            draft.set_preset(SpeedPreset::Random);
        }
    });
    number_of_machines(ui, draft, takes_wheel, look, language);
    sharing::sharing(ui, draft, look, language);
}

/// Shows the settings of the network: latency, the parent's time for a message, and bandwidth.
fn network(ui: &mut Ui, draft: &mut Settings, takes_wheel: bool, look: Look, language: Language) {
    let (width, max) = (ui.available_width(), Settings::MAX_LATENCY_MS);
    let (name, at_once) =
        word!(language, ("Network", "latency at once, rest restarts"), ("Rede", "latência já, resto reinicia"));
    heading(ui, name, at_once, look);
    let hop = word!(language, "Latency of a hop", "Latência de um salto");
    let mut steps = 0;
    labelled_row(ui, (hop, Definition::LATENCY, language), look, |ui| {
        let (name, all) = (word!(language, "Latency in milliseconds", "Latência em milissegundos"), 0.0..=max);
        let field = number_field(ui, &mut draft.latency, all, " ms", VALUE_WIDTH_PT, (name, language));
        if field.dragged() {
            draft.latency = round_latency(draft.latency);
        }
        steps += wheel_steps(ui, &field);
    });
    // A square root, because latencies below half a second matter most.
    let mut root = draft.latency.sqrt();
    let name = word!(language, "Latency slider", "Controle da latência");
    let bar = slider(ui, &mut root, Scale::Linear(0.0, max.sqrt()), width - GRID, look.accent, name);
    steps += wheel_steps(ui, &bar);
    let presses = |key| ui.input(|input| input.num_presses(key) as i32);
    let keys = if bar.has_focus() { presses(Key::ArrowRight) - presses(Key::ArrowLeft) } else { 0 };
    if keys != 0 || steps != 0 && takes_wheel {
        let steps = keys + if takes_wheel { steps } else { 0 };
        let stepped = (0..steps.abs()).fold(draft.latency, |latency, _| next_latency(latency, steps > 0));
        draft.latency = stepped.min(max);
    } else if bar.changed() {
        draft.latency = round_latency(root * root);
    }
    sharing::network(ui, draft, look, language);
}

/// Shows the number of machines.
fn number_of_machines(ui: &mut Ui, draft: &mut Settings, takes_wheel: bool, look: Look, language: Language) {
    let (width, max) = (ui.available_width(), Settings::MAX_NODES as u32);
    let mut nodes = draft.speeds.len() as u32;
    let mut steps = 0;
    labelled_row(ui, (word!(language, "How many", "Quantas"), Definition::MACHINE, language), look, |ui| {
        let name = word!(language, "Number of machines", "Número de máquinas");
        let field = number_field(ui, &mut nodes, 1..=max, "", VALUE_WIDTH_PT, (name, language));
        steps += wheel_steps(ui, &field);
    });
    let mut dragged = f64::from(nodes);
    let name = word!(language, "Machines slider", "Controle das máquinas");
    let bar = slider(ui, &mut dragged, Scale::Whole(1.0, f64::from(max)), width - GRID, look.accent, name);
    steps += wheel_steps(ui, &bar);
    nodes = (dragged as u32).saturating_add_signed(if takes_wheel { steps } else { 0 }).clamp(1, max);
    if nodes as usize != draft.speeds.len() {
        draft.set_nodes(nodes as usize);
    }
}

/// Shows the settings of the picture.
fn picture(ui: &mut Ui, draft: &mut Settings, look: Look, language: Language) {
    high_row(ui, word!(language, "Size", "Tamanho"), look, |ui| {
        // The layout runs from right to left.
        let combo = ComboBox::from_id_salt("size").selected_text(word!(language, "usual", "…")).width(0.0);
        let combo = combo.show_ui(ui, |ui| {
            for (width, height) in SIZES {
                let size = Size::new(width, height).unwrap_or(draft.size);
                ui.selectable_value(&mut draft.size, size, size.to_string());
            }
        });
        let name = word!(language, "Usual sizes", "Tamanhos usuais");
        combo.response.widget_info(|| WidgetInfo::labeled(egui::Role::ComboBox, true, name));
        let (mut width, mut height) = (draft.size.width(), draft.size.height());
        let [wide, high] =
            word!(language, ["Width in pixels", "Height in pixels"], ["Largura em pixels", "Altura em pixels"]);
        number_field(ui, &mut height, 16..=Settings::MAX_SIDE_PX, "", 5.5 * GRID, (high, language));
        ui.label(RichText::new("×").font(theme::regular(theme::BODY)).color(look.quiet));
        number_field(ui, &mut width, 16..=Settings::MAX_SIDE_PX, "", 5.5 * GRID, (wide, language));
        if let Ok(size) = Size::new(width, height) {
            draft.size = size;
        }
    });
    let name = word!(language, "Samples", "Amostras");
    labelled_row(ui, name, look, |ui| {
        let samples = &mut draft.quality.samples;
        let suffix = format!(" × {samples}");
        number_field(ui, samples, 1..=Settings::MAX_SAMPLES, &suffix, 9.0 * GRID, (name, language));
        let hint = word!(language, "More settings of quality and speed", "Mais ajustes de qualidade e velocidade");
        let more = button(ui, None, word!(language, "Quality…", "Mais…"), true, Emphasis::Quiet).on_hover_text(hint);
        let popup = Popup::from_toggle_button_response(&more).frame(popup_frame(ui.ctx()).inner_margin(1.5 * GRID));
        popup.close_behavior(PopupCloseBehavior::CloseOnClickOutside).show(|ui| {
            ui.set_width(44.0 * GRID);
            quality(ui, &mut draft.quality, look, language);
        });
    });
    labelled_row(ui, (word!(language, "An atom has", "Um átomo tem"), Definition::ATOM, language), look, |ui| {
        let name = word!(language, "Pixels in an atom", "Pixels num átomo");
        number_field(ui, &mut draft.atom, 1..=100_000, " pixels", VALUE_WIDTH_PT, (name, language));
    });
    let atoms = count(draft.division().atoms());
    explanation(ui, &say!(language, "The picture has {atoms} atoms", "A imagem tem {atoms} átomos"), look);
}

/// Shows the settings of quality that are seldom changed.
fn quality(ui: &mut Ui, quality: &mut Quality, look: Look, language: Language) {
    if quality.samples > 1 {
        let threshold_text = |error: f64| {
            let least = comma(language, error.to_string());
            if error > 0.0 {
                say!(language, "until the estimated error is {least}", "até o erro estimado ser {least}")
            } else {
                word!(language, "in every pixel", "em cada pixel").into()
            }
        };
        let name = word!(language, "When a pixel has enough samples", "Quando um pixel tem amostras suficientes");
        labelled_row(ui, word!(language, "All samples", "Todas as amostras"), look, |ui| {
            value_list(ui, &mut quality.threshold, &THRESHOLDS, name, threshold_text)
        });
    }
    labelled_row(ui, word!(language, "Tree of rays", "Árvore de raios"), look, |ui| {
        let (suffix, name) =
            word!(language, (" levels", "Levels of the tree of rays"), (" níveis", "Níveis da árvore de raios"));
        number_field(ui, &mut quality.max_depth, 1..=Quality::MAX_DEPTH, suffix, VALUE_WIDTH_PT, (name, language));
    });
    let cutoff_text = |cutoff: f64| {
        let max = two_digits(100.0 * cutoff, language);
        if cutoff > 0.0 {
            say!(language, "up to {max} % of a pixel", "até {max} % de um pixel")
        } else {
            word!(language, "none", "nenhum").into()
        }
    };
    let name = word!(language, "Weak rays left out", "Raios fracos omitidos");
    labelled_row(ui, name, look, |ui| value_list(ui, &mut quality.cutoff, &CUTOFFS, name, cutoff_text));
}

/// Shows a list of values; the present value may be another one.
fn value_list(ui: &mut Ui, value: &mut f64, all: &[f64], name: &str, text: impl Fn(f64) -> String) {
    let combo = ComboBox::from_id_salt(name).selected_text(text(*value)).width(26.0 * GRID);
    let combo = combo.show_ui(ui, |ui| {
        for &one in all {
            ui.selectable_value(value, one, text(one));
        }
    });
    combo.response.widget_info(|| WidgetInfo::labeled(egui::Role::ComboBox, true, name));
}

/// Shows the settings of the pace.
fn pace(ui: &mut Ui, draft: &mut Settings, look: Look, language: Language) {
    high_row(ui, (word!(language, "Pace", "Ritmo"), Definition::PACE, language), look, |ui| {
        let seconds = if let Pace::Lasts(seconds) = draft.pace { seconds } else { 20.0 };
        let full = word!(
            language,
            "As fast as this computer: a machine at 100 % never waits",
            "Tão rápido quanto este computador: uma máquina a 100 % nunca espera"
        );
        let slowly = word!(language, "Slow enough to follow the run", "Devagar o bastante para acompanhar a execução");
        let all = [
            (Pace::Full, word!(language, "Full speed", "Total"), full),
            (Pace::Lasts(seconds), word!(language, "Slowly", "Devagar"), slowly),
        ];
        if let Some(pace) = choice_buttons(ui, draft.pace, &all) {
            draft.pace = pace;
        }
    });
    if let Pace::Lasts(seconds) = &mut draft.pace {
        labelled_row(ui, word!(language, "If shared well, about", "Se bem dividida"), look, |ui| {
            let name = word!(language, "Seconds of the run", "Segundos da execução");
            number_field(ui, seconds, 1.0..=Settings::MAX_RUN_S, " s", VALUE_WIDTH_PT, (name, language)).on_hover_text(word!(language, 
                "The run takes this time if nearly all machines work until the end, as in a ring. Bands take longer with a \
                 slow machine. In real time, other programs on this computer also make the run longer",
                "A execução leva esse tempo se quase todas as máquinas trabalham até o fim, como num anel. Faixas levam mais \
                 com uma máquina lenta. Em tempo real, outros programas neste computador também alongam a execução"
            ));
        });
    }
}

/// Shows the heading of a group, and which of its settings take effect at once.
fn heading(ui: &mut Ui, text: &str, effect: &str, look: Look) {
    ui.horizontal(|ui| {
        ui.label(RichText::new(text).font(theme::strong(theme::BODY)).color(look.text));
        if !effect.is_empty() {
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                ui.label(RichText::new(effect).font(theme::regular(theme::SMALL)).color(look.quiet));
            });
        }
    });
}

/// Shows an explanation of the row above.
fn explanation(ui: &mut Ui, text: &str, look: Look) {
    ui.add(Label::new(RichText::new(text).font(theme::regular(theme::SMALL)).color(look.quiet)).wrap());
}

/// Shows a row that is high enough for buttons.
fn high_row<'a>(ui: &mut Ui, name: impl Into<RowName<'a>>, look: Look, content: impl FnOnce(&mut Ui)) {
    ui.scope(|ui| {
        ui.spacing_mut().interact_size.y = 4.0 * GRID;
        labelled_row(ui, name, look, content);
    });
}

/// Label of a row, and the definition that it shows.
struct RowName<'a> {
    text: &'a str,
    definition: Option<(Definition, Language)>,
}

impl<'a> From<&'a str> for RowName<'a> {
    fn from(text: &'a str) -> Self {
        Self { text, definition: None }
    }
}

impl<'a> From<(&'a str, Definition, Language)> for RowName<'a> {
    fn from((text, definition, language): (&'a str, Definition, Language)) -> Self {
        Self { text, definition: Some((definition, language)) }
    }
}

/// Shows a row with a label and, at its right end, the widgets of the setting.
fn labelled_row<'a>(ui: &mut Ui, name: impl Into<RowName<'a>>, look: Look, content: impl FnOnce(&mut Ui)) {
    let RowName { text, definition } = name.into();
    ui.horizontal(|ui| {
        let label = ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(look.quiet));
        if let Some((definition, language)) = definition {
            explained(label, definition, language);
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), content);
    });
}

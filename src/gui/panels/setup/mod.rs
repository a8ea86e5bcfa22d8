//! What can be set, at the left: what acts at once, and what starts the run anew.

mod sharing;

use egui::{ComboBox, Label, Popup, PopupCloseBehavior, RichText, ScrollArea, Ui, WidgetInfo};

use crate::gui::session::Session;
use crate::gui::settings::Settings;
use crate::gui::settings::pace::Pace;
use crate::gui::settings::speed_preset::SpeedPreset;
use crate::gui::settings::undo::Gesture;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button, choice, number, popup_frame, slider};
use crate::language::{Language, comma, say, word};
use crate::picture::{Quality, Size};
use crate::view::{count, two_digits};

/// How wide the panel is, in points.
pub const WIDTH: f32 = 36.0 * GRID;

/// The sizes that are offered; any other can be typed.
const SIZES: [(u32, u32); 6] = [(320, 240), (640, 480), (800, 600), (1280, 960), (1280, 720), (1920, 1080)];

/// When a pixel has enough samples: the errors that are offered; 0 is never.
const THRESHOLDS: [f64; 6] = [0.0, 0.05, 0.02, 0.01, 0.005, 0.002];

/// What weak rays may count together: the parts that are offered.
const CUTOFFS: [f64; 6] = [0.0, 1e-4, 1e-3, 1.0 / 255.0, 0.02, 0.1];

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
        let language = session.language();
        let look = Look::of(ui.ctx());
        if session.is_recorded() {
            return recorded(ui, session, look);
        }
        let mut draft = self.draft.take().unwrap_or_else(|| session.settings().clone());
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            ui.set_width(ui.available_width() - GRID);
            // Everything is in sight in a window of 1280 × 800.
            ui.spacing_mut().item_spacing.y = 2.0;
            ui.spacing_mut().interact_size.y = 3.5 * GRID;
            heading(ui, word!(language, "Takes effect at once", "Vale de imediato"), look);
            at_once(ui, &mut draft, look, language);
            ui.add_space(GRID);
            heading(ui, word!(language, "Starts the run anew", "Reinicia a execução"), look);
            anew(ui, &mut draft, look, language);
            ui.add_space(GRID);
            if button(
                ui,
                None,
                word!(language, "Back to the demonstration", "Voltar à demonstração"),
                true,
                Emphasis::Quiet,
            )
            .on_hover_text(word!(language, "Everything here as it was at first", "Tudo aqui como era no começo"))
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
    let language = session.language();
    heading(ui, word!(language, "A recorded run", "Uma execução gravada"), look);
    let text = word!(
        language,
        "It is played as it was recorded. Made live, its scene is traced anew with what was set then, and everything \
         can be changed.",
        "Ela se repete como foi gravada. Ao vivo, sua cena é calculada de novo com os ajustes de então, e tudo pode \
         ser mudado."
    );
    ui.add(Label::new(RichText::new(text).font(theme::regular(theme::BODY)).color(look.quiet)).wrap());
    if button(ui, None, word!(language, "Make it live", "Executar ao vivo"), true, Emphasis::Primary).clicked() {
        session.make_live();
    }
}

/// The width of an exact value.
const VALUE: f32 = 12.0 * GRID;

fn at_once(ui: &mut Ui, draft: &mut Settings, look: Look, language: Language) {
    let width = ui.available_width();
    let on = SpeedPreset::ALL.into_iter().find(|preset| draft.has_preset(*preset));
    egui::Grid::new("presets").spacing([GRID / 2.0, GRID / 2.0]).show(ui, |ui| {
        for (i, preset) in SpeedPreset::ALL.into_iter().enumerate() {
            let weight = if on == Some(preset) { Emphasis::On } else { Emphasis::Quiet };
            if button(ui, None, preset.name(language), true, weight).on_hover_text(preset.hint(language)).clicked() {
                draft.set_preset(preset);
            }
            if i % 2 == 1 {
                ui.end_row();
            }
        }
    });
    line(ui, word!(language, "Random seed", "Semente do acaso"), look, |ui| {
        let before = draft.seed;
        number(ui, &mut draft.seed, 0..=999_999, "", VALUE, word!(language, "Seed", "Semente"));
        if draft.seed != before {
            draft.set_preset(SpeedPreset::Random);
        }
    });
    line(ui, word!(language, "Latency of a hop", "Latência de um salto"), look, |ui| {
        let name = word!(language, "Latency in milliseconds", "Latência em milissegundos");
        number(ui, &mut draft.latency, 0..=Settings::MOST_LATENCY, " ms", VALUE, name);
    });
    // Most of what is of interest lies below half a second.
    let mut root = f64::from(draft.latency).sqrt();
    let most = f64::from(Settings::MOST_LATENCY).sqrt();
    let name = word!(language, "Latency slider", "Controle da latência");
    if slider(ui, &mut root, (0.0..=most, false), width - GRID, look.accent, name).changed() {
        draft.latency = (root * root).round() as u32;
    }
}

fn anew(ui: &mut Ui, draft: &mut Settings, look: Look, language: Language) {
    let width = ui.available_width();
    let mut nodes = draft.speeds.len() as u32;
    line(ui, word!(language, "Machines", "Máquinas"), look, |ui| {
        let name = word!(language, "Number of machines", "Número de máquinas");
        number(ui, &mut nodes, 1..=Settings::MOST_NODES as u32, "", VALUE, name);
    });
    let mut dragged = f64::from(nodes);
    let name = word!(language, "Machines slider", "Controle das máquinas");
    slider(ui, &mut dragged, (1.0..=Settings::MOST_NODES as f64, true), width - GRID, look.accent, name);
    nodes = dragged as u32;
    if nodes as usize != draft.speeds.len() {
        draft.set_nodes(nodes as usize);
    }
    sharing::sharing(ui, draft, look, language);
    sharing::network(ui, draft, look, language);
    ui.add_space(GRID);
    picture(ui, draft, look, language);
    pace(ui, draft, look, language);
}

fn picture(ui: &mut Ui, draft: &mut Settings, look: Look, language: Language) {
    high_line(ui, word!(language, "Size", "Tamanho"), look, |ui| {
        // From right to left.
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
        number(ui, &mut height, 16..=Settings::LONGEST_SIDE, "", 5.5 * GRID, high);
        ui.label(RichText::new("×").font(theme::regular(theme::BODY)).color(look.quiet));
        number(ui, &mut width, 16..=Settings::LONGEST_SIDE, "", 5.5 * GRID, wide);
        if let Ok(size) = Size::new(width, height) {
            draft.size = size;
        }
    });
    let name = word!(language, "Samples", "Amostras");
    line(ui, name, look, |ui| {
        let samples = &mut draft.quality.samples;
        let suffix = format!(" × {samples}");
        number(ui, samples, 1..=Settings::MOST_SAMPLES, &suffix, 9.0 * GRID, name);
        let hint =
            word!(language, "What else makes a picture good or fast", "O que mais torna uma imagem boa ou rápida");
        let more = button(ui, None, word!(language, "Quality…", "Mais…"), true, Emphasis::Quiet).on_hover_text(hint);
        let popup = Popup::from_toggle_button_response(&more).frame(popup_frame(ui.ctx()).inner_margin(1.5 * GRID));
        popup.close_behavior(PopupCloseBehavior::CloseOnClickOutside).show(|ui| {
            ui.set_width(44.0 * GRID);
            quality(ui, &mut draft.quality, look, language);
        });
    });
    line(ui, word!(language, "An atom is", "Um átomo tem"), look, |ui| {
        let name = word!(language, "Pixels in an atom", "Pixels num átomo");
        number(ui, &mut draft.atom, 1..=100_000, " pixels", VALUE, name);
    });
    let atoms = count(draft.division().atoms());
    small(ui, &say!(language, "That makes {atoms} atoms", "Isso dá {atoms} átomos"), look);
}

/// What is seldom changed.
fn quality(ui: &mut Ui, quality: &mut Quality, look: Look, language: Language) {
    if quality.samples > 1 {
        let until = |error: f64| {
            let least = comma(language, error.to_string());
            if error > 0.0 {
                say!(language, "until the error is {least}", "até o erro ser {least}")
            } else {
                word!(language, "for every pixel", "em todo pixel").into()
            }
        };
        let name = word!(language, "When a pixel has enough samples", "Quando um pixel tem amostras bastantes");
        line(ui, word!(language, "All samples", "Todas as amostras"), look, |ui| {
            one_of(ui, &mut quality.threshold, &THRESHOLDS, name, until)
        });
    }
    line(ui, word!(language, "Tree of rays", "Árvore de raios"), look, |ui| {
        let (suffix, name) =
            word!(language, (" levels", "Levels of the tree of rays"), (" níveis", "Níveis da árvore de raios"));
        number(ui, &mut quality.max_depth, 1..=Quality::MAX_DEPTH, suffix, VALUE, name);
    });
    let part = |part: f64| {
        let most = two_digits(100.0 * part, language);
        if part > 0.0 {
            say!(language, "up to {most} % of a pixel", "até {most} % de um pixel")
        } else {
            word!(language, "none", "nenhum").into()
        }
    };
    let name = word!(language, "Weak rays left out", "Raios fracos omitidos");
    line(ui, name, look, |ui| one_of(ui, &mut quality.cutoff, &CUTOFFS, name, part));
}

/// One value of a list, or what it is if it is not in the list.
fn one_of(ui: &mut Ui, value: &mut f64, all: &[f64], name: &str, text: impl Fn(f64) -> String) {
    let combo = ComboBox::from_id_salt(name).selected_text(text(*value)).width(26.0 * GRID);
    let combo = combo.show_ui(ui, |ui| {
        for &one in all {
            ui.selectable_value(value, one, text(one));
        }
    });
    combo.response.widget_info(|| WidgetInfo::labeled(egui::Role::ComboBox, true, name));
}

fn pace(ui: &mut Ui, draft: &mut Settings, look: Look, language: Language) {
    high_line(ui, word!(language, "Pace", "Andamento"), look, |ui| {
        let seconds = if let Pace::Lasts(seconds) = draft.tempo { seconds } else { 20 };
        let full = word!(
            language,
            "As fast as this computer can: a machine at 100 % never waits",
            "O mais rápido que este computador pode: uma máquina a 100 % nunca espera"
        );
        let slowly = word!(language, "So that everybody can follow", "Para que todos possam acompanhar");
        let all = [
            (Pace::Full, word!(language, "Full speed", "Total"), full),
            (Pace::Lasts(seconds), word!(language, "Slowly", "Devagar"), slowly),
        ];
        if let Some(tempo) = choice(ui, draft.tempo, &all) {
            draft.tempo = tempo;
        }
    });
    if let Pace::Lasts(seconds) = &mut draft.tempo {
        line(ui, word!(language, "Shared well, about", "Bem dividida, uns"), look, |ui| {
            let name = word!(language, "Seconds of the run", "Segundos da execução");
            number(ui, seconds, 1..=Settings::LONGEST_RUN, " s", VALUE, name).on_hover_text(word!(language, 
                "So long the run takes if nearly all machines work until the end, as in a ring. Bands take longer beside a \
                 slow machine, and so does this computer in real time while it has other things to do",
                "Tanto leva a execução se quase todas as máquinas trabalham até o fim, como num anel. Faixas levam mais ao \
                 lado de uma máquina lenta, e também este computador em tempo real, quando tem outras coisas a fazer"
            ));
        });
    }
}

fn heading(ui: &mut Ui, text: &str, look: Look) {
    ui.label(RichText::new(text).font(theme::strong(theme::BODY)).color(look.text));
}

/// What explains the line above.
fn small(ui: &mut Ui, text: &str, look: Look) {
    ui.add(Label::new(RichText::new(text).font(theme::regular(theme::SMALL)).color(look.quiet)).wrap());
}

/// A line of what is to be pressed.
fn high_line(ui: &mut Ui, name: &str, look: Look, content: impl FnOnce(&mut Ui)) {
    ui.scope(|ui| {
        ui.spacing_mut().interact_size.y = 4.0 * GRID;
        line(ui, name, look, content);
    });
}

/// A line of a name and, at its right end, what is called so.
fn line(ui: &mut Ui, name: &str, look: Look, content: impl FnOnce(&mut Ui)) {
    ui.horizontal(|ui| {
        ui.label(RichText::new(name).font(theme::regular(theme::BODY)).color(look.quiet));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), content);
    });
}

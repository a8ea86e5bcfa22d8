//! The bar at the top: what runs, how long, and what to press.

use egui::{Align, Color32, Label, Layout, RichText, TextStyle, Ui};

use crate::gui::input::keys::UserCommand;
use crate::gui::session::{Phase, Session};
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button, named_button};
use crate::language::{Language, say, word};
use crate::runlog::Driver;
use crate::sentence::shown;
use crate::view::{Sharing, count, time_words};

/// What is open, and so shown as pressed.
#[derive(Clone, Copy, Debug, Default)]
pub struct Open {
    /// The scenes.
    pub scenes: bool,
    /// Speed against accuracy.
    pub accuracy: bool,
    /// Runs beside each other.
    pub compare: bool,
    /// The lessons.
    pub learn: bool,
    /// What can be set.
    pub setup: bool,
    /// Saving.
    pub save: bool,
}

/// Shows the bar and returns what was pressed.
pub fn show(ui: &mut Ui, session: &Session, open: Open) -> Option<UserCommand> {
    let language = session.language();
    let look = Look::of(ui.ctx());
    let width = ui.available_width();
    let worded = worded(ui, width, language);
    // All buttons have room for their words.
    let wide = worded == WORDED;
    let mut clicked = None;
    ui.horizontal(|ui| {
        ui.set_min_height(5.0 * GRID);
        ui.label(RichText::new("anel").font(theme::strong(theme::LARGE)).color(look.text));
        ui.add_space(GRID);
        let name = session.header().scene.as_str();
        let shown: String = name.chars().take(if wide { 24 } else { 14 }).collect();
        let scenes = word!(language, "Scenes", "Cenas");
        let shown = if shown.is_empty() { scenes } else { &shown };
        let weight = if open.scenes { Emphasis::On } else { Emphasis::Quiet };
        // Buttons and time come first.
        let shown = Some(shown).filter(|_| width > 860.0);
        if named_button(ui, Some(Icon::Scenes), scenes, shown, weight).on_hover_text(hint(session)).clicked() {
            clicked = Some(UserCommand::Scenes);
        }
        let from_right = Layout::right_to_left(Align::Center);
        ui.with_layout(from_right, |ui| {
            clicked = clicked.or(buttons(ui, session, worded, open));
            ui.add_space(if wide { 2.0 * GRID } else { GRID });
            let time = time_words(session.stage().lasted(), session.stage().grain(), language);
            let font = theme::strong(theme::LARGE);
            let needed = ui.painter().layout_no_wrap(time.clone(), font.clone(), look.text).size().x;
            if needed < ui.available_width() {
                ui.label(RichText::new(time).font(font).color(look.text));
            }
            if let Some(state) = time_state(session).filter(|_| ui.available_width() > 260.0) {
                ui.label(quiet(state.into(), look.quiet));
            }
            ui.add_space(2.0 * GRID);
            // What is left over between name and time.
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                let what = what(ui, session);
                ui.add(Label::new(quiet(what, look.quiet)).truncate());
            });
        });
    });
    clicked
}

/// What the scene's button does, and what is said of the run.
fn hint(session: &Session) -> String {
    let language = session.language();
    let open = word!(language, "Open a scene or a recorded run (O)", "Abrir uma cena ou uma execução gravada (O)");
    let first = std::iter::once(open);
    first.chain(session.header().caption.lines()).collect::<Vec<_>>().join("\n")
}

/// How many buttons have words only where there is room for them.
const WORDED: usize = 5;

/// Those buttons, first those that keep their words longest.
fn names(language: Language) -> [&'static str; WORDED] {
    word!(
        language,
        ["Learn", "Compare", "Set up", "Save…", "Accuracy"],
        ["Lições", "Comparar", "Ajustar", "Salvar…", "Precisão"]
    )
}

/// How many of them have words in a bar of this width.
fn worded(ui: &Ui, width: f32, language: Language) -> usize {
    // What all else needs.
    let mut room = width - word!(language, 886.0, 906.0);
    let font = TextStyle::Button.resolve(ui.style());
    let has_room = |name: &&str| {
        let words = ui.painter().layout_no_wrap((*name).to_owned(), font.clone(), Color32::PLACEHOLDER);
        room -= words.size().x + 2.0 * GRID;
        room >= 0.0
    };
    names(language).into_iter().take_while(has_room).count()
}

/// From right to left; so many have words.
fn buttons(ui: &mut Ui, session: &Session, worded: usize, open: Open) -> Option<UserCommand> {
    let language = session.language();
    let mut clicked = None;
    let [learn, compare, set_up, save, accuracy] = names(language);
    let words = |name| names(language)[..worded].contains(&name);
    let mut press = |icon, name, words, weight, command, hint: &str| {
        if button(ui, Some(icon), name, words, weight).on_hover_text(hint).clicked() {
            clicked = Some(command);
        }
    };
    let shown = |open: bool| if open { Emphasis::On } else { Emphasis::Quiet };
    let hint = word!(language, "Which key does what (F1)", "Que tecla faz o quê (F1)");
    press(Icon::Help, word!(language, "Help", "Ajuda"), false, Emphasis::Quiet, UserCommand::Help, hint);
    let other = language.other();
    let switch = named_button(ui, None, other.name(), Some(other.short_name()), Emphasis::Quiet);
    if switch.on_hover_text(word!(language, "Em português (Shift L)", "In English (Shift L)")).clicked() {
        clicked = Some(UserCommand::Language);
    }
    let mut press = |icon, name, words, weight, command, hint: &str| {
        if button(ui, Some(icon), name, words, weight).on_hover_text(hint).clicked() {
            clicked = Some(command);
        }
    };
    let hint = word!(language, "Dark or light (D)", "Escuro ou claro (D)");
    press(
        Icon::Contrast,
        word!(language, "Dark or light", "Escuro ou claro"),
        false,
        Emphasis::Quiet,
        UserCommand::Theme,
        hint,
    );
    let hint = word!(language, "Save a picture, or the run (S)", "Salvar uma imagem, ou a execução (S)");
    press(Icon::Save, save, words(save), shown(open.save), UserCommand::Save, hint);
    let hint = word!(language, "What other qualities cost (A)", "O que custam outras qualidades (A)");
    press(Icon::Chart, accuracy, words(accuracy), shown(open.accuracy), UserCommand::Accuracy, hint);
    let hint = word!(language, "Lessons with questions (N)", "Lições com perguntas (N)");
    press(Icon::Learn, learn, words(learn), shown(open.learn), UserCommand::Learn, hint);
    let hint = word!(language, "The same run by other strategies (K)", "A mesma execução com outras estratégias (K)");
    press(Icon::Compare, compare, words(compare), shown(open.compare), UserCommand::Compare, hint);
    let hint = word!(language, "Machines, picture, strategy (E)", "Máquinas, imagem, estratégia (E)");
    press(Icon::Sliders, set_up, words(set_up), shown(open.setup), UserCommand::Setup, hint);
    ui.add_enabled_ui(session.history().can_undo(), |ui| {
        let button = button(ui, Some(Icon::Undo), word!(language, "Undo", "Desfazer"), false, Emphasis::Quiet);
        let hint = word!(
            language,
            "Take back the last change of a speed or of what is set (Ctrl Z)",
            "Desfazer a última mudança de velocidade ou de ajuste (Ctrl Z)"
        );
        if button.on_hover_text(hint).clicked() {
            clicked = Some(UserCommand::Undo);
        }
    });
    let mut press = |icon, name, words, weight, command, hint: &str| {
        if button(ui, Some(icon), name, words, weight).on_hover_text(hint).clicked() {
            clicked = Some(command);
        }
    };
    // The two to press first keep their words.
    let over = !matches!(session.stage().phase, Phase::Running | Phase::Preparing);
    let weight = |first: bool| if first { Emphasis::Primary } else { Emphasis::Quiet };
    let hint = if session.is_recorded() {
        word!(
            language,
            "From its beginning (R); Set up can make it live",
            "Do início (R); em Ajustar pode tornar-se ao vivo"
        )
    } else {
        word!(language, "A new run, with what is set (R)", "Uma nova execução, com o que está ajustado (R)")
    };
    let (name, weight_now) = (word!(language, "Restart", "Reiniciar"), weight(over && session.stage().shows_end()));
    press(Icon::Restart, name, true, weight_now, UserCommand::Restart, hint);
    let stage = session.stage();
    let (icon, name) = match stage.goes_on() {
        _ if stage.is_at_end() => (Icon::Play, word!(language, "Play again", "Repetir")),
        true => (Icon::Pause, word!(language, "Pause", "Pausar")),
        false if stage.phase == Phase::Preparing => (Icon::Pause, word!(language, "Pause", "Pausar")),
        false => (Icon::Play, word!(language, "Go on", "Continuar")),
    };
    let can = !matches!(stage.phase, Phase::Preparing | Phase::Failed(_));
    ui.add_enabled_ui(can, |ui| {
        let button = button(ui, Some(icon), name, true, weight(!over || !stage.shows_end()));
        if button
            .on_hover_text(word!(language, "Stand still or go on (space)", "Parar ou continuar (espaço)"))
            .clicked()
        {
            clicked = Some(UserCommand::Pause);
        }
    });
    clicked
}

/// What is to be said before the shown time.
fn time_state(session: &Session) -> Option<&'static str> {
    let language = session.language();
    let stage = session.stage();
    match (stage.phase == Phase::Running, stage.is_live(), stage.goes_on()) {
        (_, true, _) if stage.paused => Some(word!(language, "paused at", "em pausa em")),
        (_, true, _) => None,
        (true, false, true) => Some(word!(language, "earlier", "antes")),
        (false, false, true) => Some(word!(language, "again", "de novo")),
        (_, false, false) if stage.shows_end() => None,
        (_, false, false) => Some(word!(language, "stands at", "parado em")),
    }
}

/// What runs, in as many words as fit.
fn what(ui: &Ui, session: &Session) -> String {
    let language = session.language();
    let header = session.header();
    let machines = Sharing::of(header).machines(header.speeds.len(), language);
    let virtually =
        if header.driver == Driver::Sim { word!(language, " · virtual time", " · tempo virtual") } else { "" };
    let machines = format!("{machines}{virtually}");
    let title = &header.caption.title;
    let machines = if title.is_empty() { machines } else { format!("“{}” · {machines}", shown(title, 60)) };
    let machines = if session.is_recorded() {
        say!(language, "recorded · {machines}", "gravada · {machines}")
    } else {
        machines
    };
    let (width, height) = (header.size.width(), header.size.height());
    let size = format!("{machines} · {width} × {height} pixels");
    let (atoms, pixels) = (count(header.division.atoms()), header.division.atom_pixels());
    let all =
        say!(language, "{size} in {atoms} atoms of {pixels} pixels", "{size} em {atoms} átomos de {pixels} pixels");
    let fits = |text: &String| {
        let galley = ui.painter().layout_no_wrap(text.clone(), theme::regular(theme::SMALL), Color32::PLACEHOLDER);
        galley.size().x <= ui.available_width()
    };
    [all, size, machines].into_iter().find(fits).unwrap_or_default()
}

fn quiet(text: String, colour: Color32) -> RichText {
    RichText::new(text).font(theme::regular(theme::SMALL)).color(colour)
}

//! The top bar: scene, run, time and main buttons.

use egui::{Align, Color32, Label, Layout, RichText, Ui};

use crate::gui::input::keys::UserCommand;
use crate::gui::input::speed_slider::recorded_hint;
use crate::gui::session::{Phase, Session, Stage};
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button, button_with_room, named_button, text_width};
use crate::language::{Language, say, word};
use crate::runlog::Driver;
use crate::sentence::shown;
use crate::time::Time;
use crate::view::{count, time_words};

/// Which pages and panels are open; their buttons are shown as pressed.
#[derive(Clone, Copy, Debug, Default)]
pub struct OpenPages {
    /// The Scenes page.
    pub scenes: bool,
    /// The Accuracy page.
    pub accuracy: bool,
    /// The Compare page.
    pub compare: bool,
    /// The list of lessons, or a lesson.
    pub learn: bool,
    /// The settings.
    pub setup: bool,
    /// The save sheet.
    pub save: bool,
}

/// Shows the bar. Returns the command of the pressed button.
pub fn show(ui: &mut Ui, session: &Session, open: OpenPages) -> Option<UserCommand> {
    let language = session.language();
    let look = Look::of(ui.ctx());
    let width = ui.available_width();
    let labelled = labelled_buttons(ui, width, session);
    let mut clicked = None;
    ui.horizontal(|ui| {
        ui.set_min_height(5.0 * GRID);
        ui.label(RichText::new("anel").font(theme::strong(theme::LARGE)).color(look.text));
        ui.add_space(GRID);
        let scenes = word!(language, "Scenes", "Cenas");
        let shown = shown_scene(session);
        let emphasis = if open.scenes { Emphasis::On } else { Emphasis::Quiet };
        // In a narrow bar the other buttons and the time need the room.
        let shown = Some(shown.as_str()).filter(|_| width > 860.0);
        if named_button(ui, Some(Icon::Scenes), scenes, shown, emphasis).on_hover_text(hint(session)).clicked() {
            clicked = Some(UserCommand::Scenes);
        }
        if session.is_recorded() {
            ui.label(quiet(recorded(language).into(), look.text)).on_hover_text(recorded_hint(language));
        }
        let from_right = Layout::right_to_left(Align::Center);
        ui.with_layout(from_right, |ui| {
            ui.spacing_mut().item_spacing.x = GAP_PT;
            clicked = clicked.or(buttons(ui, session, labelled, open));
            ui.add_space(GRID);
            // Compare has a clock of its own.
            if !open.compare {
                clock(ui, session, look);
                if let Some(state) = time_state(session).filter(|_| ui.available_width() > 260.0) {
                    ui.label(quiet(state.into(), look.quiet));
                }
                ui.add_space(2.0 * GRID);
            }
            // The room that is left between name and time.
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                let run = run_text(ui, session);
                ui.add(Label::new(quiet(run, look.quiet)).truncate());
            });
        });
    });
    clicked
}

/// Returns the tooltip of the scene's button: what it does, and title, memo and computer of the run.
fn hint(session: &Session) -> String {
    let language = session.language();
    let open = word!(
        language,
        "Open a scene, a lesson or a recorded run (O)",
        "Abrir uma cena, lição ou execução gravada (O)"
    );
    let first = std::iter::once(open.to_owned());
    first.chain(session.header().caption.lines()).collect::<Vec<_>>().join("\n")
}

/// Gap between two buttons, in points.
const GAP_PT: f32 = GRID / 2.0;

/// Number of buttons that have a text only where there is room for it.
const FLEXIBLE_BUTTONS: usize = 5;

/// Returns the texts of the flexible buttons; in a narrowing bar the last one loses its text first.
fn names(language: Language) -> [&'static str; FLEXIBLE_BUTTONS] {
    word!(
        language,
        ["Learn", "Compare", "Set up", "Save…", "Accuracy"],
        ["Lições", "Comparar", "Ajustar", "Salvar…", "Precisão"]
    )
}

/// Returns how many of the flexible buttons have a text in a bar of this width.
fn labelled_buttons(ui: &Ui, width: f32, session: &Session) -> usize {
    /// Width of a button without its text.
    const BESIDE_TEXT_PT: f32 = 6.0 * GRID;
    let language = session.language();
    let large =
        |text: String| ui.painter().layout_no_wrap(text, theme::strong(theme::LARGE), Color32::PLACEHOLDER).size().x;
    let recorded = if session.is_recorded() { text_width(ui, recorded(language)) + GRID } else { 0.0 };
    let scene = text_width(ui, &shown_scene(session)) + BESIDE_TEXT_PT;
    let play = play_room(ui, language) + text_width(ui, restart_name(language)) + 2.0 * BESIDE_TEXT_PT;
    let other = text_width(ui, language.other().short_name()) + 3.0 * GRID;
    // Help, colours, undo, and the flexible buttons without a text; then the gaps of these and of the other three.
    let icons = (3 + FLEXIBLE_BUTTONS) as f32 * 4.0 * GRID + (6 + FLEXIBLE_BUTTONS) as f32 * GAP_PT;
    let stage = session.stage();
    let clock = large(time_words(longest_time(stage), stage.playback_scale(), language));
    // The last number is the gaps round the name of the program and the clock.
    let mut room = width - large("anel".into()) - scene - recorded - clock - play - other - icons - 5.0 * GRID;
    let has_room = |name: &&str| {
        room -= text_width(ui, name) + 2.0 * GRID;
        room >= 0.0
    };
    names(language).into_iter().take_while(has_room).count()
}

/// Returns the text of the scene's button: its name, or the beginning of a long one.
fn shown_scene(session: &Session) -> String {
    let name: String = session.header().scene.chars().take(20).collect();
    if name.is_empty() { word!(session.language(), "Scenes", "Cenas").into() } else { name }
}

fn recorded(language: Language) -> &'static str {
    word!(language, "recorded", "gravada")
}

fn restart_name(language: Language) -> &'static str {
    word!(language, "Restart", "Reiniciar")
}

/// Returns the texts of the button that plays: at the end, while the run goes on, and while it is paused.
fn play_names(language: Language) -> [&'static str; 3] {
    word!(language, ["Play again", "Pause", "Resume"], ["Repetir", "Pausar", "Continuar"])
}

/// Returns the width of the longest of these texts: the button keeps its width.
fn play_room(ui: &Ui, language: Language) -> f32 {
    play_names(language).into_iter().map(|name| text_width(ui, name)).fold(0.0, f32::max)
}

/// Shows the buttons from right to left; the first `labelled` flexible ones have a text. Returns the command of the
/// pressed button.
fn buttons(ui: &mut Ui, session: &Session, labelled: usize, open: OpenPages) -> Option<UserCommand> {
    let language = session.language();
    let mut clicked = None;
    let [learn, compare, set_up, save, accuracy] = names(language);
    let has_text = |name| names(language)[..labelled].contains(&name);
    let mut press = |icon, name, has_text, emphasis, command, hint: &str| {
        if button(ui, Some(icon), name, has_text, emphasis).on_hover_text(hint).clicked() {
            clicked = Some(command);
        }
    };
    let shown = |open: bool| if open { Emphasis::On } else { Emphasis::Quiet };
    let hint = word!(language, "List of all keys (F1)", "Lista de todas as teclas (F1)");
    press(Icon::Help, word!(language, "Help", "Ajuda"), false, Emphasis::Quiet, UserCommand::Help, hint);
    let other = language.other();
    let switch = named_button(ui, None, other.name(), Some(other.short_name()), Emphasis::Quiet);
    if switch.on_hover_text(word!(language, "Em português (Shift L)", "In English (Shift L)")).clicked() {
        clicked = Some(UserCommand::Language);
    }
    let mut press = |icon, name, has_text, emphasis, command, hint: &str| {
        if button(ui, Some(icon), name, has_text, emphasis).on_hover_text(hint).clicked() {
            clicked = Some(command);
        }
    };
    let hint = word!(language, "Dark or light colours (D)", "Cores escuras ou claras (D)");
    press(
        Icon::Contrast,
        word!(language, "Dark or light", "Escuro ou claro"),
        false,
        Emphasis::Quiet,
        UserCommand::Theme,
        hint,
    );
    let hint = word!(language, "Save a picture or the run (S)", "Salvar uma imagem ou a execução (S)");
    press(Icon::Save, save, has_text(save), shown(open.save), UserCommand::Save, hint);
    let hint =
        word!(language, "Measure error and time of other qualities (A)", "Medir erro e tempo de outras qualidades (A)");
    press(Icon::Chart, accuracy, has_text(accuracy), shown(open.accuracy), UserCommand::Accuracy, hint);
    let hint = word!(language, "Lessons with questions (N)", "Lições com perguntas (N)");
    press(Icon::Learn, learn, has_text(learn), shown(open.learn), UserCommand::Learn, hint);
    let hint =
        word!(language, "Compare the run with other strategies (K)", "Comparar a execução com outras estratégias (K)");
    press(Icon::Compare, compare, has_text(compare), shown(open.compare), UserCommand::Compare, hint);
    let hint = word!(language, "Set machines, strategy and picture (E)", "Ajustar máquinas, estratégia e imagem (E)");
    press(Icon::Sliders, set_up, has_text(set_up), shown(open.setup), UserCommand::Setup, hint);
    ui.add_enabled_ui(session.history().can_undo(), |ui| {
        let button = button(ui, Some(Icon::Undo), word!(language, "Undo", "Desfazer"), false, Emphasis::Quiet);
        let hint = word!(
            language,
            "Undo the last change of a speed or a setting (Ctrl Z)",
            "Desfazer a última mudança de velocidade ou de ajuste (Ctrl Z)"
        );
        let nothing = word!(language, "Undo: nothing to undo yet (Ctrl Z)", "Desfazer: ainda nada a desfazer (Ctrl Z)");
        if button.on_hover_text(hint).on_disabled_hover_text(nothing).clicked() {
            clicked = Some(UserCommand::Undo);
        }
    });
    // The main button always has a text, the other one unless the bar is so narrow that they would cover the scene's.
    let is_narrow = ui.ctx().content_rect().width() < 720.0;
    let mut press = |icon, name, has_text, emphasis, command, hint: &str| {
        if button(ui, Some(icon), name, has_text, emphasis).on_hover_text(hint).clicked() {
            clicked = Some(command);
        }
    };
    let is_over = !matches!(session.stage().phase, Phase::Running | Phase::Preparing);
    // Compare has a main button of its own.
    let emphasis = |is_main: bool| if is_main && !open.compare { Emphasis::Primary } else { Emphasis::Quiet };
    let hint = if session.is_recorded() {
        word!(
            language,
            "Play the recorded run from its beginning (R). Set up can make it live",
            "Repetir a execução gravada do início (R). Ajustar pode executá-la ao vivo"
        )
    } else {
        word!(
            language,
            "Start a new run with the present settings (R)",
            "Iniciar uma nova execução com os ajustes atuais (R)"
        )
    };
    let name = restart_name(language);
    press(
        Icon::Restart,
        name,
        !is_narrow,
        emphasis(is_over && session.stage().shows_end()),
        UserCommand::Restart,
        hint,
    );
    let stage = session.stage();
    let [again, pause, resume] = play_names(language);
    let (icon, name) = match stage.goes_on() {
        _ if stage.is_at_end() => (Icon::Play, again),
        true => (Icon::Pause, pause),
        false if stage.phase == Phase::Preparing => (Icon::Pause, pause),
        false => (Icon::Play, resume),
    };
    // Compare has a clock and a button of its own.
    if open.compare {
        return clicked;
    }
    let can = !matches!(stage.phase, Phase::Preparing | Phase::Failed(_));
    // A narrow bar has no room for it.
    let room = if labelled > 0 { play_room(ui, language) } else { 0.0 };
    ui.add_enabled_ui(can, |ui| {
        let button = button_with_room(ui, icon, name, room, emphasis(!is_over || !stage.shows_end()));
        if button.on_hover_text(word!(language, "Pause or resume (space)", "Pausar ou continuar (espaço)")).clicked() {
            clicked = Some(UserCommand::Pause);
        }
    });
    clicked
}

/// Returns the text before the shown time; `None` while the run is live.
fn time_state(session: &Session) -> Option<&'static str> {
    let language = session.language();
    let stage = session.stage();
    match (stage.phase == Phase::Running, stage.is_live(), stage.goes_on()) {
        (_, true, _) if stage.paused => Some(word!(language, "paused at", "em pausa em")),
        (_, true, _) if session.recovering_scheduler().is_some() => Some(word!(language, "hangs since", "parou em")),
        (_, true, _) => None,
        (true, false, true) => Some(word!(language, "earlier", "antes")),
        (false, false, true) => Some(word!(language, "again", "de novo")),
        (_, false, false) if stage.shows_end() => None,
        (_, false, false) => Some(word!(language, "stopped at", "parado em")),
    }
}

/// Returns the longest time that the clock is expected to show.
fn longest_time(stage: &Stage) -> Time {
    let is_over = matches!(stage.phase, Phase::Finished | Phase::Failed(_));
    if is_over { stage.length() } else { stage.length().max(Time::from_secs(10.0)) }
}

/// Shows the time of the run. It has the width of the longest time that is to be expected, so that its neighbours stay
/// in their places.
fn clock(ui: &mut Ui, session: &Session, look: Look) {
    let (stage, language) = (session.stage(), session.language());
    let (scale, font) = (stage.playback_scale(), theme::strong(theme::LARGE));
    let layout = |time| ui.painter().layout_no_wrap(time_words(time, scale, language), font.clone(), look.text);
    // In a run that hangs for ever nothing happens any more.
    let hangs = session.recovering_scheduler().is_some();
    let time = if hangs { stage.lasted().min(stage.state().head()) } else { stage.lasted() };
    let size = layout(longest_time(stage)).size();
    // Without a gap it would touch the scene's name.
    if size.x + GRID < ui.available_width() {
        let text = RichText::new(time_words(time, scale, language)).font(font).color(look.text);
        ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Center), |ui| ui.label(text));
    }
}

/// Describes the run in one line: title, strategy, machines, and as much about the picture as fits.
fn run_text(ui: &Ui, session: &Session) -> String {
    let language = session.language();
    let header = session.header();
    let machines = header.scheduler().machines(header.speeds.len(), language);
    let virtual_time =
        if header.driver == Driver::Sim { word!(language, " · virtual time", " · tempo virtual") } else { "" };
    let machines = format!("{machines}{virtual_time}");
    let title = &header.caption.title;
    let machines = if title.is_empty() { machines } else { format!("“{}” · {machines}", shown(title, 60)) };
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

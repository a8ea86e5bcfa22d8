//! The run's time in the user's hand: steps, how fast it goes, a line to drag along, and what is worth jumping to.

use std::time::Duration;

use egui::{
    Align, Align2, EventFilter, Key, Layout, Painter, Popup, PopupCloseBehavior, Pos2, Rect, Response, RichText, Role,
    Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2,
};

use crate::gui::input::keys::UserCommand;
use crate::gui::input::rate_menu;
use crate::gui::session::{Phase, Session, Stage};
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button, named_button, next_of, popup_frame};
use crate::language::{Language, say, word};
use crate::time::Time;
use crate::view::{Landmark, Marker, MarkerKind, StepUnit, condition_strokes, landmarks, time_words};

/// How high the panel is.
pub const HEIGHT: f32 = 4.0 * GRID;

/// By what one steps, and what was found in the run.
pub struct TimePanel {
    step: StepUnit,
    /// What was found when the list was opened.
    found: Vec<Landmark>,
    /// The version of the run's lanes that it was found in, and the language.
    found_in: (u64, Language),
    /// The list is to be opened or closed.
    toggles: bool,
    is_finding: bool,
}

impl Default for TimePanel {
    fn default() -> Self {
        let found_in = (0, Language::default());
        Self { step: StepUnit::Event, found: Vec::new(), found_in, toggles: false, is_finding: false }
    }
}

impl TimePanel {
    /// Opens or closes the list of what is worth jumping to.
    pub fn toggle_find(&mut self) {
        self.toggles = true;
    }

    /// Closes that list; returns what leads to what stands at this place of it.
    pub fn choose(&mut self, place: usize) -> Option<UserCommand> {
        self.toggle_find();
        self.found.get(place).map(|mark| UserCommand::Jump(mark.records, mark.subject))
    }

    /// Whether that list is open, or about to be.
    pub fn is_finding(&self) -> bool {
        self.is_finding || self.toggles
    }

    /// Shows the panel and returns what was pressed.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session, shows_timeline: bool) -> Option<UserCommand> {
        let language = session.language();
        let look = Look::of(ui.ctx());
        let mut pressed = None;
        ui.horizontal(|ui| {
            ui.set_height(HEIGHT);
            ui.spacing_mut().item_spacing.x = GRID / 2.0;
            let can = session.stage().phase != Phase::Preparing;
            ui.add_enabled_ui(can, |ui| {
                pressed = self.steps(ui, language);
                ui.add_space(GRID);
                pressed = pressed.or(rate_menu::show(ui, session.stage().time.rate(), language));
            });
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                ui.spacing_mut().item_spacing.x = GRID / 2.0;
                pressed = pressed.or(self.find(ui, session, look));
                let weight = if shows_timeline { Emphasis::On } else { Emphasis::Quiet };
                let words = (ui.available_width() > 760.0).then_some(word!(language, "Timeline", "Linha do tempo"));
                let name = word!(language, "Show the timeline", "Mostrar a linha do tempo");
                let hint = word!(
                    language,
                    "Who did what and when, in place of the machines (T)",
                    "Quem fez o quê e quando, no lugar das máquinas (T)"
                );
                let timeline = named_button(ui, Some(Icon::Lanes), name, words, weight);
                if timeline.on_hover_text(hint).clicked() {
                    pressed = Some(UserCommand::Timeline);
                }
                pressed = pressed.or(live(ui, session.stage(), look, language));
                ui.add_space(GRID);
                let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
                pressed = pressed.or(arrows(ui, &response, self.step));
                line(ui, rect, response, session, look);
            });
        });
        pressed
    }

    /// Back, by what, and on.
    fn steps(&mut self, ui: &mut Ui, language: Language) -> Option<UserCommand> {
        let step = self.step;
        let mut pressed = None;
        let (name, [back_keys, on_keys]) = (step.name(language), ['←', '→'].map(|arrow| keys(step, arrow)));
        let back =
            button(ui, Some(Icon::StepBack), word!(language, "Step back", "Passo atrás"), false, Emphasis::Quiet);
        let hint = say!(language, "Back by one {name} ({back_keys})", "Voltar: {name} ({back_keys})");
        if back.on_hover_text(hint).clicked() {
            pressed = Some(UserCommand::StepUnit(step, false));
        }
        let by =
            named_button(ui, None, word!(language, "What a step is", "O que é um passo"), Some(name), Emphasis::Quiet);
        let hint = word!(
            language,
            "Event: a message, or a hand on the run. Atom: one is traced. Lap: a machine's own offer goes off. Press to \
             change",
            "Evento: uma mensagem, ou uma intervenção. Átomo: um é calculado. Volta: a oferta de uma máquina parte. \
             Pressionar para mudar"
        );
        if by.on_hover_text(hint).clicked() {
            self.step = next_of(&StepUnit::ALL, step);
        }
        let on = button(ui, Some(Icon::StepOn), word!(language, "Step on", "Passo adiante"), false, Emphasis::Quiet);
        let hint = say!(language, "On by one {name} ({on_keys})", "Avançar: {name} ({on_keys})");
        if on.on_hover_text(hint).clicked() {
            pressed = Some(UserCommand::StepUnit(step, true));
        }
        pressed
    }

    /// What is worth jumping to.
    fn find(&mut self, ui: &mut Ui, session: &Session, look: Look) -> Option<UserCommand> {
        let language = session.language();
        let weight = if self.is_finding { Emphasis::On } else { Emphasis::Quiet };
        let hint = word!(
            language,
            "The first offer, the biggest transfer … (F)",
            "A primeira oferta, a maior transferência … (F)"
        );
        let find = button(ui, None, word!(language, "Find", "Achar"), true, weight).on_hover_text(hint);
        let id = Popup::default_response_id(&find);
        if std::mem::take(&mut self.toggles) {
            Popup::toggle_id(ui.ctx(), id);
        }
        let was_open = self.is_finding;
        let popup = Popup::from_toggle_button_response(&find).frame(popup_frame(ui.ctx()));
        let shown = popup.close_behavior(PopupCloseBehavior::CloseOnClick).show(|ui| {
            let known = (session.stage().lanes().version(), language);
            if !was_open || self.found_in != known {
                (self.found, self.found_in) = (landmarks(&session.stage().log, language), known);
                let told = session.stage().told_length();
                self.found.retain(|mark| mark.at <= told);
            }
            ui.set_width(54.0 * GRID);
            ui.spacing_mut().item_spacing.y = GRID / 4.0;
            let mut chosen = None;
            for (place, mark) in self.found.iter().enumerate() {
                if entry(ui, (place + 1, mark), session.stage().grain(), look, language).clicked() {
                    chosen = Some(UserCommand::Jump(mark.records, mark.subject));
                }
            }
            if self.found.is_empty() {
                let text = word!(language, "Nothing has happened yet", "Nada aconteceu ainda");
                ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(look.quiet));
            }
            chosen
        });
        self.is_finding = shown.is_some();
        shown.and_then(|shown| shown.inner)
    }
}

/// The key for a step.
fn keys(step: StepUnit, arrow: char) -> String {
    match step {
        StepUnit::Event => arrow.to_string(),
        StepUnit::Atom => format!("Shift {arrow}"),
        StepUnit::Lap => format!("Ctrl {arrow}"),
    }
}

/// A line of the list: what it is, and when.
fn entry(ui: &mut Ui, (number, mark): (usize, &Landmark), rate: f64, look: Look, language: Language) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), 3.5 * GRID), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &mark.words));
    if response.hovered() || response.has_focus() {
        ui.painter().rect_filled(rect, 6.0, look.raised);
    }
    let y = rect.center().y;
    let words = ui.painter().layout_no_wrap(mark.words.clone(), theme::regular(theme::BODY), look.text);
    let font = theme::regular(theme::SMALL);
    ui.painter().text(pos2(rect.left() + GRID, y), Align2::LEFT_CENTER, number, font, look.quiet);
    ui.painter().galley(pos2(rect.left() + 3.0 * GRID, y - words.size().y / 2.0), words, look.text);
    let time =
        ui.painter().layout_no_wrap(time_words(mark.at, rate, language), theme::regular(theme::SMALL), look.quiet);
    ui.painter().galley(pos2(rect.right() - GRID - time.size().x, y - time.size().y / 2.0), time, look.quiet);
    response
}

/// Back to what happens now, or to the end.
fn live(ui: &mut Ui, stage: &Stage, look: Look, language: Language) -> Option<UserCommand> {
    let runs = matches!(stage.phase, Phase::Running | Phase::Preparing);
    let (name, hint) = if runs {
        word!(language, ("Live", "What happens now (L)"), ("Ao vivo", "O que acontece agora (L)"))
    } else {
        word!(language, ("End", "The end of the run (L)"), ("Fim", "O fim da execução (L)"))
    };
    let is_there = if runs { stage.is_live() } else { stage.shows_end() };
    let weight = if is_there { Emphasis::On } else { Emphasis::Quiet };
    let icon = if runs { Icon::Live } else { Icon::End };
    let response = button(ui, Some(icon), name, true, weight).on_hover_text(hint);
    // A run that has left the shown time behind is not to be forgotten.
    if runs && !is_there {
        ui.painter().circle_filled(response.rect.right_top() + vec2(-4.0, 4.0), 3.0, look.accent);
    }
    response.clicked().then_some(UserCommand::Live)
}

/// Whoever has come to the line with the keyboard makes steps by its arrows.
fn arrows(ui: &Ui, response: &Response, step: StepUnit) -> Option<UserCommand> {
    if !response.has_focus() {
        return None;
    }
    let filter = EventFilter { horizontal_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
    let pressed = |key| ui.input(|input| input.key_pressed(key));
    let forward = pressed(Key::ArrowRight);
    (forward || pressed(Key::ArrowLeft)).then_some(UserCommand::StepUnit(step, forward))
}

/// The line along which one drags, with what stands out.
fn line(ui: &Ui, rect: Rect, response: Response, session: &mut Session, look: Look) {
    let language = session.language();
    let length = session.stage().told_length();
    let rail =
        Rect::from_x_y_ranges(rect.left() + GRID..=rect.right() - GRID, rect.center().y - 2.0..=rect.center().y + 2.0);
    let time_at = |at: Pos2| {
        let share = ((at.x - rail.left()) / rail.width()).clamp(0.0, 1.0);
        Time((f64::from(share) * length.0 as f64) as u64)
    };
    if let Some(at) = response.interact_pointer_pos().filter(|_| response.dragged() || response.clicked()) {
        let stands = session.stage().time.is_paused() || response.dragged();
        let is_end = at.x >= rail.right() && !session.stage().hides_later;
        let at = if is_end { Time(u64::MAX) } else { time_at(at) };
        session.drag_to(at, stands);
    }
    if response.drag_stopped() {
        session.let_time_go();
    }
    let stage = session.stage();
    let x = |time: Time| {
        let share = if length == Time::ZERO { 0.0 } else { time.0 as f64 / length.0 as f64 };
        rail.left() + rail.width() * share.clamp(0.0, 1.0) as f32
    };
    let now = stage.lasted();
    let grain = stage.grain();
    response.widget_info(|| {
        let mut info = WidgetInfo::slider(true, now.secs(), word!(language, "The run's time", "O tempo da execução"));
        let is_more = stage.phase == Phase::Running || stage.hides_later;
        let of = if is_more { word!(language, "so far", "até agora") } else { word!(language, "in all", "ao todo") };
        let [now, length] = [now, length].map(|time| time_words(time, grain, language));
        info.current_text_value = Some(say!(language, "{now} of {length} {of}", "{now} de {length} {of}"));
        info
    });
    let painter = ui.painter();
    painter.rect_filled(rail, 2.0, look.hairline);
    painter.rect_filled(rail.with_max_x(x(now)), 2.0, look.accent.gamma_multiply(0.8));
    let mut last_retired = f32::NEG_INFINITY;
    let shown = |sign: &&Marker| !stage.hides_later || sign.at <= now;
    for sign in stage.signs().all().iter().filter(shown) {
        // Many retire at about one time.
        if matches!(sign.kind, MarkerKind::Retired(_)) {
            if x(sign.at) < last_retired + 7.0 {
                continue;
            }
            last_retired = x(sign.at);
        }
        draw_sign(painter, pos2(x(sign.at), rail.center().y), sign, stage, look);
    }
    let handle = pos2(x(now), rail.center().y);
    let grown = if response.hovered() || response.dragged() { 8.0 } else { 6.5 };
    painter.circle(handle, grown, look.accent, Stroke::new(2.0, look.text));
    if response.has_focus() {
        painter.circle_stroke(handle, grown + 3.0, Stroke::new(1.5, look.accent));
    }
    if let Some(at) = response.hover_pos().filter(|_| length > Time::ZERO) {
        let pointed = time_at(at);
        let reach = Duration::from_secs_f64(length.secs() * f64::from(6.0 / rail.width().max(1.0)));
        let mut words = vec![time_words(pointed, grain * 0.1, language)];
        words.extend(
            stage
                .signs()
                .near(pointed, reach)
                .into_iter()
                .filter(shown)
                .take(3)
                .map(|sign| sign.happening.sentence(language)),
        );
        response.on_hover_text_at_pointer(words.join("\n"));
    }
}

/// A sign above or below the line: a wedge for a speed, bars for a pause, a ring for a machine that retired.
fn draw_sign(painter: &Painter, at: Pos2, sign: &Marker, stage: &Stage, look: Look) {
    let own = |node: u16| stage.colours.get(usize::from(node)).map_or(look.text, |&rgb| theme::colour(rgb));
    let above = at - vec2(0.0, 9.0);
    match sign.kind {
        MarkerKind::Speed(node) => {
            let corners = vec![above + vec2(-4.0, -4.0), above + vec2(4.0, -4.0), above + vec2(0.0, 3.0)];
            painter.add(Shape::convex_polygon(corners, own(node), Stroke::NONE));
        }
        MarkerKind::Pause(node) => {
            for side in [-2.5, 2.5] {
                let bar = Rect::from_center_size(above + vec2(side, -0.5), vec2(2.5, 7.0));
                painter.rect_filled(bar, 0.0, own(node));
            }
        }
        MarkerKind::Condition(node, condition) => {
            const REACH: f32 = 3.6;
            for stroke in condition_strokes(condition) {
                let points = stroke.map(|point| above + REACH * egui::Vec2::from(point));
                painter.line_segment(points, Stroke::new(1.75, own(node)));
            }
        }
        MarkerKind::Latency => {
            let bar = Rect::from_center_size(above, vec2(7.0, 2.5));
            painter.rect_filled(bar, 0.0, look.text);
        }
        MarkerKind::Retired(node) => {
            painter.circle_stroke(at + vec2(0.0, 9.0), 3.0, Stroke::new(1.75, own(node)));
        }
        MarkerKind::Complete => {
            let line = [at - vec2(0.0, 10.0), at + vec2(0.0, 10.0)];
            painter.line_segment(line, Stroke::new(1.5, look.text));
        }
    }
}

//! The time bar: steps, playback rate, the line to drag, and the list of landmarks.

use std::time::Duration;

use egui::{
    Align, Align2, EventFilter, Key, Layout, Painter, Popup, PopupCloseBehavior, Pos2, Rect, RectAlign, Response,
    RichText, Role, Sense, Shape, Stroke, Tooltip, Ui, WidgetInfo, pos2, vec2,
};

use crate::gui::input::keys::UserCommand;
use crate::gui::input::rate_menu;
use crate::gui::session::{Phase, Session, Stage};
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::steady;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button, cycle, hint_above, named_button, popup_frame};
use crate::language::{Language, say, word};
use crate::time::Time;
use crate::view::{Landmark, Marker, MarkerKind, StepUnit, TimeScale, condition_strokes, landmarks, time_words};

/// Height of the panel, in points.
pub const HEIGHT_PT: f32 = 4.0 * GRID;

/// The time bar.
pub struct TimePanel {
    step: StepUnit,
    /// Landmarks of the run, found when the list was opened.
    landmarks: Vec<Landmark>,
    /// Version of the lanes, and language, of the landmarks.
    landmarks_key: (u64, Language),
    /// Whether the next frame opens or closes the list.
    toggles_list: bool,
    is_list_open: bool,
}

impl Default for TimePanel {
    fn default() -> Self {
        Self {
            step: StepUnit::Event,
            landmarks: Vec::new(),
            landmarks_key: (0, Language::default()),
            toggles_list: false,
            is_list_open: false,
        }
    }
}

impl TimePanel {
    /// Opens or closes the list of landmarks.
    pub fn toggle_find(&mut self) {
        self.toggles_list = true;
    }

    /// Closes the list; returns the jump to the landmark at this index.
    pub fn choose(&mut self, index: usize) -> Option<UserCommand> {
        self.toggle_find();
        self.landmarks.get(index).map(|mark| UserCommand::Jump(mark.records, mark.subject))
    }

    /// Whether the list is open, or opens in the next frame.
    pub fn is_finding(&self) -> bool {
        self.is_list_open || self.toggles_list
    }

    /// Shows the panel. Returns the command of the pressed button.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session, shows_timeline: bool) -> Option<UserCommand> {
        let language = session.language();
        let look = Look::of(ui.ctx());
        let mut pressed = None;
        ui.horizontal(|ui| {
            ui.set_height(HEIGHT_PT);
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
                let emphasis = if shows_timeline { Emphasis::On } else { Emphasis::Quiet };
                let text = (ui.available_width() > 470.0).then_some(word!(language, "Timeline", "Linha do tempo"));
                let name = word!(language, "Show the timeline", "Mostrar a linha do tempo");
                let hint = word!(
                    language,
                    "Show what each machine did and when, or the machines again (T)",
                    "Mostrar o que cada máquina fez e quando, ou de novo as máquinas (T)"
                );
                let timeline = named_button(ui, Some(Icon::Lanes), name, text, emphasis);
                if hint_above(timeline, hint).clicked() {
                    pressed = Some(UserCommand::Timeline);
                }
                pressed = pressed.or(live(ui, session.stage(), look, language));
                ui.add_space(GRID);
                let (rect, response) = steady::allocate_size(ui, ui.available_size(), "time", Sense::click_and_drag());
                pressed = pressed.or(arrow_keys(ui, &response, self.step));
                line(ui, rect, response, session, look);
            });
        });
        pressed
    }

    /// Shows the button of the beginning, and those of the steps: back, unit, forward.
    fn steps(&mut self, ui: &mut Ui, language: Language) -> Option<UserCommand> {
        let step = self.step;
        let mut pressed = None;
        let name = word!(language, "Beginning", "Início");
        let hint = word!(language, "Show the beginning of the run (Home)", "Mostrar o início da execução (Home)");
        let beginning = button(ui, Some(Icon::Beginning), name, false, Emphasis::Quiet);
        if hint_above(beginning, hint).clicked() {
            pressed = Some(UserCommand::Beginning);
        }
        let (name, [back_keys, forward_keys]) = (step.name(language), ['←', '→'].map(|arrow| keys(step, arrow)));
        let back =
            button(ui, Some(Icon::StepBack), word!(language, "Step back", "Passo atrás"), false, Emphasis::Quiet);
        let hint = say!(language, "To the previous {name} ({back_keys})", "Voltar: {name} ({back_keys})");
        if hint_above(back, &hint).clicked() {
            pressed = Some(UserCommand::Step(step, false));
        }
        let unit =
            named_button(ui, None, word!(language, "Unit of a step", "Unidade do passo"), Some(name), Emphasis::Quiet);
        let hint = word!(
            language,
            "Event: a message or a change by the user. Atom: an atom is traced. Lap: a machine offers help. Press to \
            change",
            "Evento: uma mensagem ou mudança do usuário. Átomo: um átomo é calculado. Volta: uma máquina oferece ajuda. \
            Pressione para mudar"
        );
        if hint_above(unit, hint).clicked() {
            self.step = cycle(&StepUnit::ALL, step);
        }
        let forward =
            button(ui, Some(Icon::StepOn), word!(language, "Step forward", "Passo adiante"), false, Emphasis::Quiet);
        let hint = say!(language, "To the next {name} ({forward_keys})", "Avançar: {name} ({forward_keys})");
        if hint_above(forward, &hint).clicked() {
            pressed = Some(UserCommand::Step(step, true));
        }
        pressed
    }

    /// Shows the button and the list of landmarks.
    fn find(&mut self, ui: &mut Ui, session: &Session, look: Look) -> Option<UserCommand> {
        let language = session.language();
        let emphasis = if self.is_list_open { Emphasis::On } else { Emphasis::Quiet };
        let hint = word!(
            language,
            "Jump to the first offer, the biggest transfer … (F)",
            "Ir à primeira oferta, à maior transferência … (F)"
        );
        let find = hint_above(button(ui, None, word!(language, "Find", "Achar"), true, emphasis), hint);
        let id = Popup::default_response_id(&find);
        if std::mem::take(&mut self.toggles_list) {
            Popup::toggle_id(ui.ctx(), id);
        }
        let was_open = self.is_list_open;
        let popup = Popup::from_toggle_button_response(&find).frame(popup_frame(ui.ctx()));
        let shown = popup.close_behavior(PopupCloseBehavior::CloseOnClick).show(|ui| {
            let key = (session.stage().lanes().version(), language);
            if !was_open || self.landmarks_key != key {
                (self.landmarks, self.landmarks_key) = (landmarks(&session.stage().log, language), key);
                let length = session.stage().shown_length();
                self.landmarks.retain(|mark| mark.at <= length);
            }
            ui.set_width(54.0 * GRID);
            ui.spacing_mut().item_spacing.y = GRID / 4.0;
            let mut chosen = None;
            for (index, mark) in self.landmarks.iter().enumerate() {
                if entry(ui, (index + 1, mark), session.stage().playback_scale(), look, language).clicked() {
                    chosen = Some(UserCommand::Jump(mark.records, mark.subject));
                }
            }
            if self.landmarks.is_empty() {
                let text = word!(language, "There is nothing to find yet", "Ainda não há nada para achar");
                ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(look.quiet));
            }
            chosen
        });
        self.is_list_open = shown.is_some();
        shown.and_then(|shown| shown.inner)
    }
}

/// Returns the keys of a step.
fn keys(step: StepUnit, arrow: char) -> String {
    match step {
        StepUnit::Event => arrow.to_string(),
        StepUnit::Atom => format!("Shift {arrow}"),
        StepUnit::Lap => format!("Ctrl {arrow}"),
    }
}

/// Shows a landmark of the list: its number, its text and its time.
fn entry(
    ui: &mut Ui,
    (number, mark): (usize, &Landmark),
    scale: TimeScale,
    look: Look,
    language: Language,
) -> Response {
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
        ui.painter().layout_no_wrap(time_words(mark.at, scale, language), theme::regular(theme::SMALL), look.quiet);
    ui.painter().galley(pos2(rect.right() - GRID - time.size().x, y - time.size().y / 2.0), time, look.quiet);
    response
}

/// Shows the button that follows the run or shows its end.
fn live(ui: &mut Ui, stage: &Stage, look: Look, language: Language) -> Option<UserCommand> {
    let runs = matches!(stage.phase, Phase::Running | Phase::Preparing);
    let (name, hint) = if runs {
        word!(language, ("Live", "Show the present (L)"), ("Ao vivo", "Mostrar o presente (L)"))
    } else {
        word!(language, ("End", "Show the end of the run (L)"), ("Fim", "Mostrar o fim da execução (L)"))
    };
    let is_on = if runs { stage.is_live() } else { stage.shows_end() };
    let emphasis = if is_on { Emphasis::On } else { Emphasis::Quiet };
    let icon = if runs { Icon::Live } else { Icon::End };
    // A narrow bar needs the room for its line.
    let has_text = ui.ctx().content_rect().width() > 720.0;
    let response = hint_above(button(ui, Some(icon), name, has_text, emphasis), hint);
    // A dot reminds the user that the run is ahead of the shown time.
    if runs && !is_on {
        ui.painter().circle_filled(response.rect.right_top() + vec2(-4.0, 4.0), 3.0, look.accent);
    }
    response.clicked().then_some(UserCommand::Live)
}

/// Returns the step of an arrow key while the line has the keyboard focus.
fn arrow_keys(ui: &Ui, response: &Response, step: StepUnit) -> Option<UserCommand> {
    if !response.has_focus() {
        return None;
    }
    let filter = EventFilter { horizontal_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
    let pressed = |key| ui.input(|input| input.key_pressed(key));
    let forward = pressed(Key::ArrowRight);
    (forward || pressed(Key::ArrowLeft)).then_some(UserCommand::Step(step, forward))
}

/// Shows the line to drag along, with its markers.
fn line(ui: &Ui, rect: Rect, response: Response, session: &mut Session, look: Look) {
    let language = session.language();
    let length = session.stage().shown_length();
    let rail =
        Rect::from_x_y_ranges(rect.left() + GRID..=rect.right() - GRID, rect.center().y - 2.0..=rect.center().y + 2.0);
    let time_at = |at: Pos2| {
        let share = ((at.x - rail.left()) / rail.width()).clamp(0.0, 1.0);
        Time((f64::from(share) * length.0 as f64) as u64)
    };
    if let Some(at) = response.interact_pointer_pos().filter(|_| response.dragged() || response.clicked()) {
        let paused = session.stage().time.is_paused() || response.dragged();
        let is_end = at.x >= rail.right() && !session.stage().hides_later;
        let at = if is_end { Time(u64::MAX) } else { time_at(at) };
        session.drag_to(at, paused);
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
    let scale = stage.playback_scale();
    response.widget_info(|| {
        let mut info = WidgetInfo::slider(true, now.secs(), word!(language, "The run's time", "O tempo da execução"));
        let is_more = stage.phase == Phase::Running || stage.hides_later;
        let of = if is_more { word!(language, "so far", "até agora") } else { word!(language, "in all", "ao todo") };
        let [now, length] = [now, length].map(|time| time_words(time, scale, language));
        info.current_text_value = Some(say!(language, "{now} of {length} {of}", "{now} de {length} {of}"));
        info
    });
    let painter = ui.painter();
    painter.rect_filled(rail, 2.0, look.hairline);
    painter.rect_filled(rail.with_max_x(x(now)), 2.0, look.accent.gamma_multiply(0.8));
    let mut last_retired = f32::NEG_INFINITY;
    let shown = |marker: &&Marker| !stage.hides_later || marker.at <= now;
    for marker in stage.markers().all().iter().filter(shown) {
        // Many machines retire at about the same time: overlapping markers are left out.
        if matches!(marker.kind, MarkerKind::Retired(_)) {
            if x(marker.at) < last_retired + 7.0 {
                continue;
            }
            last_retired = x(marker.at);
        }
        draw_marker(painter, pos2(x(marker.at), rail.center().y), marker, stage, look);
    }
    let handle = pos2(x(now), rail.center().y);
    let handle_radius = if response.hovered() || response.dragged() { 8.0 } else { 6.5 };
    painter.circle(handle, handle_radius, look.accent, Stroke::new(2.0, look.text));
    if response.has_focus() {
        painter.circle_stroke(handle, handle_radius + 3.0, Stroke::new(1.5, look.accent));
    }
    let is_at_knob = response.dragged() || response.hover_pos().is_some_and(|at| at.distance(handle) <= 10.0);
    if is_at_knob {
        label_above(&response, handle, time_words(now, scale, language));
    } else if let Some(at) = response.hover_pos().filter(|_| length > Time::ZERO) {
        let reach = Duration::from_secs_f64(length.secs() * f64::from(6.0 / rail.width().max(1.0)));
        let near = stage.markers().near(time_at(at), reach).into_iter().filter(shown).take(3);
        let words = |marker: &Marker| {
            format!("{}: {}", time_words(marker.at, scale, language), marker.happening.sentence(language))
        };
        let lines: Vec<String> = near.map(words).collect();
        if !lines.is_empty() {
            label_above(&response, pos2(at.x, rail.center().y), lines.join("\n"));
        }
    }
}

/// Shows a text above a place on the line, so that it does not cover the sentence below.
fn label_above(response: &Response, at: Pos2, text: String) {
    let mut tooltip = Tooltip::for_widget(response);
    let above = &[RectAlign::TOP, RectAlign::TOP_START, RectAlign::TOP_END];
    tooltip.popup = tooltip.popup.at_position(at - vec2(0.0, HEIGHT_PT / 2.0)).align(RectAlign::TOP);
    tooltip.popup = tooltip.popup.align_alternatives(above);
    tooltip.show(|ui| ui.label(text));
}

/// Paints a marker above or below the line: a wedge for a speed, bars for a pause, a circle for a retired machine.
fn draw_marker(painter: &Painter, at: Pos2, marker: &Marker, stage: &Stage, look: Look) {
    let own = |node: u16| stage.colours.get(usize::from(node)).map_or(look.text, |&rgb| theme::colour(rgb));
    let above = at - vec2(0.0, 9.0);
    match marker.kind {
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
            const HALF_SIZE_PT: f32 = 3.6;
            for stroke in condition_strokes(condition) {
                let points = stroke.map(|point| above + HALF_SIZE_PT * egui::Vec2::from(point));
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

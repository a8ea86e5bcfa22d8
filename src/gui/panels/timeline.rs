//! The timeline: a lane for each machine with its atoms, its waiting, and the messages between machines.

use egui::{Align2, Painter, Rect, Response, Sense, Shape, Stroke, Ui, UiBuilder, pos2, vec2};

use crate::balance::{NodeId, Party};
use crate::gui::input::selection::Selection;
use crate::gui::input::speed_slider;
use crate::gui::session::{Phase, Session, Stage};
use crate::gui::widgets;
use crate::gui::widgets::explained::explain_at;
use crate::gui::widgets::paint::{Inks, quads};
use crate::gui::widgets::steady;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::language::{Language, say, word};
use crate::palette::text_on;
use crate::time::Time;
use crate::view::{
    Definition, Details, Highlight, Subject, TimeScale, TimeWindow, Timeline, TimelineLayout, activity_word, axis,
    bytes_words, count, fraction, node_name, time_words, timeline, timeline_at,
};

/// Width of the heads left of the lanes (number, slider, speed), in points.
const HEAD_WIDTH_PT: f32 = 20.0 * GRID;

/// Least height of a lane whose head has a slider, in points.
const MIN_SLIDER_LANE_PT: f32 = 16.0;
/// Least width of a panel whose lanes have heads with sliders, in points.
const MIN_SLIDER_WIDTH_PT: f32 = 75.0 * GRID;
/// Width of a lane's head without a slider, in points.
const NARROW_HEAD_PT: f32 = 6.0 * GRID;

/// Least height of a lane whose number stands in its chip, in points.
const MIN_NUMBERED_LANE_PT: f32 = 15.0;

/// The timeline panel.
#[derive(Default)]
pub struct TimelinePanel {
    window: TimeWindow,
    /// The last drawing, and what it depends on.
    cache: Option<(DrawingKey, Timeline)>,
    /// Shown time of the last frame.
    last_shown: Time,
}

/// Inputs of a drawing.
#[derive(Clone, Copy, PartialEq)]
struct DrawingKey {
    version: u64,
    window: TimeWindow,
    layout: TimelineLayout,
    length: Time,
}

/// Returns the height of the panel for this number of machines.
pub fn height(ui: &Ui, nodes: usize) -> f32 {
    let whole = ui.ctx().content_rect().height();
    // A low window leaves more room for picture and ring.
    let max = if whole < 600.0 { 0.27 } else { 0.36 } * whole;
    (54.0 + nodes as f32 * 22.0).clamp(12.0 * GRID, max.max(12.0 * GRID))
}

impl TimelinePanel {
    /// Resets the zoom for a new run.
    pub fn reset(&mut self) {
        *self = Self::default();
    }

    /// Shows all lanes.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        session: &mut Session,
        selection: &mut Selection,
        highlight: &Highlight,
        hovered: Option<&Details>,
    ) {
        let language = session.language();
        let look = Look::of(ui.ctx());
        let area = ui.available_rect_before_wrap();
        let nodes = session.header().speeds.len();
        // Low or short lanes have narrow heads without sliders.
        let has_sliders = area.width() >= MIN_SLIDER_WIDTH_PT
            && TimelineLayout::new(nodes, area.width(), area.height()).lane_height >= MIN_SLIDER_LANE_PT + 2.0;
        let left = if has_sliders { HEAD_WIDTH_PT } else { NARROW_HEAD_PT };
        let lanes = area.with_min_x(area.left() + left);
        let layout = TimelineLayout::new(nodes, lanes.width(), lanes.height());
        let response = steady::allocate_rect(ui, lanes, "lanes", Sense::click_and_drag());
        self.window.fit(session.stage().shown_length());
        self.follow(session.stage());
        zoom_and_pan(&mut self.window, ui, &response, lanes);
        self.window.fit(session.stage().shown_length());
        self.handle_pointer(&response, lanes, &layout, session, selection);
        let stage = session.stage();
        describe(&response, stage, language);
        if let Some(details) = hovered.filter(|_| response.hovered() && !response.dragged()) {
            let (title, more) = details.words(stage.state(), stage.now(), stage.playback_scale(), language);
            response.clone().on_hover_text_at_pointer(format!("{title}\n{more}"));
        }
        let painter = ui.painter_at(lanes.expand(1.0));
        self.paint(&painter, lanes, &layout, stage, highlight, look);
        usage(ui, (area, has_sliders), &layout, stage, look, language);
        let scale = TimeScale::of_length(stage.shown_length());
        self.axis(&painter, lanes, &layout, scale, look, language);
        for node in 0..nodes as NodeId {
            let [top, bottom] = layout.lane(node).map(|y| area.top() + y);
            let row = Rect::from_min_max(pos2(area.left(), top), pos2(area.left() + left - GRID, bottom));
            lane_head(ui, row, node, session, selection, highlight.nodes.contains(&node));
        }
        if layout.lane_height < MIN_NUMBERED_LANE_PT {
            numbers(ui.painter(), area, &layout, look);
        }
    }

    /// Keeps the shown time inside a zoomed window.
    fn follow(&mut self, stage: &Stage) {
        let moved = std::mem::replace(&mut self.last_shown, stage.lasted()) != self.last_shown;
        if moved && !self.window.shows_all() {
            self.window.show(self.last_shown);
        }
    }

    /// Paints the time axis below the lanes.
    fn axis(
        &self,
        painter: &Painter,
        lanes: Rect,
        layout: &TimelineLayout,
        scale: TimeScale,
        look: Look,
        language: Language,
    ) {
        if layout.axis_height == 0.0 {
            return;
        }
        let (times, rate) = axis(&self.window, layout.width);
        let top = lanes.top() + layout.bottom();
        for time in times {
            let x = lanes.left() + lanes.width() * self.window.share(time) as f32;
            painter.line_segment([pos2(x, top), pos2(x, top + 4.0)], Stroke::new(1.0, look.quiet));
            let words = time_words(time, scale.at_rate(rate), language);
            let galley = painter.layout_no_wrap(words, theme::regular(theme::SMALL), look.quiet);
            let left = (x + 4.0).min(lanes.right() - galley.size().x);
            painter.galley(pos2(left, top + 2.0), galley, look.quiet);
        }
    }

    /// Zooms in (`factor` < 1) or out round the shown time.
    pub fn zoom(&mut self, factor: f64, now: Time) {
        let share = self.window.share(now);
        let share = if (0.0..=1.0).contains(&share) { share } else { 0.5 };
        self.window.zoom(share, factor);
    }

    /// Reports what the pointer hovers. A click selects that and shows its time; a drag moves the shown time.
    fn handle_pointer(
        &self,
        response: &Response,
        lanes: Rect,
        layout: &TimelineLayout,
        session: &mut Session,
        selection: &mut Selection,
    ) {
        let Some(at) = response.hover_pos().or_else(|| response.interact_pointer_pos()) else { return };
        let time = self.window.at(f64::from((at.x - lanes.left()) / lanes.width()));
        let is_hidden = session.stage().hides_later && time > session.stage().lasted();
        let subject = timeline_at(session.stage().lanes(), &self.window, layout, (at - lanes.min).into());
        let subject = subject.filter(|_| !is_hidden);
        if let Some(subject) = subject {
            selection.hover(subject);
        }
        // A drag in a zoomed timeline pans it instead.
        if response.dragged() && self.window.shows_all() {
            session.drag_to(time, true);
        } else if response.drag_stopped() {
            session.let_time_go();
        } else if response.clicked() {
            selection.selected = subject;
            session.stage_mut().seek(time, true);
        }
    }

    /// Paints lanes, messages, highlights and the line of the shown time.
    fn paint(
        &mut self,
        painter: &Painter,
        lanes: Rect,
        layout: &TimelineLayout,
        stage: &Stage,
        highlight: &Highlight,
        look: Look,
    ) {
        let inks = Inks { look, nodes: &stage.colours };
        let length = stage.shown_length();
        let key = DrawingKey { version: stage.lanes().version(), window: self.window, layout: *layout, length };
        if self.cache.as_ref().is_none_or(|(cached, _)| *cached != key) {
            self.cache = Some((key, timeline(stage.lanes(), &self.window, layout, length)));
        }
        let Some((_, drawing)) = &self.cache else { return };
        let at = |[x, y]: [f32; 2]| lanes.min + vec2(x, y);
        for node in &highlight.nodes {
            let [top, bottom] = layout.lane(*node);
            let lane = Rect::from_min_max(at([0.0, top - 1.0]), at([layout.width, bottom + 1.0]));
            painter.rect_filled(lane, 2.0, look.raised);
        }
        painter.add(Shape::mesh(quads(&drawing.quads, lanes.min, &inks)));
        for (from, to, ink) in &drawing.lines {
            painter.line_segment([at(*from), at(*to)], Stroke::new(1.25, inks.colour(*ink)));
        }
        let x = |time: Time| lanes.left() + lanes.width() * self.window.share(time).clamp(-1.0, 2.0) as f32;
        if let Some((node, bar)) = highlight.bar {
            let [top, bottom] = layout.lane(node);
            let rect = Rect::from_min_max(
                pos2(x(bar.from), lanes.top() + top),
                pos2(x(bar.to).max(x(bar.from) + 2.0), lanes.top() + bottom),
            );
            painter.rect_stroke(rect.expand(1.5), 1.0, Stroke::new(2.0, look.text), egui::StrokeKind::Outside);
        }
        if let Some(trip) = highlight.message.and_then(|id| stage.lanes().trip(id)) {
            let height = |party| match party {
                Party::Node(node) => {
                    let [top, bottom] = layout.lane(node);
                    lanes.top() + (top + bottom) / 2.0
                }
                Party::Parent => lanes.top(),
            };
            let line = [pos2(x(trip.sent), height(trip.from)), pos2(x(trip.arrives), height(trip.to))];
            painter.line_segment(line, Stroke::new(3.0, look.text));
            for end in line {
                painter.circle_filled(end, 4.0, look.text);
            }
        }
        let now = x(stage.lasted());
        if !stage.is_live() && !stage.shows_end() {
            let later = Rect::from_min_max(pos2(now.max(lanes.left()), lanes.top()), lanes.max);
            let opacity = if stage.hides_later { 1.0 } else { 0.55 };
            painter.rect_filled(later, 0.0, look.ground.gamma_multiply(opacity));
        }
        painter.line_segment(
            [pos2(now, lanes.top() + 0.5 * layout.header_height), pos2(now, lanes.top() + layout.bottom())],
            Stroke::new(1.5, look.accent),
        );
    }
}

/// Zooms with the wheel or a pinch, pans with a drag or a horizontal scroll; a double click shows everything.
pub fn zoom_and_pan(window: &mut TimeWindow, ui: &Ui, response: &Response, lanes: Rect) {
    if let Some(at) = response.hover_pos() {
        let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta(), input.zoom_delta()));
        let factor = f64::from((-scroll.y * 0.005).exp() / pinch);
        if factor != 1.0 {
            window.zoom(f64::from((at.x - lanes.left()) / lanes.width()), factor);
        }
        if scroll.x != 0.0 {
            window.pan(-f64::from(scroll.x / lanes.width()));
        }
    }
    if response.double_clicked() {
        window.show_all();
    } else if response.dragged() && !window.shows_all() {
        window.pan(-f64::from(response.drag_delta().x / lanes.width()));
    }
}

/// Shows the head of a lane: the machine's number, slider and speed.
fn lane_head(
    ui: &mut Ui,
    row: Rect,
    node: NodeId,
    session: &mut Session,
    selection: &mut Selection,
    is_highlighted: bool,
) {
    let language = session.language();
    let look = Look::of(ui.ctx());
    let response = ui.interact(row, ui.scope_id().with(("lane", node)), Sense::click());
    let stage = session.stage();
    let name = node_name(node);
    widgets::describe(&response, &say!(language, "Lane of machine {name}", "Pista da máquina {name}"), || {
        let atoms = stage.lanes().lanes()[usize::from(node)].bars().len();
        let activity = activity_word(stage.state().activity(node, stage.now()), language);
        say!(language, "{atoms} atoms traced so far, {activity}", "{atoms} átomos calculados até agora, {activity}")
    });
    if response.hovered() {
        selection.hover(Subject::Node(node));
    }
    if response.clicked() {
        selection.toggle(Subject::Node(node));
    }
    let own = stage.colours[usize::from(node)];
    let side = row.height().min(3.0 * GRID);
    let chip = Rect::from_min_size(row.min, vec2(side.max(2.5 * GRID), row.height()));
    ui.painter().rect_filled(chip, 4.0, theme::colour(own));
    if is_highlighted {
        let stroke = Stroke::new(1.5, look.text);
        ui.painter().rect_stroke(chip.expand(1.0), 4.0, stroke, egui::StrokeKind::Outside);
    }
    if row.height() >= MIN_NUMBERED_LANE_PT - 2.0 {
        let ink = theme::colour(text_on(own));
        let font = theme::strong(theme::SMALL.min(row.height()));
        ui.painter().text(chip.center(), Align2::CENTER_CENTER, node_name(node), font, ink);
    }
    if row.height() >= MIN_SLIDER_LANE_PT && row.width() > NARROW_HEAD_PT {
        let slider = Rect::from_min_max(pos2(chip.right() + GRID, row.top()), row.max);
        let at = UiBuilder::new().max_rect(slider).id_salt(("lane slider", node));
        ui.scope_builder(at, |ui| speed_slider::show(ui, node, slider.width() - 6.5 * GRID, session, true));
        let speed = fraction(session.speed(node));
        let right = pos2(slider.right(), row.center().y);
        ui.painter().text(right, Align2::RIGHT_CENTER, speed, theme::regular(theme::SMALL), look.quiet);
    }
}

/// Paints the numbers of low lanes beside their chips, as many as have room.
fn numbers(painter: &Painter, area: Rect, layout: &TimelineLayout, look: Look) {
    let chip_width = 2.5 * GRID;
    for node in layout.numbered(MIN_NUMBERED_LANE_PT) {
        let [top, bottom] = layout.lane(node);
        let left = pos2(area.left() + chip_width + GRID / 2.0, area.top() + (top + bottom) / 2.0);
        painter.text(left, Align2::LEFT_CENTER, node_name(node), theme::regular(11.0), look.quiet);
    }
}

/// Paints the figures of the machines' usage up to the shown time, as many as fit, above the strip that shows it. Each
/// explains itself.
fn usage(
    ui: &Ui,
    (area, has_caption): (Rect, bool),
    lanes: &TimelineLayout,
    stage: &Stage,
    look: Look,
    language: Language,
) {
    if lanes.header_height == 0.0 || stage.lasted() == Time::ZERO {
        return;
    }
    let painter = ui.painter_at(area);
    let layout = |text: &str| painter.layout_no_wrap(text.to_owned(), theme::regular(theme::SMALL), look.quiet);
    let mut corner = area.min;
    for (text, definition) in usage_figures(stage, language) {
        let dot = if corner.x > area.left() { "  ·  " } else { "" };
        let (dot, galley) = (layout(dot), layout(&text));
        let place = Rect::from_min_size(corner + vec2(dot.size().x, 0.0), galley.size());
        if place.right() > area.right() {
            break;
        }
        painter.galley(corner, dot, look.quiet);
        painter.galley(place.min, galley, look.quiet);
        explain_at(ui, (place, 0), definition, language);
        corner = place.right_top();
    }
    // Narrow heads have no room for the caption.
    if !has_caption {
        return;
    }
    let label = layout(Definition::IN_USE.name(language));
    let corner = pos2(area.left(), area.top() + lanes.header_height - label.size().y - 4.0);
    explain_at(ui, (Rect::from_min_size(corner, label.size()), 0), Definition::IN_USE, language);
    painter.galley(corner, label, look.quiet);
}

/// Returns the figures of the machines' usage up to the shown time, with their definitions.
fn usage_figures(stage: &Stage, language: Language) -> [(String, Definition); 4] {
    let usage = stage.lanes().usage(stage.lasted());
    let [used, above, under_way] = [usage.utilisation, usage.imbalance, usage.on_the_way].map(fraction);
    let (messages, bytes) = (count(usage.messages as u64), bytes_words(usage.bytes, language));
    [
        (
            say!(language, "{used} of the machines' time spent tracing", "{used} do tempo das máquinas calculando"),
            Definition::TIME_USED,
        ),
        (
            say!(language, "busiest machine {above} above the mean", "máquina mais ocupada {above} acima da média"),
            Definition::IMBALANCE,
        ),
        (
            say!(
                language,
                "{under_way} with an offer or atoms on the way",
                "{under_way} com oferta ou átomos a caminho"
            ),
            Definition::ON_THE_WAY,
        ),
        (say!(language, "{messages} messages, {bytes}", "{messages} mensagens, {bytes}"), Definition::MESSAGES),
    ]
}

/// Describes the timeline for screen readers.
fn describe(response: &Response, stage: &Stage, language: Language) {
    widgets::describe(response, word!(language, "Timeline", "Linha do tempo"), || {
        let [until, length] =
            [stage.lasted(), stage.shown_length()].map(|time| time_words(time, stage.playback_scale(), language));
        let is_over = stage.phase == Phase::Finished && !stage.hides_later;
        let of = if is_over { word!(language, "in all", "ao todo") } else { word!(language, "so far", "até agora") };
        let usage = usage_figures(stage, language).map(|(text, _)| text).join(" · ");
        say!(language, "{until} of {length} {of}: {usage}", "{until} de {length} {of}: {usage}")
    });
}

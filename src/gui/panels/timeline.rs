//! A lane a machine: what it traced and when, what it waited for, and which messages went from one to another.

use egui::{Align2, Painter, Rect, Response, Sense, Shape, Stroke, Ui, UiBuilder, pos2, vec2};

use super::nodes;
use crate::balance::{NodeId, Party};
use crate::gui::input::selection::Selection;
use crate::gui::session::{Phase, Session, Stage};
use crate::gui::widgets;
use crate::gui::widgets::paint::{Inks, quads};
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::language::{Language, say, word};
use crate::palette::text_on;
use crate::time::Time;
use crate::view::{
    Details, Highlight, Subject, TimeWindow, Timeline, TimelineLayout, activity_word, axis, bytes_words, count,
    fraction, node_name, time_words, timeline, timeline_at,
};

/// What is left of the lanes: number, speed.
const LEFT: f32 = 20.0 * GRID;

/// Lanes of this height have a slider beside them.
const SLIDER: f32 = 16.0;

/// What is seen of the run's time, and what was drawn of it.
#[derive(Default)]
pub struct TimelinePanel {
    window: TimeWindow,
    drawn: Option<(Key, Timeline)>,
    /// The time that was shown in the frame before.
    shown: Time,
}

/// What a drawing depends on.
#[derive(Clone, Copy, PartialEq)]
struct Key {
    version: u64,
    window: TimeWindow,
    plan: TimelineLayout,
    head: Time,
}

/// How high the panel of so many lanes is to be, perhaps below a lesson.
pub fn height(ui: &Ui, nodes: usize, has_lesson: bool) -> f32 {
    let whole = ui.ctx().content_rect().height();
    // In a low window picture and ring still need their room.
    let is_low = whole < if has_lesson { 700.0 } else { 600.0 };
    let most = if is_low { 0.27 } else { 0.36 } * whole;
    (54.0 + nodes as f32 * 22.0).clamp(12.0 * GRID, most.max(12.0 * GRID))
}

impl TimelinePanel {
    /// A run begins: all of it is seen.
    pub fn begin(&mut self) {
        *self = Self::default();
    }

    /// Shows all lanes.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        session: &mut Session,
        focus: &mut Selection,
        lit: &Highlight,
        hovered: Option<&Details>,
    ) {
        let language = session.language();
        let look = Look::of(ui.ctx());
        let area = ui.available_rect_before_wrap();
        let nodes = session.header().speeds.len();
        // Low lanes have no sliders, and need less room for what stands beside them.
        let has_sliders = TimelineLayout::new(nodes, area.width(), area.height()).lane_height >= SLIDER + 2.0;
        let left = if has_sliders { LEFT } else { 6.0 * GRID };
        let place = area.with_min_x(area.left() + left);
        let plan = TimelineLayout::new(nodes, place.width(), place.height());
        let response = ui.allocate_rect(place, Sense::click_and_drag());
        self.window.fit(session.stage().told_length());
        self.follow(session.stage());
        self.move_about(ui, &response, place);
        self.window.fit(session.stage().told_length());
        self.point(&response, place, &plan, session, focus);
        let stage = session.stage();
        describe(&response, stage, language);
        if let Some(about) = hovered.filter(|_| response.hovered() && !response.dragged()) {
            let (title, more) = about.words(stage.state(), stage.now(), stage.grain(), language);
            response.clone().on_hover_text_at_pointer(format!("{title}\n{more}"));
        }
        let painter = ui.painter_at(place.expand(1.0));
        self.paint(&painter, place, &plan, stage, lit, look);
        usage(&ui.painter_at(area), area, &plan, stage, look, language);
        self.axis(&painter, place, &plan, look, language);
        for node in 0..nodes as NodeId {
            let [top, bottom] = plan.lane(node).map(|y| area.top() + y);
            let row = Rect::from_min_max(pos2(area.left(), top), pos2(area.left() + left - GRID, bottom));
            lane_head(ui, row, node, session, focus, lit.nodes.contains(&node));
        }
    }

    /// Whoever looks at a part of the run goes along with its time.
    fn follow(&mut self, stage: &Stage) {
        let moved = std::mem::replace(&mut self.shown, stage.lasted()) != self.shown;
        if moved && !self.window.shows_all() {
            self.window.show(self.shown);
        }
    }

    /// Wheel and fingers: nearer, further, to and fro.
    fn move_about(&mut self, ui: &Ui, response: &Response, place: Rect) {
        if let Some(at) = response.hover_pos() {
            let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta(), input.zoom_delta()));
            let factor = f64::from((-scroll.y * 0.005).exp() / pinch);
            if factor != 1.0 {
                self.window.zoom(f64::from((at.x - place.left()) / place.width()), factor);
            }
            if scroll.x != 0.0 {
                self.window.pan(-f64::from(scroll.x / place.width()));
            }
        }
        if response.double_clicked() {
            self.window.show_all();
        } else if response.dragged() && !self.window.shows_all() {
            self.window.pan(-f64::from(response.drag_delta().x / place.width()));
        }
    }

    /// Times below the lanes.
    fn axis(&self, painter: &Painter, place: Rect, plan: &TimelineLayout, look: Look, language: Language) {
        if plan.axis_height == 0.0 {
            return;
        }
        let (times, rate) = axis(&self.window, plan.width);
        let top = place.top() + plan.bottom();
        for time in times {
            let x = place.left() + place.width() * self.window.share(time) as f32;
            painter.line_segment([pos2(x, top), pos2(x, top + 4.0)], Stroke::new(1.0, look.quiet));
            let words =
                painter.layout_no_wrap(time_words(time, rate, language), theme::regular(theme::SMALL), look.quiet);
            let left = (x + 4.0).min(place.right() - words.size().x);
            painter.galley(pos2(left, top + 2.0), words, look.quiet);
        }
    }

    /// Nearer (less than 1) or further, about the shown time.
    pub fn zoom(&mut self, factor: f64, now: Time) {
        let share = self.window.share(now);
        let share = if (0.0..=1.0).contains(&share) { share } else { 0.5 };
        self.window.zoom(share, factor);
    }

    /// What the pointer is on, and what a click does: it selects, and goes to that time.
    fn point(
        &self,
        response: &Response,
        place: Rect,
        plan: &TimelineLayout,
        session: &mut Session,
        focus: &mut Selection,
    ) {
        let Some(at) = response.hover_pos().or_else(|| response.interact_pointer_pos()) else { return };
        let time = self.window.at(f64::from((at.x - place.left()) / place.width()));
        let is_hidden = session.stage().hides_later && time > session.stage().lasted();
        let about = timeline_at(session.stage().lanes(), &self.window, plan, (at - place.min).into());
        let about = about.filter(|_| !is_hidden);
        if let Some(about) = about {
            focus.hover(about);
        }
        // All of a run that is seen is dragged through like on the line above.
        if response.dragged() && self.window.shows_all() {
            session.drag_to(time, true);
        } else if response.drag_stopped() {
            session.let_time_go();
        } else if response.clicked() {
            focus.selected = about;
            session.stage_mut().seek(time, true);
        }
    }

    fn paint(
        &mut self,
        painter: &Painter,
        place: Rect,
        plan: &TimelineLayout,
        stage: &Stage,
        lit: &Highlight,
        look: Look,
    ) {
        let inks = Inks { look, nodes: &stage.colours };
        let head = stage.told_length();
        let key = Key { version: stage.lanes().version(), window: self.window, plan: *plan, head };
        if self.drawn.as_ref().is_none_or(|(drawn, _)| *drawn != key) {
            self.drawn = Some((key, timeline(stage.lanes(), &self.window, plan, head)));
        }
        let Some((_, drawn)) = &self.drawn else { return };
        let at = |[x, y]: [f32; 2]| place.min + vec2(x, y);
        for node in &lit.nodes {
            let [top, bottom] = plan.lane(*node);
            let lane = Rect::from_min_max(at([0.0, top - 1.0]), at([plan.width, bottom + 1.0]));
            painter.rect_filled(lane, 2.0, look.raised);
        }
        painter.add(Shape::mesh(quads(&drawn.quads, place.min, &inks)));
        for (from, to, ink) in &drawn.lines {
            painter.line_segment([at(*from), at(*to)], Stroke::new(1.25, inks.colour(*ink)));
        }
        let x = |time: Time| place.left() + place.width() * self.window.share(time).clamp(-1.0, 2.0) as f32;
        if let Some((node, bar)) = lit.bar {
            let [top, bottom] = plan.lane(node);
            let rect = Rect::from_min_max(
                pos2(x(bar.from), place.top() + top),
                pos2(x(bar.to).max(x(bar.from) + 2.0), place.top() + bottom),
            );
            painter.rect_stroke(rect.expand(1.5), 1.0, Stroke::new(2.0, look.text), egui::StrokeKind::Outside);
        }
        if let Some(trip) = lit.message.and_then(|id| stage.lanes().trip(id)) {
            let height = |party| match party {
                Party::Node(node) => {
                    let [top, bottom] = plan.lane(node);
                    place.top() + (top + bottom) / 2.0
                }
                Party::Parent => place.top(),
            };
            let line = [pos2(x(trip.sent), height(trip.from)), pos2(x(trip.arrives), height(trip.to))];
            painter.line_segment(line, Stroke::new(3.0, look.text));
            for end in line {
                painter.circle_filled(end, 4.0, look.text);
            }
        }
        let now = x(stage.lasted());
        if !stage.is_live() && !stage.shows_end() {
            let later = Rect::from_min_max(pos2(now.max(place.left()), place.top()), place.max);
            let strength = if stage.hides_later { 1.0 } else { 0.55 };
            painter.rect_filled(later, 0.0, look.ground.gamma_multiply(strength));
        }
        painter.line_segment(
            [pos2(now, place.top() + 0.5 * plan.header_height), pos2(now, place.top() + plan.bottom())],
            Stroke::new(1.5, look.accent),
        );
    }
}

/// A lane's number and speed, at its left.
fn lane_head(ui: &mut Ui, row: Rect, node: NodeId, session: &mut Session, focus: &mut Selection, is_lit: bool) {
    let language = session.language();
    let look = Look::of(ui.ctx());
    let response = ui.interact(row, ui.scope_id().with(("lane", node)), Sense::click());
    let stage = session.stage();
    let name = node_name(node);
    widgets::describe(&response, &say!(language, "Lane of {name}", "Pista de {name}"), || {
        let usage = stage.lanes().lanes()[usize::from(node)].bars().len();
        let doing = activity_word(stage.state().activity(node, stage.now()), language);
        say!(language, "{usage} atoms traced so far, {doing}", "{usage} átomos calculados até agora, {doing}")
    });
    if response.hovered() {
        focus.hover(Subject::Node(node));
    }
    if response.clicked() {
        focus.toggle(Subject::Node(node));
    }
    let own = stage.colours[usize::from(node)];
    let side = row.height().min(3.0 * GRID);
    let chip = Rect::from_min_size(row.min, vec2(side.max(2.5 * GRID), row.height()));
    ui.painter().rect_filled(chip, 4.0, theme::colour(own));
    if is_lit {
        let stroke = Stroke::new(1.5, look.text);
        ui.painter().rect_stroke(chip.expand(1.0), 4.0, stroke, egui::StrokeKind::Outside);
    }
    // Where lanes are low some numbers stand beside them.
    let each = (13.0 / row.height().max(1.0)).ceil() as u16;
    if each == 1 {
        let ink = theme::colour(text_on(own));
        let font = theme::strong(theme::SMALL.min(row.height()));
        ui.painter().text(chip.center(), Align2::CENTER_CENTER, node_name(node), font, ink);
    } else if node.is_multiple_of(each) {
        let place = pos2(chip.right() + GRID, row.center().y);
        ui.painter().text(place, Align2::LEFT_CENTER, node_name(node), theme::regular(11.0), look.quiet);
    }
    if row.height() >= SLIDER {
        let slider = Rect::from_min_max(pos2(chip.right() + GRID, row.top()), row.max);
        let at = UiBuilder::new().max_rect(slider).id_salt(("lane slider", node));
        ui.scope_builder(at, |ui| nodes::speed_slider(ui, node, slider.width() - 6.5 * GRID, session));
        let speed = fraction(session.speed(node));
        let place = pos2(slider.right(), row.center().y);
        ui.painter().text(place, Align2::RIGHT_CENTER, speed, theme::regular(theme::SMALL), look.quiet);
    }
}

/// How the machines' time was used until the shown time, in as many words as fit, above the strip that shows it.
fn usage(painter: &Painter, area: Rect, plan: &TimelineLayout, stage: &Stage, look: Look, language: Language) {
    if plan.header_height == 0.0 || stage.lasted() == Time::ZERO {
        return;
    }
    let layout = |text: String| painter.layout_no_wrap(text, theme::regular(theme::SMALL), look.quiet);
    let words = usage_words(stage, language);
    let mut galleys = (1..=words.len()).rev().map(|parts| layout(words[..parts].join(" · ")));
    if let Some(galley) = galleys.find(|galley| galley.size().x <= area.width()) {
        painter.galley(area.min, galley, look.quiet);
    }
    // Beside low lanes there is no room for it.
    if plan.lane_height < SLIDER + 2.0 {
        return;
    }
    let label = layout(word!(language, "machines in use", "máquinas em uso").into());
    let place = pos2(area.left(), area.top() + plan.header_height - label.size().y - 4.0);
    painter.galley(place, label, look.quiet);
}

fn usage_words(stage: &Stage, language: Language) -> [String; 4] {
    let usage = stage.lanes().usage(stage.lasted());
    let [used, above, under_way] = [usage.utilisation, usage.imbalance, usage.on_the_way].map(fraction);
    let (messages, bytes) = (count(usage.messages as u64), bytes_words(usage.bytes, language));
    [
        say!(language, "{used} of the machines' time used", "{used} do tempo das máquinas usado"),
        say!(language, "busiest machine {above} above the mean", "a mais ocupada {above} acima da média"),
        say!(language, "{under_way} with an offer or atoms on the way", "{under_way} com oferta ou átomos a caminho"),
        say!(language, "{messages} messages, {bytes}", "{messages} mensagens, {bytes}"),
    ]
}

fn describe(response: &Response, stage: &Stage, language: Language) {
    widgets::describe(response, word!(language, "Timeline", "Linha do tempo"), || {
        let [until, length] =
            [stage.lasted(), stage.told_length()].map(|time| time_words(time, stage.grain(), language));
        let over = stage.phase == Phase::Finished && !stage.hides_later;
        let of = if over { word!(language, "in all", "ao todo") } else { word!(language, "so far", "até agora") };
        let usage = usage_words(stage, language).join(" · ");
        say!(language, "{until} of {length} {of}: {usage}", "{until} de {length} {of}: {usage}")
    });
}

//! The few widgets of the window: a button, a slim slider, an exact value, a choice.

pub mod canvas_texture;
pub mod icons;
pub mod paint;
pub mod picture_view;
pub mod test_positions;
pub mod theme;

use std::ops::RangeInclusive;

use egui::text::{CCursor, CCursorRange};
use egui::text_edit::TextEditState;
use egui::{
    Align, Color32, Context, DragValue, Frame, Key, Label, Layout, Rect, Response, RichText, Role, Sense, Stroke,
    StrokeKind, TextEdit, TextStyle, Ui, Vec2, WidgetInfo, pos2, vec2,
};

use crate::language::{Language, word};
use icons::Icon;
use theme::{GRID, Look};

/// What a painted view is called, and what there is to be seen in it, for those who cannot see it.
pub fn describe(response: &Response, name: &str, seen: impl Fn() -> String) {
    response.widget_info(|| {
        let mut info = WidgetInfo::labeled(Role::Image, true, name);
        info.current_text_value = Some(seen());
        info
    });
}

/// How a button stands out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Emphasis {
    /// One of many.
    Quiet,
    /// What it stands for is the case, or open.
    On,
    /// The one to press first.
    Primary,
}

/// A button. `name` is its accessible name, and its words if `words`.
pub fn button(ui: &mut Ui, icon: Option<Icon>, name: &str, words: bool, weight: Emphasis) -> Response {
    named_button(ui, icon, name, words.then_some(name), weight)
}

/// A button whose words are not its accessible name.
pub fn named_button(ui: &mut Ui, icon: Option<Icon>, name: &str, words: Option<&str>, weight: Emphasis) -> Response {
    let look = Look::of(ui.ctx());
    let text_font = TextStyle::Button.resolve(ui.style());
    let galley = words.map(|words| ui.painter().layout_no_wrap(words.to_owned(), text_font, Color32::PLACEHOLDER));
    let icon_side = 2.0 * GRID;
    let text_width = galley.as_ref().map_or(0.0, |galley| galley.size().x);
    let icon_width = if icon.is_some() { icon_side } else { 0.0 };
    let gap = if galley.is_some() && icon.is_some() { GRID } else { 0.0 };
    let size = vec2(icon_width + gap + text_width + if galley.is_some() { 3.0 } else { 2.0 } * GRID, 4.0 * GRID);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    response.widget_info(|| WidgetInfo::selected(Role::Button, ui.is_enabled(), weight == Emphasis::On, name));
    if ui.is_rect_visible(rect) {
        let hovered = response.hovered() || response.is_pointer_button_down_on();
        let (fill, text) = match (weight, hovered) {
            (Emphasis::Primary, false) => (look.accent, look.on_accent),
            (Emphasis::Primary, true) => (look.accent.gamma_multiply(0.85), look.on_accent),
            (Emphasis::Quiet, false) => (look.raised, look.text),
            (Emphasis::On, _) | (Emphasis::Quiet, true) => (look.hairline, look.text),
        };
        ui.painter().rect_filled(rect, 6.0, fill);
        if weight == Emphasis::On {
            let line = Stroke::new(1.5, look.accent);
            ui.painter().rect_stroke(rect, 6.0, line, StrokeKind::Inside);
        }
        focus_ring(ui, &response, rect, look);
        let mut left = rect.center().x - (icon_width + gap + text_width) / 2.0;
        if let Some(icon) = icon {
            let place = Rect::from_center_size(pos2(left + icon_side / 2.0, rect.center().y), Vec2::splat(icon_side));
            icons::paint(ui.painter(), icon, place, text);
            left = place.right() + GRID;
        }
        if let Some(galley) = galley {
            let place = pos2(left, rect.center().y - galley.size().y / 2.0);
            ui.painter().galley(place, galley, text);
        }
    }
    response
}

/// What follows `now` in `all`, after the last the first.
pub fn next_of<T: Copy + PartialEq>(all: &[T], now: T) -> T {
    all.iter().cycle().skip_while(|other| **other != now).nth(1).copied().unwrap_or(now)
}

/// Buttons of which one is on; returns what was pressed. Each has a value, an accessible name that is also its words, and
/// a hint.
pub fn choice<T: Copy + PartialEq>(ui: &mut Ui, on: T, all: &[(T, &str, &str)]) -> Option<T> {
    let mut pressed = None;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = GRID / 2.0;
        for &(value, name, hint) in all {
            let weight = if value == on { Emphasis::On } else { Emphasis::Quiet };
            if button(ui, None, name, true, weight).on_hover_text(hint).clicked() {
                pressed = Some(value);
            }
        }
    });
    pressed
}

/// What was done with a field of text.
pub struct TextFieldResponse {
    /// Something was typed.
    pub changed: bool,
    /// Enter was pressed.
    pub entered: bool,
    /// Whoever types, types there.
    pub focused: bool,
}

/// A field for a path, with a hint while it is empty. It gets the focus if it `wants_focus`, and keeps it on Enter:
/// whoever has mistyped goes on typing. `name` is its accessible name.
pub fn path_field(
    ui: &mut Ui,
    (path, hint): (&mut String, &str),
    width: f32,
    name: &str,
    wants_focus: &mut bool,
) -> TextFieldResponse {
    let hint = RichText::new(hint).color(Look::of(ui.ctx()).quiet);
    let field = TextEdit::singleline(path).desired_width(width).hint_text(hint).margin(vec2(GRID, 0.75 * GRID));
    let field = ui.add(field);
    field.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, name));
    let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
    let begins = std::mem::take(wants_focus);
    if begins || entered {
        field.request_focus();
    }
    if begins {
        // The name is what one would change, rather than the directory or the ending.
        let mut state = TextEditState::load(ui.ctx(), field.id).unwrap_or_default();
        let [from, to] = stem(path).map(CCursor::new);
        state.cursor.set_char_range(Some(CCursorRange::two(from, to)));
        state.store(ui.ctx(), field.id);
    }
    TextFieldResponse { changed: field.changed(), entered, focused: field.has_focus() }
}

/// Where in a path the file's name without its ending begins and ends, in characters.
fn stem(path: &str) -> [usize; 2] {
    let name = path.rfind(std::path::is_separator).map_or(0, |separator| separator + 1);
    let end = path[name..].rfind('.').filter(|&dot| dot > 0).map_or(path.len(), |dot| name + dot);
    [name, end].map(|place| path[..place].chars().count())
}

/// What lies round the content of a popup.
pub fn popup_frame(ctx: &Context) -> Frame {
    let look = Look::of(ctx);
    Frame::popup(&ctx.global_style()).fill(look.ground).stroke(Stroke::new(1.0, look.hairline)).inner_margin(GRID)
}

/// A slim slider, in steps of 1 if `whole`, its filled part in `colour`. `name` is its accessible name.
pub fn slider(
    ui: &mut Ui,
    value: &mut f64,
    (range, whole): (RangeInclusive<f64>, bool),
    width: f32,
    colour: Color32,
    name: &str,
) -> Response {
    ui.scope(|ui| {
        let look = Look::of(ui.ctx());
        ui.spacing_mut().slider_width = width;
        ui.spacing_mut().interact_size.y = 2.5 * GRID;
        let visuals = ui.visuals_mut();
        visuals.selection.bg_fill = colour;
        for state in [&mut visuals.widgets.inactive, &mut visuals.widgets.hovered, &mut visuals.widgets.active] {
            state.bg_fill = look.hairline;
            state.fg_stroke = Stroke::NONE;
        }
        let (least, most) = (*range.start(), *range.end());
        let slider = egui::Slider::new(value, range).step_by(if whole { 1.0 } else { 0.0 }).show_value(false);
        let response = ui.add(slider);
        // Without words beside it the slider has no name of its own.
        response.widget_info(|| WidgetInfo::slider(ui.is_enabled(), *value, name));
        // Over egui's handle, which has the rail's colour while nobody touches it.
        let radius = response.rect.height() / 2.5;
        let left = response.rect.left() + radius;
        let share = ((*value - least) / (most - least)).clamp(0.0, 1.0) as f32;
        let x = left + (response.rect.width() - 2.0 * radius) * share;
        let handle = pos2(x, response.rect.center().y);
        let grown = if response.hovered() || response.dragged() { 9.0 } else { 8.0 };
        let line = if ui.is_enabled() { look.text } else { look.quiet };
        ui.painter().circle(handle, grown, colour, Stroke::new(2.0, line));
        if response.has_focus() {
            ui.painter().circle_stroke(handle, grown + 3.0, Stroke::new(1.5, look.accent));
        }
        response
    })
    .inner
}

/// An exact value, to be typed or dragged. `name` is its accessible name.
pub fn number<N: egui::emath::Numeric>(
    ui: &mut Ui,
    value: &mut N,
    range: RangeInclusive<N>,
    suffix: &str,
    width: f32,
    name: &str,
) -> Response {
    ui.scope(|ui| {
        // In a low row the text is small.
        let height = ui.available_height().min(3.5 * GRID);
        ui.spacing_mut().interact_size = vec2(width, height);
        ui.spacing_mut().button_padding = vec2(0.75 * GRID, 0.0);
        if height < 3.0 * GRID {
            ui.style_mut().override_font_id = Some(theme::regular(theme::SMALL));
        }
        let speed = (range.end().to_f64() - range.start().to_f64()).clamp(10.0, 2000.0) / 400.0;
        let response = ui.add(DragValue::new(value).range(range).suffix(suffix).max_decimals(0).speed(speed));
        let exact = value.to_f64();
        response.widget_info(|| WidgetInfo {
            label: Some(name.to_owned()),
            ..WidgetInfo::drag_value(ui.is_enabled(), exact)
        });
        response
    })
    .inner
}

/// The content of a menu of what can be done to a machine or a message, where anything can; returns what was chosen.
pub fn deeds<T>(
    ui: &mut Ui,
    title: &str,
    deeds: impl IntoIterator<Item = (T, String)>,
    (is_possible, hint): (bool, &str),
    look: Look,
    language: Language,
) -> Option<T> {
    ui.set_width(34.0 * GRID);
    let title = Label::new(RichText::new(title).font(theme::strong(theme::BODY)).color(look.text)).wrap();
    ui.with_layout(Layout::top_down(Align::Min), |ui| ui.add(title));
    let mut chosen = None;
    for (deed, words) in deeds {
        ui.add_enabled_ui(is_possible, |ui| {
            if button(ui, None, &words, true, Emphasis::Quiet).clicked() {
                chosen = Some(deed);
                ui.close();
            }
        });
    }
    let never = word!(language, "Only while a run goes on, live", "Só enquanto uma execução acontece, ao vivo");
    let hint = RichText::new(if is_possible { hint } else { never });
    let hint = Label::new(hint.font(theme::regular(theme::SMALL)).color(look.quiet)).wrap();
    // A menu would stretch its lines.
    ui.with_layout(Layout::top_down(Align::Min), |ui| ui.add(hint));
    chosen
}

/// A title, and below it what there is to say.
pub fn more_words(ui: &mut Ui, title: &str, lines: &[(&'static str, String)], look: Look) {
    ui.spacing_mut().interact_size.y = 0.0;
    ui.label(RichText::new(title).font(theme::strong(theme::BODY)).color(look.text));
    egui::Grid::new("more").spacing([2.0 * GRID, 0.25 * GRID]).show(ui, |ui| {
        for (what, how_much) in lines {
            ui.label(RichText::new(*what).font(theme::regular(theme::SMALL)).color(look.quiet));
            ui.label(RichText::new(how_much).font(theme::regular(theme::SMALL)).color(look.text));
            ui.end_row();
        }
    });
}

fn focus_ring(ui: &Ui, response: &Response, rect: Rect, look: Look) {
    if response.has_focus() {
        let stroke = Stroke::new(1.5, look.accent);
        ui.painter().rect_stroke(rect.expand(2.0), 8.0, stroke, StrokeKind::Outside);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_files_stem_is_found() {
        let found = |path: &str| {
            let [from, to] = stem(path);
            path.chars().skip(from).take(to - from).collect::<String>()
        };
        assert_eq!(found("/home/é/my.picture.png"), "my.picture");
        assert_eq!(found("picture"), "picture");
        assert_eq!(found("/tmp/.hidden"), ".hidden");
        assert_eq!((found("/tmp/"), found("")), (String::new(), String::new()));
    }
}

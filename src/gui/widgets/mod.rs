//! Widgets: buttons, slider, number field, menu, tooltip; and fonts, colours and the painter of display lists.

pub mod canvas_texture;
pub mod explained;
pub mod icons;
pub mod number;
pub mod paint;
pub mod path_input;
pub mod picture_view;
pub mod progress;
pub mod slider;
pub mod steady;
pub mod test_positions;
pub mod theme;

use std::cell::Cell;
use std::ops::RangeInclusive;

use egui::{
    Align, Color32, Context, DragValue, Frame, Id, Key, Label, Layout, Modifiers, Rect, RectAlign, Response, RichText,
    Role, Sense, Stroke, StrokeKind, TextStyle, Tooltip, Ui, UiBuilder, Vec2, WidgetInfo, pos2, vec2,
};

use crate::language::Language;
use icons::Icon;
use number::{NumberError, RefusedNumber};
use steady::steady_id;
use theme::{GRID, Look};

/// Gives a painted view an accessible name and a text of its content for screen readers.
pub fn describe(response: &Response, name: &str, content: impl Fn() -> String) {
    response.widget_info(|| {
        let mut info = WidgetInfo::labeled(Role::Image, true, name);
        info.current_text_value = Some(content());
        info
    });
}

/// Emphasis of a button.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Emphasis {
    /// Normal.
    Quiet,
    /// Its option is chosen, or its page is open.
    On,
    /// The main action.
    Primary,
}

/// Shows a button. `name` is its accessible name, and its text if `has_text`.
pub fn button(ui: &mut Ui, icon: Option<Icon>, name: &str, has_text: bool, emphasis: Emphasis) -> Response {
    named_button(ui, icon, name, has_text.then_some(name), emphasis)
}

/// Shows a button whose text differs from its accessible name.
pub fn named_button(ui: &mut Ui, icon: Option<Icon>, name: &str, text: Option<&str>, emphasis: Emphasis) -> Response {
    paint_button(ui, name, icon, (name, text), 0.0, emphasis)
}

/// Shows a button that has room for a text of this width, in points: its own text may change, and its size does not.
/// There is one in its place.
pub fn button_with_room(ui: &mut Ui, icon: Icon, name: &str, room: f32, emphasis: Emphasis) -> Response {
    paint_button(ui, "button with room", Some(icon), (name, Some(name)), room, emphasis)
}

fn paint_button(
    ui: &mut Ui,
    key: &str,
    icon: Option<Icon>,
    (name, text): (&str, Option<&str>),
    room: f32,
    emphasis: Emphasis,
) -> Response {
    let look = Look::of(ui.ctx());
    let text_font = TextStyle::Button.resolve(ui.style());
    let galley = text.map(|text| ui.painter().layout_no_wrap(text.to_owned(), text_font, Color32::PLACEHOLDER));
    let icon_side = 2.0 * GRID;
    let text_width = galley.as_ref().map_or(0.0, |galley| galley.size().x);
    let icon_width = if icon.is_some() { icon_side } else { 0.0 };
    let gap = if galley.is_some() && icon.is_some() { GRID } else { 0.0 };
    let size =
        vec2(icon_width + gap + text_width.max(room) + if galley.is_some() { 3.0 } else { 2.0 } * GRID, 4.0 * GRID);
    let (rect, response) = steady::allocate_size(ui, size, key, Sense::click());
    response.widget_info(|| WidgetInfo::selected(Role::Button, ui.is_enabled(), emphasis == Emphasis::On, name));
    if ui.is_rect_visible(rect) {
        let hovered = response.hovered() || response.is_pointer_button_down_on();
        let (fill, ink) = match (emphasis, hovered) {
            (Emphasis::Primary, false) => (look.accent, look.on_accent),
            (Emphasis::Primary, true) => (look.accent.gamma_multiply(0.85), look.on_accent),
            (Emphasis::Quiet, false) => (look.raised, look.text),
            (Emphasis::On, _) | (Emphasis::Quiet, true) => (look.hairline, look.text),
        };
        ui.painter().rect_filled(rect, 6.0, fill);
        if emphasis == Emphasis::On {
            let line = Stroke::new(1.5, look.accent);
            ui.painter().rect_stroke(rect, 6.0, line, StrokeKind::Inside);
        }
        focus_ring(ui, &response, rect, look);
        let mut left = rect.center().x - (icon_width + gap + text_width) / 2.0;
        if let Some(icon) = icon {
            let rect = Rect::from_center_size(pos2(left + icon_side / 2.0, rect.center().y), Vec2::splat(icon_side));
            icons::paint(ui.painter(), icon, rect, ink);
            left = rect.right() + GRID;
        }
        if let Some(galley) = galley {
            let corner = pos2(left, rect.center().y - galley.size().y / 2.0);
            ui.painter().galley(corner, galley, ink);
        }
    }
    response
}

/// Returns the width of a text on a button, in points.
pub fn text_width(ui: &Ui, text: &str) -> f32 {
    let font = TextStyle::Button.resolve(ui.style());
    ui.painter().layout_no_wrap(text.to_owned(), font, Color32::PLACEHOLDER).size().x
}

/// Returns the element after `current`; after the last one the first.
pub fn cycle<T: Copy + PartialEq>(all: &[T], current: T) -> T {
    all.iter().cycle().skip_while(|other| **other != current).nth(1).copied().unwrap_or(current)
}

/// Shows a row of buttons of which one is on, each with its value, its text and its tooltip. Returns the value of the
/// pressed button.
pub fn choice_buttons<T: Copy + PartialEq>(ui: &mut Ui, on: T, all: &[(T, &str, &str)]) -> Option<T> {
    let mut pressed = None;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = GRID / 2.0;
        for &(value, name, hint) in all {
            let emphasis = if value == on { Emphasis::On } else { Emphasis::Quiet };
            if button(ui, None, name, true, emphasis).on_hover_text(hint).clicked() {
                pressed = Some(value);
            }
        }
    });
    pressed
}

/// Returns the frame of a popup.
pub fn popup_frame(ctx: &Context) -> Frame {
    let look = Look::of(ctx);
    Frame::popup(&ctx.global_style()).fill(look.ground).stroke(Stroke::new(1.0, look.hairline)).inner_margin(GRID)
}

/// Shows a number field, to type or to drag. A text that is no number is refused as a whole: the value stays, the field
/// gets a red frame, and [`RefusedNumber`] says why. `name` is its accessible name.
pub fn number_field<N: egui::emath::Numeric>(
    ui: &mut Ui,
    value: &mut N,
    range: RangeInclusive<N>,
    suffix: &str,
    width: f32,
    label: (&str, Language),
) -> Response {
    // With every key, the beginning of a longer number would count.
    field_of_number(ui, value, range, suffix, width, label, false)
}

/// Shows a number field like [`number_field`] whose value follows with every key.
pub fn live_number_field<N: egui::emath::Numeric>(
    ui: &mut Ui,
    value: &mut N,
    range: RangeInclusive<N>,
    suffix: &str,
    width: f32,
    label: (&str, Language),
) -> Response {
    field_of_number(ui, value, range, suffix, width, label, true)
}

fn field_of_number<N: egui::emath::Numeric>(
    ui: &mut Ui,
    value: &mut N,
    range: RangeInclusive<N>,
    suffix: &str,
    width: f32,
    (name, language): (&str, Language),
    is_live: bool,
) -> Response {
    let steady = UiBuilder::new().scope_id(steady_id(ui, name));
    ui.scope_builder(steady, |ui| {
        // A low row has small text.
        let height = ui.available_height().min(3.5 * GRID);
        ui.spacing_mut().interact_size = vec2(width, height);
        ui.spacing_mut().button_padding = vec2(0.75 * GRID, 0.0);
        if height < 3.0 * GRID {
            ui.style_mut().override_font_id = Some(theme::regular(theme::SMALL));
        }
        let speed = (range.end().to_f64() - range.start().to_f64()).clamp(10.0, 2000.0) / 400.0;
        let refused = Cell::new(None);
        let is_dropped = is_text_dropped(ui.ctx());
        let parse = |text: &str| {
            if is_dropped {
                return None;
            }
            number::parse(text, suffix, N::INTEGRAL, language)
                .map_err(|why| refused.set(Some((text.trim().to_owned(), why))))
                .ok()
        };
        let field = DragValue::new(value).range(range).suffix(suffix).max_decimals(0).speed(speed);
        let field = field.update_while_editing(is_live).custom_parser(parse);
        let response = ui.add(field.custom_formatter(|number, _| number::format(number, language)));
        keep_escape(ui, &response);
        // The beginning of a number need not be one.
        show_refusal(ui, &response, refused.take().filter(|_| !is_live || !response.has_focus()), name);
        let exact = value.to_f64();
        response.widget_info(|| WidgetInfo {
            label: Some(name.to_owned()),
            ..WidgetInfo::drag_value(ui.is_enabled(), exact)
        });
        response
    })
    .inner
}

/// Whether Esc has just left a text field, so that its text does not count. egui forgets the key one frame too early:
/// for two frames it asks for the value of a text that was left.
fn is_text_dropped(ctx: &Context) -> bool {
    let id = Id::unique("pass of the last Esc");
    let pass = ctx.cumulative_pass_nr();
    if ctx.input(|input| input.key_pressed(Key::Escape)) {
        ctx.data_mut(|data| data.insert_temp(id, pass));
    }
    ctx.data(|data| data.get_temp::<u64>(id)).is_some_and(|last| pass <= last + 2)
}

/// Keeps the Esc that has left a text field from closing the menu around the field.
pub fn keep_escape(ui: &Ui, field: &Response) {
    if field.lost_focus() {
        ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
    }
}

/// Reports a refused text, and frames the field until it is edited again.
fn show_refusal(ui: &Ui, response: &Response, refused: Option<(String, NumberError)>, name: &str) {
    let id = response.id.with("refused");
    match refused {
        // Without a text the user has left the field as it was.
        Some((text, why)) if !text.is_empty() => {
            ui.data_mut(|data| data.insert_temp(id, true));
            RefusedNumber { field: name.to_owned(), text, why }.report(ui.ctx());
        }
        _ if response.has_focus() || response.dragged() => ui.data_mut(|data| data.remove::<bool>(id)),
        _ => {}
    }
    if ui.data(|data| data.get_temp::<bool>(id)).unwrap_or(false) {
        let stroke = Stroke::new(1.5, Look::of(ui.ctx()).trouble);
        ui.painter().rect_stroke(response.rect, 4.0, stroke, StrokeKind::Outside);
    }
}

/// Shows the content of a menu for a machine or a message: a title, a row for each action with its text and its key,
/// and a hint. The rows are disabled unless they are possible. Returns the chosen action.
pub fn action_menu<T>(
    ui: &mut Ui,
    title: &str,
    actions: impl IntoIterator<Item = (T, String, &'static str)>,
    (is_possible, hint): (bool, &str),
    look: Look,
) -> Option<T> {
    ui.set_width(34.0 * GRID);
    let title = Label::new(RichText::new(title).font(theme::strong(theme::BODY)).color(look.text)).wrap();
    ui.with_layout(Layout::top_down(Align::Min), |ui| ui.add(title));
    let mut chosen = None;
    for (action, text, key) in actions {
        ui.add_enabled_ui(is_possible, |ui| {
            if menu_row(ui, &text, key, look).clicked() {
                chosen = Some(action);
                ui.close();
            }
        });
    }
    let hint = Label::new(RichText::new(hint).font(theme::regular(theme::SMALL)).color(look.quiet)).wrap();
    // The layout of a menu would stretch the lines.
    ui.with_layout(Layout::top_down(Align::Min), |ui| ui.add(hint));
    chosen
}

/// Shows a row of a menu, as wide as the menu, with its key at the right.
fn menu_row(ui: &mut Ui, text: &str, key: &str, look: Look) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), 4.0 * GRID), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, ui.is_enabled(), text));
    let is_hovered = response.hovered() || response.has_focus();
    ui.painter().rect_filled(rect, 6.0, if is_hovered { look.hairline } else { look.raised });
    for (text, right, colour) in [(text, false, look.text), (key, true, look.quiet)] {
        let galley = ui.painter().layout_no_wrap(text.to_owned(), TextStyle::Button.resolve(ui.style()), colour);
        let x = if right { rect.right() - 1.5 * GRID - galley.size().x } else { rect.left() + 1.5 * GRID };
        ui.painter().galley(pos2(x, rect.center().y - galley.size().y / 2.0), galley, colour);
    }
    response
}

/// Shows a tooltip above a widget, enabled or not, so that it covers nothing below.
pub fn hint_above(response: Response, text: &str) -> Response {
    response.ctx.accesskit_node_builder(response.id, |node| node.set_description(text));
    let mut tooltip = Tooltip::for_widget(&response);
    // egui keeps a tooltip open while the pointer is in its widget's rectangle, even if a page covers the widget.
    let is_open = response.contains_pointer() && Tooltip::should_show_tooltip(&response, true);
    tooltip.popup = tooltip.popup.open(is_open).align(RectAlign::TOP);
    tooltip.popup = tooltip.popup.align_alternatives(&[RectAlign::TOP_START, RectAlign::TOP_END]);
    tooltip.show(|ui| ui.label(text));
    response
}

/// Shows the content of a tooltip: a title and rows of name and value.
pub fn tooltip_table(ui: &mut Ui, title: &str, lines: &[(&'static str, String)], look: Look) {
    ui.spacing_mut().interact_size.y = 0.0;
    ui.label(RichText::new(title).font(theme::strong(theme::BODY)).color(look.text));
    egui::Grid::new("more").spacing([2.0 * GRID, 0.25 * GRID]).show(ui, |ui| {
        for (name, value) in lines {
            ui.label(RichText::new(*name).font(theme::regular(theme::SMALL)).color(look.quiet));
            ui.label(RichText::new(value).font(theme::regular(theme::SMALL)).color(look.text));
            ui.end_row();
        }
    });
}

/// Paints a ring round the widget that has the keyboard focus.
fn focus_ring(ui: &Ui, response: &Response, rect: Rect, look: Look) {
    if response.has_focus() {
        let stroke = Stroke::new(1.5, look.accent);
        ui.painter().rect_stroke(rect.expand(2.0), 8.0, stroke, StrokeKind::Outside);
    }
}

//! A row a node: its number and colour, its speed to drag, what it has done and has left, and what it does.

use egui::{Align2, Color32, Rect, ScrollArea, Sense, Ui, UiBuilder, pos2, vec2};

use super::session::Session;
use super::theme::{self, GRID, Look};
use super::widgets;
use crate::palette::{Rgb, text_on};
use crate::view::{Activity, Row, activity_word, count, node_name, rows};

const ROW: f32 = 4.0 * GRID;
const HEAD: f32 = 2.5 * GRID;

/// How high the panel of so many nodes is to be: beyond a third of the window the rows scroll.
pub fn height(ui: &Ui, nodes: usize) -> f32 {
    let grid = Grid::new(nodes, ui.available_width() - 4.0 * GRID);
    grid.height().min((ui.ctx().content_rect().height() * 0.3).max(HEAD + ROW))
}

/// Shows all rows, in as many columns as there is room for.
pub fn show(ui: &mut Ui, session: &mut Session) {
    let look = Look::of(ui.ctx());
    let rows = rows(session.state(), session.now());
    let grid = Grid::new(rows.len(), ui.available_width());
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        let (area, _) = ui.allocate_exact_size(vec2(ui.available_width(), grid.height()), Sense::hover());
        for column in 0..grid.columns {
            let corner = area.min + vec2(grid.left(column), 0.0);
            head(ui, &Columns::new(Rect::from_min_size(corner, vec2(grid.width, HEAD))), look);
        }
        for (i, row) in rows.iter().enumerate() {
            let corner = area.min + vec2(grid.left(i / grid.lines), HEAD + (i % grid.lines) as f32 * ROW);
            let places = Columns::new(Rect::from_min_size(corner, vec2(grid.width, ROW)));
            let speed = session.speed(row.node);
            if let Some(speed) = show_row(ui, &places, row, speed, session.colours()[i], look) {
                session.set_speed(row.node, speed);
            }
        }
    });
}

/// Rows in columns, filled from top to bottom.
struct Grid {
    columns: usize,
    lines: usize,
    /// The width of a column.
    width: f32,
}

impl Grid {
    const GAP: f32 = 4.0 * GRID;

    fn new(rows: usize, room: f32) -> Self {
        // Two columns are worth some squeezing, more are not.
        let columns = if room < 740.0 { 1 } else { (((room + Self::GAP) / 632.0) as usize).max(2) };
        let lines = rows.div_ceil(columns).max(1);
        let columns = rows.div_ceil(lines).max(1);
        Self { columns, lines, width: (room + Self::GAP) / columns as f32 - Self::GAP }
    }

    fn height(&self) -> f32 {
        HEAD + self.lines as f32 * ROW
    }

    fn left(&self, column: usize) -> f32 {
        column as f32 * (self.width + Self::GAP)
    }
}

/// Where the parts of a row go, from left to right.
struct Columns {
    row: Rect,
    slider: Rect,
    /// The right ends of the numbers.
    speed: f32,
    bar: Rect,
    /// The same as `left` if it is not shown.
    done: f32,
    left: f32,
    /// The same as `left` if it is not shown.
    idle: f32,
    /// The left end of the last word.
    activity: f32,
}

impl Columns {
    fn new(row: Rect) -> Self {
        let within = |left: f32, width: f32, height: f32| {
            Rect::from_min_size(pos2(row.left() + left, row.center().y - height / 2.0), vec2(width, height))
        };
        let narrow = row.width() < 430.0;
        let slider = within(4.5 * GRID, if narrow { 11.0 } else { 15.0 } * GRID, 2.5 * GRID);
        let speed = slider.right() + 7.0 * GRID;
        let activity = row.right() - 10.0 * GRID;
        let idle = activity - 2.0 * GRID;
        // How long it was idle is the first to go where there is little room.
        let left = if row.width() < 520.0 { idle } else { idle - 7.0 * GRID };
        // How much it has done is the next: the bar above the rows tells it too.
        let done = if row.width() < 400.0 { left } else { left - 7.0 * GRID };
        let bar = speed + 2.0 * GRID;
        let bar = within(bar - row.left(), (done - 7.5 * GRID - bar).max(0.0), GRID);
        Self { row, slider, speed, bar, done, left, idle, activity }
    }
}

fn head(ui: &Ui, places: &Columns, look: Look) {
    let y = places.row.center().y;
    let words = |x: f32, anchor, text: &str| {
        ui.painter().text(pos2(x, y), anchor, text, theme::regular(theme::SMALL), look.quiet);
    };
    words(places.row.left() + 1.5 * GRID, Align2::CENTER_CENTER, "no.");
    words(places.slider.left(), Align2::LEFT_CENTER, "speed");
    if places.bar.width() > 5.0 * GRID {
        words(places.bar.left(), Align2::LEFT_CENTER, "atoms");
    }
    if places.done < places.left {
        words(places.done, Align2::RIGHT_CENTER, "done");
    }
    words(places.left, Align2::RIGHT_CENTER, "left");
    if places.idle > places.left {
        words(places.idle, Align2::RIGHT_CENTER, "idle");
    }
    words(places.activity, Align2::LEFT_CENTER, "now");
}

/// Shows a row and returns the node's new speed if its slider was moved.
fn show_row(ui: &mut Ui, places: &Columns, row: &Row, speed: f64, own: Rgb, look: Look) -> Option<f64> {
    let name = node_name(row.node);
    let (y, colour) = (places.row.center().y, theme::colour(own));
    let response = ui.interact(places.row, ui.scope_id().with(("row", row.node)), Sense::hover());
    let doing = activity_word(row.activity);
    widgets::describe(&response, &format!("Node {name}"), || {
        format!("{} atoms done, {} left, {doing}", row.done, row.left)
    });
    let painter = ui.painter();
    let chip = Rect::from_center_size(pos2(places.row.left() + 1.5 * GRID, y), vec2(3.0 * GRID, 3.0 * GRID));
    painter.rect_filled(chip, 6.0, colour);
    let ink = theme::colour(text_on(own));
    painter.text(chip.center(), Align2::CENTER_CENTER, name.to_string(), theme::strong(theme::BODY), ink);

    let number = |x: f32, text: String, colour: Color32| {
        painter.text(pos2(x, y), Align2::RIGHT_CENTER, text, theme::regular(theme::BODY), colour);
    };
    number(places.speed, format!("{:.0} %", speed * 100.0), look.text);
    if places.done < places.left {
        number(places.done, count(row.done), look.text);
    }
    number(places.left, count(row.left), if row.left > 0 { look.text } else { look.quiet });
    if places.idle > places.left {
        number(places.idle, format!("{:.0} %", row.idle * 100.0), look.text);
    }
    let calm = matches!(row.activity, Activity::Idle | Activity::Retired | Activity::Waiting | Activity::Done);
    let ink = if calm { look.quiet } else { look.text };
    painter.text(pos2(places.activity, y), Align2::LEFT_CENTER, doing, theme::regular(theme::BODY), ink);
    if places.bar.width() > 5.0 * GRID {
        let upto = |share: f32| places.bar.with_max_x(places.bar.left() + places.bar.width() * share);
        painter.rect_filled(upto(row.left_bar), 4.0, colour.gamma_multiply(0.28));
        painter.rect_filled(upto(row.done_bar), 4.0, colour);
    }

    let mut percent = (speed * 100.0).round();
    let place = UiBuilder::new().max_rect(places.slider).id_salt(("speed", row.node));
    let slider = |ui: &mut Ui| {
        widgets::slider(ui, &mut percent, places.slider.width(), colour, &format!("Speed of node {name}"))
    };
    ui.scope_builder(place, slider).inner.changed().then_some(percent / 100.0)
}

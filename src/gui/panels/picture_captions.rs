//! Captions on the picture while a run is young: what an atom is, and why machines of one speed differ.

use egui::{Align2, Color32, Painter, Rect, Stroke, Vec2, pos2, vec2};

use crate::balance::NodeId;
use crate::gui::session::Session;
use crate::gui::widgets::theme::{self, GRID};
use crate::language::{Language, say, word};
use crate::view::{cheapest_and_costliest, fraction, node_name};

/// Seconds before the viewer for which captions are shown.
const SHOWN_SECONDS: f64 = 12.0;
/// Least width of a picture with captions, in points.
const MIN_WIDTH_PT: f32 = 300.0;

/// Paints the captions on the whole picture in `frame`; `scale` is the side of a pixel in points.
pub fn paint(painter: &Painter, frame: Rect, scale: f32, session: &Session) {
    let (stage, language) = (session.stage(), session.language());
    let state = stage.state();
    // Lessons explain by themselves.
    let seconds = stage.lasted().secs() / state.rate().max(1e-9);
    let alpha = (SHOWN_SECONDS - seconds).clamp(0.0, 1.0) as f32;
    let is_quiet = stage.hides_later || state.finished().is_some() || state.done() == 0;
    if is_quiet || alpha == 0.0 || frame.width() < MIN_WIDTH_PT {
        return;
    }
    let mut placed = vec![atom_caption(painter, (frame, scale), session, alpha, language)];
    let Some([cheap, costly]) = cheapest_and_costliest(state) else { return };
    let texts = [
        (cheap, word!(language, "cheap atoms", "átomos baratos")),
        (costly, word!(language, "costly atoms", "átomos caros")),
    ];
    for (node, text) in texts {
        // Both run at full speed; without a word of it the costly band was taken for the slow machine.
        let (name, speed) = (node_name(node), fraction(1.0));
        let text = say!(language, "{name} at {speed}: {text}", "{name} a {speed}: {text}");
        let galley = painter.layout_no_wrap(text, theme::strong(theme::SMALL), Color32::WHITE);
        let size = galley.size() + vec2(1.5 * GRID, 4.0);
        let middle = pos2(frame.right() - GRID, band_middle(frame, scale, session, node));
        let plate = Align2::RIGHT_CENTER.anchor_size(middle, size);
        if !frame.contains_rect(plate) || placed.iter().any(|other| plate.expand(2.0).intersects(*other)) {
            continue;
        }
        painter.rect_filled(plate, 4.0, plate_colour(alpha));
        painter.galley_with_override_text_color(plate.min + vec2(0.75 * GRID, 2.0), galley, white(alpha));
        placed.push(plate);
    }
}

/// Paints a magnified atom below an atom of the picture; returns the area.
fn atom_caption(
    painter: &Painter,
    (frame, scale): (Rect, f32),
    session: &Session,
    alpha: f32,
    language: Language,
) -> Rect {
    const STRIP_SIZE_PT: Vec2 = vec2(150.0, 9.0);
    const MAX_CELLS: u32 = 60;
    let header = session.header();
    let (pixels, nodes) = (header.division.atom_pixels(), header.speeds.len());
    // The first atom of the band in the middle: it begins at the left edge, or near it.
    let node = nodes / 2;
    let first = header.division.bands(nodes).nth(node).map_or(0, |band| band.start);
    let run = header.division.pixels(first);
    let width = header.size.width();
    let (x, y) = (run.start % width, run.start / width);
    let across = pixels.min(width - x) as f32;
    let corner = frame.min + vec2(x as f32, y as f32) * scale;
    let real = Rect::from_min_size(corner, vec2(across, 1.0) * scale);
    let text = if pixels == 1 {
        word!(language, "one atom: 1 pixel", "um átomo: 1 pixel").to_owned()
    } else {
        say!(language, "one atom: {pixels} pixels in a row", "um átomo: {pixels} pixels em linha")
    };
    let galley = painter.layout_no_wrap(text, theme::strong(theme::SMALL), Color32::WHITE);
    let has_strip = (2..=MAX_CELLS).contains(&pixels);
    let strip = if has_strip { STRIP_SIZE_PT } else { Vec2::ZERO };
    let size = vec2(strip.x.max(galley.size().x), strip.y + galley.size().y + 4.0) + Vec2::splat(GRID);
    let plate = Rect::from_min_size(pos2(frame.left() + GRID, real.bottom() + 2.0 * GRID), size);
    if !frame.contains_rect(plate) || real.right() > frame.right() {
        return Rect::NOTHING;
    }
    painter.rect_filled(plate, 4.0, plate_colour(alpha));
    let line = Stroke::new(1.0, white(0.7 * alpha));
    painter.line_segment([real.left_bottom(), plate.left_top()], line);
    painter.line_segment([real.right_bottom(), plate.right_top()], line);
    painter.rect_stroke(real.expand(1.0), 0.0, Stroke::new(1.5, white(alpha)), egui::StrokeKind::Outside);
    let inner = plate.shrink(0.5 * GRID);
    if has_strip {
        let own = theme::colour(session.stage().colours[node.min(nodes - 1)]);
        let cell = inner.width() / pixels as f32;
        for i in 0..pixels {
            let left = inner.left() + i as f32 * cell;
            let rect = Rect::from_min_size(pos2(left, inner.top()), vec2(cell - 0.75, strip.y));
            painter.rect_filled(rect, 0.0, own.gamma_multiply(alpha));
        }
    }
    let below = pos2(inner.left(), inner.top() + strip.y + 4.0);
    painter.galley_with_override_text_color(below, galley, white(alpha));
    plate
}

/// Returns the height of the middle of a machine's band.
fn band_middle(frame: Rect, scale: f32, session: &Session, node: NodeId) -> f32 {
    let header = session.header();
    let (division, width) = (header.division, header.size.width());
    let band = division.bands(header.speeds.len()).nth(usize::from(node)).unwrap_or_default();
    let middle = division.pixels_of(&band);
    frame.top() + (middle.start + middle.end) as f32 / 2.0 / width as f32 * scale
}

/// Returns the colour behind a caption. It is dark in both themes, as the picture is the same in both.
fn plate_colour(alpha: f32) -> Color32 {
    Color32::from_black_alpha((190.0 * alpha) as u8)
}

fn white(alpha: f32) -> Color32 {
    Color32::WHITE.gamma_multiply(alpha)
}

//! Painter of display lists.

use egui::epaint::{Mesh, PathStroke, Vertex};
use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Vec2, pos2};

use super::theme::{self, Look};
use crate::palette::{Rgb, text_on};
use crate::view::{Anchor, Hue, Ink, Mark, Point, Quad, TextSize};

/// The colours behind the hues of a display list.
pub struct Inks<'a> {
    /// The theme's colours.
    pub look: Look,
    /// The nodes' colours.
    pub nodes: &'a [Rgb],
}

impl Inks<'_> {
    /// Returns the colour of an ink.
    pub fn colour(&self, ink: Ink) -> Color32 {
        let node = |node: u16| self.nodes.get(usize::from(node)).copied().unwrap_or([0x80; 3]);
        let full = match ink.hue {
            Hue::Node(i) => theme::colour(node(i)),
            Hue::OnNode(i) => theme::colour(text_on(node(i))),
            Hue::Text => self.look.text,
            Hue::Quiet => self.look.quiet,
            Hue::Accent => self.look.accent,
            Hue::Hairline => self.look.hairline,
            Hue::Ground => self.look.ground,
            Hue::Fixed(colour) => theme::colour(colour),
        };
        full.gamma_multiply(ink.alpha)
    }
}

/// Builds one mesh of all rectangles, with their corner (0, 0) at `origin`. One mesh, because there may be thousands. A
/// rectangle is at least half a point wide, so that it stays visible.
pub fn quads(quads: &[Quad], origin: Pos2, inks: &Inks<'_>) -> Mesh {
    let mut mesh = Mesh::default();
    for Quad { place: [left, top, right, bottom], ink } in quads {
        let (min, max) = (pos2(*left, *top), pos2(right.max(left + 0.5), *bottom));
        let rect = Rect { min: origin + min.to_vec2(), max: origin + max.to_vec2() };
        let (first, color) = (mesh.vertices.len() as u32, inks.colour(*ink));
        for pos in [rect.left_top(), rect.right_top(), rect.right_bottom(), rect.left_bottom()] {
            mesh.vertices.push(Vertex { pos, uv: egui::epaint::WHITE_UV, color });
        }
        mesh.indices.extend([first, first + 1, first + 2, first, first + 2, first + 3]);
    }
    mesh
}

/// Paints `marks`, with their corner (0, 0) at `origin`.
pub fn paint(painter: &Painter, origin: Pos2, marks: &[Mark], inks: &Inks<'_>) {
    let at = |[x, y]: Point| pos2(origin.x + x, origin.y + y);
    let along = |points: &[Point]| points.iter().map(|&point| at(point)).collect::<Vec<_>>();
    for mark in marks {
        match mark {
            Mark::Disc { centre, radius, ink } => {
                painter.circle_filled(at(*centre), *radius, inks.colour(*ink));
            }
            Mark::Box { centre, half, round, ink } => {
                let rect = Rect::from_center_size(at(*centre), 2.0 * Vec2::from(*half));
                painter.rect_filled(rect, *round, inks.colour(*ink));
            }
            Mark::Line { points, width, ink } => {
                let stroke = PathStroke::new(*width, inks.colour(*ink));
                let closed = points.len() > 8 && is_closed(points);
                let mut points = along(points);
                painter.add(if closed {
                    points.pop();
                    Shape::closed_line(points, stroke)
                } else {
                    Shape::line(points, stroke)
                });
            }
            Mark::Trail { points, width, ink } => {
                painter.add(trail(&along(points), *width, inks.colour(*ink)));
            }
            Mark::Label { at: place, anchor, text, size, ink } => {
                let anchor = match anchor {
                    Anchor::Left => Align2::LEFT_CENTER,
                    Anchor::Centre => Align2::CENTER_CENTER,
                    Anchor::Right => Align2::RIGHT_CENTER,
                };
                painter.text(at(*place), anchor, text, font(*size), inks.colour(*ink));
            }
        }
    }
}

fn font(size: TextSize) -> FontId {
    // Few distinct sizes: each size takes room in the font atlas, and a resize passes through many.
    match size {
        TextSize::Small(times) => theme::regular((theme::SMALL * times).round()),
        TextSize::Body(times) => theme::strong((theme::BODY * times).round()),
        TextSize::Fit(size) => theme::strong((size / 2.0).round().max(3.0) * 2.0),
    }
}

fn is_closed(points: &[Point]) -> bool {
    let ([x, y], [u, v]) = (points[0], points[points.len() - 1]);
    (x - u).hypot(y - v) < 0.05
}

/// Builds the mesh of a trail, whose width and opacity grow from 0 at its tail to full at its head.
fn trail(points: &[Pos2], width: f32, colour: Color32) -> Mesh {
    let mut mesh = Mesh::default();
    let last = points.len().saturating_sub(1);
    for (i, &point) in points.iter().enumerate() {
        let (before, after) = (points[i.saturating_sub(1)], points[(i + 1).min(last)]);
        let share = i as f32 / last.max(1) as f32;
        let side = (after - before).normalized().rot90() * (width / 2.0 * share);
        for corner in [point - side, point + side] {
            mesh.vertices.push(Vertex::untextured(corner, colour.gamma_multiply(share * share)));
        }
        if i > 0 {
            let next = 2 * i as u32;
            mesh.add_triangle(next - 2, next - 1, next);
            mesh.add_triangle(next - 1, next, next + 1);
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trail_is_transparent_at_its_tail_and_full_at_its_head() {
        let mesh = trail(&[pos2(0.0, 0.0), pos2(5.0, 0.0), pos2(10.0, 0.0)], 4.0, Color32::WHITE);
        assert!(mesh.is_valid());
        assert_eq!((mesh.vertices.len(), mesh.indices.len()), (6, 12));
        assert_eq!((mesh.vertices[0].color, mesh.vertices[5].color), (Color32::TRANSPARENT, Color32::WHITE));
        assert_eq!(mesh.vertices[5].pos.distance(mesh.vertices[4].pos), 4.0);
    }

    #[test]
    fn trail_of_one_point_is_a_valid_mesh() {
        assert!(trail(&[pos2(1.0, 1.0)], 4.0, Color32::WHITE).is_valid());
    }
}

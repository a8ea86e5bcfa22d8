//! Icons, drawn as lines and polygons.

use std::f32::consts::PI;

use egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, Vec2, pos2, vec2};

/// Icon of a button.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Icon {
    /// Triangle: play or resume.
    Play,
    /// Two bars: pause.
    Pause,
    /// Circular arrow: restart.
    Restart,
    /// Arrow into a tray: save.
    Save,
    /// Half-filled circle: dark or light theme.
    Contrast,
    /// Four tiles: scenes.
    Scenes,
    /// Three sliders: settings.
    Sliders,
    /// Points in a chart: accuracy.
    Chart,
    /// Three bars: comparison.
    Compare,
    /// Mortarboard: lessons.
    Learn,
    /// Arrow to the left: undo.
    Undo,
    /// Bar and triangle: beginning.
    Beginning,
    /// Triangle and bar: end.
    End,
    /// Arrow to a dot at the left: previous event.
    StepBack,
    /// Arrow to a dot at the right: next event.
    StepOn,
    /// Left arrow: previous step of a lesson.
    Back,
    /// Right arrow: next step of a lesson.
    Next,
    /// Double chevron to the left: slower.
    Slower,
    /// Double chevron to the right: faster.
    Faster,
    /// Dot: live.
    Live,
    /// Bars in lanes: timeline.
    Lanes,
    /// Camera.
    Camera,
    /// Two sheets: copy.
    Copy,
    /// Question mark: help.
    Help,
    /// Cross: close, or wrong.
    Close,
    /// Tick: right.
    Tick,
}

/// Paints an icon into a square.
pub fn paint(painter: &Painter, icon: Icon, rect: Rect, colour: Color32) {
    let at = |x: f32, y: f32| -> Pos2 { rect.lerp_inside(vec2(x, y)) };
    let stroke = Stroke::new(1.75, colour);
    let line = |points: &[(f32, f32)]| painter.line(points.iter().map(|&(x, y)| at(x, y)).collect(), stroke);
    let arc = |centre: (f32, f32), radius: f32, from: f32, to: f32| {
        let turn = |i: i32| {
            let angle = from + (to - from) * i as f32 / 20.0;
            at(centre.0 + radius * angle.cos(), centre.1 + radius * angle.sin())
        };
        (0..=20).map(turn).collect::<Vec<_>>()
    };
    let head = |tip: Pos2, corners: [Vec2; 3]| {
        painter.add(Shape::convex_polygon(corners.map(|corner| tip + corner).to_vec(), colour, Stroke::NONE));
    };
    match icon {
        Icon::Play => {
            let corners = vec![at(0.22, 0.1), at(0.9, 0.5), at(0.22, 0.9)];
            painter.add(Shape::convex_polygon(corners, colour, Stroke::NONE));
        }
        Icon::Pause => {
            for left in [0.18, 0.6] {
                painter.rect_filled(Rect::from_min_max(at(left, 0.12), at(left + 0.22, 0.88)), 1.0, colour);
            }
        }
        Icon::Restart => {
            let points = arc((0.5, 0.5), 0.38, 0.4, 5.53);
            let tip = points[points.len() - 1];
            painter.line(points, stroke);
            head(tip, [vec2(-5.0, -1.0), vec2(2.5, -5.0), vec2(2.5, 3.0)]);
        }
        Icon::Undo => {
            let points = arc((0.52, 0.58), 0.34, 0.9, -PI);
            let tip = points[points.len() - 1];
            painter.line(points, stroke);
            head(tip, [vec2(-4.5, -1.0), vec2(4.5, -1.0), vec2(0.0, 5.0)]);
        }
        Icon::Save => {
            line(&[(0.5, 0.08), (0.5, 0.62)]);
            line(&[(0.25, 0.4), (0.5, 0.66), (0.75, 0.4)]);
            line(&[(0.1, 0.66), (0.1, 0.92), (0.9, 0.92), (0.9, 0.66)]);
        }
        Icon::Contrast => {
            painter.circle_stroke(rect.center(), rect.width() * 0.4, stroke);
            let half = arc((0.5, 0.5), 0.4, -PI / 2.0, PI / 2.0);
            painter.add(Shape::convex_polygon(half, colour, Stroke::NONE));
        }
        Icon::Scenes => {
            for (x, y) in [(0.1, 0.14), (0.56, 0.14), (0.1, 0.56), (0.56, 0.56)] {
                let tile = Rect::from_min_max(at(x, y), at(x + 0.34, y + 0.3));
                painter.rect_stroke(tile, 1.5, Stroke::new(1.5, colour), egui::StrokeKind::Middle);
            }
        }
        Icon::Sliders => {
            for (y, knob) in [(0.2, 0.7), (0.5, 0.3), (0.8, 0.6)] {
                line(&[(0.06, y), (0.94, y)]);
                painter.circle_filled(at(knob, y), rect.width() * 0.13, colour);
            }
        }
        Icon::Chart => {
            line(&[(0.1, 0.08), (0.1, 0.9), (0.94, 0.9)]);
            for (x, y) in [(0.3, 0.22), (0.46, 0.52), (0.82, 0.68)] {
                painter.circle_filled(at(x, y), rect.width() * 0.1, colour);
            }
        }
        Icon::Learn => {
            // A mortarboard.
            let board = vec![at(0.0, 0.36), at(0.5, 0.12), at(1.0, 0.36), at(0.5, 0.6)];
            painter.add(Shape::convex_polygon(board, colour, Stroke::NONE));
            line(&[(0.24, 0.52), (0.24, 0.78), (0.5, 0.9), (0.76, 0.78), (0.76, 0.52)]);
        }
        Icon::Compare => {
            // Two pictures side by side.
            for left in [0.04, 0.56] {
                let pane = Rect::from_min_max(at(left, 0.16), at(left + 0.4, 0.84));
                painter.rect_stroke(pane, 1.5, Stroke::new(1.5, colour), egui::StrokeKind::Middle);
            }
            painter.rect_filled(Rect::from_min_max(at(0.04, 0.5), at(0.44, 0.84)), 1.0, colour);
            painter.rect_filled(Rect::from_min_max(at(0.56, 0.34), at(0.96, 0.84)), 1.0, colour);
        }
        Icon::Beginning => {
            line(&[(0.22, 0.18), (0.22, 0.82)]);
            let corners = vec![at(0.82, 0.16), at(0.82, 0.84), at(0.34, 0.5)];
            painter.add(Shape::convex_polygon(corners, colour, Stroke::NONE));
        }
        Icon::End => {
            line(&[(0.78, 0.18), (0.78, 0.82)]);
            let corners = vec![at(0.18, 0.16), at(0.66, 0.5), at(0.18, 0.84)];
            painter.add(Shape::convex_polygon(corners, colour, Stroke::NONE));
        }
        Icon::StepBack => {
            painter.circle_filled(at(0.14, 0.5), rect.width() * 0.14, colour);
            line(&[(0.98, 0.5), (0.42, 0.5)]);
            line(&[(0.64, 0.26), (0.4, 0.5), (0.64, 0.74)]);
        }
        Icon::StepOn => {
            painter.circle_filled(at(0.86, 0.5), rect.width() * 0.14, colour);
            line(&[(0.02, 0.5), (0.58, 0.5)]);
            line(&[(0.36, 0.26), (0.6, 0.5), (0.36, 0.74)]);
        }
        Icon::Back => {
            line(&[(0.9, 0.5), (0.12, 0.5)]);
            line(&[(0.44, 0.18), (0.12, 0.5), (0.44, 0.82)]);
        }
        Icon::Next => {
            line(&[(0.1, 0.5), (0.88, 0.5)]);
            line(&[(0.56, 0.18), (0.88, 0.5), (0.56, 0.82)]);
        }
        Icon::Slower => {
            for x in [0.46, 0.78] {
                line(&[(x, 0.24), (x - 0.26, 0.5), (x, 0.76)]);
            }
        }
        Icon::Faster => {
            for x in [0.22, 0.54] {
                line(&[(x, 0.24), (x + 0.26, 0.5), (x, 0.76)]);
            }
        }
        Icon::Live => {
            painter.circle_filled(rect.center(), rect.width() * 0.26, colour);
        }
        Icon::Lanes => {
            for (y, from, to) in [(0.22, 0.08, 0.62), (0.5, 0.3, 0.92), (0.78, 0.08, 0.5)] {
                let bar = Rect::from_min_max(at(from, y - 0.09), at(to, y + 0.09));
                painter.rect_filled(bar, 1.0, colour);
            }
        }
        Icon::Camera => {
            let body = Rect::from_min_max(at(0.06, 0.26), at(0.94, 0.84));
            painter.rect_stroke(body, 2.0, Stroke::new(1.5, colour), egui::StrokeKind::Middle);
            painter.circle_stroke(at(0.5, 0.55), rect.width() * 0.16, Stroke::new(1.5, colour));
            line(&[(0.34, 0.24), (0.4, 0.12), (0.6, 0.12), (0.66, 0.24)]);
        }
        Icon::Copy => {
            let sheet = Rect::from_min_max(at(0.34, 0.3), at(0.88, 0.94));
            painter.rect_stroke(sheet, 2.0, Stroke::new(1.5, colour), egui::StrokeKind::Middle);
            line(&[(0.2, 0.7), (0.12, 0.7), (0.12, 0.06), (0.66, 0.06), (0.66, 0.14)]);
        }
        Icon::Help => {
            painter.line(arc((0.5, 0.3), 0.2, -PI, 0.5 * PI), stroke);
            line(&[(0.5, 0.5), (0.5, 0.66)]);
            painter.circle_filled(pos2(rect.center().x, at(0.5, 0.88).y), 1.4, colour);
        }
        Icon::Close => {
            line(&[(0.22, 0.22), (0.78, 0.78)]);
            line(&[(0.78, 0.22), (0.22, 0.78)]);
        }
        Icon::Tick => _ = line(&[(0.15, 0.55), (0.4, 0.8), (0.85, 0.22)]),
    }
}

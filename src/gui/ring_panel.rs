//! The ring.

use egui::{Sense, Ui};

use super::paint::{Inks, paint};
use super::session::Session;
use super::theme::{self, Look};
use super::widgets;
use crate::view::{Overlay, activity_word, node_name, ring};

/// Shows the ring as large as it gets.
pub fn show(ui: &mut Ui, session: &Session) {
    let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::hover());
    let (state, now) = (session.state(), session.now());
    widgets::describe(&response, "Ring", || {
        let say = |node| format!("{} is {}", node_name(node), activity_word(state.activity(node, now)));
        let nodes: Vec<_> = (0..).zip(state.nodes()).map(|(node, _)| say(node)).collect();
        nodes.join(", ")
    });
    let look = Look::of(ui.ctx());
    let inks = Inks { look, nodes: session.colours() };
    let painter = ui.painter_at(rect.expand(4.0));
    let overlay = Overlay { outcome: session.outcome(), selected: None };
    let marks = ring(state, &overlay, now, rect.size().into());
    paint(&painter, rect.min, &marks, &inks);
    let latency = session.header().link.latency.as_millis();
    let lines = [format!("{latency} ms a hop"), "parcels drawn slower than they travel".to_owned()];
    let galleys = lines.map(|line| painter.layout_no_wrap(line, theme::regular(theme::SMALL), look.quiet));
    // Where the corner is narrow the second line would run into the lowest node's label.
    let room = rect.width() / 2.0 - 64.0;
    let mut corner = rect.right_bottom();
    for galley in galleys.into_iter().filter(|galley| galley.size().x < room).rev() {
        corner.y -= galley.size().y;
        painter.galley(corner - egui::vec2(galley.size().x, 0.0), galley, look.quiet);
    }
}

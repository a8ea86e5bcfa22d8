//! What happens, in a sentence, and who has done how much, in a bar.

use egui::{Align2, CornerRadius, Rect, RichText, Sense, Ui, pos2, vec2};

use super::session::{Phase, Session};
use super::theme::{self, GRID, Look};
use super::widgets;
use crate::palette::text_on;
use crate::view::{Share, node_name, percent, result_words, shares};

/// Shows both.
pub fn show(ui: &mut Ui, session: &Session) {
    let look = Look::of(ui.ctx());
    let sentence = match (session.phase(), session.outcome()) {
        (Phase::Failed(why), _) => format!("The run cannot go on: {why}"),
        (_, Some(outcome)) => result_words(session.state(), &outcome),
        _ => session.narrator().sentence(session.state(), session.now()),
    };
    // Rather small than cut; what is too long even so has two lines.
    let width = |size: f32| ui.painter().layout_no_wrap(sentence.clone(), theme::strong(size), look.text).size().x;
    let size = [20.0, 18.0, theme::BODY].into_iter().find(|&size| width(size) <= ui.available_width());
    let text = RichText::new(&sentence).font(theme::strong(size.unwrap_or(theme::BODY))).color(look.text);
    ui.add(egui::Label::new(text).wrap());
    bar(ui, session, look);
}

/// All atoms in one row: each node's part in its colour, what is still to be done empty.
fn bar(ui: &mut Ui, session: &Session, look: Look) {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), 3.0 * GRID), Sense::hover());
    let (shares, all) = (shares(session.state()), session.state().atoms());
    widgets::describe(&response, "Who has traced how much", || {
        let say = |share: &Share| format!("{} {}", node_name(share.node), percent(share.atoms, all));
        shares.iter().map(say).collect::<Vec<_>>().join(", ")
    });
    ui.painter().rect_filled(rect, 4.0, look.raised);
    let last = shares.iter().rposition(|share| share.end > share.start);
    for (i, share) in shares.iter().enumerate() {
        let part = Rect::from_x_y_ranges(
            rect.left() + rect.width() * share.start..=rect.left() + rect.width() * share.end,
            rect.y_range(),
        );
        let mut corners = CornerRadius::ZERO;
        if share.start == 0.0 {
            (corners.nw, corners.sw) = (4, 4);
        }
        if Some(i) == last && share.end > 0.999 {
            (corners.ne, corners.se) = (4, 4);
        }
        let own = session.colours()[i];
        ui.painter().rect_filled(part, corners, theme::colour(own));
        let ink = theme::colour(text_on(own));
        if part.width() > 72.0 {
            let number = node_name(share.node).to_string();
            let left = pos2(part.left() + GRID, part.center().y);
            ui.painter().text(left, Align2::LEFT_CENTER, number, theme::strong(theme::BODY), ink);
            let right = pos2(part.right() - GRID, part.center().y);
            let text = percent(share.atoms, all);
            ui.painter().text(right, Align2::RIGHT_CENTER, text, theme::regular(theme::BODY), ink);
        } else if part.width() > 20.0 {
            let number = node_name(share.node).to_string();
            ui.painter().text(part.center(), Align2::CENTER_CENTER, number, theme::strong(theme::BODY), ink);
        }
    }
}

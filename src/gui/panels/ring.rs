//! The ring of machines, with its tooltips and menus.

use egui::{Align2, Rect, RichText, Sense, Ui, vec2};

use crate::balance::NodeId;
use crate::gui::input::machine_menu;
use crate::gui::input::message_menu::{self, MessageInMenu};
use crate::gui::input::selection::Selection;
use crate::gui::session::Session;
use crate::gui::widgets;
use crate::gui::widgets::explained::explain_at;
use crate::gui::widgets::paint::{Inks, paint};
use crate::gui::widgets::steady;
use crate::gui::widgets::theme::{self, Look};
use crate::language::{say, word};
use crate::view::{
    Highlight, Point, RingLayout, RingOverlay, RingSpot, Subject, activity_word, flight_words, message_at, node_name,
    node_words, parent_words, ring, ring_at, ring_corner_at, ring_corners, time_words,
};

/// Shows the ring as large as possible. A click selects a machine or a message, the right button opens its menu, and a
/// tooltip describes what is under the pointer.
pub fn show(ui: &mut Ui, session: &mut Session, selection: &mut Selection, highlight: &Highlight) {
    let language = session.language();
    let (rect, response) = steady::allocate_size(ui, ui.available_size(), "ring", Sense::click());
    let (stage, now) = (session.stage(), session.now());
    let state = stage.state();
    widgets::describe(&response, word!(language, "The ring", "O anel"), || {
        let text = |node| {
            let (name, activity) = (node_name(node), activity_word(state.activity(node, now), language));
            format!("{name}: {activity}")
        };
        let nodes: Vec<_> = (0..).zip(state.nodes()).map(|(node, _)| text(node)).collect();
        nodes.join(", ")
    });
    let look = Look::of(ui.ctx());
    let inks = Inks { look, nodes: &stage.colours };
    let painter = ui.painter_at(rect.expand(4.0));
    let overlay = RingOverlay {
        summary: stage.result().copied(),
        selected: selection.node(),
        highlighted: highlight.nodes.clone(),
        message: highlight.message,
    };
    let layout = RingLayout::new(state.nodes().len(), rect.size().into(), language);
    paint(&painter, rect.min, &ring(&layout, state, &overlay, now, language), &inks);

    let pointed = response.hover_pos().map(|at| -> Point { (at - rect.min).into() });
    let spot = pointed.and_then(|at| ring_at(&layout, at));
    let message = pointed.and_then(|at| message_at(&layout, state, now, at));
    if response.clicked() {
        match (message, spot) {
            (Some(message), _) => selection.toggle(Subject::Message(message.id)),
            (None, Some(RingSpot::Node(node))) => selection.toggle(Subject::Node(node)),
            (None, _) => selection.selected = None,
        }
    }
    match (message, spot) {
        (Some(message), _) => selection.hover(Subject::Message(message.id)),
        (None, Some(RingSpot::Node(node))) => selection.hover(Subject::Node(node)),
        (None, _) => {}
    }
    // Messages are drawn on top, so they come first.
    let tooltip = match (message, spot) {
        (Some(message), _) => Some((flight_words(message, language), Vec::new())),
        (None, Some(RingSpot::Node(node))) => {
            let name = node_name(node);
            Some((say!(language, "Machine {name}", "Máquina {name}"), node_words(state, node, now, language)))
        }
        (None, Some(RingSpot::Parent)) => {
            Some((word!(language, "The parent", "O pai").to_owned(), parent_words(state, now, language)))
        }
        (None, None) => None,
    };
    if response.secondary_clicked() {
        let menu = match (message, spot) {
            (Some(message), _) => Some(RingMenu::Message(MessageInMenu::new(message, language))),
            (None, Some(RingSpot::Node(node))) => Some(RingMenu::Node(node)),
            (None, _) => None,
        };
        ui.data_mut(|data| data.insert_temp(response.id, menu));
    }
    if state.finished().is_none() {
        paint(&painter, rect.min, &ring_corners(&layout, state, rect.size().into(), language), &inks);
        let corner = pointed.and_then(|at| ring_corner_at(&layout, state, rect.size().into(), at, language));
        if let Some((definition, [left, top, right, bottom])) = corner {
            let [from, to] = [vec2(left, top), vec2(right, bottom)].map(|by| rect.min + by);
            explain_at(ui, (Rect::from_min_max(from, to), 0), definition, language);
        }
    }
    // Presentation mode has no top bar with the time.
    if Look::is_strong(painter.ctx()) {
        let time = time_words(stage.lasted(), stage.playback_scale(), language);
        let font = theme::strong(theme::LARGE);
        painter.text(rect.right_top(), Align2::RIGHT_TOP, time, font, look.text);
    }
    let can_fail = session.can_fail() && message.is_none() && matches!(spot, Some(RingSpot::Node(_)));
    match ui.data(|data| data.get_temp::<Option<RingMenu>>(response.id)).flatten() {
        Some(RingMenu::Node(node)) => machine_menu::on(&response, session, selection, node, look),
        Some(RingMenu::Message(message)) => message_menu::on(&response, session, &message, look),
        None => {}
    }
    if let Some((title, lines)) = tooltip {
        response.on_hover_ui_at_pointer(|ui| {
            widgets::tooltip_table(ui, &title, &lines, look);
            if can_fail {
                let hint = word!(
                    language,
                    "Right-click: switch off, hang, cut off",
                    "Botão direito: desligar, travar, isolar"
                );
                ui.label(RichText::new(hint).font(theme::regular(theme::SMALL)).color(look.quiet));
            }
        });
    }
}

/// Subject of the ring's context menu.
#[derive(Clone)]
enum RingMenu {
    Node(NodeId),
    Message(MessageInMenu),
}

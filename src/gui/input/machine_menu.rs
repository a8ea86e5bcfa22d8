//! Context menu of a machine: switch it off, hang it, cut it off, restore it, or let a spare one join.

use egui::{Align2, Popup, Rect, Response, Role, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

use super::selection::Selection;
use crate::balance::{Condition, NodeId};
use crate::gui::session::{Session, only_live_words};
use crate::gui::widgets::explained::explained;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{action_menu, popup_frame};
use crate::language::{Language, say, word};
use crate::view::{Definition, NodeRow, Subject, activity_word, node_name};

/// Opens the menu of a machine when `response` is right-clicked.
pub fn on(response: &Response, session: &mut Session, selection: &mut Selection, node: NodeId, look: Look) {
    show(Popup::context_menu(response), response, (session, selection), node, look);
}

/// Opens the menu of a machine when its activity in the table is clicked. The activity begins at `left` in the
/// rectangle `row_rect`.
pub fn on_activity(
    ui: &mut Ui,
    (left, row_rect): (f32, Rect),
    (session, selection): (&mut Session, &mut Selection),
    row: &NodeRow,
    look: Look,
) {
    let language = session.language();
    let rect = Rect::from_min_max(pos2(left - 0.5 * GRID, row_rect.top()), row_rect.right_bottom());
    let response = ui.interact(rect, ui.scope_id().with(("menu", row.node)), Sense::click());
    let name = node_name(row.node);
    response.widget_info(|| {
        let activity = activity_word(row.activity, language);
        let label = say!(language, "Machine {name} now: {activity}", "Máquina {name} agora: {activity}");
        WidgetInfo::labeled(Role::Button, session.can_fail(), label)
    });
    let response = explained(response, Definition::of_activity(row.activity), language);
    if response.hovered() || response.has_focus() {
        let inner = rect.shrink2(vec2(0.0, 3.0));
        ui.painter().rect_stroke(inner, 5.0, Stroke::new(1.0, look.hairline), egui::StrokeKind::Inside);
        let right = pos2(rect.right() - GRID, rect.center().y);
        ui.painter().text(right, Align2::RIGHT_CENTER, "…", theme::strong(theme::BODY), look.quiet);
    }
    show(Popup::menu(&response), &response, (session, selection), row.node, look);
}

fn show(
    popup: Popup<'_>,
    response: &Response,
    (session, selection): (&mut Session, &mut Selection),
    node: NodeId,
    look: Look,
) {
    if popup.frame(popup_frame(&response.ctx)).show(|ui| items(ui, session, node, look)).is_some() {
        // The keys that the menu shows are those of the selected machine.
        selection.selected = Some(Subject::Node(node));
    }
}

/// Returns the conditions that a machine in this condition can get, each with the text of its button.
fn possible_conditions(condition: Condition, is_spare: bool, language: Language) -> Vec<(Condition, &'static str)> {
    let (well, hung) = (Condition::Well, (Condition::Hung, word!(language, "Hang", "Travar")));
    let (off, cut) = (
        (Condition::Off, word!(language, "Switch off", "Desligar")),
        (Condition::CutOff, word!(language, "Cut off", "Isolar")),
    );
    match condition {
        Condition::Off if is_spare => vec![(well, word!(language, "Join", "Entrar no anel"))],
        Condition::Off => vec![(well, word!(language, "Switch on", "Ligar"))],
        Condition::Well => vec![off, hung, cut],
        Condition::Hung => vec![(well, word!(language, "Resume", "Retomar")), off, cut],
        Condition::CutOff => vec![(well, word!(language, "Reconnect", "Reconectar")), off, hung],
    }
}

/// Returns the key that changes the `present` condition of a selected machine to this one. The key of a condition also
/// ends it.
fn key(condition: Condition, present: Condition) -> &'static str {
    match if condition == Condition::Well { present } else { condition } {
        Condition::Off => "X",
        Condition::Hung => "H",
        Condition::CutOff => "U",
        Condition::Well => "",
    }
}

fn items(ui: &mut Ui, session: &mut Session, node: NodeId, look: Look) {
    let language = session.language();
    let name = node_name(node);
    let hint = if !session.can_fail() {
        only_live_words(language)
    } else if session.mends_losses() {
        word!(
            language,
            "This ring detects the failure and recovers the atoms",
            "Este anel detecta a falha e recupera os átomos"
        )
    } else {
        word!(
            language,
            "This run cannot recover lost atoms and may hang. The adaptive ring can, with its leases",
            "Esta execução não recupera átomos perdidos e pode travar. O anel adaptativo recupera, com seus prazos"
        )
    };
    let conditions = possible_conditions(session.condition(node), session.is_spare(node), language);
    let present = session.condition(node);
    let conditions =
        conditions.into_iter().map(|(condition, text)| (condition, text.to_owned(), key(condition, present)));
    let title = say!(language, "Machine {name}", "Máquina {name}");
    if let Some(condition) = action_menu(ui, &title, conditions, (session.can_fail(), hint), look) {
        session.set_condition(node, condition);
    }
}

//! What can become of a machine: it is switched off, hangs, is cut off, and is well again; or it joins.

use egui::{Align2, Popup, Rect, Response, Role, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

use crate::balance::{Condition, NodeId};
use crate::gui::session::Session;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{deeds, popup_frame};
use crate::language::{Language, say, word};
use crate::view::{NodeRow, activity_word, node_name};

/// The menu of a machine, which opens where the right button is pressed on `response`.
pub fn on(response: &Response, session: &mut Session, node: NodeId, look: Look) {
    show(Popup::context_menu(response), response, session, node, look);
}

/// What a machine does now, in its row, opens its menu too.
pub fn on_state(ui: &mut Ui, (left, row): (f32, Rect), session: &mut Session, shown: &NodeRow, look: Look) {
    let language = session.language();
    let place = Rect::from_min_max(pos2(left - 0.5 * GRID, row.top()), row.right_bottom());
    let response = ui.interact(place, ui.scope_id().with(("menu", shown.node)), Sense::click());
    let name = node_name(shown.node);
    response.widget_info(|| {
        let does = activity_word(shown.activity, language);
        let label = say!(language, "What node {name} does: {does}", "O que a máquina {name} faz: {does}");
        WidgetInfo::labeled(Role::Button, session.can_fail(), label)
    });
    if response.hovered() || response.has_focus() {
        let inner = place.shrink2(vec2(0.0, 3.0));
        ui.painter().rect_stroke(inner, 5.0, Stroke::new(1.0, look.hairline), egui::StrokeKind::Inside);
        let tip = pos2(place.right() - GRID, place.center().y);
        ui.painter().text(tip, Align2::RIGHT_CENTER, "…", theme::strong(theme::BODY), look.quiet);
    }
    show(Popup::menu(&response), &response, session, shown.node, look);
}

fn show(popup: Popup<'_>, response: &Response, session: &mut Session, node: NodeId, look: Look) {
    popup.frame(popup_frame(&response.ctx)).show(|ui| items(ui, session, node, look));
}

/// What can be done to a machine that is so, each with what it is called.
fn possible(condition: Condition, is_spare: bool, language: Language) -> Vec<(Condition, &'static str)> {
    let (well, hung) = (Condition::Well, (Condition::Hung, word!(language, "Let it hang", "Travar")));
    let (off, cut) = (
        (Condition::Off, word!(language, "Switch off", "Desligar")),
        (Condition::CutOff, word!(language, "Cut off", "Isolar")),
    );
    match condition {
        Condition::Off if is_spare => vec![(well, word!(language, "Let it join", "Deixar entrar"))],
        Condition::Off => vec![(well, word!(language, "Switch on again", "Ligar de novo"))],
        Condition::Well => vec![off, hung, cut],
        Condition::Hung => vec![(well, word!(language, "Let it go on", "Deixar continuar")), off, cut],
        Condition::CutOff => vec![(well, word!(language, "Connect again", "Conectar de novo")), off, hung],
    }
}

fn items(ui: &mut Ui, session: &mut Session, node: NodeId, look: Look) {
    let language = session.language();
    let name = node_name(node);
    let hint = if session.mends_losses() {
        word!(language, "This ring notices, and mends it", "Este anel percebe e conserta")
    } else {
        word!(
            language,
            "No remedy for this here: the run may hang. The adaptive ring has one, its leases",
            "Aqui não há remédio: a execução pode parar. O anel adaptativo tem, os prazos"
        )
    };
    let possible = possible(session.condition(node), session.is_spare(node), language);
    let possible = possible.into_iter().map(|(condition, words)| (condition, words.to_owned()));
    let title = say!(language, "Machine {name}", "Máquina {name}");
    if let Some(condition) = deeds(ui, &title, possible, (session.can_fail(), hint), look, language) {
        session.set_condition(node, condition);
    }
}

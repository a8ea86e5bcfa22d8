//! What can be added to a comparison: another strategy, or a run with one thing changed.

use std::time::Duration;

use egui::{Frame, Popup, PopupCloseBehavior, Response, RichText, Role, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

use super::super::settings::Settings;
use super::super::theme::{self, GRID, Look};
use super::columns::menu_button;
use crate::balance::{NodeId, Strategy};
use crate::language::{say, word};
use crate::sim::{Change, Trial};
use crate::view::change_words;

/// A menu of strategies; returns what was chosen.
pub fn strategies(ui: &mut Ui, strategies: &[Strategy], look: Look) -> Option<Change> {
    if strategies.is_empty() {
        return None;
    }
    let opener = menu_button(ui, word!("Add a run", "Acrescentar uma execução"), word!("Add …", "Acrescentar …"));
    let changes = strategies.iter().map(|&strategy| Change::Strategy(strategy)).collect();
    menu(&opener, vec![(String::new(), changes)], look)
}

/// A menu of what can be changed of a run, all else being the same; returns what was chosen.
pub fn changes(ui: &mut Ui, letter: char, trial: &Trial, look: Look) -> Option<Change> {
    let name = say!("The same as {letter} with one thing changed", "Igual a {letter}, mudando uma coisa");
    let opener = menu_button(ui, &name, word!("Change …", "Mudar …"));
    let opener = opener.on_hover_text(&name);
    menu(&opener, possible(trial), look)
}

/// What can be changed, by what it is about.
fn possible(trial: &Trial) -> Vec<(String, Vec<Change>)> {
    let header = &trial.header;
    let nodes = header.speeds.len();
    let strategies = Strategy::ALL.into_iter().filter(|&strategy| strategy != header.rules.strategy);
    let counts = [1, 2, 3, 4, 5, 8, 16, 32].into_iter().filter(|&count| count != nodes);
    let last = nodes.saturating_sub(1) as NodeId;
    let mut speeds: Vec<Change> =
        [1.0, 0.5, 0.1, 0.05, 0.01].into_iter().map(|speed| Change::Speed(last, speed)).collect();
    speeds
        .retain(|change| !matches!(change, Change::Speed(node, speed) if header.speeds[usize::from(*node)] == *speed));
    speeds.push(Change::Equal);
    let atom = header.division.atom_pixels();
    let most = Settings::MOST_ATOMS;
    let atoms = [5, 20, 50, 200, 1000, 5000].into_iter();
    let atoms = atoms.filter(|&pixels| pixels != atom && header.size.pixels() / pixels <= most);
    let ms = Duration::from_millis;
    let latencies = [0, 5, 40, 200, 1000].map(ms).into_iter().filter(|&latency| latency != header.link.latency);
    let handlings = [0, 2, 20, 100].map(ms).into_iter().filter(|&handling| handling != header.handling);
    vec![
        (word!("Strategy", "Estratégia").into(), strategies.map(Change::Strategy).collect()),
        (word!("Machines", "Máquinas").into(), counts.map(Change::Nodes).collect()),
        (word!("The last machine", "A última máquina").into(), speeds),
        (word!("Atoms", "Átomos").into(), atoms.map(Change::Atom).collect()),
        (word!("Network", "Rede").into(), latencies.map(Change::Latency).collect()),
        (word!("Parent", "Pai").into(), handlings.map(Change::Handling).collect()),
    ]
}

/// Groups of changes, each a line of buttons under its name.
fn menu(opener: &Response, groups: Vec<(String, Vec<Change>)>, look: Look) -> Option<Change> {
    let frame = Frame::popup(&opener.ctx.global_style()).fill(look.ground).stroke(Stroke::new(1.0, look.hairline));
    let popup = Popup::from_toggle_button_response(opener).frame(frame.inner_margin(GRID));
    let shown = popup.close_behavior(PopupCloseBehavior::CloseOnClick).show(|ui| {
        ui.set_width(34.0 * GRID);
        ui.spacing_mut().item_spacing = vec2(GRID, 0.0);
        let mut chosen = None;
        for (group, changes) in groups.into_iter().filter(|(_, changes)| !changes.is_empty()) {
            if !group.is_empty() {
                ui.add_space(GRID / 2.0);
                ui.label(RichText::new(group).font(theme::regular(theme::SMALL)).color(look.quiet));
            }
            ui.horizontal_wrapped(|ui| {
                for change in changes {
                    if item(ui, change, look).clicked() {
                        chosen = Some(change);
                    }
                }
            });
        }
        chosen
    });
    shown.and_then(|shown| shown.inner)
}

fn item(ui: &mut Ui, change: Change, look: Look) -> Response {
    let words = change_words(change);
    let galley = ui.painter().layout_no_wrap(words.clone(), theme::regular(theme::BODY), look.text);
    let (rect, response) = ui.allocate_exact_size(galley.size() + vec2(GRID, GRID), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &words));
    if response.hovered() || response.has_focus() {
        ui.painter().rect_filled(rect, 6.0, look.raised);
    }
    ui.painter().galley(pos2(rect.left() + GRID / 2.0, rect.top() + GRID / 2.0), galley, look.text);
    response
}

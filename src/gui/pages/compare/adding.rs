//! Menus that add a run to the comparison: by another strategy, or with one change.

use std::time::Duration;

use egui::{
    Popup, PopupCloseBehavior, Response, RichText, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo, pos2, vec2,
};

use crate::balance::{NodeId, Party, Remedy, Strategy};
use crate::gui::settings::Settings;
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button, named_button, popup_frame};
use crate::language::{Language, say, word};
use crate::sim::{Change, Trial};
use crate::time::Time;
use crate::view::{
    TimeScale, change_words, count, duration, fraction, node_name, remedy_hint, remedy_name, time_words,
};

/// Shows the menu of strategies. Returns the chosen one as a change.
pub fn strategies(ui: &mut Ui, strategies: &[Strategy], look: Look, language: Language) -> Option<Change> {
    if strategies.is_empty() {
        return None;
    }
    let opener = named_button(
        ui,
        None,
        word!(language, "Add a run", "Acrescentar uma execução"),
        Some(word!(language, "Add…", "Acrescentar…")),
        Emphasis::Quiet,
    );
    let changes = strategies.iter().map(|strategy| (Change::Strategy(strategy.clone()), false)).collect();
    menu(&opener, |ui| row(ui, "", changes, look, language))
}

/// Shows the menu of changes that can be made to a run. Returns the chosen one. If the run has not ended at the shown
/// time `now`, the menu also offers new speeds from that time on; until then both runs are the same.
pub fn changes(
    ui: &mut Ui,
    letter: char,
    trial: &Trial,
    now: Option<Time>,
    has_room: bool,
    look: Look,
    language: Language,
) -> Option<Change> {
    let name = say!(language, "Add {letter} with one change", "Acrescentar {letter} com uma mudança");
    let (icon, text) =
        if has_room { (None, Some(word!(language, "Change…", "Mudar…"))) } else { (Some(Icon::Sliders), None) };
    let opener = named_button(ui, icon, &name, text, Emphasis::Quiet).on_hover_text(&name);
    let nodes = trial.header.speeds.len();
    menu(&opener, |ui| {
        // The machine whose speed changes: at first the last one.
        let id = opener.id.with("machine");
        let last = nodes.saturating_sub(1);
        let mut node = ui.data(|data| data.get_temp::<usize>(id)).unwrap_or(last).min(last);
        let mut chosen = None;
        let title = say!(language, "{letter} again, with one change", "{letter} de novo, com uma mudança");
        ui.label(RichText::new(title).font(theme::strong(theme::BODY)).color(look.text));
        ui.add_space(GRID / 2.0);
        for (group, changes) in possible_changes(trial, language) {
            chosen = chosen.or(row(ui, group, changes, look, language));
        }
        ui.horizontal(|ui| {
            heading(ui, word!(language, "A machine", "Uma máquina"), look);
            let before = button(
                ui,
                Some(Icon::Back),
                word!(language, "Previous machine", "Máquina anterior"),
                false,
                Emphasis::Quiet,
            );
            if before.clicked() {
                node = (node + last) % nodes;
            }
            let number = RichText::new(node_name(node as NodeId).to_string());
            ui.label(number.font(theme::strong(theme::BODY)).color(look.text));
            if button(ui, Some(Icon::Next), word!(language, "Next machine", "Próxima máquina"), false, Emphasis::Quiet)
                .clicked()
            {
                node = (node + 1) % nodes;
            }
        });
        ui.data_mut(|data| data.insert_temp(id, node));
        let node = node as NodeId;
        let speeds = [0.0, 0.01, 0.05, 0.1, 0.5, 1.0];
        let initial = trial.header.speeds[usize::from(node)];
        let always = values(&speeds, initial, |speed| Change::Speed(node, speed));
        chosen = chosen.or(row(ui, word!(language, "from the beginning", "desde o início"), always, look, language));
        if let Some(now) = now {
            let at = time_words(now, TimeScale::of_length(now), language);
            let later = values(&speeds, trial.speed_at(now, node), |speed| Change::SpeedAt(now, node, speed));
            chosen = chosen.or(row(ui, &say!(language, "from {at} on", "a partir de {at}"), later, look, language));
        }
        let initial = trial.header.link.latency_of(Party::Node(node));
        let latencies =
            values(&LATENCIES_MS.map(Duration::from_millis), initial, |time| Change::OwnLatency(node, time));
        chosen =
            chosen.or(row(ui, word!(language, "its messages take", "suas mensagens levam"), latencies, look, language));
        chosen
    })
}

/// The latencies offered, of all machines or of one, in milliseconds.
const LATENCIES_MS: [u64; 5] = [0, 5, 40, 200, 1000];

/// A change, and whether the run has this value already.
type Choice = (Change, bool);

/// Returns the possible changes in groups.
fn possible_changes(trial: &Trial, language: Language) -> Vec<(&'static str, Vec<Choice>)> {
    let header = &trial.header;
    let strategies = Strategy::ALL.map(|strategy| {
        let is_present = strategy == header.rules.strategy;
        (Change::Strategy(strategy), is_present)
    });
    let lacks = |remedy| (Change::Without(remedy), !header.rules.remedies.has(remedy));
    let remedies = if header.rules.strategy == Strategy::Adaptive { Remedy::ALL.map(lacks).into() } else { Vec::new() };
    let mut machines = values(&[1, 2, 3, 4, 5, 8, 16, 32], header.speeds.len(), Change::Nodes);
    if header.speeds.iter().any(|&speed| speed < 1.0) {
        machines.push((Change::Equal, false));
    }
    let atoms = [5, 20, 50, 200, 1000, 5000].into_iter();
    let atoms: Vec<_> = atoms.filter(|pixels| header.size.pixels() / pixels <= Settings::MAX_ATOMS).collect();
    let atoms = values(&atoms, header.division.atom_pixels(), Change::Atom);
    let ms = Duration::from_millis;
    let latencies = values(&LATENCIES_MS.map(ms), header.link.latency, Change::Latency);
    let handlings = values(&[0, 2, 20, 100].map(ms), header.handling, Change::Handling);
    vec![
        (word!(language, "Strategy", "Estratégia"), strategies.into()),
        (word!(language, "Without", "Sem"), remedies),
        (word!(language, "Machines", "Máquinas"), machines),
        (word!(language, "Pixels in an atom", "Pixels por átomo"), atoms),
        (word!(language, "A message takes", "Uma mensagem leva"), latencies),
        (word!(language, "The parent takes", "O pai leva"), handlings),
    ]
}

/// Returns the offered values in ascending order, with the present value among them.
fn values<T: Copy + PartialOrd>(offered: &[T], present: T, change: impl Fn(T) -> Change) -> Vec<Choice> {
    let (below, from) = offered.split_at(offered.partition_point(|value| *value < present));
    let above = from.iter().filter(|value| **value > present);
    let choice = |value: &T| (change(*value), false);
    below.iter().map(choice).chain([(change(present), true)]).chain(above.map(choice)).collect()
}

/// Shows a menu that closes when a change is chosen.
fn menu(opener: &Response, content: impl FnOnce(&mut Ui) -> Option<Change>) -> Option<Change> {
    let popup = Popup::from_toggle_button_response(opener).frame(popup_frame(&opener.ctx));
    let shown = popup.close_behavior(PopupCloseBehavior::CloseOnClickOutside).show(|ui| {
        ui.set_width(80.0 * GRID);
        ui.spacing_mut().item_spacing = vec2(GRID / 2.0, 0.0);
        let chosen = content(ui);
        if chosen.is_some() {
            ui.close();
        }
        chosen
    });
    shown.and_then(|shown| shown.inner)
}

/// Shows the heading of a row.
fn heading(ui: &mut Ui, text: &str, look: Look) {
    let (rect, _) = ui.allocate_exact_size(vec2(17.0 * GRID, 4.0 * GRID), Sense::hover());
    let galley = ui.painter().layout_no_wrap(text.to_owned(), theme::regular(theme::SMALL), look.quiet);
    ui.painter().galley(pos2(rect.left(), rect.center().y - galley.size().y / 2.0), galley, look.quiet);
}

/// Shows a group of changes, in one line or more.
fn row(ui: &mut Ui, group: &str, changes: Vec<Choice>, look: Look, language: Language) -> Option<Change> {
    let mut chosen = None;
    if !changes.is_empty() {
        ui.horizontal_top(|ui| {
            if !group.is_empty() {
                heading(ui, group, look);
            }
            // A second line begins below the first one instead of below the heading.
            ui.horizontal_wrapped(|ui| {
                for (change, is_present) in changes {
                    if item(ui, &change, is_present, look, language).clicked() {
                        chosen = Some(change);
                    }
                }
            });
        });
    }
    chosen
}

/// Returns the text of a change without what its row says.
fn short_text(change: &Change, language: Language) -> String {
    match *change {
        Change::Nodes(nodes) => nodes.to_string(),
        Change::Speed(_, speed) | Change::SpeedAt(_, _, speed) => fraction(speed),
        Change::Atom(pixels) => count(pixels),
        Change::Latency(time) | Change::OwnLatency(_, time) | Change::Handling(time) if time.is_zero() => {
            word!(language, "0 ms", "0 ms").to_owned()
        }
        Change::Latency(time) | Change::OwnLatency(_, time) | Change::Handling(time) => duration(time, language),
        Change::Without(remedy) => remedy_name(remedy, language).to_owned(),
        Change::Strategy(_) | Change::Equal => change_words(change, language),
    }
}

/// Shows a change as a button; the present value is only outlined.
fn item(ui: &mut Ui, change: &Change, is_present: bool, look: Look, language: Language) -> Response {
    let galley = ui.painter().layout_no_wrap(short_text(change, language), theme::regular(theme::BODY), look.text);
    let sense = if is_present { Sense::hover() } else { Sense::click() };
    let (rect, response) = ui.allocate_exact_size(vec2(galley.size().x + 2.0 * GRID, 3.75 * GRID), sense);
    let (role, now) = if is_present { (Role::Label, word!(language, ", now", ", agora")) } else { (Role::Button, "") };
    response.widget_info(|| WidgetInfo::labeled(role, true, change_words(change, language) + now));
    if is_present {
        let stroke = Stroke::new(1.5, look.accent);
        ui.painter().rect_stroke(rect.shrink2(vec2(0.0, 2.0)), 6.0, stroke, StrokeKind::Inside);
    } else if response.hovered() || response.has_focus() {
        ui.painter().rect_filled(rect, 6.0, look.raised);
    }
    let corner = pos2(rect.left() + GRID, rect.center().y - galley.size().y / 2.0);
    ui.painter().galley(corner, galley, look.text);
    match change {
        Change::Without(remedy) => response.on_hover_text(remedy_hint(*remedy, language)),
        _ if is_present => response.on_hover_text(word!(language, "The present value", "O valor atual")),
        _ => response,
    }
}

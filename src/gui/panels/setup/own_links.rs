//! The table of what each machine and the parent have of their own at their ends of the links.

use egui::{Grid, Popup, PopupCloseBehavior, RichText, ScrollArea, Ui};

use super::{VALUE_WIDTH_PT, explanation};
use crate::balance::Party;
use crate::gui::settings::{OwnLinkSetting, Settings};
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, named_button, number_field, popup_frame};
use crate::language::{Language, say, word};
use crate::view::node_name;

/// Shows a button that opens the table; its name says how many parties have links of their own.
pub(super) fn own_links(ui: &mut Ui, draft: &mut Settings, look: Look, language: Language) {
    let count = match draft.own_link_count() {
        0 => word!(language, "none", "nenhum").to_owned(),
        count => count.to_string(),
    };
    let name = say!(language, "Own links: {count}", "Enlaces próprios: {count}");
    let text = word!(language, "Each…", "Cada…");
    let opener = named_button(ui, None, &name, Some(text), Emphasis::Quiet).on_hover_text(word!(
        language,
        "A far machine: latency and bandwidth of each machine",
        "Uma máquina distante: latência e banda de cada máquina"
    ));
    let popup = Popup::from_toggle_button_response(&opener).frame(popup_frame(ui.ctx()).inner_margin(1.5 * GRID));
    popup.close_behavior(PopupCloseBehavior::CloseOnClickOutside).show(|ui| {
        ui.set_width(44.0 * GRID);
        ui.spacing_mut().interact_size.y = 3.5 * GRID;
        table(ui, draft, look, language);
        ui.add_space(GRID);
        let rule = word!(
            language,
            "A message takes the larger latency and the smaller bandwidth of its two ends",
            "Uma mensagem leva a maior latência e a menor banda de suas duas pontas"
        );
        explanation(ui, rule, look);
    });
}

/// Shows a row for the parent and for each machine.
fn table(ui: &mut Ui, draft: &mut Settings, look: Look, language: Language) {
    ScrollArea::vertical().max_height(64.0 * GRID).show(ui, |ui| {
        Grid::new("own links").num_columns(3).spacing([2.0 * GRID, 2.0]).show(ui, |ui| {
            for text in [
                word!(language, "machine", "máquina"),
                word!(language, "latency", "latência"),
                word!(language, "bandwidth", "banda"),
            ] {
                ui.label(RichText::new(text).font(theme::regular(theme::SMALL)).color(look.quiet));
            }
            ui.end_row();
            for party in draft.parties() {
                row(ui, draft, party, look, language);
                ui.end_row();
            }
        });
    });
}

/// Shows the values of a party. A value like that of all others is none of its own.
fn row(ui: &mut Ui, draft: &mut Settings, party: Party, look: Look, language: Language) {
    let (label, whose) = match party {
        Party::Parent => {
            (word!(language, "parent", "pai").to_owned(), word!(language, "the parent", "do pai").to_owned())
        }
        Party::Node(node) => {
            let name = node_name(node);
            (name.to_string(), say!(language, "machine {name}", "da máquina {name}"))
        }
    };
    ui.label(RichText::new(label).font(theme::regular(theme::BODY)).color(look.text));
    let (usual_latency, usual_bandwidth) =
        if party == Party::Parent { (0.0, 0) } else { (draft.latency, draft.bandwidth) };
    let own = draft.own_link(party);
    let mut latency = own.latency.unwrap_or(usual_latency);
    let name = say!(language, "Latency of {whose} in milliseconds", "Latência {whose} em milissegundos");
    number_field(ui, &mut latency, 0.0..=Settings::MAX_LATENCY_MS, " ms", VALUE_WIDTH_PT, (&name, language));
    let mut bandwidth = own.bandwidth.unwrap_or(usual_bandwidth);
    let suffix = if bandwidth == 0 { word!(language, ": no limit", ": livre") } else { " kB/s" };
    // 0 means no limit, which none can have of its own where all others have one.
    let least = usual_bandwidth.min(1);
    let name = say!(language, "Kilobytes a second of {whose}", "Quilobytes por segundo {whose}");
    number_field(ui, &mut bandwidth, least..=Settings::MAX_BANDWIDTH_KB_S, suffix, VALUE_WIDTH_PT, (&name, language));
    let own = OwnLinkSetting {
        latency: (latency != usual_latency).then_some(latency),
        bandwidth: (bandwidth != usual_bandwidth).then_some(bandwidth),
    };
    if own != draft.own_link(party) {
        draft.set_own_link(party, own);
    }
}

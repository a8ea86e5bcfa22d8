//! Who shares the atoms, by which rules, and over what network.

use egui::text::{LayoutJob, TextFormat};
use egui::{Button, ComboBox, Popup, PopupCloseBehavior, Response, RichText, TextWrapMode, Ui, WidgetInfo, vec2};

use super::{VALUE, high_line, line, small};
use crate::balance::{Remedy, Strategy};
use crate::gui::settings::Settings;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, choice, named_button, number, popup_frame};
use crate::language::{Language, say, word};
use crate::runlog::Driver;
use crate::view::{Sharing, remedies_words, remedy_hint, remedy_name};

/// Who shares the atoms, and how.
pub(super) fn sharing(ui: &mut Ui, draft: &mut Settings, look: Look, language: Language) {
    let on = draft.sharing();
    let name = word!(language, "Strategy", "Estratégia");
    high_line(ui, name, look, |ui| {
        // Who rayon is, the list tells.
        let combo = ComboBox::from_id_salt("strategy")
            .selected_text(on.short_name(language))
            .width(20.0 * GRID)
            .height(60.0 * GRID);
        let combo = combo.show_ui(ui, |ui| {
            // All of them are in sight in a window of 1280 × 800.
            ui.spacing_mut().item_spacing.y = 0.0;
            ui.spacing_mut().button_padding.y = 3.0;
            ui.visuals_mut().selection.bg_fill = look.hairline;
            for sharing in Sharing::ALL {
                if strategy(ui, sharing, sharing == on, look, language).clicked() && sharing != on {
                    draft.set_sharing(sharing);
                }
            }
        });
        combo.response.widget_info(|| {
            let mut info = WidgetInfo::labeled(egui::Role::ComboBox, true, name);
            info.current_text_value = Some(on.name(language).to_owned());
            info
        });
    });
    // What it does, its remedies say.
    let adapts = on == Sharing::By(Strategy::Adaptive);
    if adapts {
        remedies(ui, draft, look, language);
    } else {
        small(ui, on.hint(language), look);
    }
    let stealing = on == Sharing::Stealing;
    high_line(ui, word!(language, "Time", "Tempo"), look, |ui| {
        ui.add_enabled_ui(!stealing, |ui| {
            let virtual_hint = word!(
                language,
                "The same rules in simulated time; a changed speed acts in virtual time",
                "As mesmas regras em tempo simulado; uma nova velocidade vale em tempo virtual"
            );
            let real_hint = word!(
                language,
                "Threads of this computer trace, as fast as their machines",
                "Threads deste computador calculam, tão rápido quanto suas máquinas"
            );
            // From right to left.
            let all = [(true, "Virtual", virtual_hint), (false, "Real", real_hint)];
            if let Some(is_virtual) = choice(ui, draft.driver == Driver::Sim, &all) {
                draft.driver = if is_virtual { Driver::Sim } else { Driver::Threads };
            }
        });
    });
    let is_farm = !stealing && draft.strategy.is_farm();
    let has_part = is_farm || !stealing && draft.strategy.is_ring();
    let (what, name) = if is_farm {
        word!(language, ("A part is", "Atoms in a part"), ("Uma parte tem", "Átomos numa parte"))
    } else {
        word!(
            language,
            ("Smallest parcel", "Least atoms worth sending"),
            ("Menor pacote", "Mínimo de átomos que vale enviar")
        )
    };
    ui.add_enabled_ui(has_part, |ui| {
        line(ui, what, look, |ui| {
            let suffix = if draft.part == 1 {
                word!(language, " atom", " átomo")
            } else {
                word!(language, " atoms", " átomos")
            };
            number(ui, &mut draft.part, 1..=10_000, suffix, VALUE, name);
        });
    });
    if adapts {
        spares(ui, draft, look, language);
    }
}

/// What messages cost; rayon's threads send none.
pub(super) fn network(ui: &mut Ui, draft: &mut Settings, look: Look, language: Language) {
    ui.add_enabled_ui(draft.sharing() != Sharing::Stealing, |ui| {
        line(ui, word!(language, "The parent takes", "O pai leva"), look, |ui| {
            let (most, suffix) = (Settings::MOST_HANDLING, word!(language, " ms each", " ms cada"));
            let name = word!(language, "Parent's milliseconds for a message", "Milissegundos do pai por mensagem");
            number(ui, &mut draft.handling, 0..=most, suffix, 13.0 * GRID, name).on_hover_text(word!(
                language,
                "So long the parent is busy with each message. With many of them it cannot keep up: they wait in line, \
                 and so does whoever needs an answer",
                "Tanto o pai se ocupa de cada mensagem. Se são muitas, ele não dá conta: elas esperam na fila, \
                 e com elas quem precisa de resposta"
            ));
        });
        line(ui, word!(language, "A link carries", "Um enlace leva"), look, |ui| {
            let no_limit = word!(language, ": no limit", ": sem limite");
            let (most, suffix) = (Settings::MOST_BANDWIDTH, if draft.bandwidth == 0 { no_limit } else { " kB/s" });
            let name = word!(language, "Kilobytes a second", "Quilobytes por segundo");
            number(ui, &mut draft.bandwidth, 0..=most, suffix, VALUE, name).on_hover_text(word!(
                language,
                "An Ethernet of 1997 carried at most 1250 kB/s; 0 is no limit",
                "Uma Ethernet de 1997 levava no máximo 1250 kB/s; 0 é sem limite"
            ));
        });
        if draft.bandwidth > 0 {
            let text = word!(language, "All share one wire", "Todos num só cabo");
            let text = RichText::new(text).font(theme::regular(theme::BODY)).color(look.quiet);
            ui.checkbox(&mut draft.shared_wire, text).on_hover_text(word!(
                language,
                "Only one message at a time is sent, whoever sends it; else each pair has a wire",
                "Só uma mensagem é enviada por vez, seja de quem for; senão cada par tem um cabo"
            ));
        }
    });
}

/// Machines that are off at first, and may join while the run goes on.
fn spares(ui: &mut Ui, draft: &mut Settings, look: Look, language: Language) {
    line(ui, word!(language, "Spare machines", "Máquinas de reserva"), look, |ui| {
        let mut spares = draft.spares.len() as u32;
        let name = word!(language, "Number of spare machines", "Número de máquinas de reserva");
        number(ui, &mut spares, 0..=Settings::MOST_SPARES as u32, "", VALUE, name).on_hover_text(word!(
            language,
            "They are off at first: an empty seat's menu lets one join",
            "De início, desligadas: o menu de um lugar vazio deixa uma entrar"
        ));
        draft.set_spares(spares as usize);
    });
}

/// What the ring does otherwise than the article's, each to be left out.
fn remedies(ui: &mut Ui, draft: &mut Settings, look: Look, language: Language) {
    line(ui, word!(language, "Remedies", "Remédios"), look, |ui| {
        let words = remedies_words(draft.remedies, language);
        let name = say!(language, "Remedies: {words}", "Remédios: {words}");
        let opener = named_button(ui, None, &name, Some(&words), Emphasis::Quiet);
        let popup = Popup::from_toggle_button_response(&opener).frame(popup_frame(ui.ctx()));
        popup.close_behavior(PopupCloseBehavior::CloseOnClickOutside).show(|ui| {
            ui.set_width(54.0 * GRID);
            ui.spacing_mut().item_spacing.y = 0.0;
            ui.visuals_mut().widgets.inactive.bg_fill = look.hairline;
            for remedy in Remedy::ALL {
                let mut has = draft.remedies.has(remedy);
                let name =
                    RichText::new(remedy_name(remedy, language)).font(theme::strong(theme::BODY)).color(look.text);
                if ui.checkbox(&mut has, name).changed() {
                    let (with, without) = (draft.remedies.with(remedy), draft.remedies.without(remedy));
                    draft.remedies = if has { with } else { without };
                }
                small(ui, remedy_hint(remedy, language), look);
                ui.add_space(0.75 * GRID);
            }
            let hint = word!(language, "Without any it is the article's ring", "Sem nenhum, é o anel do artigo");
            small(ui, hint, look);
        });
    });
}

/// A strategy in the list: its name, and below it what happens.
fn strategy(ui: &mut Ui, sharing: Sharing, on: bool, look: Look, language: Language) -> Response {
    let mut words = LayoutJob::default();
    let mut line = |text: &str, size, color| {
        words.append(text, 0.0, TextFormat { font_id: theme::regular(size), color, ..TextFormat::default() });
    };
    line(&format!("{}\n", sharing.name(language)), theme::BODY, look.text);
    line(sharing.hint(language), theme::SMALL, look.quiet);
    let response =
        ui.add(Button::selectable(on, words).wrap_mode(TextWrapMode::Extend).min_size(vec2(36.0 * GRID, 0.0)));
    response.widget_info(|| WidgetInfo::selected(egui::Role::Button, true, on, sharing.name(language)));
    response
}

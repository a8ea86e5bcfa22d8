//! Settings of strategy, driver, network, spare machines and remedies.

use egui::text::{LayoutJob, TextFormat};
use egui::{Button, ComboBox, Popup, PopupCloseBehavior, Response, RichText, TextWrapMode, Ui, WidgetInfo, vec2};

use super::own_links::own_links;
use super::{VALUE_WIDTH_PT, explanation, high_row, labelled_row};
use crate::balance::{Remedy, Scheduler, Strategy};
use crate::gui::settings::Settings;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, choice_buttons, named_button, number_field, popup_frame};
use crate::language::{Language, say, word};
use crate::runlog::Driver;
use crate::view::{Definition, remedies_words, remedy_hint, remedy_name};

/// Shows the settings of strategy and driver.
pub(super) fn sharing(ui: &mut Ui, draft: &mut Settings, look: Look, language: Language) {
    let on = draft.scheduler();
    let name = word!(language, "Strategy", "Estratégia");
    high_row(ui, name, look, |ui| {
        // The short name: the list has the full one.
        let combo = ComboBox::from_id_salt("strategy")
            .selected_text(on.short_title(language))
            .width(20.0 * GRID)
            .height(60.0 * GRID);
        let combo = combo.show_ui(ui, |ui| {
            // With these distances the whole list is visible in a window of 1280 × 800.
            ui.spacing_mut().item_spacing.y = 0.0;
            ui.spacing_mut().button_padding.y = 3.0;
            ui.visuals_mut().selection.bg_fill = look.hairline;
            for scheduler in Scheduler::ALL {
                let is_on = scheduler == on;
                if strategy(ui, &scheduler, is_on, look, language).clicked() && !is_on {
                    draft.set_scheduler(scheduler);
                }
            }
        });
        combo.response.widget_info(|| {
            let mut info = WidgetInfo::labeled(egui::Role::ComboBox, true, name);
            info.current_text_value = Some(on.title(language).to_owned());
            info
        });
    });
    // The remedies explain what the adaptive ring does.
    let is_adaptive = on == Scheduler::Protocol(Strategy::Adaptive);
    if is_adaptive {
        remedies(ui, draft, look, language);
    } else {
        explanation(ui, on.hint(language), look);
    }
    let stealing = on == Scheduler::WorkStealing;
    high_row(ui, (word!(language, "Time", "Tempo"), Definition::VIRTUAL_TIME, language), look, |ui| {
        ui.add_enabled_ui(!stealing, |ui| {
            let virtual_hint = word!(
                language,
                "The same strategy in simulated time, independent of this computer's speed",
                "A mesma estratégia em tempo simulado, sem depender da velocidade deste computador"
            );
            let real_hint = word!(
                language,
                "Threads of this computer trace at the speeds of the machines",
                "Threads deste computador calculam nas velocidades das máquinas"
            );
            // The layout runs from right to left.
            let all = [(true, "Virtual", virtual_hint), (false, "Real", real_hint)];
            if let Some(is_virtual) = choice_buttons(ui, draft.driver == Driver::Sim, &all) {
                draft.driver = if is_virtual { Driver::Sim } else { Driver::Threads };
            }
        });
    });
    let is_farm = !stealing && draft.strategy.is_farm();
    let has_part = is_farm || !stealing && draft.strategy.is_ring();
    let (label, name) = if is_farm {
        word!(language, ("A part has", "Atoms in a part"), ("Uma parte tem", "Átomos numa parte"))
    } else {
        word!(
            language,
            ("Smallest transfer", "Fewest atoms of a transfer"),
            ("Menor transferência", "Mínimo de átomos de uma transferência")
        )
    };
    ui.add_enabled_ui(has_part, |ui| {
        labelled_row(ui, (label, Definition::PART, language), look, |ui| {
            let suffix = if draft.part == 1 {
                word!(language, " atom", " átomo")
            } else {
                word!(language, " atoms", " átomos")
            };
            number_field(ui, &mut draft.part, 1..=10_000, suffix, VALUE_WIDTH_PT, (name, language));
        });
    });
    if on.survives_losses() {
        spares(ui, draft, look, language);
    }
}

/// Shows the settings of the network; rayon's threads send no messages.
pub(super) fn network(ui: &mut Ui, draft: &mut Settings, look: Look, language: Language) {
    ui.add_enabled_ui(draft.scheduler() != Scheduler::WorkStealing, |ui| {
        labelled_row(ui, (word!(language, "The parent takes", "O pai leva"), Definition::HANDLING, language), look, |ui| {
            let (max, suffix) = (Settings::MAX_HANDLING_MS, word!(language, " ms each", " ms cada"));
            let name = word!(language, "Parent's milliseconds for a message", "Milissegundos do pai por mensagem");
            number_field(ui, &mut draft.handling, 0.0..=max, suffix, 13.0 * GRID, (name, language)).on_hover_text(word!(
                language,
                "Time that the parent needs for each message. If messages come faster, they wait in line, and machines \
                wait for their answers",
                "Tempo que o pai precisa para cada mensagem. Se chegam mais depressa, esperam na fila, e as máquinas \
                esperam suas respostas"
            ));
        });
        labelled_row(ui, (word!(language, "A link", "Enlace"), Definition::BANDWIDTH, language), look, |ui| {
            let no_limit = word!(language, ": no limit", ": livre");
            let (max, suffix) = (Settings::MAX_BANDWIDTH_KB_S, if draft.bandwidth == 0 { no_limit } else { " kB/s" });
            let name = word!(language, "Kilobytes a second", "Quilobytes por segundo");
            number_field(ui, &mut draft.bandwidth, 0..=max, suffix, VALUE_WIDTH_PT, (name, language)).on_hover_text(
                word!(
                    language,
                    "An Ethernet of 1997 carried at most 1250 kB/s. 0 means no limit",
                    "Uma Ethernet de 1997 levava no máximo 1250 kB/s. 0 significa sem limite"
                ),
            );
            own_links(ui, draft, look, language);
        });
        if draft.bandwidth > 0 {
            let text = word!(language, "All share one wire", "Todos num só cabo");
            let text = RichText::new(text).font(theme::regular(theme::BODY)).color(look.quiet);
            ui.checkbox(&mut draft.shared_wire, text).on_hover_text(word!(
                language,
                "Only one message at a time travels. Otherwise each pair of machines has its own wire",
                "Só uma mensagem viaja por vez. Senão, cada par de máquinas tem seu próprio cabo"
            ));
        }
    });
}

/// Shows the number of spare machines.
fn spares(ui: &mut Ui, draft: &mut Settings, look: Look, language: Language) {
    labelled_row(ui, word!(language, "Spare machines", "Máquinas de reserva"), look, |ui| {
        let mut spares = draft.spares.len() as u32;
        let name = word!(language, "Number of spare machines", "Número de máquinas de reserva");
        number_field(ui, &mut spares, 0..=Settings::MAX_SPARES as u32, "", VALUE_WIDTH_PT, (name, language))
            .on_hover_text(word!(
                language,
                "They are off at first. Right-click one in the ring to let it join",
                "Começam desligadas. Clique em uma no anel com o botão direito para ela entrar"
            ));
        draft.set_spares(spares as usize);
    });
}

/// Shows the remedies of the adaptive ring, each with a check box.
fn remedies(ui: &mut Ui, draft: &mut Settings, look: Look, language: Language) {
    labelled_row(ui, word!(language, "Remedies", "Remédios"), look, |ui| {
        let text = remedies_words(draft.remedies, language);
        let name = say!(language, "Remedies: {text}", "Remédios: {text}");
        let opener = named_button(ui, None, &name, Some(&text), Emphasis::Quiet);
        let popup = Popup::from_toggle_button_response(&opener).frame(popup_frame(ui.ctx()));
        popup.close_behavior(PopupCloseBehavior::CloseOnClickOutside).show(|ui| {
            ui.set_width(54.0 * GRID);
            ui.spacing_mut().item_spacing.y = 0.0;
            ui.visuals_mut().widgets.inactive.bg_fill = look.hairline;
            for remedy in Remedy::ALL {
                let mut is_on = draft.remedies.has(remedy);
                let name =
                    RichText::new(remedy_name(remedy, language)).font(theme::strong(theme::BODY)).color(look.text);
                if ui.checkbox(&mut is_on, name).changed() {
                    let (with, without) = (draft.remedies.with(remedy), draft.remedies.without(remedy));
                    draft.remedies = if is_on { with } else { without };
                }
                explanation(ui, remedy_hint(remedy, language), look);
                ui.add_space(0.75 * GRID);
            }
            let hint = word!(
                language,
                "Without any remedy it is the article's ring",
                "Sem nenhum remédio, é o anel do artigo"
            );
            explanation(ui, hint, look);
        });
    });
}

/// Shows a strategy of the list: its name, and below it its description.
fn strategy(ui: &mut Ui, scheduler: &Scheduler, on: bool, look: Look, language: Language) -> Response {
    let mut text = LayoutJob::default();
    let mut add = |part: &str, size, color| {
        text.append(part, 0.0, TextFormat { font_id: theme::regular(size), color, ..TextFormat::default() });
    };
    add(&format!("{}\n", scheduler.title(language)), theme::BODY, look.text);
    add(scheduler.hint(language), theme::SMALL, look.quiet);
    let response =
        ui.add(Button::selectable(on, text).wrap_mode(TextWrapMode::Extend).min_size(vec2(36.0 * GRID, 0.0)));
    response.widget_info(|| WidgetInfo::selected(egui::Role::Button, true, on, scheduler.title(language)));
    response
}

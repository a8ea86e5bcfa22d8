//! What comes of a comparison: when who did what, where the time went, how strategies grow, and why two runs differ.

use egui::{RichText, ScrollArea, Sense, Ui, UiBuilder, pos2, vec2};

use super::columns::letter;
use super::growth::{self, Measure};
use super::{CompareColumn, lanes};
use crate::gui::session::Growth;
use crate::gui::widgets;
use crate::gui::widgets::paint::{Inks, paint};
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::language::{Language, say, word};
use crate::time::Time;
use crate::view::{
    NamedBudget, TimeBudget, compare_runs, count, duration, fraction, time_budget_height, time_budget_marks,
    time_budget_words,
};

/// What is shown of all runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Tab {
    /// A lane a machine, on one axis of time.
    #[default]
    Lanes,
    /// Where the time went.
    Spent,
    /// What comes of more machines.
    Growth(Measure),
}

/// What is chosen.
#[derive(Default)]
pub struct Findings {
    tab: Tab,
    /// The runs of which is told why they differ.
    pub pair: [usize; 2],
}

impl Findings {
    /// Whether it is to be known how strategies grow.
    pub fn wants_growth(&self) -> bool {
        matches!(self.tab, Tab::Growth(_))
    }

    /// The height that they want of so much, the same whatever is shown.
    pub fn height(all: f32) -> f32 {
        (0.47 * all).clamp(30.0 * GRID, 52.0 * GRID)
    }

    /// Shows them in what room there is. Returns the time that somebody points to with a button down.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        entries: &mut [CompareColumn],
        growth: Option<&Growth>,
        now: Time,
        length: Time,
        look: Look,
        language: Language,
    ) -> Option<Time> {
        let mut sought = None;
        let area = ui.available_rect_before_wrap();
        let right = (0.32 * area.width()).clamp(34.0 * GRID, 56.0 * GRID);
        let left = area.with_max_x(area.right() - right - 3.0 * GRID);
        let right = area.with_min_x(area.right() - right);
        ui.scope_builder(UiBuilder::new().max_rect(left), |ui| {
            let tabs = [
                (
                    Tab::Lanes,
                    word!(language, "Timelines", "Linhas do tempo"),
                    word!(language, "Who did what and when", "Quem fez o quê e quando"),
                ),
                (
                    Tab::Spent,
                    word!(language, "Where the time went", "Para onde foi o tempo"),
                    word!(language, "Work, waiting, messages", "Trabalho, espera, mensagens"),
                ),
                (
                    Tab::Growth(Measure::Speedup),
                    "Speedup",
                    word!(language, "With one machine to eight", "Com uma a oito máquinas"),
                ),
                (
                    Tab::Growth(Measure::Efficiency),
                    word!(language, "Efficiency", "Eficiência"),
                    word!(language, "With one machine to eight", "Com uma a oito máquinas"),
                ),
            ];
            if let Some(tab) = widgets::choice(ui, self.tab, &tabs) {
                self.tab = tab;
            }
            ui.add_space(GRID);
            match self.tab {
                Tab::Lanes => sought = lanes::show(ui, entries, now, length, look, language),
                Tab::Spent => where_time_went(ui, entries, look, language),
                Tab::Growth(measure) => growth::show(ui, growth, entries, measure, look, language),
            }
        });
        ui.scope_builder(UiBuilder::new().max_rect(right), |ui| self.why(ui, entries, look, language));
        sought
    }

    /// Why two of them differ, and the figures of both.
    fn why(&self, ui: &mut Ui, entries: &[CompareColumn], look: Look, language: Language) {
        let known = |place: usize| {
            let contender = entries.get(place)?.contender.as_ref()?;
            Some((letter(place), contender))
        };
        let (Some((a, one)), Some((b, other))) = (known(self.pair[0]), known(self.pair[1])) else { return };
        let heading = say!(language, "{a} and {b}: why they differ", "{a} e {b}: por que diferem");
        ui.label(RichText::new(heading).font(theme::strong(theme::BODY)).color(look.text));
        ui.add_space(GRID / 2.0);
        ScrollArea::vertical().id_salt("why").auto_shrink(false).show(ui, |ui| {
            let text = match (&one.budget, &other.budget) {
                (Some(first), Some(second)) => compare_runs(
                    NamedBudget { name: &one.name, budget: first },
                    NamedBudget { name: &other.name, budget: second },
                    language,
                ),
                _ => {
                    let name = if one.budget.is_none() { &one.name } else { &other.name };
                    say!(
                        language,
                        "{name} never ends: a machine that stands still keeps its atoms.",
                        "{name} nunca termina: uma máquina parada fica com seus átomos."
                    )
                }
            };
            ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(look.text));
            ui.add_space(GRID);
            figures(ui, [(a, one.budget.as_ref()), (b, other.budget.as_ref())], look, language);
        });
    }
}

/// A row a figure, a column a run.
fn figures(ui: &mut Ui, runs: [(char, Option<&TimeBudget>); 2], look: Look, language: Language) {
    /// What it is called, what it is, and how much.
    type Figure = ([&'static str; 2], fn(&TimeBudget, Language) -> String);
    let all: [Figure; 7] = [
        (
            word!(language, ["time", "Until the picture is complete"], ["tempo", "Até a imagem ficar pronta"]),
            |account, language| duration(account.makespan, language),
        ),
        (
            word!(
                language,
                ["shared perfectly", "Had all machines worked until the end"],
                ["divisão perfeita", "Se todas as máquinas trabalhassem até o fim"]
            ),
            |account, language| duration(account.ideal, language),
        ),
        (
            word!(
                language,
                ["efficiency", "The time if it were shared perfectly, over the time"],
                ["eficiência", "O tempo da divisão perfeita sobre o tempo"]
            ),
            |account, _| fraction(account.efficiency()),
        ),
        (
            word!(
                language,
                [
                    "messages to share",
                    "All messages but those with results and those that only tell what a machine has"
                ],
                [
                    "mensagens de divisão",
                    "Todas as mensagens, menos as de resultados e as que só dizem o que uma máquina tem"
                ]
            ),
            |account, _| count(account.messages.sharing()),
        ),
        (
            word!(
                language,
                [
                    "messages with results",
                    "What a machine has traced goes to the parent in small batches, so that one sees the picture grow. A slow \
                     machine's atoms go one by one: the more of them it traces, the more messages, whoever shares",
                ],
                [
                    "mensagens de resultados",
                    "O que uma máquina calculou vai ao pai em pequenos lotes, para que se veja a imagem crescer. Os átomos de \
                     uma máquina lenta vão um a um: quanto mais ela calcula, mais mensagens, seja qual for a divisão",
                ]
            ),
            |account, _| count(account.messages.results),
        ),
        (
            word!(
                language,
                ["atoms given away", "From one machine to another"],
                ["átomos cedidos", "De uma máquina a outra"]
            ),
            |account, _| count(account.messages.atoms_moved),
        ),
        (
            word!(
                language,
                ["alone at the end", "While only one machine still traced"],
                ["sozinha no fim", "Enquanto só uma máquina ainda calculava"]
            ),
            |account, language| duration(account.last.alone, language),
        ),
    ];
    let font = theme::regular(theme::SMALL);
    let row = |ui: &mut Ui, name: &str, values: [String; 2]| {
        let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), 18.0), Sense::hover());
        ui.spacing_mut().item_spacing.y = 0.0;
        widgets::describe(&response, name, || values.join("; "));
        let painter = ui.painter();
        painter.text(rect.left_center(), egui::Align2::LEFT_CENTER, name, font.clone(), look.quiet);
        for (value, right) in values.into_iter().zip([11.0 * GRID, 0.0]) {
            let at = pos2(rect.right() - GRID - right, rect.center().y);
            painter.text(at, egui::Align2::RIGHT_CENTER, value, font.clone(), look.text);
        }
        response
    };
    row(ui, "", runs.map(|(letter, _)| letter.to_string()));
    for ([name, hint], of) in all {
        row(ui, name, runs.map(|(_, account)| account.map_or("—".to_owned(), |account| of(account, language))))
            .on_hover_text(hint);
    }
}

/// Bars of what the machines' time was spent on.
fn where_time_went(ui: &mut Ui, entries: &[CompareColumn], look: Look, language: Language) {
    let names: Vec<String> =
        (0..entries.len()).map(|place| format!("{}  {}", letter(place), entries[place].name(language))).collect();
    let accounts = entries.iter().map(|entry| entry.contender.as_ref()?.budget.as_ref());
    let runs: Vec<(&str, &TimeBudget)> =
        names.iter().zip(accounts).filter_map(|(name, account)| Some((name.as_str(), account?))).collect();
    ScrollArea::vertical().id_salt("spent").auto_shrink(false).show(ui, |ui| {
        let size = vec2(ui.available_width() - GRID, time_budget_height(runs.len()));
        let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
        widgets::describe(&response, word!(language, "Where the time went", "Para onde foi o tempo"), || {
            time_budget_words(&runs, language)
        });
        paint(ui.painter(), rect.min, &time_budget_marks(&runs, rect.width(), language), &Inks { look, nodes: &[] });
    });
}

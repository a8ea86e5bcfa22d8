//! Findings of a comparison: timelines, time budgets, growth curves, and why two runs differ.

use egui::{Rect, RichText, ScrollArea, Sense, Ui, UiBuilder, pos2, vec2};

use super::columns::letter;
use super::growth::{self, Measure};
use super::{CompareColumn, lanes};
use crate::gui::session::Growth;
use crate::gui::widgets;
use crate::gui::widgets::explained::{explain_at, explained};
use crate::gui::widgets::paint::{Inks, paint};
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::language::{Language, say, word};
use crate::time::Time;
use crate::view::{
    Definition, NamedBudget, TimeBudget, TimeWindow, compare_runs, count, duration, fraction, time_budget_height,
    time_budget_legend, time_budget_marks, time_budget_words,
};

/// A tab of the findings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Tab {
    /// The timelines on one time axis.
    #[default]
    Lanes,
    /// The time budgets.
    Spent,
    /// Speedup or efficiency over the number of machines.
    Growth(Measure),
}

/// The findings.
#[derive(Default)]
pub struct Findings {
    tab: Tab,
    /// Columns of the two runs whose difference is explained.
    pub pair: [usize; 2],
    /// The stretch of time that the timelines show.
    pub window: TimeWindow,
    /// Shown time of the last frame.
    last_shown: Time,
}

impl Findings {
    /// Whether the growth curves are shown.
    pub fn wants_growth(&self) -> bool {
        matches!(self.tab, Tab::Growth(_))
    }

    /// Returns the height of the findings on a page of this height; it is the same for all tabs.
    pub fn height(page: f32) -> f32 {
        (0.47 * page).clamp(30.0 * GRID, 52.0 * GRID)
    }

    /// Shows the findings. Returns the time to which the user drags in the timelines.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        columns: &mut [CompareColumn],
        growth: Option<&Growth>,
        now: Time,
        length: Time,
        language: Language,
    ) -> Option<Time> {
        let (look, mut sought) = (Look::of(ui.ctx()), None);
        let area = ui.available_rect_before_wrap();
        let table = NAMES_WIDTH_PT + columns.len() as f32 * MIN_FIGURE_WIDTH_PT + GRID;
        // The tabs at the left need their room.
        let most = area.width() - 69.0 * GRID;
        let right = (0.32 * area.width()).clamp(34.0 * GRID, 56.0 * GRID).max(table.min(most));
        let left = area.with_max_x(area.right() - right - 3.0 * GRID);
        let right = area.with_min_x(area.right() - right);
        ui.scope_builder(UiBuilder::new().max_rect(left), |ui| {
            let machines = word!(language, "With one to eight machines", "Com uma a oito máquinas");
            let [speedup, efficiency] = [Definition::SPEEDUP, Definition::EFFICIENCY]
                .map(|measure| format!("{}\n{machines}", measure.text(language)));
            let tabs = [
                (
                    Tab::Lanes,
                    word!(language, "Timelines", "Linhas do tempo"),
                    word!(language, "What each machine did and when", "O que cada máquina fez e quando"),
                ),
                (
                    Tab::Spent,
                    word!(language, "Where the time went", "Para onde foi o tempo"),
                    word!(language, "Work, waiting, messages", "Trabalho, espera, mensagens"),
                ),
                (Tab::Growth(Measure::Speedup), "Speedup", &*speedup),
                (Tab::Growth(Measure::Efficiency), word!(language, "Efficiency", "Eficiência"), &*efficiency),
            ];
            if let Some(tab) = widgets::choice_buttons(ui, self.tab, &tabs) {
                self.tab = tab;
            }
            ui.add_space(GRID);
            match self.tab {
                Tab::Lanes => {
                    // The shown time stays inside a zoomed window.
                    if std::mem::replace(&mut self.last_shown, now) != now {
                        self.window.show(now);
                    }
                    sought = lanes::show(ui, columns, &mut self.window, (now, length), look, language);
                }
                Tab::Spent => where_time_went(ui, columns, look, language),
                Tab::Growth(measure) => growth::show(ui, growth, columns, measure, look, language),
            }
        });
        ui.scope_builder(UiBuilder::new().max_rect(right), |ui| self.why(ui, columns, look, language));
        sought
    }

    /// Explains why the two runs of the pair differ, and shows their figures.
    fn why(&self, ui: &mut Ui, columns: &[CompareColumn], look: Look, language: Language) {
        let run_of = |index: usize| {
            let run = columns.get(index)?.run.as_ref()?;
            Some((letter(index), run))
        };
        let (Some((a, one)), Some((b, other))) = (run_of(self.pair[0]), run_of(self.pair[1])) else { return };
        let heading = say!(language, "{a} and {b}: why they differ", "{a} e {b}: por que diferem");
        ui.label(RichText::new(heading).font(theme::strong(theme::BODY)).color(look.text));
        ui.add_space(GRID / 2.0);
        ScrollArea::vertical().id_salt("why").auto_shrink(false).show(ui, |ui| {
            let names = [one, other].map(|run| run.name(language));
            let text = match (&one.budget, &other.budget) {
                (Some(first), Some(second)) => compare_runs(
                    NamedBudget { name: &names[0], budget: first },
                    NamedBudget { name: &names[1], budget: second },
                    language,
                ),
                _ => {
                    let name = &names[usize::from(one.budget.is_some())];
                    say!(
                        language,
                        "{name} never ends: a stopped machine keeps its atoms.",
                        "{name} nunca termina: uma máquina parada fica com seus átomos."
                    )
                }
            };
            ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(look.text));
            ui.add_space(GRID);
            figures(ui, columns, self.pair, look, language);
        });
    }
}

/// Width of the names of the figures, in points.
const NAMES_WIDTH_PT: f32 = 19.0 * GRID;
/// Least width of a column of figures, in points.
const MIN_FIGURE_WIDTH_PT: f32 = 7.5 * GRID;

/// Shows a table with a row for each figure and a column for each run; those of the pair stand out.
fn figures(ui: &mut Ui, columns: &[CompareColumn], pair: [usize; 2], look: Look, language: Language) {
    /// A figure, and its value.
    type Figure = (Definition, fn(&TimeBudget, Language) -> String);
    let all: [Figure; 7] = [
        (Definition::TIME, |budget, language| duration(budget.makespan, language)),
        (Definition::IDEAL, |budget, language| duration(budget.ideal, language)),
        (Definition::EFFICIENCY, |budget, _| fraction(budget.efficiency())),
        (Definition::MESSAGES_TO_SHARE, |budget, _| count(budget.messages.sharing())),
        (Definition::MESSAGES_WITH_RESULTS, |budget, _| count(budget.messages.results)),
        (Definition::ATOMS_GIVEN_AWAY, |budget, _| count(budget.messages.atoms_moved)),
        (Definition::ALONE, |budget, language| duration(budget.last.alone, language)),
    ];
    let font = theme::regular(theme::SMALL);
    let room = ui.available_width() - GRID - NAMES_WIDTH_PT;
    // A narrow page has room for the pair only.
    let has_all = columns.len() as f32 * MIN_FIGURE_WIDTH_PT <= room + 1.0;
    let shown: Vec<usize> = (0..columns.len()).filter(|index| has_all || pair.contains(index)).collect();
    let wide = (room / shown.len().max(1) as f32).min(11.0 * GRID);
    let budget_of = |&index: &usize| columns[index].run.as_ref()?.budget.as_ref();
    let row = |ui: &mut Ui, name: &str, values: Vec<String>| {
        let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), 18.0), Sense::hover());
        ui.spacing_mut().item_spacing.y = 0.0;
        widgets::describe(&response, name, || values.join("; "));
        let painter = ui.painter();
        painter.text(rect.left_center(), egui::Align2::LEFT_CENTER, name, font.clone(), look.quiet);
        for (place, (index, value)) in shown.iter().zip(&values).rev().enumerate() {
            let at = pos2(rect.right() - GRID - wide * place as f32, rect.center().y);
            let colour = if pair.contains(index) { look.text } else { look.quiet };
            painter.text(at, egui::Align2::RIGHT_CENTER, value, font.clone(), colour);
        }
        response
    };
    row(ui, "", shown.iter().map(|&index| letter(index).to_string()).collect());
    for (figure, value_of) in all {
        let value = |budget: Option<&TimeBudget>| budget.map_or("—".to_owned(), |budget| value_of(budget, language));
        let values = shown.iter().map(budget_of).map(value).collect();
        explained(row(ui, figure.name(language), values), figure, language);
    }
}

/// Shows the time budgets as bars.
fn where_time_went(ui: &mut Ui, columns: &[CompareColumn], look: Look, language: Language) {
    let names: Vec<String> =
        (0..columns.len()).map(|index| format!("{}  {}", letter(index), columns[index].name(language))).collect();
    let budgets = columns.iter().map(|column| column.run.as_ref()?.budget.as_ref());
    let runs: Vec<(&str, &TimeBudget)> =
        names.iter().zip(budgets).filter_map(|(name, budget)| Some((name.as_str(), budget?))).collect();
    ScrollArea::vertical().id_salt("spent").auto_shrink(false).show(ui, |ui| {
        let size = vec2(ui.available_width() - GRID, time_budget_height(runs.len()));
        let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
        widgets::describe(&response, word!(language, "Where the time went", "Para onde foi o tempo"), || {
            time_budget_words(&runs, language)
        });
        paint(ui.painter(), rect.min, &time_budget_marks(&runs, rect.width(), language), &Inks { look, nodes: &[] });
        for (part, [left, top, right, bottom]) in time_budget_legend(&runs, rect.width(), language) {
            let [from, to] = [vec2(left, top), vec2(right, bottom)].map(|by| rect.min + by);
            explain_at(ui, (Rect::from_min_max(from, to), 0), part, language);
        }
        let note = word!(
            language,
            "Shares of the machines' time. Each machine counts alike; in the efficiency a machine counts by its speed.",
            "Partes do tempo das máquinas. Cada uma conta igual; na eficiência, uma máquina conta por sua velocidade."
        );
        ui.label(RichText::new(note).font(theme::regular(theme::SMALL)).color(look.quiet));
    });
}

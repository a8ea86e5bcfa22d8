//! What comes of a comparison: when who did what, where the time went, how strategies grow, and why two runs differ.

use egui::{Rect, RichText, ScrollArea, Sense, Shape, Stroke, Ui, UiBuilder, WidgetInfo, pos2, vec2};

use super::super::paint::{Inks, paint, quads};
use super::super::session::{Grown, Growth};
use super::super::theme::{self, GRID, Look};
use super::super::widgets;
use super::Entry;
use super::columns::letter;
use crate::language::{decimal, say, word};
use crate::palette::{DISTINCT, node_colours};
use crate::study::article_over_ideal;
use crate::time::Time;
use crate::view::{
    Account, Axis, Chart, LanePlan, Named, Series, Sharing, Style, TimeWindow, contrast, count, duration, fraction,
    series_hue, spent, spent_height, spent_words, timeline,
};

/// What is shown of all runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Tab {
    /// A lane a machine, on one axis of time.
    #[default]
    Lanes,
    /// Where the time went.
    Spent,
    /// Speedup by the number of machines.
    Speedup,
    /// Efficiency by the number of machines.
    Efficiency,
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
        matches!(self.tab, Tab::Speedup | Tab::Efficiency)
    }

    /// The height that they want.
    pub fn height(&self) -> f32 {
        if self.wants_growth() { 49.0 * GRID } else { 34.0 * GRID }
    }

    /// Shows them in what room there is. Returns the time that somebody points to with a button down.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        entries: &mut [Entry],
        growth: Option<&Growth>,
        now: Time,
        length: Time,
        look: Look,
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
                    word!("Timelines", "Linhas do tempo"),
                    word!("Who did what and when", "Quem fez o quê e quando"),
                ),
                (
                    Tab::Spent,
                    word!("Where the time went", "Para onde foi o tempo"),
                    word!("Work, waiting, messages", "Trabalho, espera, mensagens"),
                ),
                (Tab::Speedup, "Speedup", word!("With one machine to eight", "Com uma a oito máquinas")),
                (
                    Tab::Efficiency,
                    word!("Efficiency", "Eficiência"),
                    word!("With one machine to eight", "Com uma a oito máquinas"),
                ),
            ];
            if let Some(tab) = widgets::choice(ui, self.tab, &tabs) {
                self.tab = tab;
            }
            ui.add_space(GRID);
            match self.tab {
                Tab::Lanes => sought = lanes(ui, entries, now, length, look),
                Tab::Spent => where_time_went(ui, entries, look),
                Tab::Speedup | Tab::Efficiency => grown(ui, growth, self.tab == Tab::Speedup, look),
            }
        });
        ui.scope_builder(UiBuilder::new().max_rect(right), |ui| self.why(ui, entries, look));
        sought
    }

    /// Why two of them differ, and the figures of both.
    fn why(&self, ui: &mut Ui, entries: &[Entry], look: Look) {
        let known = |place: usize| {
            let contender = entries.get(place)?.contender.as_ref()?;
            Some((letter(place), contender))
        };
        let (Some((a, one)), Some((b, other))) = (known(self.pair[0]), known(self.pair[1])) else { return };
        let heading = say!("{a} and {b}: why they differ", "{a} e {b}: por que diferem");
        ui.label(RichText::new(heading).font(theme::strong(theme::BODY)).color(look.text));
        ui.add_space(GRID / 2.0);
        ScrollArea::vertical().id_salt("why").auto_shrink(false).show(ui, |ui| {
            let text = match (&one.account, &other.account) {
                (Some(first), Some(second)) => {
                    contrast(Named { name: &one.name, account: first }, Named { name: &other.name, account: second })
                }
                _ => {
                    let name = if one.account.is_none() { &one.name } else { &other.name };
                    say!(
                        "{name} never ends: a machine that stands still keeps its atoms.",
                        "{name} nunca termina: uma máquina parada fica com seus átomos."
                    )
                }
            };
            ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(look.text));
            ui.add_space(GRID);
            figures(ui, [(a, one.account.as_ref()), (b, other.account.as_ref())], look);
        });
    }
}

/// A row a figure, a column a run.
fn figures(ui: &mut Ui, runs: [(char, Option<&Account>); 2], look: Look) {
    type Figure = (&'static str, fn(&Account) -> String);
    let all: [Figure; 6] = [
        (word!("time", "tempo"), |account| duration(account.makespan)),
        (word!("shared perfectly", "divisão perfeita"), |account| duration(account.ideal)),
        (word!("efficiency", "eficiência"), |account| fraction(account.efficiency())),
        (word!("messages", "mensagens"), |account| count(account.messages.total as u32)),
        (word!("atoms given away", "átomos cedidos"), |account| count(account.messages.atoms_moved as u32)),
        (word!("alone at the end", "sozinha no fim"), |account| duration(account.last.alone)),
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
    };
    row(ui, "", runs.map(|(letter, _)| letter.to_string()));
    for (name, of) in all {
        row(ui, name, runs.map(|(_, account)| account.map_or("—".to_owned(), of)));
    }
}

/// All lanes of all runs on one axis, along which one can drag.
fn lanes(ui: &mut Ui, entries: &mut [Entry], now: Time, length: Time, look: Look) -> Option<Time> {
    let mut sought = None;
    let area = ui.available_rect_before_wrap();
    let left = 3.0 * GRID;
    let each = (area.height() / entries.len().max(1) as f32).min(14.0 * GRID);
    let mut window = TimeWindow::default();
    window.fit(length);
    for (place, entry) in entries.iter_mut().enumerate() {
        let row =
            Rect::from_min_size(area.left_top() + vec2(0.0, each * place as f32), vec2(area.width(), each - GRID));
        let strip = row.with_min_x(row.left() + left);
        let font = theme::strong(theme::BODY);
        ui.painter().text(row.left_center(), egui::Align2::LEFT_CENTER, letter(place), font, look.text);
        let Some(contender) = &entry.contender else { continue };
        let plan = LanePlan {
            head: 0.0,
            foot: 0.0,
            ..LanePlan::new(contender.lanes.lanes().len(), strip.width(), strip.height())
        };
        let plan = LanePlan { lane: strip.height() / plan.lanes as f32, ..plan };
        let key = (strip.size(), length);
        if entry.lanes.as_ref().is_none_or(|(size, of, _)| (*size, *of) != key) {
            let drawn = timeline(&contender.lanes, &window, &plan, contender.length());
            entry.lanes = Some((key.0, key.1, drawn));
        }
        let Some((.., drawn)) = &entry.lanes else { continue };
        let inks = Inks { look, nodes: &contender.colours };
        ui.painter().add(Shape::mesh(quads(&drawn.quads, strip.min, &inks)));
        // Of many messages one would see only that they are many.
        for (from, to, ink) in &drawn.lines {
            let at = |[x, y]: [f32; 2]| strip.min + vec2(x, y);
            ui.painter().line_segment([at(*from), at(*to)], Stroke::new(1.0, inks.colour(*ink)));
        }
        let response = ui.interact(strip, ui.scope_id().with(("lanes", entry.id)), Sense::click_and_drag());
        if let Some(at) = response.interact_pointer_pos() {
            sought = Some(window.at(f64::from(((at.x - strip.left()) / strip.width()).clamp(0.0, 1.0))));
        }
        let name = &contender.name;
        widgets::describe(&response, name, || {
            contender.account.as_ref().map_or_else(String::new, |account| spent_words(&[(name, account)]))
        });
        if let Some(end) = contender.end() {
            let x = strip.left() + strip.width() * window.share(end) as f32;
            ui.painter().line_segment([pos2(x, strip.top()), pos2(x, strip.bottom())], Stroke::new(1.5, look.text));
        }
    }
    let bottom = area.top() + each * entries.len() as f32 - GRID;
    let x = area.left() + left + (area.width() - left) * window.share(now.min(length)) as f32;
    ui.painter().line_segment([pos2(x, area.top()), pos2(x, bottom)], Stroke::new(1.5, look.accent));
    sought
}

/// Bars of what the machines' time was spent on.
fn where_time_went(ui: &mut Ui, entries: &[Entry], look: Look) {
    let names: Vec<String> =
        (0..entries.len()).map(|place| format!("{}  {}", letter(place), entries[place].name())).collect();
    let accounts = entries.iter().map(|entry| entry.contender.as_ref()?.account.as_ref());
    let runs: Vec<(&str, &Account)> =
        names.iter().zip(accounts).filter_map(|(name, account)| Some((name.as_str(), account?))).collect();
    ScrollArea::vertical().id_salt("spent").auto_shrink(false).show(ui, |ui| {
        let size = vec2(ui.available_width() - GRID, spent_height(runs.len()));
        let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
        widgets::describe(&response, word!("Where the time went", "Para onde foi o tempo"), || spent_words(&runs));
        paint(ui.painter(), rect.min, &spent(&runs, rect.width()), &Inks { look, nodes: &[] });
    });
}

/// Curves over the number of machines, and the article's points.
fn grown(ui: &mut Ui, growth: Option<&Growth>, is_speedup: bool, look: Look) {
    let Some(growth) = growth else {
        let text = word!("Running with one machine to eight …", "Executando com uma a oito máquinas …");
        ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(look.quiet));
        return;
    };
    let chart = chart(growth, is_speedup);
    let rect = ui.available_rect_before_wrap();
    let response = ui.allocate_rect(rect, Sense::hover());
    response.widget_info(|| {
        let line = |series: &Series| {
            let points: Vec<_> = series.points.iter().map(|(x, y)| format!("{x:.0}: {}", decimal(*y, 2))).collect();
            format!("{}: {}", series.name, points.join(", "))
        };
        let lines: Vec<_> = chart.series.iter().map(line).collect();
        WidgetInfo::labeled(egui::Role::Image, true, format!("{}\n{}", chart.y.label, lines.join("\n")))
    });
    let colours = node_colours(DISTINCT);
    paint(ui.painter(), rect.min, &chart.marks(rect.size().into()), &Inks { look, nodes: &colours });
}

fn chart(growth: &Growth, is_speedup: bool) -> Chart {
    let mut series = Vec::new();
    for (i, (strategy, runs)) in growth.of.iter().enumerate() {
        let value = |run: &Grown| if is_speedup { run.speedup } else { run.efficiency };
        let name = Sharing::By(*strategy).name();
        let points = runs.iter().map(|run| (run.machines as f64, value(run))).collect();
        series.push(Series { name: name.to_owned(), hue: series_hue(i), points, style: Style::Line });
        // The article has figures of equal machines, and of four with a slow fifth.
        let article = |run: &Grown| {
            let over = article_over_ideal(*strategy, run.machines, growth.slow.is_some())?;
            let power = run.speedup / run.efficiency;
            Some((run.machines as f64, if is_speedup { power / over } else { 1.0 / over }))
        };
        let points: Vec<_> = runs.iter().filter_map(article).collect();
        if !points.is_empty() {
            series.push(Series { name: String::new(), hue: series_hue(i), points, style: Style::Dots });
        }
    }
    let machines = match growth.slow {
        None => word!("equal machines", "máquinas iguais").to_owned(),
        Some(speed) => {
            let speed = fraction(speed);
            say!("machines, the last of which runs at {speed}", "máquinas, a última a {speed}")
        }
    };
    let y = if is_speedup {
        word!("times as fast as one machine", "vezes mais rápido que uma máquina")
    } else {
        word!("ideal time / time", "tempo ideal / tempo")
    };
    Chart {
        title: String::new(),
        note: word!("Dots without a line: what the article measured", "Pontos sem linha: o que o artigo mediu")
            .to_owned(),
        x: Axis { label: machines, ..Axis::default() },
        y: Axis { label: y.to_owned(), ..Axis::default() },
        series,
    }
}

//! The Accuracy page: a chart of time and error of qualities, pictures beside the reference, and scene statistics.

mod choosing;
mod findings;
mod pictures;

use egui::{Align, Label, Layout, ProgressBar, Rect, RichText, ScrollArea, Sense, Ui, WidgetInfo, vec2};

use crate::gui::session::{Finding, Phase, Session};
use crate::gui::settings::undo::Gesture;
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::paint::{Inks, paint};
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{self, Emphasis, button};
use crate::language::{Language, decimal, say, word};
use crate::view::{measured_lines, needs_lines, needs_warnings, quality_lines, quality_words};
use choosing::ChoiceAction;
use findings::{AccuracyFindings, Choice};
use pictures::PointPictures;

/// The Accuracy page.
#[derive(Default)]
pub struct Accuracy {
    open: bool,
    findings: Option<AccuracyFindings>,
    choice: Option<Choice>,
    pictures: PointPictures,
    /// Whether the page has paused the run.
    holds_run: bool,
}

/// Action of a button of the page.
enum AccuracyAction {
    Close,
    MeasureAgain,
}

impl Accuracy {
    /// Opens or closes the page.
    pub fn toggle(&mut self, session: &mut Session) {
        if self.open { self.close(session) } else { self.open = true }
    }

    /// Whether the page is open.
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// Closes the page and cancels the measurement.
    pub fn close(&mut self, session: &mut Session) {
        self.open = false;
        session.stop_measuring();
        self.resume_run(session);
        self.findings = self.findings.take().filter(|findings| findings.over.is_some());
    }

    /// Takes a part of the results of a job.
    pub fn take(&mut self, job: u64, finding: Finding, session: &mut Session) {
        let Some(findings) = self.findings.as_mut().filter(|findings| findings.job == job) else { return };
        findings.take(finding);
        if findings.over.is_some() {
            self.resume_run(session);
        }
    }

    /// Returns the number of measured points, for tests.
    pub fn points(&self) -> usize {
        self.findings.as_ref().map_or(0, AccuracyFindings::count)
    }

    /// Shows the page.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session) {
        let language = session.language();
        let look = Look::of(ui.ctx());
        let mut action = self.heading(ui, session, look);
        if session.is_recorded() {
            self.cancel(session);
            recorded(ui, session, look);
        } else if self.measure_scene(session) {
            action = self.content(ui, session, look).or(action);
        } else {
            note(ui, word!(language, "Reading and compiling the scene …", "Lendo e compilando a cena …"), look);
        }
        match action {
            Some(AccuracyAction::Close) => self.close(session),
            Some(AccuracyAction::MeasureAgain) => self.cancel(session),
            None => {}
        }
    }

    /// Starts the measurement of the scene, unless its results are there or in progress. Returns whether there is a
    /// scene.
    fn measure_scene(&mut self, session: &mut Session) -> bool {
        let Some(prepared) = session.prepared().cloned() else { return false };
        if self.findings.as_ref().is_none_or(|findings| !findings.are_of(&prepared)) {
            let mut findings = AccuracyFindings::new(&prepared.opened, prepared.size, prepared.quality);
            findings.job = session.measure(&prepared, findings.qualities.clone());
            (self.findings, self.choice) = (Some(findings), None);
            if session.stage().phase == Phase::Running && !session.stage().paused {
                session.set_run_paused(true);
                self.holds_run = true;
            }
        }
        true
    }

    /// Cancels the measurement and drops its results.
    fn cancel(&mut self, session: &mut Session) {
        session.stop_measuring();
        self.findings = None;
        self.resume_run(session);
    }

    /// Resumes the run if the page has paused it.
    fn resume_run(&mut self, session: &mut Session) {
        if std::mem::take(&mut self.holds_run) && session.stage().paused {
            session.set_run_paused(false);
        }
    }

    /// Shows title, progress and the buttons of the page.
    fn heading(&self, ui: &mut Ui, session: &Session, look: Look) -> Option<AccuracyAction> {
        let language = session.language();
        let mut action = None;
        ui.horizontal(|ui| {
            let title = word!(language, "Speed and accuracy", "Velocidade e precisão");
            ui.label(RichText::new(title).font(theme::strong(theme::LARGE)).color(look.text));
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let close = word!(language, "Close accuracy", "Fechar precisão");
                if button(ui, Some(Icon::Close), close, false, Emphasis::Quiet).clicked() {
                    action = Some(AccuracyAction::Close);
                }
                let Some(findings) = self.findings.as_ref().filter(|_| !session.is_recorded()) else { return };
                let failed = matches!(findings.over, Some(Err(_)));
                let again = word!(language, "Try again", "Tentar de novo");
                if failed && button(ui, Some(Icon::Restart), again, true, Emphasis::Primary).clicked() {
                    action = Some(AccuracyAction::MeasureAgain);
                }
                if findings.over.is_none() {
                    let bar = ProgressBar::new(findings.share()).desired_width(20.0 * GRID).desired_height(0.75 * GRID);
                    let bar = ui.add(bar.fill(look.accent));
                    let share = decimal(language, findings.share().into(), 2);
                    bar.widget_info(|| {
                        let name = say!(language, "{share} measured", "{share} medido");
                        WidgetInfo::labeled(egui::Role::ProgressIndicator, true, name)
                    });
                }
                let colour = if failed { look.trouble } else { look.quiet };
                let text = RichText::new(findings.progress(language)).font(theme::regular(theme::BODY)).color(colour);
                ui.add(Label::new(text).truncate());
            });
        });
        action
    }

    fn content(&mut self, ui: &mut Ui, session: &mut Session, look: Look) -> Option<AccuracyAction> {
        let language = session.language();
        const GAP_PT: f32 = 3.0 * GRID;
        let height = ui.available_height();
        let mut action = None;
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            let width = ui.available_width() - 1.5 * GRID;
            let right = (0.4 * width).clamp(36.0 * GRID, 64.0 * GRID);
            ui.horizontal_top(|ui| {
                ui.spacing_mut().item_spacing.x = 0.0;
                ui.vertical(|ui| {
                    ui.set_width(width - right - GAP_PT);
                    ui.spacing_mut().item_spacing.x = GRID;
                    action = self.chart_and_choice(ui, session, height, look);
                });
                ui.add_space(GAP_PT);
                ui.vertical(|ui| {
                    ui.set_width(right);
                    ui.spacing_mut().item_spacing.x = GRID;
                    self.pictures_and_needs(ui, height, look, language);
                });
            });
        });
        action
    }

    /// Shows the chart, and below it the controls of the choice.
    fn chart_and_choice(
        &mut self,
        ui: &mut Ui,
        session: &mut Session,
        height: f32,
        look: Look,
    ) -> Option<AccuracyAction> {
        let language = session.language();
        let findings = self.findings.as_ref()?;
        let choice = self.choice.unwrap_or(Choice::Point(AccuracyFindings::PRESENT));
        let chosen = findings.chosen(choice);
        let size = vec2(ui.available_width(), (height - choosing::HEIGHT_PT).max(45.0 * GRID));
        if let Some(index) = chart(ui, findings, chosen, size, look, language) {
            self.choice = Some(Choice::Point(index));
        }
        match choosing::show(ui, findings, choice, chosen, look, language)? {
            ChoiceAction::Choose(choice) => self.choice = Some(choice),
            ChoiceAction::Take(quality) => {
                session.change(Gesture::Once, |settings| settings.quality = quality);
                return Some(AccuracyAction::Close);
            }
        }
        None
    }

    /// Shows the picture of the chosen point, and the statistics of the scene.
    fn pictures_and_needs(&mut self, ui: &mut Ui, height: f32, look: Look, language: Language) {
        let Some(findings) = &self.findings else { return };
        let chosen = findings.chosen(self.choice.unwrap_or(Choice::Point(AccuracyFindings::PRESENT)));
        if let (Some(index), Some(reference)) = (chosen, &findings.reference)
            && let Some(frame) = findings.frames.get(index)
        {
            self.pictures.show(ui, (findings.job, index), frame, &reference.picture, 0.66 * height, language);
            ui.add_space(GRID);
        }
        needs(ui, findings, look, language);
    }
}

/// Shows the chart. Returns the index of the clicked point.
fn chart(
    ui: &mut Ui,
    findings: &AccuracyFindings,
    chosen: Option<usize>,
    size: egui::Vec2,
    look: Look,
    language: Language,
) -> Option<usize> {
    let name = word!(language, "Chart of time and error", "Gráfico de tempo e erro");
    /// Side of the square round a point that reacts to the pointer, in points.
    const TARGET_SIDE_PT: f32 = 2.0 * GRID;
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    if findings.count() == 0 {
        let text = word!(
            language,
            "First the reference is traced, a picture with a very small error. Then points appear here, one for \
        each quality. A point to the left is faster, a lower point is better. The run is paused meanwhile, so \
        that it does not disturb the measurement.",
            "Primeiro é calculada a referência, uma imagem com erro muito pequeno. Depois aparecem aqui pontos, um \
        para cada qualidade. Um ponto à esquerda é mais rápido, um ponto mais baixo é melhor. A execução fica \
        pausada para não atrapalhar a medição."
        );
        let galley =
            ui.painter().layout(text.into(), theme::regular(theme::BODY), look.quiet, (0.7 * size.x).min(60.0 * GRID));
        let corner = rect.center() - galley.size() / 2.0;
        ui.painter().galley(corner, galley, look.quiet);
        widgets::describe(&response, name, || text.into());
        return None;
    }
    widgets::describe(&response, name, || findings.progress(language));
    let drawn = findings.tradeoff(chosen, language).drawn(rect.size().into(), language);
    paint(&ui.painter_at(rect), rect.min, &drawn.marks, &Inks { look, nodes: &[] });
    let mut clicked = None;
    for (index, at) in drawn.places.iter().enumerate() {
        let Some(point) = findings.point(index) else { continue };
        let target = Rect::from_center_size(rect.min + vec2(at[0], at[1]), vec2(TARGET_SIDE_PT, TARGET_SIDE_PT));
        let response = ui.interact(target, ui.scope_id().with(("point", index)), Sense::click());
        let number = index + 1;
        response.widget_info(|| {
            let name = say!(language, "Point {number}", "Ponto {number}");
            let mut info = WidgetInfo::selected(egui::Role::Button, true, chosen == Some(index), name);
            info.current_text_value = Some(quality_words(&point.quality, language));
            info
        });
        if response.hovered() || response.has_focus() {
            ui.painter().circle_stroke(target.center(), 0.6 * TARGET_SIDE_PT, egui::Stroke::new(1.5, look.text));
        }
        if response.clicked() {
            clicked = Some(index);
        }
        response.on_hover_ui(|ui| {
            let is_set = index == AccuracyFindings::PRESENT;
            let title = if is_set {
                word!(language, "The present quality", "A qualidade atual")
            } else {
                word!(language, "A quality", "Uma qualidade")
            };
            let mut lines = quality_lines(&point.quality, language);
            let measured = findings.frames[index].size();
            lines.extend(measured_lines(findings.time(index), findings.whole, &point.difference, measured, language));
            widgets::tooltip_table(ui, title, &lines, look);
        });
    }
    clicked
}

/// Shows the statistics of the scene.
fn needs(ui: &mut Ui, findings: &AccuracyFindings, look: Look, language: Language) {
    const NAME_WIDTH_PT: f32 = 12.0 * GRID;
    let Some((compiled, levels)) = &findings.needs else { return };
    let title = word!(language, "What this scene needs", "O que esta cena pede");
    ui.label(RichText::new(title).font(theme::strong(theme::BODY)).color(look.text));
    let small = |text: &str, colour| RichText::new(text).font(theme::regular(theme::SMALL)).color(colour);
    ui.spacing_mut().item_spacing.y = 0.5 * GRID;
    for (name, text) in needs_lines(compiled, levels, language) {
        let galley =
            |text: String, colour, width| ui.painter().layout(text, theme::regular(theme::SMALL), colour, width);
        let text = galley(text, look.text, ui.available_width() - NAME_WIDTH_PT);
        let name = galley(name.to_owned(), look.quiet, NAME_WIDTH_PT);
        let size = vec2(ui.available_width(), text.size().y);
        let description = format!("{}: {}", name.text(), text.text());
        let (line, response) = ui.allocate_exact_size(size, Sense::hover());
        response.widget_info(|| WidgetInfo::labeled(egui::Role::Label, true, &description));
        ui.painter().galley(line.min, name, look.quiet);
        ui.painter().galley(line.min + vec2(NAME_WIDTH_PT, 0.0), text, look.text);
    }
    for warning in needs_warnings(compiled, language) {
        ui.add(Label::new(small(&warning, look.trouble)).wrap());
    }
}

/// Shows the page for a recorded run, which cannot be measured.
fn recorded(ui: &mut Ui, session: &mut Session, look: Look) {
    let language = session.language();
    let text = word!(
        language,
        "This is a recorded run. Make it live to measure its scene and to try other settings.",
        "Esta é uma execução gravada. Execute-a ao vivo para medir sua cena e testar outros ajustes."
    );
    note(ui, text, look);
    if button(ui, None, word!(language, "Make it live", "Executar ao vivo"), true, Emphasis::Primary).clicked() {
        session.make_live();
    }
}

fn note(ui: &mut Ui, text: &str, look: Look) {
    ui.add_space(2.0 * GRID);
    ui.add(Label::new(RichText::new(text).font(theme::regular(theme::BODY)).color(look.quiet)).wrap());
}

//! Speed against accuracy of the scene at hand: a chart to choose from, pictures, and what the scene needs.

mod choosing;
mod findings;
mod pictures;

use egui::{Align, Label, Layout, ProgressBar, Rect, RichText, ScrollArea, Sense, Ui, WidgetInfo, vec2};

use crate::gui::session::{Finding, Phase, Session};
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::paint::{Inks, paint};
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{self, Emphasis, button};
use crate::language::{Language, decimal, say, word};
use crate::view::{measured_lines, needs_lines, needs_warnings, quality_lines, quality_words};
use choosing::QualityChoice;
use findings::{AccuracyFindings, Choice};
use pictures::PointPictures;

/// The page.
#[derive(Default)]
pub struct Accuracy {
    open: bool,
    findings: Option<AccuracyFindings>,
    choice: Option<Choice>,
    pictures: PointPictures,
    /// Whether the run stands still because of this.
    holds_run: bool,
}

/// What is to be done with the page.
enum AccuracyAction {
    Close,
    Again,
}

impl Accuracy {
    /// Opens the page, or closes it.
    pub fn toggle(&mut self, session: &mut Session) {
        if self.open { self.close(session) } else { self.open = true }
    }

    /// Whether the page is to be shown.
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// Closes it; what is being measured is given up.
    pub fn close(&mut self, session: &mut Session) {
        self.open = false;
        session.stop_measuring();
        self.let_run_go_on(session);
        self.findings = self.findings.take().filter(|findings| findings.over.is_some());
    }

    /// Takes in what a job has found out.
    pub fn take(&mut self, job: u64, finding: Finding, session: &mut Session) {
        let Some(findings) = self.findings.as_mut().filter(|findings| findings.job == job) else { return };
        findings.take(finding);
        if findings.over.is_some() {
            self.let_run_go_on(session);
        }
    }

    /// How many points are measured, for tests.
    pub fn points(&self) -> usize {
        self.findings.as_ref().map_or(0, AccuracyFindings::count)
    }

    /// Shows the page.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session) {
        let language = session.language();
        let look = Look::of(ui.ctx());
        let mut asked = self.heading(ui, session, look);
        if session.is_recorded() {
            self.give_up(session);
            recorded(ui, session, look);
        } else if self.keep_up(session) {
            asked = self.content(ui, session, look).or(asked);
        } else {
            note(
                ui,
                word!(language, "The scene is being read and compiled …", "A cena está sendo lida e compilada …"),
                look,
            );
        }
        match asked {
            Some(AccuracyAction::Close) => self.close(session),
            Some(AccuracyAction::Again) => self.give_up(session),
            None => {}
        }
    }

    /// Measures the scene at hand, unless that is what goes on. Returns whether there is a scene.
    fn keep_up(&mut self, session: &mut Session) -> bool {
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

    fn give_up(&mut self, session: &mut Session) {
        session.stop_measuring();
        self.findings = None;
        self.let_run_go_on(session);
    }

    fn let_run_go_on(&mut self, session: &mut Session) {
        if std::mem::take(&mut self.holds_run) && session.stage().paused {
            session.set_run_paused(false);
        }
    }

    /// What the page is about, how far it is, and the way out.
    fn heading(&self, ui: &mut Ui, session: &Session, look: Look) -> Option<AccuracyAction> {
        let language = session.language();
        let mut asked = None;
        ui.horizontal(|ui| {
            let title = word!(language, "Speed against accuracy", "Velocidade e precisão");
            ui.label(RichText::new(title).font(theme::strong(theme::LARGE)).color(look.text));
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let close = word!(language, "Close accuracy", "Fechar precisão");
                if button(ui, Some(Icon::Close), close, false, Emphasis::Quiet).clicked() {
                    asked = Some(AccuracyAction::Close);
                }
                let Some(findings) = self.findings.as_ref().filter(|_| !session.is_recorded()) else { return };
                let failed = matches!(findings.over, Some(Err(_)));
                let again = word!(language, "Try again", "Tentar de novo");
                if failed && button(ui, Some(Icon::Restart), again, true, Emphasis::Primary).clicked() {
                    asked = Some(AccuracyAction::Again);
                }
                if findings.over.is_none() {
                    let bar = ProgressBar::new(findings.share()).desired_width(20.0 * GRID).desired_height(0.75 * GRID);
                    let bar = ui.add(bar.fill(look.accent));
                    let share = decimal(language, findings.share().into(), 2);
                    bar.widget_info(|| {
                        let words = say!(language, "{share} measured", "{share} medido");
                        WidgetInfo::labeled(egui::Role::ProgressIndicator, true, words)
                    });
                }
                let colour = if failed { look.trouble } else { look.quiet };
                let text = RichText::new(findings.progress(language)).font(theme::regular(theme::BODY)).color(colour);
                ui.add(Label::new(text).truncate());
            });
        });
        asked
    }

    fn content(&mut self, ui: &mut Ui, session: &mut Session, look: Look) -> Option<AccuracyAction> {
        let language = session.language();
        const GAP: f32 = 3.0 * GRID;
        let height = ui.available_height();
        let mut asked = None;
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            let width = ui.available_width() - 1.5 * GRID;
            let right = (0.4 * width).clamp(36.0 * GRID, 64.0 * GRID);
            ui.horizontal_top(|ui| {
                ui.spacing_mut().item_spacing.x = 0.0;
                ui.vertical(|ui| {
                    ui.set_width(width - right - GAP);
                    ui.spacing_mut().item_spacing.x = GRID;
                    asked = self.choosing(ui, session, height, look);
                });
                ui.add_space(GAP);
                ui.vertical(|ui| {
                    ui.set_width(right);
                    ui.spacing_mut().item_spacing.x = GRID;
                    self.looking(ui, height, look, language);
                });
            });
        });
        asked
    }

    /// The chart, and below it how to choose.
    fn choosing(&mut self, ui: &mut Ui, session: &mut Session, height: f32, look: Look) -> Option<AccuracyAction> {
        let language = session.language();
        let findings = self.findings.as_ref()?;
        let choice = self.choice.unwrap_or(Choice::Place(AccuracyFindings::PRESENT));
        let chosen = findings.chosen(choice);
        let size = vec2(ui.available_width(), (height - choosing::HEIGHT).max(45.0 * GRID));
        if let Some(place) = chart(ui, findings, chosen, size, look, language) {
            self.choice = Some(Choice::Place(place));
        }
        match choosing::show(ui, findings, choice, chosen, look, language)? {
            QualityChoice::Choice(choice) => self.choice = Some(choice),
            QualityChoice::Take(quality) => {
                session.change(crate::gui::settings::undo::Gesture::Once, |settings| settings.quality = quality);
                return Some(AccuracyAction::Close);
            }
        }
        None
    }

    /// The picture of what is chosen, and what the scene needs.
    fn looking(&mut self, ui: &mut Ui, height: f32, look: Look, language: Language) {
        let Some(findings) = &self.findings else { return };
        let chosen = findings.chosen(self.choice.unwrap_or(Choice::Place(AccuracyFindings::PRESENT)));
        if let (Some(place), Some(reference)) = (chosen, &findings.reference)
            && let Some(frame) = findings.frames.get(place)
        {
            self.pictures.show(ui, (findings.job, place), frame, &reference.picture, 0.66 * height, language);
            ui.add_space(GRID);
        }
        needs(ui, findings, look, language);
    }
}

/// The chart; returns the place of the point that was clicked.
fn chart(
    ui: &mut Ui,
    findings: &AccuracyFindings,
    chosen: Option<usize>,
    size: egui::Vec2,
    look: Look,
    language: Language,
) -> Option<usize> {
    let name = word!(language, "Chart of time and error", "Gráfico de tempo e erro");
    /// Whoever points so near to a point means it.
    const NEAR: f32 = 2.0 * GRID;
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    if findings.count() == 0 {
        let words = word!(
            language,
            "First a picture is traced that is as good as true. Then points appear here, one for each quality: \
             the farther to the left the faster, the lower the better. The run stands still meanwhile, since one \
             would disturb the other.",
            "Primeiro se calcula uma imagem praticamente exata. Depois aparecem aqui pontos, um para cada qualidade: \
             quanto mais à esquerda, mais rápida; quanto mais embaixo, melhor. A execução fica parada enquanto isso, \
             pois uma atrapalharia a outra."
        );
        let galley =
            ui.painter().layout(words.into(), theme::regular(theme::BODY), look.quiet, (0.7 * size.x).min(60.0 * GRID));
        let corner = rect.center() - galley.size() / 2.0;
        ui.painter().galley(corner, galley, look.quiet);
        widgets::describe(&response, name, || words.into());
        return None;
    }
    widgets::describe(&response, name, || findings.progress(language));
    let drawn = findings.tradeoff(chosen, language).drawn(rect.size().into(), language);
    paint(&ui.painter_at(rect), rect.min, &drawn.marks, &Inks { look, nodes: &[] });
    let mut clicked = None;
    for (place, at) in drawn.places.iter().enumerate() {
        let Some(point) = findings.point(place) else { continue };
        let near = Rect::from_center_size(rect.min + vec2(at[0], at[1]), vec2(NEAR, NEAR));
        let response = ui.interact(near, ui.scope_id().with(("point", place)), Sense::click());
        let which = place + 1;
        response.widget_info(|| {
            let name = say!(language, "Point {which}", "Ponto {which}");
            let mut info = WidgetInfo::selected(egui::Role::Button, true, chosen == Some(place), name);
            info.current_text_value = Some(quality_words(&point.quality, language));
            info
        });
        if response.hovered() || response.has_focus() {
            ui.painter().circle_stroke(near.center(), 0.6 * NEAR, egui::Stroke::new(1.5, look.text));
        }
        if response.clicked() {
            clicked = Some(place);
        }
        response.on_hover_ui(|ui| {
            let is_set = place == AccuracyFindings::PRESENT;
            let title = if is_set {
                word!(language, "What is set now", "O ajuste atual")
            } else {
                word!(language, "A quality", "Uma qualidade")
            };
            let mut lines = quality_lines(&point.quality, language);
            let measured = findings.frames[place].size();
            lines.extend(measured_lines(findings.time(place), findings.whole, &point.difference, measured, language));
            widgets::more_words(ui, title, &lines, look);
        });
    }
    clicked
}

/// A quiet column: what the scene at hand needs.
fn needs(ui: &mut Ui, findings: &AccuracyFindings, look: Look, language: Language) {
    const WHAT: f32 = 12.0 * GRID;
    let Some((compiled, levels)) = &findings.needs else { return };
    let title = word!(language, "What this scene needs", "O que esta cena pede");
    ui.label(RichText::new(title).font(theme::strong(theme::BODY)).color(look.text));
    let small = |text: &str, colour| RichText::new(text).font(theme::regular(theme::SMALL)).color(colour);
    ui.spacing_mut().item_spacing.y = 0.5 * GRID;
    for (what, words) in needs_lines(compiled, levels, language) {
        let galley =
            |text: String, colour, width| ui.painter().layout(text, theme::regular(theme::SMALL), colour, width);
        let words = galley(words, look.text, ui.available_width() - WHAT);
        let what = galley(what.to_owned(), look.quiet, WHAT);
        let size = vec2(ui.available_width(), words.size().y);
        let said = format!("{}: {}", what.text(), words.text());
        let (line, response) = ui.allocate_exact_size(size, Sense::hover());
        response.widget_info(|| WidgetInfo::labeled(egui::Role::Label, true, &said));
        ui.painter().galley(line.min, what, look.quiet);
        ui.painter().galley(line.min + vec2(WHAT, 0.0), words, look.text);
    }
    for warning in needs_warnings(compiled, language) {
        ui.add(Label::new(small(&warning, look.trouble)).wrap());
    }
}

/// Of a recorded run nothing is measured.
fn recorded(ui: &mut Ui, session: &mut Session, look: Look) {
    let language = session.language();
    let text = word!(
        language,
        "This is a recorded run. Made live, its scene can be measured, and other settings tried.",
        "Esta é uma execução gravada. Ao vivo, sua cena pode ser medida, e outros ajustes, testados."
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

//! What happens in sentences, what came of it in figures, and who has done how much in a bar.

use egui::text::{LayoutJob, TextFormat, TextWrapping};
use egui::{Align2, CornerRadius, FontId, Label, Rect, RichText, Sense, Ui, UiBuilder, pos2, vec2};

use crate::gui::session::{Phase, Session};
use crate::gui::widgets;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::language::{Language, say, word};
use crate::palette::text_on;
use crate::time::Time;
use crate::view::{
    Details, Happening, NodeShare, node_name, node_shares, percent, record_words, result_words, seconds_words,
    summary_figures, unfinished_words, work_split_words,
};

const SENTENCE: f32 = 3.25 * GRID;
const EVENT: f32 = 2.25 * GRID;
const BAR: f32 = 3.0 * GRID;

/// How high the panel is to be, so that it does not change while one watches.
pub fn height(ui: &Ui) -> f32 {
    SENTENCE + events_shown(ui) as f32 * EVENT + 1.5 * GRID + BAR
}

/// Shows all three.
pub fn show(ui: &mut Ui, session: &Session, about: Option<&Details>) {
    let language = session.language();
    let look = Look::of(ui.ctx());
    let (whole, _) = ui.allocate_exact_size(vec2(ui.available_width(), height(ui)), Sense::hover());
    let (above, below) = whole.split_top_bottom_at_y(whole.bottom() - BAR);
    let words = &mut ui.new_child(UiBuilder::new().max_rect(above.with_max_y(above.bottom() - GRID)));
    words.spacing_mut().item_spacing.y = 0.0;
    words.shrink_clip_rect(above);
    match about {
        Some(about) => {
            // The run is told of above, where there is room for both.
            if events_shown(words) > 0 {
                sentence(words, session, look);
            }
            selected(words, session, about, look);
        }
        None if session.stage().result().is_some() => result(words, session, look),
        None => {
            sentence(words, session, look);
            let stage = session.stage();
            let earlier = stage.narrator().earlier(stage.state(), session.now());
            events(words, earlier.rev().take(events_shown(words)), look, language);
        }
    }
    bar(ui, below, session, look);
}

fn events_shown(ui: &Ui) -> usize {
    match ui.ctx().content_rect().height() {
        // In a room nothing else tells of what is selected.
        height if height < 560.0 => usize::from(Look::is_strong(ui.ctx())),
        height if height < 700.0 => 1,
        height if height < 950.0 => 2,
        _ => 4,
    }
}

/// What is selected, in the place of earlier events: whoever clicks wants to know.
fn selected(ui: &mut Ui, session: &Session, about: &Details, look: Look) {
    let language = session.language();
    let stage = session.stage();
    let (title, more) = about.words(stage.state(), stage.now(), stage.grain(), language);
    let area = ui.available_rect_before_wrap();
    let response = ui.interact(area, ui.scope_id().with("selected"), Sense::hover());
    widgets::describe(&response, word!(language, "Selected", "Selecionado"), || format!("{title}. {more}"));
    let layout = |more: &str| {
        let mut job = LayoutJob::default();
        job.wrap.max_width = area.width();
        job.append(&title, 0.0, TextFormat::simple(theme::strong(theme::SMALL), look.text));
        job.append(more, 0.0, TextFormat::simple(theme::regular(theme::SMALL), look.quiet));
        ui.painter().layout_job(job)
    };
    // As much as there is room for.
    let more = format!(" · {more}");
    let ends = more.match_indices(" · ").map(|(end, _)| end).chain([more.len()]);
    let fits = ends.map(|end| layout(&more[..end])).take_while(|galley| galley.size().y <= area.height());
    if let Some(galley) = fits.last() {
        ui.painter().galley(area.min, galley, look.text);
    }
}

/// The sentence of the moment.
fn sentence(ui: &mut Ui, session: &Session, look: Look) {
    let language = session.language();
    let stage = session.stage();
    let sentence = match &stage.phase {
        Phase::Preparing => word!(
            language,
            "Reading the scene, compiling it, and looking what it will cost …",
            "Lendo a cena, compilando-a e vendo quanto vai custar …"
        )
        .to_owned(),
        Phase::Failed(why) => say!(language, "The run cannot go on: {why}", "A execução não pode continuar: {why}"),
        Phase::Finished if stage.shows_end() && stage.state().finished().is_none() => {
            unfinished_words(stage.state(), language)
        }
        _ => match stage.stepped_to() {
            Some(record) => record_words(record, stage.state(), language),
            None => stage.narrator().sentence(stage.state(), session.now(), language),
        },
    };
    // Rather small than cut.
    let width = |size: f32| ui.painter().layout_no_wrap(sentence.clone(), theme::strong(size), look.text).size().x;
    let size = [20.0, 18.0, theme::BODY].into_iter().find(|&size| width(size) <= ui.available_width());
    let text = RichText::new(&sentence).font(theme::strong(size.unwrap_or(theme::SMALL))).color(look.text);
    ui.allocate_ui(vec2(ui.available_width(), SENTENCE), |ui| {
        ui.set_min_height(SENTENCE);
        ui.add(Label::new(text).wrap());
    });
}

/// Events and their times, a line each.
fn events<'a>(ui: &mut Ui, events: impl Iterator<Item = (Time, &'a Happening)>, look: Look, language: Language) {
    let font = theme::regular(theme::SMALL);
    for (at, event) in events {
        let (line, response) = ui.allocate_exact_size(vec2(ui.available_width(), EVENT), Sense::hover());
        widgets::describe(&response, word!(language, "Event", "Evento"), || event.sentence(language));
        let y = line.center().y;
        let time = seconds_words(at.secs(), language);
        ui.painter().text(pos2(line.left() + 5.0 * GRID, y), Align2::RIGHT_CENTER, time, font.clone(), look.quiet);
        let galley = one_line(ui, &event.sentence(language), &font, look, line.width() - 6.0 * GRID);
        ui.painter().galley(pos2(line.left() + 6.0 * GRID, y - galley.size().y / 2.0), galley, look.quiet);
    }
}

/// What the run amounts to: large, and in words.
fn result(ui: &mut Ui, session: &Session, look: Look) {
    let language = session.language();
    let stage = session.stage();
    let Some(result) = stage.result() else { return };
    let area = ui.available_rect_before_wrap();
    let response = ui.interact(area, ui.scope_id().with("result"), Sense::hover());
    widgets::describe(&response, word!(language, "Result", "Resultado"), || {
        result_words(stage.state(), result, language)
    });
    // Where there is no room below a figure, what it means stands beside it.
    let is_high = area.height() > 5.5 * GRID;
    let value = theme::strong(if is_high { theme::LARGE } else { 20.0 });
    let mut x = area.left();
    for (figure, means) in summary_figures(result, language) {
        let figure = ui.painter().layout_no_wrap(figure, value.clone(), look.text);
        let means = ui.painter().layout_no_wrap(means.to_owned(), theme::regular(theme::SMALL), look.quiet);
        let (figure_size, means_size) = (figure.size(), means.size());
        let below = pos2(x, area.top() + 3.25 * GRID);
        let beside = pos2(x + figure_size.x + 0.75 * GRID, area.top() + figure_size.y - means_size.y - 2.0);
        ui.painter().galley(pos2(x, area.top() - if is_high { 0.5 * GRID } else { 0.0 }), figure, look.text);
        ui.painter().galley(if is_high { below } else { beside }, means, look.quiet);
        x = if is_high { x + figure_size.x.max(means_size.x) } else { beside.x + means_size.x } + 3.0 * GRID;
    }
    let place = Rect::from_min_max(pos2(x + GRID, area.top()), area.max);
    // Where there is more room than the figures need, the last events still stand there.
    let rest = area.with_min_y(area.top() + 7.0 * GRID);
    let lines = (rest.height().max(0.0) / EVENT) as usize;
    ui.scope_builder(UiBuilder::new().max_rect(rest), |ui| {
        events(ui, stage.narrator().events().rev().take(lines), look, language);
    });
    let parts = work_split_words(stage.state(), language).unwrap_or_default();
    let height =
        |size: f32| ui.painter().layout(parts.clone(), theme::regular(size), look.text, place.width()).size().y;
    // Rather not at all than cut: the bar below tells it too.
    let fits = [theme::BODY, theme::SMALL].into_iter().find(|&size| height(size) <= place.height());
    if let Some(size) = fits.filter(|_| place.width() > 12.0 * GRID) {
        ui.scope_builder(UiBuilder::new().max_rect(place), |ui| {
            ui.add(Label::new(RichText::new(&parts).font(theme::regular(size)).color(look.text)).wrap());
        });
    }
}

fn one_line(ui: &Ui, text: &str, font: &FontId, look: Look, width: f32) -> std::sync::Arc<egui::Galley> {
    let mut job = LayoutJob::simple_singleline(text.to_owned(), font.clone(), look.quiet);
    job.wrap = TextWrapping::truncate_at_width(width);
    ui.painter().layout_job(job)
}

/// All atoms in one row: each node's part in its colour, what is still to be done empty.
fn bar(ui: &Ui, rect: Rect, session: &Session, look: Look) {
    let language = session.language();
    let response = ui.interact(rect, ui.scope_id().with("bar"), Sense::hover());
    let state = session.stage().state();
    let (shares, all) = (node_shares(state), state.atoms());
    widgets::describe(&response, word!(language, "Who has traced how much", "Quem calculou quanto"), || {
        let say = |share: &NodeShare| format!("{} {}", node_name(share.node), percent(share.atoms, all));
        shares.iter().map(say).collect::<Vec<_>>().join(", ")
    });
    ui.painter().rect_filled(rect, 4.0, look.raised);
    let end = shares.last().map_or(0.0, |share| share.end);
    if rect.width() * (1.0 - end) > 26.0 * GRID {
        let (at, font) = (pos2(rect.right() - GRID, rect.center().y), theme::regular(theme::SMALL));
        let words = word!(language, "who has traced how much", "quem calculou quanto");
        ui.painter().text(at, Align2::RIGHT_CENTER, words, font, look.quiet);
    }
    let last = shares.iter().rposition(|share| share.end > share.start);
    for (i, share) in shares.iter().enumerate() {
        let part = Rect::from_x_y_ranges(
            rect.left() + rect.width() * share.start..=rect.left() + rect.width() * share.end,
            rect.y_range(),
        );
        let mut corners = CornerRadius::ZERO;
        if share.start == 0.0 {
            (corners.nw, corners.sw) = (4, 4);
        }
        if Some(i) == last && share.end > 0.999 {
            (corners.ne, corners.se) = (4, 4);
        }
        let own = session.stage().colours[i];
        ui.painter().rect_filled(part, corners, theme::colour(own));
        let ink = theme::colour(text_on(own));
        if part.width() > 72.0 {
            let number = node_name(share.node).to_string();
            let left = pos2(part.left() + GRID, part.center().y);
            ui.painter().text(left, Align2::LEFT_CENTER, number, theme::strong(theme::BODY), ink);
            let right = pos2(part.right() - GRID, part.center().y);
            let text = percent(share.atoms, all);
            ui.painter().text(right, Align2::RIGHT_CENTER, text, theme::regular(theme::BODY), ink);
        } else if part.width() > 20.0 {
            let number = node_name(share.node).to_string();
            ui.painter().text(part.center(), Align2::CENTER_CENTER, number, theme::strong(theme::BODY), ink);
        }
    }
}

//! Narration of the run: sentences or the result, and the bar of the machines' shares.

use egui::text::{LayoutJob, TextFormat, TextWrapping};
use egui::{Align2, Color32, CornerRadius, FontId, Label, Rect, RichText, Sense, Ui, UiBuilder, pos2, vec2};

use crate::balance::{Scheduler, Strategy};
use crate::gui::input::keys::UserCommand;
use crate::gui::session::{Phase, Session, Stage};
use crate::gui::widgets::explained::{explain_at, explained};
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{self, Emphasis, button, hint_above};
use crate::language::{Language, say, word};
use crate::palette::text_on;
use crate::runlog::Driver;
use crate::time::Time;
use crate::view::{
    Definition, Details, Happening, NodeShare, before_virtual_time, disturbance_words, node_name, node_shares, percent,
    record_words, result_words, summary_figures, time_words, unfinished_words, work_split_words,
};

/// Height of the sentence, in points.
const SENTENCE_HEIGHT_PT: f32 = 3.25 * GRID;
/// Height of a warning with its button, in points.
const WARNING_HEIGHT_PT: f32 = 4.25 * GRID;
const EVENT_HEIGHT_PT: f32 = 2.25 * GRID;
const BAR_HEIGHT_PT: f32 = 3.0 * GRID;

/// Returns the height of the panel. Without a notice it depends on the window only, so it does not change during a run.
/// A notice of this height takes the place of earlier events.
pub fn height(ui: &Ui, notice: f32) -> f32 {
    let events = events_shown(ui) as f32 * EVENT_HEIGHT_PT;
    SENTENCE_HEIGHT_PT + events.max(notice) + 1.5 * GRID + BAR_HEIGHT_PT
}

/// Shows the details of the selected subject, else the result of a finished run, else sentences; and below the bar.
/// Returns the place of a notice of this height, between the sentences and the bar, and the command of the pressed
/// button.
pub fn show(ui: &mut Ui, session: &Session, details: Option<&Details>, notice: f32) -> (Rect, Option<UserCommand>) {
    let language = session.language();
    let look = Look::of(ui.ctx());
    let (whole, _) = ui.allocate_exact_size(vec2(ui.available_width(), height(ui, notice)), Sense::hover());
    let (above, below) = whole.split_top_bottom_at_y(whole.bottom() - BAR_HEIGHT_PT);
    let (above, place) = above.split_top_bottom_at_y(above.bottom() - GRID - notice);
    let upper = &mut ui.new_child(UiBuilder::new().max_rect(above));
    let lines = ((above.height() - SENTENCE_HEIGHT_PT).max(0.0) / EVENT_HEIGHT_PT) as usize;
    upper.spacing_mut().item_spacing.y = 0.0;
    upper.shrink_clip_rect(above.with_max_y(above.bottom() + if notice > 0.0 { GRID / 2.0 } else { GRID }));
    let mut pressed = None;
    match details {
        Some(details) => {
            // Where there is room for both, the result or the sentence of the moment stays.
            if lines > 0 && session.stage().result().is_some() {
                let (result_area, _) =
                    upper.allocate_exact_size(vec2(above.width(), SENTENCE_HEIGHT_PT), Sense::hover());
                // A child of its own leaves the room below to the details.
                result(&mut upper.new_child(UiBuilder::new().max_rect(result_area)), session, look);
            } else if lines > 0 {
                pressed = sentence(upper, session, look);
            }
            selected(upper, session, details, look);
        }
        None if session.stage().result().is_some() => result(upper, session, look),
        None => {
            pressed = sentence(upper, session, look);
            let stage = session.stage();
            let (narrator, now) = (stage.narrator(), session.now());
            // A warning takes the room of one.
            let lines = lines.saturating_sub(usize::from(session.recovering_scheduler().is_some()));
            let told = usize::from(narrator.event_time(stage.state(), now).is_some());
            let more = narrator.events_so_far().saturating_sub(told + lines);
            let others = narrator.other_events(stage.state(), now).rev().take(lines);
            events(upper, others, more, stage, look, language);
        }
    }
    bar(ui, below, session, look);
    (place.with_max_y(place.bottom() - GRID), pressed)
}

/// Returns how many earlier events have room below the sentence.
fn events_shown(ui: &Ui) -> usize {
    match ui.ctx().content_rect().height() {
        // In presentation mode the details of the selection need this line.
        height if height < 560.0 => usize::from(Look::is_strong(ui.ctx())),
        height if height < 700.0 => 1,
        height if height < 950.0 => 2,
        _ => 4,
    }
}

/// Shows the details of the selected subject in place of earlier events.
fn selected(ui: &mut Ui, session: &Session, details: &Details, look: Look) {
    let language = session.language();
    let stage = session.stage();
    let (title, more) = details.words(stage.state(), stage.now(), stage.playback_scale(), language);
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
    // As many parts as fit.
    let more = format!(" · {more}");
    let ends = more.match_indices(" · ").map(|(end, _)| end).chain([more.len()]);
    let fits = ends.map(|end| layout(&more[..end])).take_while(|galley| galley.size().y <= area.height());
    if let Some(galley) = fits.last() {
        ui.painter().galley(area.min, galley, look.text);
    }
}

/// Returns the width of the column of times, in points.
fn time_width(ui: &Ui, stage: &Stage, language: Language) -> f32 {
    let longest = time_words(stage.length().max(Time::from_secs(10.0)), stage.playback_scale(), language);
    let width = ui.painter().layout_no_wrap(longest, theme::regular(theme::SMALL), Color32::PLACEHOLDER).size().x;
    width.ceil().max(5.0 * GRID)
}

/// Shows the sentence of the moment, after the time of its event. If the run hangs for ever, it is a warning with a
/// button. Returns the command of the pressed button.
fn sentence(ui: &mut Ui, session: &Session, look: Look) -> Option<UserCommand> {
    let language = session.language();
    let stage = session.stage();
    let sentence = match &stage.phase {
        Phase::Preparing if session.loading().is_some_and(|loading| loading.traced.share > 0.0) => word!(
            language,
            "The run begins when its picture is traced",
            "A execução começa quando sua imagem está calculada"
        )
        .to_owned(),
        Phase::Preparing => word!(
            language,
            "Reading and compiling the scene, and estimating its cost …",
            "Lendo e compilando a cena, e estimando seu custo …"
        )
        .to_owned(),
        Phase::Failed(why) => {
            say!(language, "The run has failed: {why}. Press Restart", "A execução falhou: {why}. Pressione Reiniciar")
        }
        Phase::Finished if stage.shows_end() && stage.state().finished().is_none() => {
            unfinished_words(stage.state(), language)
        }
        // The records of virtual time begin when all costs are known.
        Phase::Running if stage.log.header.driver == Driver::Sim && stage.log.records().is_empty() => {
            before_virtual_time(language).into()
        }
        _ => match stage.stepped_to() {
            Some(record) => record_words(record, stage.state(), language),
            None => stage.narrator().sentence(stage.state(), session.now(), language),
        },
    };
    let event = match stage.stepped_to() {
        Some(record) => Some(record.at),
        None => stage.narrator().event_time(stage.state(), session.now()),
    };
    let recovering = session.recovering_scheduler();
    let width = time_width(ui, stage, language);
    let height = if recovering.is_some() { WARNING_HEIGHT_PT } else { SENTENCE_HEIGHT_PT };
    let (row, _) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
    let when =
        event.map_or(word!(language, "now", "agora").into(), |at| time_words(at, stage.playback_scale(), language));
    let at = pos2(row.left() + width, row.top() + 0.5 * SENTENCE_HEIGHT_PT);
    ui.painter().text(at, Align2::RIGHT_CENTER, when, theme::regular(theme::SMALL), look.quiet);
    let mut room = row.with_min_x(row.left() + width + GRID);
    let is_pressed = recovering.as_ref().is_some_and(|scheduler| {
        let name = if *scheduler == Scheduler::Protocol(Strategy::Adaptive) {
            word!(language, "Again with the adaptive ring", "De novo com o anel adaptativo")
        } else {
            word!(language, "Again with the farm with leases", "De novo com a dinâmica com prazos")
        };
        let at = room.with_min_x(room.right() - widgets::text_width(ui, name) - 3.0 * GRID);
        room.max.x = at.left() - GRID;
        let hint = word!(
            language,
            "Start the run again with the strategy that recovers from a failure",
            "Iniciar a execução de novo com a estratégia que se recupera de uma falha"
        );
        let at = Rect::from_min_size(at.min, vec2(at.width(), 4.0 * GRID));
        let shown = |ui: &mut Ui| hint_above(button(ui, None, name, true, Emphasis::Primary), hint).clicked();
        ui.scope_builder(UiBuilder::new().max_rect(at), shown).inner
    });
    let colour = if recovering.is_some() { look.trouble } else { look.text };
    // The largest font in which the sentence has one line, else a small one.
    let text_width = |size: f32| ui.painter().layout_no_wrap(sentence.clone(), theme::strong(size), look.text).size().x;
    let size = [20.0, 18.0, theme::BODY].into_iter().find(|&size| text_width(size) <= room.width());
    let text = RichText::new(&sentence).font(theme::strong(size.unwrap_or(theme::SMALL))).color(colour);
    ui.scope_builder(UiBuilder::new().max_rect(room), |ui| ui.add(Label::new(text).wrap()));
    is_pressed.then_some(UserCommand::RestartRecovering)
}

/// Shows events with their times, one line each, and after the last one how many `more` there are.
fn events<'a>(
    ui: &mut Ui,
    events: impl Iterator<Item = (Time, &'a Happening)>,
    more: usize,
    stage: &Stage,
    look: Look,
    language: Language,
) {
    let (font, scale, width) = (theme::regular(theme::SMALL), stage.playback_scale(), time_width(ui, stage, language));
    let mut events = events.peekable();
    while let Some((at, event)) = events.next() {
        let (line, response) = ui.allocate_exact_size(vec2(ui.available_width(), EVENT_HEIGHT_PT), Sense::hover());
        widgets::describe(&response, word!(language, "Event", "Evento"), || event.sentence(language));
        let y = line.center().y;
        let time = time_words(at, scale, language);
        ui.painter().text(pos2(line.left() + width, y), Align2::RIGHT_CENTER, time, font.clone(), look.quiet);
        let is_last = more > 0 && events.peek().is_none();
        let more = if is_last { say!(language, "  … and {more} more", "  … e mais {more}") } else { String::new() };
        let sentence = format!("{}{more}", event.sentence(language));
        let left = line.left() + width + GRID;
        let galley = one_line(ui, &sentence, &font, look, line.right() - left);
        ui.painter().galley(pos2(left, y - galley.size().y / 2.0), galley, look.quiet);
    }
}

/// Shows the result of the run: large figures, and a sentence on the machines' shares.
fn result(ui: &mut Ui, session: &Session, look: Look) {
    let language = session.language();
    let stage = session.stage();
    let Some(result) = stage.result() else { return };
    let area = ui.available_rect_before_wrap();
    let response = ui.interact(area, ui.scope_id().with("result"), Sense::hover());
    widgets::describe(&response, word!(language, "Result", "Resultado"), || {
        result_words(stage.state(), result, language)
    });
    // In a low panel the caption stands beside the figure instead of below it.
    let is_high = area.height() > 5.5 * GRID;
    let value = theme::strong(if is_high { theme::LARGE } else { 20.0 });
    let mut x = area.left();
    for (figure, definition) in summary_figures(result, language) {
        let figure = ui.painter().layout_no_wrap(figure, value.clone(), look.text);
        let caption = definition.name(language).to_owned();
        let caption = ui.painter().layout_no_wrap(caption, theme::regular(theme::SMALL), look.quiet);
        let (figure_size, caption_size) = (figure.size(), caption.size());
        let below = pos2(x, area.top() + 3.25 * GRID);
        let beside = pos2(x + figure_size.x + 0.75 * GRID, area.top() + figure_size.y - caption_size.y - 2.0);
        let corner = pos2(x, area.top() - if is_high { 0.5 * GRID } else { 0.0 });
        let place = Rect::from_min_size(corner, figure_size)
            .union(Rect::from_min_size(if is_high { below } else { beside }, caption_size));
        // A figure is left out rather than cut off.
        if place.right() > area.right() {
            break;
        }
        ui.painter().galley(corner, figure, look.text);
        ui.painter().galley(if is_high { below } else { beside }, caption, look.quiet);
        explain_at(ui, (place, 0), definition, language);
        x = if is_high { x + figure_size.x.max(caption_size.x) } else { beside.x + caption_size.x } + 3.0 * GRID;
    }
    let right = Rect::from_min_max(pos2(x + GRID, area.top()), area.max);
    // A high panel has room for the last events below the figures.
    let rest = area.with_min_y(area.top() + 7.0 * GRID);
    let lines = (rest.height().max(0.0) / EVENT_HEIGHT_PT) as usize;
    ui.scope_builder(UiBuilder::new().max_rect(rest), |ui| {
        let more = stage.narrator().events_so_far().saturating_sub(lines);
        events(ui, stage.narrator().events().rev().take(lines), more, stage, look, language);
    });
    let disturbed = disturbance_words(result.disturbance, language);
    let parts = work_split_words(stage.state(), language);
    let texts = [
        disturbed.as_ref().zip(parts.as_ref()).map(|(disturbed, parts)| format!("{disturbed}. {parts}")),
        disturbed.clone(),
        parts.filter(|_| disturbed.is_none()),
    ];
    let height =
        |text: &str, size: f32| ui.painter().layout(text.to_owned(), theme::regular(size), look.text, right.width());
    // A sentence is left out rather than cut off: the bar shows the shares too.
    let sizes = |text: String| [theme::BODY, theme::SMALL].map(|size| (text.clone(), size));
    let mut tried = texts.into_iter().flatten().flat_map(sizes);
    let fits = tried.find(|(text, size)| height(text, *size).size().y <= right.height());
    if let Some((text, size)) = fits.filter(|_| right.width() > 12.0 * GRID) {
        ui.scope_builder(UiBuilder::new().max_rect(right), |ui| {
            ui.add(Label::new(RichText::new(text).font(theme::regular(size)).color(look.text)).wrap());
        });
    }
}

/// Lays out a text in one line, shortened to `width` points.
fn one_line(ui: &Ui, text: &str, font: &FontId, look: Look, width: f32) -> std::sync::Arc<egui::Galley> {
    let mut job = LayoutJob::simple_singleline(text.to_owned(), font.clone(), look.quiet);
    job.wrap = TextWrapping::truncate_at_width(width);
    ui.painter().layout_job(job)
}

/// Paints the bar of all atoms: the share of each machine in its colour, untraced atoms empty.
fn bar(ui: &Ui, rect: Rect, session: &Session, look: Look) {
    let language = session.language();
    let response = ui.interact(rect, ui.scope_id().with("bar"), Sense::hover());
    let response = explained(response, Definition::WHO_TRACED, language);
    let state = session.stage().state();
    let (shares, all) = (node_shares(state), state.atoms());
    widgets::describe(&response, word!(language, "Who has traced how much", "Quem calculou quanto"), || {
        let text = |share: &NodeShare| format!("{}: {}", node_name(share.node), percent(share.atoms, all));
        shares.iter().map(text).collect::<Vec<_>>().join(", ")
    });
    ui.painter().rect_filled(rect, 4.0, look.raised);
    let end = shares.last().map_or(0.0, |share| share.end);
    if rect.width() * (1.0 - end) > 26.0 * GRID {
        let (at, font) = (pos2(rect.right() - GRID, rect.center().y), theme::regular(theme::SMALL));
        let caption = Definition::WHO_TRACED.name(language);
        ui.painter().text(at, Align2::RIGHT_CENTER, caption, font, look.quiet);
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

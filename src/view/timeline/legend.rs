//! The legend of a timeline: a sentence for each thing that is drawn.

use super::time_window::TimeWindow;
use super::{MAX_LINES, offers_and_transfers, parent_ticks};
use crate::balance::Condition;
use crate::language::{Language, word};
use crate::view::state::lane::{Lane, LanePhase};
use crate::view::state::lanes::{Lanes, Load};

/// Explains what is drawn in a window of the timeline, and nothing else.
pub(crate) fn timeline_legend(lanes: &Lanes, window: &TimeWindow, language: Language) -> Vec<&'static str> {
    let any = |has: &dyn Fn(&Lane) -> bool| lanes.lanes().iter().any(has);
    let has_phase =
        |wanted: &[LanePhase]| any(&|lane: &Lane| lane.phases().iter().any(|(_, phase)| wanted.contains(phase)));
    let has_condition = |wanted| any(&|lane: &Lane| lane.conditions().iter().any(|(_, found)| *found == wanted));
    let messages = |load| Some(offers_and_transfers(lanes, window, load).count()).filter(|count| *count <= MAX_LINES);
    let is_drawn = |count: Option<usize>| count.is_some_and(|count| count > 0);
    let ticks = Some(parent_ticks(lanes, window).take(MAX_LINES + 1).count()).filter(|count| *count <= MAX_LINES);
    let entries = [
        (
            any(&|lane: &Lane| !lane.bars().is_empty()),
            word!(
                language,
                "Bars: atoms traced; paler: part of the time.",
                "Barras: átomos calculados; mais claras: parte do tempo."
            ),
        ),
        (
            has_phase(&[LanePhase::Offers, LanePhase::Receives]),
            word!(
                language,
                "Thin bars: asking for atoms; darker: atoms on their way to it.",
                "Barras finas: pedindo átomos; mais escuras: átomos a caminho dela."
            ),
        ),
        (
            has_phase(&[LanePhase::Retired, LanePhase::Asleep]),
            word!(
                language,
                "Grey line in a lane: no longer needed, or asleep.",
                "Linha cinza na pista: dispensada ou dormindo."
            ),
        ),
        (
            any(&|lane: &Lane| !lane.stops().is_empty()),
            word!(language, "Black line in a lane: paused.", "Linha preta na pista: em pausa."),
        ),
        (
            has_condition(Condition::Hung),
            word!(language, "Hourglass and dashes: hung.", "Ampulheta e traços: travada."),
        ),
        (
            has_condition(Condition::CutOff),
            word!(
                language,
                "Cut wire and two dashed lines: cut off.",
                "Fio cortado e duas linhas tracejadas: isolada."
            ),
        ),
        (
            has_condition(Condition::Off),
            word!(language, "Cross on a pale lane: off.", "Cruz numa pista clara: desligada."),
        ),
        (
            is_drawn(messages(Load::Atoms)),
            word!(
                language,
                "Dark lines between lanes: atoms to another machine.",
                "Linhas escuras entre pistas: átomos para outra máquina."
            ),
        ),
        (
            is_drawn(messages(Load::Offer)),
            word!(
                language,
                "Pale lines between lanes: offers of help.",
                "Linhas claras entre pistas: ofertas de ajuda."
            ),
        ),
        (
            is_drawn(ticks),
            word!(language, "Ticks: messages to and from the parent.", "Riscos: mensagens para o pai e dele."),
        ),
        (
            messages(Load::Atoms).is_none() || messages(Load::Offer).is_none() || ticks.is_none(),
            word!(
                language,
                "Messages of which there are too many are left out.",
                "Mensagens que são demais são omitidas."
            ),
        ),
        (
            true,
            word!(
                language,
                "Above: the share of the machines that traced.",
                "Acima: a parte das máquinas que calculava."
            ),
        ),
    ];
    entries.into_iter().filter_map(|(is_drawn, text)| is_drawn.then_some(text)).collect()
}

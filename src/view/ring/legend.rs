//! The legend of the ring: a sentence for each thing that is drawn.

use super::layers::{RingLayer, RingMarks};
use super::layout::RingLayout;
use super::machine::shows_pipe;
use super::{RingOverlay, condition_badge::Badge, draw};
use crate::balance::{NodeId, Scheduler};
use crate::language::{Language, word};
use crate::time::Time;
use crate::view::state::flight::Cargo;
use crate::view::state::node_state::Activity;
use crate::view::state::run_state::RunState;

/// Explains what is drawn of the ring at `now`, and nothing else.
pub(crate) fn ring_legend(
    layout: &RingLayout,
    state: &RunState,
    overlay: &RingOverlay,
    now: Time,
    language: Language,
) -> Vec<&'static str> {
    let mut marks = draw(layout, state, overlay, now, language);
    let machines: Vec<(Activity, bool)> = (0..state.nodes().len() as NodeId)
        .map(|node| (state.activity(node, now), state.node_as_drawn(node, now).paused))
        .collect();
    let any = |has: &dyn Fn(Activity) -> bool| machines.iter().any(|(activity, _)| has(*activity));
    let has_badge = |badge| machines.iter().any(|&(activity, paused)| Badge::of(activity, paused) == Some(badge));
    let has_copies = state.flights().iter().any(|flight| matches!(flight.cargo, Cargo::Again(_)));
    let mut is_drawn = |layer| has_marks(&mut marks, layer);
    let parcels = is_drawn(RingLayer::Parcels);
    let entries = [
        (
            true,
            word!(
                language,
                "Disc: a machine; the faster, the larger. Arc round it: its atoms left; full: an equal share of the picture.",
                "Disco: uma máquina; quanto mais rápida, maior. Arco em volta: átomos que restam; cheio: uma parte igual da imagem."
            ),
        ),
        (
            any(&|activity| activity != Activity::Tracing && activity != Activity::Done && !is_open(activity)),
            word!(language, "Pale disc: it traces nothing now.", "Disco claro: agora não calcula nada."),
        ),
        (
            any(&|activity| matches!(activity, Activity::Retired | Activity::NoMore)),
            word!(language, "Dashed circle: no longer needed.", "Círculo tracejado: dispensada."),
        ),
        (
            any(&|activity| activity == Activity::Spare),
            word!(language, "Dashed seat: a spare machine.", "Lugar tracejado: máquina de reserva."),
        ),
        (
            (0..)
                .zip(&machines)
                .any(|(node, (activity, _))| shows_pipe(layout, &state.node_as_drawn(node, now), *activity)),
            word!(
                language,
                "Squares: the last atoms of a machine, in its pipe; no other can take them.",
                "Quadrados: os últimos átomos de uma máquina, em seu pipe; nenhuma outra pode levá-los."
            ),
        ),
        (has_badge(Badge::Paused), word!(language, "Two bars: paused.", "Duas barras: em pausa.")),
        (has_badge(Badge::Asleep), word!(language, "z: asleep.", "z: dormindo.")),
        (has_badge(Badge::Hung), word!(language, "Hourglass: hung.", "Ampulheta: travada.")),
        (has_badge(Badge::CutOff), word!(language, "Cut wire: cut off.", "Fio cortado: isolada.")),
        (has_badge(Badge::Off), word!(language, "Power switch: off.", "Botão de ligar: desligada.")),
        (
            state.scheduler.is_ring(),
            word!(
                language,
                "Outer circle with arrows: the way of offers of help.",
                "Círculo externo com setas: o caminho das ofertas de ajuda."
            ),
        ),
        (
            state.scheduler != Scheduler::WorkStealing,
            word!(language, "Spokes: the ways to and from the parent.", "Raios: os caminhos para o pai e dele."),
        ),
        (
            is_drawn(RingLayer::Results),
            word!(language, "Dots on spokes: traced atoms.", "Pontos nos raios: átomos calculados."),
        ),
        (
            is_drawn(RingLayer::Offers),
            word!(
                language,
                "Numbered disc on the outer circle: that machine offers help.",
                "Disco numerado no círculo externo: essa máquina oferece ajuda."
            ),
        ),
        (
            parcels,
            word!(
                language,
                "×n: a parcel of n atoms, in the colour of its giver, with a rim in that of its receiver.",
                "×n: um pacote de n átomos, na cor de quem dá, com borda na cor de quem recebe."
            ),
        ),
        (
            parcels && has_copies,
            word!(language, "Two boxes: atoms given out again.", "Duas caixas: átomos redistribuídos."),
        ),
        (
            is_drawn(RingLayer::FarmMessages),
            word!(
                language,
                "?: a request. ×n beside a spoke: its answer, n atoms. Dots at the parent: messages in line.",
                "?: um pedido. ×n ao lado de um raio: sua resposta, n átomos. Pontos junto ao pai: mensagens na fila."
            ),
        ),
        (
            is_drawn(RingLayer::Wakes),
            word!(language, "Spark: a machine wakes another.", "Faísca: uma máquina acorda outra."),
        ),
        (is_drawn(RingLayer::Losses), word!(language, "Cross: a lost message.", "Cruz: uma mensagem perdida.")),
        (
            true,
            word!(
                language,
                "Circle in the centre: the parent and the picture so far, or the result.",
                "Círculo no centro: o pai e a imagem até agora, ou o resultado."
            ),
        ),
    ];
    entries.into_iter().filter_map(|(is_drawn, text)| is_drawn.then_some(text)).collect()
}

fn has_marks(marks: &mut RingMarks, layer: RingLayer) -> bool {
    !marks.layer(layer).is_empty()
}

/// Whether a machine is drawn as an outline.
fn is_open(activity: Activity) -> bool {
    matches!(activity, Activity::Retired | Activity::Asleep | Activity::NoMore | Activity::Off | Activity::Spare)
}

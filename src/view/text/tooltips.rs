//! Tooltips: facts about a node, the parent, an atom or a message.

use std::time::Duration;

use super::format::{
    TimeScale, activity_word, atoms_words, count, counted, duration, fraction, node_name, party_name, percent,
    rate_words, time_words, two_digits,
};
use crate::balance::{Condition, NodeId, Party, Scheduler};
use crate::language::{Language, say, word};
use crate::picture::Atom;
use crate::time::Time;
use crate::view::state::atom_state::AtomState;
use crate::view::state::flight::{Cargo, Flight};
use crate::view::state::node_rows::node_rows;
use crate::view::state::node_state::{Activity, NodeState, Parcels, Slot};
use crate::view::state::run_state::RunState;

/// Kind of a fact about a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fact {
    State,
    Speed,
    Done,
    Left,
    Pipe,
    Rate,
    Idle,
    Stopped,
    Stole,
    Lost,
    Asked,
    Got,
    Offers,
    Gave,
    Shares,
    Link,
}

impl Fact {
    /// Returns the label of the fact.
    pub(crate) fn name(self, language: Language) -> &'static str {
        match self {
            Self::State => word!(language, "state", "estado"),
            Self::Speed => word!(language, "speed", "velocidade"),
            Self::Done => word!(language, "done", "feito"),
            Self::Left => word!(language, "left", "resta"),
            Self::Pipe => word!(language, "in the pipe", "no pipe"),
            Self::Rate => word!(language, "rate", "ritmo"),
            Self::Idle => word!(language, "idle", "ociosa"),
            Self::Stopped => word!(language, "stopped for", "parada por"),
            Self::Stole => word!(language, "stole", "roubou"),
            Self::Lost => word!(language, "lost", "perdeu"),
            Self::Asked => word!(language, "asked", "pediu"),
            Self::Got => word!(language, "got", "recebeu"),
            Self::Offers => word!(language, "offers of help", "ofertas de ajuda"),
            Self::Gave => word!(language, "gave", "deu"),
            Self::Shares => word!(language, "shares", "divide"),
            Self::Link => word!(language, "own link", "enlace próprio"),
        }
    }
}

/// Returns labels and values of a node's facts; none for a node that the run does not have.
pub fn node_words(state: &RunState, node: NodeId, now: Time, language: Language) -> Vec<(&'static str, String)> {
    let words = |(fact, words): (Fact, Option<String>)| {
        (fact.name(language), words.unwrap_or_else(|| nothing(language).into()))
    };
    node_facts(state, node, now, language).into_iter().map(words).collect()
}

/// Returns a node's facts; a value is `None` where there is nothing of it.
pub(crate) fn node_facts(state: &RunState, node: NodeId, now: Time, language: Language) -> Vec<(Fact, Option<String>)> {
    let Some(of) = state.nodes().get(usize::from(node)) else { return Vec::new() };
    let row = node_rows(state, now).swap_remove(usize::from(node));
    let paused =
        if of.paused && row.activity != Activity::Paused { word!(language, ", paused", ", em pausa") } else { "" };
    let mut facts = vec![
        (Fact::State, Some(format!("{}{paused}", activity_word(row.activity, language)))),
        (Fact::Speed, Some(fraction(of.speed))),
        (Fact::Done, Some(atoms_words(of.done, language))),
        (Fact::Left, Some(left_words(of, row.lost, language))),
        (Fact::Pipe, Some(pipe_words(of, language).into())),
        (Fact::Rate, Some(rate_words(row.rate, language))),
        (Fact::Idle, Some(fraction(row.idle))),
    ];
    if !row.stopped.is_zero() && !of.spare {
        facts.push((Fact::Stopped, Some(duration(row.stopped, language))));
    }
    facts.extend(shared_facts(state.scheduler(), of, language));
    facts.extend(own_link_words(state, Party::Node(node), language).map(|own| (Fact::Link, Some(own))));
    facts
}

/// Writes how many atoms a node still has, or how many were lost with it.
fn left_words(of: &NodeState, lost: u32, language: Language) -> String {
    let atoms = atoms_words(if lost > 0 { lost } else { of.left() }, language);
    if lost > 0 { say!(language, "{atoms} lost", "perdeu {atoms}") } else { atoms }
}

/// Returns the latency and the bandwidth that a party has of its own; `None` if it has none.
fn own_link_words(state: &RunState, party: Party, language: Language) -> Option<String> {
    let own = state.own_link(party);
    let latency = own.latency.map(|latency| duration(latency, language));
    let bandwidth = own.bandwidth.map(|bandwidth| format!("{} kB/s", two_digits(bandwidth * 1e-3, language)));
    let words: Vec<String> = latency.into_iter().chain(bandwidth).collect();
    (!words.is_empty()).then(|| words.join(", "))
}

/// Returns the time that messages of nodes travel; a range if some nodes have a latency of their own.
fn latency_words(state: &RunState, language: Language) -> String {
    let (least, most) = state.latency_range();
    if least == most {
        return duration(most, language);
    }
    let (least, most) = (duration(least, language), duration(most, language));
    say!(language, "{least} to {most}", "{least} a {most}")
}

/// Returns facts about the atoms that a node has got from others and given to them.
fn shared_facts(scheduler: &Scheduler, of: &NodeState, language: Language) -> Vec<(Fact, Option<String>)> {
    let parcel = word!(language, "parcel", "pacote");
    match scheduler {
        Scheduler::WorkStealing => {
            let theft = word!(language, "theft", "roubo");
            vec![
                (Fact::Stole, parcels_words(of.got, theft, language)),
                (Fact::Lost, parcels_words(of.given, theft, language)),
            ]
        }
        _ if scheduler.is_farm() => vec![
            (Fact::Asked, Some(counted(of.requests, word!(language, "time", "vez"), language))),
            (Fact::Got, parcels_words(of.got, word!(language, "part", "parte"), language)),
        ],
        _ if scheduler.is_ring() => {
            let [made, passed] = [of.offers, of.hops].map(count);
            let offers = say!(language, "{made} made, {passed} passed on", "{made} feitas, {passed} repassadas");
            vec![
                (Fact::Offers, Some(offers)),
                (Fact::Gave, parcels_words(of.given, parcel, language)),
                (Fact::Got, parcels_words(of.got, parcel, language)),
            ]
        }
        _ => vec![(Fact::Shares, Some(word!(language, "with nobody", "com ninguém").into()))],
    }
}

/// Returns labels and values of the parent's facts.
pub fn parent_words(state: &RunState, now: Time, language: Language) -> Vec<(&'static str, String)> {
    let (arrived, all) = (state.arrived(), state.division().pixels_in(&(0..state.atoms())));
    let until = state.finished().map_or(now, |end| end.min(now));
    let each = if until == Time::ZERO { 0.0 } else { arrived.messages as f64 / until.secs() };
    let (placed, of, part) = (count(arrived.pixels), count(all), percent(arrived.pixels, all));
    let (handled, rate) = (arrived.messages, rate_words(each, language));
    let mut words = vec![
        (
            word!(language, "placed", "recebido"),
            say!(language, "{placed} of {of} pixels, {part}", "{placed} de {of} pixels, {part}"),
        ),
        (
            word!(language, "messages", "mensagens"),
            say!(language, "{handled} handled, {rate}", "{handled} tratadas, {rate}"),
        ),
    ];
    if !state.handling.is_zero() {
        let messages = counted(state.line_length(now) as u64, word!(language, "message", "mensagem"), language);
        let each = duration(state.handling, language);
        words.push((
            word!(language, "in line", "na fila"),
            say!(language, "{messages}, {each} each", "{messages}, {each} cada"),
        ));
    }
    if state.scheduler().is_farm() {
        let parts = parcels_words(state.handed_out, word!(language, "part", "parte"), language);
        words.push((word!(language, "handed out", "distribuiu"), parts.unwrap_or_else(|| nothing(language).into())));
    }
    let way = if state.scheduler().is_ring() {
        word!(language, "a hop takes", "um salto leva")
    } else {
        word!(language, "a message takes", "uma mensagem leva")
    };
    words.push((way, latency_words(state, language)));
    words.extend(own_link_words(state, Party::Parent, language).map(|own| (Fact::Link.name(language), own)));
    words
}

/// Returns notes on the drawing of the ring, one on each line.
pub fn drawing_notes(state: &RunState, language: Language) -> Vec<String> {
    let (takes, handling) = (latency_words(state, language), duration(state.handling, language));
    let mut lines = [
        word!(language, "some atoms take longer than others", "alguns átomos demoram mais que outros"),
        word!(language, "all machines are emulated", "as máquinas são emuladas"),
    ]
    .map(str::to_owned)
    .to_vec();
    match state.scheduler() {
        Scheduler::WorkStealing => lines.push(
            word!(
                language,
                "threads share their memory, without messages",
                "as threads dividem a memória, sem mensagens"
            )
            .into(),
        ),
        _ if state.latency_range().1.is_zero() && state.handling.is_zero() => {}
        scheduler if scheduler.is_ring() => {
            lines.push(say!(
                language,
                "an offer of help takes {takes} a hop",
                "uma oferta de ajuda leva {takes} por salto"
            ));
        }
        _ if state.handling.is_zero() => {
            lines.push(say!(language, "a message takes {takes}", "uma mensagem leva {takes}"))
        }
        _ => lines.push(say!(
            language,
            "a message takes {takes}, the parent {handling}",
            "uma mensagem leva {takes}, o pai, {handling}"
        )),
    }
    if !state.scheduler().is_fixed() {
        lines.push(
            word!(
                language,
                "parcels are drawn slower than they travel",
                "os pacotes aparecem mais lentos do que viajam"
            )
            .into(),
        );
    }
    lines
}

/// Says where an atom is, in a sentence; empty if there is no such atom. Atoms have numbers from 1 here, and from 0 in
/// files.
pub fn atom_words(state: &RunState, atom: Atom, now: Time, language: Language) -> String {
    let Some(&atom_state) = state.atom_states().get(atom as usize) else { return String::new() };
    let place = match (atom_state, state.carrier(atom)) {
        (AtomState::Traced { by, cost, at, .. }, _) => {
            let cost = duration(Duration::try_from_secs_f32(cost).unwrap_or_default(), language);
            let length = state.finished().unwrap_or(state.head());
            let (by, at) = (node_name(by), time_words(at, TimeScale::of_length(length), language));
            say!(
                language,
                "traced by {by} at {at}, at a cost of {cost}",
                "calculado por {by} em {at}, ao custo de {cost}"
            )
        }
        (_, Some(Flight { from: Party::Node(from), to: Party::Node(to), .. })) => {
            let [from, to] = [*from, *to].map(node_name);
            say!(language, "on its way from {from} to {to}", "a caminho, de {from} para {to}")
        }
        (_, Some(Flight { to: Party::Node(to), cargo, .. })) => {
            let to = node_name(*to);
            match cargo {
                Cargo::Part(_) => {
                    say!(
                        language,
                        "on its way to {to}, in the part that it asked for",
                        "a caminho de {to}, na parte que ela pediu"
                    )
                }
                _ => say!(language, "on its way to {to}, in its band", "a caminho de {to}, em sua faixa"),
            }
        }
        (AtomState::With { node, since }, _) => with_words(state, atom, (node, since), now, language),
        (AtomState::Lost, _) => word!(language, "lost: no machine has it", "perdido: nenhuma máquina o tem").into(),
        (AtomState::Nowhere, _) => word!(language, "still with the parent", "ainda com o pai").into(),
    };
    let name = count(atom.saturating_add(1));
    say!(language, "Atom {name}: {place}", "Átomo {name}: {place}")
}

/// Describes a message in a few words.
pub fn flight_words(flight: &Flight, language: Language) -> String {
    let [from, to] = [flight.from, flight.to].map(|party| party_name(party, language));
    let atoms = atoms_words(flight.cargo.atoms(), language);
    let words = match &flight.cargo {
        Cargo::Band(_) => say!(language, "{atoms} for {to}, its band", "{atoms} para {to}, sua faixa"),
        Cargo::Request => say!(language, "{from} asks {to} for atoms", "{from} pede átomos ao pai"),
        Cargo::Part(_) if flight.cargo.atoms() == 0 => {
            say!(language, "{from} has no more atoms for {to}", "{from} não tem mais átomos para {to}")
        }
        Cargo::Part(_) => say!(language, "{atoms} for {to}, which asked for them", "{atoms} para {to}, que os pediu"),
        Cargo::Transfer(_) => say!(language, "{atoms} from {from} to {to}", "{atoms} de {from} para {to}"),
        Cargo::Offer { who } => {
            let who = node_name(*who);
            say!(
                language,
                "The offer of {who} to help, on its way from {from} to {to}",
                "A oferta de ajuda de {who}, a caminho, de {from} para {to}"
            )
        }
        Cargo::Results(_) => {
            say!(language, "{atoms} that {from} has traced, for {to}", "{atoms} que {from} calculou, para {to}")
        }
        Cargo::Again(_) => say!(
            language,
            "{atoms} from {from} to {to}, to be traced once more",
            "{atoms} de {from} a {to}, para calcular de novo"
        ),
        Cargo::Sleeps => say!(language, "{from} tells {to} that it sleeps", "{from} diz a {to} que dorme"),
        Cargo::Wake => say!(language, "{from} wakes {to}", "{from} acorda {to}"),
        Cargo::Beat => say!(language, "{from} tells {to} what it has", "{from} diz ao pai o que tem"),
        Cargo::Notice => say!(
            language,
            "{from} tells {to} about lost atoms or machines",
            "{from} avisa {to} de átomos ou máquinas perdidas"
        ),
        Cargo::Shutdown => {
            say!(language, "{from} tells {to} that the run is over", "A mensagem de suicídio, para {to}")
        }
    };
    if flight.lost.is_some() { say!(language, "{words}: lost", "{words}: perdida") } else { words }
}

/// Says where an atom is that a node has.
fn with_words(state: &RunState, atom: Atom, (node, since): (NodeId, Time), now: Time, language: Language) -> String {
    let (name, waited) = (node_name(node), duration(now.since(since), language));
    match state.nodes().get(usize::from(node)) {
        Some(of) if of.condition == Condition::Hung => {
            say!(language, "with {name}, which hangs", "com {name}, que travou")
        }
        Some(of) if of.atom == Some(atom) && of.paused => {
            say!(language, "{name} has begun it, but is paused", "{name} o começou, mas está em pausa")
        }
        Some(of) if of.atom == Some(atom) && of.speed == 0.0 => {
            say!(language, "{name} has begun it, but its speed is 0 %", "{name} o começou, mas sua velocidade é 0 %")
        }
        Some(of) if of.atom == Some(atom) => say!(language, "{name} traces it now", "{name} o calcula agora"),
        _ => say!(language, "has been in the queue of {name} for {waited}", "está na fila de {name} há {waited}"),
    }
}

fn nothing(language: Language) -> &'static str {
    word!(language, "nothing", "nada")
}

fn pipe_words(of: &NodeState, language: Language) -> &'static str {
    match of.pipe() {
        [Slot::Empty, _] => nothing(language),
        [Slot::Traced, Slot::Empty] => word!(language, "one atom, which it traces", "um átomo, que ela calcula"),
        [Slot::Traced, _] => word!(language, "two atoms, one of which it traces", "dois átomos; um deles ela calcula"),
        [Slot::Filled, Slot::Empty] => word!(language, "one atom, which waits", "um átomo, que espera"),
        [Slot::Filled, _] => word!(language, "two atoms, which wait", "dois átomos, que esperam"),
    }
}

fn parcels_words(Parcels { count, atoms }: Parcels, parcel: &str, language: Language) -> Option<String> {
    let (atoms, parcels) = (atoms_words(atoms, language), counted(count, parcel, language));
    (count > 0).then(|| say!(language, "{atoms} in {parcels}", "{atoms} em {parcels}"))
}

#[cfg(test)]
mod tests;

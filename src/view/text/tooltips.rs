//! What is said of a thing that somebody points at.

use std::time::Duration;

use super::format::{
    activity_word, atoms_words, count, counted, duration, fraction, node_name, party_name, percent, rate_words,
    seconds_words,
};
use crate::balance::{Condition, NodeId, Party};
use crate::language::{Language, say, word};
use crate::picture::Atom;
use crate::time::Time;
use crate::view::state::atom_state::AtomState;
use crate::view::state::flight::{Cargo, Flight};
use crate::view::state::node_rows::rows;
use crate::view::state::node_state::{Activity, NodeState, Parcels, Slot};
use crate::view::state::run_state::RunState;
use crate::view::state::scheduler::Sharing;

/// Something that there is to say of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fact {
    State,
    Speed,
    Done,
    Left,
    Pipe,
    Rate,
    Idle,
    Stole,
    Lost,
    Asked,
    Got,
    Offers,
    Gave,
    Shares,
}

impl Fact {
    /// What it is called.
    pub(crate) fn name(self, language: Language) -> &'static str {
        match self {
            Self::State => word!(language, "state", "estado"),
            Self::Speed => word!(language, "speed", "velocidade"),
            Self::Done => word!(language, "done", "feito"),
            Self::Left => word!(language, "left", "resta"),
            Self::Pipe => word!(language, "in the pipe", "no pipe"),
            Self::Rate => word!(language, "rate", "ritmo"),
            Self::Idle => word!(language, "idle", "ociosa"),
            Self::Stole => word!(language, "stole", "roubou"),
            Self::Lost => word!(language, "lost", "perdeu"),
            Self::Asked => word!(language, "asked", "pediu"),
            Self::Got => word!(language, "got", "recebeu"),
            Self::Offers => word!(language, "offers", "ofertas"),
            Self::Gave => word!(language, "gave", "deu"),
            Self::Shares => word!(language, "shares", "divide"),
        }
    }
}

/// What there is to say of a node, each with what it is; nothing of a node that is not in the ring.
pub fn node_words(state: &RunState, node: NodeId, now: Time, language: Language) -> Vec<(&'static str, String)> {
    let words = |(fact, words): (Fact, Option<String>)| {
        (fact.name(language), words.unwrap_or_else(|| nothing(language).into()))
    };
    node_facts(state, node, now, language).into_iter().map(words).collect()
}

/// The same; without words where it amounts to nothing.
pub(crate) fn node_facts(state: &RunState, node: NodeId, now: Time, language: Language) -> Vec<(Fact, Option<String>)> {
    let Some(of) = state.nodes().get(usize::from(node)) else { return Vec::new() };
    let row = rows(state, now).swap_remove(usize::from(node));
    let paused =
        if of.paused && row.activity != Activity::Paused { word!(language, ", paused", ", em pausa") } else { "" };
    let mut facts = vec![
        (Fact::State, Some(format!("{}{paused}", activity_word(row.activity, language)))),
        (Fact::Speed, Some(fraction(of.speed))),
        (Fact::Done, Some(atoms_words(of.done, language))),
        (Fact::Left, Some(atoms_words(of.left(), language))),
        (Fact::Pipe, Some(pipe_words(of, language).into())),
        (Fact::Rate, Some(rate_words(row.rate, language))),
        (Fact::Idle, Some(fraction(row.idle))),
    ];
    facts.extend(shared_facts(state.sharing(), of, language));
    facts
}

/// What a node has got from others, and they from it.
fn shared_facts(sharing: Sharing, of: &NodeState, language: Language) -> Vec<(Fact, Option<String>)> {
    let parcel = word!(language, "parcel", "pacote");
    match sharing {
        Sharing::Stealing => {
            let theft = word!(language, "theft", "roubo");
            vec![
                (Fact::Stole, parcels_words(of.got, theft, language)),
                (Fact::Lost, parcels_words(of.given, theft, language)),
            ]
        }
        _ if sharing.is_farm() => vec![
            (Fact::Asked, Some(counted(of.requests, word!(language, "time", "vez"), language))),
            (Fact::Got, parcels_words(of.got, word!(language, "part", "parte"), language)),
        ],
        _ if sharing.is_ring() => {
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

/// What there is to say of the parent, each with what it is.
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
        let (messages, each) = (state.line_length(now), duration(state.handling, language));
        words.push((
            word!(language, "in line", "na fila"),
            say!(language, "{messages}, {each} each", "{messages}, {each} cada"),
        ));
    }
    if state.sharing().is_farm() {
        let parts = parcels_words(state.handed_out, word!(language, "part", "parte"), language);
        words.push((word!(language, "handed out", "distribuiu"), parts.unwrap_or_else(|| nothing(language).into())));
    }
    let way = if state.sharing().is_ring() {
        word!(language, "a hop takes", "um salto leva")
    } else {
        word!(language, "a message takes", "uma mensagem leva")
    };
    words.push((way, duration(state.latency(), language)));
    words
}

/// What there is to know of the drawing itself, a line each.
pub fn small_print(state: &RunState, language: Language) -> Vec<String> {
    let (takes, handling) = (duration(state.latency(), language), duration(state.handling, language));
    let mut lines =
        vec![word!(language, "some atoms take longer than others", "alguns átomos demoram mais que outros").to_owned()];
    match state.sharing() {
        Sharing::Stealing => lines.push(
            word!(
                language,
                "threads share their memory, without messages",
                "as threads dividem a memória, sem mensagens"
            )
            .into(),
        ),
        _ if state.latency().is_zero() && state.handling.is_zero() => {}
        sharing if sharing.is_ring() => {
            lines.push(say!(language, "an offer takes {takes} a hop", "uma oferta leva {takes} por salto"));
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
    if !state.sharing().is_fixed() {
        lines.push(
            word!(language, "parcels are drawn slower than they travel", "os pacotes viajam mais rápido do que se vê")
                .into(),
        );
    }
    lines
}

/// Where an atom stands, in a sentence; empty if there is no such atom. For people atoms are numbered from 1 too.
pub fn atom_words(state: &RunState, atom: Atom, now: Time, language: Language) -> String {
    let Some(&place) = state.places().get(atom as usize) else { return String::new() };
    let stands = match (place, state.carrier(atom)) {
        (AtomState::Traced { by, cost, at, .. }, _) => {
            let cost = duration(Duration::try_from_secs_f32(cost).unwrap_or_default(), language);
            let (by, at) = (node_name(by), seconds_words(at.secs(), language));
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
        (AtomState::Lost, _) => word!(language, "lost: nobody has it", "perdido: ninguém o tem").into(),
        (AtomState::Nowhere, _) => word!(language, "still with the parent", "ainda com o pai").into(),
    };
    let name = count(atom.saturating_add(1));
    say!(language, "Atom {name}: {stands}", "Átomo {name}: {stands}")
}

/// What a message is, in a few words.
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
                "The offer of {who}, on its way from {from} to {to}",
                "A oferta de {who}, a caminho, de {from} para {to}"
            )
        }
        Cargo::Results(_) => {
            say!(language, "{atoms} that {from} has traced, for {to}", "{atoms} que {from} calculou, para {to}")
        }
        Cargo::Again(_) => say!(
            language,
            "{atoms} from {from} to {to}, to be traced once more",
            "{atoms} de {from} para {to}, para calcular de novo"
        ),
        Cargo::Sleeps => say!(language, "{from} tells {to} that it sleeps", "{from} diz a {to} que dorme"),
        Cargo::Wake => say!(language, "{from} wakes {to}", "{from} acorda {to}"),
        Cargo::Beat => say!(language, "{from} tells {to} what it has", "{from} diz ao pai o que tem"),
        Cargo::Notice => say!(language, "{from} tells {to} what is lost", "{from} diz a {to} o que se perdeu"),
        Cargo::Shutdown => say!(language, "The end, for {to}", "A mensagem de suicídio, para {to}"),
    };
    if flight.lost.is_some() { say!(language, "{words}: lost", "{words}: perdida") } else { words }
}

/// An atom is at a node.
fn with_words(state: &RunState, atom: Atom, (node, since): (NodeId, Time), now: Time, language: Language) -> String {
    let (name, waited) = (node_name(node), duration(now.since(since), language));
    match state.nodes().get(usize::from(node)) {
        Some(of) if of.condition == Condition::Hung => {
            say!(language, "is with {name}, which hangs", "está com {name}, que travou")
        }
        Some(of) if of.atom == Some(atom) && of.paused => {
            say!(language, "{name} has begun it, but is paused", "{name} o começou, mas está em pausa")
        }
        Some(of) if of.atom == Some(atom) && of.speed == 0.0 => {
            say!(language, "{name} has begun it, but stands still", "{name} o começou, mas está parada")
        }
        Some(of) if of.atom == Some(atom) => say!(language, "{name} traces it now", "{name} o calcula agora"),
        _ => say!(language, "waits in the queue of {name}, for {waited} now", "espera na fila de {name}, há {waited}"),
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
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::record::{Record, RecordKind};
    use crate::view::tests::sample_runs;

    fn value<'a>(words: &'a [(&str, String)], label: &str) -> &'a str {
        words.iter().find(|(other, _)| *other == label).map_or("", |(_, value)| value)
    }

    #[test]
    fn a_node_tells_what_it_did() {
        let language = Language::English;
        let header = sample_runs::header(&[1.0, 1.0, 0.1], 600);
        let mut state = RunState::new(&header);
        sample_runs::records(&header).iter().for_each(|record| state.apply(record));
        let slow = node_words(&state, 2, state.head(), language);
        let given = state.nodes()[2].given;
        assert!(given.count > 1);
        assert_eq!(value(&slow, "gave"), format!("{} atoms in {} parcels", given.atoms, given.count));
        assert_eq!((value(&slow, "state"), value(&slow, "speed")), ("done", "10 %"));
        assert_eq!((value(&slow, "left"), value(&slow, "in the pipe")), ("0 atoms", "nothing"));
        assert!(value(&slow, "offers").starts_with(&format!("{} made, ", state.nodes()[2].offers)));
        assert!(node_words(&state, 3, state.head(), language).is_empty());
    }

    #[test]
    fn a_node_that_is_paused_says_so() {
        let language = Language::English;
        let header = sample_runs::header(&[1.0, 1.0], 60);
        let mut state = RunState::new(&header);
        sample_runs::records(&header).iter().take(30).for_each(|record| state.apply(record));
        let state_of = |state: &RunState| value(&node_words(state, 0, state.head(), language), "state").to_owned();
        let pipe_of = |state: &RunState| value(&node_words(state, 0, state.head(), language), "in the pipe").to_owned();
        assert_eq!((&*state_of(&state), &*pipe_of(&state)), ("tracing", "two atoms, one of which it traces"));
        state.apply(&Record { at: state.head(), what: RecordKind::Paused { node: 0 } });
        assert_eq!((&*state_of(&state), &*pipe_of(&state)), ("paused", "two atoms, which wait"));
        state.nodes[0].left = 0;
        assert_eq!((&*state_of(&state), &*pipe_of(&state)), ("idle, paused", "nothing"));
    }

    #[test]
    fn the_parent_has_placed_every_pixel_at_the_end() {
        let language = Language::English;
        let header = sample_runs::header(&[1.0, 0.3], 40);
        let mut state = RunState::new(&header);
        assert_eq!(value(&parent_words(&state, Time::ZERO, language), "placed"), "0 of 2\u{a0}000 pixels, 0 %");
        let records = sample_runs::records(&header);
        records.iter().for_each(|record| state.apply(record));
        let words = parent_words(&state, Time::from_secs(2.0), language);
        assert_eq!(value(&words, "placed"), "2\u{a0}000 of 2\u{a0}000 pixels, 100 %");
        assert_eq!(value(&words, "a hop takes"), "40 ms");
        let is_handled = |record: &&Record| matches!(record.what, RecordKind::Received { by: Party::Parent, .. });
        let handled = records.iter().filter(is_handled).count();
        assert!(value(&words, "messages").starts_with(&format!("{handled} handled, ")), "{words:?}");
    }

    #[test]
    fn an_atom_is_followed_from_the_parent_to_the_picture() {
        let language = Language::English;
        let header = sample_runs::header(&[1.0, 1.0, 0.1], 90);
        let mut state = RunState::new(&header);
        let mut told: Vec<String> = Vec::new();
        told.push(atom_words(&state, 89, Time::ZERO, language));
        for record in sample_runs::records(&header) {
            state.apply(&record);
            let words = atom_words(&state, 89, record.at, language);
            told.push(words.split(", for").next().unwrap_or_default().to_owned());
        }
        told.dedup();
        assert_eq!(told[0], "Atom 90: still with the parent");
        assert_eq!(told[1], "Atom 90: on its way to 3, in its band");
        assert_eq!(told[2], "Atom 90: waits in the queue of 3");
        assert!(told[3].starts_with("Atom 90: on its way from 3 to "), "{told:#?}");
        assert!(told.iter().any(|told| told.ends_with(" traces it now")), "{told:#?}");
        assert!(told.last().is_some_and(|told| told.ends_with(", at a cost of 1.0 ms")), "{told:#?}");
        assert_eq!(atom_words(&state, 90, Time::ZERO, language), "");
    }

    #[test]
    fn an_atom_that_is_begun_knows_why_it_is_not_done() {
        let language = Language::English;
        let header = sample_runs::header(&[1.0], 9);
        let mut state = RunState::new(&header);
        sample_runs::records(&header).iter().take(3).for_each(|record| state.apply(record));
        assert_eq!(atom_words(&state, 0, state.head(), language), "Atom 1: 1 traces it now");
        let later = state.head() + Duration::from_secs(3);
        assert_eq!(atom_words(&state, 8, later, language), "Atom 9: waits in the queue of 1, for 3.0 s now");
        state.apply(&Record { at: later, what: RecordKind::SpeedSet { node: 0, speed: 0.0 } });
        assert_eq!(atom_words(&state, 0, later, language), "Atom 1: 1 has begun it, but stands still");
        state.apply(&Record { at: later, what: RecordKind::Paused { node: 0 } });
        assert_eq!(atom_words(&state, 0, later, language), "Atom 1: 1 has begun it, but is paused");
    }

    #[test]
    fn messages_are_told_apart() {
        let header = sample_runs::header(&[1.0, 1.0, 0.1], 300);
        let mut state = RunState::new(&header);
        let mut told = BTreeSet::new();
        for record in sample_runs::records(&header) {
            state.apply(&record);
            told.extend(state.flights().iter().map(|flight| flight_words(flight, Language::English)));
        }
        for part in ["100 atoms for 3, its band", "2 atoms that 2 has traced, for the parent", " atoms from 3 to "] {
            assert!(told.iter().any(|told| told.contains(part)), "{part}: {told:#?}");
        }
        assert!(told.contains("The offer of 1, on its way from 1 to 3"), "{told:#?}");
    }
}

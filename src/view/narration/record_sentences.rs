//! Sentences for single records, with their reasons, for stepping through a run.

use super::happening::Happening;
use super::share::{Share, ShareBasis, atoms_in_queue};
use crate::balance::{NodeId, Party};
use crate::language::{Language, say, word};
use crate::record::{Record, RecordKind};
use crate::view::state::flight::{Cargo, Flight};
use crate::view::state::run_state::RunState;
use crate::view::text::format::{atoms_words, count, duration, node_name, party_name};
use crate::view::text::tooltips::flight_words;

/// Puts a record into a sentence; `state` already knows the record.
pub fn record_words(record: &Record, state: &RunState, language: Language) -> String {
    if let Some(happening) = Happening::of(record, state) {
        return happening.sentence(language);
    }
    match &record.kind {
        RecordKind::Sent { id, .. } => match state.flight(*id) {
            Some(flight) => sent_words(flight, state, language),
            None => word!(language, "A message is sent", "Uma mensagem é enviada").into(),
        },
        RecordKind::Received { id, by } => {
            let by = match by {
                Party::Parent => word!(language, "The parent", "O pai").into(),
                Party::Node(node) => node_name(*node).to_string(),
            };
            match state.flight(*id).map(|flight| flight_words(flight, language)) {
                Some(what) => {
                    say!(language, "{by} handles a message: {what}", "{by} atende uma mensagem: {what}")
                }
                None => say!(language, "{by} handles a message", "{by} atende uma mensagem"),
            }
        }
        RecordKind::Estimated { .. } => {
            word!(language, "The parent has sampled the picture", "O pai amostrou a imagem").into()
        }
        RecordKind::AtomStarted { node, atom } => {
            let (name, atom) = (node_name(*node), count(atom.saturating_add(1)));
            say!(language, "{name} begins atom {atom}", "{name} começa o átomo {atom}")
        }
        RecordKind::AtomDone { node, atom, cost } => {
            let (name, atom, cost) = (node_name(*node), count(atom.saturating_add(1)), duration(*cost, language));
            say!(
                language,
                "{name} has traced atom {atom}, at a cost of {cost}",
                "{name} calculou o átomo {atom}, ao custo de {cost}"
            )
        }
        RecordKind::Link { one, other, cut } => {
            let (one, other) = (party_name(*one, language), party_name(*other, language));
            if *cut {
                say!(
                    language,
                    "The link between {one} and {other} is cut",
                    "A ligação entre {one} e {other} foi cortada"
                )
            } else {
                say!(
                    language,
                    "The link between {one} and {other} works again",
                    "A ligação entre {one} e {other} voltou"
                )
            }
        }
        RecordKind::Lost { .. } => word!(language, "A message is lost", "Uma mensagem se perde").into(),
        RecordKind::AtomFailed { node, atom } => {
            let (name, atom) = (node_name(*node), count(atom.saturating_add(1)));
            say!(language, "{name} fails to trace atom {atom}", "{name} não consegue calcular o átomo {atom}")
        }
        RecordKind::GivenUp { atom } => {
            let atom = count(atom.saturating_add(1));
            say!(
                language,
                "Atom {atom} cannot be traced: the run has failed",
                "O átomo {atom} não pode ser calculado: a execução falhou"
            )
        }
        RecordKind::Estimating
        | RecordKind::SpeedSet { .. }
        | RecordKind::Paused { .. }
        | RecordKind::Resumed { .. }
        | RecordKind::LatencySet { .. }
        | RecordKind::OwnLatencySet { .. }
        | RecordKind::Condition { .. }
        | RecordKind::Delayed { .. }
        | RecordKind::Retired { .. }
        | RecordKind::Finished => String::new(),
    }
}

fn sent_words(flight: &Flight, state: &RunState, language: Language) -> String {
    match (flight.from, flight.to, &flight.cargo) {
        (Party::Node(from), Party::Node(to), Cargo::Transfer(_)) => {
            let atoms = flight.cargo.atoms();
            Happening::transfer(state, from, to, atoms).sentence(language)
        }
        (Party::Node(from), _, Cargo::Offer { who }) if from == *who => {
            let done = state.nodes().get(usize::from(from)).map_or(0, |node| node.offered);
            Happening::offer(state, *who, true, done).sentence(language)
        }
        (Party::Node(from), Party::Node(to), Cargo::Offer { who }) => {
            let left = state.nodes().get(usize::from(from)).map_or(0, |node| atoms_in_queue(node.left()));
            let why = if left == 0 {
                word!(language, "it has no waiting atoms", "não tem átomos à espera")
            } else {
                word!(language, "its waiting atoms are not worth a transfer", "seus átomos não valem um envio")
            };
            let [from, who, to] = [from, *who, to].map(node_name);
            say!(
                language,
                "{from} passes the offer of {who} on to {to}: {why}",
                "{from} repassa a oferta de {who} a {to}: {why}"
            )
        }
        _ => flight_words(flight, language),
    }
}

/// Explains the number of atoms in a transfer, the latest record of `state`; `None` for work stealing.
pub fn share_words(state: &RunState, from: NodeId, to: NodeId, atoms: u32, language: Language) -> Option<String> {
    let share = Share::of(state, from, to, atoms)?;
    let (waiting, reason) = (atoms_words(share.waiting, language), share.reason(to, language));
    let (from, verb) = (node_name(from), if share.waiting == 1 { "esperava" } else { "esperavam" });
    Some(match share.basis {
        ShareBasis::Traced { offerer, giver } => {
            let [offerer, sum] = [offerer, offerer.saturating_add(giver)].map(count);
            say!(
                language,
                "{offerer}/{sum} of {waiting} that waited with machine {from}: {reason}",
                "{offerer}/{sum} de {waiting} que {verb} na máquina {from}: {reason}"
            )
        }
        _ => say!(
            language,
            "of {waiting} that waited with machine {from}: {reason}",
            "de {waiting} que {verb} na máquina {from}: {reason}"
        ),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balance::Message;
    use crate::view::tests::sample_runs;

    #[test]
    fn every_record_has_words_and_shares_match_their_reasons() {
        let language = Language::English;
        let header = sample_runs::header(&[1.0, 0.7, 0.9, 0.5, 0.1], 900);
        let mut state = RunState::new(&header);
        let mut shares = 0;
        for record in sample_runs::records(&header) {
            state.apply(&record);
            let words = record_words(&record, &state, language);
            assert!(!words.is_empty() && words.chars().count() < 190, "{words}");
            if let RecordKind::Sent {
                from: Party::Node(from),
                to: Party::Node(to),
                message: Message::Transfer(ranges),
                ..
            } = &record.kind
            {
                let atoms: u32 = ranges.iter().map(|range| range.len() as u32).sum();
                let [owner, offerer] = [*from, *to].map(|node| &state.nodes()[usize::from(node)]);
                let (own, offered) = (f64::from(owner.done), f64::from(offerer.offered));
                let waits = f64::from(atoms_in_queue(owner.left()) + atoms);
                assert!((waits * offered / (offered + own) - f64::from(atoms)).abs() <= 0.5, "{words}");
                assert!(words.contains(" in proportion to atoms traced, "), "{words}");
                shares += 1;
            }
        }
        assert!(shares > 3);
    }

    #[test]
    fn passed_on_offer_has_a_reason() {
        let language = Language::English;
        let header = sample_runs::header(&[1.0, 1.0, 1.0], 300);
        let mut state = RunState::new(&header);
        let mut sentences = Vec::new();
        for record in sample_runs::records(&header) {
            state.apply(&record);
            sentences.push(record_words(&record, &state, language));
        }
        assert!(sentences.iter().any(|words| words.ends_with(": it has no waiting atoms")), "{sentences:#?}");
        assert!(sentences.iter().any(|words| words.starts_with("1 handles a message: ")), "{sentences:#?}");
    }
}

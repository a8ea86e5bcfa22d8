//! What a record says in a sentence, and why it came so: for whoever goes through a run event by event.

use super::flight::{Cargo, Flight};
use super::hover::flight_words;
use super::sentences;
use super::sharing::Sharing;
use super::standing::PIPE;
use super::state::RunState;
use super::words::{atoms_words, count, duration, node_name};
use crate::balance::{NodeId, Party};
use crate::record::{Record, What};

/// What happened, in a sentence; `state` already knows it.
pub fn record_words(record: &Record, state: &RunState) -> String {
    match &record.what {
        What::Sent { id, .. } => match state.flight(*id) {
            Some(flight) => sent_words(flight, state),
            None => "A message leaves".into(),
        },
        What::Received { id, by } => {
            let by = match by {
                Party::Parent => "The parent".into(),
                Party::Node(node) => node_name(*node).to_string(),
            };
            match state.flight(*id) {
                Some(flight) => format!("{by} handles what has arrived: {}", flight_words(flight)),
                None => format!("{by} handles a message"),
            }
        }
        What::Estimating => sentences::ESTIMATING.into(),
        What::Estimated { .. } => "The parent has sampled the picture".into(),
        What::AtomStarted { node, atom } => {
            format!("{} begins atom {}", node_name(*node), count(atom.saturating_add(1)))
        }
        What::AtomDone { node, atom, cost } => {
            let (name, atom) = (node_name(*node), count(atom.saturating_add(1)));
            format!("{name} has traced atom {atom}, at a cost of {}", duration(*cost))
        }
        What::SpeedSet { node, speed } => {
            let before = state.nodes().get(usize::from(*node)).map_or(*speed, |node| node.speed_before);
            sentences::speed(state, *node, before, *speed)
        }
        What::Paused { node } => sentences::paused(state, *node),
        What::Resumed { node } => sentences::resumed(state, *node),
        What::LatencySet { latency } => sentences::latency(state, *latency),
        What::Retired { node } => sentences::retired(state, &[*node]),
        What::Finished => sentences::COMPLETE.into(),
    }
}

fn sent_words(flight: &Flight, state: &RunState) -> String {
    match (flight.from, flight.to, &flight.cargo) {
        (Party::Node(from), Party::Node(to), Cargo::Transfer(_)) => {
            let atoms = flight.cargo.atoms();
            let why = share_words(state, from, to, atoms).map(|why| format!(": {why}")).unwrap_or_default();
            format!("{}{why}", sentences::transfer(state, from, to, atoms))
        }
        (Party::Node(from), _, Cargo::Offer { who }) if from == *who => {
            sentences::offer(*who, true, state.nodes().get(usize::from(from)).map_or(0, |node| node.offered))
        }
        (Party::Node(from), Party::Node(to), Cargo::Offer { who }) => {
            let left = state.nodes().get(usize::from(from)).map_or(0, |node| waiting(node.left()));
            let why = if left == 0 { "no atom waits with it" } else { "what it could give is not worth it" };
            format!("{} passes the offer of {} on to {}: {why}", node_name(from), node_name(*who), node_name(to))
        }
        _ => flight_words(flight),
    }
}

/// Why a transfer, the last thing that has happened, has so many atoms (§7); `None` where nobody has weighed anything.
pub fn share_words(state: &RunState, from: NodeId, to: NodeId, atoms: u32) -> Option<String> {
    if !matches!(state.sharing(), Sharing::By(_)) {
        return None;
    }
    let [owner, offerer] = [from, to].map(|node| state.nodes().get(usize::from(node)));
    let (own, offered, waits) = (owner?.done, offerer?.offered, waiting(owner?.left()) + atoms);
    let (from, to) = (node_name(from), node_name(to));
    let waits = format!("of {} that waited with machine {from}", atoms_words(waits));
    Some(match (own, offered) {
        (0, 0) => format!("{waits}, half, since neither had traced any"),
        (_, 0) => format!("{waits}, one for a trial, since machine {to} had traced none"),
        _ => {
            let [own, offered, sum] = [own, offered, own.saturating_add(offered)].map(count);
            format!("{waits}, {offered}/{sum}: machine {to} had traced {offered}, machine {from} {own}")
        }
    })
}

/// How many of a node's atoms nobody has begun: what is in its pipe stays there.
fn waiting(left: u32) -> u32 {
    left.saturating_sub(PIPE)
}

#[cfg(test)]
mod tests {
    use super::super::sample;
    use super::*;
    use crate::balance::Message;

    #[test]
    fn every_record_is_told_and_a_share_is_what_its_reason_says() {
        let header = sample::header(&[1.0, 0.7, 0.9, 0.5, 0.1], 900);
        let mut state = RunState::new(&header);
        let mut shares = 0;
        for record in sample::records(&header) {
            state.apply(&record);
            let words = record_words(&record, &state);
            assert!(!words.is_empty() && words.chars().count() < 190, "{words}");
            if let What::Sent {
                from: Party::Node(from), to: Party::Node(to), message: Message::Transfer(ranges), ..
            } = &record.what
            {
                let atoms: u32 = ranges.iter().map(|range| range.len() as u32).sum();
                let [owner, offerer] = [*from, *to].map(|node| &state.nodes()[usize::from(node)]);
                let (own, offered) = (f64::from(owner.done), f64::from(offerer.offered));
                let waits = f64::from(waiting(owner.left()) + atoms);
                assert!((waits * offered / (offered + own) - f64::from(atoms)).abs() <= 0.5, "{words}");
                assert!(words.contains(" that waited with machine "), "{words}");
                shares += 1;
            }
        }
        assert!(shares > 3);
    }

    #[test]
    fn whoever_passes_an_offer_on_says_why() {
        let header = sample::header(&[1.0, 1.0, 1.0], 300);
        let mut state = RunState::new(&header);
        let mut told = Vec::new();
        for record in sample::records(&header) {
            state.apply(&record);
            told.push(record_words(&record, &state));
        }
        assert!(told.iter().any(|words| words.ends_with(": no atom waits with it")), "{told:#?}");
        assert!(told.iter().any(|words| words.starts_with("1 handles what has arrived: ")), "{told:#?}");
    }
}

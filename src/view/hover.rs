//! What is said of a thing that somebody points at.

use std::time::Duration;

use super::flight::{Cargo, Flight};
use super::node::{Activity, NodeState, Parcels, Slot};
use super::nodes::rows;
use super::place::Place;
use super::sharing::Sharing;
use super::state::RunState;
use super::words::{activity_word, atoms_words, count, counted, duration, fraction, node_name, percent, rate_words};
use crate::balance::{NodeId, Party};
use crate::picture::Atom;
use crate::time::Time;

/// What there is to say of a node, each with what it is; nothing of a node that is not in the ring.
pub fn node_words(state: &RunState, node: NodeId, now: Time) -> Vec<(&'static str, String)> {
    let Some(of) = state.nodes().get(usize::from(node)) else { return Vec::new() };
    let row = rows(state, now).swap_remove(usize::from(node));
    let paused = if of.paused && row.activity != Activity::Paused { ", paused" } else { "" };
    let mut words = vec![
        ("state", format!("{}{paused}", activity_word(row.activity))),
        ("speed", fraction(of.speed)),
        ("done", atoms_words(of.done)),
        ("left", atoms_words(of.left())),
        ("in the pipe", pipe_words(of).into()),
        ("rate", rate_words(row.rate)),
        ("idle", fraction(row.idle)),
    ];
    words.extend(shared_words(state.sharing(), of));
    words
}

/// What a node has got from others, and they from it.
fn shared_words(sharing: Sharing, of: &NodeState) -> Vec<(&'static str, String)> {
    match sharing {
        Sharing::Stealing => {
            vec![("stole", parcels_words(of.got, "theft")), ("lost", parcels_words(of.given, "theft"))]
        }
        _ if sharing.is_farm() => {
            vec![("asked", counted(of.requests, "time")), ("got", parcels_words(of.got, "part"))]
        }
        _ if sharing.is_ring() => vec![
            ("offers", format!("{} made, {} passed on", count(of.offers), count(of.hops))),
            ("gave", parcels_words(of.given, "parcel")),
            ("got", parcels_words(of.got, "parcel")),
        ],
        _ => vec![("shares", "with nobody".into())],
    }
}

/// What there is to say of the parent, each with what it is.
pub fn parent_words(state: &RunState, now: Time) -> Vec<(&'static str, String)> {
    let (arrived, all) = (state.arrived(), state.division().pixels_in(&(0..state.atoms())));
    let until = state.finished().map_or(now, |end| end.min(now));
    let each = if until == Time::ZERO { 0.0 } else { arrived.messages as f64 / until.secs() };
    let mut words = vec![
        ("placed", format!("{} of {} pixels, {}", count(arrived.pixels), count(all), percent(arrived.pixels, all))),
        ("messages", format!("{} seen, {}", arrived.messages, rate_words(each))),
    ];
    if !state.handling.is_zero() {
        words.push(("waiting", format!("{}, {} each", state.waiting(now), duration(state.handling))));
    }
    if state.sharing().is_farm() {
        words.push(("handed out", parcels_words(state.handed_out, "part")));
    }
    let way = if state.sharing().is_ring() { "a hop takes" } else { "a message takes" };
    words.push((way, duration(state.latency())));
    words
}

/// What there is to know of the drawing itself, a line each.
pub fn small_print(state: &RunState) -> Vec<String> {
    let takes = duration(state.latency());
    let mut lines = vec!["some atoms take longer than others".to_owned()];
    match state.sharing() {
        Sharing::Stealing => lines.push("threads share their memory, without messages".into()),
        _ if state.latency().is_zero() && state.handling.is_zero() => {}
        sharing if sharing.is_ring() => lines.push(format!("an offer takes {takes} a hop")),
        _ if state.handling.is_zero() => lines.push(format!("a message takes {takes}")),
        _ => lines.push(format!("a message takes {takes}, the parent {}", duration(state.handling))),
    }
    if !state.sharing().is_fixed() {
        lines.push("parcels are drawn slower than they travel".into());
    }
    lines
}

/// Where an atom stands, in a sentence; empty if there is no such atom. For people atoms are numbered from 1 too.
pub fn atom_words(state: &RunState, atom: Atom, now: Time) -> String {
    let Some(&place) = state.places().get(atom as usize) else { return String::new() };
    let stands = match (place, state.carrier(atom)) {
        (Place::Traced { by, cost, at, .. }, _) => {
            let cost = duration(Duration::try_from_secs_f32(cost).unwrap_or_default());
            format!("traced by {} at {:.1} s, at a cost of {cost}", node_name(by), at.secs())
        }
        (_, Some(Flight { from: Party::Node(from), to: Party::Node(to), .. })) => {
            format!("on its way from {} to {}", node_name(*from), node_name(*to))
        }
        (_, Some(Flight { to: Party::Node(to), cargo: Cargo::Part(_), .. })) => {
            format!("on its way to {}, in the part that it asked for", node_name(*to))
        }
        (_, Some(Flight { to: Party::Node(to), .. })) => format!("on its way to {}, in its band", node_name(*to)),
        (Place::With { node, since }, _) => with_words(state, atom, (node, since), now),
        (Place::Nowhere, _) => "still with the parent".into(),
    };
    format!("Atom {}: {stands}", count(atom.saturating_add(1)))
}

/// What a message is, in a few words.
pub fn flight_words(flight: &Flight) -> String {
    let name = |party| match party {
        Party::Parent => "the parent".into(),
        Party::Node(node) => node_name(node).to_string(),
    };
    let (from, to, atoms) = (name(flight.from), name(flight.to), atoms_words(flight.cargo.atoms()));
    match &flight.cargo {
        Cargo::Band(_) => format!("{atoms} for {to}, its band"),
        Cargo::Request => format!("{from} asks {to} for atoms"),
        Cargo::Part(_) if flight.cargo.atoms() == 0 => format!("{from} has no more atoms for {to}"),
        Cargo::Part(_) => format!("{atoms} for {to}, which asked for them"),
        Cargo::Transfer(_) => format!("{atoms} from {from} to {to}"),
        Cargo::Offer { who } => format!("The offer of {}, on its way from {from} to {to}", node_name(*who)),
        Cargo::Results(_) => format!("{atoms} that {from} has traced, for {to}"),
        Cargo::Shutdown => format!("The end, for {to}"),
    }
}

/// An atom is at a node.
fn with_words(state: &RunState, atom: Atom, (node, since): (NodeId, Time), now: Time) -> String {
    let name = node_name(node);
    match state.nodes().get(usize::from(node)) {
        Some(of) if of.atom == Some(atom) && of.paused => format!("{name} has begun it, but is paused"),
        Some(of) if of.atom == Some(atom) && of.speed == 0.0 => format!("{name} has begun it, but stands still"),
        Some(of) if of.atom == Some(atom) => format!("{name} traces it now"),
        _ => format!("waits in the queue of {name}, for {} now", duration(now.since(since))),
    }
}

fn pipe_words(of: &NodeState) -> &'static str {
    match of.pipe() {
        [Slot::Empty, _] => "nothing",
        [Slot::Traced, Slot::Empty] => "one atom, which it traces",
        [Slot::Traced, _] => "two atoms, one of which it traces",
        [Slot::Filled, Slot::Empty] => "one atom, which waits",
        [Slot::Filled, _] => "two atoms, which wait",
    }
}

fn parcels_words(Parcels { count, atoms }: Parcels, parcel: &str) -> String {
    if count == 0 { "nothing".into() } else { format!("{} in {}", atoms_words(atoms), counted(count, parcel)) }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::super::sample;
    use super::*;
    use crate::record::{Record, What};

    fn value<'a>(words: &'a [(&str, String)], label: &str) -> &'a str {
        words.iter().find(|(other, _)| *other == label).map_or("", |(_, value)| value)
    }

    #[test]
    fn a_node_tells_what_it_did() {
        let header = sample::header(&[1.0, 1.0, 0.1], 600);
        let mut state = RunState::new(&header);
        sample::records(&header).iter().for_each(|record| state.apply(record));
        let slow = node_words(&state, 2, state.head());
        let given = state.nodes()[2].given;
        assert!(given.count > 1);
        assert_eq!(value(&slow, "gave"), format!("{} atoms in {} parcels", given.atoms, given.count));
        assert_eq!((value(&slow, "state"), value(&slow, "speed")), ("done", "10 %"));
        assert_eq!((value(&slow, "left"), value(&slow, "in the pipe")), ("0 atoms", "nothing"));
        assert!(value(&slow, "offers").starts_with(&format!("{} made, ", state.nodes()[2].offers)));
        assert!(node_words(&state, 3, state.head()).is_empty());
    }

    #[test]
    fn a_node_that_is_paused_says_so() {
        let header = sample::header(&[1.0, 1.0], 60);
        let mut state = RunState::new(&header);
        sample::records(&header).iter().take(30).for_each(|record| state.apply(record));
        let state_of = |state: &RunState| value(&node_words(state, 0, state.head()), "state").to_owned();
        let pipe_of = |state: &RunState| value(&node_words(state, 0, state.head()), "in the pipe").to_owned();
        assert_eq!((&*state_of(&state), &*pipe_of(&state)), ("computing", "two atoms, one of which it traces"));
        state.apply(&Record { at: state.head(), what: What::Paused { node: 0 } });
        assert_eq!((&*state_of(&state), &*pipe_of(&state)), ("paused", "two atoms, which wait"));
        state.nodes[0].left = 0;
        assert_eq!((&*state_of(&state), &*pipe_of(&state)), ("idle, paused", "nothing"));
    }

    #[test]
    fn the_parent_has_placed_every_pixel_at_the_end() {
        let header = sample::header(&[1.0, 0.3], 40);
        let mut state = RunState::new(&header);
        assert_eq!(value(&parent_words(&state, Time::ZERO), "placed"), "0 of 2\u{a0}000 pixels, 0 %");
        let records = sample::records(&header);
        records.iter().for_each(|record| state.apply(record));
        let words = parent_words(&state, Time::from_secs(2.0));
        assert_eq!(value(&words, "placed"), "2\u{a0}000 of 2\u{a0}000 pixels, 100 %");
        assert_eq!(value(&words, "a hop takes"), "40 ms");
        let seen = |record: &&Record| matches!(record.what, What::Received { by: Party::Parent, .. });
        let seen = records.iter().filter(seen).count();
        assert!(value(&words, "messages").starts_with(&format!("{seen} seen, ")), "{words:?}");
    }

    #[test]
    fn an_atom_is_followed_from_the_parent_to_the_picture() {
        let header = sample::header(&[1.0, 1.0, 0.1], 90);
        let mut state = RunState::new(&header);
        let mut told: Vec<String> = Vec::new();
        told.push(atom_words(&state, 89, Time::ZERO));
        for record in sample::records(&header) {
            state.apply(&record);
            let words = atom_words(&state, 89, record.at);
            told.push(words.split(", for").next().unwrap_or_default().to_owned());
        }
        told.dedup();
        assert_eq!(told[0], "Atom 90: still with the parent");
        assert_eq!(told[1], "Atom 90: on its way to 3, in its band");
        assert_eq!(told[2], "Atom 90: waits in the queue of 3");
        assert!(told[3].starts_with("Atom 90: on its way from 3 to "), "{told:#?}");
        assert!(told.iter().any(|told| told.ends_with(" traces it now")), "{told:#?}");
        assert!(told.last().is_some_and(|told| told.ends_with(", at a cost of 1.0 ms")), "{told:#?}");
        assert_eq!(atom_words(&state, 90, Time::ZERO), "");
    }

    #[test]
    fn an_atom_that_is_begun_knows_why_it_is_not_done() {
        let header = sample::header(&[1.0], 9);
        let mut state = RunState::new(&header);
        sample::records(&header).iter().take(3).for_each(|record| state.apply(record));
        assert_eq!(atom_words(&state, 0, state.head()), "Atom 1: 1 traces it now");
        let later = state.head() + Duration::from_secs(3);
        assert_eq!(atom_words(&state, 8, later), "Atom 9: waits in the queue of 1, for 3.0 s now");
        state.apply(&Record { at: later, what: What::SpeedSet { node: 0, speed: 0.0 } });
        assert_eq!(atom_words(&state, 0, later), "Atom 1: 1 has begun it, but stands still");
        state.apply(&Record { at: later, what: What::Paused { node: 0 } });
        assert_eq!(atom_words(&state, 0, later), "Atom 1: 1 has begun it, but is paused");
    }

    #[test]
    fn messages_are_told_apart() {
        let header = sample::header(&[1.0, 1.0, 0.1], 300);
        let mut state = RunState::new(&header);
        let mut told = BTreeSet::new();
        for record in sample::records(&header) {
            state.apply(&record);
            told.extend(state.flights().iter().map(flight_words));
        }
        for part in ["100 atoms for 3, its band", "2 atoms that 2 has traced, for the parent", " atoms from 3 to "] {
            assert!(told.iter().any(|told| told.contains(part)), "{part}: {told:#?}");
        }
        assert!(told.contains("The offer of 1, on its way from 1 to 3"), "{told:#?}");
    }
}

//! Changes of a trial run in words, and names of trial runs.

use super::format::{TimeScale, count, duration, fraction, node_name, time_words};
use super::remedies::without;
use crate::balance::Scheduler;
use crate::balance::Strategy;
use crate::language::{Language, say, word};
use crate::sim::Change;

/// Describes a change in a few words.
pub fn change_words(change: &Change, language: Language) -> String {
    match *change {
        Change::Strategy(ref strategy) => Scheduler::Protocol(strategy.clone()).title(language).to_owned(),
        Change::Nodes(1) => word!(language, "1 machine", "1 máquina").to_owned(),
        Change::Nodes(nodes) => say!(language, "{nodes} machines", "{nodes} máquinas"),
        Change::Speed(node, speed) => {
            let (name, speed) = (node_name(node), fraction(speed));
            say!(language, "{name} at {speed}", "{name} a {speed}")
        }
        Change::SpeedAt(at, node, speed) => {
            let (at, name, speed) =
                (time_words(at, TimeScale::of_length(at), language), node_name(node), fraction(speed));
            say!(language, "{name} at {speed} from {at} on", "{name} a {speed} a partir de {at}")
        }
        Change::Without(remedy) => without(remedy, language),
        Change::Equal => word!(language, "all at 100 %", "todas a 100 %").to_owned(),
        Change::Atom(pixels) => {
            let pixels = count(pixels);
            say!(language, "atoms of {pixels} pixels", "átomos de {pixels} pixels")
        }
        Change::Latency(latency) if latency.is_zero() => {
            word!(language, "messages take no time", "mensagens instantâneas").to_owned()
        }
        Change::Latency(latency) => {
            let latency = duration(latency, language);
            say!(language, "{latency} a message", "{latency} por mensagem")
        }
        Change::OwnLatency(node, latency) if latency.is_zero() => {
            let name = node_name(node);
            say!(language, "messages of {name} take no time", "mensagens de {name} instantâneas")
        }
        Change::OwnLatency(node, latency) => {
            let (name, latency) = (node_name(node), duration(latency, language));
            say!(language, "{latency} a message of {name}", "{latency} por mensagem de {name}")
        }
        Change::Handling(handling) if handling.is_zero() => {
            word!(language, "the parent is never busy", "o pai nunca está ocupado").to_owned()
        }
        Change::Handling(handling) => {
            let handling = duration(handling, language);
            say!(language, "the parent takes {handling} a message", "o pai leva {handling} por mensagem")
        }
    }
}

/// Names a run after its strategy and its changes. Of several changes of one thing only the last is named.
pub fn trial_name(strategy: &Strategy, changes: &[Change], language: Language) -> String {
    let mut words = vec![Scheduler::Protocol(strategy.clone()).title(language).to_owned()];
    let is_later = |change: &Change, later: &[Change]| later.iter().any(|other| overrides(change, other));
    for (i, change) in changes.iter().enumerate() {
        if !matches!(change, Change::Strategy(_)) && !is_later(change, &changes[i + 1..]) {
            words.push(change_words(change, language));
        }
    }
    words.join(", ")
}

/// Whether the later change overrides the earlier one.
fn overrides(earlier: &Change, later: &Change) -> bool {
    match (earlier, later) {
        (Change::Speed(one, _), Change::Speed(other, _))
        | (Change::OwnLatency(one, _), Change::OwnLatency(other, _)) => one == other,
        (Change::Speed(..), Change::Equal) => true,
        (Change::Without(one), Change::Without(other)) => one == other,
        _ => std::mem::discriminant(earlier) == std::mem::discriminant(later) && !matches!(later, Change::SpeedAt(..)),
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::balance::Remedy;
    use crate::time::Time;

    #[test]
    fn run_is_named_after_its_last_changes() {
        let language = Language::English;
        let changes = [
            Change::Strategy(Strategy::Farm),
            Change::Speed(7, 0.05),
            Change::Latency(Duration::from_millis(200)),
            Change::Speed(7, 0.5),
            Change::Nodes(4),
            Change::SpeedAt(Time::from_secs(2.0), 1, 0.1),
        ];
        assert_eq!(
            trial_name(&Strategy::Farm, &changes, language),
            "Farm, 200 ms a message, 8 at 50 %, 4 machines, 2 at 10 % from 2.0 s on"
        );
        assert_eq!(
            trial_name(&Strategy::Ring, &[Change::Speed(1, 0.5), Change::Equal], language),
            "Ring, all at 100 %"
        );
        assert_eq!(trial_name(&Strategy::Ring, &[], language), "Ring");
        let far = [4, 3, 4].map(|node| Change::OwnLatency(node, Duration::from_millis(40 * u64::from(node))));
        assert_eq!(trial_name(&Strategy::Ring, &far, language), "Ring, 120 ms a message of 4, 160 ms a message of 5");
        let without = [Remedy::Wake, Remedy::Copies, Remedy::Wake].map(Change::Without);
        assert_eq!(
            trial_name(&Strategy::Adaptive, &without, language),
            "Adaptive ring, without copies, without waking"
        );
    }
}

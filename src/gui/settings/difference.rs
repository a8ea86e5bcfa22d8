//! A short text of what changed between two settings.

use super::Settings;
use crate::balance::Party;
use crate::language::{Language, comma, decimal, say, word};
use crate::picture::Quality;
use crate::runlog::Driver;
use crate::view::{fraction, remedies_words};

impl Settings {
    /// Lists the values that differ from `before`, separated by commas; empty if none differs.
    pub fn difference(&self, before: &Self, language: Language) -> String {
        let mut parts: Vec<String> = self.machines_difference(before, language).into_iter().collect();
        let mut add = |differs: bool, text: String| parts.extend(differs.then_some(text));
        let size = self.size;
        add(size != before.size, format!("{size} pixels"));
        quality_difference(self.quality, before.quality, &mut add, language);
        let atom = self.atom;
        add(atom != before.atom, say!(language, "atoms of {atom} pixels", "átomos de {atom} pixels"));
        let (scheduler, sharing_before) = (self.scheduler(), before.scheduler());
        add(scheduler != sharing_before, scheduler.title(language).to_lowercase());
        let virtual_time = self.driver == Driver::Sim;
        let time = if virtual_time {
            word!(language, "virtual time", "tempo virtual")
        } else {
            word!(language, "real time", "tempo real")
        };
        add(virtual_time != (before.driver == Driver::Sim), time.into());
        // A new strategy sets its usual part, which is not worth a word.
        let part = self.part;
        let part_text = if self.strategy.is_farm() {
            say!(language, "{part} atoms in a part", "{part} átomos por parte")
        } else {
            say!(language, "at least {part} atoms in a transfer", "ao menos {part} átomos por transferência")
        };
        add(scheduler == sharing_before && part != before.part, part_text);
        add(scheduler == sharing_before && self.remedies != before.remedies, remedies_words(self.remedies, language));
        add(self.pace != before.pace, self.pace.text(language));
        let [latency, handling] = [self.latency, self.handling].map(|ms| comma(language, ms.to_string()));
        add(self.latency != before.latency, say!(language, "{latency} ms a hop", "{latency} ms por salto"));
        add(
            self.handling != before.handling,
            say!(language, "the parent takes {handling} ms for a message", "o pai leva {handling} ms por mensagem"),
        );
        let bandwidth = match self.bandwidth {
            0 => word!(language, "links without a limit", "enlaces sem limite").into(),
            bandwidth => say!(language, "links of {bandwidth} kB/s", "enlaces de {bandwidth} kB/s"),
        };
        add(self.bandwidth != before.bandwidth, bandwidth);
        let wire = if self.shared_wire {
            word!(language, "one wire for all machines", "um cabo para todas as máquinas")
        } else {
            word!(language, "a wire for each pair of machines", "um cabo para cada par de máquinas")
        };
        add(self.shared_wire != before.shared_wire, wire.into());
        let own = self.parties().filter(|&of| self.own_link(of) != before.own_link(of)).collect::<Vec<_>>();
        add(!own.is_empty(), self.own_link_words(&own, language));
        parts.join(", ")
    }

    /// Describes what these parties have of their own.
    fn own_link_words(&self, parties: &[Party], language: Language) -> String {
        let [party] = *parties else {
            let count = parties.len();
            return say!(language, "new links of {count} machines", "novos enlaces de {count} máquinas");
        };
        let whose = match party {
            Party::Parent => word!(language, "the parent", "pai").to_owned(),
            Party::Node(node) => {
                let name = node + 1;
                say!(language, "machine {name}", "máquina {name}")
            }
        };
        let own = self.own_link(party);
        let latency = own.latency.map(|ms| format!("{ms} ms"));
        let bandwidth = own.bandwidth.map(|kilobytes| format!("{kilobytes} kB/s"));
        let values = latency.into_iter().chain(bandwidth).collect::<Vec<_>>().join(", ");
        match values.is_empty() {
            true => say!(language, "{whose} with a link like the others", "{whose} com um enlace como os outros"),
            false => say!(language, "{whose} with a link of {values}", "{whose} com um enlace de {values}"),
        }
    }

    /// Describes the difference of the machines: their number, or else their speeds.
    fn machines_difference(&self, before: &Self, language: Language) -> Option<String> {
        let (spares, nodes) = (self.spares.len(), self.speeds.len());
        if self.scheduler() == before.scheduler() && spares != before.spares.len() {
            return Some(match spares {
                0 => word!(language, "no spare machine", "nenhuma máquina de reserva").into(),
                1 => word!(language, "1 spare machine", "1 máquina de reserva").into(),
                _ => say!(language, "{spares} spare machines", "{spares} máquinas de reserva"),
            });
        }
        if nodes != before.speeds.len() {
            return Some(match nodes {
                1 => word!(language, "1 machine", "1 máquina").into(),
                _ => say!(language, "{nodes} machines", "{nodes} máquinas"),
            });
        }
        let speeds: Vec<f64> = self.all_speeds().collect();
        let other = |(node, (now, before)): (usize, (&f64, f64))| (*now != before).then_some(node);
        let changed: Vec<_> = speeds.iter().zip(before.all_speeds()).enumerate().filter_map(other).collect();
        match changed[..] {
            [] => None,
            [node] => {
                let (name, speed) = (node + 1, fraction(speeds[node]));
                Some(say!(language, "machine {name} at {speed}", "máquina {name} a {speed}"))
            }
            _ => {
                let count = changed.len();
                Some(say!(language, "new speeds for {count} machines", "novas velocidades de {count} máquinas"))
            }
        }
    }
}

/// Adds the parts of the picture's quality that differ.
fn quality_difference(quality: Quality, before: Quality, add: &mut impl FnMut(bool, String), language: Language) {
    let samples = quality.samples;
    let all = say!(language, "{samples} × {samples} samples a pixel", "{samples} × {samples} amostras por pixel");
    add(samples != before.samples, all);
    let least = comma(language, quality.threshold.to_string());
    let threshold = match quality.threshold {
        0.0 => word!(language, "all samples in every pixel", "todas as amostras em cada pixel").into(),
        _ => say!(language, "samples until the estimated error is {least}", "amostras até o erro estimado ser {least}"),
    };
    add(quality.threshold != before.threshold, threshold);
    let depth = quality.max_depth;
    add(depth != before.max_depth, say!(language, "{depth} levels of rays", "{depth} níveis de raios"));
    let cutoff = decimal(language, quality.cutoff, 4);
    add(
        quality.cutoff != before.cutoff,
        say!(language, "cutoff of weak rays {cutoff}", "limite de raios fracos {cutoff}"),
    );
}

//! What was changed, in words.

use super::Settings;
use super::pace::Pace;
use crate::language::{Language, comma, decimal, say, word};
use crate::picture::Quality;
use crate::runlog::Driver;
use crate::view::{fraction, remedies_words};

impl Settings {
    /// What these settings have that those `before` had not, in a few words.
    pub fn difference(&self, before: &Self, language: Language) -> String {
        let mut words: Vec<String> = self.other_machines(before, language).into_iter().collect();
        let mut tell = |differs: bool, text: String| words.extend(differs.then_some(text));
        let size = self.size;
        tell(size != before.size, format!("{size} pixels"));
        other_quality(self.quality, before.quality, &mut tell, language);
        let atom = self.atom;
        tell(atom != before.atom, say!(language, "atoms of {atom} pixels", "átomos de {atom} pixels"));
        let (sharing, before_it) = (self.sharing(), before.sharing());
        tell(sharing != before_it, sharing.name(language).to_lowercase());
        let virtual_time = self.driver == Driver::Sim;
        let time = if virtual_time {
            word!(language, "virtual time", "tempo virtual")
        } else {
            word!(language, "real time", "tempo real")
        };
        tell(virtual_time != (before.driver == Driver::Sim), time.into());
        // A strategy brings its usual part with it.
        let part = self.part;
        let parts = if self.strategy.is_farm() {
            say!(language, "{part} atoms in a part", "{part} átomos por parte")
        } else {
            say!(language, "{part} atoms in a transfer at least", "{part} átomos por transferência, no mínimo")
        };
        tell(sharing == before_it && part != before.part, parts);
        tell(sharing == before_it && self.remedies != before.remedies, remedies_words(self.remedies, language));
        tell(self.tempo != before.tempo, Pace::words(self.tempo, language));
        let (latency, handling) = (self.latency, self.handling);
        tell(latency != before.latency, say!(language, "{latency} ms a hop", "{latency} ms por salto"));
        tell(
            handling != before.handling,
            say!(language, "{handling} ms a message for the parent", "{handling} ms do pai por mensagem"),
        );
        let bandwidth = match self.bandwidth {
            0 => word!(language, "links of any speed", "enlaces sem limite").into(),
            bandwidth => say!(language, "links of {bandwidth} kB/s", "enlaces de {bandwidth} kB/s"),
        };
        tell(self.bandwidth != before.bandwidth, bandwidth);
        let wire = if self.shared_wire {
            word!(language, "one wire for all", "um cabo para todos")
        } else {
            word!(language, "a wire for each pair", "um cabo para cada par")
        };
        tell(self.shared_wire != before.shared_wire, wire.into());
        words.join(", ")
    }

    /// How many machines there are now, or which have other speeds.
    fn other_machines(&self, before: &Self, language: Language) -> Option<String> {
        let (spares, nodes) = (self.spares.len(), self.speeds.len());
        if self.sharing() == before.sharing() && spares != before.spares.len() {
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
                let many = changed.len();
                Some(say!(language, "other speeds for {many} machines", "outras velocidades de {many} máquinas"))
            }
        }
    }
}

fn other_quality(quality: Quality, before: Quality, tell: &mut impl FnMut(bool, String), language: Language) {
    let samples = quality.samples;
    let all = say!(language, "{samples} × {samples} samples a pixel", "{samples} × {samples} amostras por pixel");
    tell(samples != before.samples, all);
    let least = comma(language, quality.threshold.to_string());
    let threshold = match quality.threshold {
        0.0 => word!(language, "all samples for every pixel", "todas as amostras em todo pixel").into(),
        _ => say!(language, "samples until the estimated error is {least}", "amostras até o erro estimado ser {least}"),
    };
    tell(quality.threshold != before.threshold, threshold);
    let depth = quality.max_depth;
    tell(depth != before.max_depth, say!(language, "{depth} levels of rays", "{depth} níveis de raios"));
    let cutoff = decimal(language, quality.cutoff, 4);
    tell(
        quality.cutoff != before.cutoff,
        say!(language, "rays left out up to {cutoff}", "raios omitidos até {cutoff}"),
    );
}

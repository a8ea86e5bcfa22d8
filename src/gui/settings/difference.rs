//! What was changed, in words.

use super::Settings;
use super::pace::Pace;
use crate::language::{comma, decimal, say, word};
use crate::picture::Quality;
use crate::runlog::Driver;
use crate::view::{fraction, remedies_words};

impl Settings {
    /// What these settings have that those `before` had not, in a few words.
    pub fn difference(&self, before: &Self) -> String {
        let mut words: Vec<String> = self.other_machines(before).into_iter().collect();
        let mut tell = |differs: bool, text: String| words.extend(differs.then_some(text));
        let size = self.size;
        tell(size != before.size, format!("{size} pixels"));
        other_quality(self.quality, before.quality, &mut tell);
        let atom = self.atom;
        tell(atom != before.atom, say!("atoms of {atom} pixels", "átomos de {atom} pixels"));
        let (sharing, before_it) = (self.sharing(), before.sharing());
        tell(sharing != before_it, sharing.name().to_lowercase());
        let virtual_time = self.driver == Driver::Sim;
        let time = if virtual_time { word!("virtual time", "tempo virtual") } else { word!("real time", "tempo real") };
        tell(virtual_time != (before.driver == Driver::Sim), time.into());
        // A strategy brings its usual part with it.
        let part = self.part;
        let parts = if self.strategy.is_farm() {
            say!("{part} atoms in a part", "{part} átomos por parte")
        } else {
            say!("{part} atoms in a transfer at least", "{part} átomos por transferência, no mínimo")
        };
        tell(sharing == before_it && part != before.part, parts);
        tell(sharing == before_it && self.remedies != before.remedies, remedies_words(self.remedies));
        tell(self.tempo != before.tempo, Pace::words(self.tempo));
        let (latency, handling) = (self.latency, self.handling);
        tell(latency != before.latency, say!("{latency} ms a hop", "{latency} ms por salto"));
        tell(
            handling != before.handling,
            say!("{handling} ms a message for the parent", "{handling} ms do pai por mensagem"),
        );
        let bandwidth = match self.bandwidth {
            0 => word!("links of any speed", "enlaces sem limite").into(),
            bandwidth => say!("links of {bandwidth} kB/s", "enlaces de {bandwidth} kB/s"),
        };
        tell(self.bandwidth != before.bandwidth, bandwidth);
        let wire = if self.shared_wire {
            word!("one wire for all", "um cabo para todos")
        } else {
            word!("a wire for each pair", "um cabo para cada par")
        };
        tell(self.shared_wire != before.shared_wire, wire.into());
        words.join(", ")
    }

    /// How many machines there are now, or which have other speeds.
    fn other_machines(&self, before: &Self) -> Option<String> {
        let (spares, nodes) = (self.spares.len(), self.speeds.len());
        if self.sharing() == before.sharing() && spares != before.spares.len() {
            return Some(match spares {
                0 => word!("no spare machine", "nenhuma máquina de reserva").into(),
                1 => word!("1 spare machine", "1 máquina de reserva").into(),
                _ => say!("{spares} spare machines", "{spares} máquinas de reserva"),
            });
        }
        if nodes != before.speeds.len() {
            return Some(match nodes {
                1 => word!("1 machine", "1 máquina").into(),
                _ => say!("{nodes} machines", "{nodes} máquinas"),
            });
        }
        let speeds: Vec<f64> = self.all_speeds().collect();
        let other = |(node, (now, before)): (usize, (&f64, f64))| (*now != before).then_some(node);
        let changed: Vec<_> = speeds.iter().zip(before.all_speeds()).enumerate().filter_map(other).collect();
        match changed[..] {
            [] => None,
            [node] => {
                let (name, speed) = (node + 1, fraction(speeds[node]));
                Some(say!("machine {name} at {speed}", "máquina {name} a {speed}"))
            }
            _ => {
                let many = changed.len();
                Some(say!("other speeds for {many} machines", "outras velocidades de {many} máquinas"))
            }
        }
    }
}

fn other_quality(quality: Quality, before: Quality, tell: &mut impl FnMut(bool, String)) {
    let samples = quality.samples;
    let all = say!("{samples} × {samples} samples a pixel", "{samples} × {samples} amostras por pixel");
    tell(samples != before.samples, all);
    let least = comma(quality.threshold.to_string());
    let threshold = match quality.threshold {
        0.0 => word!("all samples for every pixel", "todas as amostras em todo pixel").into(),
        _ => say!("samples until the error is {least}", "amostras até o erro ser {least}"),
    };
    tell(quality.threshold != before.threshold, threshold);
    let depth = quality.max_depth;
    tell(depth != before.max_depth, say!("{depth} levels of rays", "{depth} níveis de raios"));
    let cutoff = decimal(quality.cutoff, 4);
    tell(quality.cutoff != before.cutoff, say!("rays left out up to {cutoff}", "raios omitidos até {cutoff}"));
}

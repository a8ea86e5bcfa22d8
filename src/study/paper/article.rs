//! The article's own figures.

use std::time::Duration;

use crate::balance::{Rules, Strategy};
use crate::runlog::{Header, LinkSettings, Metrics};

/// Time of one machine for the picture (Figure 6).
pub(super) const SERIAL_TIME: Duration = Duration::from_secs(580);

/// Time of the slow fifth machine for the picture (Figure 7).
pub(super) const SLOW_SERIAL_TIME: Duration = Duration::from_secs(6099);

/// Pixels in an atom (§9).
pub(super) const ATOM_PX: u32 = 50;

/// Machines, whether one of them is slow, and the seconds of farm ("dinâmica"), static bands and ring (Figures 6 and
/// 7).
const FIGURE_SECONDS: [(usize, bool, [f64; 3]); 4] = [
    (2, false, [369.0, 346.0, 300.0]),
    (3, false, [275.0, 230.0, 220.0]),
    (4, false, [229.0, 191.0, 164.0]),
    (5, true, [212.0, 1220.0, 157.0]),
];

/// A ring of four (Figures 8 and 9): tens of seconds, packets sent, mean atoms in a packet.
pub(super) const PACKETS: [(f64, f64, f64); 5] =
    [(16.0, 10.0, 35.0), (16.3, 8.0, 42.5), (16.4, 12.0, 30.666), (16.8, 13.0, 27.615), (18.3, 9.0, 13.333)];

/// Returns the slow machine's speed.
pub(super) fn slow_speed() -> f64 {
    SERIAL_TIME.div_duration_f64(SLOW_SERIAL_TIME)
}

/// Returns the article's makespan / ideal for a number of machines, of which the last may be slow; `None` where the
/// article has no figure.
pub fn over_ideal(strategy: &Strategy, nodes: usize, slow: bool) -> Option<f64> {
    let column = match strategy {
        Strategy::Farm => 0,
        Strategy::Static => 1,
        Strategy::Ring => 2,
        Strategy::Serial
        | Strategy::StaticEstimate
        | Strategy::FarmBySpeed
        | Strategy::FarmLeases
        | Strategy::Adaptive => return None,
    };
    let (.., seconds) = FIGURE_SECONDS.iter().find(|(count, with_slow, _)| (*count, *with_slow) == (nodes, slow))?;
    let speed = if slow { (nodes - 1) as f64 + slow_speed() } else { nodes as f64 };
    Some(seconds[column] * speed / SERIAL_TIME.as_secs_f64())
}

/// The modelled network: a shared Ethernet of 10 Mbit/s, of which 1 MB/s is left for payload; 2 ms a message; and a
/// parent that is busy for 15 ms with each message, PVM's daemons included.
pub(super) const NETWORK: Network = Network { latency: 2e-3, bandwidth: 1e6, handling: 15e-3 };

/// Costs of messages in seconds and bytes per second, on the scale on which one machine needs [`SERIAL_TIME`] for the
/// picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Network {
    pub latency: f64,
    pub bandwidth: f64,
    pub handling: f64,
}

impl Network {
    /// Puts a run on this network, with all times multiplied by `scale`.
    pub fn with(self, header: Header, scale: f64) -> Header {
        Header {
            link: LinkSettings {
                latency: Duration::from_secs_f64(self.latency * scale),
                bandwidth: Some(self.bandwidth / scale),
                shared: true,
                ..LinkSettings::default()
            },
            rules: Rules {
                beat: Rules::beat_for(Duration::from_secs_f64(self.handling * scale), header.speeds.len()),
                ..header.rules
            },
            handling: Duration::from_secs_f64(self.handling * scale),
            ..header
        }
    }

    /// Atoms in a part of the model's farm. With larger parts its parent has little to do, and the farm is as good as
    /// the ring.
    pub const PART: u32 = 1;
}

/// Makespan / ideal; NaN for a run that did not end.
pub(super) fn makespan_over_ideal(metrics: &Metrics) -> f64 {
    metrics.efficiency().map_or(f64::NAN, |efficiency| 1.0 / efficiency)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn article_ratios_match_its_tables() {
        let ratios = |strategy| {
            let of = |nodes, slow| over_ideal(strategy, nodes, slow).map(|ratio| (ratio * 1000.0).round() / 1000.0);
            [of(2, false), of(3, false), of(4, false), of(5, true)].map(Option::unwrap)
        };
        assert_eq!(ratios(&Strategy::Ring), [1.034, 1.138, 1.131, 1.109]);
        assert_eq!(ratios(&Strategy::Static), [1.193, 1.190, 1.317, 8.614]);
        assert_eq!(ratios(&Strategy::Farm), [1.272, 1.422, 1.579, 1.497]);
        assert_eq!(over_ideal(&Strategy::Ring, 5, false), None);
    }
}

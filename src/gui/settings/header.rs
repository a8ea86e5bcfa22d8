//! Conversion between settings and a run's header.

use std::time::Duration;

use super::pace::Pace;
use super::{OwnLinkSetting, Settings, milliseconds};
use crate::balance::{NodeId, Rules, Scheduler, Strategy};
use crate::driver::auto_pace;
use crate::runlog::{Driver, Header, LinkSettings, Metadata, OwnLink};

impl Settings {
    /// Returns the header of a run with these settings. `name` and `text` are the scene's; `work` is the time of the
    /// whole picture on the reference machine at full pace; `cores` is the number of this computer's cores.
    pub fn header(&self, name: &str, text: &str, work: Duration, cores: usize) -> Header {
        let handling = milliseconds(self.handling);
        let speeds: Vec<f64> = self.all_speeds().collect();
        Header {
            scene: name.to_owned(),
            scene_text: text.to_owned(),
            size: self.size,
            quality: self.quality,
            division: self.division(),
            driver: self.driver,
            rules: Rules {
                strategy: self.strategy.clone(),
                part: self.part,
                batch: Some(Rules::batch_for(handling, speeds.len())),
                beat: Rules::beat_for(handling, speeds.len()),
                remedies: self.remedies,
            },
            spares: self.spares.len() as NodeId,
            pace: self.pace_fraction(work, cores),
            link: LinkSettings {
                latency: self.latency_time(),
                bandwidth: (self.bandwidth > 0).then(|| f64::from(self.bandwidth) * 1e3),
                shared: self.shared_wire,
                nodes: self.own_links.iter().take(speeds.len()).map(|own| own_link(*own)).collect(),
                parent: own_link(self.parent_link),
            },
            handling,
            cores: if self.driver == Driver::Sim { speeds.len() } else { cores },
            speeds,
            // A run in virtual time is the same on every computer.
            caption: if self.driver == Driver::Sim { Metadata::default() } else { Metadata::here(cores) },
        }
    }

    /// Returns settings for a run like that of this header; `pace` is used if its pace was not full. The window does
    /// not offer two threads a node, so these become one.
    pub fn of(header: &Header, pace: Pace) -> Self {
        let own = header.speeds.len().saturating_sub(header.spares.into());
        let (speeds, spares) = header.speeds.split_at(own);
        Self {
            size: header.size,
            quality: header.quality,
            atom: header.division.atom_pixels(),
            driver: if header.driver == Driver::Pairs { Driver::Threads } else { header.driver },
            strategy: header.rules.strategy.clone(),
            part: header.rules.part,
            pace: if header.pace < 1.0 { pace } else { Pace::Full },
            speeds: speeds.to_vec(),
            spares: spares.to_vec(),
            remedies: header.rules.remedies,
            latency: millis(header.link.latency),
            handling: millis(header.handling),
            // 0 means no limit.
            bandwidth: header.link.bandwidth.map_or(0, kilobytes),
            shared_wire: header.link.shared,
            own_links: header.link.nodes.iter().map(|own| own_setting(*own)).collect(),
            parent_link: own_setting(header.link.parent),
            ..Self::default()
        }
    }

    /// Returns the fraction of a real core that the reference machine gets.
    pub(super) fn pace_fraction(&self, work: Duration, cores: usize) -> f64 {
        // The sum of all speeds is the power of a ring that shares perfectly. Other strategies take longer, which is
        // the point of the demonstration; only the serial run, which uses one machine, gets its own sum.
        let speeds =
            if self.scheduler() == Scheduler::Protocol(Strategy::Serial) { &self.speeds[..1] } else { &self.speeds };
        let all: Vec<f64> = self.all_speeds().collect();
        let max = if self.driver == Driver::Sim { 1.0 } else { auto_pace(&all, cores) };
        self.pace.fraction(work, speeds.iter().sum(), max)
    }
}

/// Converts a time to milliseconds, to the nanosecond, the unit of the header.
fn millis(time: Duration) -> f64 {
    (time.as_secs_f64() * 1e9).round() / 1e6
}

/// Converts a bandwidth to kB/s, at least 1.
fn kilobytes(bandwidth: f64) -> u32 {
    (bandwidth * 1e-3).ceil().max(1.0) as u32
}

fn own_link(own: OwnLinkSetting) -> OwnLink {
    OwnLink {
        latency: own.latency.map(milliseconds),
        bandwidth: own.bandwidth.map(|kilobytes| f64::from(kilobytes) * 1e3),
    }
}

fn own_setting(own: OwnLink) -> OwnLinkSetting {
    OwnLinkSetting { latency: own.latency.map(millis), bandwidth: own.bandwidth.map(kilobytes) }
}

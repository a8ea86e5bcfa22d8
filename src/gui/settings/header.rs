//! What a run with these settings is asked to do, and which settings a run may have had.

use std::time::Duration;

use super::Settings;
use super::pace::Pace;
use crate::balance::{NodeId, Rules, Strategy};
use crate::driver::auto_pace;
use crate::runlog::{Driver, Header, LinkSettings, Metadata};
use crate::view::Sharing;

impl Settings {
    /// What a run with these settings is asked to do. The scene has a `name` and its file's `text`, `work` is the time of
    /// the whole picture on the reference machine at full pace, `cores` are those of this computer.
    pub fn header(&self, name: &str, text: &str, work: Duration, cores: usize) -> Header {
        let handling = Duration::from_millis(self.handling.into());
        let speeds: Vec<f64> = self.all_speeds().collect();
        Header {
            scene: name.to_owned(),
            scene_text: text.to_owned(),
            size: self.size,
            quality: self.quality,
            division: self.division(),
            driver: self.driver,
            rules: Rules {
                strategy: self.strategy,
                part: self.part,
                batch: Some(Rules::batch_for(handling, speeds.len())),
                beat: Rules::beat_for(handling, speeds.len()),
                remedies: self.remedies,
            },
            spares: self.spares.len() as NodeId,
            pace: self.pace(work, cores),
            link: LinkSettings {
                latency: self.latency_time(),
                bandwidth: (self.bandwidth > 0).then(|| f64::from(self.bandwidth) * 1e3),
                shared: self.shared_wire,
            },
            handling,
            cores: if self.driver == Driver::Sim { speeds.len() } else { cores },
            speeds,
            // A run in virtual time is the same on every computer.
            caption: if self.driver == Driver::Sim { Metadata::default() } else { Metadata::here(cores) },
        }
    }

    /// The settings that a run with this header may have had. Two threads a node are not offered here: one does the same.
    pub fn of(header: &Header, tempo: Pace) -> Self {
        let millis = |time: Duration| u32::try_from(time.as_millis()).unwrap_or(u32::MAX);
        let own = header.speeds.len().saturating_sub(header.spares.into());
        let (speeds, spares) = header.speeds.split_at(own);
        Self {
            size: header.size,
            quality: header.quality,
            atom: header.division.atom_pixels(),
            driver: if header.driver == Driver::Pairs { Driver::Threads } else { header.driver },
            strategy: header.rules.strategy,
            part: header.rules.part,
            tempo: if header.pace < 1.0 { tempo } else { Pace::Full },
            speeds: speeds.to_vec(),
            spares: spares.to_vec(),
            remedies: header.rules.remedies,
            latency: millis(header.link.latency),
            handling: millis(header.handling),
            // A limit stays one, however low.
            bandwidth: header.link.bandwidth.map_or(0, |bandwidth| (bandwidth * 1e-3).ceil().max(1.0) as u32),
            shared_wire: header.link.shared,
            ..Self::default()
        }
    }

    pub(super) fn pace(&self, work: Duration, cores: usize) -> f64 {
        // Machines that share badly take longer than those in a ring: that is to be seen.
        let speeds = if self.sharing() == Sharing::By(Strategy::Serial) { &self.speeds[..1] } else { &self.speeds };
        let all: Vec<f64> = self.all_speeds().collect();
        let most = if self.driver == Driver::Sim { 1.0 } else { auto_pace(&all, cores) };
        self.tempo.pace(work, speeds.iter().sum(), most)
    }
}

//! The picture of a run in the colours of its machines or of its costs, as Save in the window writes it.

use std::path::{Path, PathBuf};

use super::Failure;
use crate::palette::node_colours;
use crate::picture::{Frame, write_png};
use crate::runlog::RunLog;
use crate::view::{Layer, RunState, picture_pixels};

/// The pictures in false colours that a command writes.
#[derive(Clone, Debug, Default, clap::Args)]
pub(super) struct LayerArgs {
    /// Save the picture in the colours of the nodes that traced it
    #[arg(long, value_name = "FILE.png")]
    pub owners_png: Option<PathBuf>,
    /// Save the picture in the colours of the atoms' costs
    #[arg(long, value_name = "FILE.png")]
    pub costs_png: Option<PathBuf>,
}

impl LayerArgs {
    /// Returns the files to write.
    pub fn outputs(&self) -> impl Iterator<Item = &Path> {
        [&self.owners_png, &self.costs_png].into_iter().flatten().map(|path| &**path)
    }

    /// Writes the pictures of a run, whose render is `frame`.
    pub fn write(&self, log: &RunLog, frame: &Frame) -> Result<(), Failure> {
        if self.outputs().next().is_none() {
            return Ok(());
        }
        let mut state = RunState::new(&log.header);
        log.records().iter().for_each(|record| state.apply(record));
        let colours = node_colours(log.header.speeds.len());
        for (path, layer) in [(&self.owners_png, Layer::Owners), (&self.costs_png, Layer::Costs)] {
            let Some(path) = path else { continue };
            let pixels = picture_pixels(frame, &state, &colours, (layer, 1.0));
            write_png(path, frame.size(), &pixels).map_err(|error| Failure::Failed(error.to_string()))?;
        }
        Ok(())
    }
}

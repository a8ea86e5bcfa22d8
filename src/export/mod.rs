//! Files for other programs: a scene for another renderer, drawings for paper and slides, animations, and records.

mod animation;
mod chrome;
mod comparison;
mod csv;
mod drawing;
mod error;
mod film;
mod frame_palette;
mod hatch;
mod pov;
mod raster;
mod svg;

pub use chrome::write_chrome;
pub use comparison::{Comparison, ComparisonEntry};
pub use csv::write_csv;
pub use drawing::Drawing;
pub use error::ExportError;
pub use film::Film;
pub use pov::{PovLimit, PovScene, to_pov};
pub use raster::Raster;
pub use svg::{to_hatched_svg, to_svg};

use crate::balance::Party;
use crate::view::node_name;

/// Names a party in files for other programs: `parent`, or a machine's number from 1.
fn party_name(party: Party) -> String {
    match party {
        Party::Parent => "parent".into(),
        Party::Node(node) => node_name(node).to_string(),
    }
}

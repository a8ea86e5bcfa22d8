//! Files for other programs: a scene for another renderer, drawings for paper and slides, animations, and records.

mod animation;
mod chrome;
mod colours;
mod comparison;
mod csv;
mod drawing;
mod error;
mod film;
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
pub use pov::to_pov;
pub use raster::Raster;
pub use svg::{to_hatched_svg, to_svg};

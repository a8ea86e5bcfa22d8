//! The picture: its size and quality, its regions, its division into atoms and bands, its frame in linear light, its
//! transparency, its PNG, and the difference between two pictures.

mod compare;
mod coverage;
mod division;
mod frame;
mod png;
mod quality;
mod region;
mod size;

pub use compare::{Difference, max_channel_difference};
pub use coverage::{Coverage, srgba8};
pub use division::{Atom, Division, atoms_in, push_atom};
pub use frame::{Colour, Frame, srgb8};
pub use png::{encode_png, write_png, write_png_with_alpha};
pub use quality::{Quality, QualityError};
pub use region::{Region, RegionError};
pub use size::{Size, SizeError};

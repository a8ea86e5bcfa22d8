//! The picture: its size and quality, its division into atoms and bands, its frame in linear light, its PNG, and the
//! difference between two pictures.

mod compare;
mod division;
mod frame;
mod png;
mod quality;
mod size;

pub use compare::{Difference, max_channel_difference};
pub use division::{Atom, Division, atoms_in, push_atom};
pub use frame::{Colour, Frame, srgb8};
pub use png::{encode_png, write_png};
pub use quality::{Quality, QualityError};
pub use size::{Size, SizeError};

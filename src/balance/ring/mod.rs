#![doc = include_str!("README.md")]

mod node;
mod share;

pub use node::RingNode;
pub use share::share;

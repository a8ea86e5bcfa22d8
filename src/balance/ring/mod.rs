#![doc = include_str!("README.md")]

mod node;
mod share;

pub use node::Node;
pub use share::share;

#![doc = include_str!("README.md")]

mod helping;
mod node;
mod offering;
mod route;
mod share;
mod sleepers;
mod speed_estimate;
mod timers;

pub use node::Node;
pub use route::Ring;
pub use share::share_by_speed;

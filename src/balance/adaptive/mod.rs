#![doc = include_str!("README.md")]

mod helping;
mod node;
mod offering;
mod route;
mod share;
mod sleepers;
mod speed_estimate;
mod timers;

pub use node::AdaptiveNode;
pub use route::RingMembers;
pub use share::share_by_speed;

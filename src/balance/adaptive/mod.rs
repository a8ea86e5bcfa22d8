#![doc = include_str!("README.md")]

mod admission;
mod copies;
mod heartbeat;
mod helping;
mod node;
mod offering;
mod own_offer;
mod route;
mod share;
mod sleep_notice;
mod sleepers;
mod speed_estimate;
mod timers;

pub use node::AdaptiveNode;
pub use route::RingMembers;
pub use share::share_by_speed;

#![doc = include_str!("README.md")]

mod copies;
mod helping;
mod node;
mod offering;
mod own_offer;
mod route;
mod share;
mod sleep_notice;
mod sleepers;
mod timers;

pub use node::AdaptiveNode;
pub use route::RingMembers;
pub use share::share_by_speed;

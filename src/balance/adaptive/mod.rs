#![doc = include_str!("README.md")]

mod duties;
mod gauge;
mod helping;
mod node;
mod offering;
mod route;
mod share;
mod sleepers;

pub use node::Node;
pub use route::Ring;
pub use share::share_by_speed;

#![doc = include_str!("README.md")]

mod lessor;
mod node;

pub(super) use lessor::Lessor;
pub(super) use node::LeasedFarmNode;

//! The protocol that shares atoms among nodes. It does no I/O: it uses no thread, clock, channel or colour.
//!
//! The parties are one [`Parent`] and its nodes. A driver hands a party an [`Event`] and the time; the party answers
//! with [`Action`]s, which the driver executes. The [`Strategy`] decides how nodes answer.

pub mod adaptive;
mod admission;
mod condition;
pub mod estimate;
mod farm;
pub mod farm_leases;
mod heartbeat;
mod leases;
mod ledger;
mod message;
mod parent;
mod queue;
mod remedy;
pub mod ring;
mod scheduler;
mod speed_estimate;
mod static_node;
mod strategy;
mod work;

pub use condition::{Condition, Transition};
pub use message::{Action, Event, Message, NodeId, OfferDetails, Party};
pub use parent::Parent;
pub use remedy::{Remedies, Remedy, UnknownRemedy};
pub use scheduler::{Scheduler, UnknownScheduler};
pub use strategy::{Node, Rules, Strategy, UnknownStrategy};
pub use work::PIPE_ATOMS;

//! How atoms are shared among nodes, as a protocol that touches no thread, clock, channel or colour.
//!
//! A party is handed an [`Event`] and the time, and answers with [`Action`]s; a driver carries them out. The
//! parties are one [`Parent`] and its nodes; what a node does is its [`Strategy`].

pub mod adaptive;
mod condition;
pub mod estimate;
mod farm;
mod ledger;
mod message;
mod parent;
mod queue;
mod remedy;
pub mod ring;
mod static_node;
mod strategy;
mod work;

pub use condition::{Condition, Transition};
pub use message::{Action, Event, OfferDetails, Message, NodeId, Party};
pub use parent::Parent;
pub use remedy::{Remedies, Remedy};
pub use strategy::{Node, Rules, Strategy};
pub use work::PIPE_ATOMS;

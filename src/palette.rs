//! The nodes' colours.

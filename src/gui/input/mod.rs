//! Keys, context menus and the selection.

pub mod keys;
pub mod machine_menu;
pub mod message_menu;
pub mod rate_menu;
pub mod selection;
pub mod speed_slider;
pub mod tab_order;
pub mod zoom;

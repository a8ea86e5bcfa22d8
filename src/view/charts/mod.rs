//! Charts of measurements as display lists.

pub mod axis;
pub mod bar_chart;
pub mod frame;
pub mod line_chart;
pub mod time_budget_chart;
pub mod tradeoff;

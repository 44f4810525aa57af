//! Diagrams, laid out: from what is drawn to places of lines and texts, as numbers. What is drawn is decided in `tables`; templates write
//! the numbers down as SVG.

pub(crate) mod axis;
pub(crate) mod flow;
pub(crate) mod hysteresis;
pub(crate) mod label;
pub(crate) mod machine;
pub(crate) mod timing;

//! The formats that tools read, as bytes: EDS and DCF, XDD and XDC, concise DCF, DBC, and the resolved model as JSON; and the findings of a check.

mod artifacts;
pub mod boot;
pub mod concise;
pub mod dbc;
pub mod eds;
pub mod findings;
mod hexadecimal;
pub mod json;
pub mod nmt;
pub mod xdd;

pub use artifacts::{Selection, artifacts};

//! Checked access to the values of a dictionary, with the abort codes of CiA 301.

pub(crate) mod application;
mod check;
pub(crate) mod command;
pub(crate) mod communication;
pub(crate) mod constraint;
mod corrected;
pub(crate) mod dictionary;
pub(crate) mod parameters;
#[cfg(feature = "critical-section")]
pub(crate) mod shared;
pub(crate) mod table_dictionary;
#[cfg(test)]
pub(crate) mod test_table;

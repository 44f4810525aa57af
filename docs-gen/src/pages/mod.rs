//! What is on the pages: devices, chapters of the manual, appendices and warnings.

pub(crate) mod appendix;
mod chapters;
mod device;
mod groups;
mod notation;
mod questions;
mod warnings;
mod workbench;

//! Generators: from the resolved model to the files that tools and people use.
//!
//! Every backend is a pure function from the model to bytes, so that the same specification gives the same files on every
//! machine. Files are written in one place, [`files`]: each whole, and only what differs.

mod artifact;
#[cfg(all(feature = "eds", feature = "json"))]
mod artifacts;
#[cfg(feature = "eds")]
pub mod boot;
#[cfg(feature = "format")]
mod builder;
#[cfg(feature = "c")]
pub mod c;
#[cfg(feature = "runtime")]
pub mod client;
#[cfg(feature = "eds")]
pub mod concise;
#[cfg(feature = "dbc")]
pub mod dbc;
#[cfg(feature = "diff")]
pub mod diff;
#[cfg(feature = "docs")]
pub mod docs;
#[cfg(feature = "eds")]
pub mod eds;
mod expand;
mod facts;
pub mod files;
mod foreign;
#[cfg(any(feature = "eds", feature = "json"))]
mod hexadecimal;
#[cfg(feature = "yaml")]
pub mod import;
#[cfg(feature = "json")]
pub mod json;
#[cfg(feature = "lsp")]
pub mod line_diff;
#[cfg(feature = "lsp")]
pub mod lsp;
#[cfg(feature = "runtime")]
pub mod monitor;
#[cfg(any(feature = "dbc", feature = "runtime"))]
mod nmt;
#[cfg(feature = "yaml")]
pub mod parameters;
mod plan;
#[cfg(feature = "plant")]
pub mod plant;
mod provenance;
#[cfg(feature = "runtime")]
pub mod runtime;
pub mod rust;
#[cfg(feature = "runtime")]
pub mod slcan;
#[cfg(all(feature = "links", target_os = "linux"))]
pub mod socketcan;
pub mod source;
#[cfg(feature = "st")]
pub mod st;
#[cfg(feature = "runtime")]
pub mod trace;
#[cfg(feature = "xdd")]
pub mod xdd;
#[cfg(feature = "yaml")]
pub mod yaml;

pub use artifact::{Artifact, OutputFile, Pool, SharedFile};
#[cfg(all(feature = "eds", feature = "json"))]
pub use artifacts::{Selection, artifacts};
#[cfg(feature = "format")]
pub use builder::{BuildError, Builder};
pub use expand::{Expansion, expand};
pub use foreign::{condense, condensed};
pub use provenance::Provenance;

/// The README's examples compile and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

//! Generators: from the resolved model to the files that tools and people use.
//!
//! Here is what a build script and the macro need: the [`plan`] of a device's code, the [`rust`] that prints it, and the
//! [`Builder`]. The other backends are crates of their own, next to this one. Every backend is a pure function from the model
//! to bytes, so that the same specification gives the same files on every machine. Files are written in one place, [`files`]:
//! each as a whole, and only what differs.

mod artifact;
#[cfg(feature = "format")]
mod builder;
mod expand;
pub mod facts;
pub mod files;
mod foreign;
pub mod plan;
mod provenance;
pub mod rust;
pub mod source;

pub use artifact::{Artifact, OutputFile, Pool, SharedFile};
#[cfg(feature = "format")]
pub use builder::{BuildError, Builder};
pub use expand::{Expansion, expand};
pub use foreign::{CHECK, condense, condensed};
pub use provenance::Provenance;

/// The README's examples compile and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

//! Typed `no_std` Rust for CANopen object dictionaries, generated from their specification.
//!
//! # In a build script
//!
//! ```no_run
//! // build.rs
//! od_gen::Builder::new("lamp.od.yaml").device("lamp").generate();
//! ```
//!
//! The crate then includes the module, and calls it with the crate `firmware-glue`:
//!
//! ```text
//! mod lamp {
//!     include!(concat!(env!("OUT_DIR"), "/lamp.rs"));
//! }
//! ```
//!
//! `Builder` reports mistakes of the specification as errors of the build, with their places. Cargo runs the script
//! again only when a file that it read has changed. The macro `object_dictionary!` of the crate `od-macros` gives
//! the same module without a build script. The same steps in a program of its own:
//!
//! ```
//! let directory = std::env::temp_dir().join(format!("od-gen-lamp-{}", std::process::id()));
//! std::fs::create_dir_all(&directory)?;
//! let specification = directory.join("lamp.od.yaml");
//! std::fs::write(&specification, "
//! od-spec: 1
//! title: Lamp
//! uses: [cia301]
//! devices:
//!   lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}
//! objects:
//!   0x2000: {name: brightness, type: unsigned8, access: rw, default: 80, max: 100}
//! ")?;
//! let modules = od_gen::Builder::new(&specification).out_dir(&directory).try_generate()?;
//! assert!(std::fs::read_to_string(&modules[0])?.contains("pub fn brightness"));
//! # std::fs::remove_dir_all(&directory)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # In a generator
//!
//! [`plan`] decides names and places of a device's code, and [`rust`] prints it. The other outputs are crates of their
//! own (`od-formats`, `od-c`, `od-st`, `od-docs`) that use the same plan. Every backend is a pure function from the
//! model of `od-spec` to bytes, so the same specification gives the same files on every machine. [`files`] writes them:
//! each as a whole, and only what differs.
//!
//! # Features
//!
//! - `format`: generated Rust as files that are laid out for people, as the command `odgen build --rust` writes them

#![cfg_attr(docsrs, feature(doc_cfg))]

mod artifact;
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
pub use builder::{BuildError, Builder};
pub use expand::{Expansion, expand};
pub use foreign::{CHECK, condense, condensed};
pub use provenance::Provenance;

/// The README's examples compile and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

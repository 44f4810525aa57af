//! What the shipped specifications produce: the object dictionaries of the OAT Pitch Control System and of the Fullmo drive
//! as Rust modules.
//!
//! The modules are generated and checked in, so that they can be read and reviewed; `cargo xtask generate` makes them anew,
//! and a test compares. `eds/` beside them holds the EDS and DCF files of the same devices.

#![no_std]

// The generator's own layout is kept: it is what every build gives, on any machine.

/// Pitch Management Module (PMM): supply, battery, booster and brake chopper.
#[rustfmt::skip]
pub mod pmm;

/// Pitch Motion Controller (PMC): the axis controller.
#[rustfmt::skip]
pub mod pmc;

/// The drive of Fullmo GmbH after CiA 402.
#[rustfmt::skip]
pub mod fullmo;

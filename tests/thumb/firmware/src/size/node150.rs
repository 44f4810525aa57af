//! A whole node with the scaled model of 150 objects, and the services that it has objects for: SDO server, PDOs, NMT, heartbeat.
#![no_std]
#![no_main]

use thumb_scaled::scaled150::Controller as Device;

/// Nothing is stored, nothing is asked.
type Drive = ();

const DRIVE: Drive = ();

#[path = "../shared/node.rs"]
mod program;

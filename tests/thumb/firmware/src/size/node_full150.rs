//! A whole node with the scaled model of 150 objects and the objects of all services: SDO server, PDOs and SYNC, NMT, heartbeats sent and
//! watched, guarding, emergencies with their history, those of others, LSS.
#![no_std]
#![no_main]

use thumb_scaled::full150::Controller as Device;

/// Nothing is stored, nothing is asked.
type Drive = ();

const DRIVE: Drive = ();

#[path = "../shared/node.rs"]
mod program;

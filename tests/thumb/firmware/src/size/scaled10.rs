//! Serves the scaled model of 10 objects.
#![no_std]
#![no_main]

use thumb_scaled::scaled10 as model;

#[path = "../shared/scaled.rs"]
mod program;

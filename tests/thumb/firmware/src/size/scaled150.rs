//! Serves the scaled model of 150 objects.
#![no_std]
#![no_main]

use thumb_scaled::scaled150 as model;

#[path = "../shared/scaled.rs"]
mod program;

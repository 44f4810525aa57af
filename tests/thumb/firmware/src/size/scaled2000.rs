//! Serves the scaled model of 2000 objects.
#![no_std]
#![no_main]

use thumb_scaled::scaled2000 as model;

#[path = "../shared/scaled.rs"]
mod program;

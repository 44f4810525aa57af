//! Holds what the shipped specifications produce: `eds/`, `dcf/` and `json/` beside this crate; typed Rust comes with its backend.
#![no_std]

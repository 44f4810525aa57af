//! C for CANopenNode, compiled against a header of our own and compared with the JSON dump: what every entry is and holds, and how every access ends.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

mod accesses;
mod complaints;
mod entries;
mod extension;
mod groups;
mod project;

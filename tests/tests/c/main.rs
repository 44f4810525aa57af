//! Generated C: it compiles, and does what the specification says.

mod canopennode;
mod dictionary;
mod names;

//! Generated Rust: it compiles without a warning, and does what the specification says.

mod access;
mod architecture;
mod book;
mod dictionary;
mod doors;
mod download;
mod error_codes;
mod generated_rust;
mod mutants;
mod names;
mod nasty;
mod pdos_in_full;
mod physical;
mod release;
mod runs;
mod state_machines;

#[allow(
    clippy::all,
    clippy::pedantic,
    reason = "what users' lints say about generated code is tested with od-generated"
)]
mod everything {
    od_macros::object_dictionary!("readers/everything.od.yaml");
}

//! Nodes on a bus, and dictionaries that are made at run time.

mod demo_slcan;
mod host_node;
mod live_dictionary;
mod run_time_table;
mod sdo;
mod sdo_client;
mod sdo_server;
mod table_faults;
mod trace;

#[path = "../../shared/node.rs"]
mod node;

#[allow(
    clippy::all,
    clippy::pedantic,
    reason = "what users' lints say about generated code is tested with od-generated"
)]
mod everything {
    od_macros::object_dictionary!("readers/everything.od.yaml");
}

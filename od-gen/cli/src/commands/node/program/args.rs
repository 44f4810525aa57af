//! Arguments of `odgen node program`.

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;

use super::super::args::{OneNodeArgs, duration};
use super::super::confirm::ConfirmArgs;

#[derive(Debug, Args)]
pub(crate) struct NodeProgramArgs {
    /// Specification, EDS, DCF, XDD or XDC of the node's device; or a plant file, with all nodes of a machine
    pub spec: PathBuf,

    #[command(flatten)]
    pub node: OneNodeArgs,

    /// The program, byte for byte as the device takes it
    pub file: PathBuf,

    /// Which program of the device: the sub-index of 1F50h
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u8).range(1..=254))]
    pub program: u8,

    /// Seconds that the node may need to delete, write or start a program
    #[arg(long, value_name = "SECONDS", default_value = "30", value_parser = duration)]
    pub patience: Duration,

    #[command(flatten)]
    pub confirm: ConfirmArgs,
}

//! Arguments of `odgen dbc`.

use std::path::PathBuf;

use clap::Args;

use super::{Messages, NodesArgs};

#[derive(Debug, Args)]
pub(crate) struct DbcArgs {
    #[command(flatten)]
    pub nodes: NodesArgs,

    /// The file [default: `KEY-N.dbc` of the only node, and `bus.dbc` of several]
    #[arg(long, short, value_name = "FILE")]
    pub out: Option<PathBuf>,

    /// Replace a file of this name that odgen did not make
    #[arg(long)]
    pub force: bool,

    #[command(flatten)]
    pub messages: Messages,
}

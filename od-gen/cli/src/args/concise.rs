//! Arguments of the commands about concise DCFs.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};

#[derive(Debug, Args)]
pub(crate) struct ConciseArgs {
    #[command(subcommand)]
    pub command: ConciseCommand,
}

#[derive(Debug, Subcommand)]
pub(crate) enum ConciseCommand {
    /// List the records in their order: entry, name, bytes, value in its unit or by its name, and what the device refuses
    Show(ConciseShowArgs),
}

#[derive(Debug, Args)]
pub(crate) struct ConciseShowArgs {
    /// The concise DCF
    pub file: PathBuf,

    /// The specification, EDS, DCF, XDD or XDC of the node's device [default: the only `*.od.yaml` of the current directory]
    pub spec: Option<PathBuf>,

    /// Key of the device [default: the only one]
    #[arg(long, value_name = "KEY")]
    pub device: Option<String>,

    /// Node-ID, 1 to 127, to recognise defaults that depend on it [default: of a DCF its own]
    #[arg(long, value_name = "ID")]
    pub node: Option<String>,

    /// How the records are written
    #[arg(long, value_enum, default_value_t)]
    pub format: ConciseFormat,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum ConciseFormat {
    /// For people, a line for each record
    #[default]
    Human,
    /// One JSON object
    Json,
    /// The values that they leave in the node, as `odgen dcf --set-file` takes them
    Settings,
}

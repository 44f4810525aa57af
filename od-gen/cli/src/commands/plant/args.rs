//! Arguments of the commands about plants.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};

use crate::messages::{Format, Messages};

#[derive(Debug, Args)]
pub(crate) struct PlantArgs {
    #[command(subcommand)]
    pub command: PlantCommand,
}

#[derive(Debug, Subcommand)]
pub(crate) enum PlantCommand {
    /// Make the files of all nodes: DCF, concise DCF, the list of nodes of each bus, and what differs where; an error writes none of them
    Build(PlantBuildArgs),
    /// Check a plant without writing anything
    Check(PlantCheckArgs),
    /// Show what nodes are set to, and which level says so
    Show(PlantShowArgs),
}

impl PlantCommand {
    /// How messages are written, where that is said after the command.
    pub(crate) const fn message_format(&self) -> Option<Format> {
        match self {
            Self::Build(args) => args.messages.format,
            Self::Check(args) => args.messages.format,
            Self::Show(_) => None,
        }
    }
}

#[derive(Debug, Args)]
pub(crate) struct PlantBuildArgs {
    /// The plant file
    pub plant: PathBuf,

    /// Directory for the files
    #[arg(long, short, default_value = "plant", value_name = "DIR")]
    pub out: PathBuf,

    /// Remove files of nodes and machines that are no longer in the plant
    #[arg(long)]
    pub prune: bool,

    /// Replace files of these names that odgen did not make
    #[arg(long)]
    pub force: bool,

    #[command(flatten)]
    pub messages: Messages,
}

#[derive(Debug, Args)]
pub(crate) struct PlantCheckArgs {
    /// The plant file
    pub plant: PathBuf,

    #[command(flatten)]
    pub messages: Messages,
}

#[derive(Debug, Args)]
pub(crate) struct PlantShowArgs {
    /// The plant file
    pub plant: PathBuf,

    /// Only this site
    #[arg(long, value_name = "NAME")]
    pub site: Option<String>,

    /// Only this machine, by name or number
    #[arg(long, value_name = "NAME")]
    pub machine: Option<String>,

    /// Only this position
    #[arg(long, value_name = "NAME")]
    pub position: Option<String>,

    /// Only this device
    #[arg(long, value_name = "KEY")]
    pub device: Option<String>,

    /// Only this entry, by name or index, also where no level sets it
    #[arg(long, value_name = "ENTRY")]
    pub entry: Option<String>,

    /// How the values are written
    #[arg(long, value_enum, default_value_t)]
    pub format: ShowFormat,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum ShowFormat {
    /// For people
    #[default]
    Human,
    /// One JSON object
    Json,
}

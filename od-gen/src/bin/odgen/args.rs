//! The command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use od_spec::diag::render;

/// Checks specifications of CANopen object dictionaries and makes EDS, DCF, JSON and Rust files from them.
#[derive(Debug, Parser)]
#[command(
    name = "odgen",
    version,
    after_help = "Exit codes: 0 fine, 1 errors in the input or output not written, 2 wrong command line.\n\
                  `odgen explain OD0507` tells more about a message; `odgen reference` describes the language."
)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub command: Command,

    /// How messages are written
    #[arg(long, global = true, value_enum, default_value_t)]
    pub format: Format,

    /// Colours in messages
    #[arg(long, global = true, value_enum, default_value_t, value_name = "WHEN")]
    pub color: Color,
}

#[derive(Debug, Clone, Copy, Default, ValueEnum)]
pub(crate) enum Format {
    /// With the source lines, as rustc does
    #[default]
    Human,
    /// One line each
    Short,
    /// One JSON object per line
    Json,
}

impl From<Format> for render::Format {
    fn from(format: Format) -> Self {
        match format {
            Format::Human => render::Format::Human,
            Format::Short => render::Format::Short,
            Format::Json => render::Format::Json,
        }
    }
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Color {
    /// On a terminal
    #[default]
    Auto,
    /// Always
    Always,
    /// Never
    Never,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Make the files of a specification: EDS of each device and the JSON dump; all of them or, on an error, none
    Build(BuildArgs),
    /// Check specifications without writing anything
    Check(CheckArgs),
    /// Make the DCF of one node, with parameter values of your own
    Dcf(DcfArgs),
    /// Print the resolved model as JSON
    Dump(DumpArgs),
    /// List where the printed manual says something else than the specification
    Errata(ErrataArgs),
    /// Tell what a message code means and what to do about it
    Explain {
        /// A code such as OD0507, or `all`
        code: String,
    },
    /// Print the language reference (Markdown)
    Reference,
    /// Print the JSON Schema of the language, for editors
    Schema,
    /// Print a completion script for a shell
    Completions {
        /// The shell
        #[arg(value_enum)]
        shell: clap_complete::Shell,
    },
}

#[derive(Debug, Args)]
pub(crate) struct BuildArgs {
    /// Specifications (`*.od.yaml`); without any, the specifications that come with odgen, with Rust and a DCF for node 1
    pub specs: Vec<PathBuf>,

    /// Directory for the files
    #[arg(long, short, default_value = "generated", value_name = "DIR")]
    pub out: PathBuf,

    /// Only these devices
    #[arg(long, value_name = "KEY")]
    pub device: Vec<String>,

    /// Also a DCF of each device for this node-ID (1 to 127)
    #[arg(long, value_name = "ID")]
    pub node: Option<String>,

    /// Also a Rust module of each device, `src/KEY.rs`
    #[arg(long)]
    pub rust: bool,
}

#[derive(Debug, Args)]
pub(crate) struct CheckArgs {
    /// Specifications (`*.od.yaml`)
    #[arg(required = true)]
    pub specs: Vec<PathBuf>,

    /// Treat warnings as errors
    #[arg(long)]
    pub deny_warnings: bool,

    /// Also what only Rust code minds: names that give one identifier, strings without a capacity
    #[arg(long)]
    pub rust: bool,
}

#[derive(Debug, Args)]
pub(crate) struct DcfArgs {
    /// The specification
    pub spec: PathBuf,

    /// Key of the device
    #[arg(long, value_name = "KEY")]
    pub device: String,

    /// Node-ID, 1 to 127
    #[arg(long, value_name = "ID")]
    pub node: String,

    /// Bit rate in kbit/s [default: 250, or the device's highest]
    #[arg(long, value_name = "KBIT")]
    pub bit_rate: Option<String>,

    /// Name of the node [default: product name and node-ID]
    #[arg(long, value_name = "NAME")]
    pub node_name: Option<String>,

    /// Number of the network
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub net_number: u32,

    /// Name of the network
    #[arg(long, value_name = "NAME", default_value = "")]
    pub net_name: String,

    /// Value of an entry: `607D.2=9000`, `"EFC target position=90.00 °"`, `"sensor selection code=-1"`
    #[arg(long = "set", value_name = "ENTRY=VALUE")]
    pub settings: Vec<String>,

    /// File to write [default: the key and node-ID, such as pmc-5.dcf]
    #[arg(long, short, value_name = "FILE")]
    pub out: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct DumpArgs {
    /// The specification
    pub spec: PathBuf,

    /// As JSON, the only format there is
    #[arg(long)]
    pub json: bool,

    /// Only these devices
    #[arg(long, value_name = "KEY")]
    pub device: Vec<String>,
}

#[derive(Debug, Args)]
pub(crate) struct ErrataArgs {
    /// The specification
    pub spec: PathBuf,

    /// Only this kind of fact, such as `access` or `gap`
    #[arg(long, value_name = "KIND")]
    pub kind: Option<String>,

    /// Only this object, such as 6041 (hexadecimal)
    #[arg(long, value_name = "INDEX")]
    pub at: Option<String>,

    /// As Markdown
    #[arg(long)]
    pub markdown: bool,
}

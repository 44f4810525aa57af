//! The command line.

mod bus;
mod concise;
mod dbc;
mod diff;
mod node;
mod on_bus;
mod plant;
mod st;

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use od_spec::diag::render;
use od_spec::eds::readers::Reader;

pub(crate) use bus::{DecodeArgs, NodesArgs, ServeArgs};
pub(crate) use concise::{ConciseArgs, ConciseCommand, ConciseFormat, ConciseShowArgs};
pub(crate) use dbc::DbcArgs;
pub(crate) use diff::{DiffArgs, DiffFormat};
pub(crate) use node::{DcfArgs, ParamsArgs, SchemaArgs};
pub(crate) use on_bus::{
    LinkArgs, NmtName, NodeArgs, NodeBackupArgs, NodeCommand, NodeFileArgs, NodeGroupArgs, NodeMonitorArgs,
    NodeNmtArgs, NodeReadArgs, NodeScanArgs, NodeWriteArgs, OneNodeArgs,
};
pub(crate) use plant::{PlantArgs, PlantBuildArgs, PlantCommand, PlantShowArgs, ShowFormat};
pub(crate) use st::StArgs;

/// Checks CANopen object dictionaries – specifications, EDS, DCF, XDD and XDC files – and makes EDS, DCF, XDD, JSON, Rust and documents from them.
#[derive(Debug, Parser)]
#[command(
    name = "odgen",
    version,
    after_help = "Exit codes: 0 fine, 1 errors in the input or output not written, 2 wrong command line, \
                  3 what `odgen diff --exit-code` looks for, or `odgen node compare` finds.\n\
                  `odgen explain OD0507` tells more about a message; `odgen reference` describes the language."
)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub command: Command,

    /// How messages are written
    #[arg(long, value_enum)]
    pub format: Option<Format>,

    /// Directory whose `*.od.yaml` are taken when no SPEC is named
    #[arg(long = "specs", global = true, default_value = ".", hide_default_value = true, value_name = "DIR")]
    pub directory: PathBuf,

    /// Colours in messages
    #[arg(long, global = true, value_enum, default_value_t, value_name = "WHEN")]
    pub color: Color,
}

/// How messages are written, said behind the command. `odgen docs` and `odgen diff` have formats of their own; there it is said before the command.
#[derive(Debug, Args)]
pub(crate) struct Messages {
    /// How messages are written
    #[arg(long, value_enum)]
    pub format: Option<Format>,
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

/// How findings are written. SARIF and GitHub's workflow commands go to standard output, the others to standard error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum CheckFormat {
    /// With the source lines, as rustc does, and a summary
    Human,
    /// One line each
    Short,
    /// One JSON object per line
    Json,
    /// One SARIF 2.1.0 document, for code scanning services
    Sarif,
    /// Workflow commands of GitHub Actions, which show findings beside the source
    Github,
}

impl CheckFormat {
    /// How messages about the command itself are written.
    fn of_messages(self) -> Format {
        match self {
            CheckFormat::Human => Format::Human,
            CheckFormat::Short | CheckFormat::Sarif | CheckFormat::Github => Format::Short,
            CheckFormat::Json => Format::Json,
        }
    }
}

impl From<Format> for CheckFormat {
    fn from(format: Format) -> Self {
        match format {
            Format::Human => CheckFormat::Human,
            Format::Short => CheckFormat::Short,
            Format::Json => CheckFormat::Json,
        }
    }
}

impl Cli {
    /// How messages are written, wherever it was said.
    pub(crate) fn message_format(&self) -> Format {
        let behind = match &self.command {
            Command::Build(args) => args.messages.format,
            Command::Check(args) => args.format.map(CheckFormat::of_messages),
            Command::Dbc(args) => args.messages.format,
            Command::Dcf(args) => args.messages.format,
            Command::Decode(args) => args.messages.format,
            Command::Dump(args) => args.messages.format,
            Command::Errata(args) => args.messages.format,
            Command::Import(args) => args.messages.format,
            Command::Fix(args) => args.messages.format,
            Command::Fmt(args) => args.messages.format,
            Command::New(args) => args.messages.format,
            Command::Node(args) => args.command.message_format(),
            Command::Params(args) => args.messages.format,
            Command::Plant(args) => args.command.message_format(),
            Command::Serve(args) => args.messages.format,
            Command::St(args) => args.messages.format,
            _ => None,
        };
        behind.or(self.format).unwrap_or_default()
    }
}

impl From<DocsFormat> for docs_gen::Format {
    fn from(format: DocsFormat) -> Self {
        match format {
            DocsFormat::Md => docs_gen::Format::Markdown,
            DocsFormat::Html => docs_gen::Format::Html,
            DocsFormat::Print => docs_gen::Format::Print,
        }
    }
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
    /// Check specifications, EDS, DCF, XDD and XDC files without writing anything
    Check(CheckArgs),
    /// Look into a concise DCF, the binary that a CANopen master downloads to a node (object 1F22h)
    Concise(ConciseArgs),
    /// Make the DBC of the nodes of a bus, for trace and test tools: PDOs and services as messages, with units, names of values and bits
    Dbc(DbcArgs),
    /// Make the DCF of one node, with parameter values of your own
    Dcf(DcfArgs),
    /// Tell what the frames of a recorded trace say: services, entries and values in units, states, errors
    Decode(DecodeArgs),
    /// Tell what differs between two dictionaries, and what each change breaks
    Diff(DiffArgs),
    /// Print the resolved model as JSON
    Dump(DumpArgs),
    /// Make the reference documentation: the manual's tables and a reference of all objects, as Markdown or HTML
    Docs(DocsArgs),
    /// List where the printed manual says something else than the specification
    Errata(ErrataArgs),
    /// Make a specification of an EDS, DCF, XDD or XDC
    Import(ImportArgs),
    /// Put right what is wrong with the form of EDS and DCF files, as far as nothing has to be guessed
    Fix(FixArgs),
    /// Lay out specifications: indentation and blanks; comments, order and facts stay
    Fmt(FmtArgs),
    /// Serve an editor: the Language Server Protocol on standard input and output
    Lsp(LspArgs),
    /// Write a commented specification to start from
    New(NewArgs),
    /// Talk to nodes on a bus, by an adapter with SLCAN (TCP or serial) or a CAN interface
    Node(NodeArgs),
    /// Make a parameter file of a DCF: the values that differ from the defaults, by name and in units
    Params(ParamsArgs),
    /// Work on a plant file: the nodes of many machines, with values inherited from type, site and machine
    Plant(PlantArgs),
    /// Be nodes on a bus, without hardware, for whoever comes by SLCAN (TCP or a pseudo-terminal) or a CAN interface
    Serve(ServeArgs),
    /// Make Structured Text (IEC 61131-3) for PLC programs: constants, enums, bits, conversions to units and back, PDOs
    St(StArgs),
    /// Tell what a message code means and what to do about it
    Explain {
        /// A code such as OD0507, or `all`
        code: String,
    },
    /// Print a library of standard objects, or the names of all
    Library {
        /// Name, such as `cia402`
        name: Option<String>,
    },
    /// Print the language reference (Markdown)
    Reference,
    /// Print the JSON Schema of the language, or of the parameter files of a device, for editors
    Schema(SchemaArgs),
    /// Print a completion script for a shell
    Completions {
        /// The shell
        #[arg(value_enum)]
        shell: clap_complete::Shell,
    },
}

#[derive(Debug, Args)]
pub(crate) struct LspArgs {
    /// Standard input and output; editors say it, and there is nothing else
    #[arg(long)]
    pub stdio: bool,
}

#[derive(Debug, Args)]
pub(crate) struct BuildArgs {
    /// Specifications, EDS, DCF, XDD or XDC files [default: the `*.od.yaml` of the current directory]
    pub specs: Vec<PathBuf>,

    /// Directory for the files
    #[arg(long, short, default_value = "generated", value_name = "DIR")]
    pub out: PathBuf,

    /// Only these devices
    #[arg(long, value_name = "KEY")]
    pub device: Vec<String>,

    /// Also a DCF of each device for this node-ID (1 to 127) [default: of a DCF its own node, with its values]
    #[arg(long, value_name = "ID")]
    pub node: Option<String>,

    /// Also an XDD of each device (CiA 311), `xdd/KEY.xdd`, and an XDC beside each DCF
    #[arg(long)]
    pub xdd: bool,

    /// Also a Rust module of each device, `src/KEY.rs`
    #[arg(long)]
    pub rust: bool,

    /// Also the dictionary of each device in C, for this kind of firmware, `c/KEY/`
    #[arg(long, value_enum, value_name = "KIND")]
    pub c: Vec<CKind>,

    /// Also the reference documentation in this format, `docs/`
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub docs: Vec<DocsFormat>,

    /// Remove what odgen made there before and this command does not make
    #[arg(long, conflicts_with = "device")]
    pub prune: bool,

    /// Replace files of these names that odgen did not make
    #[arg(long)]
    pub force: bool,

    #[command(flatten)]
    pub messages: Messages,
}

/// Firmware that a dictionary in C is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum CKind {
    /// Any: a dictionary by itself, C99 without a stack
    Plain,
    /// Firmware with the stack CANopenNode, version 4: `OD.h`, `OD.c`, and an extension that keeps limits, locks and conditions
    #[value(name = "canopennode")]
    CanopenNode,
}

impl From<CKind> for od_c::Kind {
    fn from(kind: CKind) -> Self {
        match kind {
            CKind::Plain => Self::Plain,
            CKind::CanopenNode => Self::CanopenNode,
        }
    }
}

/// Readers of which it is foretold what they refuse.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum ReaderName {
    /// dcfchk, the checker of lely's dcf-tools
    #[value(alias = "dcfchk")]
    Lely,
    /// The Python library canopen
    PythonCanopen,
    /// The Python package eds-utils
    EdsUtils,
    /// The JavaScript library canopen
    NodeCanopen,
    /// The Rust crate canopen-host
    CanopenHost,
}

impl From<ReaderName> for Reader {
    fn from(name: ReaderName) -> Self {
        match name {
            ReaderName::Lely => Reader::Dcfchk,
            ReaderName::PythonCanopen => Reader::PythonCanopen,
            ReaderName::EdsUtils => Reader::EdsUtils,
            ReaderName::NodeCanopen => Reader::NodeCanopen,
            ReaderName::CanopenHost => Reader::CanopenHost,
        }
    }
}

#[derive(Debug, Args)]
pub(crate) struct CheckArgs {
    /// Specifications, EDS, DCF, XDD and XDC files, directories to look for them in, or `-` for standard input [default: the
    /// `*.od.yaml` of the current directory]
    #[arg(value_name = "FILE")]
    pub files: Vec<PathBuf>,

    /// Take these findings as errors: a code such as EDS503, the codes that begin with EDS5, `warnings` or `notes`
    #[arg(long, value_name = "CODE")]
    pub deny: Vec<String>,

    /// Treat warnings as errors, as `--deny warnings` does
    #[arg(long)]
    pub deny_warnings: bool,

    /// Leave these findings out, named in the same way; errors in a specification stay
    #[arg(long, value_name = "CODE")]
    pub allow: Vec<String>,

    /// Hold EDS and DCF files to the standard, as files of one's own, not as files of others that are only read
    #[arg(long)]
    pub strict: bool,

    /// Take as errors what this reader refuses an EDS or DCF for, and nothing else
    #[arg(long = "for", value_enum, value_name = "READER")]
    pub readers: Vec<ReaderName>,

    /// Also show notes: what is not wrong but worth knowing, such as objects that depart from the standard they are taken from
    #[arg(long)]
    pub notes: bool,

    /// Show every place of a finding that an EDS or DCF has in many places, not only the first three
    #[arg(long)]
    pub all: bool,

    /// Also what only Rust code minds: names that give one identifier, strings without a capacity
    #[arg(long)]
    pub rust: bool,

    /// What standard input is called; the name tells what it is, as it does for a file
    #[arg(long, value_name = "NAME", default_value = "<stdin>", hide_default_value = true)]
    pub stdin_name: String,

    /// How findings are written [default: human]
    #[arg(long, value_enum)]
    pub format: Option<CheckFormat>,
}

#[derive(Debug, Clone, Args)]
pub(crate) struct DocsArgs {
    /// Specifications, EDS, DCF, XDD or XDC files [default: the `*.od.yaml` of the current directory]
    pub specs: Vec<PathBuf>,

    /// Directory for the documents; those of a specification go into a directory with its name
    #[arg(long, short, default_value = "generated/docs", value_name = "DIR")]
    pub out: PathBuf,

    /// Only these devices
    #[arg(long, value_name = "KEY")]
    pub device: Vec<String>,

    /// Language of the documents, such as `en` or `de` [default: the first of the specification]
    #[arg(long, value_name = "CODE")]
    pub lang: Option<String>,

    /// Format; can be given several times [default: md, or with --templates none but theirs]
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub format: Vec<DocsFormat>,

    /// With `--format print`: mark where the manual differs from the issue that it takes the place of, and list the errata behind it
    #[arg(long)]
    pub errata: bool,

    /// Directory with templates of your own, which are laid over those of the format
    #[arg(long, value_name = "DIR")]
    pub templates: Option<PathBuf>,

    /// Write the templates of the format into this directory, to start your own from, and nothing else
    #[arg(long, value_name = "DIR", conflicts_with_all = ["templates", "dump_context"])]
    pub export_templates: Option<PathBuf>,

    /// Print what templates see, as JSON, and nothing else
    #[arg(long)]
    pub dump_context: bool,

    /// Replace files of these names that odgen did not make
    #[arg(long)]
    pub force: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum DocsFormat {
    /// Markdown: a file per chapter, device and appendix
    Md,
    /// HTML: a file for the system and one per device, each complete in itself
    Html,
    /// HTML to be printed: a file for everything, with title, contents and page numbers
    Print,
}

#[derive(Debug, Args)]
pub(crate) struct DumpArgs {
    /// The specification, EDS, DCF, XDD or XDC [default: the only `*.od.yaml` of the current directory]
    pub spec: Option<PathBuf>,

    /// As JSON, the only format there is
    #[arg(long)]
    pub json: bool,

    /// Only these devices
    #[arg(long, value_name = "KEY")]
    pub device: Vec<String>,

    #[command(flatten)]
    pub messages: Messages,
}

#[derive(Debug, Args)]
pub(crate) struct FixArgs {
    /// EDS or DCF files
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,

    /// Print what changes, as a unified diff with the codes of what it puts right [default, unless --write is given]
    #[arg(long)]
    pub diff: bool,

    /// Change the files
    #[arg(long)]
    pub write: bool,

    #[command(flatten)]
    pub messages: Messages,
}

#[derive(Debug, Args)]
pub(crate) struct FmtArgs {
    /// Specifications, their parts and libraries; `-` reads one and prints it [default: the `*.od.yaml` of the current directory]
    #[arg(value_name = "FILE")]
    pub files: Vec<PathBuf>,

    /// Change nothing; name the files that are laid out otherwise, and fail if there is one
    #[arg(long)]
    pub check: bool,

    #[command(flatten)]
    pub messages: Messages,
}

#[derive(Debug, Args)]
pub(crate) struct ImportArgs {
    /// EDS, DCF, XDD or XDC files
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,

    /// Directory for the specifications, each named like its file
    #[arg(long, short, default_value = ".", value_name = "DIR")]
    pub out: PathBuf,

    /// Replace specifications that are there already
    #[arg(long)]
    pub force: bool,

    #[command(flatten)]
    pub messages: Messages,
}

#[derive(Debug, Args)]
pub(crate) struct NewArgs {
    /// Key of the device, which also names the file: small letters, digits and hyphens
    pub name: String,

    /// What the device follows
    #[arg(long, value_enum, default_value_t)]
    pub profile: Profile,

    /// Modes of operation of a drive, such as `pp,hm` or `"profile position,homing"`
    #[arg(long, value_delimiter = ',', value_name = "MODES")]
    pub modes: Vec<String>,

    /// Digital inputs of an I/O module
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u16).range(..=2032))]
    pub inputs: Option<u16>,

    /// Digital outputs of an I/O module
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u16).range(..=2032))]
    pub outputs: Option<u16>,

    /// Analogue inputs of an I/O module
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u16).range(..=254))]
    pub analogue_inputs: Option<u16>,

    /// Analogue outputs of an I/O module
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u16).range(..=254))]
    pub analogue_outputs: Option<u16>,

    /// Directory for the file
    #[arg(long, short, default_value = ".", value_name = "DIR")]
    pub out: PathBuf,

    #[command(flatten)]
    pub messages: Messages,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Profile {
    /// No device profile, only the communication objects
    #[default]
    Cia301,
    /// I/O modules; how many channels they have, `--inputs` and the others say
    Cia401,
    /// Drives and motion control; its modes are pp, vl, pv, tq, hm, ip, csp, csv, cst
    Cia402,
}

#[derive(Debug, Args)]
pub(crate) struct ErrataArgs {
    /// The specification, EDS, DCF, XDD or XDC [default: the only `*.od.yaml` of the current directory]
    pub spec: Option<PathBuf>,

    /// Only this kind of fact, such as `access` or `gap`
    #[arg(long, value_name = "KIND")]
    pub kind: Option<String>,

    /// Only this object, such as 6041 (hexadecimal)
    #[arg(long, value_name = "INDEX")]
    pub at: Option<String>,

    /// As Markdown
    #[arg(long)]
    pub markdown: bool,

    #[command(flatten)]
    pub messages: Messages,
}

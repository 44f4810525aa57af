//! Arguments of the commands that talk to nodes on a bus.

use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, Subcommand, ValueEnum};
use od_bus::trace::Service;
use od_spec::diag::{Diagnostic, codes};

use super::confirm::ConfirmArgs;
use super::specify::SpecifyArgs;
use crate::bus_nodes::NodesArgs;
use crate::messages::{Format, Messages};
use crate::report::{Report, node_id};

#[derive(Debug, Args)]
pub(crate) struct NodeArgs {
    #[command(subcommand)]
    pub command: NodeCommand,
}

#[derive(Debug, Subcommand)]
pub(crate) enum NodeCommand {
    /// Read entries: name, value in its unit or by its name, set bits, bytes
    Read(NodeReadArgs),
    /// Write entries, in the order that is given, after a check against the specification and what the node has, and a question
    Write(NodeWriteArgs),
    /// Write the parameters of a node, or of all nodes of a machine, into parameter files, by name and in units: all that can be read and written
    Backup(NodeBackupArgs),
    /// Show which values of a parameter file differ on a node or on the nodes of a machine; exit code 3 when there are
    /// any
    Compare(NodeFileArgs),
    /// Write the values of a parameter file to a node, or to the nodes of a machine, after a question, in an order that
    /// they accept, and read them back
    Restore(NodeRestoreArgs),
    /// Print what goes over the bus as it happens: heartbeats and their loss, states, emergencies, PDOs and transfers
    /// with names and units
    Monitor(NodeMonitorArgs),
    /// Ask all 127 node-IDs for their identity, and show which of the specifications fits
    Scan(NodeScanArgs),
    /// Load a program into a node (1F50h), after a question: it is stopped, deleted, loaded in blocks, checked and started
    Program(NodeProgramArgs),
    /// Command the state of a node, or of all
    Nmt(NodeNmtArgs),
    /// Make a node store its parameters (1010h)
    Store(NodeGroupArgs),
    /// Make a node restore its defaults (1011h), from its next reset on
    LoadDefaults(NodeGroupArgs),
}

impl NodeCommand {
    /// How messages are written, where that is said after the command.
    pub(crate) const fn message_format(&self) -> Option<Format> {
        match self {
            Self::Read(args) => args.node.link.messages.format,
            Self::Write(args) => args.node.link.messages.format,
            Self::Backup(args) => args.node.link.messages.format,
            Self::Compare(args) => args.node.link.messages.format,
            Self::Restore(args) => args.file.node.link.messages.format,
            Self::Monitor(args) => args.link.messages.format,
            Self::Scan(args) => args.link.messages.format,
            Self::Program(args) => args.node.link.messages.format,
            Self::Nmt(args) => args.link.messages.format,
            Self::Store(args) | Self::LoadDefaults(args) => args.node.link.messages.format,
        }
    }
}

/// How the bus is reached.
#[derive(Debug, Args)]
pub(crate) struct LinkArgs {
    /// The CAN adapter, which speaks SLCAN: `tcp:HOST:PORT`, such as `odgen serve` or `odgen-bridge`, or `serial:PORT[@BAUD]`, such as `serial:/dev/ttyACM0`
    #[arg(long, value_name = "ADAPTER", default_value = "tcp:127.0.0.1:3333")]
    pub slcan: String,

    /// In place of an adapter with SLCAN: a CAN interface of Linux (SocketCAN), such as `can0`
    #[arg(long, value_name = "INTERFACE", conflicts_with = "slcan")]
    pub socketcan: Option<String>,

    /// Bit rate that the adapter is set to, in kbit/s [default: what it has]
    #[arg(long, value_name = "KBIT")]
    pub bit_rate: Option<u16>,

    /// Milliseconds after which a node that does not answer is given up
    #[arg(long, value_name = "MS", default_value_t = 1000)]
    pub timeout: u32,

    /// How often an entry is read again when a frame was lost or broken; a write is never repeated before it is read
    /// back
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub retries: u8,

    #[command(flatten)]
    pub messages: Messages,
}

/// Which node, and what device it is.
#[derive(Debug, Args)]
pub(crate) struct OneNodeArgs {
    /// Key of the device [default: the only one]
    #[arg(long, value_name = "KEY", requires = "spec")]
    pub device: Option<String>,

    /// Node-ID, 1 to 127 [default: of a DCF or a parameter file its own]
    #[arg(long, value_name = "ID")]
    pub node: Option<String>,

    /// Where SPEC is a plant file: the machine, by name or number, whose nodes are meant [default: the only one]
    #[arg(long, value_name = "NAME", requires = "spec")]
    pub machine: Option<String>,

    /// The site of the machine [default: that of the only machine with this name]
    #[arg(long, value_name = "NAME", requires = "spec")]
    pub site: Option<String>,

    /// Go on with a node that has another serial number, such as a spare part; everything else has to fit
    #[arg(long, requires = "spec")]
    pub any_serial: bool,

    /// Go on with a node of another major or a lower minor revision; a higher minor one is compatible
    #[arg(long, requires = "spec")]
    pub any_revision: bool,

    /// Go on with any node, without asking for its device type, vendor, product, revision and serial number
    #[arg(long, requires = "spec")]
    pub any_device: bool,

    #[command(flatten)]
    pub link: LinkArgs,
}

/// Which nodes of a machine are left out.
#[derive(Debug, Args)]
pub(crate) struct SkipArgs {
    /// Node of the machine that is left out, such as one that is not there; can be given several times
    #[arg(long, value_name = "ID", conflicts_with = "node")]
    skip: Vec<String>,
}

impl SkipArgs {
    pub(super) fn ids(&self, report: &Report) -> Result<Vec<u8>, u8> {
        self.skip.iter().map(|id| node_id(id).map_err(|diagnostic| report.refuse(diagnostic))).collect()
    }

    /// Demands that none is named, where a single node is meant.
    pub(super) fn none(&self, report: &Report) -> Result<(), u8> {
        if self.skip.is_empty() {
            return Ok(());
        }
        let message = "`--skip` leaves out nodes of a machine, and this is about a single node";
        Err(report.refuse(Diagnostic::without_place(codes::BAD_NODE_ID, message).help("remove `--skip`")))
    }
}

#[derive(Debug, Args)]
pub(crate) struct NodeReadArgs {
    /// Specification, EDS, DCF, XDD or XDC of the node's device; or a plant file, with all nodes of a machine
    pub spec: PathBuf,

    #[command(flatten)]
    pub node: OneNodeArgs,

    /// Entries by index or name, as settings name them: `6064`, `607D.2`, `"position actual value"`; of an object with several entries all
    #[arg(required = true, value_name = "ENTRY")]
    pub entries: Vec<String>,
}

#[derive(Debug, Args)]
pub(crate) struct NodeWriteArgs {
    /// Specification, EDS, DCF, XDD or XDC of the node's device; or a plant file, with all nodes of a machine
    pub spec: PathBuf,

    #[command(flatten)]
    pub node: OneNodeArgs,

    /// What is written: `607D.2=9000`, `"EFC target position=90.00 °"`
    #[arg(required = true, value_name = "ENTRY=VALUE")]
    pub settings: Vec<String>,

    /// Locked entry that may be written anyway: factory data, which the device takes only while it is unlocked for
    /// service
    #[arg(long, value_name = "ENTRY")]
    pub unlock: Vec<String>,

    /// Send also what fails the check; the node decides
    #[arg(long)]
    pub force: bool,

    #[command(flatten)]
    pub confirm: ConfirmArgs,
}

#[derive(Debug, Args)]
pub(crate) struct NodeBackupArgs {
    /// Specification, EDS, DCF, XDD or XDC of the node's device; or a plant file, with all nodes of a machine
    pub spec: PathBuf,

    #[command(flatten)]
    pub node: OneNodeArgs,

    /// File to write; without `--node`, of a machine of a plant the directory for a file of each node
    #[arg(long, short, value_name = "FILE|DIR")]
    pub out: PathBuf,

    /// Replace files of these names
    #[arg(long)]
    pub force: bool,

    #[command(flatten)]
    pub skip: SkipArgs,
}

#[derive(Debug, Args)]
pub(crate) struct NodeFileArgs {
    /// Specification, EDS, DCF, XDD or XDC of the node's device; or a plant file, with all nodes of a machine
    pub spec: PathBuf,

    #[command(flatten)]
    pub node: OneNodeArgs,

    /// The parameter file; of a machine of a plant the directory with a file of each node
    #[arg(value_name = "FILE|DIR")]
    pub file: PathBuf,

    #[command(flatten)]
    pub skip: SkipArgs,
}

#[derive(Debug, Args)]
pub(crate) struct NodeRestoreArgs {
    #[command(flatten)]
    pub file: NodeFileArgs,

    #[command(flatten)]
    pub confirm: ConfirmArgs,
}

#[derive(Debug, Args)]
pub(crate) struct NodeScanArgs {
    /// Specifications, EDS, DCF, XDD or XDC files whose devices nodes may be [default: none]
    #[arg(value_name = "SPEC")]
    pub specs: Vec<PathBuf>,

    #[command(flatten)]
    pub specify: SpecifyArgs,

    #[command(flatten)]
    pub link: LinkArgs,
}

#[derive(Debug, Args)]
pub(crate) struct NodeMonitorArgs {
    #[command(flatten)]
    pub nodes: NodesArgs,

    /// Every frame, also SYNC, TIME, heartbeats with the same state and PDOs with the same values
    #[arg(long)]
    pub all: bool,

    /// Only these services
    #[arg(long, value_enum, value_delimiter = ',', value_name = "SERVICE")]
    pub only: Vec<ServiceName>,

    /// Ask the nodes first which identifiers they use and what their PDOs carry, by SDO; otherwise that is as specified until it is written
    #[arg(long)]
    pub ask: bool,

    /// End after this many seconds [default: with Ctrl-C]
    #[arg(long = "for", value_name = "SECONDS", value_parser = duration)]
    pub seconds: Option<Duration>,

    #[command(flatten)]
    pub link: LinkArgs,
}

/// `1.5`.
pub(super) fn duration(text: &str) -> Result<Duration, String> {
    let is_plain = text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
    let seconds = text.parse().ok().filter(|_| is_plain);
    seconds
        .and_then(|seconds| Duration::try_from_secs_f64(seconds).ok())
        .ok_or_else(|| "expected a number of seconds, such as `1.5`".to_owned())
}

/// What frames belong to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum ServiceName {
    /// Commands of the master
    Nmt,
    /// SYNC
    Sync,
    /// TIME
    Time,
    /// Emergency messages
    Emcy,
    /// PDOs
    Pdo,
    /// Transfers of entries
    Sdo,
    /// Boot-up, heartbeats and their loss, node guarding
    Heartbeat,
    /// Layer setting services
    Lss,
    /// Nothing that is known
    Unknown,
}

impl ServiceName {
    pub(crate) const fn service(self) -> Service {
        match self {
            Self::Nmt => Service::Nmt,
            Self::Sync => Service::Sync,
            Self::Time => Service::Time,
            Self::Emcy => Service::Emergency,
            Self::Pdo => Service::Pdo,
            Self::Sdo => Service::Sdo,
            Self::Heartbeat => Service::Heartbeat,
            Self::Lss => Service::Lss,
            Self::Unknown => Service::Unknown,
        }
    }
}

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

#[derive(Debug, Args)]
pub(crate) struct NodeNmtArgs {
    /// The command
    #[arg(value_enum)]
    pub command: NmtName,

    /// Node-ID, 1 to 127, or `all`
    #[arg(long, value_name = "ID|all")]
    pub node: String,

    #[command(flatten)]
    pub link: LinkArgs,
}

/// The commands of NMT.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum NmtName {
    /// To operational: PDOs are sent and taken
    Start,
    /// To stopped: nothing is served but NMT
    Stop,
    /// To pre-operational: the node can be set up
    PreOperational,
    /// The whole device starts again
    ResetNode,
    /// The communication starts again
    ResetCommunication,
}

#[derive(Debug, Args)]
pub(crate) struct NodeGroupArgs {
    /// Specification, EDS, DCF, XDD or XDC of the node's device, or a plant file: whether the node is this one is asked first [default: what
    /// the node says of itself is shown]
    pub spec: Option<PathBuf>,

    #[command(flatten)]
    pub node: OneNodeArgs,

    /// Which parameters: 1 all, 2 communication, 3 application, from 4 on the manufacturer's
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u8).range(1..=127))]
    pub group: u8,

    #[command(flatten)]
    pub confirm: ConfirmArgs,
}

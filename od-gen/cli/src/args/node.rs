//! Arguments of the commands about one node: its DCF, its parameter file, and the schema of such files.

use std::path::PathBuf;

use clap::Args;

use super::Messages;

#[derive(Debug, Args)]
pub(crate) struct DcfArgs {
    /// The specification, EDS, DCF, XDD or XDC [default: the only `*.od.yaml` of the current directory]
    pub spec: Option<PathBuf>,

    /// Key of the device [default: the only one]
    #[arg(long, value_name = "KEY")]
    pub device: Option<String>,

    /// Node-ID, 1 to 127 [default: of a DCF its own]
    #[arg(long, value_name = "ID")]
    pub node: Option<String>,

    /// Bit rate in kbit/s [default: of a DCF its own; 250, or the device's highest]
    #[arg(long, value_name = "KBIT")]
    pub bit_rate: Option<String>,

    /// Name of the node [default: of a DCF its own; product name and node-ID]
    #[arg(long, value_name = "NAME")]
    pub node_name: Option<String>,

    /// Number of the network [default: of a DCF its own; 1]
    #[arg(long, value_name = "N")]
    pub net_number: Option<u32>,

    /// Name of the network [default: of a DCF its own; none]
    #[arg(long, value_name = "NAME")]
    pub net_name: Option<String>,

    /// Parameter file (YAML) of the node, with values by name and in units; of several, a later one is laid over the earlier ones
    #[arg(long, value_name = "FILE")]
    pub params: Vec<PathBuf>,

    /// Value of an entry: `607D.2=9000`, `607Dsub2=9000`, `"EFC target position=90.00 °"`, `"sensor selection code=-1"`
    #[arg(long = "set", value_name = "ENTRY=VALUE")]
    pub settings: Vec<String>,

    /// File with one such setting on each line; lines that begin with `#` are comments
    #[arg(long, value_name = "FILE")]
    pub set_file: Vec<PathBuf>,

    /// Locked entry that may be set all the same: factory data, which the device takes only while it is unlocked for service
    #[arg(long, value_name = "ENTRY")]
    pub unlock: Vec<String>,

    /// Write no file; tell what is written into the node at boot, by a PLC that creates all SDOs, with a concise DCF, and by a configuration tool
    #[arg(long)]
    pub explain: bool,

    /// Write no value that is the entry's default
    #[arg(long)]
    pub since_default: bool,

    /// File to write [default: the key and node-ID, such as pmc-5.dcf]
    #[arg(long, short, value_name = "FILE")]
    pub out: Option<PathBuf>,

    /// Also the concise DCF for the master's object 1F22h, beside the DCF with the ending `.bin`
    #[arg(long)]
    pub concise: bool,

    /// Also the same as an XDC (CiA 311), beside the DCF with the ending `.xdc`
    #[arg(long)]
    pub xdc: bool,

    /// Replace files of these names that odgen did not make
    #[arg(long)]
    pub force: bool,

    #[command(flatten)]
    pub messages: Messages,
}

#[derive(Debug, Args)]
pub(crate) struct ParamsArgs {
    /// The DCF, saved from a device by any tool
    #[arg(value_name = "DCF")]
    pub file: PathBuf,

    /// Specification of the device, whose names, units and defaults count [default: those of the DCF itself]
    #[arg(long, value_name = "SPEC")]
    pub spec: Option<PathBuf>,

    /// Key of the device in the specification [default: the only one]
    #[arg(long, value_name = "KEY", requires = "spec")]
    pub device: Option<String>,

    /// File to write [default: it is printed]
    #[arg(long, short, value_name = "FILE")]
    pub out: Option<PathBuf>,

    /// Replace a file of this name
    #[arg(long)]
    pub force: bool,

    #[command(flatten)]
    pub messages: Messages,
}

#[derive(Debug, Args)]
pub(crate) struct SchemaArgs {
    /// Specification, EDS or DCF, of whose device the schema of parameter files is printed
    #[arg(long, value_name = "SPEC")]
    pub params: Option<PathBuf>,

    /// Key of the device [default: the only one]
    #[arg(long, value_name = "KEY", requires = "params")]
    pub device: Option<String>,

    /// The schema of plant files; of a plant, or of specifications, EDS and DCF files, with what their devices have
    #[arg(long, conflicts_with = "params", num_args = 0.., value_name = "PLANT|SPEC")]
    pub plant: Option<Vec<PathBuf>>,
}

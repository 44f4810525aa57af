//! Arguments of `odgen new`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::messages::Messages;

#[derive(Debug, Args)]
pub(crate) struct NewArgs {
    /// Key of the device and name of the file: lower-case letters, digits and hyphens
    pub name: String,

    /// Device profile
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

    /// Also write a firmware project, in a directory with the name of the device
    #[arg(long, value_enum, value_name = "LANGUAGE")]
    pub firmware: Option<Firmware>,

    /// Clone of the odgen repository, with the crates that firmware in Rust needs; they are not published yet
    #[arg(long, value_name = "DIR")]
    pub glue: Option<PathBuf>,

    /// Directory to write to
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
    /// I/O modules, with the number of channels in `--inputs` and the other three options
    Cia401,
    /// Drives and motion control, with the modes pp, vl, pv, tq, hm, ip, csp, csv, cst
    Cia402,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Firmware {
    /// A complete node in Rust, which `cargo run --release` starts in QEMU
    Rust,
    /// The dictionary in C with an SDO server, which `make run` starts in QEMU
    C,
    /// A main program for CANopenNode and the list of files to compile, without the stack and its driver
    Canopennode,
}

//! `odgen concise`.

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand, ValueEnum};
use od_formats::concise::{self, Listing};
use od_gen::source::read_bytes;
use od_spec::diag::{Diagnostic, codes};

use crate::exit::ERRORS;
use crate::report::{Report, node_id, print, print_json, shown};
use crate::specs;

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

pub(crate) fn run(args: &ConciseArgs, directory: &Path, report: &Report) -> u8 {
    let ConciseCommand::Show(args) = &args.command;
    show(args, directory, report).unwrap_or_else(|code| code)
}

/// Lists the records; fails when the file is broken, or the device refuses one of them.
fn show(args: &ConciseShowArgs, directory: &Path, report: &Report) -> Result<u8, u8> {
    let node =
        args.node.as_deref().map(node_id).transpose().map_err(|diagnostic| report.refuse(diagnostic))?;
    let file = shown(&args.file);
    let bytes = read_bytes(&args.file).map_err(|reason| {
        let message = format!("cannot read {file}: {reason}");
        report.refuse(Diagnostic::without_place(codes::UNREADABLE, message).help("check the path"))
    })?;
    let spec = specs::one(args.spec.as_deref(), directory, report)?;
    let (used, _) = report.compile_with_sources(&spec).ok_or(ERRORS)?;
    let device = report.device_or_only(&used.system, args.device.as_deref())?;
    let concise = concise::read(&bytes);
    let listing = Listing::new(&file, &concise, device, used.node_id(node));
    let code = match args.format {
        ConciseFormat::Human => print(&listing.human()),
        ConciseFormat::Json => print_json(listing.json().as_bytes()),
        ConciseFormat::Settings => print(&listing.settings()),
    };
    match concise.fault {
        Some(fault) => Err(report.refuse(fault.diagnostic(&file))),
        None if listing.refused() > 0 => Err(ERRORS),
        None => Ok(code),
    }
}

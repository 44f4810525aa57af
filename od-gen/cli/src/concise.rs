//! `odgen concise`.

use std::path::Path;

use od_formats::concise::{self, Listing};
use od_gen::source::read_file;
use od_spec::diag::{Diagnostic, codes};

use super::args::{ConciseArgs, ConciseCommand, ConciseFormat, ConciseShowArgs};
use super::report::{Report, node_id, print, print_json, shown};
use super::{ERRORS, specs};

pub(crate) fn run(args: &ConciseArgs, directory: &Path, report: &Report) -> u8 {
    let ConciseCommand::Show(args) = &args.command;
    show(args, directory, report).unwrap_or_else(|code| code)
}

/// Lists the records; fails when the file is broken, or the device refuses one of them.
fn show(args: &ConciseShowArgs, directory: &Path, report: &Report) -> Result<u8, u8> {
    let node =
        args.node.as_deref().map(node_id).transpose().map_err(|diagnostic| report.refuse(diagnostic))?;
    let file = shown(&args.file);
    let bytes = read_file(&args.file).map_err(|reason| {
        let message = format!("cannot read {file}: {reason}");
        report.refuse(Diagnostic::without_place(codes::UNREADABLE, message).help("check the path"))
    })?;
    let spec = specs::one(args.spec.as_deref(), directory, report)?;
    let (used, _) = report.compile_with_sources(&spec).ok_or(ERRORS)?;
    let device = report.device_or_only(&used.system, args.device.as_deref())?;
    let concise = concise::read(&bytes);
    let listing = Listing::new(&file, &concise, device, node.or(used.stated_node_id));
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

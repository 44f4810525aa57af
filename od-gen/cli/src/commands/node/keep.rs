//! `odgen node backup`, `compare` and `restore`: the parameters of a node, or of the nodes of a machine, as files.

use std::path::Path;

use od_gen::Artifact;
use od_gen::files::Existing;
use od_spec::diag::{Diagnostic, codes};
use od_spec::file_name;

use super::args::{NodeBackupArgs, NodeFileArgs, NodeRestoreArgs};
use super::beside::{Beside, beside, compared};
use super::machine::Machine;
use super::outcome::worse;
use super::restore::restored;
use super::taken::{kept_line, parameters_of};
use super::{Described, connect, reach};
use crate::exit::SUCCESS;
use crate::interrupt::Interrupt;
use crate::output::{forced, keep};
use crate::report::{Report, print};
use crate::settings::ParameterFiles;

/// Writes a parameter file of what a node has; none where it does not answer.
pub(super) fn backup(args: &NodeBackupArgs, report: &Report) -> Result<u8, u8> {
    let described = Described::read(&args.spec, &args.node, report)?;
    if let Described::Machine(machine) = &described
        && args.node.node.is_none()
    {
        return machine.backup(args, report);
    }
    args.skip.none(report)?;
    let target = described.target(&args.node, None, report)?;
    let name = args.out.file_name().and_then(|name| name.to_str()).ok_or_else(|| {
        let message = format!("cannot write `{}`: it names no file", file_name::shown(&args.out));
        report.refuse(Diagnostic::without_place(codes::WRITE_FAILED, message).help("write the file's name"))
    })?;
    let interrupt = Interrupt::noted();
    let mut client = reach(&args.node, target, report)?;
    let written = parameters_of(&mut client, args, target, described.sources(), &interrupt, report)?;
    target.has_started(&mut client, report)?;
    let artifact =
        Artifact { path: name.to_owned(), bytes: written.text.into_bytes(), purpose: String::new() };
    let directory = args.out.parent().unwrap_or(Path::new(""));
    keep(directory, std::slice::from_ref(&artifact), forced(args.force, Existing::None))
        .map_err(|diagnostic| report.refuse(diagnostic))?;
    Ok(print(&kept_line(&args.out, written.count, target)))
}

/// Reads what a file sets, and reports where the node differs; the same for the files of a directory and the nodes of a
/// machine.
pub(super) fn compare(args: &NodeFileArgs, report: &Report) -> Result<u8, u8> {
    let described = Described::read(&args.spec, &args.node, report)?;
    if let Some(machine) = machine_of(&described, args) {
        return machine.compare(args, report);
    }
    let beside = beside_one(&described, args, report)?;
    let interrupt = Interrupt::noted();
    let mut client = reach(&args.node, beside.target, report)?;
    let code = compared(&mut client, &beside, &interrupt, report)?;
    beside.target.has_started(&mut client, report)?;
    Ok(code)
}

/// Writes what a file sets and the node has otherwise, and reads all of it back; the same for the files of a directory and the nodes of a
/// machine.
pub(super) fn restore(args: &NodeRestoreArgs, report: &Report) -> Result<u8, u8> {
    let described = Described::read(&args.file.spec, &args.file.node, report)?;
    if let Some(machine) = machine_of(&described, &args.file) {
        return machine.restore(args, report);
    }
    let beside = beside_one(&described, &args.file, report)?;
    let mut client = connect(&args.file.node.link, report)?;
    let mut code = SUCCESS;
    for mut outcome in restored(&mut client, args, std::slice::from_ref(&beside), report)? {
        outcome.heed_start(&mut client, report);
        code = worse(code, outcome.code);
    }
    Ok(code)
}

/// The machine whose nodes have a file each in the directory that a command line names.
fn machine_of<'d>(described: &'d Described, args: &NodeFileArgs) -> Option<&'d Machine> {
    match described {
        Described::Machine(machine) => args.file.is_dir().then_some(machine),
        Described::Devices { .. } => None,
    }
}

/// The file of a single node.
fn beside_one<'a>(described: &'a Described, args: &NodeFileArgs, report: &Report) -> Result<Beside<'a>, u8> {
    args.skip.none(report)?;
    let target_of = |files: &ParameterFiles| described.target(&args.node, Some(files), report);
    beside(described.sources(), args.file.clone(), target_of, report)
}

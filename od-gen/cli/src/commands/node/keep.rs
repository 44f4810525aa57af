//! `odgen node backup` and `compare`: the parameters of a node as a file.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use od_bus::client::{Bus, Client, kept};
use od_gen::Artifact;
use od_gen::files::Existing;
use od_import::parameters::{About, ParameterText, write_all};
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::model::Value;
use od_spec::source::SourceMap;
use od_spec::{Commissioning, Layer, ParameterValues, assign_layers};

use super::args::{NodeBackupArgs, NodeFileArgs};
use super::had::{Had, had, values, words};
use super::machine::Machine;
use super::reach::SERIAL_NUMBER;
use super::{Described, Target, on_the_bus, reach};
use crate::exit::{DIFFERS, ERRORS, SUCCESS};
use crate::interrupt::Interrupt;
use crate::output::{forced, keep};
use crate::report::{Report, print, shown};
use crate::settings::{ParameterFiles, parameter_files};

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
        let message = format!("cannot write `{}`: it names no file", args.out.display());
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

/// `  kept.yaml  24 values of valve (node 5)`.
pub(super) fn kept_line(file: &Path, count: usize, target: Target<'_>) -> String {
    format!("  {}  {} of {}\n", shown(file), values(count), target.name())
}

/// The parameter file of a node; what it cannot say is noted.
pub(super) fn parameters_of<B: Bus>(
    client: &mut Client<B>,
    args: &NodeBackupArgs,
    target: Target<'_>,
    sources: &SourceMap,
    interrupt: &Interrupt,
    report: &Report,
) -> Result<ParameterText, u8> {
    let had = had(client, target, kept(target.device), Some(interrupt), report)?;
    let mut node = Commissioning::of_node(target.device, target.id);
    // Nobody has asked the adapter.
    node.bit_rate = args.node.link.bit_rate.unwrap_or(0);
    node.values = had.values;
    node.serial_number = serial_number(client, target, report)?;
    let untold = had.untold.iter().map(|(id, why)| format!("{}: {why}", target.words().entry(*id)));
    let about = About {
        system: target.system,
        sources,
        device: target.device,
        names_device: true,
        node_id: Some(target.id),
    };
    let written = write_all(about, node, untold.collect());
    for (lines, what) in [(&written.left_out, "left out"), (&written.findings, "wrong")] {
        for line in lines {
            report.note(&format!("{}{what}: {line}", target.mark()));
        }
    }
    Ok(written)
}

/// The serial number by which a backup knows its node again; 0 says that there is none.
fn serial_number<B: Bus>(
    client: &mut Client<B>,
    target: Target<'_>,
    report: &Report,
) -> Result<Option<u32>, u8> {
    if target.device.entry(SERIAL_NUMBER).is_none() {
        return Ok(None);
    }
    match client.read(target.id, SERIAL_NUMBER) {
        Ok(bytes) => Ok(bytes.try_into().map(u32::from_le_bytes).ok().filter(|number| *number != 0)),
        Err(error) if error.is_of_entry() => Ok(None),
        Err(error) => Err(report.refuse(target.failed("read", SERIAL_NUMBER, &error))),
    }
}

/// A parameter file and the node that it is laid beside.
pub(super) struct Beside<'a> {
    pub(super) target: Target<'a>,
    pub(super) file: PathBuf,
    pub(super) sources: SourceMap,
    pub(super) layers: Vec<Layer>,
    /// The entries that the file sets, with their values.
    pub(super) meant: ParameterValues,
}

/// Reads a parameter file for a node and checks it as for a DCF. What is no error depends on what the node has, and is told then.
pub(super) fn beside<'a>(
    sources: &SourceMap,
    file: PathBuf,
    target_of: impl FnOnce(&ParameterFiles) -> Result<Target<'a>, u8>,
    report: &Report,
) -> Result<Beside<'a>, u8> {
    let (mut sources, mut diagnostics) = (sources.clone(), Diagnostics::new());
    let files = parameter_files(std::slice::from_ref(&file), &mut sources, &mut diagnostics)
        .map_err(|diagnostic| report.refuse(*diagnostic))?;
    if diagnostics.has_errors() {
        shown_errors(&diagnostics, &sources, report)?;
    }
    let mut target = target_of(&files)?;
    // The plant says whom the machine has; a file, whose values it holds.
    target.serial = target.serial.or_else(|| files.stated_serial());
    if let Some(stated) = files.stated_node().filter(|stated| *stated != target.id) {
        report.note(&format!("{} is of node {stated}, and this is node {}", shown(&file), target.id));
    }
    let system = target.system;
    files.check_device(system, target.device, &mut diagnostics);
    let layers = files.into_layers();
    let meant = assign_layers(system, target.device, target.id, &layers, &mut diagnostics).values;
    if on_the_bus(&diagnostics, &[]).has_errors() {
        shown_errors(&diagnostics, &sources, report)?;
    }
    Ok(Beside { target, file, sources, layers, meant })
}

/// Shows what a check says; its errors end the command.
pub(super) fn shown_errors(found: &Diagnostics, sources: &SourceMap, report: &Report) -> Result<(), u8> {
    let counting = on_the_bus(found, &[]);
    report.show(&counting, sources);
    if counting.has_errors() { Err(ERRORS) } else { Ok(()) }
}

/// Whether two values are one on a node.
fn is_same(one: &Value, other: &Value, node: u8) -> bool {
    one == other || one.integer_for(node).is_some_and(|raw| other.integer_for(node) == Some(raw))
}

/// Tells what a node has otherwise than a file, and what it does not tell; how many of each.
pub(super) fn told_differences(
    target: Target<'_>,
    meant: &ParameterValues,
    had: &Had,
    report: &Report,
) -> (usize, u8) {
    let (mut count, mut code) = (0, SUCCESS);
    for (id, wanted) in meant {
        let name = target.words().entry(*id);
        match had.values.get(id) {
            Some(held) if is_same(held, wanted, target.id) => {}
            Some(held) => {
                count += 1;
                let (wanted, held) = (words(target, *id, wanted), words(target, *id, held));
                let mark = target.mark();
                code = code.max(print(&format!("{mark}{name}: {held} in the node, {wanted} in the file\n")));
            }
            None => {
                let why = had.untold.iter().find(|(untold, _)| untold == id);
                let why = why.map_or("it cannot be read", |(_, why)| why.as_str());
                let message = format!("{}: cannot compare {name}: {why}", target.name());
                code = code.max(report.refuse(Diagnostic::without_place(codes::ACCESS_FAILED, message)));
            }
        }
    }
    (count, code)
}

/// Reads what a file sets, and tells where the node differs; the same for the files of a directory and the nodes of a machine.
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

/// The machine whose nodes have a file each in the directory that a command line names.
pub(super) fn machine_of<'d>(described: &'d Described, args: &NodeFileArgs) -> Option<&'d Machine> {
    match described {
        Described::Machine(machine) => args.file.is_dir().then_some(machine),
        Described::Devices { .. } => None,
    }
}

/// The file of a single node.
pub(super) fn beside_one<'a>(
    described: &'a Described,
    args: &NodeFileArgs,
    report: &Report,
) -> Result<Beside<'a>, u8> {
    args.skip.none(report)?;
    let target_of = |files: &ParameterFiles| described.target(&args.node, Some(files), report);
    beside(described.sources(), args.file.clone(), target_of, report)
}

/// Compares one node with its file; the exit code.
pub(super) fn compared<B: Bus>(
    client: &mut Client<B>,
    beside: &Beside<'_>,
    interrupt: &Interrupt,
    report: &Report,
) -> Result<u8, u8> {
    let Beside { target, file, meant, .. } = beside;
    let target = *target;
    let had = had(client, target, meant.keys().copied(), Some(interrupt), report)?;
    let (count, code) = told_differences(target, meant, &had, report);
    let not_in_file = kept(target.device).filter(|id| !meant.contains_key(id)).count();
    let differ = if count == 1 { "differs" } else { "differ" };
    let mut line = format!("{} of {} compared, {count} {differ}", values(meant.len()), shown(file));
    if not_in_file > 0 {
        let _ = write!(line, "; {not_in_file} further parameters of {} are not in it", target.name());
    }
    let printed = print(&format!("{line}\n"));
    Ok(match code.max(printed) {
        SUCCESS if count > 0 => DIFFERS,
        code => code,
    })
}

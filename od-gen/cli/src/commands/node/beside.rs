//! A parameter file compared with the node that it is for, and how the two differ.

use std::fmt::Write as _;
use std::path::PathBuf;

use od_bus::client::{Bus, Client, kept};
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::model::Value;
use od_spec::source::SourceMap;
use od_spec::{Layer, ParameterValues, assign_layers};

use super::had::{Had, had, values, words};
use super::{Target, on_the_bus};
use crate::exit::{DIFFERS, ERRORS, SUCCESS};
use crate::interrupt::Interrupt;
use crate::report::{Report, print, shown};
use crate::settings::{ParameterFiles, parameter_files};

/// A parameter file and the node that it is compared with.
pub(super) struct Beside<'a> {
    pub(super) target: Target<'a>,
    pub(super) file: PathBuf,
    pub(super) sources: SourceMap,
    pub(super) layers: Vec<Layer>,
    /// The entries that the file sets, with their values.
    pub(super) meant: ParameterValues,
}

/// Reads a parameter file for a node and checks it as for a DCF. What is not an error depends on what the node has, and
/// is reported then.
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

/// Reports what a node has otherwise than a file, and what it does not report; how many of each.
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
                let why = had.unreported.iter().find(|(unreported, _)| unreported == id);
                let why = why.map_or("it cannot be read", |(_, why)| why.as_str());
                let message = format!("{}: cannot compare {name}: {why}", target.name());
                code = code.max(report.refuse(Diagnostic::without_place(codes::ACCESS_FAILED, message)));
            }
        }
    }
    (count, code)
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

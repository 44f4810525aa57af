//! `odgen node backup`, `compare` and `restore`: the parameters of a node as a file.

use std::cell::OnceCell;
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use od_bus::client::{Bus, Client, involved, judged, kept, plan};
use od_gen::Artifact;
use od_gen::files::Existing;
use od_import::parameters::{About, ParameterText, write_all};
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::model::{EntryId, Index, Role, Value, Write};
use od_spec::source::{SourceMap, Span};
use od_spec::{Assigned, Commissioning, Layer, ParameterValues, assign_layers, rule_codes};

use super::args::{NodeBackupArgs, NodeFileArgs, NodeRestoreArgs};
use super::confirm::{Change, ConfirmArgs, preview};
use super::doubt::{Presence, Unwritten, sent};
use super::had::{Had, had, values, words};
use super::hand::{InHand, pdo_of, tell_unsent};
use super::reach::SERIAL_NUMBER;
use super::{Described, Target, has_started, on_the_bus, reach};
use crate::exit::{DIFFERS, ERRORS, SUCCESS};
use crate::interrupt::Interrupt;
use crate::output::{forced, keep};
use crate::report::{Report, print, shown};
use crate::settings::{ParameterFiles, parameter_files};

/// Writes a parameter file of what a node has; none where it does not answer.
pub(super) fn backup(args: &NodeBackupArgs, report: &Report) -> Result<u8, u8> {
    let described = Described::read(&args.node, report)?;
    if let Described::Machine(machine) = &described
        && args.node.node.is_none()
    {
        return machine.backup(args, report);
    }
    let target = described.target(&args.node, None, report)?;
    let name = args.out.file_name().and_then(|name| name.to_str()).ok_or_else(|| {
        let message = format!("cannot write `{}`: it names no file", args.out.display());
        report.refuse(Diagnostic::without_place(codes::WRITE_FAILED, message).help("write the file's name"))
    })?;
    let mut client = reach(&args.node, target, report)?;
    let written = parameters_of(&mut client, args, target, described.sources(), report)?;
    has_started(&mut client, target, report)?;
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
    report: &Report,
) -> Result<ParameterText, u8> {
    let had = had(client, target, kept(target.device), report)?;
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
    file: PathBuf,
    sources: SourceMap,
    layers: Vec<Layer>,
    /// The entries that the file sets, with their values.
    meant: ParameterValues,
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
fn shown_errors(found: &Diagnostics, sources: &SourceMap, report: &Report) -> Result<(), u8> {
    let counting = on_the_bus(found, &[]);
    report.show(&counting, sources);
    if counting.has_errors() { Err(ERRORS) } else { Ok(()) }
}

/// Whether two values are one on a node.
fn is_same(one: &Value, other: &Value, node: u8) -> bool {
    one == other || one.integer_for(node).is_some_and(|raw| other.integer_for(node) == Some(raw))
}

/// Tells what a node has otherwise than a file, and what it does not tell; how many of each.
fn told_differences(target: Target<'_>, meant: &ParameterValues, had: &Had, report: &Report) -> (usize, u8) {
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

/// What is done with a node and a parameter file.
#[derive(Clone, Copy)]
pub(super) enum WithFile<'a> {
    Compare,
    /// What allows the writes, and what ends them; Ctrl-C is noted from the first of them on.
    Restore(&'a ConfirmArgs, &'a OnceCell<Interrupt>),
}

impl WithFile<'_> {
    /// Done with all nodes: `compared`.
    pub(super) const fn done(self) -> &'static str {
        match self {
            Self::Compare => "compared",
            Self::Restore(ConfirmArgs { dry_run: true, .. }, _) => "looked at",
            Self::Restore(..) => "restored",
        }
    }

    /// Whether somebody wants it to end.
    pub(super) fn is_interrupted(self) -> bool {
        match self {
            Self::Compare => false,
            Self::Restore(_, interrupt) => interrupt.get().is_some_and(Interrupt::is_wanted),
        }
    }

    /// Does it; the exit code.
    pub(super) fn with<B: Bus>(
        self,
        client: &mut Client<B>,
        beside: &Beside<'_>,
        report: &Report,
    ) -> Result<u8, u8> {
        match self {
            Self::Compare => compared(client, beside, report),
            Self::Restore(confirm, interrupt) => restored(client, beside, confirm, interrupt, report),
        }
    }
}

/// Reads what a file sets, and tells where the node differs; the same for the files of a directory and the nodes of a machine.
pub(super) fn compare(args: &NodeFileArgs, report: &Report) -> Result<u8, u8> {
    with_file(args, WithFile::Compare, report)
}

/// Writes what a file sets and the node has otherwise, and reads all of it back; the same for the files of a directory and the nodes of a
/// machine.
pub(super) fn restore(args: &NodeRestoreArgs, report: &Report) -> Result<u8, u8> {
    with_file(&args.file, WithFile::Restore(&args.confirm, &OnceCell::new()), report)
}

fn with_file(args: &NodeFileArgs, work: WithFile<'_>, report: &Report) -> Result<u8, u8> {
    let described = Described::read(&args.node, report)?;
    if let Described::Machine(machine) = &described
        && args.file.is_dir()
    {
        return machine.with_files(args, work, report);
    }
    let target_of = |files: &ParameterFiles| described.target(&args.node, Some(files), report);
    let beside = beside(described.sources(), args.file.clone(), target_of, report)?;
    let mut client = reach(&args.node, beside.target, report)?;
    let code = work.with(&mut client, &beside, report)?;
    has_started(&mut client, beside.target, report)?;
    Ok(code)
}

fn compared<B: Bus>(client: &mut Client<B>, beside: &Beside<'_>, report: &Report) -> Result<u8, u8> {
    let Beside { target, file, meant, .. } = beside;
    let target = *target;
    let had = had(client, target, meant.keys().copied(), report)?;
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

fn restored<B: Bus>(
    client: &mut Client<B>,
    beside: &Beside<'_>,
    confirm: &ConfirmArgs,
    interrupt: &OnceCell<Interrupt>,
    report: &Report,
) -> Result<u8, u8> {
    let Beside { target, file, sources, layers, meant } = beside;
    let target = *target;
    let written_ids: BTreeSet<EntryId> = meant.keys().copied().collect();
    let asked_for = judged(target.system, target.device, &written_ids);
    let ids: BTreeSet<EntryId> =
        kept(target.device).chain(written_ids).chain(asked_for.iter().copied()).collect();
    let before = had(client, target, ids, report)?;
    // What the file does not set stays as the node has it, and rules look at that.
    before.tell_taken_for_default(target, &asked_for, report);
    let mut now = Commissioning::of_node(target.device, target.id);
    now.values.clone_from(&before.values);
    let mut diagnostics = Diagnostics::new();
    let of_node = now.configured(target.device);
    let assigned = assign_layers(target.system, &of_node, target.id, layers, &mut diagnostics);
    if on_the_bus(&diagnostics, &[]).has_errors() {
        report.note("nothing was written; with what the node has beside the values of the file:");
        shown_errors(&diagnostics, sources, report)?;
    }
    let writes =
        plan(target.system, target.device, target.id, &before.values, meant).map_err(|no_value| {
            let diagnostic = Diagnostic::without_place(rule_codes::VALUE_DOES_NOT_FIT, no_value.to_string());
            report.refuse(diagnostic.help("correct the value"))
        })?;
    shown_errors(&about_writes(&diagnostics, sources, &assigned, &writes), sources, report)?;
    for write in writes.iter().filter(|write| assigned.unlocked.contains(&write.id)) {
        report.note(&format!(
            "LOCKED {}: the device takes it only while it is unlocked for service",
            target.words().entry(write.id)
        ));
    }
    if !writes.is_empty() {
        let changes = changes(target, &before, &writes);
        let question = format!("write {} of {}", values(changes.len()), target.name());
        confirm.ask(&preview(target, &changes), &question, report)?;
    }
    let interrupt = interrupt.get_or_init(Interrupt::noted_with_hangup);
    let code = written(client, target, &writes, interrupt, report)?;
    let after = had(client, target, meant.keys().copied(), report)?;
    let (count, unread) = told_differences(target, meant, &after, report);
    let code = code.max(unread);
    if count > 0 {
        let has = if count == 1 { "has" } else { "have" };
        let message = format!("{}: {} of the file {has} not come back", target.name(), values(count));
        return Ok(code.max(
            report.refuse(
                Diagnostic::without_place(codes::ACCESS_FAILED, message)
                    .help("see above what the node has in their place"),
            ),
        ));
    }
    let held = values(meant.len());
    let line = format!("  {}  {held} read back as in {}\n", target.name(), shown(file));
    Ok(if code == SUCCESS { print(&line) } else { code })
}

/// What some writes change: of an entry that is written twice, as that of a PDO which is switched off and on, the last.
fn changes(target: Target<'_>, before: &Had, writes: &[Write]) -> Vec<Change> {
    let mut last: Vec<Change> = Vec::new();
    for write in writes {
        let old = before.values.get(&write.id).map(|old| words(target, write.id, old));
        let new = target.words().value(write.id, &write.bytes);
        last.retain(|change| change.id != write.id);
        last.push(Change { id: write.id, old, new });
    }
    last.retain(|change| change.old.as_ref() != Some(&change.new));
    last
}

/// What a check says, but of values that the node has already and that are not written.
fn about_writes(
    found: &Diagnostics,
    sources: &SourceMap,
    assigned: &Assigned,
    writes: &[Write],
) -> Diagnostics {
    let line = |span: Span| (span.file, sources.file(span.file).line_col(span.start).line);
    let written: BTreeSet<EntryId> = writes.iter().map(|write| write.id).collect();
    let unwritten = assigned.origins.iter().filter(|(id, _)| !written.contains(id));
    let unwritten: BTreeSet<_> = unwritten.map(|(_, origin)| line(origin.span)).collect();
    let mut told = Diagnostics::new();
    for one in found {
        if !one.labels.first().is_some_and(|label| unwritten.contains(&line(label.span))) {
            told.push(one.clone());
        }
    }
    told
}

/// What must not be written any more, as a node has refused something that belongs with it.
struct HeldBack<'a> {
    target: Target<'a>,
    /// What was refused, or held back itself.
    first: BTreeSet<EntryId>,
    /// What conditions join with that.
    joined: BTreeSet<EntryId>,
}

impl HeldBack<'_> {
    fn add(&mut self, id: EntryId) {
        self.first.insert(id);
        self.joined.extend(involved(self.target.system, self.target.device, &BTreeSet::from([id])));
    }

    /// A value beside one that did not come may break a condition, or switch on a PDO that carries something else; and what is not
    /// whole must not be stored.
    fn has(&self, id: EntryId) -> bool {
        let keeps = Role::of(id.index) == Role::StoreParameters || id.index == CONFIGURATION_DATE;
        let is_of_same_pdo =
            |one: &EntryId| pdo_of(one.index).is_some() && pdo_of(one.index) == pdo_of(id.index);
        self.joined.contains(&id)
            || self.first.iter().any(is_of_same_pdo)
            || (keeps && !self.first.is_empty())
    }
}

/// Verify configuration (1020h): what a configuration tool leaves behind when everything is written.
const CONFIGURATION_DATE: Index = Index(0x1020);

/// Carries out writes. One that is refused is told, and of the next ones those are tried that have nothing to do with it; the exit code
/// where the node is gone.
fn written<B: Bus>(
    client: &mut Client<B>,
    target: Target<'_>,
    writes: &[Write],
    interrupt: &Interrupt,
    report: &Report,
) -> Result<u8, u8> {
    let (mut code, mut in_hand) = (SUCCESS, InHand::new(interrupt));
    let mut held_back = HeldBack { target, first: BTreeSet::new(), joined: BTreeSet::new() };
    for (at, write) in writes.iter().enumerate() {
        if held_back.has(write.id) {
            let name = target.words().entry(write.id);
            report.note(&format!("not sent, as it belongs with what was refused: {name}"));
            held_back.add(write.id);
            continue;
        }
        if !in_hand.takes(write.id) {
            continue;
        }
        match sent(client, target, write.id, &write.bytes, report) {
            Ok(()) => {
                let line = super::access::line(target, write.id, &write.bytes);
                code = code.max(print(&format!("{}{line}  written\n", target.mark())));
            }
            Err(Unwritten { why, node }) => {
                code = code.max(report.refuse(*why));
                held_back.add(write.id);
                if node == Presence::Gone {
                    let unsent: Vec<EntryId> = writes.iter().skip(at + 1).map(|write| write.id).collect();
                    tell_unsent(target, &unsent, report);
                    return Err(code);
                }
            }
        }
    }
    in_hand.end(target, report).map(|()| code)
}

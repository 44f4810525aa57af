//! `odgen node read` and `odgen node write`.

use std::collections::BTreeSet;
use std::ops::Range;

use od_bus::client::{Bus, Client, judged};
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::model::{Dictionary, EntryId, Role, SubIndex, Value};
use od_spec::source::{SourceMap, Spanned};
use od_spec::{Commissioning, Layer, SettingNames, assign_layers, nearest, rule_codes};

use super::args::{NodeReadArgs, NodeWriteArgs};
use super::confirm::preview;
use super::doubt::{Untaken, sent};
use super::had::{had, tell_recovered, values};
use super::hand::InHand;
use super::hint::command;
use super::{Described, Target, on_the_bus, reach};
use crate::exit::{ERRORS, SUCCESS};
use crate::interrupt::Interrupt;
use crate::report::{Report, print};

/// Reads entries. What cannot be read is reported, and the others are still read.
pub(super) fn read(args: &NodeReadArgs, report: &Report) -> Result<u8, u8> {
    let described = Described::read(&args.spec, &args.node, report)?;
    let target = described.target(&args.node, None, report)?;
    let mut ids = Vec::new();
    for text in &args.entries {
        ids.extend(entries(target.device, text).map_err(|diagnostic| report.refuse(diagnostic))?);
    }
    let mut client = reach(&args.node, target, report)?;
    let (mut code, recovered) = (SUCCESS, client.recovered());
    for id in ids {
        match target.read(&mut client, id) {
            Ok(bytes) => code = code.max(print(&format!("{}\n", line(target, id, &bytes)))),
            Err(error) => {
                code = code.max(report.refuse(target.failed("read", id, &error)));
                if error.is_of_node() {
                    break;
                }
            }
        }
    }
    tell_recovered(target, client.recovered() - recovered, report);
    Ok(code)
}

/// `2000h brightness = 80 %  [50]`.
pub(super) fn line(target: Target<'_>, id: EntryId, bytes: &[u8]) -> String {
    let words = target.words();
    let hexadecimal: Vec<String> = bytes.iter().map(|byte| format!("{byte:02X}")).collect();
    format!("{} = {}  [{}]", words.entry(id), words.value(id, bytes), hexadecimal.join(" "))
}

/// The entries that a text means: one, or those of an object with several.
fn entries(device: &Dictionary, text: &str) -> Result<Vec<EntryId>, Diagnostic> {
    let names = SettingNames::of(device);
    let object = names.object(text).and_then(|index| device.objects.get(&index));
    let ids: Vec<EntryId> = match object.filter(|object| object.is_structured()) {
        Some(object) => {
            let readable = object.entries.iter().filter(|entry| entry.access.is_readable());
            readable.map(|entry| EntryId { index: object.index, sub: entry.sub }).collect()
        }
        None => names.entry(text).filter(|id| device.entry(*id).is_some()).into_iter().collect(),
    };
    if !ids.is_empty() {
        return Ok(ids);
    }
    let instead = names.instead(text);
    if !instead.is_empty() {
        let message = format!("`{text}` is the name of several entries of `{}`", device.key);
        let help = format!("write `{}`", instead.join("` or `"));
        return Err(Diagnostic::without_place(rule_codes::DUPLICATE_NAME, message).help(help));
    }
    let known = device.objects.values().map(|object| object.name.as_str());
    let help = nearest(text, known).map_or_else(
        || "write an index in hexadecimal (`607D.2`), an object's name, or `object.entry`".to_owned(),
        |name| format!("did you mean `{name}`?"),
    );
    let message = format!("`{}` has no entry `{text}`", device.key);
    Err(Diagnostic::without_place(codes::UNKNOWN_ENTRY, message).help(help))
}

/// Writes entries one after the other; ends with the first that fails.
pub(super) fn write(args: &NodeWriteArgs, report: &Report) -> Result<u8, u8> {
    let described = Described::read(&args.spec, &args.node, report)?;
    let target = described.target(&args.node, None, report)?;
    let (mut sources, mut diagnostics) = (described.sources().clone(), Diagnostics::new());
    let mut of_line = |what: &str, text: &String| {
        let file = sources.add(what, text.as_str());
        Spanned::new(text.clone(), sources.whole(file))
    };
    let settings: Vec<Spanned<String>> =
        args.settings.iter().map(|text| of_line("ENTRY=VALUE", text)).collect();
    let mut layer = Layer::of(od_spec::settings(&settings, &mut diagnostics));
    layer.unlocked = args.unlock.iter().map(|name| of_line("--unlock", name)).collect();
    let names = SettingNames::of(target.device);
    let meant = names.read(target.id, &layer.settings);
    if diagnostics.has_errors() || meant.len() < settings.len() {
        // What is not a value cannot be sent, and needs no bus to be reported.
        assign_layers(target.system, target.device, target.id, &[layer], &mut diagnostics);
        report.show(&diagnostics, &sources);
        return Err(ERRORS);
    }
    if let Some(command) = meant.iter().find_map(|(id, _)| instead(*id, target, args)) {
        return Err(report.refuse(command));
    }
    let mut client = reach(&args.node, target, report)?;
    let written: BTreeSet<EntryId> = meant.iter().map(|(id, _)| *id).collect();
    let judged = judged(target.system, target.device, &written);
    let before = had(&mut client, target, written.union(&judged).copied(), None, report)?;
    before.tell_taken_for_default(target, &judged, report);
    let changes = before.changes(target, &meant);
    let mut now = Commissioning::of_node(target.device, target.id);
    now.values = before.values;
    let mut unlocked = BTreeSet::new();
    let is_locked = |id| target.device.entry(id).is_some_and(|entry| entry.locked);
    for round in rounds(target.device, &meant) {
        let of_node = now.configured(target.device);
        let settings = layer.settings.get(round.clone()).unwrap_or_default().to_vec();
        let mut round_of = Layer::of(settings);
        round_of.unlocked.clone_from(&layer.unlocked);
        let assigned = assign_layers(target.system, &of_node, target.id, &[round_of], &mut diagnostics);
        unlocked.extend(assigned.unlocked);
        now.values.extend(meant.get(round).unwrap_or_default().iter().cloned());
        // The first round has reported the names that lift no lock.
        layer.unlocked.retain(|name| names.entry(&name.value).is_some_and(is_locked));
    }
    checked(&diagnostics, &sources, args.force, report)?;
    for id in &unlocked {
        report.note(&format!(
            "LOCKED {}: the device takes it only while it is unlocked for service",
            target.words().entry(*id)
        ));
    }
    let question = format!("write {} of {}", values(changes.len()), target.name());
    let store = command("store", &args.spec, target, &args.node);
    let interrupt = Interrupt::noted_with_hangup();
    args.confirm.ask(&preview(target, &changes, &store), &question, &interrupt, report)?;
    target.has_started(&mut client, report)?;
    let code = send(&mut client, target, &meant, &interrupt, report).unwrap_or_else(|code| code);
    let started = target.has_started(&mut client, report);
    Ok(started.map_or_else(|failed| code.max(failed), |()| code))
}

/// What is said of a write that is a command of its own.
fn instead(id: EntryId, target: Target<'_>, args: &NodeWriteArgs) -> Option<Diagnostic> {
    let name = match Role::of(id.index) {
        Role::StoreParameters => "store",
        Role::RestoreDefaults => "load-defaults",
        _ => return None,
    };
    let group = if id.sub == SubIndex(1) { String::new() } else { format!(" --group {}", id.sub) };
    let message = format!("{id} takes a signature, which is a command");
    let help = format!("write `{}{group}`", command(name, &args.spec, target, &args.node));
    Some(Diagnostic::without_place(rule_codes::IS_COMMAND, message).help(help))
}

/// Settings that can be looked at together: no entry is set twice in a round. CiA 301 changes a mapping by writing its number of
/// entries twice.
fn rounds(device: &Dictionary, meant: &[(EntryId, Value)]) -> Vec<Range<usize>> {
    let holder = |id: EntryId| {
        device.entry(id).and_then(|entry| entry.alias.as_ref()).map_or(id, |alias| alias.target)
    };
    let mut rounds = Vec::new();
    let (mut begin, mut set) = (0, BTreeSet::new());
    for (at, (id, _)) in meant.iter().enumerate() {
        if !set.insert(holder(*id)) {
            rounds.push(begin..at);
            (begin, set) = (at, BTreeSet::from([holder(*id)]));
        }
    }
    rounds.push(begin..meant.len());
    rounds
}

/// Shows what the check says, except what is about files that are loaded at boot: commands are given here by intention, and in the order
/// that is given, to a node that need not have its defaults.
fn checked(found: &Diagnostics, sources: &SourceMap, is_forced: bool, report: &Report) -> Result<(), u8> {
    let counting = on_the_bus(found, &[rule_codes::IS_COMMAND]);
    report.show(&counting, sources);
    match (counting.has_errors(), is_forced) {
        (false, _) => Ok(()),
        (true, true) => {
            report.note("`--force`: sent although the check says otherwise; the node has the last word");
            Ok(())
        }
        (true, false) => {
            report.note("nothing was sent, as the check with what the node has now fails; `--force` sends it all the same");
            Err(ERRORS)
        }
    }
}

/// Writes values, each followed by a word about it.
fn send<B: Bus>(
    client: &mut Client<B>,
    target: Target<'_>,
    meant: &[(EntryId, Value)],
    interrupt: &Interrupt,
    report: &Report,
) -> Result<u8, u8> {
    let (mut code, mut in_hand) = (SUCCESS, InHand::new(interrupt));
    for (at, (id, value)) in meant.iter().enumerate() {
        if !in_hand.takes(*id) {
            continue;
        }
        let entry = target.device.entry(*id);
        let bytes = entry.and_then(|entry| value.bytes_for(entry.data_type, target.id));
        let failed = match bytes {
            None => {
                let message = format!("{} cannot have the value", target.words().entry(*id));
                Some(
                    Diagnostic::without_place(rule_codes::VALUE_DOES_NOT_FIT, message)
                        .help("correct the value"),
                )
            }
            Some(bytes) => match sent(client, target, *id, &bytes, Untaken::Reported, report) {
                Ok(()) => {
                    in_hand.wrote(*id, &bytes);
                    // A full disk at standard output is no reason to leave a PDO switched off.
                    code = code.max(print(&format!("{}  written\n", line(target, *id, &bytes))));
                    None
                }
                Err(unwritten) => Some(*unwritten.why),
            },
        };
        if let Some(diagnostic) = failed {
            let code = code.max(report.refuse(diagnostic));
            let unsent: Vec<EntryId> = meant.iter().skip(at + 1).map(|(id, _)| *id).collect();
            in_hand.tell_unsent(client, target, &unsent, report);
            return Err(code);
        }
    }
    in_hand.end(client, target, report).map(|()| code)
}

//! `odgen node read` and `odgen node write`.

use std::collections::BTreeSet;

use od_bus::client::{AccessError, Bus, Client, involved};
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::model::{Dictionary, EntryId, Value};
use od_spec::source::{SourceMap, Spanned};
use od_spec::{Commissioning, Layer, SettingNames, assign_layers, nearest, rule_codes};

use super::args::{NodeReadArgs, NodeWriteArgs};
use super::doubt::sent;
use super::{Described, Target, on_the_bus, reach};
use crate::exit::{ERRORS, SUCCESS};
use crate::report::{Report, print};

/// Reads entries. What cannot be read is told, and the others are read all the same.
pub(super) fn read(args: &NodeReadArgs, report: &Report) -> Result<u8, u8> {
    let described = Described::read(&args.node, report)?;
    let target = described.target(&args.node, None, report)?;
    let mut ids = Vec::new();
    for text in &args.entries {
        ids.extend(entries(target.device, text).map_err(|diagnostic| report.refuse(diagnostic))?);
    }
    let mut client = reach(&args.node, target, report)?;
    let mut code = SUCCESS;
    for id in ids {
        match target.read(&mut client, id) {
            Ok(bytes) => code = code.max(print(&format!("{}\n", line(target, id, &bytes)))),
            Err(error) => {
                code = code.max(report.refuse(target.failed("read", id, &error)));
                if error.is_of_node() {
                    return Ok(code);
                }
            }
        }
    }
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
    let described = Described::read(&args.node, report)?;
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
    let meant = SettingNames::of(target.device).read(target.id, &layer.settings);
    if diagnostics.has_errors() || meant.len() < settings.len() {
        // What is no value cannot be sent, and needs no bus to be told.
        assign_layers(target.system, target.device, target.id, &[layer], &mut diagnostics);
        report.show(&diagnostics, &sources);
        return Err(ERRORS);
    }
    let mut client = reach(&args.node, target, report)?;
    let written: BTreeSet<EntryId> = meant.iter().map(|(id, _)| *id).collect();
    let mut now = Commissioning::of_node(target.device, target.id);
    for id in involved(target.system, target.device, &written) {
        if let Some(value) = asked(&mut client, target, id, report)? {
            now.values.insert(id, value);
        }
    }
    let of_node = now.configured(target.device);
    let assigned = assign_layers(target.system, &of_node, target.id, &[layer], &mut diagnostics);
    checked(&diagnostics, &sources, args.force, report)?;
    for id in &assigned.unlocked {
        report.note(&format!(
            "LOCKED {}: the device takes it only while it is unlocked for service",
            target.words().entry(*id)
        ));
    }
    send(&mut client, target, &meant, report)
}

/// What a node has now in an entry that a condition asks for.
fn asked<B: Bus>(
    client: &mut Client<B>,
    target: Target<'_>,
    id: EntryId,
    report: &Report,
) -> Result<Option<Value>, u8> {
    let data_type = target.device.entry(id).map(|entry| entry.data_type);
    let why = match client.read(target.id, id) {
        Ok(bytes) => match data_type.and_then(|data_type| Value::from_bytes(data_type, &bytes)) {
            Some(value) => return Ok(Some(value)),
            None => "it holds no value of its type".to_owned(),
        },
        Err(error) if error.is_of_entry() => error.to_string(),
        Err(error) => return Err(report.refuse(target.failed("read", id, &error))),
    };
    report.note(&has_default(target, id, &why));
    Ok(None)
}

/// What is said of an entry that a condition asks for and a node does not tell.
pub(super) fn has_default(target: Target<'_>, id: EntryId, why: &str) -> String {
    let name = target.words().entry(id);
    format!("a condition asks for {name}, which cannot be read ({why}): it is taken to have its default")
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
    report: &Report,
) -> Result<u8, u8> {
    for (at, (id, value)) in meant.iter().enumerate() {
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
            Some(bytes) => match sent(client, target, *id, &bytes, report) {
                Ok(()) => {
                    let code = print(&format!("{}  written\n", line(target, *id, &bytes)));
                    if code != SUCCESS {
                        return Err(code);
                    }
                    None
                }
                Err(unwritten) => Some(*unwritten.why),
            },
        };
        if let Some(diagnostic) = failed {
            let code = report.refuse(diagnostic);
            for (id, _) in meant.iter().skip(at + 1) {
                report.note(&format!("not sent any more: {}", target.words().entry(*id)));
            }
            return Err(code);
        }
    }
    Ok(SUCCESS)
}

/// What is said of a write that failed.
pub(super) fn not_written(target: Target<'_>, id: EntryId, error: &AccessError) -> Diagnostic {
    let diagnostic = target.failed("write", id, error);
    let is_locked = target.device.entry(id).is_some_and(|entry| entry.locked);
    match error {
        AccessError::Refused(_) if is_locked => {
            diagnostic.help("the entry is locked: unlock the device for service first")
        }
        _ => diagnostic,
    }
}

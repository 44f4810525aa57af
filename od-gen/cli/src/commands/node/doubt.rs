//! A write, and what a node has where its answer to it was lost or broken.

use od_bus::client::{AccessError, Bus, Client, value};
use od_spec::diag::Diagnostic;
use od_spec::model::EntryId;

use super::Target;
use crate::report::Report;

/// What is said of a value that a node did not take, or of which it is not known.
pub(super) struct Unwritten {
    pub(super) why: Box<Diagnostic>,
    pub(super) node: Presence,
}

/// Whether another access is worth a try.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Presence {
    Here,
    Gone,
}

impl Presence {
    const fn after(error: &AccessError) -> Self {
        if error.is_of_node() { Self::Gone } else { Self::Here }
    }
}

/// What follows where the value that is read back shows that the node did not take a write.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Untaken {
    /// It is reported: what the user writes may be a command, of which the value does not show that it was carried out.
    Reported,
    /// It is written once more: what a parameter file holds is a value, and half of a PDO would be left.
    WrittenAgain,
}

/// Writes a value. After an answer that was lost or broken, the value is read back first, as a second write may do something else than
/// the first.
pub(super) fn sent<B: Bus>(
    client: &mut Client<B>,
    target: Target<'_>,
    id: EntryId,
    bytes: &[u8],
    untaken: Untaken,
    report: &Report,
) -> Result<(), Unwritten> {
    let Err(error) = client.write(target.id, id, bytes) else { return Ok(()) };
    let unwritten = |node, note: Option<String>| {
        let why = not_written(target, id, &error);
        let why = Box::new(match note {
            Some(note) => why.note(note),
            None => why,
        });
        Err(Unwritten { why, node })
    };
    let unknown = |why: &str| Some(format!("whether the node took the value is not known: {why}"));
    if error.is_of_entry() {
        return unwritten(Presence::Here, None);
    }
    if matches!(error, AccessError::Bus(_)) {
        return unwritten(Presence::Gone, unknown("read it"));
    }
    let Some(entry) = target.device.entry(id).filter(|entry| entry.access.is_readable()) else {
        return unwritten(Presence::after(&error), unknown("it cannot be read"));
    };
    match target.read(client, id) {
        Ok(held) if value(entry, &held).is_some_and(|held| value(entry, bytes) == Some(held)) => {
            let name = target.words().entry(id);
            report.note(&format!("{}{name}: {error}; read back, it has the value", target.mark()));
            Ok(())
        }
        Ok(_) if untaken == Untaken::WrittenAgain => {
            let name = target.words().entry(id);
            report.note(&format!(
                "{}{name}: {error}; read back, it does not have the value, which is written again",
                target.mark()
            ));
            sent(client, target, id, bytes, Untaken::Reported, report)
        }
        Ok(held) => {
            unwritten(Presence::Here, Some(format!("read back, it is {}", target.words().value(id, &held))))
        }
        Err(unread) => {
            unwritten(Presence::after(&unread), unknown(&format!("it cannot be read back: {unread}")))
        }
    }
}

/// What is said of a write that failed.
fn not_written(target: Target<'_>, id: EntryId, error: &AccessError) -> Diagnostic {
    let diagnostic = target.failed("write", id, error);
    let is_locked = target.device.entry(id).is_some_and(|entry| entry.locked);
    match error {
        AccessError::Refused(_) if is_locked => {
            diagnostic.help("the entry is locked: unlock the device for service first")
        }
        _ => diagnostic,
    }
}

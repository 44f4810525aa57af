//! What a node has in its entries.

use std::collections::BTreeSet;

use od_bus::client::{AccessError, Bus, Client, value};
use od_spec::ParameterValues;
use od_spec::diag::{Diagnostic, codes};
use od_spec::model::{EntryId, Value};

use super::Target;
use super::confirm::Change;
use crate::exit::INTERRUPTED;
use crate::interrupt::Interrupt;
use crate::progress::Progress;
use crate::report::Report;

/// What a node has, and what it does not report, with the reason.
pub(super) struct Had {
    pub(super) values: ParameterValues,
    pub(super) unreported: Vec<(EntryId, String)>,
}

/// So many entries that cannot be read are named with the reason, each on a line.
const NAMED: usize = 4;

impl Had {
    /// What some writes change, one after the other.
    pub(super) fn changes(&self, target: Target<'_>, meant: &[(EntryId, Value)]) -> Vec<Change> {
        let mut now = self.values.clone();
        let change = |(id, value): &(EntryId, Value)| {
            let old = now.insert(*id, value.clone());
            let old = old.map(|old| words(target, *id, &old));
            Change { id: *id, old, new: words(target, *id, value) }
        };
        meant.iter().map(change).collect()
    }

    /// Says of entries that rules look at, and that the node does not report, that they are taken to have their
    /// defaults.
    pub(super) fn tell_taken_for_default(
        &self,
        target: Target<'_>,
        judged: &BTreeSet<EntryId>,
        report: &Report,
    ) {
        let mark = target.mark();
        let unreported: Vec<_> = self.unreported.iter().filter(|(id, _)| judged.contains(id)).collect();
        for (id, why) in unreported.iter().take(NAMED) {
            let name = target.words().entry(*id);
            report.note(&format!(
                "{mark}a rule looks at {name}, which cannot be read ({why}): it is taken to have its default"
            ));
        }
        let more: Vec<String> = unreported.iter().skip(NAMED).map(|(id, _)| id.to_string()).collect();
        if !more.is_empty() {
            report.note(&format!(
                "{mark}so are {} more that cannot be read: {}",
                more.len(),
                more.join(", ")
            ));
        }
    }
}

/// Reads entries; what a node refuses is noted. The exit code after a message where nothing can be read any more, or the user has
/// interrupted a command that changes nothing.
pub(super) fn had<B: Bus>(
    client: &mut Client<B>,
    target: Target<'_>,
    ids: impl IntoIterator<Item = EntryId>,
    interrupt: Option<&Interrupt>,
    report: &Report,
) -> Result<Had, u8> {
    let ids: Vec<EntryId> = ids.into_iter().collect();
    let recovered = client.recovered();
    let mut progress = Progress::new("read", "values", ids.len(), report.audience());
    let had = had_of(client, target, &ids, interrupt, &mut progress);
    progress.clear();
    tell_recovered(target, client.recovered() - recovered, report);
    had.map_err(|unread| match unread {
        Unread::Failed(id, error) => report.refuse(target.failed("read", id, &error)),
        Unread::Interrupted => {
            let message = format!("{}: interrupted before all was read", target.name());
            report.refuse(
                Diagnostic::without_place(codes::ACCESS_FAILED, message)
                    .help("nothing was changed; give the command again"),
            );
            INTERRUPTED
        }
    })
}

/// Notes that so many values were read only when they were asked for again: the bus is to be looked at.
pub(super) fn tell_recovered(target: Target<'_>, count: usize, report: &Report) {
    let was = match count {
        0 => return,
        1 => "was",
        _ => "were",
    };
    report.note(&format!(
        "{}{} {was} read only when asked for again: frames were lost or broken, or the node is slow",
        target.mark(),
        values(count)
    ));
}

/// Why not all entries were read.
enum Unread {
    Failed(EntryId, AccessError),
    Interrupted,
}

fn had_of<B: Bus>(
    client: &mut Client<B>,
    target: Target<'_>,
    ids: &[EntryId],
    interrupt: Option<&Interrupt>,
    progress: &mut Progress,
) -> Result<Had, Unread> {
    let mut had = Had { values: ParameterValues::new(), unreported: Vec::new() };
    for (at, id) in ids.iter().copied().enumerate() {
        progress.show(at);
        if interrupt.is_some_and(Interrupt::is_wanted) {
            return Err(Unread::Interrupted);
        }
        let Some(entry) = target.device.entry(id) else { continue };
        match target.read(client, id) {
            Ok(bytes) => match value(entry, &bytes) {
                Some(value) => {
                    // A formula with the node-ID is what the value means, where it is the default.
                    let default = entry.default.as_ref().filter(|default| {
                        let raw = default.integer_for(target.id);
                        raw.is_some() && raw == value.integer()
                    });
                    had.values.insert(id, default.cloned().unwrap_or(value));
                }
                None => had.unreported.push((id, format!("no value of type {}", entry.data_type.name()))),
            },
            // What a bad bus kept back is not left out of a file that is taken for whole.
            Err(error) if !error.is_of_node() && !error.is_of_frames() => {
                had.unreported.push((id, error.to_string()));
            }
            Err(error) => return Err(Unread::Failed(id, error)),
        }
    }
    Ok(had)
}

/// A value in words.
pub(super) fn words(target: Target<'_>, id: EntryId, value: &Value) -> String {
    let bytes = target.device.entry(id).and_then(|entry| value.bytes_for(entry.data_type, target.id));
    bytes.map_or_else(|| "no value".to_owned(), |bytes| target.words().value(id, &bytes))
}

/// `1 value`, `2 values`.
pub(super) fn values(count: usize) -> String {
    format!("{count} value{}", if count == 1 { "" } else { "s" })
}

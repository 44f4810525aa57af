//! Names of the format: ASCII, no more than 32 characters, none twice in one message.

use std::collections::BTreeMap;

use od_gen::plan::Words;
use od_spec::model::{Dictionary, EntryId};

use super::Node;

/// Longest name that every tool takes.
pub(super) const LONGEST: usize = 32;
/// Longest name of a node, so that `_heartbeat` and `_RPDO512` have room after it.
const LONGEST_OF_NODE: usize = LONGEST - "_heartbeat".len();

/// The name of a signal, whole and as the format takes it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct SignalName {
    /// As the format takes it.
    pub short: String,
    /// The whole name.
    pub long: String,
}

impl SignalName {
    /// A name that fits as it is.
    pub(super) fn plain(name: &str) -> Self {
        Self { short: name.to_owned(), long: name.to_owned() }
    }
}

/// What a signal is named after.
#[derive(Debug, Clone)]
pub(super) struct Named {
    /// The words of its name.
    pub words: Words,
    /// The words that matter most, where a part has to do.
    pub most: Words,
    /// Where its value lies: an entry, and of a bit field the lowest bit.
    pub id: EntryId,
    /// Lowest bit of a part of the entry.
    pub bit: Option<u8>,
}

impl Named {
    /// What distinguishes it from every other signal of a node: `_6041_0_b3`.
    fn number(&self) -> String {
        let EntryId { index, sub } = self.id;
        let bit = self.bit.map(|bit| format!("_b{bit}")).unwrap_or_default();
        format!("_{:04X}_{}{bit}", index.0, sub.0)
    }

    /// The name with its number after it, cut before the number where it is too long.
    fn numbered(&self, words: &Words, longest: usize) -> String {
        let number = self.number();
        let name = words.snake();
        if name.is_empty() {
            return format!("x{}", number.trim_start_matches('_'));
        }
        format!("{}{number}", cut(&name, longest.saturating_sub(number.len())))
    }
}

/// The beginning of a name, without a `_` at its end.
fn cut(name: &str, longest: usize) -> &str {
    name.get(..longest).unwrap_or(name).trim_end_matches('_')
}

/// The names of the signals of a message. A name that is too long, or that two signals would have, gets the number of its entry:
/// so it does not depend on what else the message carries first.
pub(super) fn signal_names(named: &[Named]) -> Vec<SignalName> {
    let mut wanted: BTreeMap<String, usize> = BTreeMap::new();
    for one in named {
        *wanted.entry(one.words.snake()).or_default() += 1;
    }
    let mut given: BTreeMap<String, usize> = BTreeMap::new();
    let names = named.iter().map(|one| {
        let whole = one.words.snake();
        let is_alone = !whole.is_empty() && wanted.get(&whole) == Some(&1);
        let long = if is_alone { whole } else { one.numbered(&one.words, usize::MAX) };
        let short = if long.len() <= LONGEST { long.clone() } else { one.numbered(&one.most, LONGEST) };
        // An entry that is mapped twice.
        let count = given.entry(short.clone()).or_default();
        *count += 1;
        if *count == 1 {
            return SignalName { short, long };
        }
        let behind = format!("_again{count}");
        let short = format!("{}{behind}", cut(&short, LONGEST - behind.len()));
        SignalName { short, long: format!("{long}{behind}") }
    });
    names.collect()
}

/// The name of a node: `pmc_5`.
pub(super) fn node_name(node: &Node<'_>) -> String {
    let whole = whole_node_name(node);
    if whole.len() <= LONGEST_OF_NODE {
        return whole;
    }
    let number = format!("_{}", node.id);
    format!("{}{number}", cut(&whole, LONGEST_OF_NODE - number.len()))
}

/// The name of a node, however long it is.
pub(super) fn whole_node_name(node: &Node<'_>) -> String {
    let key = Words::of(&node.device.key).snake();
    if key.is_empty() { format!("node_{}", node.id) } else { format!("{key}_{}", node.id) }
}

/// The words of an entry's name, and those that matter most.
pub(super) fn of_entry(device: &Dictionary, id: EntryId) -> (Words, Words) {
    let object = device.objects.get(&id.index);
    let entry = object.and_then(|object| object.entry(id.sub));
    match (object, entry) {
        (Some(object), Some(entry)) if object.is_structured() => {
            (Words::of(&object.name).and(&entry.name), Words::of(&entry.name))
        }
        (Some(object), _) => (Words::of(&object.name), Words::of(&object.name)),
        (None, _) => (Words::of(""), Words::of("")),
    }
}

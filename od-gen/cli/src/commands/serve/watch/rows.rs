//! What is to be seen of nodes: their states, and the values of their entries.

use std::collections::BTreeSet;

use firmware_glue::nmt::State;
use od_bus::runtime::Bus;
use od_bus::trace::Node;
use od_spec::model::{EntryId, PdoTarget};
use od_spec::visible::visible;

/// Which entries are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scope {
    /// Those that PDOs carry as specified, and those whose values have changed.
    Moving,
    /// All of them.
    All,
}

/// A node.
struct Seen<'a> {
    node: Node<'a>,
    name: String,
    state: Option<State>,
    emergency: Option<String>,
    entries: Vec<Entry>,
}

struct Entry {
    id: EntryId,
    name: String,
    /// The name in small letters, by which it is found.
    small: String,
    is_carried: bool,
    first: Option<Vec<u8>>,
    now: Option<Vec<u8>>,
}

/// A row on the screen.
pub(super) enum Row {
    /// A node: its name, its state, its last emergency.
    Node { name: String, state: &'static str, emergency: Option<String> },
    /// An entry with its value.
    Entry { name: String, value: String },
}

/// All rows.
pub(super) struct Rows<'a> {
    nodes: Vec<Seen<'a>>,
    scope: Scope,
    /// A part of the names of entries that are shown.
    pub(super) filter: String,
}

impl<'a> Rows<'a> {
    pub(super) fn new(nodes: Vec<Node<'a>>, bus: &Bus<'_>) -> Self {
        let seen = |node: Node<'a>| {
            let pdos = node.device.pdos.iter().flat_map(|pdo| &pdo.map);
            let carried: BTreeSet<EntryId> = pdos
                .filter_map(|mapped| match mapped.target {
                    PdoTarget::Entry(id) => Some(id),
                    PdoTarget::Dummy(_) => None,
                })
                .collect();
            let entries = node.device.entries().map(|(id, _, _)| {
                let name = visible(&node.entry(id)).into_owned();
                let small = name.to_lowercase();
                Entry { id, name, small, is_carried: carried.contains(&id), first: None, now: None }
            });
            let entries = entries.collect();
            Seen { name: node.name(), node, state: None, emergency: None, entries }
        };
        let mut rows = Self {
            nodes: nodes.into_iter().map(seen).collect(),
            scope: Scope::Moving,
            filter: String::new(),
        };
        rows.look(bus);
        for entry in rows.nodes.iter_mut().flat_map(|seen| &mut seen.entries) {
            entry.first.clone_from(&entry.now);
        }
        rows
    }

    /// Looks at what the nodes have now.
    pub(super) fn look(&mut self, bus: &Bus<'_>) {
        for (seen, node) in self.nodes.iter_mut().zip(bus.nodes()) {
            seen.state = Some(node.state());
            let dictionary = node.dictionary();
            for entry in &mut seen.entries {
                let id = firmware_glue::EntryId { index: entry.id.index.0, sub: entry.id.sub.0 };
                entry.now = dictionary.value(id);
            }
        }
    }

    /// A node has reported an error, or that it is gone.
    pub(super) fn emergency(&mut self, node: u8, text: &str) {
        if let Some(seen) = self.nodes.iter_mut().find(|seen| seen.node.id == node) {
            seen.emergency = Some(text.to_owned());
        }
    }

    /// Shows all entries, or no longer.
    pub(super) const fn turn(&mut self) {
        self.scope = match self.scope {
            Scope::Moving => Scope::All,
            Scope::All => Scope::Moving,
        };
    }

    pub(super) const fn scope(&self) -> Scope {
        self.scope
    }

    /// Which rows there are: the position of a node, and of one of its entries.
    fn places(&self) -> Vec<(usize, Option<usize>)> {
        let filter = self.filter.to_lowercase();
        let mut places = Vec::new();
        for (at, seen) in self.nodes.iter().enumerate() {
            places.push((at, None));
            let is_shown = |entry: &Entry| {
                let is_of_scope = match self.scope {
                    Scope::All => true,
                    Scope::Moving => entry.is_carried || entry.first != entry.now,
                };
                is_of_scope && entry.small.contains(&filter)
            };
            let shown = seen.entries.iter().enumerate().filter(|(_, entry)| is_shown(entry));
            places.extend(shown.map(|(entry, _)| (at, Some(entry))));
        }
        places
    }

    /// How many rows there are.
    pub(super) fn count(&self) -> usize {
        self.places().len()
    }

    /// Some of the rows, with their values in words.
    pub(super) fn part(&self, first: usize, count: usize) -> Vec<Row> {
        let row = |(node, entry): (usize, Option<usize>)| {
            let seen = self.nodes.get(node)?;
            let Some(entry) = entry else {
                let state = match seen.state {
                    Some(State::Initialising) | None => "initialising",
                    Some(State::PreOperational) => "pre-operational",
                    Some(State::Operational) => "operational",
                    Some(State::Stopped) => "stopped",
                };
                let (name, emergency) = (seen.name.clone(), seen.emergency.clone());
                return Some(Row::Node { name, state, emergency });
            };
            let entry = seen.entries.get(entry)?;
            let value = match &entry.now {
                Some(bytes) => seen.node.value(entry.id, bytes),
                None => "–".to_owned(),
            };
            Some(Row::Entry { name: entry.name.clone(), value: visible(&value).into_owned() })
        };
        self.places().into_iter().skip(first).take(count).filter_map(row).collect()
    }
}

//! The application of a virtual node.

use std::collections::BTreeMap;

use firmware_glue::lss::{BitRate, LssHandler, MaybeNode, Reply};
use firmware_glue::node::{Event, NodeHandler, Reset};
use firmware_glue::pdo::engine::PdoHandler;
use firmware_glue::storage::{ALL, Command};
use firmware_glue::{AbortCode, Application, Dictionary, EntryId, NodeId, Storage};

use super::LiveDictionary;
use super::programs::Programs;

/// What a virtual node checks of a value beyond what its dictionary says. A firmware chooses, too: it gives its services the application, or
/// the application inside [`firmware_glue::Consistent`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Checks {
    /// Nothing.
    #[default]
    None,
    /// That no constraint breaks that held before; a client gets [`AbortCode::INCOMPATIBLE`].
    Constraints,
}

/// The application of a virtual node: it keeps parameters for as long as the program runs, and notes what happens.
#[derive(Debug)]
pub(super) struct Host {
    /// What was stored on command.
    stored: BTreeMap<Storage, Stored>,
    /// The node that the values of a group in the dictionary are for.
    nodes: BTreeMap<Storage, NodeId>,
    /// Entries that were written and not yet reported.
    changed: Vec<EntryId>,
    has_restarted: bool,
    checks: Checks,
    /// In kbit/s, as LSS can switch between them.
    bit_rates: Vec<u16>,
    /// DOMAINs that were written to.
    domains: BTreeMap<EntryId, Vec<u8>>,
    /// The DOMAIN that is being written, which takes the place of the old one when it is whole.
    coming: Option<(EntryId, Vec<u8>)>,
    programs: Programs,
}

/// Values of a storage group.
#[derive(Debug)]
struct Stored {
    /// Whose they are, if they follow the node-ID.
    node: Option<NodeId>,
    bytes: Vec<u8>,
}

/// No DOMAIN is longer: what clients send is kept in memory.
const LONGEST_DOMAIN: usize = 16 << 20;

impl Host {
    pub(super) fn new(dictionary: &LiveDictionary<'_>) -> Self {
        let bit_rates = dictionary.lss().map(|lss| lss.bit_rates.clone()).unwrap_or_default();
        let checks = Checks::None;
        Self {
            stored: BTreeMap::new(),
            nodes: BTreeMap::new(),
            changed: Vec::new(),
            has_restarted: false,
            checks,
            bit_rates,
            domains: BTreeMap::new(),
            coming: None,
            programs: Programs::of(dictionary),
        }
    }

    pub(super) const fn check(&mut self, checks: Checks) {
        self.checks = checks;
    }

    /// Whether the node has started again; said once.
    pub(super) const fn has_restarted(&mut self) -> bool {
        std::mem::replace(&mut self.has_restarted, false)
    }

    /// Entries that were written; each said once.
    pub(super) fn changed(&mut self) -> Vec<EntryId> {
        std::mem::take(&mut self.changed)
    }
}

impl Application<LiveDictionary<'_>> for Host {
    /// Looks at constraints, where it is to; carries out commands for programs.
    fn accept(
        &mut self,
        dictionary: &mut LiveDictionary<'_>,
        entry: EntryId,
        value: &[u8],
    ) -> Result<(), AbortCode> {
        match self.checks {
            Checks::None => {}
            Checks::Constraints if dictionary.stays_consistent(entry, value) => {}
            Checks::Constraints => return Err(AbortCode::INCOMPATIBLE),
        }
        self.programs.accept(entry, value)
    }

    fn command(&mut self, dictionary: &mut LiveDictionary<'_>, command: Command) -> Result<(), AbortCode> {
        for storage in command.groups() {
            match command {
                Command::Save(_) => {
                    let follows = dictionary.follows_node_id(*storage);
                    let node = self.nodes.get(storage).copied().filter(|_| follows);
                    let bytes = dictionary.stored(*storage).to_vec();
                    self.stored.insert(*storage, Stored { node, bytes });
                }
                // It takes effect with the next reset.
                Command::Restore(_) => drop(self.stored.remove(storage)),
            }
        }
        Ok(())
    }

    fn changed(&mut self, dictionary: &mut LiveDictionary<'_>, entry: EntryId) {
        self.programs.report(dictionary);
        self.changed.push(entry);
    }

    /// A DOMAIN has what was written to it last, and nothing before.
    fn read_domain(
        &mut self,
        _: &mut LiveDictionary<'_>,
        entry: EntryId,
        offset: u32,
        buffer: &mut [u8],
    ) -> Result<usize, AbortCode> {
        let whole = self.domains.get(&entry).ok_or(AbortCode::NO_DATA)?;
        let rest = usize::try_from(offset).ok().and_then(|offset| whole.get(offset..)).unwrap_or_default();
        let count = rest.len().min(buffer.len());
        if let (Some(to), Some(from)) = (buffer.get_mut(..count), rest.get(..count)) {
            to.copy_from_slice(from);
        }
        Ok(count)
    }

    fn write_domain(
        &mut self,
        dictionary: &mut LiveDictionary<'_>,
        entry: EntryId,
        offset: u32,
        data: &[u8],
        last: bool,
    ) -> Result<(), AbortCode> {
        self.programs.takes(entry)?;
        let (of, mut whole) = match self.coming.take() {
            Some(coming) if offset > 0 => coming,
            _ => (entry, Vec::new()),
        };
        if of != entry || usize::try_from(offset) != Ok(whole.len()) {
            return Err(AbortCode::NOT_STORED);
        }
        if whole.len() + data.len() > LONGEST_DOMAIN {
            return Err(AbortCode::OUT_OF_MEMORY);
        }
        whole.extend(data);
        if last {
            self.programs.loaded(entry, &whole);
            self.programs.report(dictionary);
            self.domains.insert(entry, whole);
        } else {
            self.coming = Some((entry, whole));
        }
        Ok(())
    }
}

impl PdoHandler<LiveDictionary<'_>> for Host {}

impl LssHandler for Host {
    /// A bus inside a program has no bit rate; the device says which ones it would have.
    fn has_bit_rate(&self, rate: BitRate) -> bool {
        rate.kbits().is_some_and(|rate| self.bit_rates.contains(&rate))
    }

    /// The node has it until the program ends, and there is no power-off before.
    fn store(&mut self, _: MaybeNode, _: Option<BitRate>) -> Reply {
        Reply::Done
    }
}

impl NodeHandler<LiveDictionary<'_>> for Host {
    fn restart(&mut self, dictionary: &mut LiveDictionary<'_>, node: NodeId, reset: Reset) {
        let groups: &[Storage] = match reset {
            Reset::Node => &ALL,
            Reset::Communication => &[Storage::Communication],
        };
        for storage in groups {
            self.nodes.insert(*storage, node);
            // What follows another node-ID would have this node use the identifiers of that one.
            if let Some(stored) = self.stored.get(storage)
                && stored.node.is_none_or(|saved| saved == node)
            {
                let layout = dictionary.layout(*storage);
                // It has given the bytes itself.
                let _ = dictionary.restore(*storage, layout, &stored.bytes);
            }
        }
        tell_commands(dictionary);
        self.programs.restart(reset);
        self.programs.report(dictionary);
        self.has_restarted = true;
    }

    fn node_event(&mut self, _: &mut LiveDictionary<'_>, event: Event) {
        if let Event::State(state) = event {
            self.programs.enter(state);
        }
    }
}

/// Says in 1010h and 1011h that parameters are stored, and defaults restored, on command (CiA 301 7.5.2.13, 7.5.2.14), where
/// the device does not say what it does.
fn tell_commands(dictionary: &mut LiveDictionary<'_>) {
    const ON_COMMAND: [u8; 4] = [1, 0, 0, 0];
    let commands = [0x1010, 0x1011].into_iter().flat_map(|index| (1..=127).map(move |sub| (index, sub)));
    for (index, sub) in commands {
        if let Ok(entry) = dictionary.find(index, sub)
            && dictionary.value(entry).is_some_and(|value| value == [0; 4])
        {
            // A constant says itself what the device does.
            let _ = dictionary.hold(entry, &ON_COMMAND);
        }
    }
}

#[cfg(test)]
mod tests;

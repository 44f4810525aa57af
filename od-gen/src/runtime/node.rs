//! A node that no hardware has: its dictionary, its SDO servers, its state and its heartbeat.

use std::collections::BTreeMap;
use std::fmt;

use firmware_glue::frame::{CanId, Frame};
use firmware_glue::sdo::{Channel, SdoServer};
use firmware_glue::table::{EntryRow, Place};
use firmware_glue::{AbortCode, Application, Dictionary, EntryId, Storage};

use super::LiveDictionary;

/// Microseconds of a millisecond.
const MILLISECOND: u64 = 1000;
/// What a node stores on command, one after the other.
const STORED: [Storage; 3] = [Storage::Communication, Storage::Application, Storage::Manufacturer];

/// A virtual node. Frames go in, frames come out, and the time is told, in microseconds from any beginning.
///
/// It boots, has the states of NMT, sends its heartbeat (1017h) or answers node guarding, serves SDO on every channel of 1200h to
/// 127Fh, and stores and restores parameters (1010h, 1011h) for as long as the program runs. It sends no PDO and takes none:
/// there is no application that would have values for them.
#[derive(Debug)]
pub struct VirtualNode<'t> {
    id: u8,
    dictionary: LiveDictionary<'t>,
    store: Store,
    servers: Vec<SdoServer<Vec<u8>>>,
    state: State,
    beat: Option<Beat>,
    /// The bit that changes with every answer to node guarding.
    toggle: u8,
}

/// The state of a node (CiA 301 7.3.2), with the byte that tells it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
enum State {
    Stopped = 4,
    Operational = 5,
    PreOperational = 127,
}

/// A heartbeat that is on.
#[derive(Debug, Clone, Copy)]
struct Beat {
    /// Milliseconds, as 1017h had it then.
    period: u16,
    /// When it is time for the next.
    next: u64,
}

/// A node without an SDO channel: its node-ID is none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NoChannel;

impl fmt::Display for NoChannel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a node-ID is 1 to 127")
    }
}

impl std::error::Error for NoChannel {}

/// What the node has stored, as long as the program runs.
#[derive(Debug, Default)]
struct Store(BTreeMap<Storage, Vec<u8>>);

/// The part of an application: it carries out "store parameters" and "restore defaults".
impl Application<LiveDictionary<'_>> for Store {
    fn accept(
        &mut self,
        dictionary: &mut LiveDictionary<'_>,
        entry: EntryId,
        _: &[u8],
    ) -> Result<(), AbortCode> {
        for storage in STORED.into_iter().filter(|storage| is_meant(entry.sub, *storage)) {
            match entry.index {
                0x1010 => drop(self.0.insert(storage, dictionary.stored(storage).to_vec())),
                // It takes effect with the next reset.
                0x1011 => drop(self.0.remove(&storage)),
                _ => {}
            }
        }
        Ok(())
    }
}

/// Whether a sub-index of 1010h and 1011h is about a group.
const fn is_meant(sub: u8, storage: Storage) -> bool {
    match storage {
        Storage::Communication => matches!(sub, 1 | 2),
        Storage::Application => matches!(sub, 1 | 3),
        Storage::Manufacturer => matches!(sub, 1 | 4..),
        Storage::No | Storage::Remanent => false,
    }
}

impl<'t> VirtualNode<'t> {
    /// A node that is switched off, with a node-ID from 1 to 127.
    ///
    /// # Errors
    /// [`NoChannel`]: the node-ID is none.
    pub fn new(id: u8, dictionary: LiveDictionary<'t>) -> Result<Self, NoChannel> {
        Channel::predefined(id).ok_or(NoChannel)?;
        let (state, toggle) = (State::PreOperational, 0);
        Ok(Self { id, dictionary, store: Store::default(), servers: Vec::new(), state, beat: None, toggle })
    }

    /// Its dictionary.
    pub const fn dictionary(&self) -> &LiveDictionary<'t> {
        &self.dictionary
    }

    /// Switches it on; returns its boot-up message.
    pub fn start(&mut self, now: u64) -> Frame {
        self.reset_node();
        self.boot(now)
    }

    /// Takes a frame, and says what there is to say to it.
    pub fn take(&mut self, frame: &Frame, now: u64) -> Vec<Frame> {
        let id = frame.id().get();
        if id == 0 {
            return self.command(frame.bytes().unwrap_or_default(), now).into_iter().collect();
        }
        if id == self.error_control() && frame.bytes().is_none() {
            return self.guard().into_iter().collect();
        }
        if self.state == State::Stopped {
            return Vec::new();
        }
        let (dictionary, store) = (&mut self.dictionary, &mut self.store);
        let mut servers = self.servers.iter_mut();
        servers
            .find_map(|server| server.handle(frame, dictionary, store, wrapping(now)))
            .into_iter()
            .collect()
    }

    /// What it says by itself. To be called until it is nothing.
    pub fn poll(&mut self, now: u64) -> Vec<Frame> {
        let (dictionary, store) = (&mut self.dictionary, &mut self.store);
        let of_servers =
            self.servers.iter_mut().filter_map(|server| server.poll(dictionary, store, wrapping(now)));
        let mut frames: Vec<Frame> = of_servers.collect();
        frames.extend(self.heartbeat(now));
        frames
    }

    /// When it has something to say next, unless a frame comes before.
    pub fn next_deadline(&self) -> Option<u64> {
        self.beat.map(|beat| beat.next)
    }

    /// NMT (CiA 301 7.2.8.2).
    fn command(&mut self, bytes: &[u8], now: u64) -> Option<Frame> {
        let [command, whom] = *bytes else { return None };
        if whom != 0 && whom != self.id {
            return None;
        }
        match command {
            1 => self.enter(State::Operational),
            2 => self.enter(State::Stopped),
            128 => self.enter(State::PreOperational),
            129 => {
                self.reset_node();
                return Some(self.boot(now));
            }
            130 => {
                self.reset_communication();
                return Some(self.boot(now));
            }
            _ => {}
        }
        None
    }

    fn enter(&mut self, state: State) {
        self.state = state;
        if state == State::Stopped {
            self.servers.iter_mut().for_each(SdoServer::reset);
        }
    }

    /// Puts all values back to what is stored, or else to the defaults; what the device keeps by itself stays.
    fn reset_node(&mut self) {
        let kept = self.dictionary.stored(Storage::Remanent).to_vec();
        self.dictionary.reset(self.id);
        self.restore(Storage::Remanent, &kept);
        for (storage, bytes) in self.store.0.clone() {
            self.restore(storage, &bytes);
        }
    }

    /// Puts the communication objects back, and leaves the others.
    fn reset_communication(&mut self) {
        let mut anew = self.dictionary.clone();
        anew.reset(self.id);
        let table = self.dictionary.table();
        let rows = table.parts().entries.iter().take(usize::from(table.parts().first_application_row));
        for EntryRow { attributes, place } in rows {
            let Some(shared) = table.parts().attributes.get(usize::from(*attributes)) else { continue };
            if shared.place != Place::Image || shared.data_type.is_string() {
                continue;
            }
            let start = usize::from(shared.page) << 16 | usize::from(*place);
            let range = start..start + usize::from(shared.size);
            if let (Some(old), Some(new)) =
                (self.dictionary.image_mut().get_mut(range.clone()), anew.image().get(range))
            {
                old.copy_from_slice(new);
            }
        }
        if let Some(bytes) = self.store.0.get(&Storage::Communication).cloned() {
            self.restore(Storage::Communication, &bytes);
        }
    }

    /// Takes back what the same dictionary has given; there is nothing to take where it keeps nothing.
    fn restore(&mut self, storage: Storage, bytes: &[u8]) {
        let layout = self.dictionary.layout(storage);
        let _ = self.dictionary.restore(storage, layout, bytes);
    }

    /// Begins anew, with the channels that the dictionary has now.
    fn boot(&mut self, now: u64) -> Frame {
        let size = self.dictionary.table().largest_value();
        let first = Channel::of_server(&self.dictionary, 0).or_else(|| Channel::predefined(self.id));
        let more = (1..=127).filter_map(|number| Channel::of_server(&self.dictionary, number));
        self.servers =
            first.into_iter().chain(more).map(|channel| SdoServer::new(channel, vec![0; size])).collect();
        self.state = State::PreOperational;
        self.toggle = 0;
        self.beat = self.period().map(|period| Beat { period, next: after(now, period) });
        self.told(0)
    }

    /// Milliseconds between heartbeats, if they are on.
    fn period(&self) -> Option<u16> {
        let value = self.dictionary.read(0x1017, 0).ok()?;
        let period = u16::from_le_bytes(value.bytes().try_into().ok()?);
        (period > 0).then_some(period)
    }

    /// A heartbeat, if it is time for one; a time that was written counts at once.
    fn heartbeat(&mut self, now: u64) -> Option<Frame> {
        let period = self.period();
        if self.beat.map(|beat| beat.period) != period {
            self.beat = period.map(|period| Beat { period, next: now });
        }
        let beat = self.beat.as_mut().filter(|beat| beat.next <= now)?;
        beat.next = after(now, beat.period);
        Some(self.told(self.state as u8))
    }

    /// The answer to node guarding; there is none while there are heartbeats.
    fn guard(&mut self) -> Option<Frame> {
        if self.beat.is_some() {
            return None;
        }
        let answer = self.told(self.toggle | self.state as u8);
        self.toggle ^= 0x80;
        Some(answer)
    }

    const fn error_control(&self) -> u16 {
        0x700 + self.id as u16
    }

    /// A byte on the identifier of error control.
    fn told(&self, byte: u8) -> Frame {
        let id = CanId::new(self.error_control()).unwrap_or(CanId::MAX);
        Frame::data(id, &[byte]).unwrap_or(Frame::full(id, [0; 8]))
    }
}

/// A time for servers, which count in 32 bits and mind only differences.
fn wrapping(now: u64) -> u32 {
    u32::try_from(now & u64::from(u32::MAX)).unwrap_or_default()
}

fn after(now: u64, milliseconds: u16) -> u64 {
    now + u64::from(milliseconds) * MILLISECOND
}

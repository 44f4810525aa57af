//! When PDOs are sent and take effect (CiA 301 9.2.1, 9.2.3 and 9.6.3, 1005h, 1019h, 1400h, 1800h).
//!
//! The engine reads the communication parameters in the dictionary whenever it needs them, so that a change over the bus counts
//! at once: what has other parameters than before begins anew. It sends nothing by itself: [`PdoEngine::poll`] gives frames, one at
//! a time, as the driver has room for them.
//!
//! A SYNC does two things, in this order: synchronous TPDOs take their values, then synchronous RPDOs that came since the SYNC
//! before take effect. So a TPDO reports the values at the SYNC. What is not sent, or comes, after the synchronous
//! window (1007h) is dropped and reported.
//!
//! Where CiA 301 leaves a choice: a cyclic TPDO of type n goes with the n-th SYNC after the node became operational, the one
//! with the start value counted as the first. A remote frame for a synchronous TPDO makes it go with the next SYNC. The inhibit time counts for event-driven
//! TPDOs (254, 255), however they are asked for. Their event timer begins as the node becomes operational; the application
//! decides whether something is sent at once ([`PdoEngine::trigger`]).

mod event;
mod receive;
mod settings;
#[cfg(test)]
mod tests;
mod transmit;
mod window;

pub use event::{PdoEvent, PdoHandler};

use core::fmt;

use crate::access::communication::cob_id::can_id;
use crate::access::dictionary::Dictionary;
use crate::access::parameters::Parameters;
use crate::bus::clock::{Instant, earlier};
use crate::bus::frame::Frame;
use crate::pdo::engine::receive::{Length, Receive};
use crate::pdo::engine::settings::Settings;
use crate::pdo::engine::transmit::Transmit;
use crate::pdo::engine::window::Moment;
use crate::pdo::mapping::Mapping;
use crate::table::mapping::{RECEIVE, TRANSMIT};
use crate::table::{Pdo, Table};

/// Sends up to `T` TPDOs and receives up to `R` RPDOs: as many as the dictionary has.
#[derive(Debug, Clone)]
pub struct PdoEngine<const T: usize, const R: usize> {
    transmit: [Transmit; T],
    /// The mappings of the TPDOs, and those of the RPDOs.
    transmitted: [Mapping; T],
    receive: [Receive; R],
    received: [Mapping; R],
    state: Running,
    sync: SyncLength,
    /// When the last SYNC came.
    synced: Option<Instant>,
    /// The TPDO that is looked at first, so that each has its turn.
    first: usize,
}

/// Whether the node is operational: there are no PDOs else.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Running {
    No,
    Yes,
}

/// Whether the last SYNC had the length that 1019h says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum SyncLength {
    Right,
    Wrong,
}

/// A dictionary has more PDOs than an engine has room for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct TooManyPdos {
    /// TPDOs of the dictionary.
    pub transmit: usize,
    /// RPDOs of the dictionary.
    pub receive: usize,
}

impl fmt::Display for TooManyPdos {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "too little room for {} TPDOs and {} RPDOs", self.transmit, self.receive)
    }
}

impl core::error::Error for TooManyPdos {}

impl<const T: usize, const R: usize> PdoEngine<T, R> {
    /// An engine for the PDOs of a table; it rests until [`start`](Self::start).
    ///
    /// # Errors
    /// [`TooManyPdos`]: none of them is left out in silence.
    pub fn new(table: &Table<'_>) -> Result<Self, TooManyPdos> {
        Self::check(table)?;
        Ok(Self::resting())
    }

    /// Whether there is room for the PDOs of a table.
    pub(crate) fn check(table: &Table<'_>) -> Result<(), TooManyPdos> {
        let (transmit, receive) = (transmit_pdos(table).len(), receive_pdos(table).len());
        if transmit > T || receive > R { Err(TooManyPdos { transmit, receive }) } else { Ok(()) }
    }

    /// An engine that rests.
    pub(crate) const fn resting() -> Self {
        Self {
            transmit: [Transmit::NEW; T],
            transmitted: [Mapping::NEW; T],
            receive: [Receive::NEW; R],
            received: [Mapping::NEW; R],
            state: Running::No,
            sync: SyncLength::Right,
            synced: None,
            first: 0,
        }
    }

    /// The node becomes operational: PDOs begin.
    #[inline(never)]
    pub fn start<'t, D: Dictionary<'t>>(&mut self, dictionary: &D, now: Instant) {
        for (slot, pdo) in self.transmit.iter_mut().zip(transmit_pdos(dictionary.table())) {
            slot.start(Settings::of(dictionary, pdo), now);
        }
        self.receive = [Receive::NEW; R];
        (self.sync, self.synced) = (SyncLength::Right, None);
        self.state = Running::Yes;
    }

    /// The node leaves operational: nothing is sent, received or watched, and what waits is dropped.
    #[inline(never)]
    pub fn stop(&mut self) {
        self.transmit = [Transmit::NEW; T];
        self.receive = [Receive::NEW; R];
        (self.sync, self.synced) = (SyncLength::Right, None);
        self.state = Running::No;
    }

    /// An event of a TPDO, 1 to 512: one of type 254 or 255 is sent as soon as its inhibit time allows, one of type 0 with
    /// the next SYNC; others have no events.
    pub fn trigger<'t, D: Dictionary<'t>>(&mut self, dictionary: &D, number: u16, now: Instant) {
        self.trigger_if(dictionary, |pdo, _| self::number(pdo) == number, now);
    }

    /// An entry has changed: an event of every TPDO that carries it or a view of it.
    pub fn trigger_entry<'t, D: Dictionary<'t>>(&mut self, dictionary: &D, entry: D::Entry, now: Instant) {
        let row = dictionary.table().holder(dictionary.row(entry));
        self.trigger_if(dictionary, |pdo, mapping| mapping.carries(dictionary, pdo, row), now);
    }

    fn trigger_if<'t, D: Dictionary<'t>>(
        &mut self,
        dictionary: &D,
        is_it: impl Fn(&Pdo<'_>, &mut Mapping) -> bool,
        now: Instant,
    ) {
        if self.state == Running::No {
            return;
        }
        let pdos = transmit_pdos(dictionary.table());
        for ((slot, mapping), pdo) in self.transmit.iter_mut().zip(&mut self.transmitted).zip(pdos) {
            if is_it(pdo, mapping) {
                slot.trigger(Settings::of(dictionary, pdo), now);
            }
        }
    }

    /// Takes a frame: a SYNC (1005h), data of an RPDO, or a remote frame for a TPDO. Several RPDOs may hear one frame; a frame of
    /// something else is ignored.
    pub fn handle<'t, D: Dictionary<'t>, A: PdoHandler<D>>(
        &mut self,
        frame: &Frame,
        dictionary: &mut D,
        application: &mut A,
        now: Instant,
    ) {
        if self.state == Running::No {
            return;
        }
        let table = dictionary.table();
        let Some(data) = frame.bytes() else {
            for (slot, pdo) in self.transmit.iter_mut().zip(transmit_pdos(table)) {
                slot.remote(Settings::of(dictionary, pdo), frame, now);
            }
            return;
        };
        let sync = Parameters::of(dictionary).number(0x1005, 0).and_then(can_id);
        if sync == Some(frame.id()) {
            let has_counter = Parameters::of(dictionary).byte(0x1019, 0) != 0;
            return match *data {
                [] if !has_counter => self.sync(None, dictionary, application, now),
                [counter] if has_counter => self.sync(Some(counter), dictionary, application, now),
                _ if core::mem::replace(&mut self.sync, SyncLength::Wrong) == SyncLength::Right => {
                    application.pdo_event(dictionary, PdoEvent::SyncLength { length: frame.length() });
                }
                _ => {}
            };
        }
        let moment = Moment::after(self.synced, dictionary, now);
        for ((slot, mapping), pdo) in self.receive.iter_mut().zip(&mut self.received).zip(receive_pdos(table))
        {
            let contents = Contents { pdo, mapping };
            slot.handle(Settings::of(dictionary, pdo), contents, frame, dictionary, application, moment);
        }
    }

    /// A SYNC, also one that the node sends itself.
    pub fn sync<'t, D: Dictionary<'t>, A: PdoHandler<D>>(
        &mut self,
        counter: Option<u8>,
        dictionary: &mut D,
        application: &mut A,
        now: Instant,
    ) {
        if self.state == Running::No {
            return;
        }
        (self.sync, self.synced) = (SyncLength::Right, Some(now));
        let table = dictionary.table();
        for ((slot, mapping), pdo) in
            self.transmit.iter_mut().zip(&mut self.transmitted).zip(transmit_pdos(table))
        {
            let contents = Contents { pdo, mapping };
            slot.sync(Settings::of(dictionary, pdo), contents, counter, dictionary, application, now);
        }
        for ((slot, mapping), pdo) in self.receive.iter_mut().zip(&mut self.received).zip(receive_pdos(table))
        {
            let contents = Contents { pdo, mapping };
            slot.sync(Settings::of(dictionary, pdo), contents, dictionary, application);
        }
    }

    /// A TPDO that is to be sent now; to be called until there is none. RPDOs that are overdue are reported to the
    /// application.
    pub fn poll<'t, D: Dictionary<'t>, A: PdoHandler<D>>(
        &mut self,
        dictionary: &mut D,
        application: &mut A,
        now: Instant,
    ) -> Option<Frame> {
        if self.state == Running::No {
            return None;
        }
        let table = dictionary.table();
        for (slot, pdo) in self.receive.iter_mut().zip(receive_pdos(table)) {
            if slot.is_overdue(Settings::of(dictionary, pdo), now) {
                application.pdo_event(dictionary, PdoEvent::Overdue { number: number(pdo) });
            }
        }
        let moment = Moment::after(self.synced, dictionary, now);
        let pdos = transmit_pdos(table);
        let first = self.first.min(pdos.len());
        for at in (first..pdos.len()).chain(0..first) {
            let (Some(slot), Some(mapping), Some(pdo)) =
                (self.transmit.get_mut(at), self.transmitted.get_mut(at), pdos.get(at))
            else {
                continue;
            };
            let (settings, contents) = (Settings::of(dictionary, pdo), Contents { pdo, mapping });
            if let Some(frame) = slot.poll(settings, contents, dictionary, application, moment) {
                self.first = at + 1;
                return Some(frame);
            }
        }
        None
    }

    /// Whether any RPDO is overdue.
    #[must_use]
    pub fn is_any_overdue(&self) -> bool {
        self.receive.iter().any(Receive::is_missing)
    }

    /// Whether the last frame of any RPDO was too short.
    #[must_use]
    pub fn is_any_too_short(&self) -> bool {
        self.is_any(Length::TooShort)
    }

    /// Whether the last frame of any RPDO was too long.
    #[must_use]
    pub fn is_any_too_long(&self) -> bool {
        self.is_any(Length::TooLong)
    }

    fn is_any(&self, length: Length) -> bool {
        self.receive.iter().any(|slot| slot.length() == length)
    }

    /// Whether the last SYNC had a wrong length.
    #[must_use]
    pub fn is_sync_wrong(&self) -> bool {
        self.sync == SyncLength::Wrong
    }

    /// When there is something to do next, unless something happens before.
    pub fn next_deadline<'t, D: Dictionary<'t>>(&self, dictionary: &D) -> Option<Instant> {
        if self.state == Running::No {
            return None;
        }
        let table = dictionary.table();
        let transmit = self.transmit.iter().zip(transmit_pdos(table));
        let receive = self.receive.iter().zip(receive_pdos(table));
        let sent = transmit.map(|(slot, pdo)| slot.deadline(Settings::of(dictionary, pdo)));
        let received = receive.map(|(slot, pdo)| slot.deadline(Settings::of(dictionary, pdo)));
        sent.chain(received).fold(None, earlier)
    }
}

fn transmit_pdos<'t>(table: &Table<'t>) -> &'t [Pdo<'t>] {
    let pdos = table.parts().pdos;
    pdos.get(pdos.partition_point(|pdo| pdo.index < TRANSMIT)..).unwrap_or_default()
}

fn receive_pdos<'t>(table: &Table<'t>) -> &'t [Pdo<'t>] {
    let pdos = table.parts().pdos;
    pdos.get(..pdos.partition_point(|pdo| pdo.index < TRANSMIT)).unwrap_or_default()
}

/// A PDO and its mapping.
struct Contents<'a> {
    pdo: &'a Pdo<'a>,
    mapping: &'a mut Mapping,
}

impl Contents<'_> {
    fn number(&self) -> u16 {
        number(self.pdo)
    }
}

/// 1 to 512.
fn number(pdo: &Pdo<'_>) -> u16 {
    let first = if pdo.index < TRANSMIT { RECEIVE } else { TRANSMIT };
    (pdo.index - first).saturating_add(1)
}

//! The communication parameters of a PDO (CiA 301 9.6.3, 1400h and 1800h).

use core::ops::Range;

use crate::access::communication::cob_id::{NO_REMOTE_FRAMES, valid_id};
use crate::access::dictionary::Dictionary;
use crate::bus::clock::Duration;
use crate::bus::frame::CanId;
use crate::table::stored::at_row;
use crate::table::{Pdo, Row};

/// When a PDO is sent or takes effect (CiA 301 table 56).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Transmission {
    /// 0: with the SYNC after an event.
    SyncAfterEvent,
    /// 1 to 240: with every n-th SYNC.
    EverySync(u8),
    /// 252: on a remote frame, with the values of the last SYNC.
    RemoteAfterSync,
    /// 253: on a remote frame.
    Remote,
    /// 254, 255: after an event, and after a time without one.
    Event,
    /// 241 to 251: CiA 301 does not say.
    Reserved,
}

/// The parameters of a PDO that exists.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Settings {
    pub id: CanId,
    pub remote: RemoteFrames,
    pub transmission: Transmission,
    /// Least time from one to the next, in 100 µs.
    inhibit: u16,
    /// Longest time from one to the next, in ms.
    timer: u16,
    /// Counter of the SYNC from which on others are counted; 0 for any.
    pub start: u8,
}

/// Whether a TPDO is sent on remote frames: bit 30 of its COB-ID.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum RemoteFrames {
    Answered,
    Ignored,
}

impl Settings {
    /// The present parameters; `None` of a PDO that does not exist at present.
    #[inline(never)]
    pub(super) fn of<'t, D: Dictionary<'t>>(dictionary: &D, pdo: &Pdo<'_>) -> Option<Self> {
        let table = dictionary.table();
        let cob_id = at_row(table, dictionary.image(), table.found(pdo.cob_id))?;
        let id = valid_id(cob_id)?;
        let rows = table.search_object(pdo.index).ok()?;
        let word = |sub| word(dictionary, rows.clone(), sub);
        let byte = |sub| u8::try_from(word(sub)).unwrap_or_default();
        let transmission = match byte(2) {
            0 => Transmission::SyncAfterEvent,
            every @ 1..=240 => Transmission::EverySync(every),
            241..=251 => Transmission::Reserved,
            252 => Transmission::RemoteAfterSync,
            253 => Transmission::Remote,
            254..=255 => Transmission::Event,
        };
        let remote =
            if cob_id & NO_REMOTE_FRAMES == 0 { RemoteFrames::Answered } else { RemoteFrames::Ignored };
        Some(Self { id, remote, transmission, inhibit: word(3), timer: word(5), start: byte(6) })
    }

    /// Least time from one to the next; only of those after events.
    pub(super) fn inhibit(self) -> Duration {
        Duration::from_tenth_millis(self.inhibit.into())
    }

    /// Longest time from one to the next, sent or received; none if it does not matter.
    pub(super) fn timer(self) -> Duration {
        Duration::from_millis(self.timer.into())
    }
}

/// A number of up to 16 bits of an object with these rows; 0 where there is none.
#[inline(never)]
fn word<'t, D: Dictionary<'t>>(dictionary: &D, rows: Range<Row>, sub: u8) -> u16 {
    let table = dictionary.table();
    let number = table.lookup_in(rows, sub).ok().and_then(|found| at_row(table, dictionary.image(), found));
    number.and_then(|number| u16::try_from(number).ok()).unwrap_or_default()
}

//! What the PDO engine reports to the application.

use crate::access::application::Application;
use crate::access::application::Entries;
use crate::access::constraint::{Consistent, Constrained};
use crate::pdo::{PdoError, Refused};

/// Something that happened to PDOs. Numbers are those of RPDOs and TPDOs, 1 to 512.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum PdoEvent<E> {
    /// The values of an RPDO took effect, except those that were refused.
    Received {
        /// Number of the RPDO.
        number: u16,
        /// The first entry that did not take its value.
        refused: Option<Refused<E>>,
    },
    /// An RPDO has less data than its mapping; nothing took effect. Said once, until a frame has another length. Emergency 8210h (CiA 301 table 21).
    TooShort {
        /// Number of the RPDO.
        number: u16,
    },
    /// An RPDO has more data than its mapping; the values take effect. Said once, until a frame has another length. Emergency 8220h.
    TooLong {
        /// Number of the RPDO.
        number: u16,
    },
    /// An RPDO came that has no usable mapping.
    NotReceived {
        /// Number of the RPDO.
        number: u16,
        /// Why.
        error: PdoError,
    },
    /// An RPDO has not come for the time of its event timer. Emergency 8250h.
    Overdue {
        /// Number of the RPDO.
        number: u16,
    },
    /// An RPDO that was overdue came.
    Resumed {
        /// Number of the RPDO.
        number: u16,
    },
    /// A TPDO was to be sent, but has no usable mapping or a value that cannot be shown.
    NotSent {
        /// Number of the TPDO.
        number: u16,
        /// Why.
        error: PdoError,
    },
    /// A synchronous RPDO came after the synchronous window (1007h), and did not take effect.
    CameLate {
        /// Number of the RPDO.
        number: u16,
    },
    /// There was no room for a synchronous TPDO within the synchronous window (1007h): it goes with the next SYNC that it is due at.
    NotSentInTime {
        /// Number of the TPDO.
        number: u16,
    },
    /// A SYNC has another length than 1019h says (1 byte if there is a counter, else none), and was not followed. Said once, until one has
    /// the right length. Emergency 8240h.
    SyncLength {
        /// Bytes that it has.
        length: u8,
    },
}

/// An application that hears of its PDOs.
pub trait PdoHandler<D: Entries>: Application<D> {
    /// Called when something happened.
    fn pdo_event(&mut self, dictionary: &mut D, event: PdoEvent<D::Entry>) {
        let _ = (dictionary, event);
    }
}

impl<D: Entries> PdoHandler<D> for () {}

impl<D: Constrained, A: PdoHandler<D>> PdoHandler<D> for Consistent<'_, A> {
    fn pdo_event(&mut self, dictionary: &mut D, event: PdoEvent<D::Entry>) {
        self.0.pdo_event(dictionary, event);
    }
}

//! Emergencies: errors that a node has, reports and remembers (CiA 301 9.2.5 and 9.6.3, 1001h, 1003h, 1014h, 1015h),
//! and those of others that it hears (1028h).
//!
//! ```
//! use firmware_glue::emcy::{Emergency, ErrorRegister};
//!
//! let emergency = Emergency::new(0x4210).with_details([1, 0, 0, 0, 0]);
//! assert_eq!(emergency.register(), ErrorRegister::GENERIC.with(ErrorRegister::TEMPERATURE));
//! ```

use core::ops::Range;

use crate::access::communication::cob_id::valid_id;
use crate::access::dictionary::Dictionary;
use crate::access::parameters::{Parameters, set, set_at};
use crate::bus::clock::{Duration, Instant};
use crate::bus::frame::{CanId, Frame};
use crate::bus::node_id::NodeId;
use crate::emcy::error_register::{DeviceError, ErrorRegister};
use crate::table::stored::at_row;

/// An error of the device.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Emergency {
    code: u16,
    register: ErrorRegister,
    details: [u8; 5],
}

impl Emergency {
    /// A protocol error: PDO not processed, because it was too short.
    pub const PDO_LENGTH: Self = Self::new(0x8210);
    /// A protocol error: a PDO was longer than its mapping.
    pub const PDO_TOO_LONG: Self = Self::new(0x8220);
    /// A protocol error: a SYNC with an unexpected length.
    pub const SYNC_LENGTH: Self = Self::new(0x8240);
    /// A protocol error: an RPDO has not come in time.
    pub const RPDO_TIMEOUT: Self = Self::new(0x8250);
    /// A communication error: a heartbeat or the guarding has stayed away.
    pub const HEARTBEAT: Self = Self::new(0x8130);
    /// A communication error: recovered from bus off.
    pub const BUS_OFF_RECOVERED: Self = Self::new(0x8140);

    /// An error by its code: constants of `errors` in generated code, or those of CiA 301 table 21. It sets the bits of 1001h that its class says.
    #[must_use]
    pub const fn new(code: u16) -> Self {
        Self { code, register: ErrorRegister::of_code(code), details: [0; 5] }
    }

    /// An error of the device, with the bits of 1001h that its specification says: `errors::ErrorCode` of generated code.
    pub fn of<E: DeviceError>(error: E) -> Self {
        Self::new(error.code()).with_register(error.register())
    }

    /// With other bits of 1001h than the class of its code says; the generic bit is always set.
    #[must_use]
    pub const fn with_register(self, register: ErrorRegister) -> Self {
        Self { register: register.with(ErrorRegister::GENERIC), ..self }
    }

    /// With bytes that the manufacturer gives a meaning; the first two are in the error history, too.
    #[must_use]
    pub const fn with_details(self, details: [u8; 5]) -> Self {
        Self { details, ..self }
    }

    /// Its code.
    #[must_use]
    pub const fn code(self) -> u16 {
        self.code
    }

    /// The bits that it sets in 1001h.
    #[must_use]
    pub const fn register(self) -> ErrorRegister {
        self.register
    }

    /// The manufacturer's bytes.
    #[must_use]
    pub const fn details(self) -> [u8; 5] {
        self.details
    }

    /// The emergency that a frame carries, as another node's consumer reads it: with the whole error register of the
    /// sender. `None` of a frame without eight bytes.
    #[must_use]
    pub fn from_frame(frame: &Frame) -> Option<Self> {
        let [low, high, register, details @ ..] = <[u8; 8]>::try_from(frame.bytes()?).ok()?;
        Some(Self {
            code: u16::from_le_bytes([low, high]),
            register: ErrorRegister::received(register),
            details,
        })
    }
}

/// An emergency of another node that the dictionary listens to, and whose it is: sub-index n of 1028h has the COB-ID of node n.
pub fn heard<'t, D: Dictionary<'t>>(frame: &Frame, dictionary: &D) -> Option<(NodeId, Emergency)> {
    let table = dictionary.table();
    let mut rows = table.object(0x1028).ok()?;
    let emergency = Emergency::from_frame(frame)?;
    let is_it =
        |row: u16| at_row(table, dictionary.image(), table.found(row)).and_then(valid_id) == Some(frame.id());
    let node = NodeId::new(table.id(rows.find(|row| is_it(*row))?).sub)?;
    Some((node, emergency))
}

/// A message that waits to be sent: code, error register at the time, the manufacturer's bytes.
#[derive(Debug, Clone, Copy)]
struct Message([u8; 8]);

impl Message {
    const EMPTY: Self = Self([0; 8]);

    fn new(code: u16, register: ErrorRegister, details: [u8; 5]) -> Self {
        let mut bytes = [0; 8];
        let [low, high] = code.to_le_bytes();
        for (byte, value) in bytes.iter_mut().zip([low, high, register.bits()].into_iter().chain(details)) {
            *byte = value;
        }
        Self(bytes)
    }
}

/// What became of an error that was raised.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Raised {
    /// It is new: it is in 1001h and 1003h, and a message waits to be sent.
    New,
    /// It was there already; nothing is done again.
    Present,
    /// There are more errors than the producer has room for: it is in 1003h and its message waits to be sent, but it
    /// cannot be cleared. Its bits stay in 1001h until [`EmergencyProducer::clear_all`].
    NotKept,
}

/// The errors that are present, up to `N` at once, and the messages that wait, as many: `N` had better be the number of codes that the
/// device has.
///
/// A message waits while its identifier (1014h) is switched off, until the inhibit time (1015h) has passed, and in states without emergencies. When more wait than there is
/// room for, the oldest is dropped: 1001h and 1003h are complete all the same.
#[derive(Debug, Clone)]
pub struct EmergencyProducer<const N: usize> {
    present: [Option<Emergency>; N],
    /// Bits of errors that there was no room for.
    others: ErrorRegister,
    /// Messages that wait, from `first` on in a ring.
    waiting: [Message; N],
    first: usize,
    waits: usize,
    sent: Option<Instant>,
    dropped: u32,
}

impl<const N: usize> Default for EmergencyProducer<N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize> EmergencyProducer<N> {
    /// Without errors.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            present: [None; N],
            others: ErrorRegister::NONE,
            waiting: [Message::EMPTY; N],
            first: 0,
            waits: 0,
            sent: None,
            dropped: 0,
        }
    }

    /// An error occurs. One that is present already, by its code, is not reported again.
    pub fn raise<'t, D: Dictionary<'t>>(&mut self, dictionary: &mut D, emergency: Emergency) -> Raised {
        if self.is_present(emergency.code) {
            return Raised::Present;
        }
        let raised = match self.present.iter_mut().find(|place| place.is_none()) {
            Some(place) => {
                *place = Some(emergency);
                Raised::New
            }
            None => {
                self.others = self.others.with(emergency.register);
                Raised::NotKept
            }
        };
        self.report(dictionary, emergency);
        raised
    }

    fn report<'t, D: Dictionary<'t>>(&mut self, dictionary: &mut D, emergency: Emergency) {
        let register = self.register();
        set(dictionary, 0x1001, 0, register.bits().into());
        remember(dictionary, emergency);
        self.wait(Message::new(emergency.code, register, emergency.details));
    }

    /// An error is gone. A message says so with the code 0000h and the bits of errors that remain. `false` if it was not
    /// present.
    pub fn clear<'t, D: Dictionary<'t>>(&mut self, dictionary: &mut D, code: u16) -> bool {
        let is_it = |place: &&mut Option<Emergency>| place.is_some_and(|present| present.code == code);
        let Some(place) = self.present.iter_mut().find(is_it) else { return false };
        *place = None;
        self.reset_told(dictionary);
        true
    }

    /// Every error is gone. `false` if there was no error.
    pub fn clear_all<'t, D: Dictionary<'t>>(&mut self, dictionary: &mut D) -> bool {
        self.clear_all_but(dictionary, |_| false)
    }

    /// Every error is gone but those with some codes. `false` if there was no error.
    pub(crate) fn clear_all_but<'t, D: Dictionary<'t>>(
        &mut self,
        dictionary: &mut D,
        stays: impl Fn(u16) -> bool,
    ) -> bool {
        let goes = |present: &Emergency| !stays(present.code);
        if self.others == ErrorRegister::NONE && !self.present().any(|present| goes(&present)) {
            return false;
        }
        for place in &mut self.present {
            place.take_if(|present| goes(present));
        }
        self.others = ErrorRegister::NONE;
        self.reset_told(dictionary);
        true
    }

    fn reset_told<'t, D: Dictionary<'t>>(&mut self, dictionary: &mut D) {
        let register = self.register();
        set(dictionary, 0x1001, 0, register.bits().into());
        self.wait(Message::new(0, register, [0; 5]));
    }

    /// Whether an error is present, by its code.
    #[must_use]
    pub fn is_present(&self, code: u16) -> bool {
        self.present.iter().flatten().any(|present| present.code == code)
    }

    /// The errors that are present.
    pub fn present(&self) -> impl Iterator<Item = Emergency> {
        self.present.iter().flatten().copied()
    }

    /// The bits of all errors that are present: 1001h.
    #[must_use]
    pub fn register(&self) -> ErrorRegister {
        self.present.iter().flatten().fold(self.others, |bits, present| bits.with(present.register))
    }

    /// Messages that were dropped because too many waited.
    #[must_use]
    pub const fn dropped(&self) -> u32 {
        self.dropped
    }

    /// The message that is to be sent now; to be asked in states that have emergencies only, and until there is none.
    pub fn poll<'t, D: Dictionary<'t>>(&mut self, dictionary: &D, now: Instant) -> Option<Frame> {
        let id = identifier(dictionary)?;
        if now < self.next_deadline(dictionary)? {
            return None;
        }
        let Message(bytes) = *self.waiting.get(self.first)?;
        self.drop_first();
        self.sent = Some(now);
        Some(Frame::full(id, bytes))
    }

    /// When the next message can be sent.
    pub fn next_deadline<'t, D: Dictionary<'t>>(&self, dictionary: &D) -> Option<Instant> {
        if self.waits == 0 || identifier(dictionary).is_none() {
            return None;
        }
        let inhibit = Duration::from_tenth_millis(Parameters::of(dictionary).word(0x1015, 0).into());
        Some(self.sent.map_or(Instant::ZERO, |sent| sent + inhibit))
    }

    fn wait(&mut self, message: Message) {
        if self.waits == N {
            self.dropped = self.dropped.saturating_add(1);
            self.drop_first();
        }
        let after = self.first + self.waits;
        if let Some(place) = self.waiting.get_mut(if after < N { after } else { after - N }) {
            *place = message;
            self.waits += 1;
        }
    }

    /// The message that waits longest is sent, or lost.
    fn drop_first(&mut self) {
        self.first = if self.first + 1 < N { self.first + 1 } else { 0 };
        self.waits = self.waits.saturating_sub(1);
    }
}

/// 1014h, if it is switched on.
fn identifier<'t, D: Dictionary<'t>>(dictionary: &D) -> Option<CanId> {
    valid_id(Parameters::of(dictionary).number(0x1014, 0)?)
}

/// Puts an error at the top of the history (1003h): the newest is sub-index 1, the oldest is lost when there is no room. A client
/// clears it by writing 0 to the number of errors.
fn remember<'t, D: Dictionary<'t>>(dictionary: &mut D, emergency: Emergency) {
    let table = dictionary.table();
    let Ok(Range { start: number, end }) = table.object(0x1003) else { return };
    let room = u8::try_from(end.saturating_sub(number + 1)).unwrap_or(u8::MAX);
    let filled = Parameters::of(dictionary).byte(0x1003, 0).saturating_add(1).min(room);
    let mut newer = line(emergency);
    for row in (number..).skip(1).take(filled.into()) {
        let found = table.found(row);
        let older = at_row(table, dictionary.image(), found).unwrap_or_default();
        set_at(dictionary.image_mut(), found, newer);
        newer = older;
    }
    set(dictionary, 0x1003, 0, filled.into());
}

/// An error as the history has it.
fn line(emergency: Emergency) -> u32 {
    let [a, b, ..] = emergency.details;
    let [low, high] = emergency.code.to_le_bytes();
    u32::from_le_bytes([low, high, a, b])
}

#[cfg(test)]
mod tests;

//! An RPDO (CiA 301 9.2.1).

use core::cmp::Ordering;

use crate::access::dictionary::Dictionary;
use crate::bus::clock::Instant;
use crate::bus::frame::Frame;
use crate::pdo::engine::event::{PdoEvent, PdoHandler};
use crate::pdo::engine::settings::{Settings, Transmission};
use crate::pdo::engine::window::{Moment, Window};
use crate::pdo::engine::{Contents, number};
use crate::pdo::{PdoError, Received};

/// What is known of an RPDO beyond its parameters.
#[derive(Debug, Clone, Copy)]
pub(super) struct Receive {
    settings: Option<Settings>,
    /// Data that waits for the next SYNC.
    waiting: Option<Frame>,
    watch: Watch,
    length: Length,
}

/// Deadline monitoring by the event timer: from the first reception on.
#[derive(Debug, Clone, Copy)]
enum Watch {
    Awaited,
    Came(Instant),
    Overdue,
}

/// How much data the last frame had, compared with the mapping.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Length {
    /// As much; or none has come.
    Right,
    TooShort,
    TooLong,
}

impl Length {
    fn of(found: usize, expected: usize) -> Self {
        match found.cmp(&expected) {
            Ordering::Less => Self::TooShort,
            Ordering::Equal => Self::Right,
            Ordering::Greater => Self::TooLong,
        }
    }
}

impl Receive {
    pub(super) const NEW: Self =
        Self { settings: None, waiting: None, watch: Watch::Awaited, length: Length::Right };

    /// Takes up the present parameters; with others, it begins anew.
    fn update(&mut self, settings: Option<Settings>) -> Option<Settings> {
        if self.settings != settings {
            *self = Self { settings, ..Self::NEW };
        }
        settings
    }

    /// A data frame, if it is this RPDO's. Data of a synchronous one takes effect at the next SYNC, whatever the number of its
    /// transmission type.
    pub(super) fn handle<'t, D: Dictionary<'t>, A: PdoHandler<D>>(
        &mut self,
        settings: Option<Settings>,
        contents: Contents<'_>,
        frame: &Frame,
        dictionary: &mut D,
        application: &mut A,
        Moment { now, window }: Moment,
    ) {
        let (Some(settings), Some(data)) = (self.update(settings), frame.bytes()) else { return };
        if settings.id != frame.id() {
            return;
        }
        let number = contents.number();
        let length = match contents.mapping.length(dictionary, contents.pdo) {
            Ok(expected) => Length::of(data.len(), expected.into()),
            Err(error) => return application.pdo_event(dictionary, PdoEvent::NotReceived { number, error }),
        };
        self.judge(length, number, dictionary, application);
        if length == Length::TooShort {
            return;
        }
        match settings.transmission {
            Transmission::SyncAfterEvent | Transmission::EverySync(_) if window == Window::Closed => {
                return application.pdo_event(dictionary, PdoEvent::CameLate { number });
            }
            Transmission::SyncAfterEvent | Transmission::EverySync(_) => self.waiting = Some(*frame),
            Transmission::Event => self.take(contents, data, dictionary, application),
            // Not for RPDOs: the dictionary refuses them, but a table may begin with one.
            Transmission::RemoteAfterSync | Transmission::Remote | Transmission::Reserved => return,
        }
        let before = core::mem::replace(&mut self.watch, Watch::Came(now));
        if matches!(before, Watch::Overdue) {
            application.pdo_event(dictionary, PdoEvent::Resumed { number });
        }
    }

    /// A SYNC: what came before it takes effect.
    pub(super) fn sync<'t, D: Dictionary<'t>, A: PdoHandler<D>>(
        &mut self,
        settings: Option<Settings>,
        contents: Contents<'_>,
        dictionary: &mut D,
        application: &mut A,
    ) {
        self.update(settings);
        if let Some(data) = self.waiting.take().as_ref().and_then(Frame::bytes) {
            self.take(contents, data, dictionary, application);
        }
    }

    /// A wrong length is reported once: every frame of a sender that has another mapping has it.
    fn judge<'t, D: Dictionary<'t>, A: PdoHandler<D>>(
        &mut self,
        length: Length,
        number: u16,
        dictionary: &mut D,
        application: &mut A,
    ) {
        if core::mem::replace(&mut self.length, length) == length {
            return;
        }
        match length {
            Length::Right => {}
            Length::TooShort => application.pdo_event(dictionary, PdoEvent::TooShort { number }),
            Length::TooLong => application.pdo_event(dictionary, PdoEvent::TooLong { number }),
        }
    }

    /// The values take effect.
    #[inline(never)]
    fn take<'t, D: Dictionary<'t>, A: PdoHandler<D>>(
        &mut self,
        Contents { pdo, mapping }: Contents<'_>,
        data: &[u8],
        dictionary: &mut D,
        application: &mut A,
    ) {
        let number = number(pdo);
        match mapping.unpack(pdo, data, dictionary, application) {
            Ok(Received { refused, .. }) => {
                application.pdo_event(dictionary, PdoEvent::Received { number, refused });
            }
            // The mapping has grown since the data came.
            Err(PdoError::TooShort) => self.judge(Length::TooShort, number, dictionary, application),
            Err(error) => application.pdo_event(dictionary, PdoEvent::NotReceived { number, error }),
        }
    }

    /// Whether it has not come for too long: said once.
    pub(super) fn is_overdue(&mut self, settings: Option<Settings>, now: Instant) -> bool {
        self.update(settings);
        let overdue = self.deadline(settings).is_some_and(|deadline| deadline <= now);
        if overdue {
            self.watch = Watch::Overdue;
        }
        overdue
    }

    /// Whether it has not come since it became overdue.
    pub(super) const fn is_missing(&self) -> bool {
        matches!(self.watch, Watch::Overdue)
    }

    /// How much data its last frame had.
    pub(super) const fn length(&self) -> Length {
        self.length
    }

    /// When it has to have come.
    pub(super) fn deadline(&self, settings: Option<Settings>) -> Option<Instant> {
        let timer = settings?.timer();
        match self.watch {
            Watch::Came(at) if !timer.is_zero() => Some(at + timer),
            Watch::Awaited | Watch::Came(_) | Watch::Overdue => None,
        }
    }
}

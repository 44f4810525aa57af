//! An RPDO (CiA 301 9.2.1).

use crate::clock::Instant;
use crate::dictionary::Dictionary;
use crate::frame::Frame;
use crate::pdo::{self, PdoError};
use crate::pdo_engine::event::{PdoEvent, PdoHandler};
use crate::pdo_engine::settings::{Settings, Transmission};

/// What is known of an RPDO beyond its parameters.
#[derive(Debug, Clone, Copy)]
pub(super) struct Receive {
    settings: Option<Settings>,
    /// Data that waits for the next SYNC.
    waiting: Option<Frame>,
    watch: Watch,
}

/// Deadline monitoring by the event timer: from the first reception on.
#[derive(Debug, Clone, Copy)]
enum Watch {
    Awaited,
    Came(Instant),
    Overdue,
}

impl Receive {
    pub(super) const NEW: Self = Self { settings: None, waiting: None, watch: Watch::Awaited };

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
        number: u16,
        frame: &Frame,
        dictionary: &mut D,
        application: &mut A,
        now: Instant,
    ) {
        let (Some(settings), Some(data)) = (self.update(settings), frame.bytes()) else { return };
        if settings.id != frame.id() {
            return;
        }
        match pdo::received_length(dictionary, number) {
            Ok(length) if data.len() < length => {
                return application.pdo_event(dictionary, PdoEvent::TooShort { number });
            }
            Ok(_) => {}
            Err(error) => return application.pdo_event(dictionary, PdoEvent::NotReceived { number, error }),
        }
        match settings.transmission {
            Transmission::SyncAfterEvent | Transmission::EverySync(_) => self.waiting = Some(*frame),
            Transmission::Event => take(number, data, dictionary, application),
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
        number: u16,
        dictionary: &mut D,
        application: &mut A,
    ) {
        self.update(settings);
        if let Some(data) = self.waiting.take().as_ref().and_then(Frame::bytes) {
            take(number, data, dictionary, application);
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

    /// When it has to have come.
    pub(super) fn deadline(&self, settings: Option<Settings>) -> Option<Instant> {
        let timer = settings?.timer;
        match self.watch {
            Watch::Came(at) if !timer.is_zero() => Some(at + timer),
            Watch::Awaited | Watch::Came(_) | Watch::Overdue => None,
        }
    }
}

/// The values take effect.
fn take<'t, D: Dictionary<'t>, A: PdoHandler<D>>(
    number: u16,
    data: &[u8],
    dictionary: &mut D,
    application: &mut A,
) {
    match pdo::unpack(dictionary, number, data, application) {
        Ok(received) => {
            if received.too_long {
                application.pdo_event(dictionary, PdoEvent::TooLong { number });
            }
            application.pdo_event(dictionary, PdoEvent::Received { number, refused: received.refused });
        }
        // The mapping has grown since the data came.
        Err(PdoError::TooShort) => application.pdo_event(dictionary, PdoEvent::TooShort { number }),
        Err(error) => application.pdo_event(dictionary, PdoEvent::NotReceived { number, error }),
    }
}

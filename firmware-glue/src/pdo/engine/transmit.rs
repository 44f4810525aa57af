//! A TPDO (CiA 301 9.2.1).

use crate::access::dictionary::Dictionary;
use crate::bus::clock::Instant;
use crate::bus::frame::Frame;
use crate::pdo;
use crate::pdo::engine::event::{PdoEvent, PdoHandler};
use crate::pdo::engine::settings::{RemoteFrames, Settings, Transmission};
use crate::pdo::engine::window::{Moment, Window};
use crate::pdo::engine::{Contents, number};

/// What is known of a TPDO beyond its parameters.
#[derive(Debug, Clone, Copy)]
pub(super) struct Transmit {
    settings: Option<Settings>,
    /// Since when it is as it is: the event timer begins here.
    since: Instant,
    sent: Option<Instant>,
    wanted: Wanted,
    /// Values that are to be sent at once.
    ready: Option<pdo::Frame>,
    syncs: Syncs,
    /// Values of the last SYNC, for remote frames.
    sample: Option<pdo::Frame>,
}

/// Whether something has asked for the TPDO: for its values of the moment in which it is sent or of the next SYNC, as its
/// transmission says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Wanted {
    No,
    Yes,
}

/// How SYNCs are counted.
#[derive(Debug, Clone, Copy)]
enum Syncs {
    /// The SYNC with the start value has not come.
    Awaited,
    /// So many since the last that the TPDO was sent with.
    Counted(u8),
}

impl Transmit {
    pub(super) const NEW: Self = Self {
        settings: None,
        since: Instant::ZERO,
        sent: None,
        wanted: Wanted::No,
        ready: None,
        syncs: Syncs::Awaited,
        sample: None,
    };

    /// Begins, as the node becomes operational.
    pub(super) fn start(&mut self, settings: Option<Settings>, now: Instant) {
        *self = Self { settings, since: now, ..Self::NEW };
    }

    /// Takes up the present parameters; with others, it begins anew, except for the inhibit time of what was sent
    /// before.
    fn update(&mut self, settings: Option<Settings>, now: Instant) -> Option<Settings> {
        if self.settings != settings {
            let sent = self.sent.filter(|_| self.settings.map(|old| old.id) == settings.map(|new| new.id));
            *self = Self { settings, since: now, sent, ..Self::NEW };
        }
        settings
    }

    /// An event of the application.
    pub(super) fn trigger(&mut self, settings: Option<Settings>, now: Instant) {
        let Some(settings) = self.update(settings, now) else { return };
        match settings.transmission {
            Transmission::SyncAfterEvent | Transmission::Event => self.wanted = Wanted::Yes,
            Transmission::EverySync(_)
            | Transmission::RemoteAfterSync
            | Transmission::Remote
            | Transmission::Reserved => {}
        }
    }

    /// A remote frame, if it asks for this TPDO.
    pub(super) fn remote(&mut self, settings: Option<Settings>, frame: &Frame, now: Instant) {
        let Some(settings) = self.update(settings, now) else { return };
        if settings.id != frame.id() || settings.remote == RemoteFrames::Ignored {
            return;
        }
        match settings.transmission {
            Transmission::RemoteAfterSync => self.ready = self.sample,
            // A synchronous TPDO stays synchronous: it goes with the next SYNC.
            Transmission::SyncAfterEvent
            | Transmission::EverySync(_)
            | Transmission::Remote
            | Transmission::Event => self.wanted = Wanted::Yes,
            Transmission::Reserved => {}
        }
    }

    /// A SYNC: synchronous TPDOs take their values. Without a counter in the SYNC, the start value does not matter.
    pub(super) fn sync<'t, D: Dictionary<'t>, A: PdoHandler<D>>(
        &mut self,
        settings: Option<Settings>,
        contents: Contents<'_>,
        counter: Option<u8>,
        dictionary: &mut D,
        application: &mut A,
        now: Instant,
    ) {
        let Some(settings) = self.update(settings, now) else { return };
        match settings.transmission {
            Transmission::SyncAfterEvent if self.wanted == Wanted::No => {}
            Transmission::SyncAfterEvent => self.sample_now(contents, dictionary, application),
            Transmission::EverySync(every) => {
                if self.counts(settings.start, every, counter) || self.wanted == Wanted::Yes {
                    self.sample_now(contents, dictionary, application);
                }
            }
            Transmission::RemoteAfterSync => self.sample = pack(contents, dictionary, application),
            Transmission::Remote | Transmission::Event | Transmission::Reserved => {}
        }
    }

    /// Counts a SYNC; whether it is the n-th. The one whose counter is the start value is the first.
    fn counts(&mut self, start: u8, every: u8, counter: Option<u8>) -> bool {
        let before = match (self.syncs, counter) {
            (Syncs::Counted(before), _) => before,
            (Syncs::Awaited, Some(counter)) if start != 0 && counter != start => return false,
            (Syncs::Awaited, _) => 0,
        };
        let count = before.saturating_add(1);
        self.syncs = Syncs::Counted(if count < every { count } else { 0 });
        count >= every
    }

    fn sample_now<'t, D: Dictionary<'t>, A: PdoHandler<D>>(
        &mut self,
        contents: Contents<'_>,
        dictionary: &mut D,
        application: &mut A,
    ) {
        self.wanted = Wanted::No;
        self.ready = pack(contents, dictionary, application);
    }

    /// The frame, if it is to be sent now.
    pub(super) fn poll<'t, D: Dictionary<'t>, A: PdoHandler<D>>(
        &mut self,
        settings: Option<Settings>,
        contents: Contents<'_>,
        dictionary: &mut D,
        application: &mut A,
        Moment { now, window }: Moment,
    ) -> Option<Frame> {
        let Settings { id, transmission, .. } = self.update(settings, now)?;
        let is_synchronous =
            matches!(transmission, Transmission::SyncAfterEvent | Transmission::EverySync(_));
        if is_synchronous && window == Window::Closed && self.ready.take().is_some() {
            application.pdo_event(dictionary, PdoEvent::NotSentInTime { number: contents.number() });
        }
        if self.deadline(settings).is_none_or(|due| now < due) {
            return None;
        }
        // Also if it has no values to send: the event timer asks again when it has run out anew.
        self.sent = Some(now);
        if let Some(data) = self.ready.take() {
            return Frame::data(id, &data);
        }
        self.wanted = Wanted::No;
        Frame::data(id, &pack(contents, dictionary, application)?)
    }

    /// When it is to be sent, unless something happens before; at once where parameters have changed.
    pub(super) fn deadline(&self, settings: Option<Settings>) -> Option<Instant> {
        if self.settings != settings {
            return Some(Instant::ZERO);
        }
        let settings = settings?;
        if self.ready.is_some() {
            return Some(Instant::ZERO);
        }
        match (settings.transmission, self.wanted) {
            (Transmission::Remote, Wanted::Yes) => Some(Instant::ZERO),
            (Transmission::Event, wanted) => {
                let allowed = self.sent.map_or(Instant::ZERO, |sent| sent + settings.inhibit());
                let timed = self.sent.unwrap_or(self.since) + settings.timer();
                match wanted {
                    Wanted::Yes => Some(allowed),
                    Wanted::No => (!settings.timer().is_zero()).then(|| timed.max(allowed)),
                }
            }
            (
                Transmission::SyncAfterEvent
                | Transmission::EverySync(_)
                | Transmission::RemoteAfterSync
                | Transmission::Remote
                | Transmission::Reserved,
                _,
            ) => None,
        }
    }
}

/// The values of now, by the present mapping. One function for all that call it.
#[inline(never)]
fn pack<'t, D: Dictionary<'t>, A: PdoHandler<D>>(
    Contents { pdo, mapping }: Contents<'_>,
    dictionary: &mut D,
    application: &mut A,
) -> Option<pdo::Frame> {
    match mapping.pack(pdo, dictionary, application) {
        Ok(frame) => Some(frame),
        Err(error) => {
            application.pdo_event(dictionary, PdoEvent::NotSent { number: number(pdo), error });
            None
        }
    }
}

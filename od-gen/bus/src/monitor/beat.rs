//! The heartbeat of a node: how often it comes, and when it is lost.

use std::collections::VecDeque;

use crate::trace::state;

/// So many of the last distances count: one that was delayed makes the next one short.
const REMEMBERED: usize = 4;
/// From so many on they are believed, whatever 1017h says.
const ENOUGH: usize = 2;
/// So many distances late is lost.
const PATIENCE: u64 = 2;

/// What is known of the heartbeat of a node.
#[derive(Debug, Default)]
pub(super) struct Beat {
    /// The last state, and when it came.
    last: Option<(u8, u64)>,
    /// Microseconds between heartbeats, the last one at the end.
    distances: VecDeque<u64>,
    kind: Kind,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
enum Kind {
    /// It comes by itself.
    #[default]
    Beating,
    /// It has not come in time.
    Lost,
    /// A master asks for it: the time is not known otherwise.
    Guarded,
}

/// What is known of how often it comes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stated {
    /// Nothing.
    Unknown,
    /// It does not.
    None,
    /// After so many microseconds.
    Every(u64),
}

/// What a heartbeat means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Heard {
    /// The node is here for the first time, or has started again.
    First,
    /// It is still here.
    Again,
    /// It was lost.
    Back {
        /// For so long.
        silent: u64,
    },
}

/// A heartbeat that is lost.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Silence {
    /// When the last one came.
    pub(super) last: Option<u64>,
    /// For how long none has come.
    pub(super) since: u64,
    /// How long it is between two.
    pub(super) period: u64,
}

impl Beat {
    pub(super) fn heard(&mut self, state: u8, now: u64) -> Heard {
        let before = self.last.replace((state, now));
        let was_lost = self.kind == Kind::Lost;
        if was_lost {
            self.kind = Kind::Beating;
        }
        // After a boot-up the first heartbeat may come at any time, and so does a node that was away.
        let Some((_, at)) = before.filter(|(before, _)| *before != 0 && state != 0 && !was_lost) else {
            if state == 0 || was_lost {
                self.distances.clear();
            }
            return match before {
                Some((_, at)) if was_lost => Heard::Back { silent: now.saturating_sub(at) },
                _ => Heard::First,
            };
        };
        self.distances.push_back(now.saturating_sub(at));
        if self.distances.len() > REMEMBERED {
            self.distances.pop_front();
        }
        Heard::Again
    }

    /// A master has asked for it.
    pub(super) const fn is_guarded(&mut self) {
        self.kind = Kind::Guarded;
    }

    /// How long it is between two, as they came, or as 1017h says.
    fn period(&self, stated: Stated) -> Option<u64> {
        let stated = match stated {
            Stated::None => return None,
            Stated::Every(time) if self.distances.len() < ENOUGH => Some(time),
            Stated::Every(_) | Stated::Unknown => None,
        };
        self.distances.iter().copied().chain(stated).max().filter(|period| *period > 0)
    }

    /// When it is lost, unless it comes before.
    pub(super) fn late_at(&self, stated: Stated, start: u64) -> Option<u64> {
        match self.kind {
            Kind::Beating => {
                let since = self.last.map_or(start, |(_, at)| at);
                Some(since.saturating_add(self.period(stated)?.saturating_mul(PATIENCE)))
            }
            Kind::Lost | Kind::Guarded => None,
        }
    }

    /// Whether it is lost now; said once.
    pub(super) fn lose(&mut self, stated: Stated, start: u64, now: u64) -> Option<Silence> {
        if now < self.late_at(stated, start)? {
            return None;
        }
        let period = self.period(stated)?;
        self.kind = Kind::Lost;
        let last = self.last.map(|(_, at)| at);
        Some(Silence { last, since: now.saturating_sub(last.unwrap_or(start)), period })
    }

    /// State and heartbeat in words.
    pub(super) fn summary(&self, now: u64) -> String {
        let Some((last, at)) = self.last else { return "not heard".to_owned() };
        let ago = super::seconds(now.saturating_sub(at));
        let state = state(last);
        match (self.kind, self.period(Stated::Unknown)) {
            (Kind::Lost, _) => format!("LOST, {state} when it was heard {ago} ago"),
            (Kind::Guarded, _) => format!("{state}, asked for {ago} ago"),
            (Kind::Beating, Some(period)) => {
                format!("{state}, heard {ago} ago, every {}", super::seconds(period))
            }
            (Kind::Beating, None) => format!("{state}, heard {ago} ago"),
        }
    }
}

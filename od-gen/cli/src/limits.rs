//! Limits on work that someone else wrote, such as a template that doubles a text again and again, or counts for hours.

use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use memory_stats::memory_stats;

/// How often the memory in use is read. A text of a GiB takes longer to copy.
const INTERVAL: Duration = Duration::from_millis(10);

/// What some work may take.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Limits {
    /// Bytes, in addition to what the process has at the start. Where the system does not say how much memory a process has, there is
    /// no limit.
    pub(crate) memory: usize,
    /// Time from the start.
    pub(crate) time: Duration,
}

/// Which limit some work has exceeded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Exceeded {
    Memory,
    Time,
}

impl Limits {
    /// The limit that so much memory and time exceeds.
    fn exceeded(self, memory: usize, time: Duration) -> Option<Exceeded> {
        if memory > self.memory {
            Some(Exceeded::Memory)
        } else if time > self.time {
            Some(Exceeded::Time)
        } else {
            None
        }
    }
}

/// Does some work. If it exceeds a limit, `exceeded` is called once while it runs; the work itself cannot be interrupted, so that
/// `exceeded` has to end the process. Where the system has no threads, there is no limit.
pub(crate) fn limited<T>(
    limits: Limits,
    exceeded: impl FnOnce(Exceeded) + Send,
    work: impl FnOnce() -> T,
) -> T {
    let used = || memory_stats().map_or(0, |memory| memory.physical_mem);
    let (before, start) = (used(), Instant::now());
    thread::scope(|scope| {
        let (work_lasts, until_it_ends) = channel::<()>();
        let watch = move || {
            while until_it_ends.recv_timeout(INTERVAL) == Err(RecvTimeoutError::Timeout) {
                if let Some(limit) = limits.exceeded(used().saturating_sub(before), start.elapsed()) {
                    return exceeded(limit);
                }
            }
        };
        let _ = thread::Builder::new().spawn_scoped(scope, watch);
        let result = work();
        drop(work_lasts);
        result
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_and_time_have_a_limit_each() {
        let (second, limits) = (Duration::from_secs(1), Limits { memory: 1, time: Duration::from_secs(1) });
        assert_eq!(limits.exceeded(1, second), None);
        assert_eq!(limits.exceeded(2, second), Some(Exceeded::Memory));
        assert_eq!(limits.exceeded(1, 2 * second), Some(Exceeded::Time));
    }

    /// What work that goes on until it is stopped has exceeded.
    fn stopped(limits: Limits) -> Exceeded {
        let (exceeded, stop) = channel();
        limited(limits, move |limit| exceeded.send(limit).unwrap(), || stop.recv().unwrap())
    }

    #[test]
    fn work_without_end_exceeds_its_time() {
        assert_eq!(stopped(Limits { memory: usize::MAX, time: Duration::ZERO }), Exceeded::Time);
    }

    #[test]
    fn work_that_ends_is_not_stopped() {
        let limits = Limits { memory: usize::MAX, time: Duration::MAX };
        assert_eq!(limited(limits, |limit| panic!("{limit:?}"), || 1), 1);
    }
}

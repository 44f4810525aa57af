//! A limit on memory for work that someone else wrote, such as a template that doubles a text again and again.

use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use memory_stats::memory_stats;

/// How often the memory in use is read. A text of a GiB takes longer to copy.
const INTERVAL: Duration = Duration::from_millis(10);

/// Does some work. While it runs, `exceeded` is called once if the process takes more than `limit` bytes in addition to what it
/// had at the start; the work itself cannot be interrupted, so that `exceeded` has to end the process.
///
/// Where the system does not say how much memory a process has, there is no limit.
pub(crate) fn limited<T>(limit: usize, exceeded: impl FnOnce() + Send, work: impl FnOnce() -> T) -> T {
    let used = || memory_stats().map_or(0, |memory| memory.physical_mem);
    let most = used().saturating_add(limit);
    thread::scope(|scope| {
        let (work_lasts, until_it_ends) = channel::<()>();
        scope.spawn(move || {
            while until_it_ends.recv_timeout(INTERVAL) == Err(RecvTimeoutError::Timeout) {
                if used() > most {
                    return exceeded();
                }
            }
        });
        let result = work();
        drop(work_lasts);
        result
    })
}

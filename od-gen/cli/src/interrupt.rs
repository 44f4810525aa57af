//! Ctrl-C, for commands that go on until the user ends them and have something to say then.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use crate::exit::INTERRUPTED;

/// Whether the user, or the system, wants the command to end.
#[derive(Debug, Clone)]
pub(crate) struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// From now on Ctrl-C is noted, and a second one ends the program at once. Where the system does not report it, it
    /// ends the program as usual.
    pub(crate) fn noted() -> Self {
        let wanted = Arc::new(AtomicBool::new(false));
        for signal in [SIGINT, SIGTERM] {
            let _ = flag::register_conditional_shutdown(signal, INTERRUPTED.into(), Arc::clone(&wanted))
                .and_then(|_| flag::register(signal, Arc::clone(&wanted)));
        }
        Self(wanted)
    }

    /// [`noted`](Self::noted), also of a terminal that is closed: what was begun is to be finished.
    pub(crate) fn noted_with_hangup() -> Self {
        let noted = Self::noted();
        #[cfg(unix)]
        let _ = flag::register(signal_hook::consts::SIGHUP, Arc::clone(&noted.0));
        noted
    }

    /// Whether it has come.
    pub(crate) fn is_wanted(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

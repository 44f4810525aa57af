//! Why an EDS does not show a default to tools.

use od_spec::model::{Entry, Fact, Storage};

/// Why the default of an entry is left out of `DefaultValue`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Withheld {
    /// The device keeps the parameter: a PLC that writes defaults at boot would undo what was set.
    Kept,
    /// Only a standard states it; the device may have another.
    Standard,
    /// The device starts with it, but its maker does not promise it.
    NoPromise,
}

impl Withheld {
    /// Why; `None` for an entry without a default, or whose default is shown.
    pub(super) fn of(entry: &Entry) -> Option<Self> {
        if entry.default.is_none() || entry.eds.default {
            return None;
        }
        Some(if entry.locked || entry.stored != Storage::No {
            Self::Kept
        } else if entry.is_only_standard(Fact::Default) {
            Self::Standard
        } else if entry.alias.is_some() {
            // A view keeps nothing itself, and is left out where its target is.
            Self::Kept
        } else {
            Self::NoPromise
        })
    }
}

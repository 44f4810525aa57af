//! How states, paths and bits read in a message.

use crate::diag::shorten;

/// So many states of a path are shown.
const SHOWN: usize = 12;

/// `` `Off` → `On` ``.
pub(super) fn path<'a>(states: impl IntoIterator<Item = &'a str>) -> String {
    let mut states: Vec<String> = states.into_iter().map(|state| format!("`{}`", shorten(state))).collect();
    if states.len() > SHOWN {
        states.splice(SHOWN / 2..states.len() - SHOWN / 2, ["…".to_owned()]);
    }
    states.join(" → ")
}

/// `` `Off`, `On` and `Fault` ``.
pub(super) fn list<'a>(states: impl IntoIterator<Item = &'a str>) -> String {
    let mut states: Vec<String> = states.into_iter().map(|state| format!("`{}`", shorten(state))).collect();
    if states.len() > SHOWN {
        let more = states.len() - SHOWN;
        states.truncate(SHOWN);
        states.push(format!("{more} others"));
    }
    match states.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, first)) => format!("{} and {last}", first.join(", ")),
        None => String::new(),
    }
}

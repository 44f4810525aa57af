//! What keys mean.

use std::fmt::Write as _;

use od_spec::keys::{Keys, Need};

/// The meaning of a key, as the reference of the language has it.
pub(super) fn of_key(keys: &Keys, name: &str) -> Option<String> {
    let key = keys.get(name)?;
    let must = if key.need == Need::Required { ", required" } else { "" };
    let mut text = format!("**{}** (key of {}{must})\n\n{}", key.name, keys.name, key.about);
    if let Some(example) = key.example {
        // Writing into a text cannot fail.
        let _ = write!(text, "\n\n```yaml\n{}: {example}\n```", key.name);
    }
    Some(text)
}

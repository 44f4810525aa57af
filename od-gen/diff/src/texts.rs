//! Changes of texts in several languages.

use od_spec::model::{Fact, Text};

use super::change::{Change, Class, Place};

/// A change for each language whose text differs; the part names the language where it is not the first of the specification.
pub(super) fn texts(place: &Place, fact: Fact, old: &Text, new: &Text, language: &str) -> Vec<Change> {
    let text = |texts: &Text, code: &str| {
        texts.iter().find(|(one, _)| *one == code).map(|(_, text)| text.to_owned())
    };
    let mut codes: Vec<&str> = old.iter().chain(new.iter()).map(|(code, _)| code).collect();
    codes.sort_unstable();
    codes.dedup();
    let changes = codes.into_iter().filter_map(|code| {
        let change = Change::of(place.clone(), fact, text(old, code), text(new, code))?;
        let change = if code == language { change } else { change.part(format!("in {code}")) };
        Some(change.so(Class::Documents, "a text for people"))
    });
    changes.collect()
}

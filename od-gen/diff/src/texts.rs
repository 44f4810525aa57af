//! Changes of texts in several languages.

use od_spec::model::{Fact, Phrases, Text};

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
    let mut changes: Vec<Change> = changes.collect();
    if old.gap() != new.gap() {
        let none = Text::default();
        let [old, new] = [old, new].map(|text| text.gap().unwrap_or(&none));
        changes.extend(texts(place, Fact::Gap, old, new, language));
    }
    changes
}

/// The same for words that readers look for.
pub(super) fn phrases(place: &Place, old: &Phrases, new: &Phrases, language: &str) -> Vec<Change> {
    let joined = |phrases: &Phrases| {
        let lists = phrases.iter().map(|(code, list)| (code, list.join(", ")));
        let lists: Vec<(&str, String)> = lists.collect();
        Text::new(lists.iter().map(|(code, list)| (*code, list.as_str())))
    };
    texts(place, Fact::Search, &joined(old), &joined(new), language)
}

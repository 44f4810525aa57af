//! A change as a line of text.

use od_spec::model::Fact;
use od_spec::visible::visible;

use super::super::words::fact;
use super::super::{Change, Kind, Place};

/// How long a value may be in a line for people; a longer one is cut around what differs.
pub(super) const SHORT: usize = 60;

/// How a line is written.
#[derive(Clone, Copy)]
pub(super) struct Style {
    /// Between the value before and the value after.
    pub arrow: &'static str,
    /// Longest value.
    pub longest: Option<usize>,
}

/// Where a change is, with the name: `3005h test status, bit 5`.
pub(super) fn place(change: &Change) -> String {
    let name = change.name.as_str();
    let place = match &change.place {
        Place::System => "system".to_owned(),
        Place::Device => format!("device {name}").trim_end().to_owned(),
        Place::Object(index) => format!("{index} {name}"),
        Place::Entries { index, first, last } if first == last => format!("{index}.{first} {name}"),
        Place::Entries { index, first, last } => format!("{index}.{first} to {index}.{last} {name} …"),
        Place::Unit(unit) => format!("unit `{unit}`{}", users(name)),
        Place::Type(named) => format!("type `{named}`{}", users(name)),
        Place::Error(code) => format!("error {code:04X}h {name}"),
        Place::Machine(machine) => format!("state machine `{machine}`"),
        Place::Constraint(constraint) => format!("condition `{constraint}`"),
    };
    match &change.part {
        Some(part) => format!("{place}, {part}"),
        None => place,
    }
}

/// The first entries that have a unit or type.
fn users(list: &str) -> String {
    let entries: Vec<&str> = list.split(", ").filter(|entry| !entry.is_empty()).collect();
    match entries.as_slice() {
        [] => String::new(),
        [one, two, three, rest @ ..] if !rest.is_empty() => {
            format!(" ({one}, {two}, {three} and {} more)", rest.len())
        }
        few => format!(" ({})", few.join(", ")),
    }
}

/// The fact with its values: `type: unsigned8 → unsigned16`.
pub(super) fn values(change: &Change, style: Style) -> String {
    let whole = |value: &Option<String>| value.clone().unwrap_or_else(|| "none".to_owned());
    let (before, after) = (whole(&change.before), whole(&change.after));
    let (before, after) = match style.longest {
        Some(longest) if is_prose(change.fact) => cut(&before, &after, longest),
        Some(_) | None => (before, after),
    };
    match change.kind() {
        Kind::Added => after,
        Kind::Removed => before,
        Kind::Changed if change.before.is_none() && change.after.is_none() => fact(change.fact).to_owned(),
        Kind::Changed => format!("{}: {before} {} {after}", fact(change.fact), style.arrow),
    }
}

/// Whether values are sentences, of which a part is enough.
const fn is_prose(fact: Fact) -> bool {
    matches!(
        fact,
        Fact::Presence
            | Fact::Warning
            | Fact::About
            | Fact::Gap
            | Fact::Search
            | Fact::Reaction
            | Fact::Shown
            | Fact::Reset
            | Fact::Document
            | Fact::Errata
            | Fact::Eds
    )
}

/// The whole line without what follows: `~ 3005h test status: type: unsigned8 → unsigned16`.
pub(super) fn line(change: &Change, style: Style) -> String {
    let (place, values) = (place(change), values(change, style));
    let between = if values.is_empty() { "" } else { ": " };
    // One line, whatever a foreign file holds.
    visible(&format!("{} {place}{between}{values}", change.kind().sign())).into_owned()
}

/// Two values that are too long, from shortly before the first place where they differ.
fn cut(before: &str, after: &str, longest: usize) -> (String, String) {
    let is_long = |text: &str| text.chars().count() > longest;
    let one_line = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let (before, after) = (one_line(before), one_line(after));
    if !is_long(&before) && !is_long(&after) {
        return (before, after);
    }
    let same = before.chars().zip(after.chars()).take_while(|(one, other)| one == other).count();
    let start = same.saturating_sub(longest / 3);
    let part = |text: &str| {
        let mut part: String = text.chars().skip(start).take(longest).collect();
        if start > 0 {
            part.insert(0, '…');
        }
        if text.chars().count() > start + longest {
            part.push('…');
        }
        part
    };
    (part(&before), part(&after))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_values_are_cut_around_what_differs() {
        let head = "word ".repeat(20);
        let (before, after) = cut(&format!("{head}old end"), &format!("{head}new end"), 30);
        assert_eq!(before, "…word word old end");
        assert_eq!(after, "…word word new end");
        assert_eq!(cut("a\n b", "c", 30), ("a b".to_owned(), "c".to_owned()));
        let (before, after) = cut("short", &"x".repeat(80), 60);
        assert_eq!((before.as_str(), after.chars().count()), ("short", 61));
    }
}

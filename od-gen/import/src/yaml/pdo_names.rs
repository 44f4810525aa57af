//! Names with numbers in them: the pattern that most of several names follow.

use std::collections::BTreeSet;
use std::ops::Range;

use od_spec::name_pattern::{NamePattern, Numbers, Placeholder};
use od_spec::order::Arrange as _;

/// A name, and the numbers of what it is the name of.
#[derive(Debug, Clone, Copy)]
pub(super) struct Named<'a> {
    pub numbers: Numbers,
    pub name: &'a str,
}

/// What a pattern counts by preference, where several explain the names equally well.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Preferred {
    /// PDOs: objects need names that differ.
    Pdo,
    /// Mapped entries, for the same reason.
    Entry,
    /// Nothing: the name of an entry that each object has once.
    Nothing,
}

/// A pattern with its text.
#[derive(Debug, Clone)]
pub(super) struct Found {
    pub text: String,
    pattern: NamePattern,
}

impl Found {
    /// A pattern; `None` where the text is not one.
    pub(super) fn new(text: impl Into<String>) -> Option<Self> {
        let text = text.into();
        NamePattern::parse(&text).ok().map(|pattern| Self { text, pattern })
    }

    /// Whether it gives this name.
    pub(super) fn gives(&self, named: &Named<'_>) -> bool {
        self.pattern.fill(named.numbers) == named.name
    }

    fn rank(&self, preferred: Preferred) -> (bool, usize) {
        let has = |wanted: fn(Placeholder) -> bool| self.pattern.placeholders().any(|(one, _)| wanted(one));
        let without = match preferred {
            Preferred::Pdo => !has(|one| !one.is_of_entry()),
            Preferred::Entry => !has(Placeholder::is_of_entry),
            Preferred::Nothing => false,
        };
        (without, self.pattern.placeholders().count())
    }
}

/// Most names from which patterns are made; the others are only compared.
const LOOKED_AT: usize = 8;
/// Most numbers of a name that may be placeholders.
const NUMBERS: usize = 4;

/// The pattern that most of the names follow: the usual one, if none does better.
pub(super) fn most_common(list: &[Named<'_>], usual: Option<&str>, preferred: Preferred) -> Option<Found> {
    let score = |found: &Found| list.iter().filter(|named| found.gives(named)).count();
    let mut best = usual.and_then(Found::new).map(|usual| (score(&usual), usual));
    if best.as_ref().is_some_and(|(most, _)| *most == list.len()) {
        return best.map(|(_, usual)| usual);
    }
    let step = list.len().div_ceil(LOOKED_AT).max(1);
    let looked_at = list.iter().step_by(step).chain(list.last());
    let texts: BTreeSet<String> = looked_at.flat_map(candidates).collect();
    let mut found: Vec<Found> = texts.into_iter().filter_map(Found::new).collect();
    found.arrange_by_key(|found| found.rank(preferred));
    for one in found {
        let count = score(&one);
        if best.as_ref().is_none_or(|(most, _)| count > *most) {
            let is_all = count == list.len();
            best = Some((count, one));
            if is_all {
                break;
            }
        }
    }
    best.map(|(_, found)| found)
}

/// The patterns that a name could come from: each number in it may be one of those that it is counted by, or just a number.
fn candidates(named: &Named<'_>) -> Vec<String> {
    let mut texts = vec![String::new()];
    let mut at = 0;
    for (range, placeholders) in spots(named) {
        let plain = NamePattern::escape(&named.name[at..range.start]);
        let number = &named.name[range.clone()];
        texts = texts
            .into_iter()
            .flat_map(|text| {
                let open = placeholders.iter().map(|one| format!("{{{}}}", one.text()));
                let all = open.chain([number.to_owned()]);
                all.map(|end| format!("{text}{plain}{end}")).collect::<Vec<_>>()
            })
            .collect();
        at = range.end;
    }
    let rest = NamePattern::escape(&named.name[at..]);
    texts.into_iter().map(|text| text + &rest).collect()
}

/// Where numbers are in a name that placeholders can replace: the last ones, if there are many.
fn spots(named: &Named<'_>) -> Vec<(Range<usize>, Vec<Placeholder>)> {
    let name = named.name;
    let run = |at: usize, of: fn(char) -> bool| {
        let follows = name[..at].chars().next_back().is_some_and(of);
        let length = name[at..].find(|c| !of(c)).unwrap_or(name.len() - at);
        Some(at..at + length).filter(|_| length > 0 && !follows)
    };
    let mut spots = Vec::new();
    let mut end = 0;
    for (at, _) in name.char_indices() {
        if at < end {
            continue;
        }
        let index = Placeholder::Index.value(named.numbers).unwrap_or_default();
        let whole = name[at..].starts_with(&index).then(|| at..at + index.len());
        let word = run(at, |c| c.is_ascii_alphanumeric());
        let digits = run(at, |c| c.is_ascii_digit());
        let found = [whole, word, digits].into_iter().flatten().find_map(|range| {
            let placeholders = standing_for(&name[range.clone()], named.numbers);
            (!placeholders.is_empty()).then_some((range, placeholders))
        });
        if let Some((range, placeholders)) = found {
            end = range.end;
            spots.push((range, placeholders));
        }
    }
    let first = spots.len().saturating_sub(NUMBERS);
    spots.split_off(first)
}

/// The placeholders that give a text: of two notations that are the same there, the plainer.
fn standing_for(text: &str, numbers: Numbers) -> Vec<Placeholder> {
    let mut found: Vec<Placeholder> = Vec::new();
    for one in Placeholder::all().filter(|one| one.value(numbers).as_deref() == Some(text)) {
        let is_same = |known: &Placeholder| match (known, one) {
            (
                Placeholder::Number { counted, from_zero, .. },
                Placeholder::Number { counted: other, from_zero: zero, .. },
            ) => *counted == other && *from_zero == zero,
            (Placeholder::Index, _) | (_, Placeholder::Index) => false,
        };
        if !found.iter().any(is_same) {
            found.push(one);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use od_spec::model::Index;

    use super::*;

    fn numbers(pdo: u16, entry: Option<u8>) -> Numbers {
        Numbers { pdo, index: Index(0x1600 + pdo - 1), entry }
    }

    /// The pattern of objects, which have these names from PDO 1 on.
    fn of_objects(names: &[&str]) -> String {
        let named = (1..).zip(names).map(|(pdo, name)| Named { numbers: numbers(pdo, None), name });
        most_common(&named.collect::<Vec<_>>(), None, Preferred::Pdo).unwrap().text
    }

    fn of_entries(pdo: u16, names: &[&str]) -> String {
        let named = (1..).zip(names).map(|(sub, name)| Named { numbers: numbers(pdo, Some(sub)), name });
        most_common(&named.collect::<Vec<_>>(), None, Preferred::Entry).unwrap().text
    }

    #[test]
    fn the_number_is_found_however_it_is_written() {
        assert_eq!(of_objects(&["RPDO1", "RPDO2"]), "RPDO{pdo}");
        assert_eq!(
            of_objects(&["Receive PDO 0 mapping", "Receive PDO 1 mapping"]),
            "Receive PDO {pdo-1} mapping"
        );
        assert_eq!(of_objects(&["1. PDO (1)", "2. PDO (1)"]), "{pdo}. PDO (1)");
        assert_eq!(of_objects(&["PDO 1 (1600h)", "PDO 1 (1601h)"]), "PDO 1 ({index})");
        let sixteen: Vec<String> = (1..=17).map(|pdo| format!("PDO {pdo:X}")).collect();
        assert_eq!(of_objects(&sixteen.iter().map(String::as_str).collect::<Vec<_>>()), "PDO {pdo:X}");
        let from_zero: Vec<String> = (0..=16).map(|pdo| format!("PDO {pdo:x}")).collect();
        assert_eq!(of_objects(&from_zero.iter().map(String::as_str).collect::<Vec<_>>()), "PDO {pdo-1:x}");
    }

    #[test]
    fn a_number_of_a_single_object_counts() {
        assert_eq!(of_objects(&["PDO 1"]), "PDO {pdo}");
        assert_eq!(of_entries(1, &["PDO 1 entry 1"]), "PDO 1 entry {n}");
        assert_eq!(of_entries(3, &["PDO 3 entry 1", "PDO 3 entry 2"]), "PDO 3 entry {n}");
    }

    #[test]
    fn most_names_decide_and_braces_stay_braces() {
        assert_eq!(of_objects(&["PDO", "PDO (1601h)", "PDO (1602h)"]), "PDO ({index})");
        assert_eq!(of_objects(&["{pdo} 1", "{pdo} 2"]), "{{pdo}} {pdo}");
        assert_eq!(of_objects(&["1 2 3 4 5 1", "1 2 3 4 5 2"]), "1 2 3 4 5 {pdo}");
        assert_eq!(of_objects(&["ä1ß", "ä2ß"]), "ä{pdo}ß");
    }

    #[test]
    fn the_usual_pattern_stays_where_nothing_is_better() {
        let named =
            [Named { numbers: numbers(1, None), name: "x" }, Named { numbers: numbers(2, None), name: "2" }];
        let found = most_common(&named, Some("x"), Preferred::Nothing).unwrap();
        assert_eq!(found.text, "x");
        assert!(Found::new("{").is_none());
    }
}

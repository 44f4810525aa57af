//! Names as the stack's own exporter makes them, so that firmware that was written for its files finds them again: `COB-ID SYNC message` is
//! `COB_ID_SYNCMessage`. Where that exporter lets names clash, the sub-index distinguishes them.

use std::collections::BTreeMap;

use od_spec::ascii::transliterate;
use od_spec::model::{Entry, Object};

use super::super::language::is_reserved;

/// The name of an object, which follows `x1005_`.
pub(super) fn of_object(object: &Object) -> String {
    let name = camel(object.label());
    if name.is_empty() { "object".to_owned() } else { name }
}

/// The names of the entries of a record, as members of one structure: no two are equal, and none is a word of C or C++.
pub(super) fn of_members(entries: &[Entry]) -> Vec<String> {
    let mut names: Vec<String> = entries
        .iter()
        .map(|entry| match camel(entry.label()) {
            name if name.is_empty() => format!("sub{}", entry.sub),
            name if is_reserved(&name) => format!("{name}_"),
            name => name,
        })
        .collect();
    loop {
        let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
        for name in &names {
            *counts.entry(name).or_default() += 1;
        }
        let clashes: Vec<bool> =
            names.iter().map(|name| counts.get(name.as_str()).is_some_and(|count| *count > 1)).collect();
        if !clashes.contains(&true) {
            return names;
        }
        // All of the equal ones: which came first should not matter. A name grows with each round, so that there is an end.
        for ((name, clashes), entry) in names.iter_mut().zip(clashes).zip(entries) {
            if clashes {
                *name = format!("{name}_{}", entry.sub);
            }
        }
    }
}

/// Words become one: each begins in upper case, except the first one, unless it is all upper case. A `-` becomes `_`,
/// and another `_` is put before and after a number, and between two upper-case letters that come to be adjacent.
fn camel(name: &str) -> String {
    let name = transliterate(name).replace('-', "_");
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut joined = String::new();
    for word in name.split(|c| !is_part(c)).filter(|word| !word.is_empty()) {
        let is = |c: Option<char>, kind: fn(&char) -> bool| c.is_some_and(|c| kind(&c));
        let (last, first, second) = (joined.chars().last(), word.chars().next(), word.chars().nth(1));
        let is_number = is(first, char::is_ascii_digit) || is(last, char::is_ascii_digit);
        let are_capitals = is(last, char::is_ascii_uppercase) && is(first, char::is_ascii_uppercase);
        let (head, rest) = word.split_at(1);
        if is_number || are_capitals {
            joined.push('_');
            joined.push_str(word);
        } else if !joined.is_empty() {
            joined.push_str(&head.to_ascii_uppercase());
            joined.push_str(rest);
        } else if is(second, char::is_ascii_lowercase) {
            joined.push_str(&head.to_ascii_lowercase());
            joined.push_str(rest);
        } else {
            joined.push_str(word);
        }
    }
    joined
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_the_exporter() {
        for (name, expected) in [
            ("Device type", "deviceType"),
            ("COB-ID SYNC message", "COB_ID_SYNCMessage"),
            ("COB-ID time stamp object", "COB_IDTimeStampObject"),
            ("COB-ID EMCY", "COB_ID_EMCY"),
            ("Pre-defined error field", "pre_definedErrorField"),
            ("SDO server parameter", "SDOServerParameter"),
            ("Vendor-ID", "vendor_ID"),
            ("COB-ID client to server (rx)", "COB_IDClientToServerRx"),
            ("Highest sub-index supported", "highestSub_indexSupported"),
            ("24V supply status", "_24VSupplyStatus"),
            ("RPDO 1 communication parameter", "RPDO_1_communicationParameter"),
            ("mapped entry 12", "mappedEntry_12"),
            ("Sensor1 fault", "sensor1_fault"),
            ("x axis", "xAxis"),
            ("X", "X"),
            ("A value", "AValue"),
            ("Größe µ", "groesseU"),
            ("---", "___"),
            ("()", ""),
            ("", ""),
        ] {
            assert_eq!(camel(name), expected, "{name}");
        }
    }
}

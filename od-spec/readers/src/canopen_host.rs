//! What canopen-host 0.6 returns an error for: `canopen_host::eds::Eds::parse`.

use std::collections::BTreeMap;

use super::refusal::{Cause, Place, Refusals};
use od_spec::diag::readers::Reader;
use od_spec::source::FileId;

/// Data types that it knows; entries of others are passed over.
const INTEGERS: [i128; 9] = [0x01, 0x02, 0x03, 0x04, 0x05, 0x06, 0x07, 0x15, 0x1B];
const REALS: [i128; 2] = [0x08, 0x11];
const BYTES: [i128; 3] = [0x09, 0x0A, 0x0F];

type Keys<'t> = BTreeMap<String, (&'t str, Place)>;

pub(super) fn refusals(text: &str, file: FileId) -> Refusals {
    let mut refusals = Refusals::new(Reader::CanopenHost, file);
    for (name, keys) in sections(text) {
        if is_object(&name) {
            entry(&keys, &mut refusals);
        }
    }
    refusals
}

fn sections(text: &str) -> BTreeMap<String, Keys<'_>> {
    let mut sections: BTreeMap<String, Keys<'_>> = BTreeMap::new();
    let (mut current, mut start) = (None, 0);
    for whole in text.split_inclusive('\n') {
        let begin = start;
        start += whole.len();
        let line = whole.trim();
        if line.is_empty() || line.starts_with(';') {
            continue;
        }
        if let Some(name) = line.strip_prefix('[').and_then(|line| line.strip_suffix(']')) {
            let name = name.trim().to_ascii_lowercase();
            sections.entry(name.clone()).or_default();
            current = Some(name);
        } else if let (Some(section), Some((key, value))) = (&current, line.split_once('=')) {
            let place = Place { start: begin, end: begin + whole.trim_end().len() };
            if let Some(keys) = sections.get_mut(section) {
                keys.insert(key.trim().to_ascii_lowercase(), (value.trim(), place));
            }
        }
    }
    sections
}

fn is_object(name: &str) -> bool {
    let (index, sub) = name.split_once("sub").map_or((name, None), |(index, sub)| (index, Some(sub)));
    u16::from_str_radix(index, 16).is_ok() && sub.is_none_or(|sub| u8::from_str_radix(sub, 16).is_ok())
}

fn entry(keys: &Keys<'_>, refusals: &mut Refusals) {
    let Some((text, place)) = keys.get("datatype") else { return };
    let Some(data_type) =
        refusals.wants(sum(text), *place, Cause::Number, "a data type that is not a number")
    else {
        return;
    };
    if ![&INTEGERS[..], &REALS, &BYTES].iter().any(|types| types.contains(&data_type)) {
        return;
    }
    if let Some((access, place)) = keys.get("accesstype")
        && !["ro", "wo", "rw", "rwr", "rww", "const"].iter().any(|known| access.eq_ignore_ascii_case(known))
    {
        refusals.add(*place, Cause::Value, "not a valid access type");
    }
    let Some((value, place)) = keys.get("parametervalue").or_else(|| keys.get("defaultvalue")) else {
        return;
    };
    if value.is_empty() {
        return;
    }
    if INTEGERS.contains(&data_type) && sum(value).is_none() {
        refusals.add(*place, Cause::Number, "a value that is not a sum of plain numbers and `$NODEID`");
    }
    if REALS.contains(&data_type) && value.parse::<f64>().is_err() {
        refusals.add(*place, Cause::Number, "a REAL that is not written in decimal");
    }
}

/// Numbers and `$NODEID`, in any order, with `+` between them.
fn sum(text: &str) -> Option<i128> {
    let mut sum: i128 = 0;
    for term in text.split('+').map(str::trim).filter(|term| !term.is_empty()) {
        let number = match term.strip_prefix("0x").or_else(|| term.strip_prefix("0X")) {
            _ if term.eq_ignore_ascii_case("$nodeid") => 5,
            Some(digits) => i128::from_str_radix(digits, 16).ok()?,
            None => term.parse().ok()?,
        };
        sum = sum.saturating_add(number);
    }
    Some(sum)
}

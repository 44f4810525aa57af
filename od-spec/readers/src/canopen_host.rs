//! What canopen-host 0.6 returns an error for: `canopen_host::eds::Eds::parse`.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::refusal::{Cause, Place, Refusals};
use od_spec::diag::readers::Reader;
use od_spec::source::FileId;

/// Data types that it knows; entries of others are passed over.
const INTEGERS: [i128; 9] = [0x01, 0x02, 0x03, 0x04, 0x05, 0x06, 0x07, 0x15, 0x1B];
const REALS: [i128; 2] = [0x08, 0x11];
const BYTES: [i128; 3] = [0x09, 0x0A, 0x0F];

/// What it looks at in the section of an entry, each with its last value.
#[derive(Debug, Default)]
struct Entry<'t> {
    data_type: Option<Value<'t>>,
    access: Option<Value<'t>>,
    parameter: Option<Value<'t>>,
    default: Option<Value<'t>>,
}

type Value<'t> = (&'t str, Place);

impl<'t> Entry<'t> {
    fn value_of(&mut self, key: &str) -> Option<&mut Option<Value<'t>>> {
        let is = |name: &str| key.eq_ignore_ascii_case(name);
        Some(match key.len() {
            8 if is("DataType") => &mut self.data_type,
            10 if is("AccessType") => &mut self.access,
            12 if is("DefaultValue") => &mut self.default,
            14 if is("ParameterValue") => &mut self.parameter,
            _ => return None,
        })
    }
}

pub(super) fn refusals(text: &str, file: FileId) -> Refusals {
    let mut refusals = Refusals::new(Reader::CanopenHost, file);
    for entry in entries(text).values() {
        check(entry, &mut refusals);
    }
    refusals
}

/// The sections of objects and sub-indices, by name in lower case.
fn entries(text: &str) -> BTreeMap<Cow<'_, str>, Entry<'_>> {
    let mut entries: BTreeMap<Cow<'_, str>, Entry<'_>> = BTreeMap::new();
    let (mut current, mut start) = (None, 0);
    while start < text.len() {
        let begin = start;
        let rest = &text[begin..];
        let whole = &rest[..memchr::memchr(b'\n', rest.as_bytes()).unwrap_or(rest.len())];
        start += whole.len() + 1;
        let line = whole.trim();
        if let Some(name) = line.strip_prefix('[').and_then(|line| line.strip_suffix(']')) {
            let name = lower(name.trim());
            current = if is_entry(&name) { Some(entries.entry(name).or_default()) } else { None };
        } else if let Some(entry) = &mut current
            && !line.starts_with(';')
            && let Some(equals) = memchr::memchr(b'=', line.as_bytes())
            && let Some(value) = entry.value_of(line[..equals].trim_end())
        {
            let place = Place { start: begin, end: begin + whole.trim_end().len() };
            *value = Some((line[equals + 1..].trim_start(), place));
        }
    }
    entries
}

fn lower(name: &str) -> Cow<'_, str> {
    if name.bytes().any(|byte| byte.is_ascii_uppercase()) {
        Cow::Owned(name.to_ascii_lowercase())
    } else {
        Cow::Borrowed(name)
    }
}

fn is_entry(name: &str) -> bool {
    let (index, sub) = name.split_once("sub").map_or((name, None), |(index, sub)| (index, Some(sub)));
    u16::from_str_radix(index, 16).is_ok() && sub.is_none_or(|sub| u8::from_str_radix(sub, 16).is_ok())
}

fn check(entry: &Entry<'_>, refusals: &mut Refusals) {
    let Some((text, place)) = entry.data_type else { return };
    let Some(data_type) = refusals.wants(sum(text), place, Cause::Number, "a data type that is not a number")
    else {
        return;
    };
    if ![&INTEGERS[..], &REALS, &BYTES].iter().any(|types| types.contains(&data_type)) {
        return;
    }
    if let Some((access, place)) = entry.access
        && !["ro", "wo", "rw", "rwr", "rww", "const"].iter().any(|known| access.eq_ignore_ascii_case(known))
    {
        refusals.add(place, Cause::Value, "not a valid access type");
    }
    let Some((value, place)) = entry.parameter.or(entry.default) else { return };
    if value.is_empty() {
        return;
    }
    if INTEGERS.contains(&data_type) && sum(value).is_none() {
        refusals.add(place, Cause::Number, "a value that is not a sum of plain numbers and `$NODEID`");
    }
    if REALS.contains(&data_type) && value.parse::<f64>().is_err() {
        refusals.add(place, Cause::Number, "a REAL that is not written in decimal");
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

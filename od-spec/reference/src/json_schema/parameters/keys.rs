//! The keys under which an entry may be: by index, in every notation that the compiler reads.
//!
//! An editor does not see keys as text, as the compiler does: `0x2000` is the key `8192`, and `6510.10` the key `6510.1`. A text
//! that may mean several things is right where one of them is.

use std::collections::{BTreeMap, BTreeSet};

use super::{Named, settable};
use od_spec::model::{Dictionary, EntryId, Index, SubIndex};

/// Keys by index.
pub(super) struct Spellings {
    /// Texts that may mean several things.
    pub exact: BTreeMap<String, BTreeSet<Named>>,
    /// Regular expressions, each for one thing.
    pub patterns: Vec<(String, Named)>,
}

pub(super) fn spellings(device: &Dictionary) -> Spellings {
    let mut all: BTreeMap<String, BTreeSet<Named>> = BTreeMap::new();
    let named = named(device);
    for of in &named {
        for text in seen_as(*of).into_iter().chain(plain(*of)) {
            all.entry(text).or_default().insert(*of);
        }
    }
    let patterns = named.iter().map(|of| (pattern(*of, &all), *of)).collect();
    all.retain(|_, of| of.len() > 1);
    Spellings { exact: all, patterns }
}

/// Every entry that can be set, and every object that has such below it.
fn named(device: &Dictionary) -> Vec<Named> {
    let mut named = BTreeSet::new();
    for (id, object, _) in settable(device) {
        named.insert(Named::Entry(id));
        if object.is_structured() {
            named.insert(Named::Object(id.index));
        }
    }
    named.into_iter().collect()
}

/// The sub-index that has to be written; none where the object is one value.
fn index_and_sub(of: Named) -> (Index, Option<SubIndex>) {
    match of {
        Named::Entry(EntryId { index, sub }) => (index, Some(sub)),
        Named::Object(index) => (index, None),
    }
}

/// Digits alone, which a reader of YAML takes for a number: `6510`, `6510.3`.
fn plain(of: Named) -> Option<String> {
    let (index, sub) = index_and_sub(of);
    let digits = format!("{:04X}", index.0);
    let is_number = digits.bytes().all(|byte| byte.is_ascii_digit());
    is_number.then(|| match sub {
        Some(SubIndex(0)) | None => digits,
        Some(sub) => format!("{digits}.{sub}"),
    })
}

/// What becomes of keys that a reader of YAML takes for numbers: of `0x6510`, and of `6510.10`.
fn seen_as(of: Named) -> Vec<String> {
    let (index, sub) = index_and_sub(of);
    let decimal = matches!(sub, Some(SubIndex(0)) | None).then(|| index.0.to_string());
    let fraction =
        plain(of).filter(|text| text.contains('.')).map(|text| text.trim_end_matches('0').to_owned());
    decimal.into_iter().chain(fraction).collect()
}

/// Every way to write it, but those that may mean something else.
fn pattern(of: Named, all: &BTreeMap<String, BTreeSet<Named>>) -> String {
    let (Index(index), sub) = index_and_sub(of);
    let hexadecimal = |digits: String| -> String {
        let one = |digit: char| match digit {
            'A'..='F' => format!("[{digit}{}]", digit.to_ascii_lowercase()),
            digit => digit.to_string(),
        };
        digits.chars().map(one).collect()
    };
    let object = format!("(0[xX])?{}[hH]?", hexadecimal(format!("{index:04X}")));
    let of_sub = |SubIndex(sub): SubIndex| {
        let digits = hexadecimal(format!("{sub:X}"));
        let short = if sub < 10 { format!("|:0?{sub}") } else { String::new() };
        format!(
            "(\\.({sub}|0[xX]0?{digits})|[sS][uU][bB]0?{digits}|:(0[xX]0?{digits}|0?{digits}[hH]){short})"
        )
    };
    let sub = match sub {
        Some(SubIndex(0)) => format!("{}?", of_sub(SubIndex(0))),
        Some(sub) => of_sub(sub),
        None => String::new(),
    };
    let is_shared = |text: &&String| all.get(*text).is_some_and(|of| of.len() > 1);
    let texts: Vec<String> = seen_as(of).into_iter().chain(plain(of)).collect();
    let escaped = |text: &String| text.replace('.', "\\.");
    let shared: Vec<String> = texts.iter().filter(is_shared).map(escaped).collect();
    let own =
        seen_as(of).into_iter().filter(|text| !is_shared(&text)).map(|text| format!("|{}", escaped(&text)));
    let own: String = own.collect();
    let not = if shared.is_empty() { String::new() } else { format!("(?!({})$)", shared.join("|")) };
    format!("^{not}({object}{sub}{own})$")
}

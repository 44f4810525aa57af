//! Heartbeat consumers by node and time: `{node: 5, time: 3000 ms}` for the value 0005_0BB8h of an entry of 1016h.

use crate::ast::{DefaultDecl, Name};
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::keys::{CONSUMER, Key};
use crate::model::{Index, Ratio};
use crate::scalar;
use crate::source::{Span, Spanned};

/// The object whose entries are consumers.
const CONSUMERS: Index = Index(0x1016);

type Keys = [(Name, Spanned<DefaultDecl>)];

/// Whether the keys of a default are those of a consumer, at an object that has such.
pub(crate) fn are_meant(index: Index, keys: &Keys) -> bool {
    index == CONSUMERS && !keys.is_empty() && keys.iter().all(|(key, _)| is_key(&key.value))
}

/// Whether a name is a key of a consumer.
pub(super) fn is_key(name: &str) -> bool {
    CONSUMER.get(name).is_some()
}

/// The raw value of a consumer.
pub(crate) fn raw(keys: &Keys, place: Span, diagnostics: &mut Diagnostics) -> Option<i128> {
    let mut value = |key: &Key| {
        let (name, example) = (key.name, key.example.unwrap_or_default());
        let Some((_, value)) = keys.iter().find(|(key, _)| key.value == name) else {
            let message = format!("a heartbeat consumer needs the key `{name}`");
            let help = format!("write both, such as `{{node: 5, time: 3000 ms}}`, here `{name}: {example}`");
            diagnostics.push(Diagnostic::new(codes::MISSING_KEY, place, message).help(help));
            return None;
        };
        let Some(text) = value.value.text() else {
            let message = format!("a list or a map as `{name}` of a heartbeat consumer");
            let help = format!("write one value, such as `{name}: {example}`");
            diagnostics.push(Diagnostic::new(codes::BAD_VALUE, value.span, message).help(help));
            return None;
        };
        Some(Spanned::new(text, value.span))
    };
    let [node, time] = CONSUMER.keys else { return None };
    let (node, time) = (value(node), value(time));
    let node = node.and_then(|text| node_id(text, diagnostics));
    let time = time.and_then(|text| milliseconds(text, diagnostics));
    Some(node? << 16 | time?)
}

fn node_id(text: Spanned<&str>, diagnostics: &mut Diagnostics) -> Option<i128> {
    let read = scalar::integer(text.value);
    if let Some(node) = read.ok().filter(|node| (1..=127).contains(node)) {
        return Some(node);
    }
    let code = if read.is_ok() { codes::NUMBER_OUT_OF_RANGE } else { codes::BAD_NUMBER };
    let message = format!("found `{}`, expected the node-ID that is watched", shorten(text.value));
    diagnostics.push(Diagnostic::new(code, text.span, message).help("write a number from 1 to 127"));
    None
}

/// A time in milliseconds, or with its symbol.
fn milliseconds(text: Spanned<&str>, diagnostics: &mut Diagnostics) -> Option<i128> {
    let in_symbol = |symbol: &str, milliseconds: i128| {
        let number = scalar::decimal(text.value.strip_suffix(symbol)?.trim_end())?;
        number.checked_mul(Ratio::whole(milliseconds))
    };
    let plain = || scalar::integer(text.value).ok().map(Ratio::whole);
    let time = plain().or_else(|| in_symbol("ms", 1)).or_else(|| in_symbol("s", 1000));
    let (code, expected) = match time.map(Ratio::to_whole) {
        Some(Some(time)) if (1..=0xFFFF).contains(&time) => return Some(time),
        Some(Some(_)) => (codes::NUMBER_OUT_OF_RANGE, "1 ms to 65535 ms"),
        Some(None) => (codes::INEXACT_VALUE, "whole milliseconds"),
        None => (codes::BAD_VALUE, "a time"),
    };
    let message = format!("found `{}`, expected {expected}", shorten(text.value));
    diagnostics.push(
        Diagnostic::new(code, text.span, message)
            .help("write 1 ms to 65535 ms, such as `3000 ms`, `3 s` or `3000`"),
    );
    None
}

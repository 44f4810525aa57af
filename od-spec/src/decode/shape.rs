//! Compares a YAML tree with the key tables.

use std::collections::BTreeMap;

use super::{choices, lexical};
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::expr::{AnyName, ConditionError, Expr, Parsed, without_names};
use crate::keys::{CHANNELS, Key, KeyKind, Keys, NameOf, Need, NumberedName, Shape, VERSION};
use crate::model::Access;
use crate::name_pattern::{NamePattern, Placeholder};
use crate::scalar;
use crate::source::{Span, Spanned};
use crate::yaml::{MERGE, Node, NodeKind};

/// Checks a map with fixed keys and everything below it. `owner` is the place that represents
/// the whole map: the key it belongs to.
pub(super) fn check_map(node: &Node, keys: &Keys, owner: Span, diagnostics: &mut Diagnostics) {
    let NodeKind::Map(entries) = &node.kind else {
        wrong_kind(node, &format!("the keys of {}", keys.name), diagnostics);
        return;
    };
    let is_there = |key: &Key| entries.iter().any(|(name, _)| name.value == key.name);
    let missing = |key: &&Key| key.need == Need::Required && !is_there(key);
    let missing: Vec<&Key> = keys.keys.iter().filter(missing).collect();
    let (mut misspelt, mut is_sure) = (Vec::new(), true);
    for (name, value) in entries {
        match keys.get(&name.value) {
            Some(key) => check(value, key.shape, name.span, diagnostics),
            None if name.value == MERGE => {}
            None => {
                is_sure = false;
                let meant = diagnostics.suggestions.nearest(&name.value, missing.iter().map(|key| key.name));
                misspelt.extend(meant);
                unknown_key(name, value, keys, diagnostics);
            }
        }
    }
    for key in missing.iter().filter(|key| !misspelt.contains(&key.name)) {
        let what = if key.about == key.name { String::new() } else { format!(" ({})", key.about) };
        diagnostics.push(
            Diagnostic::new(codes::MISSING_KEY, owner, format!("{} needs the key `{}`", keys.name, key.name))
                .help(format!("add `{}:`{what}", key.name)),
        );
    }
    // A key that is unknown may have been meant for the one that is missing.
    if is_sure && let Some(diagnostic) = choices::check(entries, keys, owner) {
        diagnostics.push(diagnostic);
    }
}

fn unknown_key(name: &Spanned<String>, value: &Node, keys: &Keys, diagnostics: &mut Diagnostics) {
    let known = keys.keys.iter().map(|key| key.name);
    let diagnostic = Diagnostic::new(
        codes::UNKNOWN_KEY,
        name.span,
        format!("{} has no key `{}`", keys.name, shorten(&name.value)),
    );
    // What has a key and a colon needs no guess at another key.
    if let Some(pair) = without_blank(&name.value, keys).filter(|_| value.kind == NodeKind::Null) {
        let help = format!("write `{}`", shorten(&pair));
        diagnostics.push(diagnostic.label("no space after the colon").help(help).edit(name.span, pair));
        return;
    }
    let meant = diagnostics.suggestions.nearest(&name.value, known.clone());
    diagnostics.push(match meant {
        Some(word) => diagnostic.label("unknown").did_you_mean(word),
        None if value.kind == NodeKind::Null => diagnostic
            .label("a key without a value")
            .help("inside `{}` put a text that holds a comma in quotes"),
        None => diagnostic.label("unknown").help(format!(
            "its keys are {}",
            known.map(|key| format!("`{key}`")).collect::<Vec<_>>().join(", ")
        )),
    });
}

/// What `name:input` was meant to be, where `name` is a key.
fn without_blank(text: &str, keys: &Keys) -> Option<String> {
    let (key, value) = text.split_once(':')?;
    let is_pair = !value.is_empty() && keys.get(key).is_some();
    is_pair.then(|| format!("{key}: {value}"))
}

fn wrong_kind(node: &Node, expected: &str, diagnostics: &mut Diagnostics) {
    wrong_kind_for(node, expected, expected, diagnostics);
}

fn wrong_kind_for(node: &Node, expected: &str, example: &str, diagnostics: &mut Diagnostics) {
    if node.kind == NodeKind::Broken {
        return;
    }
    diagnostics.push(
        Diagnostic::new(
            codes::WRONG_KIND,
            node.span,
            format!("found {}, expected {expected}", node.describe()),
        )
        .help(format!("write {example}")),
    );
}

/// Reports what is listed twice in a list of names or numbers, in which each counts once.
fn check_set(items: &[Node], item: Shape, diagnostics: &mut Diagnostics) {
    let is_set = match item {
        // Files are not joined twice; that is said by itself.
        Shape::NameOf(NameOf::File | NameOf::LibraryFile) => false,
        Shape::NameOf(_)
        | Shape::Choice(_)
        | Shape::Index
        | Shape::Integer(..)
        | Shape::ErrorCode
        | Shape::Feature
        | Shape::Entry => true,
        _ => false,
    };
    if is_set {
        named_once(items, diagnostics);
    }
}

/// Reports what is listed twice. A number is the same in any notation; a name with a number, as features with channels have
/// it, is the same with the same number.
pub(super) fn named_once(items: &[Node], diagnostics: &mut Diagnostics) {
    let mut before = BTreeMap::new();
    for node in items {
        let numbered = || {
            let (name, number) = node.entries().first()?;
            Some((Spanned::new(name.value.as_str(), name.span), number.text().map(|text| text.value)))
        };
        let Some((name, number)) = node.text().map(|name| (name, None)).or_else(numbered) else { continue };
        let what = (scalar::integer(name.value).map_err(|_| name.value), number);
        if let Some(first) = before.get(&what) {
            diagnostics.push(
                Diagnostic::new(
                    codes::NAMED_TWICE,
                    name.span,
                    format!("`{}` is listed twice", shorten(name.value)),
                )
                .with(*first, "before")
                .help("remove one of the two, or name what was meant"),
            );
        } else {
            before.insert(what, name.span);
        }
    }
}

/// Checks a value of any shape.
pub(super) fn check(node: &Node, shape: Shape, owner: Span, diagnostics: &mut Diagnostics) {
    match shape {
        Shape::Map(keys) => check_map(node, keys, owner, diagnostics),
        Shape::ShortOr(short, keys) => match node.kind {
            NodeKind::Map(_) => check_map(node, keys, owner, diagnostics),
            _ => check(node, *short, owner, diagnostics),
        },
        Shape::Words => match &node.kind {
            // A text may be empty where a name may not.
            NodeKind::Map(_) => check_keyed(node, KeyKind::Language, Shape::Value, diagnostics),
            NodeKind::Scalar { .. } => {}
            _ => wrong_kind(node, "a text", diagnostics),
        },
        Shape::MapOf(kind, value) => check_keyed(node, kind, *value, diagnostics),
        Shape::List(item) => match &node.kind {
            NodeKind::List(items) => {
                check_set(items, *item, diagnostics);
                for node in items {
                    let owner = start(node);
                    check(node, *item, owner, diagnostics);
                }
            }
            NodeKind::Scalar { text, .. } => {
                let example = format!("a list such as `[{}]`", shorten(text));
                wrong_kind_for(node, "a list", &example, diagnostics);
            }
            NodeKind::Null | NodeKind::Map(_) | NodeKind::Broken => wrong_kind(node, "a list", diagnostics),
        },
        Shape::Feature => check_feature(node, diagnostics),
        // An empty list says that no bit is 1.
        Shape::Default | Shape::Setting => match &node.kind {
            NodeKind::List(items) => {
                for node in items {
                    let owner = start(node);
                    check(node, shape, owner, diagnostics);
                }
            }
            NodeKind::Map(_) => check_keyed(node, KeyKind::Name, shape, diagnostics),
            NodeKind::Scalar { .. } => {}
            NodeKind::Null | NodeKind::Broken => wrong_kind(node, expected(shape), diagnostics),
        },
        Shape::OneOrMore(item) => match &node.kind {
            NodeKind::List(items) if items.is_empty() => wrong_kind(node, "at least one value", diagnostics),
            NodeKind::List(items) => {
                check_set(items, *item, diagnostics);
                for node in items {
                    let owner = start(node);
                    check(node, *item, owner, diagnostics);
                }
            }
            _ => check(node, *item, owner, diagnostics),
        },
        _ => match node.text() {
            Some(text) => check_scalar(text, shape, diagnostics),
            None if matches!((shape, &node.kind), (Shape::Text | Shape::HeaderText | Shape::NameOf(_), NodeKind::Map(_))) => diagnostics.push(
                Diagnostic::new(
                    codes::WRONG_KIND,
                    node.span,
                    format!("found {}, expected {}", node.describe(), expected(shape)),
                )
                .help("write one text: names are the same in every language; descriptions such as `about` can be written by language"),
            ),
            None => wrong_kind(node, expected(shape), diagnostics),
        },
    }
}

/// The place that represents a value without a key of its own: a map's first key.
pub(in crate::decode) fn start(node: &Node) -> Span {
    node.entries().first().map_or(node.span, |(name, _)| name.span)
}

/// A name, or a name and a number.
fn check_feature(node: &Node, diagnostics: &mut Diagnostics) {
    let owner = node.span;
    match &node.kind {
        NodeKind::Map(entries) if entries.len() == 1 => {
            for (name, number) in entries {
                check(number, Shape::Integer(1, CHANNELS), name.span, diagnostics);
            }
        }
        NodeKind::Map(_) => {
            wrong_kind(node, "a feature, such as `emergency` or `digital inputs: 16`", diagnostics);
        }
        NodeKind::Scalar { .. } | NodeKind::List(_) | NodeKind::Null | NodeKind::Broken => {
            check(node, Shape::Text, owner, diagnostics);
        }
    }
}

fn check_keyed(node: &Node, kind: KeyKind, value: Shape, diagnostics: &mut Diagnostics) {
    let NodeKind::Map(entries) = &node.kind else {
        // A section whose entries were all removed or commented out holds nothing.
        if node.kind != NodeKind::Null {
            wrong_kind(node, &format!("a map whose keys are {}", key_words(kind)), diagnostics);
        }
        return;
    };
    for (name, node) in entries.iter().filter(|(name, _)| name.value != MERGE) {
        let text = name.value.as_str();
        let integer = || scalar::integer(text).ok();
        let fits = match kind {
            KeyKind::Name | KeyKind::Device => !text.is_empty(),
            KeyKind::DeviceKey => lexical::is_device_key(text),
            KeyKind::Place => lexical::is_place(text),
            KeyKind::Machines => lexical::machines(text).is_some(),
            KeyKind::Language => {
                text.len() >= 2 && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '-')
            }
            KeyKind::Indices => lexical::indices(text).is_some(),
            KeyKind::SubIndices => lexical::sub_indices(text).is_some(),
            KeyKind::SubIndex => integer().is_some_and(|sub| (1..=254).contains(&sub)),
            KeyKind::Bits => lexical::bits(text).is_some(),
            KeyKind::Integer => integer().is_some(),
            KeyKind::ErrorCodes => lexical::error_codes(text).is_some(),
            KeyKind::PdoNumber => integer().is_some_and(|number| (1..=512).contains(&number)),
            KeyKind::Number => integer().is_some_and(|number| (0..=255).contains(&number)),
        };
        if !fits {
            let meant = match kind {
                KeyKind::Indices | KeyKind::ErrorCodes => lexical::with_0x(text),
                KeyKind::Name
                | KeyKind::Device
                | KeyKind::DeviceKey
                | KeyKind::Place
                | KeyKind::Machines
                | KeyKind::Language
                | KeyKind::SubIndex
                | KeyKind::SubIndices
                | KeyKind::Bits
                | KeyKind::Integer
                | KeyKind::PdoNumber
                | KeyKind::Number => None,
            };
            let is_run = |text: &str| match kind {
                KeyKind::Indices => lexical::indices(text).is_some(),
                KeyKind::SubIndices => lexical::sub_indices(text).is_some(),
                KeyKind::Bits => lexical::bits(text).is_some(),
                KeyKind::ErrorCodes => lexical::error_codes(text).is_some(),
                KeyKind::Machines => lexical::machines(text).is_some(),
                KeyKind::Name
                | KeyKind::Device
                | KeyKind::DeviceKey
                | KeyKind::Place
                | KeyKind::Language
                | KeyKind::SubIndex
                | KeyKind::Integer
                | KeyKind::PdoNumber
                | KeyKind::Number => false,
            };
            let turned = lexical::turned(text).filter(|turned| is_run(turned));
            let message = format!("found the key `{}`, expected {}", shorten(text), key_words(kind));
            let diagnostic = Diagnostic::new(codes::BAD_KEY, name.span, message);
            diagnostics.push(match (turned, meant) {
                _ if matches!(kind, KeyKind::SubIndices | KeyKind::SubIndex)
                    && scalar::integer(text) == Ok(0) =>
                {
                    diagnostic.help("sub-index 0 counts the others: its keys go into `sub0:` of the object")
                }
                (Some(turned), _) => write_turned(diagnostic, &turned),
                (None, Some(meant)) => diagnostic.write(&meant),
                (None, None) => diagnostic.help(format!("keys of this map are {}", key_words(kind))),
            });
        }
        check(node, value, name.span, diagnostics);
    }
}

const fn key_words(kind: KeyKind) -> &'static str {
    match kind {
        KeyKind::Name | KeyKind::Device => "names",
        KeyKind::DeviceKey => "short keys of lower-case letters, digits and `-`, such as `pmc`",
        KeyKind::Place => {
            "names of letters, digits, `-` and `_`, such as `A` or `hall-2`; not `CON` and others that Windows keeps"
        }
        KeyKind::Machines => "names or numbers such as `17`, or runs such as `1..200`",
        KeyKind::Language => "language codes such as `en`",
        KeyKind::Indices => "indices such as `0x6040`, 0001h to FFFFh, or runs such as `0x3511..0x3519`",
        KeyKind::SubIndex => "sub-indices, 1 to 254",
        KeyKind::SubIndices => "sub-indices, 1 to 254, or runs such as `1..4`",
        KeyKind::Bits => "bits such as `4`, or runs such as `0..3`",
        KeyKind::Integer => "integers",
        KeyKind::ErrorCodes => "error codes such as `0x3210`, or ranges such as `0x3281..0x3288`",
        KeyKind::PdoNumber => "PDO numbers, 1 to 512",
        KeyKind::Number => "numbers, 0 to 255",
    }
}

const fn expected(shape: Shape) -> &'static str {
    match shape {
        Shape::Integer(..) | Shape::Version => "an integer",
        Shape::YesNo => "`yes` or `no`",
        Shape::Choice(_) => "a word",
        Shape::Date => "a date such as `2009-05-27`",
        Shape::DateTime => "a date and time such as `2009-05-27 09:00`",
        Shape::Index => "an index such as `0x6040`",
        Shape::ErrorCode => "an error code such as `0x3210`",
        Shape::Entry => "an entry such as `0x6040`, `0x30FA.3` or its name",
        Shape::Entries => "an entry such as `0x6040`, `0x30FA.3` or its name, or a run such as `0x2021.1..4`",
        Shape::Access => "an access type such as `ro` or `rw locked`",
        Shape::Type => "a data type or the name of a type",
        Shape::Value | Shape::Default | Shape::Setting => "a value",
        Shape::Ratio => "a fraction such as `1/10`",
        Shape::SignedRatio => "a number such as `-40` or `-273.15`, in the unit's symbol",
        Shape::Base => "a fraction and a symbol such as `1/1000 V`",
        Shape::Time => "a time such as `10 ms`",
        Shape::Numbers => "a number from 0 to 255 or a run such as `0..11`",
        Shape::Formula => "a formula such as `0x6092.1 / 0x6092.2`",
        Shape::Condition => "a condition such as `0x607D.1 < 0x607D.2`",
        Shape::Pattern => "bits such as `xxxx xxxx x01x 0001`",
        Shape::NumberedName(NumberedName::Parameter) => "a name such as `Receive PDO {pdo} Mapping`",
        Shape::NumberedName(NumberedName::MappedEntry) => "a name such as `Mapping Entry {n}`",
        Shape::Text | Shape::HeaderText | Shape::Words | Shape::NameOf(_) => "a text",
        Shape::Map(_) | Shape::MapOf(..) | Shape::ShortOr(..) => "a map",
        Shape::Feature => "a feature such as `emergency` or `digital inputs: 16`",
        Shape::List(_) | Shape::OneOrMore(_) => "a list",
    }
}

/// Reports what cannot be read in a condition or formula.
fn unreadable<T>(
    text: Spanned<&str>,
    read: Parsed<T>,
    what: &str,
    help: &str,
    diagnostics: &mut Diagnostics,
) {
    if let Err(ConditionError { range, message }) = read {
        diagnostics.push(
            Diagnostic::new(
                codes::BAD_NOTATION,
                inside(text, &range),
                format!("cannot read this {what}: {message}"),
            )
            .help(help),
        );
    }
}

fn check_integer(text: Spanned<&str>, low: i128, high: i128, diagnostics: &mut Diagnostics) {
    match scalar::integer(text.value) {
        Err(error) => diagnostics.push(
            Diagnostic::new(
                codes::BAD_NUMBER,
                text.span,
                format!("found `{}`, expected an integer", shorten(text.value)),
            )
            .help(error.help()),
        ),
        Ok(number) if !(low..=high).contains(&number) => {
            let range = format!("a number from {low} to {high}");
            diagnostics.push(
                Diagnostic::new(
                    codes::NUMBER_OUT_OF_RANGE,
                    text.span,
                    format!("found `{}`, expected {range}", shorten(text.value)),
                )
                .help(format!("write {range}")),
            );
        }
        Ok(_) => {}
    }
}

/// The version of the language: what another one means is unknown here.
fn check_version(text: Spanned<&str>, diagnostics: &mut Diagnostics) {
    if scalar::integer(text.value) != Ok(VERSION) {
        let message = format!("found version `{}` of the language, expected {VERSION}", shorten(text.value));
        diagnostics.push(Diagnostic::new(codes::NUMBER_OUT_OF_RANGE, text.span, message).help(format!(
            "write {VERSION}; if the file really is of a later version, read it with a later odgen"
        )));
    }
}

fn check_scalar(text: Spanned<&str>, shape: Shape, diagnostics: &mut Diagnostics) {
    let value = text.value;
    match shape {
        Shape::Integer(low, high) => check_integer(text, low, high, diagnostics),
        Shape::Version => check_version(text, diagnostics),
        Shape::YesNo if scalar::yes_no(value).is_none() => diagnostics.push(
            Diagnostic::new(
                codes::UNKNOWN_WORD,
                text.span,
                format!("found `{}`, expected `yes` or `no`", shorten(value)),
            )
            .help("write `yes` or `no`"),
        ),
        Shape::Choice(words) if !words.contains(&value) => unknown_word(text, words, diagnostics),
        Shape::Access if lexical::access(value).is_none() => unknown_word(text, Access::WORDS, diagnostics),
        Shape::Condition => unreadable(
            text,
            without_names(value, &mut AnyName),
            "condition",
            "conditions look like `0x30FA.3 < 0x30FA.1 <= 750` or `bit(0x6041, 2) == 0`; entries and bits may be written by name",
            diagnostics,
        ),
        Shape::Formula => unreadable(
            text,
            Expr::parse_term(value),
            "formula",
            "formulas look like `0x6092.1 / 0x6092.2 / 65536`",
            diagnostics,
        ),
        Shape::NumberedName(of) if !value.trim().is_empty() => check_numbered(text, of, diagnostics),
        _ => {
            let fits = match shape {
                Shape::NumberedName(_) => false,
                Shape::Text | Shape::NameOf(_) => !value.trim().is_empty(),
                Shape::Date => lexical::date(value).is_some(),
                Shape::DateTime => lexical::date_time(value).is_some(),
                Shape::Index => lexical::index(value).is_some(),
                Shape::ErrorCode => {
                    lexical::error_codes(value).is_some_and(|codes| codes.first == codes.last)
                }
                Shape::Entry => lexical::entry_by_index(value).is_some() || !lexical::looks_like_index(value),
                Shape::Entries if value.contains("..") && lexical::looks_like_index(value) => {
                    lexical::run_by_index(value).is_some()
                }
                Shape::Entries => {
                    lexical::entry_by_index(value).is_some() || !lexical::looks_like_index(value)
                }
                Shape::Ratio => lexical::positive_ratio(value).is_some(),
                Shape::SignedRatio => scalar::ratio(value).is_some(),
                Shape::Base => lexical::base(value).is_some(),
                Shape::Pattern => lexical::pattern(value).is_some(),
                Shape::Numbers => lexical::numbers(value).is_some(),
                _ => true,
            };
            if !fits {
                let message = format!("found {}, expected {}", quoted(value), expected(shape));
                let diagnostic = Diagnostic::new(codes::BAD_NOTATION, text.span, message);
                diagnostics.push(with_meant(diagnostic, value, shape));
            }
        }
    }
}

/// Says what to write in the place of a scalar that cannot be read.
fn with_meant(diagnostic: Diagnostic, text: &str, shape: Shape) -> Diagnostic {
    let is_run = matches!(shape, Shape::Entries) && text.contains("..");
    let turned = lexical::turned(text).filter(|run| is_run && lexical::run_by_index(run).is_some());
    if let Some(turned) = turned {
        return write_turned(diagnostic, &turned);
    }
    let meant = match shape {
        Shape::Entries if is_run => lexical::run_with_0x(text),
        Shape::Index | Shape::Entry | Shape::Entries | Shape::ErrorCode => lexical::with_0x(text),
        _ => None,
    };
    match meant {
        Some(meant) => diagnostic.write(&meant),
        None => diagnostic.help(format!("write {}", expected(shape))),
    }
}

fn write_turned(diagnostic: Diagnostic, turned: &str) -> Diagnostic {
    diagnostic.help(format!("write `{turned}`; a run goes from the smaller to the larger")).meant(turned)
}

/// The part of a scalar that a byte range of its text covers. Exact for plain one-line scalars, else the whole scalar.
pub(crate) fn inside(text: Spanned<&str>, range: &std::ops::Range<usize>) -> Span {
    let plain = (text.span.end - text.span.start) as usize;
    match plain.checked_sub(text.value.len()) {
        Some(0) => text.span.part(range.start, range.end.max(range.start + 1)),
        Some(2) => text.span.part(range.start + 1, range.end.max(range.start + 1) + 1),
        _ => text.span,
    }
}

/// The placeholders of a name are there, and have a number where it is.
fn check_numbered(text: Spanned<&str>, of: NumberedName, diagnostics: &mut Diagnostics) {
    let has_number = |placeholder: &Placeholder| match of {
        NumberedName::Parameter => !placeholder.is_of_entry(),
        NumberedName::MappedEntry => true,
    };
    let (range, message) = match NamePattern::parse(text.value) {
        Err(error) => (error.range, error.message),
        Ok(pattern) => match pattern.placeholders().find(|(placeholder, _)| !has_number(placeholder)) {
            None => return,
            Some((placeholder, range)) => {
                (range, format!("`{{{}}}` is a number that only mapped entries have", placeholder.text()))
            }
        },
    };
    let plain =
        Placeholder::all().filter(has_number).filter(|placeholder| !placeholder.text().contains([':', '-']));
    let words: Vec<String> = plain.map(|placeholder| format!("`{{{}}}`", placeholder.text())).collect();
    diagnostics.push(
        Diagnostic::new(codes::BAD_NOTATION, inside(text, &range), format!("cannot read this name: {message}"))
            .help(format!(
                "placeholders are {}; `{{pdo-1}}` counts from 0, `{{pdo:X}}` is hexadecimal; a brace of the name is doubled",
                words.join(", ")
            )),
    );
}

fn unknown_word(text: Spanned<&str>, words: &[&str], diagnostics: &mut Diagnostics) {
    let list = words.iter().map(|word| format!("`{word}`")).collect::<Vec<_>>().join(", ");
    let diagnostic = Diagnostic::new(
        codes::UNKNOWN_WORD,
        text.span,
        format!("found `{}`, expected one of {list}", shorten(text.value)),
    );
    let meant = diagnostics.suggestions.nearest(text.value, words.iter().copied());
    diagnostics.push(match meant {
        Some(word) => diagnostic.did_you_mean(word),
        None => diagnostic.help(format!("write one of {list}")),
    });
}

/// A text in backticks; an empty one in words.
fn quoted(text: &str) -> String {
    if text.trim().is_empty() { "an empty text".to_owned() } else { format!("`{}`", shorten(text)) }
}

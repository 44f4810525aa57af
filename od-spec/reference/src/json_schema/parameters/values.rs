//! What the values of an entry look like to an editor.

use super::Members;
use crate::json_schema::{Json, any_integer, any_of, object, one_field, text, texts, yes_no};
use od_spec::model::{
    BitField, Dictionary, Entry, EntryId, EnumValues, Family, Index, Object, Storage, TypeKind, Unit,
};
use od_spec::wording::{Notation, Wording, allowed};

const WORDING: Wording = Wording::english(Notation::Diagnostic);
/// The object whose entries may be written as `{node: 5, time: 3000 ms}`.
const CONSUMERS: Index = Index(0x1016);

/// Whether a value of the entry can be written down at all.
pub(super) fn has_values(entry: &Entry) -> bool {
    !matches!(entry.data_type.family(), Family::Time | Family::Domain)
}

/// The values of an entry, and what an editor shows about it.
pub(super) fn entry(id: EntryId, of: &Object, entry: &Entry, device: &Dictionary, language: &str) -> Json {
    let mut ways = values(entry);
    if of.index == CONSUMERS && id.sub.0 > 0 {
        ways.push(consumer());
    }
    object([("description", text(about(id, entry, device, language))), ("anyOf", Json::List(ways))])
}

/// Index, name, unit, range, default and meaning, in a few lines.
fn about(id: EntryId, entry: &Entry, device: &Dictionary, language: &str) -> String {
    let mut facts = vec![format!("{id} {}", device.entry_name(id).unwrap_or_default())];
    if let Some(unit) = &entry.unit {
        facts.push(format!("unit {}", WORDING.step(unit)));
    }
    if entry.is_limited() {
        facts.push(allowed(entry));
    }
    facts.extend(entry.special.iter().map(|special| WORDING.special(entry, special)));
    if let Some(default) = &entry.default {
        facts.push(format!("default {}", WORDING.value(Some(id.index), entry, default)));
    }
    if entry.stored != Storage::No {
        facts.push(WORDING.storage(entry.stored).to_owned());
    }
    let mut lines = vec![facts.join("; ")];
    if entry.locked {
        lines.push(
            "LOCKED: factory data, which the device takes only while it is unlocked for service".to_owned(),
        );
    }
    lines.extend(entry.warning.get(language).map(|warning| format!("Warning: {warning}")));
    lines.extend(entry.about.get(language).map(ToOwned::to_owned));
    lines.extend(meanings(entry));
    lines.join("\n")
}

/// The values of an enum and the bits of a bit field, a line each.
fn meanings(entry: &Entry) -> Vec<String> {
    match entry.named_type.as_ref().map(|named| &named.kind) {
        Some(TypeKind::Enum(values)) => values
            .iter()
            .map(|value| {
                let support = if value.supported { "" } else { " (not supported)" };
                format!("{}: {}{support}", WORDING.enum_number(entry.data_type, value.value), value.name)
            })
            .collect(),
        Some(TypeKind::Bits(fields)) => fields
            .iter()
            .filter(|field| !field.name.is_empty())
            .map(|field| match (field.first, field.last) {
                (first, last) if first == last => format!("bit {first}: {}", field.name),
                (first, last) => format!("bits {first}..{last}: {}", field.name),
            })
            .collect(),
        None => Vec::new(),
    }
}

/// The ways to write a value.
fn values(entry: &Entry) -> Vec<Json> {
    match (entry.data_type.family(), entry.named_type.as_ref().map(|named| &named.kind)) {
        (Family::Boolean, _) => vec![object([("enum", yes_no())]), object([("enum", numbers([0, 1]))])],
        (Family::Signed | Family::Unsigned, Some(TypeKind::Enum(values))) if !values.is_empty() => {
            enumerated(entry, values)
        }
        (Family::Signed | Family::Unsigned, named) => {
            let mut ways = integers(entry);
            if let Some(TypeKind::Bits(fields)) = named {
                ways.push(bits(fields));
            }
            ways
        }
        (Family::Real, _) => {
            let number =
                format!("^-?[0-9]+(\\.[0-9]+)?([eE][-+]?[0-9]+)?{}$", symbols(entry.unit.as_deref(), "?"));
            vec![object([("type", text("number"))]), pattern(&["string"], number)]
        }
        (Family::VisibleString, _) => {
            vec![limited(entry, pattern(&["string", "number", "boolean"], "^[ -~]*$".to_owned()))]
        }
        (Family::OctetString, _) => {
            vec![pattern(&["string", "integer"], "^ *([0-9A-Fa-f]{2} *)*$".to_owned())]
        }
        (Family::UnicodeString | Family::Time | Family::Domain, _) => {
            vec![object([("type", texts(["string", "number", "boolean"]))])]
        }
    }
}

fn numbers(numbers: impl IntoIterator<Item = i128>) -> Json {
    Json::List(numbers.into_iter().map(Json::Number).collect())
}

fn pattern(types: &[&str], pattern: String) -> Json {
    object([("type", texts(types.iter().copied())), ("pattern", text(pattern))])
}

/// At most so many characters.
fn limited(entry: &Entry, schema: Json) -> Json {
    match (schema, entry.capacity) {
        (Json::Object(mut members), Some(capacity)) => {
            members.push(("maxLength".to_owned(), Json::Number(i128::from(capacity))));
            Json::Object(members)
        }
        (schema, _) => schema,
    }
}

fn enumerated(entry: &Entry, values: &EnumValues) -> Vec<Json> {
    let names = values.iter().map(|value| value.name.as_str());
    let raw = values.iter().map(|value| value.value);
    let special = entry.special.iter().map(|special| special.value);
    vec![
        object([("enum", texts(names))]),
        object([("enum", numbers(raw.chain(special)))]),
        pattern(&["string"], format!("^{}$", any_integer())),
    ]
}

/// Raw numbers within the limits, special ones, numbers that YAML gives as text, physical values, and formulas.
fn integers(entry: &Entry) -> Vec<Json> {
    let (lowest, highest) = entry.data_type.range().unwrap_or((i128::MIN, i128::MAX));
    let mut ways = vec![object([
        ("type", text("integer")),
        ("minimum", Json::Number(entry.low.unwrap_or(lowest))),
        ("maximum", Json::Number(entry.high.unwrap_or(highest))),
    ])];
    if !entry.special.is_empty() {
        ways.push(object([("enum", numbers(entry.special.iter().map(|special| special.value)))]));
    }
    ways.push(pattern(&["string"], format!("^({}|\\$NODEID( *\\+ *[0-9A-Fa-fxX_]+)?)$", any_integer())));
    if let Some(unit) = entry.unit.as_deref() {
        ways.push(pattern(&["string"], format!("^-?[0-9]+(\\.[0-9]+)?{}$", symbols(Some(unit), ""))));
    }
    ways
}

/// A regular expression for what may follow a number.
fn symbols(unit: Option<&Unit>, times: &str) -> String {
    let Some(unit) = unit else { return String::new() };
    let mut symbols = vec![escaped(&unit.symbol)];
    if unit.base_symbol() != unit.symbol {
        symbols.push(escaped(unit.base_symbol()));
    }
    format!("( *({})){times}", symbols.join("|"))
}

/// A text as a regular expression for itself.
fn escaped(text: &str) -> String {
    let escape = |c: char| if "\\^$.|?*+()[]{}/".contains(c) { format!("\\{c}") } else { c.to_string() };
    text.chars().map(escape).collect()
}

/// The bits that are 1, runs of bits with their values.
fn bits(fields: &[BitField]) -> Json {
    let names = |field: &BitField| {
        let in_modes = field.modes.iter().map(|mode| mode.name.clone());
        std::iter::once(field.name.clone())
            .chain(in_modes)
            .filter(|name| !name.is_empty())
            .collect::<Vec<_>>()
    };
    let single: Vec<String> =
        fields.iter().filter(|field| field.first == field.last).flat_map(names).collect();
    let with_value = fields.iter().flat_map(|field| {
        names(field).into_iter().map(move |name| {
            let words = field.values.iter().map(|value| text(value.name.clone()));
            let highest = (1 << (field.last - field.first + 1)) - 1;
            let mut ways = vec![object([
                ("type", text("integer")),
                ("minimum", Json::Number(0)),
                ("maximum", Json::Number(highest)),
            ])];
            if field.first == field.last {
                ways.push(object([("enum", yes_no())]));
            }
            if !field.values.is_empty() {
                ways.push(object([("enum", Json::List(words.collect()))]));
            }
            (name, any_of(ways))
        })
    });
    let Json::Object(mut one) = one_field(Json::Bool(false)) else { return object([]) };
    let mut properties = Members::default();
    with_value.for_each(|(name, schema)| properties.add(name, schema));
    one.insert(1, ("properties".to_owned(), Json::Object(properties.list)));
    let items = any_of([object([("enum", texts(single.iter().map(String::as_str)))]), Json::Object(one)]);
    object([("type", text("array")), ("items", items)])
}

/// `{node: 5, time: 3000 ms}`.
fn consumer() -> Json {
    let node =
        object([("type", text("integer")), ("minimum", Json::Number(1)), ("maximum", Json::Number(127))]);
    let time = any_of([
        object([("type", text("integer")), ("minimum", Json::Number(0)), ("maximum", Json::Number(0xFFFF))]),
        pattern(&["string"], "^[0-9]+(\\.[0-9]+)? *(s|ms|us|µs)$".to_owned()),
    ]);
    object([
        ("type", text("object")),
        ("properties", object([("node", node), ("time", time)])),
        ("required", texts(["node", "time"])),
        ("additionalProperties", Json::Bool(false)),
    ])
}

//! The JSON Schema that lets editors complete, explain and check a specification while it is typed.
//!
//! It is draft-07: VS Code's YAML extension (and everything built on its language server) checks values by that
//! draft only and does not know the keywords that came later. The schema needs none of those. Its one drawback
//! is that a validator ignores what is next to `$ref`; here that is always a description, which editors show
//! all the same.
//!
//! An editor does not see scalars as text, as the compiler does, but as YAML 1.2 types them: `0x6040` is the
//! number 24640, as a value and as a key, where it becomes the text `24640`; an editor with a reader of its own
//! may give `0x6040`. So numbers are accepted as numbers and as text in every notation of the language, and
//! texts also as the numbers and booleans for which YAML may take them. What the schema cannot see remains the
//! compiler's: whether names are known, whether values fit their types, and the ranges of numbers written as text.

mod parameters;
mod plants;

use serde::{Serialize, Serializer};

use od_spec::keys::{
    CHANNELS, Choice, Key, KeyKind, Keys, Need, NumberedName, PART, PLANT, SPEC, Shape, VERSION,
};
use od_spec::model::{Access, DataType};

pub use parameters::parameter_schema;
pub use plants::{plant_schema, plant_schema_of};

/// Prints the JSON Schema of specifications and libraries.
pub fn json_schema() -> String {
    let mut root = vec![
        ("$schema", text("http://json-schema.org/draft-07/schema#")),
        ("title", text("CANopen object dictionary specification (*.od.yaml)")),
    ];
    root.extend(file());
    let tables = reachable().into_iter().filter(|keys| !FILES.map(|file| file.name).contains(&keys.name));
    let tables = tables.map(|keys| (slug(keys.name), object(members(keys))));
    let scalars = SCALARS.iter().filter_map(|shape| Some((definition(*shape)?.to_owned(), scalar(*shape))));
    root.push(("definitions", Json::Object(tables.chain(scalars).collect())));
    printed(root)
}

/// A schema as a file.
fn printed(root: Vec<(&str, Json)>) -> String {
    // Maps with text keys and plain values, into memory: this cannot fail.
    serde_json::to_string_pretty(&object(root)).unwrap_or_default() + "\n"
}

/// What the top level of a file is.
const FILES: [&Keys; 2] = [&SPEC, &PART];

/// The members of the schema of a file. One schema serves both kinds of files, as editors choose it by the file's name.
fn file() -> Vec<(&'static str, Json)> {
    let mut members = members(&SPEC);
    let only_part = |key: &&Key| SPEC.keys.iter().all(|known| known.name != key.name);
    let of_part = PART.keys.iter().filter(only_part).map(|key| (key.name.to_owned(), property(key)));
    for (name, member) in &mut members {
        match (*name, member) {
            ("properties", Json::Object(properties)) => {
                properties.splice(1..1, of_part.clone()).for_each(drop);
            }
            ("required", member) => {
                let of_file = |keys| object([("required", required(keys))]);
                (*name, *member) = ("anyOf", Json::List(FILES.map(of_file).into()));
            }
            _ => {}
        }
    }
    members
}

/// All key tables of specifications, in the order in which a reader of a file meets them.
pub(crate) fn reachable() -> Vec<&'static Keys> {
    reachable_from(FILES.to_vec())
}

/// All key tables of plant files.
pub(crate) fn reachable_in_plants() -> Vec<&'static Keys> {
    reachable_from(vec![&PLANT])
}

fn reachable_from(mut found: Vec<&'static Keys>) -> Vec<&'static Keys> {
    let mut at = 0;
    while let Some(keys) = found.get(at) {
        for key in keys.keys {
            collect(key.shape, &mut found);
        }
        at += 1;
    }
    found
}

fn collect(shape: Shape, found: &mut Vec<&'static Keys>) {
    match shape {
        Shape::Map(keys) | Shape::ShortOr(_, keys) if found.iter().all(|known| known.name != keys.name) => {
            found.push(keys);
        }
        Shape::MapOf(_, inner) | Shape::List(inner) | Shape::OneOrMore(inner) => collect(*inner, found),
        _ => {}
    }
}

/// A table's name without its article, as an anchor: `an entry's EDS policy` → `entrys-eds-policy`.
pub(crate) fn slug(name: &str) -> String {
    title(name).to_lowercase().replace(' ', "-").replace('\'', "")
}

/// A table's name without its article.
pub(crate) fn title(name: &str) -> &str {
    name.strip_prefix("a ").or_else(|| name.strip_prefix("an ")).unwrap_or(name)
}

/// A JSON value that is written, never read.
enum Json {
    Bool(bool),
    Number(i128),
    Text(String),
    List(Vec<Json>),
    Object(Vec<(String, Json)>),
}

/// In the order of the members, which the values of `serde_json` do not keep.
impl Serialize for Json {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Json::Bool(value) => serializer.serialize_bool(*value),
            Json::Number(value) => serializer.serialize_i128(*value),
            Json::Text(value) => serializer.serialize_str(value),
            Json::List(items) => serializer.collect_seq(items),
            Json::Object(members) => {
                serializer.collect_map(members.iter().map(|(name, value)| (name, value)))
            }
        }
    }
}

fn text(value: impl Into<String>) -> Json {
    Json::Text(value.into())
}

fn texts<'a>(values: impl IntoIterator<Item = &'a str>) -> Json {
    Json::List(values.into_iter().map(text).collect())
}

fn object<'a>(members: impl IntoIterator<Item = (&'a str, Json)>) -> Json {
    Json::Object(members.into_iter().map(|(name, value)| (name.to_owned(), value)).collect())
}

fn reference(definition: &str) -> Json {
    object([("$ref", text(format!("#/definitions/{definition}")))])
}

/// The members of the schema of a map with fixed keys.
fn members(keys: &Keys) -> Vec<(&'static str, Json)> {
    let properties = keys.keys.iter().map(|key| (key.name, property(key)));
    let mut members = vec![("type", text("object")), ("properties", object(properties))];
    if keys.keys.iter().any(is_required) {
        members.push(("required", required(keys)));
    }
    let choices: Vec<Json> = keys.choices.iter().filter_map(|choice| depend(*choice)).collect();
    if !choices.is_empty() {
        members.push(("allOf", Json::List(choices)));
    }
    members.push(("additionalProperties", Json::Bool(false)));
    members
}

fn is_required(key: &Key) -> bool {
    key.need == Need::Required
}

fn required(keys: &Keys) -> Json {
    texts(keys.keys.iter().filter(|key| is_required(key)).map(|key| key.name))
}

/// Keys that depend on each other. Editors name the first of the keys that may be missing, which says little where there are
/// many; what may be inherited, only the compiler sees.
fn depend(choice: Choice) -> Option<Json> {
    const FEW: usize = 4;
    let each = |keys: &[&'static str]| {
        Json::List(keys.iter().map(|key| object([("required", texts([*key]))])).collect())
    };
    match choice {
        Choice::One(keys) if keys.len() <= FEW => Some(object([("oneOf", each(keys))])),
        Choice::Any(keys) if keys.len() <= FEW => Some(object([("anyOf", each(keys))])),
        Choice::One(_) | Choice::Any(_) | Choice::AnyInherited(_) => None,
        Choice::Together(keys) => {
            let others =
                |key: &&'static str| (*key, texts(keys.iter().copied().filter(|other| other != key)));
            Some(object([("dependencies", object(keys.iter().map(others)))]))
        }
    }
}

/// The schema of a key's value, with what editors show about the key.
fn property(key: &Key) -> Json {
    let mut members = vec![("description".to_owned(), text(key.about))];
    // Examples are pieces of YAML; those of single values are JSON texts as well.
    if let (Some(example), Some(_)) = (key.example, definition(key.shape)) {
        members.push(("examples".to_owned(), texts([example.trim_matches('"')])));
    }
    if let Json::Object(of_value) = schema(key.shape) {
        members.extend(of_value);
    }
    Json::Object(members)
}

fn schema(shape: Shape) -> Json {
    match shape {
        Shape::Choice(words) => object([("enum", texts(words.iter().copied()))]),
        Shape::Integer(low, high) => integer(Some((low, high))),
        Shape::Version => integer(Some((VERSION, VERSION))),
        Shape::Map(keys) => reference(&slug(keys.name)),
        Shape::MapOf(kind, value) => map_of(kind, *value),
        Shape::List(item) => list(*item),
        Shape::OneOrMore(item) => any_of([schema(*item), at_least_one(*item)]),
        Shape::ShortOr(short, keys) => any_of([schema(*short), reference(&slug(keys.name))]),
        Shape::Feature => any_of([schema(Shape::Text), one_field(integer(Some((1, CHANNELS))))]),
        _ => reference(definition(shape).unwrap_or(TEXT)),
    }
}

fn any_of(schemas: impl Into<Vec<Json>>) -> Json {
    object([("anyOf", Json::List(schemas.into()))])
}

fn list(item: Shape) -> Json {
    object([("type", text("array")), ("items", schema(item))])
}

fn at_least_one(item: Shape) -> Json {
    object([("type", text("array")), ("items", schema(item)), ("minItems", Json::Number(1))])
}

/// An empty value represents an empty map: a section whose entries were all commented out holds nothing.
fn map_of(kind: KeyKind, value: Shape) -> Json {
    let type_of = ("type", texts(["object", "null"]));
    match key_pattern(kind) {
        Some(pattern) => object([
            type_of,
            ("patternProperties", Json::Object(vec![(format!("^{pattern}$"), schema(value))])),
            ("additionalProperties", Json::Bool(false)),
        ]),
        None => object([type_of, ("additionalProperties", schema(value))]),
    }
}

/// A name that may name folders and files.
const PLACE: &str = "[A-Za-z0-9][A-Za-z0-9_-]{0,31}";

/// A regular expression for the keys of a map; `None` where every key is right.
fn key_pattern(kind: KeyKind) -> Option<String> {
    let run = |number: &str| format!(" *{number} *(\\.\\. *{number} *)?");
    Some(match kind {
        KeyKind::Name | KeyKind::Device => return None,
        KeyKind::DeviceKey => "[a-z0-9][a-z0-9-]{0,31}".to_owned(),
        KeyKind::Place => PLACE.to_owned(),
        KeyKind::Machines => format!("({PLACE}| *[0-9]+ *\\.\\. *[0-9]+ *)"),
        KeyKind::Language => "[A-Za-z0-9-]{2,}".to_owned(),
        KeyKind::Indices => run(&unsigned(4, 5)),
        KeyKind::SubIndex | KeyKind::Number => unsigned(2, 3),
        KeyKind::SubIndices => run(&unsigned(2, 3)),
        KeyKind::PdoNumber => unsigned(3, 3),
        KeyKind::Integer => any_integer(),
        KeyKind::Bits => run(&unsigned(2, 2)),
        KeyKind::ErrorCodes => run(&unsigned(4, 5)),
    })
}

/// A regular expression for a number that is not negative and has at most so many digits.
fn unsigned(hexadecimal: usize, decimal: usize) -> String {
    let (hexadecimal, decimal) = (hexadecimal - 1, decimal - 1);
    format!(
        "\\+?(0[xX](0_*)*[0-9A-Fa-f](_*[0-9A-Fa-f]){{0,{hexadecimal}}}|{BINARY}|{OCTAL}|0|[1-9](_*[0-9]){{0,{decimal}}})"
    )
}

/// A regular expression for an integer in any notation of the language.
fn any_integer() -> String {
    format!("[-+]?(0[xX][0-9A-Fa-f](_*[0-9A-Fa-f])*|{BINARY}|{OCTAL}|0|[1-9](_*[0-9])*)")
}

/// `pattern` is for integers that YAML gives as text, the range for the others.
fn integer(range: Option<(i128, i128)>) -> Json {
    let mut members = vec![("type", texts(["integer", "string"]))];
    if let Some((low, high)) = range {
        members.extend([("minimum", Json::Number(low)), ("maximum", Json::Number(high))]);
    }
    members.push(("pattern", text(format!("^{}$", any_integer()))));
    object(members)
}

/// The shapes of single values that have a definition of their own.
const SCALARS: &[Shape] = &[
    Shape::Text,
    Shape::HeaderText,
    Shape::Words,
    Shape::YesNo,
    Shape::Date,
    Shape::DateTime,
    Shape::Index,
    Shape::ErrorCode,
    Shape::Entry,
    Shape::Entries,
    Shape::Access,
    Shape::Type,
    Shape::Value,
    Shape::Default,
    Shape::Ratio,
    Shape::SignedRatio,
    Shape::Base,
    Shape::Time,
    Shape::Numbers,
    Shape::Condition,
    Shape::Formula,
    Shape::Pattern,
    Shape::NumberedName(NumberedName::Parameter),
    Shape::NumberedName(NumberedName::MappedEntry),
];

/// The name of the definition of [`Shape::Text`].
const TEXT: &str = "text";

/// The name of a shape's definition, if it has one.
const fn definition(shape: Shape) -> Option<&'static str> {
    Some(match shape {
        Shape::Text | Shape::NameOf(_) => TEXT,
        Shape::HeaderText => "header-text",
        Shape::Words => "words",
        Shape::YesNo => "yes-or-no",
        Shape::Date => "date",
        Shape::DateTime => "date-and-time",
        Shape::Index => "index",
        Shape::ErrorCode => "code-of-an-error",
        Shape::Entry => "entry-reference",
        Shape::Entries => "entry-references",
        Shape::Access => "access",
        Shape::Type => "type-name",
        Shape::Value => "value",
        Shape::Default | Shape::Setting => "default-value",
        Shape::Ratio => "fraction",
        Shape::SignedRatio => "signed-fraction",
        Shape::Base => "fraction-and-symbol",
        Shape::Time => "time",
        Shape::Numbers => "numbers",
        Shape::Condition => "condition",
        Shape::Formula => "formula",
        Shape::Pattern => "bit-pattern",
        Shape::NumberedName(NumberedName::Parameter) => "numbered-name",
        Shape::NumberedName(NumberedName::MappedEntry) => "mapped-entry-name",
        Shape::Choice(_)
        | Shape::Integer(..)
        | Shape::Version
        | Shape::Map(_)
        | Shape::MapOf(..)
        | Shape::List(_)
        | Shape::OneOrMore(_)
        | Shape::ShortOr(..)
        | Shape::Feature => return None,
    })
}

const BINARY: &str = "0[bB][01](_*[01])*";
const OCTAL: &str = "0[oO][0-7](_*[0-7])*";
const DECIMAL: &str = "-?[0-9]+(\\.[0-9]+)?";
const DAY: &str = "[0-9]{4}-(0[1-9]|1[0-2])-(0[1-9]|[12][0-9]|3[01])";

fn scalar(shape: Shape) -> Json {
    let any_text = || object([("type", texts(["string", "number", "boolean"]))]);
    let pattern = |types: &[&str], pattern: String| {
        object([("type", texts(types.iter().copied())), ("pattern", text(pattern))])
    };
    match shape {
        Shape::Text => pattern(&["string", "number", "boolean"], "\\S".to_owned()),
        Shape::HeaderText => any_text(),
        Shape::Words => any_of([any_text(), map_of(KeyKind::Language, Shape::Value)]),
        Shape::YesNo => object([("enum", yes_no())]),
        Shape::Date => pattern(&["string"], format!("^{DAY}$")),
        Shape::DateTime => pattern(&["string"], format!("^{DAY}[ T]([01][0-9]|2[0-3]):[0-5][0-9]$")),
        Shape::Index => integer(Some((1, 0xFFFF))),
        Shape::ErrorCode => integer(Some((0, 0xFFFF))),
        // A text that starts with `0x` is an index and maybe a sub-index, any other may be a name.
        Shape::Entry => pattern(
            &["string", "number", "boolean"],
            format!("^({}(\\.{})?$|(?!0[xX]))", unsigned(4, 5), unsigned(2, 3)),
        ),
        Shape::Default => any_of([
            any_text(),
            list(Shape::Default),
            object([("type", text("object")), ("additionalProperties", schema(Shape::Default))]),
        ]),
        Shape::Entries => {
            let sub = unsigned(2, 3);
            pattern(
                &["string", "number", "boolean"],
                format!("^({}(\\.{sub}( *\\.\\. *{sub})?)?$|(?!0[xX]))", unsigned(4, 5)),
            )
        }
        Shape::Access => any_of([
            object([("enum", texts(access_words().iter().map(String::as_str)))]),
            pattern(&["string"], format!("^({})\\s* locked$", writable_words().join("|"))),
        ]),
        Shape::Type => any_of([object([("enum", texts(DataType::ALL.map(DataType::name)))]), any_text()]),
        Shape::Ratio => object([
            ("type", texts(["number", "string"])),
            ("exclusiveMinimum", Json::Number(0)),
            ("pattern", text(format!("^{DECIMAL}(\\s*/\\s*{DECIMAL})?$"))),
        ]),
        Shape::SignedRatio => pattern(&["number", "string"], format!("^{DECIMAL}(\\s*/\\s*{DECIMAL})?$")),
        Shape::Base => pattern(&["string"], format!("^{DECIMAL}(/{DECIMAL})? +\\S")),
        Shape::Time => any_of([
            integer(Some((0, 0xFFFF))),
            pattern(&["string"], "^[0-9]+(\\.[0-9]+)?\\s*(s|ms|us|µs)$".to_owned()),
        ]),
        Shape::Numbers => any_of([
            integer(Some((0, 0xFF))),
            pattern(&["string"], format!("^ *{0} *\\.\\. *{0} *$", unsigned(2, 3))),
        ]),
        Shape::Condition => pattern(&["string"], "[<=>]".to_owned()),
        Shape::Formula => pattern(&["string", "number"], "^[^<=>]+$".to_owned()),
        Shape::Pattern => pattern(&["string", "integer"], "^[01xrf\\s]+$".to_owned()),
        Shape::NumberedName(of) => pattern(&["string", "number", "boolean"], numbered_name(of)),
        _ => any_text(),
    }
}

/// A map with one key, whatever that is.
fn one_field(value: Json) -> Json {
    object([
        ("type", text("object")),
        ("additionalProperties", value),
        ("minProperties", Json::Number(1)),
        ("maxProperties", Json::Number(1)),
    ])
}

/// A regular expression for names with placeholders.
fn numbered_name(of: NumberedName) -> String {
    let counted = match of {
        NumberedName::Parameter => "pdo",
        NumberedName::MappedEntry => "(pdo|n)",
    };
    format!(
        "^\\s*([^{{}}\\s]|\\{{\\{{|\\}}\\}}|\\{{(index|{counted}(-1)?(:[xX])?)\\}})([^{{}}]|\\{{\\{{|\\}}\\}}|\\{{(index|{counted}(-1)?(:[xX])?)\\}})*$"
    )
}

fn yes_no() -> Json {
    let words = ["yes", "no", "true", "false"].map(text);
    Json::List([true, false].map(Json::Bool).into_iter().chain(words).collect())
}

fn writable_words() -> Vec<&'static str> {
    let writable = |word: &&&str| Access::from_word(word).is_some_and(Access::is_writable);
    Access::WORDS.iter().filter(writable).copied().collect()
}

/// Every access right; those that allow writing also with `locked`.
fn access_words() -> Vec<String> {
    let plain = Access::WORDS.iter().map(|word| (*word).to_owned());
    plain.chain(writable_words().into_iter().map(|word| format!("{word} locked"))).collect()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn definitions_have_names_of_their_own() {
        let tables = reachable();
        let names: BTreeSet<String> = tables.iter().map(|keys| slug(keys.name)).collect();
        let scalars: BTreeSet<&str> = SCALARS.iter().filter_map(|shape| definition(*shape)).collect();
        assert_eq!((names.len(), scalars.len()), (tables.len(), SCALARS.len()));
        assert!(scalars.iter().all(|name| !names.contains(*name)));
        assert!(names.contains("entrys-eds-policy"));
    }
}

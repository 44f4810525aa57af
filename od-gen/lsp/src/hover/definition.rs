//! What something is that has a name of its own: units, types, devices and so on.

use std::fmt::Write as _;

use od_spec::model::{
    BitField, BitUsage, DataType, Devices, ErrorCode, Fact, NamedType, Text, TypeKind, Unit,
};
use od_spec::names::{Definition, Kind};
use od_spec::scalar;
use od_spec::yaml::Node;

use super::{Words, code, escaped};
use crate::cursor::Cursor;

/// Most values and bits of a type that are shown.
const SHOWN: usize = 24;

/// What is defined: its kind, its name and its facts.
pub(super) fn of(cursor: &Cursor<'_>, one: &Definition, words: Words<'_>) -> String {
    let system = cursor.snapshot.system();
    let title = format!("{} **{}**", one.kind.word(), escaped(&one.name));
    let facts = match one.kind {
        Kind::Unit => system.and_then(|system| system.units.get(&one.name)).map(|unit| of_unit(unit, words)),
        Kind::Type => {
            let named = system.and_then(|system| system.types.get(&one.name));
            named.map(|named| {
                let about = paragraph(words, &named.about);
                format!("{}{}{about}", named.base, type_members(named, words))
            })
        }
        Kind::Value | Kind::Bit => {
            let owner = one.owner.map(|owner| cursor.names.definition(owner));
            let number = cursor.snapshot.now.sources.text(one.key);
            owner.map(|owner| format!("{} {}, {number}", owner.kind.word(), code(&owner.name)))
        }
        Kind::Device => system
            .and_then(|system| system.device(&one.name))
            .map(|device| format!("{}{}", escaped(&device.name), paragraph(words, &device.about))),
        Kind::Error => {
            let code = cursor.snapshot.now.sources.text(one.key).split("..").next().map(str::trim);
            let number = code.and_then(|code| scalar::integer(code).ok());
            let errors = system.map(|system| system.errors.as_slice()).unwrap_or_default();
            let error = errors.iter().find(|error| number == Some(i128::from(error.code)));
            error.map(|error| of_error(error, words))
        }
        Kind::Constraint => {
            let constraints = system.map(|system| system.constraints.as_slice()).unwrap_or_default();
            let found = constraints.iter().find(|constraint| {
                constraint.name == one.name
                    || constraint.series.as_ref().is_some_and(|series| series.name == one.name)
            });
            found.map(|found| {
                let when = found.when.as_ref().map(|when| format!(" ({})", code(&when.text)));
                let about = paragraph(words, &found.about);
                format!("{}{}{about}", code(&found.require.text), when.unwrap_or_default())
            })
        }
        Kind::Pdo => system.and_then(|system| {
            let index = one.indices?.0;
            let device = system.device(one.devices.as_ref()?.first()?)?;
            let pdo = device.pdos.iter().find(|pdo| pdo.communication_index() == index.0)?;
            let id = pdo.cob_id.as_ref().map(|id| words.wording.can_id(id)).unwrap_or_default();
            let fields = pdo.fields().map(|field| {
                let target = words.wording.mapping_parameter(field.mapped.parameter());
                let name = match field.mapped.target {
                    od_spec::model::PdoTarget::Entry(id) => device.entry_name(id).unwrap_or_default(),
                    od_spec::model::PdoTarget::Dummy(data_type) => data_type.name().to_owned(),
                };
                format!(
                    "\n- byte {}, bit {}: {} {}",
                    field.byte(),
                    field.bit(),
                    code(&target),
                    escaped(&name)
                )
            });
            let about = paragraph(words, &pdo.about);
            let (name, number) = (pdo.direction.pdo(), pdo.number);
            Some(format!("{name} {number}, {id}{}{about}", fields.collect::<String>()))
        }),
        Kind::File
        | Kind::Library
        | Kind::Feature
        | Kind::Object
        | Kind::Entry
        | Kind::Machine
        | Kind::State
        | Kind::Transition
        | Kind::Command
        | Kind::Block
        | Kind::Mark => None,
    };
    let facts = facts.or_else(|| as_written(cursor, one));
    match facts {
        Some(facts) => format!("{title}\n\n{facts}"),
        None => title,
    }
}

fn of_unit(unit: &Unit, words: Words<'_>) -> String {
    let base =
        unit.base.as_ref().map(|base| format!(", 1 {} = {} {}", unit.symbol, base.factor, base.symbol));
    let formula = unit.formula.as_ref().map(|formula| format!(", {}", code(&formula.text)));
    format!(
        "{}{}{}{}",
        escaped(&words.wording.counted_step(unit)),
        escaped(&base.unwrap_or_default()),
        formula.unwrap_or_default(),
        paragraph(words, &unit.about)
    )
}

fn of_error(error: &ErrorCode, words: Words<'_>) -> String {
    let mut text = format!("{} {}", code(&format!("{:04X}h", error.code)), escaped(&error.name));
    if let Devices::Only(devices) = &error.devices {
        let _ = write!(text, " ({})", escaped(&devices.join(", ")));
    }
    let facts = [
        (Fact::Priority, error.priority.as_deref().map(escaped)),
        (Fact::Reaction, words.text(&error.reaction)),
        (Fact::OptionCode, error.option_code.map(|id| code(&id.to_string()))),
        (Fact::Reset, words.text(&error.reset)),
    ];
    for (fact, said) in facts {
        if let Some(said) = said {
            let _ = write!(text, "\n- {}: {said}", words.wording.fact(fact));
        }
    }
    text + &paragraph(words, &error.about)
}

/// The values or bits of a type, a line each.
pub(super) fn type_members(named: &NamedType, words: Words<'_>) -> String {
    let lines: Vec<String> = match &named.kind {
        TypeKind::Enum(values) => {
            let number = |raw| words.wording.enum_number(named.base, raw);
            values.iter().map(|value| format!("{}: {}", number(value.value), escaped(&value.name))).collect()
        }
        TypeKind::Bits(fields) => {
            let used = fields.iter().filter(|field| field.usage == BitUsage::Used);
            used.map(|field| format!("{}: {}", bits(field), escaped(&name_of(field)))).collect()
        }
    };
    let more = if lines.len() > SHOWN { "\n  - …" } else { "" };
    let mut list = String::new();
    for line in lines.iter().take(SHOWN) {
        list.push_str("\n  - ");
        list.push_str(line);
    }
    list + more
}

/// `3`, `4..6`.
fn bits(field: &BitField) -> String {
    if field.first == field.last {
        field.first.to_string()
    } else {
        format!("{}..{}", field.first, field.last)
    }
}

/// The name of bits, or what they are in modes of operation.
fn name_of(field: &BitField) -> String {
    if !field.name.is_empty() || field.modes.is_empty() {
        return field.name.clone();
    }
    let modes = field.modes.iter().map(|mode| format!("{} ({})", mode.name, mode.mode.value));
    modes.collect::<Vec<_>>().join(", ")
}

/// A data type of CiA 301.
pub(super) fn of_data_type(name: &str) -> Option<String> {
    let data_type = DataType::from_name(name.trim_matches(['"', '\'']))?;
    let mut text = format!("**{data_type}** ({:04X}h)", data_type.code());
    if let Some(bits) = data_type.bits() {
        let _ = write!(text, ", {bits} bit");
    }
    if let Some((low, high)) = data_type.range() {
        let _ = write!(text, ", {low} to {high}");
    }
    Some(text)
}

fn paragraph(words: Words<'_>, about: &Text) -> String {
    words.text(about).map(|about| format!("\n\n{about}")).unwrap_or_default()
}

/// What the text says of something that the model has not: its `about`, or what is written there.
fn as_written(cursor: &Cursor<'_>, one: &Definition) -> Option<String> {
    let tree = cursor.snapshot.now.outline(one.key.file)?;
    let node = value_at(tree, one)?;
    let about = ["about", "event", "title"].into_iter().find_map(|key| node.get(key));
    let about = about.and_then(|about| about.text().or_else(|| about.entries().first()?.1.text()));
    about.map(|about| escaped(about.value))
}

/// The value of the key that a definition has.
fn value_at<'t>(node: &'t Node, one: &Definition) -> Option<&'t Node> {
    let pairs = node.entries().iter();
    let inner = |value: &Node| value.span.start <= one.key.start && one.key.end <= value.span.end;
    for (name, value) in pairs {
        if name.span == one.key {
            return Some(value);
        }
        if inner(value) {
            return value_at(value, one);
        }
    }
    node.items().iter().find(|item| inner(item)).and_then(|item| value_at(item, one))
}

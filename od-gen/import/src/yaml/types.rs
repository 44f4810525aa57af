//! Units and types of the file's own.

use std::collections::BTreeSet;

use od_spec::model::{BitField, BitUsage, EnumValue, NamedType, Ratio, TypeKind, Unit};

use super::context::Context;
use super::node::{Item, Node};
use super::scalar::spelled;
use super::texts::{described, named, one_or_more, search};

/// `units:`, of those that the text names.
pub(super) fn units(context: &Context<'_>, named: &BTreeSet<&str>) -> Vec<Item> {
    let item = |unit: &Unit| {
        let mut items = vec![Item::new("symbol", Node::text(unit.symbol.clone()))];
        if unit.scale != Ratio::ONE {
            items.push(Item::new("scale", Node::Plain(fraction(unit.scale))));
        }
        if unit.offset != Ratio::ZERO {
            items.push(Item::new("offset", Node::Plain(fraction(unit.offset))));
        }
        if let Some(base) = &unit.base {
            items.push(Item::new("base", Node::Text(format!("{} {}", fraction(base.factor), base.symbol))));
        }
        items.extend(
            unit.formula.as_ref().map(|formula| Item::new("formula", Node::text(formula.text.clone()))),
        );
        items.extend(described(&unit.about, context.language()));
        Item::new(spelled(&context.unit_name(unit)), Node::Map(items))
    };
    let units = context.units();
    units.iter().filter(|unit| named.contains(&*context.unit_name(unit))).map(|unit| item(unit)).collect()
}

/// `1/10`.
fn fraction(ratio: Ratio) -> String {
    match ratio.to_whole() {
        Some(whole) => whole.to_string(),
        None => format!("{}/{}", ratio.numerator(), ratio.denominator()),
    }
}

/// `types:`, of those that the text names.
pub(super) fn types(context: &Context<'_>, in_text: &BTreeSet<&str>) -> Vec<Item> {
    let item = |named: &NamedType| {
        let mut items = vec![Item::new("base", Node::plain(named.base.name()))];
        items.extend(described(&named.about, context.language()));
        match &named.kind {
            TypeKind::Enum(values) => {
                items.push(Item::new("values", Node::Map(enum_values(context, values))));
            }
            TypeKind::Bits(fields) => items.extend(bit_fields(context, fields)),
        }
        Item::new(spelled(&context.type_name(named)), Node::Map(items))
    };
    let types = context.types();
    types
        .iter()
        .filter(|named| in_text.contains(&*context.type_name(named)))
        .map(|named| item(named))
        .collect()
}

fn enum_values(context: &Context<'_>, values: &[EnumValue]) -> Vec<Item> {
    let item = |value: &EnumValue| {
        let supported = (!value.supported).then(|| Item::new("supported", Node::yes_no(false)));
        let more = supported.into_iter().chain(search(&value.search)).collect();
        let node = named(&value.name, more, &value.about, context.language());
        Item::new(value.value.to_string(), node)
    };
    values.iter().map(item).collect()
}

/// `3`, `4..7`.
pub(super) fn bits(field: &BitField) -> String {
    if field.first == field.last {
        field.first.to_string()
    } else {
        format!("{}..{}", field.first, field.last)
    }
}

/// `bits:`, and `rest:` for what is reserved, if nothing is said about it.
fn bit_fields(context: &Context<'_>, fields: &[BitField]) -> Vec<Item> {
    let is_rest = |field: &BitField| field.usage == BitUsage::Reserved && is_bare(field);
    let reserved = fields.iter().filter(|field| is_rest(field)).count();
    // Two runs side by side would become one.
    let apart = fields.windows(2).all(|two| !two.iter().all(is_rest));
    let short = context.style.short && reserved > 1 && apart;
    let listed = fields.iter().filter(|field| !(short && is_rest(field)));
    let listed = Item::new("bits", Node::Map(listed.map(|field| bit_field(context, field)).collect()));
    let rest = short.then(|| Item::new("rest", Node::plain("reserved")));
    std::iter::once(listed).chain(rest).collect()
}

/// Whether nothing is said about bits but what they are for.
fn is_bare(field: &BitField) -> bool {
    let BitField {
        name, about, search, errors, mnemonic, clamp, active, edge, priority, values, modes, ..
    } = field;
    name.is_empty()
        && about.is_empty()
        && about.gap().is_none()
        && search.is_empty()
        && errors.is_empty()
        && mnemonic.is_none()
        && clamp.is_none()
        && *active == 1
        && edge.is_none()
        && priority.is_none()
        && values.is_empty()
        && modes.is_empty()
}

fn bit_field(context: &Context<'_>, field: &BitField) -> Item {
    let word = match field.usage {
        BitUsage::Used => None,
        BitUsage::Reserved => Some("reserved"),
        BitUsage::Unused => Some("unused"),
    };
    if let Some(word) = word.filter(|_| is_bare(field)) {
        return Item::new(bits(field), Node::plain(word));
    }
    let mut more: Vec<Item> = Vec::new();
    more.extend(word.map(|word| Item::new(word, Node::yes_no(true))));
    let codes: Vec<Node> = field.error_codes().map(|code| Node::Plain(format!("0x{code:04X}"))).collect();
    if !codes.is_empty() {
        more.push(Item::new("error", one_or_more(codes)));
    }
    more.extend(field.mnemonic.clone().map(|mnemonic| Item::new("mnemonic", Node::Text(mnemonic))));
    more.extend(field.clamp.clone().map(|clamp| Item::new("clamp", Node::Text(clamp))));
    more.extend(search(&field.search));
    if field.active != 1 {
        more.push(Item::new("active", Node::plain(field.active)));
    }
    more.extend(field.edge.map(|edge| Item::new("edge", Node::plain(edge.word()))));
    more.extend(field.priority.clone().map(|priority| Item::new("priority", Node::Text(priority))));
    if !field.values.is_empty() {
        more.push(Item::new("values", Node::Map(enum_values(context, &field.values))));
    }
    let modes = field.modes.iter().map(|mode| {
        Item::new(spelled(&mode.mode.value), named(&mode.name, Vec::new(), &mode.about, context.language()))
    });
    let modes: Vec<Item> = modes.collect();
    if !modes.is_empty() {
        more.push(Item::new("modes", Node::Map(modes)));
    }
    if !field.name.is_empty() {
        // `reserved` and `unused` by themselves are words of the language.
        let is_word = matches!(field.name.as_str(), "reserved" | "unused");
        if !is_word || !more.is_empty() || !field.about.is_empty() {
            return Item::new(bits(field), named(&field.name, more, &field.about, context.language()));
        }
        more.push(Item::new("name", Node::text(field.name.clone())));
    }
    more.extend(described(&field.about, context.language()));
    Item::new(bits(field), Node::Map(more))
}

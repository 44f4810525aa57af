//! Units and named types.

use od_spec::model::{self, BitField, BitUsage, EnumValue, NamedType, Ratio, TypeKind, Unit};
use serde::Serialize;
use serde_json::{Value as Json, json};

use super::{Described, SearchWords, described, integer, ratio, search_words, with_description};
use crate::hexadecimal;

#[derive(Serialize)]
pub(super) struct UnitView<'a> {
    name: &'a str,
    symbol: &'a str,
    /// One raw step in `symbol`, as numerator and denominator.
    scale: [Json; 2],
    /// What the raw value 0 means, where that is not 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    offset: Option<[Json; 2]>,
    base: Option<Json>,
    #[serde(skip_serializing_if = "Option::is_none")]
    formula: Option<&'a str>,
    #[serde(flatten)]
    about: Described<'a>,
}

pub(super) fn unit_view(unit: &Unit) -> UnitView<'_> {
    UnitView {
        name: &unit.name,
        symbol: &unit.symbol,
        scale: ratio(unit.scale),
        offset: (unit.offset != Ratio::ZERO).then(|| ratio(unit.offset)),
        base: unit.base.as_ref().map(|base| json!({"symbol": base.symbol, "factor": ratio(base.factor)})),
        formula: unit.formula.as_ref().map(|formula| formula.text.as_str()),
        about: described(&unit.about),
    }
}

#[derive(Serialize)]
pub(super) struct TypeView<'a> {
    name: &'a str,
    base: &'static str,
    #[serde(flatten)]
    about: Described<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    values: Option<Vec<EnumView<'a>>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    bits: Option<Vec<BitView<'a>>>,
}

#[derive(Serialize)]
struct EnumView<'a> {
    value: Json,
    name: &'a str,
    supported: bool,
    #[serde(flatten)]
    about: Described<'a>,
    #[serde(skip_serializing_if = "SearchWords::is_empty")]
    search: SearchWords<'a>,
}

#[derive(Serialize)]
struct BitView<'a> {
    first: u8,
    last: u8,
    usage: &'static str,
    name: &'a str,
    #[serde(flatten)]
    about: Described<'a>,
    #[serde(skip_serializing_if = "SearchWords::is_empty")]
    search: SearchWords<'a>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    errors: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mnemonic: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    clamp: Option<&'a str>,
    active: u8,
    #[serde(skip_serializing_if = "Option::is_none")]
    edge: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    priority: Option<&'a str>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    values: Vec<EnumView<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    modes: Vec<Json>,
}

pub(super) fn type_view(named: &NamedType) -> TypeView<'_> {
    let (values, bits) = match &named.kind {
        TypeKind::Enum(values) => (Some(values.iter().map(enum_view).collect()), None),
        TypeKind::Bits(fields) => (None, Some(fields.iter().map(bit_view).collect())),
    };
    TypeView { name: &named.name, base: named.base.name(), about: described(&named.about), values, bits }
}

fn enum_view(value: &EnumValue) -> EnumView<'_> {
    EnumView {
        value: integer(value.value),
        name: &value.name,
        supported: value.supported,
        about: described(&value.about),
        search: search_words(&value.search),
    }
}

fn bit_view(field: &BitField) -> BitView<'_> {
    BitView {
        first: field.first,
        last: field.last,
        usage: match field.usage {
            BitUsage::Used => "used",
            BitUsage::Reserved => "reserved",
            BitUsage::Unused => "unused",
        },
        name: &field.name,
        about: described(&field.about),
        search: search_words(&field.search),
        errors: field.error_codes().map(|code| hexadecimal::prefixed(code, 4)).collect(),
        mnemonic: field.mnemonic.as_deref(),
        clamp: field.clamp.as_deref(),
        active: field.active,
        edge: field.edge.map(model::Edge::word),
        priority: field.priority.as_deref(),
        values: field.values.iter().map(enum_view).collect(),
        modes: field
            .modes
            .iter()
            .map(|one| with_description(json!({"mode": one.mode.value, "name": one.name}), &one.about))
            .collect(),
    }
}

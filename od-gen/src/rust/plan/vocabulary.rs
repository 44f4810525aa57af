//! What values are in code: units, enums, bit fields and special values.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::model::{BitUsage, DataType, Entry, EnumValue, NamedType, Ratio, Text, TypeKind};
use od_spec::source::Span;

use super::{Members, Plan, PlannedBits, PlannedSpecial, PlannedType, PlannedUnit, ValueKind, too_large};
use crate::rust::names::{Scope, camel, screaming, snake};

impl Plan<'_> {
    /// Units, types and special values that the device's entries use, by name.
    pub(super) fn vocabulary(&mut self, diagnostics: &mut Diagnostics) {
        let span = self.device.span;
        let (mut units, mut types) = (BTreeMap::new(), BTreeMap::new());
        for (_, _, entry) in self.device.entries() {
            if let Some(unit) = entry.unit.as_deref().filter(|_| entry.data_type.is_integer()) {
                units.insert(unit.name.as_str(), unit);
            }
            if let Some(named) = entry.named_type.as_deref() {
                types.insert(named.name.as_str(), named);
            }
        }
        let mut scope = Scope::with_reserved(&["bases"]);
        for unit in units.into_values() {
            let name = camel(&unit.name);
            scope.claim(&name, &format!("unit `{}`", unit.name), span, diagnostics);
            let small = |ratio: Option<Ratio>| {
                let ratio = ratio?;
                Some((u64::try_from(ratio.numerator()).ok()?, u64::try_from(ratio.denominator()).ok()?))
            };
            let (Some(scale), Some(step)) = (small(Some(unit.scale)), small(unit.step())) else {
                diagnostics.push(too_large(span, &format!("the scale of unit `{}`", unit.name)));
                continue;
            };
            let base = base_name(unit.base_symbol());
            self.units.push(PlannedUnit { unit, name, scale, step, base });
        }
        let mut scope = Scope::default();
        for named in types.into_values() {
            let name = camel(&named.name);
            scope.claim(&name, &format!("type `{}`", named.name), span, diagnostics);
            if matches!(named.kind, TypeKind::Enum(_)) && named.base == DataType::Unsigned64 {
                diagnostics.push(too_large(span, &format!("enum `{}`", named.name)));
            }
            let members = members(named, span, diagnostics);
            self.types.push(PlannedType { named, name, members });
        }
    }

    pub(super) fn kind(&mut self, entry: &Entry, diagnostics: &mut Diagnostics) -> ValueKind {
        let named = entry.named_type.as_deref().map(|named| camel(&named.name));
        let integer = entry.data_type.is_integer() && named.is_none();
        let unit = entry.unit.as_deref().filter(|_| integer).map(|unit| camel(&unit.name));
        let special = (integer && !entry.special.is_empty()).then(|| self.special(entry, diagnostics));
        ValueKind { data_type: entry.data_type, named, unit, special }
    }

    /// The set of special values of an entry; equal sets are one type.
    fn special(&mut self, entry: &Entry, diagnostics: &mut Diagnostics) -> usize {
        let values: Vec<_> = entry
            .special
            .iter()
            .map(|special| (camel(&special.name), special.name.clone(), special.value))
            .collect();
        let name = values.iter().map(|(name, ..)| name.as_str()).collect::<Vec<_>>().join("Or");
        let set = PlannedSpecial { name, values };
        if let Some(at) = self.specials.iter().position(|other| *other == set) {
            return at;
        }
        if self.specials.iter().any(|other| other.name == set.name) {
            diagnostics.push(
                Diagnostic::new(
                    codes::IDENTIFIER_CLASH,
                    entry.span,
                    format!("`{}` would name two sets of special values", set.name),
                )
                .help("give special values that differ different names"),
            );
        }
        let mut scope = Scope::default();
        for (name, text, _) in &set.values {
            scope.claim(name, &format!("special value `{text}`"), entry.span, diagnostics);
        }
        self.specials.push(set);
        self.specials.len() - 1
    }
}

/// `V`, `PU/s²` as an identifier of its own, whatever characters a symbol has.
fn base_name(symbol: &str) -> String {
    symbol.chars().fold("Base".to_owned(), |mut name, c| {
        match c {
            c if c.is_ascii_alphanumeric() => name.push(c),
            '/' => name.push_str("Per"),
            '°' => name.push_str("Degree"),
            '%' => name.push_str("Percent"),
            c => {
                let _ = write!(name, "U{:X}", u32::from(c));
            }
        }
        name
    })
}

fn members<'a>(named: &'a NamedType, span: Span, diagnostics: &mut Diagnostics) -> Members<'a> {
    let mut scope = Scope::with_reserved(&["known", "bits", "name", "number", "is_known"]);
    let label = &named.name;
    match &named.kind {
        TypeKind::Enum(values) => {
            Members::Values(constants("", values, label, span, &mut scope, diagnostics))
        }
        TypeKind::Bits(fields) => {
            let mut planned = Vec::new();
            for field in fields.iter().filter(|field| field.usage == BitUsage::Used) {
                let general =
                    [(field.name.clone(), &field.about)].into_iter().filter(|(name, _)| !name.is_empty());
                let said = |mode: &&(String, String, Text)| !matches!(mode.1.as_str(), "reserved" | "unused");
                let modes = field
                    .modes
                    .iter()
                    .filter(said)
                    .map(|(mode, name, about)| (format!("{mode} {name}"), about));
                for (label_of_field, about) in general.chain(modes) {
                    let name = snake(&label_of_field);
                    let what = format!("bit {} of type `{label}`", field.first);
                    scope.claim(&name, &what, span, diagnostics);
                    scope.claim(&format!("with_{name}"), &what, span, diagnostics);
                    let values =
                        constants(&label_of_field, &field.values, label, span, &mut scope, diagnostics);
                    planned.push(PlannedBits {
                        name,
                        label: label_of_field,
                        first: field.first,
                        last: field.last,
                        about,
                        field,
                        values,
                    });
                }
            }
            Members::Bits(planned)
        }
    }
}

fn constants<'a>(
    prefix: &str,
    values: &'a [EnumValue],
    label: &str,
    span: Span,
    scope: &mut Scope,
    diagnostics: &mut Diagnostics,
) -> Vec<(String, &'a EnumValue)> {
    let named = values.iter().map(|value| {
        let name = screaming(&format!("{prefix} {}", value.name));
        scope.claim(&name, &format!("value {} of type `{label}`", value.value), span, diagnostics);
        (name, value)
    });
    named.collect()
}

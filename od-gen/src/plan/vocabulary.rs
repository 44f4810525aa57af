//! What values are in code: units, enums, bit fields and special values.

use std::collections::BTreeMap;

use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::model::{
    BitField, BitUsage, DataType, Entry, EnumValue, ModeMeaning, NamedType, Ratio, TypeKind, Unit,
};
use od_spec::rule_codes::ALIKE_NAMES;

use super::language::{Companion, Role, ScopeKind};
use super::names::{Scope, Words};
use super::{
    Fraction, Members, Plan, PlannedBits, PlannedOffset, PlannedSpecial, PlannedSpecialValue, PlannedType,
    PlannedUnit, PlannedValue, SignedFraction, ValueKind, too_large,
};

/// Most characters of the names of values that together name the type of a set of them.
const LONGEST_LIST: usize = 80;

impl<'a> Plan<'a> {
    /// Units, types and special values that the device's entries use, by name.
    pub(super) fn vocabulary(&mut self, diagnostics: &mut Diagnostics) {
        let (mut units, mut types) = (BTreeMap::new(), BTreeMap::new());
        for (_, _, entry) in self.device.entries() {
            if let Some(unit) = entry.unit.as_deref().filter(|_| entry.data_type.is_integer()) {
                units.insert(unit.name.as_str(), unit);
            }
            if let Some(named) = entry.named_type.as_deref() {
                types.insert(named.name.as_str(), named);
            }
        }
        self.plan_units(units.into_values(), diagnostics);
        self.plan_types(types.into_values(), diagnostics);
    }

    fn plan_units(&mut self, units: impl Iterator<Item = &'a Unit>, diagnostics: &mut Diagnostics) {
        let mut scope = Scope::default();
        for unit in units {
            let span = self.place(unit.stated.span);
            let name = self.identifier(ScopeKind::Units, Role::Type, &unit.name);
            scope.claim(&name, &format!("unit `{}`", unit.name), span, diagnostics);
            let (Some(scale), Some(step)) = (fraction(unit.scale), unit.step().and_then(fraction)) else {
                diagnostics.push(too_large(span, &format!("the scale of unit `{}`", unit.name)));
                continue;
            };
            let offset = match unit.offset {
                Ratio::ZERO => None,
                _ => match planned_offset(unit) {
                    Some(offset) => Some(offset),
                    None => {
                        diagnostics.push(too_large(span, &format!("the offset of unit `{}`", unit.name)));
                        continue;
                    }
                },
            };
            self.units.push(PlannedUnit { unit, name, scale, step, offset });
        }
    }

    fn plan_types(&mut self, types: impl Iterator<Item = &'a NamedType>, diagnostics: &mut Diagnostics) {
        let mut scope = Scope::default();
        for named in types {
            let span = self.place(named.stated.span);
            let name = self.identifier(ScopeKind::Types, Role::Type, &named.name);
            scope.claim(&name, &format!("type `{}`", named.name), span, diagnostics);
            if matches!(named.kind, TypeKind::Enum(_)) && named.base == DataType::Unsigned64 {
                diagnostics.push(too_large(span, &format!("enum `{}`", named.name)));
            }
            let members = self.members(named, diagnostics);
            self.types.push(PlannedType { named, name, members });
        }
    }

    /// What an entry's values are; `words` are its name.
    pub(super) fn kind(&mut self, entry: &Entry, words: &Words, diagnostics: &mut Diagnostics) -> ValueKind {
        let named = entry.named_type.as_deref();
        let named = named.map(|named| self.identifier(ScopeKind::Types, Role::Type, &named.name));
        let integer = entry.data_type.is_integer() && named.is_none();
        let unit = entry.unit.as_deref().filter(|_| integer);
        let unit = unit.map(|unit| self.identifier(ScopeKind::Units, Role::Type, &unit.name));
        let special = (integer && !entry.special.is_empty()).then(|| self.special(entry, words, diagnostics));
        ValueKind { data_type: entry.data_type, named, unit, special }
    }

    /// The set of special values of an entry. Sets with the same meanings are one type in code, whatever their raw values: a
    /// broken wire is 32767 on one entry and 65535 on another, and the accessors of each know which.
    fn special(&mut self, entry: &Entry, words: &Words, diagnostics: &mut Diagnostics) -> usize {
        let values: Vec<_> = entry
            .special
            .iter()
            .map(|special| PlannedSpecialValue {
                name: self.identifier(ScopeKind::SpecialValues, Role::Variant, &special.name),
                text: special.name.clone(),
                value: special.value,
            })
            .collect();
        let mut set = PlannedSpecial { name: String::new(), values };
        set.name = self.special_name(&set, words);
        if let Some(at) = self.specials.iter().position(|planned| *planned == set) {
            return at;
        }
        let mut of_name = self.specials.iter().filter(|planned| planned.name == set.name);
        let one_type = of_name.next();
        let mut was_said = || entry.special.iter().any(|one| diagnostics.harden(ALIKE_NAMES, one.place.span));
        if one_type.is_some_and(|other| !set.has_meanings_of(other)) && !was_said() {
            diagnostics.push(
                Diagnostic::new(
                    codes::IDENTIFIER_CLASH,
                    entry.span,
                    format!("`{}` would name two sets of special values", set.name),
                )
                .help(
                    "spell what means the same in the same way, and give different meanings different names",
                ),
            );
        }
        let mut scope = Scope::default();
        for (PlannedSpecialValue { name, text, .. }, special) in set.values.iter().zip(&entry.special) {
            let place = self.place(special.place.span);
            scope.claim(name, &format!("special value `{text}`"), place, diagnostics);
        }
        self.specials.push(set);
        self.specials.len() - 1
    }

    /// The name of the type of a set: its values, or the first entry that has it where these are many, because each use of a
    /// value repeats it.
    fn special_name(&self, set: &PlannedSpecial, words: &Words) -> String {
        let variants: Vec<&str> = set.values.iter().map(|value| value.name.as_str()).collect();
        if variants.iter().map(|variant| variant.len()).sum::<usize>() <= LONGEST_LIST {
            return self.language.alternatives(&variants);
        }
        match self.specials.iter().find(|planned| set.has_meanings_of(planned)) {
            Some(same) => same.name.clone(),
            None => {
                let words = words.and("special values");
                self.language.identifier(ScopeKind::SpecialValues, Role::Type, &words)
            }
        }
    }

    fn members(&self, named: &'a NamedType, diagnostics: &mut Diagnostics) -> Members<'a> {
        let mut scope = Scope::default();
        match &named.kind {
            TypeKind::Enum(values) => {
                Members::Values(self.constants("", values, named, &mut scope, diagnostics))
            }
            TypeKind::Bits(fields) => {
                let used = fields.iter().filter(|field| field.usage == BitUsage::Used);
                let planned =
                    used.flat_map(|field| self.bit_accessors(field, named, &mut scope, diagnostics));
                Members::Bits(planned.collect())
            }
        }
    }

    /// A field under its name, and under one for each mode of operation in which it means something.
    fn bit_accessors(
        &self,
        field: &'a BitField,
        named: &NamedType,
        scope: &mut Scope,
        diagnostics: &mut Diagnostics,
    ) -> Vec<PlannedBits<'a>> {
        let span = self.place(field.place.span);
        let general = [(field.name.clone(), &field.about)].into_iter().filter(|(name, _)| !name.is_empty());
        let has_name = |meaning: &&ModeMeaning| !matches!(meaning.name.as_str(), "reserved" | "unused");
        let modes = field
            .modes
            .iter()
            .filter(has_name)
            .map(|one| (format!("{} {}", one.mode.value, one.name), &one.about));
        let labels = general.chain(modes);
        let planned = labels.map(|(label, about)| {
            let name = self.identifier(ScopeKind::TypeMembers, Role::Function, &label);
            let what = format!("bit {} of type `{}`", field.first, named.name);
            scope.claim(&name, &what, span, diagnostics);
            if let Some(with) = self.language.companion(Companion::With, &name) {
                scope.claim(&with, &Companion::With.describe(&what), span, diagnostics);
            }
            let values = self.constants(&label, &field.values, named, scope, diagnostics);
            PlannedBits { name, label, first: field.first, last: field.last, about, field, values }
        });
        planned.collect()
    }

    /// Constants for values; their names begin with a prefix.
    fn constants(
        &self,
        prefix: &str,
        values: &'a [EnumValue],
        named: &NamedType,
        scope: &mut Scope,
        diagnostics: &mut Diagnostics,
    ) -> Vec<PlannedValue<'a>> {
        let planned = values.iter().map(|value| {
            let name = format!("{prefix} {}", value.name);
            let name = self.identifier(ScopeKind::TypeMembers, Role::Constant, &name);
            let what = format!("value {} of type `{}`", value.value, named.name);
            scope.claim(&name, &what, self.place(value.place.span), diagnostics);
            PlannedValue { name, value }
        });
        planned.collect()
    }
}

fn planned_offset(unit: &Unit) -> Option<PlannedOffset> {
    let in_base = signed_fraction(unit.offset_in(unit.base_symbol())?)?;
    Some(PlannedOffset { in_symbol: signed_fraction(unit.offset)?, in_base })
}

/// A ratio in 64 bits, where it fits.
fn signed_fraction(ratio: Ratio) -> Option<SignedFraction> {
    Some(SignedFraction {
        numerator: i64::try_from(ratio.numerator()).ok()?,
        denominator: u64::try_from(ratio.denominator()).ok()?,
    })
}

/// A positive ratio in 64 bits, where it fits.
fn fraction(ratio: Ratio) -> Option<Fraction> {
    Some(Fraction {
        numerator: u64::try_from(ratio.numerator()).ok()?,
        denominator: u64::try_from(ratio.denominator()).ok()?,
    })
}

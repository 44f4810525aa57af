//! Enums, bit fields, units and special values.

use od_gen::facts;
use od_gen::plan::{
    Language as _, Members, PlannedBits, PlannedOffset, PlannedType, PlannedUnit, PlannedValue, Role,
    ScopeKind, Words,
};
use od_spec::model::SpecialValue;

use super::super::language::C;
use super::super::literal::{Integer, factor};
use super::super::page::{Page, WORDING};
use super::heading;

/// Enums and bit fields: a type of the width on the bus each, and what is in it.
pub(super) fn named_types(page: &mut Page<'_, '_>) {
    let plan = page.plan;
    if plan.types.is_empty() {
        return;
    }
    heading(page, "Values with names, and bits.");
    for planned in &plan.types {
        named_type(page, planned);
    }
}

fn named_type(page: &mut Page<'_, '_>, planned: &PlannedType<'_>) {
    let PlannedType { named, name, members } = planned;
    let Some(base) = Integer::of(named.base) else { return };
    // The bits of a word are counted without a sign.
    let carrier = match members {
        Members::Values(_) => base,
        Members::Bits(_) => base.unsigned(),
    };
    let type_name = page.names.type_of(name);
    page.text.gap();
    let about = page.about(&format!("{} ({})", named.name, named.base), &named.about);
    page.text.doc(&about);
    page.enter(&type_name, &format!("type `{}`", named.name));
    page.text.line(&format!("typedef {} {type_name};", carrier.name()));
    page.text.gap();
    match members {
        Members::Values(values) => {
            for value in values {
                one_value(page, &[name], value, carrier, &named.name);
            }
        }
        Members::Bits(bits) => {
            let width = u8::try_from(named.base.bits().unwrap_or(64)).unwrap_or(64);
            for bits in bits {
                some_bits(page, name, bits, carrier, width);
            }
        }
    }
}

fn one_value(
    page: &mut Page<'_, '_>,
    prefix: &[&str],
    planned: &PlannedValue<'_>,
    carrier: Integer,
    of: &str,
) {
    let PlannedValue { name, value } = planned;
    let support = if value.supported { "" } else { " Not supported." };
    let about = format!("{} {}{support}", value.value, page.about(&value.name, &value.about));
    let parts: Vec<&str> = prefix.iter().copied().chain([name.as_str()]).collect();
    page.text.doc(&about);
    page.define(&parts, &carrier.literal(value.value), &format!("value {} of `{of}`", value.value));
}

/// Mask and place of a field, and the values that it can have, before they are shifted there.
fn some_bits(page: &mut Page<'_, '_>, of: &str, bits: &PlannedBits<'_>, carrier: Integer, width: u8) {
    let PlannedBits { name, label, first, last, values, .. } = bits;
    let mask = (u64::MAX >> (63 - (last - first))) << first;
    let what = format!("bit {first} (`{label}`) of `{of}`");
    let about = facts::bits(page.plan, bits, str::to_owned);
    page.text.doc(&about);
    page.define(&[of, name, "MASK"], &carrier.pattern(mask, width), &what);
    page.define(&[of, name, "SHIFT"], &format!("({first}U)"), &what);
    if first != last {
        for value in values {
            one_value(page, &[of], value, carrier, label);
        }
    }
}

/// What one raw step is, as a fraction.
pub(super) fn units(page: &mut Page<'_, '_>) {
    let plan = page.plan;
    if plan.units.is_empty() {
        return;
    }
    heading(
        page,
        "Units: a raw value times NUMERATOR / DENOMINATOR is the value in the unit's symbol, plus OFFSET_NUMERATOR / OFFSET_DENOMINATOR \
         where there is one. The numbers are signed, as raw values may be.",
    );
    for PlannedUnit { unit, name, scale, offset, .. } in &plan.units {
        let what = format!("unit `{}`", unit.name);
        let step = WORDING.counted_step(unit);
        page.text.gap();
        let about = page.about(&format!("{}, one raw step is {step}", unit.name), &unit.about);
        page.text.doc(&about);
        page.define(&["UNIT", name, "NUMERATOR"], &factor(scale.numerator.into()), &what);
        page.define(&["UNIT", name, "DENOMINATOR"], &factor(scale.denominator.into()), &what);
        if let Some(PlannedOffset { in_symbol, .. }) = offset {
            let number = factor(in_symbol.numerator.into());
            page.define(&["UNIT", name, "OFFSET", "NUMERATOR"], &number, &what);
            let number = factor(in_symbol.denominator.into());
            page.define(&["UNIT", name, "OFFSET", "DENOMINATOR"], &number, &what);
        }
    }
}

/// Raw values with a meaning of their own, by entry: the same meaning may be another number elsewhere.
pub(super) fn specials(page: &mut Page<'_, '_>) {
    let plan = page.plan;
    let mut is_first = true;
    for planned in &plan.entries {
        let Some(carrier) = Integer::of(planned.entry.data_type) else { continue };
        if planned.entry.special.is_empty() {
            continue;
        }
        if std::mem::take(&mut is_first) {
            heading(page, "Special values of entries: no numbers, but what their names say.");
        }
        for SpecialValue { value, name, about, .. } in &planned.entry.special {
            let identifier = C.identifier(ScopeKind::SpecialValues, Role::Variant, &Words::of(name));
            let text = page.about(&format!("{} {}: {value} {name}", planned.id, planned.entry.name), about);
            let what = format!("special value `{name}` of {}", planned.id);
            page.text.doc(&text);
            page.define(&["SPECIAL", &planned.name, &identifier], &carrier.literal(*value), &what);
        }
    }
}

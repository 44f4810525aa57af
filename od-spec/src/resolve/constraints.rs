//! Conditions between entries, tried on the defaults.

use crate::ast::{ConstraintDecl, Name, Spec};
use crate::decode::{inside, nearest};
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::expr::{Comparison, EntryRef, Expr, Term};
use crate::model::{Constraint, Devices, Dictionary};
use crate::source::{Span, Spanned};

use super::refs::Broken;
use super::types::words;

pub(super) fn resolve(
    root: &Spec,
    devices: &[Dictionary],
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) -> Vec<Constraint> {
    for decl in &root.objects {
        check_write_conditions(decl, devices, broken, diagnostics);
    }
    for formula in root.units.iter().filter_map(|unit| unit.formula.clone()) {
        let formula = formula.map(|formula| formula.0);
        check_known(&formula, &devices.iter().collect::<Vec<_>>(), broken, diagnostics);
        check_operands(&formula, devices, diagnostics);
    }
    root.constraints.iter().filter_map(|decl| constraint(decl, devices, broken, diagnostics)).collect()
}

/// `writable-when` names entries of the same device.
fn check_write_conditions(
    decl: &crate::ast::ObjectDecl,
    devices: &[Dictionary],
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) {
    let members = decl.record.iter().flat_map(|record| &record.members);
    let elements = decl.array.iter().flat_map(|array| &array.elements);
    let common = decl.array.iter().map(|array| &array.entry);
    let entries = members.chain(elements).map(|(_, entry)| entry).chain(common).chain([&decl.entry]);
    for condition in entries.filter_map(|entry| entry.writable_when.as_ref()) {
        let has_object = |device: &&Dictionary| device.objects.contains_key(&decl.index.value);
        for device in devices.iter().filter(has_object) {
            check_known(condition, std::slice::from_ref(&device), broken, diagnostics);
        }
        check_names_entries(condition, diagnostics);
        check_operands(condition, devices, diagnostics);
        check_units(condition, devices, diagnostics);
    }
}

/// Reports entries that none of the devices has; `true` when there are none such.
fn check_known(
    condition: &Spanned<Expr>,
    devices: &[&Dictionary],
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) -> bool {
    let mut known = true;
    for (entry, range) in condition.value.entries().into_iter().zip(&condition.value.places) {
        let place = inside(Spanned::new(condition.value.text.as_str(), condition.span), range);
        let named = |device: &&&Dictionary| entry.device.as_ref().is_none_or(|key| *key == device.key);
        if let Some(key) = &entry.device
            && !devices.iter().any(|device| device.key == *key)
        {
            let keys = devices.iter().map(|device| device.key.as_str());
            let help = nearest(key, keys).map_or("name a device of the specification".to_owned(), |word| {
                format!("did you mean `{word}`?")
            });
            diagnostics.push(
                Diagnostic::new(codes::UNKNOWN_DEVICE, place, format!("there is no device `{key}`"))
                    .help(help),
            );
            known = false;
        } else if !devices.iter().filter(named).any(|device| device.entry(entry.id).is_some()) {
            if !broken.has(entry.id.index) {
                diagnostics.push(
                    Diagnostic::new(codes::UNKNOWN_ENTRY, place, format!("there is no entry {entry}"))
                        .help("correct the index or sub-index"),
                );
            }
            known = false;
        }
    }
    known
}

/// A comparison between numbers alone says nothing; the author forgot the `0x` of an entry.
fn check_names_entries(condition: &Spanned<Expr>, diagnostics: &mut Diagnostics) {
    let names_one = |comparison: &Comparison| {
        let terms = comparison.rest.iter().map(|(_, term)| term).chain([&comparison.first]);
        terms.into_iter().any(Term::names_entry)
    };
    if !condition.value.comparisons.iter().all(names_one) {
        diagnostics.push(
            Diagnostic::new(codes::BAD_NOTATION, condition.span, "a comparison names no entry, only numbers")
                .help("write entries with `0x`, such as `0x607D.1`; without it, they are decimal numbers"),
        );
    }
}

/// Conditions compute with integers, and ask for bits that exist.
fn check_operands(condition: &Spanned<Expr>, devices: &[Dictionary], diagnostics: &mut Diagnostics) {
    for (entry, bit) in condition.value.operands() {
        let named = |device: &&Dictionary| entry.device.as_ref().is_none_or(|key| *key == device.key);
        let Some(found) = devices.iter().filter(named).find_map(|device| device.entry(entry.id)) else {
            continue;
        };
        let problem = match (found.data_type.range(), found.data_type.bits(), bit) {
            (None, ..) => format!("{entry} is {}: conditions compute with integers", found.data_type),
            (_, Some(width), Some(bit)) if u16::from(bit) >= width => format!("{entry} has no bit {bit}"),
            _ => continue,
        };
        diagnostics.push(
            Diagnostic::new(codes::BAD_NOTATION, condition.span, problem)
                .help("name an integer entry, and a bit below its width"),
        );
    }
}

/// Entries that are compared directly are measured in one base unit. Products and quotients are left to the author.
fn check_units(condition: &Spanned<Expr>, devices: &[Dictionary], diagnostics: &mut Diagnostics) {
    let unit = |term: &Term| {
        let Term::Entry(entry) = term else { return None };
        let named = |device: &&Dictionary| entry.device.as_ref().is_none_or(|key| *key == device.key);
        let found = devices.iter().filter(named).find_map(|device| device.entry(entry.id))?;
        found.unit.clone().map(|unit| (term.to_string(), unit))
    };
    for comparison in &condition.value.comparisons {
        let mut left = unit(&comparison.first);
        for (_, term) in &comparison.rest {
            let right = unit(term);
            if let (Some((left_term, left_unit)), Some((right_term, right_unit))) = (&left, &right)
                && left_unit.base_symbol() != right_unit.base_symbol()
            {
                diagnostics.push(
                    Diagnostic::new(
                        codes::UNITS_DIFFER,
                        condition.span,
                        format!(
                            "{left_term} is in `{}`, {right_term} in `{}`",
                            left_unit.base_symbol(),
                            right_unit.base_symbol()
                        ),
                    )
                    .help("compare entries of one base unit, or correct a unit"),
                );
            }
            left = right;
        }
    }
}

fn constraint(
    decl: &ConstraintDecl,
    devices: &[Dictionary],
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) -> Option<Constraint> {
    let require = decl.require.as_ref()?;
    let all: Vec<&Dictionary> = devices.iter().collect();
    let conditions: Vec<&Spanned<Expr>> = [Some(require), decl.when.as_ref()].into_iter().flatten().collect();
    if !conditions.iter().all(|condition| check_known(condition, &all, broken, diagnostics)) {
        return None;
    }
    let before = diagnostics.iter().len();
    for condition in &conditions {
        check_names_entries(condition, diagnostics);
        check_operands(condition, devices, diagnostics);
        check_units(condition, devices, diagnostics);
    }
    if diagnostics.has_errors_behind(before) {
        return None;
    }
    let entries: Vec<&EntryRef> = conditions.iter().flat_map(|condition| condition.value.entries()).collect();
    let unprefixed = || entries.iter().filter(|entry| entry.device.is_none());
    // Entries without a device are those of each device that has all of them.
    let with_all_entries: Vec<&Dictionary> = devices
        .iter()
        .filter(|device| decl.on.as_ref().is_none_or(|on| on.iter().any(|key| key.value == device.key)))
        .filter(|device| unprefixed().all(|entry| device.entry(entry.id).is_some()))
        .collect();
    if with_all_entries.is_empty() && unprefixed().next().is_some() {
        let known = |key: &Name| devices.iter().any(|device| device.key == key.value);
        let unknown_device = decl.on.as_ref().is_some_and(|on| !on.iter().all(known));
        if unknown_device || unprefixed().any(|entry| broken.has(entry.id.index)) {
            return None;
        }
        diagnostics.push(
            Diagnostic::new(
                codes::CONSTRAINT_DEVICES,
                require.span,
                "no single device has all these entries",
            )
            .help("write `device:` before the entries, such as `pmc:0x6510.4`"),
        );
        return None;
    }
    let prefixed = entries.iter().filter_map(|entry| entry.device.clone());
    let mut keys: Vec<String> = prefixed.collect();
    if unprefixed().next().is_some() {
        keys.extend(with_all_entries.iter().map(|device| device.key.clone()));
    }
    keys.sort();
    keys.dedup();
    let seen_from = if with_all_entries.is_empty() { vec![*all.first()?] } else { with_all_entries };
    Some(Constraint {
        name: decl.name.value.clone(),
        about: words(&decl.about),
        require: require.value.clone(),
        when: decl.when.as_ref().map(|when| when.value.clone()),
        devices: Devices::Only(keys),
        seen_from: seen_from.into_iter().map(|device| device.key.clone()).collect(),
        span: require.span,
        places: places(require),
    })
}

/// Where a condition names entries.
fn places(condition: &Spanned<Expr>) -> Vec<Span> {
    let text = Spanned::new(condition.value.text.as_str(), condition.span);
    condition.value.places.iter().map(|range| inside(text, range)).collect()
}

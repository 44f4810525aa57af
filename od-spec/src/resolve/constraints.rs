//! Conditions between entries, tried on the defaults.

use crate::ast::{ConstraintDecl, Name, Spec};
use crate::decode::{inside, nearest};
use crate::diag::{Code, Diagnostic, Diagnostics};
use crate::expr::{Comparison, EntryRef, Expr, Outcome, Term, Values};
use crate::model::{Constraint, Devices, Dictionary, EntryId, Ratio};
use crate::source::Spanned;
use crate::yaml::shorten;

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
    for formula in root.units.iter().filter_map(|unit| unit.formula.as_ref()) {
        check_known(formula, &devices.iter().collect::<Vec<_>>(), broken, diagnostics);
        check_operands(formula, devices, diagnostics);
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
        let here = |device: &&Dictionary| device.objects.contains_key(&decl.index.value);
        for device in devices.iter().filter(here) {
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
                Diagnostic::new(Code::UnknownDevice, place, format!("there is no device `{key}`")).help(help),
            );
            known = false;
        } else if !devices.iter().filter(named).any(|device| device.entry(entry.id).is_some()) {
            if !broken.has(entry.id.index) {
                diagnostics.push(
                    Diagnostic::new(Code::UnknownEntry, place, format!("there is no entry {entry}"))
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
            Diagnostic::new(Code::BadNotation, condition.span, "a comparison names no entry, only numbers")
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
            Diagnostic::new(Code::BadNotation, condition.span, problem)
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
            if let (Some((one, own)), Some((other, its))) = (&left, &right)
                && own.base_symbol() != its.base_symbol()
            {
                diagnostics.push(
                    Diagnostic::new(
                        Code::UnitsDiffer,
                        condition.span,
                        format!("{one} is in `{}`, {other} in `{}`", own.base_symbol(), its.base_symbol()),
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
    let (errors, _) = diagnostics.count();
    for condition in &conditions {
        check_names_entries(condition, diagnostics);
        check_operands(condition, devices, diagnostics);
        check_units(condition, devices, diagnostics);
    }
    if diagnostics.count().0 > errors {
        return None;
    }
    let entries: Vec<&EntryRef> = conditions.iter().flat_map(|condition| condition.value.entries()).collect();
    let unprefixed = || entries.iter().filter(|entry| entry.device.is_none());
    // Entries without a device are those of each device that has all of them.
    let own: Vec<&Dictionary> = devices
        .iter()
        .filter(|device| decl.on.as_ref().is_none_or(|on| on.iter().any(|key| key.value == device.key)))
        .filter(|device| unprefixed().all(|entry| device.entry(entry.id).is_some()))
        .collect();
    if own.is_empty() && unprefixed().next().is_some() {
        let known = |key: &Name| devices.iter().any(|device| device.key == key.value);
        let unknown_device = decl.on.as_ref().is_some_and(|on| !on.iter().all(known));
        if unknown_device || unprefixed().any(|entry| broken.has(entry.id.index)) {
            return None;
        }
        diagnostics.push(
            Diagnostic::new(Code::ConstraintDevices, require.span, "no single device has all these entries")
                .help("write `device:` before the entries, such as `pmc:0x6510.4`"),
        );
        return None;
    }
    let prefixed = entries.iter().filter_map(|entry| entry.device.clone());
    let mut keys: Vec<String> = prefixed.collect();
    if unprefixed().next().is_some() {
        keys.extend(own.iter().map(|device| device.key.clone()));
    }
    keys.sort();
    keys.dedup();
    let constraint = Constraint {
        name: decl.name.value.clone(),
        about: words(&decl.about),
        require: require.value.clone(),
        when: decl.when.as_ref().map(|when| when.value.clone()),
        devices: Devices::Only(keys),
        span: require.span,
    };
    let candidates = if own.is_empty() { vec![*all.first()?] } else { own };
    for device in candidates {
        if let Outcome::Fails { left, op, right } = check(&constraint, &Defaults { device, devices }) {
            let named = require.value.entries();
            let is_link =
                |pair: &[&EntryRef]| pair[0].to_string() == left.0 && pair[1].to_string() == right.0;
            let link = named.windows(2).position(is_link);
            let place = link.map_or(require.span, |at| {
                let range = require.value.places[at].start..require.value.places[at + 1].end;
                inside(Spanned::new(require.value.text.as_str(), require.span), &range)
            });
            let mut diagnostic = Diagnostic::new(
                Code::ConstraintBroken,
                place,
                format!("the defaults of `{}` break `{}`", device.key, shorten(&constraint.name)),
            )
            .label(format!("not {}", op.sign()))
            .help("correct a default or the condition; values are compared in physical units");
            for (text, value) in [left, right] {
                let entry = named.iter().find(|entry| entry.to_string() == text);
                let defaults = Defaults { device, devices };
                let span = entry.and_then(|entry| Some(defaults.holder(entry)?.entry(entry.id)?.span));
                let said = format!("{text} is {value}");
                diagnostic = match span {
                    Some(span) => diagnostic.with(span, said),
                    None if text == value.to_string() => diagnostic,
                    None => diagnostic.note(said),
                };
            }
            diagnostics.push(diagnostic);
            break;
        }
    }
    Some(constraint)
}

/// Whether a constraint holds; one whose `when` does not hold, or cannot be decided, holds.
pub(crate) fn check(constraint: &Constraint, values: &dyn Values) -> Outcome {
    if let Some(when) = &constraint.when
        && when.evaluate(values) != Outcome::Holds
    {
        return Outcome::Holds;
    }
    constraint.require.evaluate(values)
}

/// Raw values of entries, to be seen in physical units.
pub(crate) trait Lookup {
    /// The device that an entry without `device:` belongs to.
    fn device(&self) -> &Dictionary;
    /// A device by key.
    fn other(&self, key: &str) -> Option<&Dictionary>;
    /// The raw value of an entry of a device.
    fn raw_value(&self, device: &Dictionary, id: EntryId) -> Option<i128> {
        device.entry(id)?.default.as_ref()?.integer()
    }

    /// The device that holds a named entry.
    fn holder(&self, entry: &EntryRef) -> Option<&Dictionary> {
        match &entry.device {
            Some(key) => self.other(key),
            None => Some(self.device()),
        }
    }
}

/// The defaults of all devices, seen from one of them.
pub(super) struct Defaults<'a> {
    pub device: &'a Dictionary,
    pub devices: &'a [Dictionary],
}

impl Lookup for Defaults<'_> {
    fn device(&self) -> &Dictionary {
        self.device
    }
    fn other(&self, key: &str) -> Option<&Dictionary> {
        self.devices.iter().find(|device| device.key == key)
    }
}

impl<T: Lookup> Values for T {
    fn value(&self, entry: &EntryRef) -> Option<Ratio> {
        let raw = Ratio::whole(self.raw(entry)?);
        let unit = self.holder(entry)?.entry(entry.id)?.unit.as_ref();
        match unit {
            Some(unit) => raw.checked_mul(unit.step()?),
            None => Some(raw),
        }
    }

    fn raw(&self, entry: &EntryRef) -> Option<i128> {
        self.raw_value(self.holder(entry)?, entry.id)
    }
}

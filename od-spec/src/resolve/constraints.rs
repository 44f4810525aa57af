//! Conditions between entries, tried on the defaults.

use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};

use crate::ast::{ConditionDecl, ConstraintDecl, Name, Spec};
use crate::decode::inside;
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::expr::{Comparison, EntryRef, Expr, Term};
use crate::model::{Constraint, Devices, Dictionary, Entry, Fact, Index};
use crate::source::{Span, Spanned};

use super::condition_names::{self, Described};
use super::refs::Broken;
use super::types::with_gap;
use super::varied::Varied;

pub(super) fn resolve(
    root: &Spec,
    devices: &[Dictionary],
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) -> Vec<Constraint> {
    let (known, varied) = (Known::of(devices), Varied::of(root));
    for decl in &root.objects {
        check_write_conditions(decl, &known, broken, diagnostics);
    }
    for formula in root.units.iter().filter_map(|unit| unit.formula.clone()) {
        let formula = formula.map(|formula| formula.0);
        check_known(&formula, Meant::Any(&known), broken, diagnostics);
        check_operands(&formula, Meant::Any(&known), diagnostics);
        let keys = || known.devices.iter().map(|device| device.key.as_str());
        for (entry, place) in unprefixed_in(&formula) {
            let help = "write a formula of entries that are the same on all devices";
            varied.is_refused(entry.id.index, place, keys(), help, diagnostics);
        }
    }
    // What the devices call their entries; they are not needed where no condition has names.
    let described = OnceCell::new();
    let describe = || -> Vec<Described<'_>> {
        devices.iter().map(|device| Described::new(&device.key, &device.objects)).collect()
    };
    let described = || described.get_or_init(describe).as_slice();
    root.constraints
        .iter()
        .filter_map(|decl| constraint(decl, &known, &varied, &described, broken, diagnostics))
        .collect()
}

/// The devices, by what conditions name.
struct Known<'a> {
    devices: &'a [Dictionary],
    by_key: BTreeMap<&'a str, &'a Dictionary>,
    /// The devices that have an object, in their order.
    with: BTreeMap<Index, Vec<&'a Dictionary>>,
}

impl<'a> Known<'a> {
    fn of(devices: &'a [Dictionary]) -> Self {
        let by_key = devices.iter().map(|device| (device.key.as_str(), device)).collect();
        let mut with: BTreeMap<Index, Vec<&'a Dictionary>> = BTreeMap::new();
        for device in devices {
            for index in device.objects.keys() {
                with.entry(*index).or_default().push(device);
            }
        }
        Self { devices, by_key, with }
    }

    /// The devices that have an object.
    fn with(&self, index: Index) -> &[&'a Dictionary] {
        self.with.get(&index).map_or(&[], Vec::as_slice)
    }

    /// What an operand is on the first device that has it, of those that are meant.
    fn entry(&self, operand: &EntryRef) -> Option<&'a Entry> {
        match &operand.device {
            Some(key) => self.by_key.get(key.as_str())?.entry(operand.id),
            None => self.with(operand.id.index).iter().find_map(|device| device.entry(operand.id)),
        }
    }
}

/// The devices that a condition may name.
#[derive(Clone, Copy)]
enum Meant<'a> {
    /// Those of one device.
    One(&'a Dictionary),
    /// Those of one device, and of others with their keys before them.
    SeenFrom(&'a Dictionary, &'a Known<'a>),
    Any(&'a Known<'a>),
}

impl<'a> Meant<'a> {
    fn has(self, key: &str) -> bool {
        match self {
            Self::One(device) => device.key == key,
            Self::SeenFrom(_, devices) | Self::Any(devices) => devices.by_key.contains_key(key),
        }
    }

    fn keys(self) -> impl Iterator<Item = &'a str> {
        let (one, any) = match self {
            Self::One(device) => (Some(device.key.as_str()), None),
            Self::SeenFrom(_, devices) | Self::Any(devices) => (None, Some(devices.by_key.keys().copied())),
        };
        one.into_iter().chain(any.into_iter().flatten())
    }

    fn entry(self, operand: &EntryRef) -> Option<&'a Entry> {
        match self {
            Self::One(device) => device.entry(operand.id),
            Self::SeenFrom(device, _) if operand.device.is_none() => device.entry(operand.id),
            Self::SeenFrom(_, devices) => devices.entry(operand),
            Self::Any(devices) => devices.entry(operand),
        }
    }
}

/// `writable-when` names entries of the same device.
fn check_write_conditions(
    decl: &crate::ast::ObjectDecl,
    devices: &Known<'_>,
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) {
    let members = decl.record.iter().flat_map(|record| &record.members);
    let elements = decl.array.iter().flat_map(|array| &array.elements);
    let common = decl.array.iter().map(|array| &array.entry);
    let entries = members.chain(elements).map(|(_, entry)| entry).chain(common).chain([&decl.entry]);
    for condition in entries.filter_map(|entry| entry.writable_when.as_ref()) {
        if let ConditionDecl::Plain(plain) = &condition.value {
            check_names_entries(&Spanned::new(plain.clone(), condition.span), diagnostics);
        }
        let has = |device: &&&Dictionary| {
            decl.devices.as_ref().is_none_or(|on| on.iter().any(|key| key.value == device.key))
        };
        for device in devices.with(decl.index.value).iter().filter(has) {
            let understood = match &condition.value {
                ConditionDecl::Plain(plain) => Some(plain),
                ConditionDecl::Named(_) => named_write_condition(device, decl.index.value, condition.span),
            };
            // The names were looked up already.
            let Some(understood) = understood else { continue };
            let understood = Spanned::new(understood.clone(), condition.span);
            check_known(&understood, Meant::One(device), broken, diagnostics);
            check_names_entries(&understood, diagnostics);
            check_operands(&understood, Meant::One(device), diagnostics);
            check_units(&understood, Meant::One(device), diagnostics);
        }
    }
}

/// A write condition with names, as it was understood on a device.
fn named_write_condition(device: &Dictionary, index: Index, place: Span) -> Option<&Expr> {
    let mut entries = device.objects.get(&index)?.entries.iter();
    entries.find(|entry| entry.place(Fact::WriteCondition) == place)?.writable_when.as_ref()
}

/// Reports entries that none of the devices has; `true` when there are none such.
fn check_known(
    condition: &Spanned<Expr>,
    devices: Meant<'_>,
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) -> bool {
    let mut known = true;
    for (entry, range) in condition.value.entries().into_iter().zip(&condition.value.places) {
        let place = inside(Spanned::new(condition.value.text.as_str(), condition.span), range);
        if let Some(key) = &entry.device
            && !devices.has(key)
        {
            let text = Spanned::new(condition.value.text.as_str(), condition.span);
            let place = inside(text, &(range.start..range.start + key.len()));
            let diagnostic =
                Diagnostic::new(codes::UNKNOWN_DEVICE, place, format!("there is no device `{key}`"));
            let meant = diagnostics.suggestions.nearest(key, devices.keys());
            diagnostics.push(match meant {
                Some(word) => diagnostic.did_you_mean(word),
                None => diagnostic.help("name a device of the specification"),
            });
            known = false;
        } else if devices.entry(entry).is_none() {
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
    if !condition.value.comparisons().all(names_one) {
        diagnostics.push(
            Diagnostic::new(codes::BAD_NOTATION, condition.span, "a comparison names no entry, only numbers")
                .help("write entries with `0x`, such as `0x607D.1`; without it, they are decimal numbers"),
        );
    }
}

/// Conditions compute with integers, and ask for bits that exist.
fn check_operands(condition: &Spanned<Expr>, devices: Meant<'_>, diagnostics: &mut Diagnostics) {
    for (entry, bit) in condition.value.operands() {
        let Some(found) = devices.entry(entry) else { continue };
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
fn check_units(condition: &Spanned<Expr>, devices: Meant<'_>, diagnostics: &mut Diagnostics) {
    let unit = |term: &Term| {
        let Term::Entry(entry) = term else { return None };
        devices.entry(entry)?.unit.clone().map(|unit| (term.to_string(), unit))
    };
    for comparison in condition.value.comparisons() {
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

fn constraint<'d>(
    decl: &ConstraintDecl,
    devices: &Known<'_>,
    varied: &Varied<'_>,
    described: &dyn Fn() -> &'d [Described<'d>],
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) -> Option<Constraint> {
    let understood = understood(decl, devices, described, broken, diagnostics)?;
    let (require, when) = (&understood.require, understood.when.as_ref());
    let conditions: Vec<&Spanned<Expr>> = [Some(require), when].into_iter().flatten().collect();
    if !conditions.iter().all(|condition| check_known(condition, Meant::Any(devices), broken, diagnostics)) {
        return None;
    }
    let entries: Vec<&EntryRef> = conditions.iter().flat_map(|condition| condition.value.entries()).collect();
    let unprefixed = || entries.iter().filter(|entry| entry.device.is_none());
    // Entries without a device are those of each device that has all of them.
    let on = decl.devices.as_ref();
    let on: Option<BTreeSet<&str>> = on.map(|on| on.iter().map(|key| key.value.as_str()).collect());
    let may_have_all: Vec<&Dictionary> = match unprefixed().next() {
        Some(first) => devices.with(first.id.index).to_vec(),
        None => devices.devices.iter().collect(),
    };
    let with_all_entries: Vec<&Dictionary> = may_have_all
        .into_iter()
        .filter(|device| on.as_ref().is_none_or(|on| on.contains(device.key.as_str())))
        .filter(|device| understood.devices.as_ref().is_none_or(|keys| keys.contains(&device.key.as_str())))
        .filter(|device| unprefixed().all(|entry| device.entry(entry.id).is_some()))
        .collect();
    if with_all_entries.is_empty() && unprefixed().next().is_some() {
        let known = |key: &Name| devices.by_key.contains_key(key.value.as_str());
        let unknown_device = decl.devices.as_ref().is_some_and(|on| !on.iter().all(known));
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
    let before = diagnostics.errors_found();
    for condition in &conditions {
        check_names_entries(condition, diagnostics);
        let seen_from = with_all_entries.iter().map(|device| Meant::SeenFrom(device, devices));
        let nowhere = with_all_entries.is_empty().then_some(Meant::Any(devices));
        for meant in seen_from.chain(nowhere) {
            check_operands(condition, meant, diagnostics);
            check_units(condition, meant, diagnostics);
        }
        for (entry, place) in unprefixed_in(condition) {
            let keys = with_all_entries.iter().map(|device| device.key.as_str());
            let help = "say in `devices:` for which device it is, or write the device before the entry, such as `pmc:0x6510.4`";
            varied.is_refused(entry.id.index, place, keys, help, diagnostics);
        }
    }
    if diagnostics.errors_found() > before {
        return None;
    }
    let prefixed = entries.iter().filter_map(|entry| entry.device.clone());
    let mut keys: Vec<String> = prefixed.collect();
    if unprefixed().next().is_some() {
        keys.extend(with_all_entries.iter().map(|device| device.key.clone()));
    }
    keys.sort();
    keys.dedup();
    let seen_from =
        if with_all_entries.is_empty() { vec![devices.devices.first()?] } else { with_all_entries };
    Some(Constraint {
        name: decl.name.value.clone(),
        series: decl.series.clone(),
        about: with_gap(&decl.about, &decl.gap),
        require: require.value.clone(),
        when: when.map(|when| when.value.clone()),
        devices: Devices::Only(keys),
        seen_from: seen_from.into_iter().map(|device| device.key.clone()).collect(),
        span: require.span,
        places: places(require),
    })
}

/// The entries that a condition names without a device, each with its place.
fn unprefixed_in(condition: &Spanned<Expr>) -> impl Iterator<Item = (&EntryRef, Span)> {
    let named = condition.value.entries().into_iter().zip(places(condition));
    named.filter(|(entry, _)| entry.device.is_none())
}

/// The conditions of a constraint with indices and numbers instead of names.
struct Understood<'a> {
    require: Spanned<Expr>,
    when: Option<Spanned<Expr>>,
    /// The devices on which the names mean these; all where there are no names.
    devices: Option<Vec<&'a str>>,
}

/// Looks up the names of a constraint, on every device that it may be about.
fn understood<'a, 'd>(
    decl: &ConstraintDecl,
    devices: &Known<'a>,
    described: &dyn Fn() -> &'d [Described<'d>],
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) -> Option<Understood<'a>> {
    let (require, when) = (decl.require.as_ref()?, decl.when.as_ref());
    let plain = |condition: &Spanned<ConditionDecl>| match &condition.value {
        ConditionDecl::Plain(plain) => Some(Spanned::new(plain.clone(), condition.span)),
        ConditionDecl::Named(_) => None,
    };
    if let Some(require) = plain(require)
        && when.is_none_or(|when| plain(when).is_some())
    {
        return Some(Understood { require, when: when.and_then(plain), devices: None });
    }
    let all = described();
    let is_meant = |key: &str| decl.devices.as_ref().is_none_or(|on| on.iter().any(|one| one.value == key));
    let read = |condition: &Spanned<ConditionDecl>, own: &Described<'_>, diagnostics: &mut Diagnostics| {
        match &condition.value {
            ConditionDecl::Plain(plain) => Some(plain.clone()),
            ConditionDecl::Named(text) => {
                let text = Spanned::new(text.clone(), condition.span);
                condition_names::resolve(&text, own, all, broken, diagnostics)
            }
        }
    };
    let on_device = |own: &Described<'_>, diagnostics: &mut Diagnostics| {
        let require = read(require, own, diagnostics);
        let when = match when {
            Some(when) => read(when, own, diagnostics).map(Some),
            None => Some(None),
        };
        Some((require?, when?))
    };
    let mut found: Vec<(&str, (Expr, Option<Expr>))> = Vec::new();
    let mut refused: Option<Diagnostics> = None;
    for (device, own) in devices.devices.iter().zip(all).filter(|(device, _)| is_meant(&device.key)) {
        let mut said = Diagnostics::new();
        match on_device(own, &mut said) {
            Some(conditions) => found.push((device.key.as_str(), conditions)),
            None if refused.as_ref().is_none_or(|least| said.count() < least.count()) => refused = Some(said),
            None => {}
        }
    }
    let Some((first, (plain_require, plain_when))) = found.first() else {
        // Of the device that knows most of it.
        diagnostics.append(refused.unwrap_or_default());
        return None;
    };
    if let Some((other, _)) = found.iter().find(|(_, one)| one.0 != *plain_require || one.1 != *plain_when) {
        let message = format!("the names mean other entries on `{first}` than on `{other}`");
        diagnostics.push(
            Diagnostic::new(codes::CONSTRAINT_DEVICES, require.span, message)
                .help("write indices, or `device:` before the names, or a constraint for each device"),
        );
        return None;
    }
    Some(Understood {
        require: Spanned::new(plain_require.clone(), require.span),
        when: when.zip(plain_when.clone()).map(|(when, plain)| Spanned::new(plain, when.span)),
        devices: Some(found.iter().map(|(key, _)| *key).collect()),
    })
}

/// Where a condition names entries.
fn places(condition: &Spanned<Expr>) -> Vec<Span> {
    let text = Spanned::new(condition.value.text.as_str(), condition.span);
    condition.value.places.iter().map(|range| inside(text, range)).collect()
}

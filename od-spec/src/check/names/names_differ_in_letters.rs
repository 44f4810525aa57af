//! Names in one list differ in their letters and digits: what differs in case and signs only is one name for people in
//! a hurry, and in identifiers.

use std::collections::{BTreeMap, BTreeSet};

use crate::ascii::{in_ascii, letters};
use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::diag::{Code, Diagnostic, Example, Severity, shorten};
use crate::model::{BitUsage, Dictionary, EntryId, NamedType, System, SystemSource, TypeKind};
use crate::order::Arrange as _;
use crate::source::Span;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::System(check) };

/// The code of the rule.
pub const CODE: &Code = &Code {
    id: "OD0898",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "names that differ only in case and signs",
    explanation: "Things in one list, such as the error codes of a device, the states of a machine or the special \
        values of an entry, have one name, or names that differ only in case, spaces and signs. Readers mistake one \
        for the other, and generated code, whose identifiers consist of letters and digits, cannot distinguish them: \
        there the same is an error. Give each a name of its own. Of a run of error codes, `{n}` in the name is \
        replaced by the number.",
    clause: None,
    example: Some(Example::new(
        "errors:\n  0xFF01: {name: valve stuck}\n  0xFF02: {name: Valve stuck!}",
        "errors:\n  0xFF01: {name: upper valve stuck}\n  0xFF02: {name: lower valve stuck}",
    )),
};

/// A name, and where it is written.
type Named<'a> = (&'a str, Span);

fn check(system: &System, findings: &mut Findings) {
    // The names of an EDS are as they are; code distinguishes them by their numbers.
    if system.source == SystemSource::Eds {
        return;
    }
    let mut lists = Lists { said: BTreeSet::new(), findings };
    for device in &system.devices {
        lists.objects(device);
        lists.values(device);
        lists.relations(system, device);
    }
}

/// Names without those that are equal: these are errors of their own.
fn unequal<'a>(names: impl Iterator<Item = Named<'a>>) -> Vec<Named<'a>> {
    let mut seen = BTreeSet::new();
    names.filter(|(name, _)| seen.insert(in_ascii(name))).collect()
}

/// Finds names in lists.
struct Lists<'f> {
    /// What was said of another device already.
    said: BTreeSet<(String, Vec<Span>)>,
    findings: &'f mut Findings,
}

impl Lists<'_> {
    fn objects(&mut self, device: &Dictionary) {
        let help = "give one of them another name, or an `identifier:`";
        let names = device.objects.values().map(|object| (object.label(), object.span));
        self.list("objects", help, device, unequal(names));
        for object in device.objects.values().filter(|object| object.is_structured()) {
            let names = object.entries.iter().map(|entry| (entry.label(), entry.span));
            self.list(&format!("entries of {}", object.index), help, device, unequal(names));
        }
    }

    /// Units, types and what they name; special values.
    fn values(&mut self, device: &Dictionary) {
        let (mut units, mut types) = (BTreeMap::new(), BTreeMap::new());
        let mut specials: BTreeMap<&str, Span> = BTreeMap::new();
        for (object, entry) in
            device.objects.values().flat_map(|object| object.entries.iter().map(move |entry| (object, entry)))
        {
            units.extend(entry.unit.as_deref().map(|unit| (unit.name.as_str(), unit.stated.span)));
            types.extend(entry.named_type.as_deref().map(|named| (named.name.as_str(), named)));
            if entry.special.is_empty() {
                continue;
            }
            for special in &entry.special {
                specials.entry(&special.name).or_insert(special.place.span);
            }
            let is_twice = |name: &str| entry.special.iter().filter(|one| one.name == name).count() > 1;
            let equal = entry.special.iter().filter(|special| is_twice(&special.name));
            let equal = equal.map(|special| (special.name.as_str(), special.place.span));
            let id = EntryId { index: object.index, sub: entry.sub };
            self.one_list(&format!("special values of {id}"), device, equal);
        }
        self.one_list("units", device, units);
        // What means the same on several entries is one type in code.
        self.one_list("special values", device, specials);
        for named in types.values() {
            self.members(device, named);
        }
        self.one_list(
            "types",
            device,
            types.into_values().map(|named| (named.name.as_str(), named.stated.span)),
        );
    }

    fn members(&mut self, device: &Dictionary, named: &NamedType) {
        let of_type = format!("of type `{}`", shorten(&named.name));
        match &named.kind {
            TypeKind::Enum(values) => {
                let names = values.iter().map(|value| (value.name.as_str(), value.place.span));
                self.one_list(&format!("values {of_type}"), device, unequal(names));
            }
            TypeKind::Bits(fields) => {
                let used =
                    fields.iter().filter(|field| field.usage == BitUsage::Used && !field.name.is_empty());
                let names = used.map(|field| (field.name.as_str(), field.place.span));
                self.one_list(&format!("bits {of_type}"), device, unequal(names));
                for field in fields {
                    let names = field.values.iter().map(|value| (value.name.as_str(), value.place.span));
                    let of_bits = format!("values of bits `{}`", shorten(&field.name));
                    self.one_list(&of_bits, device, unequal(names));
                }
            }
        }
    }

    /// State machines, errors and constraints.
    fn relations(&mut self, system: &System, device: &Dictionary) {
        let machines = system.machines.values().filter(|machine| machine.devices.includes(&device.key));
        for machine in machines.clone() {
            let of_machine = format!("of `{}`", shorten(&machine.name));
            let states = machine.states.iter().map(|state| (state.name.as_str(), state.span));
            self.one_list(&format!("states {of_machine}"), device, states);
            let commands = machine.commands.iter().map(|command| (command.name.as_str(), command.span));
            self.one_list(&format!("commands {of_machine}"), device, commands);
        }
        self.one_list(
            "state machines",
            device,
            machines.map(|machine| (machine.name.as_str(), machine.span)),
        );
        let errors = system.errors.iter().filter(|error| error.devices.includes(&device.key));
        let mut priorities: BTreeMap<&str, Span> = BTreeMap::new();
        for error in errors.clone() {
            if let Some(priority) = &error.priority {
                priorities.entry(priority).or_insert(error.span);
            }
        }
        self.one_list("priorities of errors", device, priorities);
        self.one_list("error codes", device, errors.map(|error| (error.name.as_str(), error.span)));
        let constraints =
            system.constraints.iter().filter(|constraint| constraint.devices.includes(&device.key));
        let names = constraints.map(|constraint| (constraint.name.as_str(), constraint.span));
        self.one_list("constraints", device, names);
    }

    fn one_list<'a>(&mut self, of: &str, device: &Dictionary, names: impl IntoIterator<Item = Named<'a>>) {
        self.list(of, "give each of them a name of its own", device, names.into_iter().collect());
    }

    /// One finding for all that have one name.
    fn list(&mut self, of: &str, help: &str, device: &Dictionary, names: Vec<Named<'_>>) {
        if names.len() < 2 {
            return;
        }
        let mut names: Vec<(String, Named<'_>)> =
            names.into_iter().map(|named| (letters(named.0), named)).collect();
        names.arrange_by(|(one, _), (other, _)| one.cmp(other));
        for alike in names.chunk_by(|(one, _), (other, _)| one == other).filter(|alike| alike.len() > 1) {
            let mut group: Vec<Named<'_>> = alike.iter().map(|(_, named)| *named).collect();
            // What has no letter at all has signs that readers can distinguish.
            if alike[0].0.is_empty() && group.windows(2).all(|two| two[0].0 != two[1].0) {
                continue;
            }
            group.arrange_by_key(|(_, place)| (!place.file.is_one_with(device.span.file), *place));
            self.report(of, help, device, &group);
        }
    }

    fn report(&mut self, of: &str, help: &str, device: &Dictionary, group: &[Named<'_>]) {
        /// So many of the places are shown.
        const SHOWN: usize = 8;
        let is_makers = |place: &Span| place.file.is_one_with(device.span.file);
        let mut places: Vec<Span> = group.iter().map(|(_, place)| *place).collect();
        places.dedup();
        // What comes from libraries alone is nothing that the author of a specification can change.
        let (Some(first), Some((name, _))) = (places.first().copied().filter(is_makers), group.first())
        else {
            return;
        };
        if !self.said.insert((of.to_owned(), places.clone())) {
            return;
        }
        // The second one is wrong, unless the first one is the only one that can change.
        let blamed = places.get(1).copied().filter(is_makers).unwrap_or(first);
        let count = group.len();
        let message = if group.iter().all(|(other, _)| other == name) {
            format!("{count} {of} are named `{}`", shorten(name))
        } else {
            format!("the names of {count} {of} differ only in case, spaces and signs")
        };
        let name_at = |place: Span| {
            let named = group.iter().find(|(_, other)| *other == place);
            named.map_or(String::new(), |(name, _)| format!("`{}`", shorten(name)))
        };
        let diagnostic = Diagnostic::new(CODE, blamed, message);
        let diagnostic = match places.as_slice() {
            [_] => diagnostic.help("write `{n}` in the name, for the number"),
            _ => diagnostic.label(name_at(blamed)).help(help),
        };
        let others = places.iter().copied().filter(|place| *place != blamed).take(SHOWN);
        let diagnostic = others.fold(diagnostic, |diagnostic, place| diagnostic.with(place, name_at(place)));
        self.findings.push_each(diagnostic);
    }
}

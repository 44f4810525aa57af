//! Objects of one device, and entries of one object, have names or identifiers of their own, also in ASCII, and none looks
//! like another one's `object.entry`.

use std::borrow::Cow;
use std::collections::BTreeMap;

use crate::ascii::in_ascii;
use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Repeated, Severity, shorten};
use crate::model::{DataType, Entry, EntryId, Fact, Object, SystemSource};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Objects(check) };

/// The code of the rule.
pub const CODE: &Code = &Code {
    id: "OD0303",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "a name has two meanings",
    explanation: "Names are how people, PDO mappings and generated code refer to things: objects of one device, entries of one object, values and bits of one \
        type, units and types each need a name of their own, also where an EDS writes it in ASCII. Otherwise a mapping or a parameter file could \
        reach another entry than its author had in mind. Give one of the two another name. Objects and entries may keep one name \
        where `identifier:` distinguishes them; references and code then use the identifier.",
    clause: None,
    example: Some(Example::new(
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro}\n  0x2001: {name: level, type: unsigned8, access: ro}",
        "objects:\n  0x2000: {name: upper level, type: unsigned8, access: ro}\n  0x2001: {name: lower level, type: unsigned8, access: ro}",
    )),
};

/// Objects by their identifiers, or else by their names as an EDS writes them.
type ByName<'a> = BTreeMap<Cow<'a, str>, &'a Object>;

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for mut finding in found(subject) {
        // CiA 306 lets names be equal; a reference by such a name is reported, with the entries that have it.
        if subject.system.source == SystemSource::Eds {
            finding.soften();
        }
        findings.push(finding);
    }
}

fn found(subject: &Subject<'_>) -> Vec<Diagnostic> {
    let mut findings = Vec::new();
    let mut by_name = ByName::new();
    let mut shared: BTreeMap<Cow<'_, str>, Repeated> = BTreeMap::new();
    for object in subject.device.objects.values() {
        if let Some(before) = by_name.insert(in_ascii(object.label()), object) {
            let found = same_name(subject, before, object);
            // Most EDS name all PDOs alike; in a specification each of them has to be mended.
            if subject.system.source == SystemSource::Eds {
                let shared = shared.entry(in_ascii(object.label())).or_insert_with(Repeated::new);
                shared.add(object.span, [], || found);
            } else {
                findings.push(found);
            }
        }
    }
    findings.extend(shared.into_values().filter_map(|found| found.into_diagnostic("objects")));
    for name in DataType::ALL.map(DataType::name) {
        if let Some(object) = by_name.get(name).filter(|object| object.label() == name) {
            let message = format!("`{name}` is the name of a data type");
            let help = subject.help(Help {
                specification: "choose another name, or add `identifier:`; this one means the data type in references",
                eds: "choose another name; this one means the data type wherever an object is named",
                setting: "choose another name; this one means the data type wherever an object is named",
            });
            findings.push(subject.object_finding(CODE, object, message).help(help));
        }
    }
    // Only a name with a dot can look like an object and its entry.
    by_name.retain(|name, _| name.contains('.'));
    for object in subject.device.objects.values().filter(|object| object.is_structured()) {
        check_entries(subject, object, &mut findings);
        if !by_name.is_empty() {
            check_dotted(subject, object, &by_name, &mut findings);
        }
    }
    findings
}

/// Two objects of one name. What comes from a library is right: the message is about the other one.
fn same_name(subject: &Subject<'_>, before: &Object, object: &Object) -> Diagnostic {
    let is_makers = object.span.file.is_one_with(subject.device.span.file);
    let (blamed, namesake) = if is_makers { (object, before) } else { (before, object) };
    let name = shorten(object.label());
    let help = subject.help(Help {
        specification: "give one of the two another name, or an `identifier:` of its own",
        eds: "give one of the two another name; people and generated code refer to objects by name",
        setting: "give one of the two another name; people and generated code refer to objects by name",
    });
    let message =
        format!("{} and {} of `{}` are both named `{name}`", before.index, object.index, subject.device.key);
    Diagnostic::new(CODE, blamed.span, message)
        .about((blamed.index, Fact::Name))
        .label(blamed.index.to_string())
        .with(namesake.span, namesake.index.to_string())
        .help(help)
}

/// Entries of one object that have one name: a finding for each name, however many have it.
fn check_entries(subject: &Subject<'_>, object: &Object, findings: &mut Vec<Diagnostic>) {
    let mut by_name: BTreeMap<Cow<'_, str>, &Entry> = BTreeMap::new();
    let mut shared: BTreeMap<Cow<'_, str>, Repeated> = BTreeMap::new();
    for entry in &object.entries {
        let Some(before) = by_name.insert(in_ascii(entry.label()), entry) else { continue };
        let place = subject.place(entry, Fact::Name);
        let found = shared.entry(in_ascii(entry.label())).or_insert_with(Repeated::new);
        // A name that is written once for many elements is wrong once.
        if found.is_empty() || place != subject.place(before, Fact::Name) {
            found.add(place, [], || same_entry_name(subject, object, before, entry));
        }
    }
    for found in shared.into_values() {
        if let Some(finding) = found.into_diagnostic("entries") {
            findings.push(finding);
        }
    }
}

/// Two entries of one name.
fn same_entry_name(subject: &Subject<'_>, object: &Object, before: &Entry, entry: &Entry) -> Diagnostic {
    let (index, first, second) = (object.index, before.sub, entry.sub);
    let (place, before_place) = (subject.place(entry, Fact::Name), subject.place(before, Fact::Name));
    let message = if entry.label() == before.label() {
        format!("{index}.{first} and {index}.{second} are both named `{}`", shorten(entry.label()))
    } else {
        format!("{index}.{first} and {index}.{second} have one name in ASCII")
    };
    let diagnostic = subject.finding(CODE, EntryId { index, sub: second }, entry, Fact::Name, message);
    if place == before_place {
        let help = subject.help(Help {
            specification: "write `{n}` into the name or into `identifier:`; it means the sub-index",
            eds: "give each entry of an object a name of its own",
            setting: "give each entry of an object a name of its own",
        });
        diagnostic.label(format!("sub-index {first} and sub-index {second}")).help(help)
    } else {
        let help = subject.help(Help {
            specification: "give each entry of an object a name or an `identifier:` of its own",
            eds: "give each entry of an object a name of its own",
            setting: "give each entry of an object a name of its own",
        });
        diagnostic
            .label(format!("sub-index {second}"))
            .with(before_place, format!("sub-index {first}"))
            .help(help)
    }
}

/// An object that is named like an entry of another one.
fn check_dotted(
    subject: &Subject<'_>,
    object: &Object,
    by_name: &ByName<'_>,
    findings: &mut Vec<Diagnostic>,
) {
    for entry in &object.entries {
        let full = format!("{}.{}", object.label(), entry.label());
        let Some(namesake) = by_name.get(&in_ascii(&full)) else { continue };
        let (index, sub) = (object.index, entry.sub);
        let message =
            format!("`{}` is the name of {} and means {index}.{sub}", shorten(&full), namesake.index);
        findings.push(
            subject
                .object_finding(CODE, namesake, message)
                .label(namesake.index.to_string())
                .with(entry.span, format!("{index}.{sub}"))
                .help("give one of them a name without this dot"),
        );
    }
}

//! What the stack demands of a dictionary: reported here, with the object and what to do, and not by a compiler that
//! stops in the stack's own files.

use od_spec::diag::{Code, Diagnostic, Diagnostics, codes};
use od_spec::model::{
    Access, DataType, Dictionary, Direction, EntryId, Family, Index, Object, Pdo, PdoTarget, SubIndex,
};
use od_spec::source::Span;

use super::cell::Cell;
use super::groups::has_groups;
use super::node_id;
use super::objects::{StackObject, groups_of};
use super::srdos::Srdos;

/// Mapped entries that the stack knows in a PDO.
const MOST_MAPPED: usize = 8;
/// Elements of 1016h that the stack counts.
const MOST_CONSUMERS: usize = 127;

/// Reports everything that the stack could not handle.
pub(super) fn check(
    device: &Dictionary,
    objects: &[StackObject<'_>],
    srdos: &Srdos,
    diagnostics: &mut Diagnostics,
) {
    let mut findings = Findings { device, diagnostics };
    findings.needed();
    findings.configured(srdos);
    findings.consumers(objects);
    let mut kinds = Kinds::default();
    for direction in [Direction::Receive, Direction::Transmit] {
        findings.pdos(direction, &mut kinds);
    }
    findings.kinds(&kinds);
    findings.mappings();
    findings.storage(objects);
    findings.identifiers();
    findings.octets(objects);
    findings.types();
}

/// The type that the stack reads an entry as, when it starts or when it sets up a PDO.
const fn type_in_stack(id: EntryId) -> Option<DataType> {
    Some(match (id.index.0, id.sub.0) {
        (0x1001 | 0x100D | 0x1019 | 0x1600..0x1800 | 0x1A00..0x1C00, 0)
        | (0x1400..0x1600 | 0x1800..0x1A00, 2) => DataType::Unsigned8,
        (0x100C | 0x1015 | 0x1017, 0) => DataType::Unsigned16,
        (0x1005 | 0x1006 | 0x1007 | 0x1012 | 0x1014, 0)
        | (0x1016 | 0x1600..0x1800 | 0x1A00..0x1C00, 1..)
        | (0x1200..0x1300, 1 | 2)
        | (0x1400..0x1600 | 0x1800..0x1A00, 1) => DataType::Unsigned32,
        _ => return None,
    })
}

/// The first of several names, and how many more there are.
fn list(names: &[&str]) -> String {
    const SHOWN: usize = 4;
    match names.len().checked_sub(SHOWN) {
        Some(more @ 1..) => format!("{} and {more} more", names[..SHOWN].join(", ")),
        Some(_) | None => names.join(", "),
    }
}

/// Reports which rules are not kept, as the stack extends the objects itself.
pub(super) fn left_to_stack(device: &Dictionary, entries: &[EntryId], diagnostics: &mut Diagnostics) {
    let named = entries.iter().filter_map(|id| {
        let entry = device.entry(*id)?;
        Some((entry.span, format!("{id} ({})", entry.name)))
    });
    Findings { device, diagnostics }.report_all(
        &named.collect::<Vec<_>>(),
        |names| format!("{names}: has limits, values, a lock or a condition, and CANopenNode keeps checks of its own only"),
        "look at what the stack checks there, or let the application look at the value in the stack's callbacks",
    );
}

/// What is the same for PDOs of both directions, each with its place.
#[derive(Default)]
struct Kinds {
    gaps: Vec<(Span, String)>,
    lacking: Vec<(Span, String)>,
}

struct Findings<'f, 'd> {
    device: &'d Dictionary,
    diagnostics: &'f mut Diagnostics,
}

impl Findings<'_, '_> {
    fn has(&self, index: u16) -> bool {
        self.device.objects.contains_key(&Index(index))
    }

    fn report(&mut self, code: &'static Code, span: Span, message: String, help: impl Into<String>) {
        self.diagnostics.push(Diagnostic::new(code, span, message).help(help));
    }

    /// Objects that no configuration does without.
    fn needed(&mut self) {
        for (index, name) in
            [(0x1000, "device type"), (0x1001, "error register"), (0x1017, "producer heartbeat time")]
        {
            if !self.has(index) {
                let message = format!(
                    "`{}` has no {} ({name}), and CANopenNode does not compile without it",
                    self.device.key,
                    Index(index)
                );
                self.report(
                    codes::STACK_REFUSES,
                    self.device.span,
                    message,
                    format!(
                        "add {} to the device; in a specification, the library `cia301` has it",
                        Index(index)
                    ),
                );
            }
        }
    }

    /// Objects that belong to others, or to something outside of the dictionary.
    fn configured(&mut self, srdos: &Srdos) {
        if !self.has(0x1018) {
            let message = format!(
                "`{}` has no 1018h (identity object), and CANopenNode's example reads the identity for LSS",
                self.device.key
            );
            let help = "add 1018h, or give the stack what it needs there";
            self.report(codes::STACK_DIFFERS, self.device.span, message, help);
        }
        for (there, missing) in [(0x100C, 0x100D), (0x100D, 0x100C)] {
            if let Some(object) = self.device.objects.get(&Index(there))
                && !self.has(missing)
            {
                let message = format!(
                    "there is {} and no {}, so that CANopenNode answers no node guarding and takes no notice of {0}",
                    Index(there),
                    Index(missing)
                );
                self.report(
                    codes::STACK_DIFFERS,
                    object.span,
                    message,
                    format!("add {}, or remove {}", Index(missing), Index(there)),
                );
            }
        }
        if !self.has(0x1200)
            && let Some((_, object)) = self.device.objects.range(Index(0x1201)..=Index(0x127F)).next()
        {
            let message = format!(
                "`{}` has {} (an SDO server) and no 1200h, and CANopenNode does not compile without it",
                self.device.key, object.index
            );
            let help = "add 1200h, the first SDO server; in a specification, the library `cia301` has it";
            self.report(codes::STACK_REFUSES, object.span, message, help);
        }
        let is_noted = |object: &Object| object.editor.as_ref().is_some_and(|notes| !notes.srdos.is_empty());
        if srdos.are_empty()
            && !self.device.objects.values().any(is_noted)
            && let Some((_, object)) = self.device.objects.range(Index(0x1301)..=Index(0x1340)).next()
        {
            let message = format!(
                "`{}` has SRDOs ({}) that map nothing, and CANopenNode maps no entry into one that is not marked for it",
                self.device.key, object.index
            );
            self.report(
                codes::STACK_DIFFERS,
                object.span,
                message,
                "give 1381h and the following a mapping and 1301h.1 a direction, or mark entries: `canopennode: {0x2000: {srdo: {0: transmit}}}`",
            );
        }
    }

    /// Heartbeat consumers: the stack counts the elements.
    fn consumers(&mut self, objects: &[StackObject<'_>]) {
        let Some(object) = objects.iter().find(|object| object.object.index.0 == 0x1016) else { return };
        match object.elements() {
            Some(1..=MOST_CONSUMERS) => {}
            Some(_) | None => self.report(
                codes::STACK_REFUSES,
                object.object.span,
                "CANopenNode takes 1016h (consumer heartbeat time) as an ARRAY of 1 to 127 elements without a gap".to_owned(),
                "make it such an ARRAY",
            ),
        }
    }

    /// The stack goes from the first parameter object of a direction to the next one in the list, and from the first mapping parameter object in step
    /// with it.
    fn pdos(&mut self, direction: Direction, kinds: &mut Kinds) {
        let first = direction.first_communication_index();
        let span = |index: u16, device: &Dictionary| {
            device.objects.get(&Index(index)).map_or(device.span, |object| object.span)
        };
        let numbers: Vec<u16> =
            (0..0x200).filter(|place| self.has(first + place) || self.has(first + 0x200 + place)).collect();
        let mut are_whole = true;
        for place in &numbers {
            let (communication, mapping) = (first + place, first + 0x200 + place);
            for (there, missing) in [(communication, mapping), (mapping, communication)] {
                if !self.has(missing) {
                    are_whole = false;
                    let message = format!(
                        "{} {} has {} and no {}: CANopenNode would use the objects of another PDO instead",
                        direction.pdo(),
                        place + 1,
                        Index(there),
                        Index(missing)
                    );
                    let span = span(there, self.device);
                    self.report(
                        codes::STACK_REFUSES,
                        span,
                        message,
                        format!("add {}, or remove {}", Index(missing), Index(there)),
                    );
                }
            }
        }
        let (Some(lowest), Some(highest)) = (numbers.first(), numbers.last()) else { return };
        if *lowest > 0 {
            let message = format!(
                "the first {} of `{}` is number {}, and CANopenNode begins with number 1",
                direction.pdo(),
                self.device.key,
                lowest + 1
            );
            let span = span(first + lowest, self.device);
            self.report(
                codes::STACK_REFUSES,
                span,
                message,
                format!("add {0} 1, which may be switched off", direction.pdo()),
            );
        } else if are_whole && usize::from(*highest) >= numbers.len() {
            let text = format!("{} number {} is at place {}", direction.pdo(), highest + 1, numbers.len());
            kinds.gaps.push((span(first + highest, self.device), text));
        }
        let objects = numbers.iter().filter_map(|place| self.device.objects.get(&Index(first + place)));
        let lacks = |(object, sub): &(&Object, u8)| object.entry(SubIndex(*sub)).is_none();
        let lacking = objects.flat_map(|object| [(object, 1), (object, 2)]).filter(lacks);
        kinds.lacking.extend(lacking.map(|(object, sub)| (object.span, format!("{}.{sub}", object.index))));
    }

    /// Reports each kind once.
    fn kinds(&mut self, kinds: &Kinds) {
        self.report_all(
            &kinds.gaps,
            |names| format!("the numbers of PDOs have a gap, and CANopenNode counts them by their place: {names}"),
            "do nothing, unless the application calls PDOs by number: the stack's numbers are places in the list",
        );
        self.report_all(
            &kinds.lacking,
            |names| format!("{names}: missing, and CANopenNode does not start without it"),
            "add the sub-index",
        );
    }

    /// PDOs with which the stack starts with an error, in 1001h and as an emergency: it stays pre-operational where the application lets it.
    fn mappings(&mut self) {
        let (mut empty, mut refused) = (Vec::new(), Vec::new());
        for pdo in self.device.pdos.iter().filter(|pdo| pdo.valid) {
            let name = format!("{} {}", pdo.direction.pdo(), pdo.number);
            let span =
                self.device.objects.get(&Index(pdo.mapping_index())).map_or(pdo.span, |object| object.span);
            // So many entries are mapped as sub-index 0 says: none where a file has no default for it.
            let number = EntryId { index: Index(pdo.mapping_index()), sub: SubIndex(0) };
            let number = self.device.entry(number).and_then(|entry| entry.default.as_ref()?.integer());
            if pdo.map.is_empty() || number.unwrap_or_default() == 0 {
                empty.push((span, name));
            } else if let Some(reason) = self.refusal(pdo) {
                refused.push((span, format!("{name} ({reason})")));
            }
        }
        self.report_all(
            &empty,
            |names| {
                format!("{names}: valid without a mapping, and CANopenNode starts with an error (1001h, emergency 8210h)")
            },
            "map something, or give the PDO out as not valid, with bit 31 of its COB-ID",
        );
        self.report_all(
            &refused,
            |names| {
                format!("{names}: CANopenNode refuses the mapping, and starts with an error (1001h, emergency 8210h)")
            },
            "correct the mapping, or give the PDO out as not valid, with bit 31 of its COB-ID",
        );
    }

    /// Commands of 1010h and 1011h that are about no value.
    fn storage(&mut self, objects: &[StackObject<'_>]) {
        let groups = groups_of(objects);
        let device = self.device;
        let empty: Vec<_> = device
            .entries()
            .filter(|(id, ..)| has_groups(device, &groups, *id) == Some(false))
            .map(|(id, _, entry)| (entry.span, format!("{id} ({})", entry.name)))
            .collect();
        self.report_all(
            &empty,
            |names| {
                format!("{names}: no value is stored by it, and CANopenNode refuses the command (0609 0011h)")
            },
            "say which entries are `stored:` by it, or remove the sub-index",
        );
    }

    /// Why the stack refuses the mapping of a PDO.
    fn refusal(&self, pdo: &Pdo) -> Option<String> {
        if pdo.map.len() > MOST_MAPPED {
            return Some(format!("{} entries, at most {MOST_MAPPED}", pdo.map.len()));
        }
        let bits: u32 = pdo.map.iter().map(|mapped| u32::from(mapped.bits)).sum();
        if bits > 64 {
            return Some(format!("{bits} bits, at most 64"));
        }
        pdo.map.iter().find_map(|mapped| {
            let PdoTarget::Entry(id) = mapped.target else { return None };
            let Some(entry) = self.device.entry(id) else { return Some(format!("{id} is not there")) };
            if !entry.pdo.allows(pdo.direction) {
                return Some(format!("{id} may not be mapped in this direction"));
            }
            let length = 8 * Cell::of(entry).map_or(0, Cell::length);
            (length < u32::from(mapped.bits))
                .then(|| format!("{id} has {length} bits, and {} are mapped", mapped.bits))
        })
    }

    /// Reports what is the same of several places once, at the first.
    fn report_all(&mut self, places: &[(Span, String)], message: impl Fn(&str) -> String, help: &str) {
        let Some((span, _)) = places.first() else { return };
        let names: Vec<&str> = places.iter().map(|(_, name)| name.as_str()).collect();
        self.report(codes::STACK_DIFFERS, *span, message(&list(&names)), help);
    }

    /// Bytes of which there may be fewer than there is room for: the stack has a length for texts of bytes alone.
    fn octets(&mut self, objects: &[StackObject<'_>]) {
        let mut whole = Vec::new();
        for slot in objects.iter().flat_map(StackObject::slots) {
            let entry = slot.entry;
            let is_fixed = entry.access == Access::Const && entry.default.is_some();
            let is_of_bytes = matches!(entry.data_type.family(), Family::OctetString | Family::UnicodeString);
            if is_of_bytes && slot.variable().is_some() && !is_fixed {
                whole.push((entry.span, format!("{} ({}, {} bytes)", slot.id, entry.name, slot.length)));
            }
        }
        self.report_all(
            &whole,
            |names| {
                format!("{names}: always whole for CANopenNode, which knows no shorter OCTET_STRING or UNICODE_STRING")
            },
            "do nothing if all bytes are always used; else leave it to the application, as a DOMAIN",
        );
    }

    /// Standard objects of another type than CiA 301 gives them, with which the stack does not start.
    fn types(&mut self) {
        let device = self.device;
        for (id, _, entry) in device.entries() {
            let Some(expected) = type_in_stack(id) else { continue };
            if entry.data_type.bits() != expected.bits() {
                let message = format!(
                    "{id} ({}) is {}, and CANopenNode starts only with {}",
                    entry.name, entry.data_type, expected
                );
                let help = format!("give it the type of CiA 301, {expected}");
                self.report(codes::STACK_REFUSES, entry.span, message, help);
            }
        }
    }

    /// Identifiers that the stack would change, and those that it leaves alone.
    fn identifiers(&mut self) {
        let changed = node_id::changed_by_stack(self.device);
        let changed = changed.into_iter().map(|(id, entry)| (entry.span, format!("{id} ({})", entry.name)));
        self.report_all(
            &changed.collect::<Vec<_>>(),
            |names| {
                format!(
                    "{names}: the same for every node, and CANopenNode adds the node-ID, because it is a base of the pre-defined connection set"
                )
            },
            "choose another identifier, or let the default be `$NODEID` plus this one",
        );
        let left: Vec<String> =
            node_id::left_to_the_device(self.device).iter().map(|default| default.id.to_string()).collect();
        if !left.is_empty() {
            let message = format!(
                "CANopenNode does not add the node-ID to {}, whose defaults have it in them",
                left.join(", ")
            );
            let help = "call `OD_addNodeId` of OD_extension.h with the node-ID, before the stack is started: it adds it there";
            self.report(codes::STACK_DIFFERS, self.device.span, message, help);
        }
    }
}

//! What the stack demands of a dictionary: reported here, with the object and what to do, and not by a compiler that
//! stops in the stack's own files.

use od_spec::diag::{Code, Diagnostic, Diagnostics, codes};
use od_spec::model::{Access, DataType, Dictionary, Direction, EntryId, Index, Object, PdoTarget, SubIndex};
use od_spec::source::Span;

use super::node_id;
use super::objects::StackObject;

/// Mapped entries that the stack knows in a PDO.
const MOST_MAPPED: usize = 8;
/// Elements of 1016h that the stack counts.
const MOST_CONSUMERS: usize = 127;

/// Reports everything that the stack could not handle.
pub(super) fn check(device: &Dictionary, objects: &[StackObject<'_>], diagnostics: &mut Diagnostics) {
    let mut findings = Findings { device, diagnostics };
    findings.needed();
    findings.configured();
    findings.consumers(objects);
    for direction in [Direction::Receive, Direction::Transmit] {
        findings.pdos(direction);
    }
    findings.mappings();
    findings.identifiers();
    findings.octets(objects);
}

/// Reports which rules are not kept, as the stack extends the objects itself.
pub(super) fn left_to_stack(device: &Dictionary, entries: &[EntryId], diagnostics: &mut Diagnostics) {
    for id in entries {
        let Some(entry) = device.entry(*id) else { continue };
        let message = format!(
            "{id} ({}) has limits, values, a lock or a condition, and CANopenNode keeps them with checks of its own only",
            entry.name
        );
        let help = "look at what the stack checks there, or let the application look at the value in the stack's callbacks";
        diagnostics.push(Diagnostic::new(codes::STACK_DIFFERS, entry.span, message).help(help));
    }
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

    /// Objects that the usual configuration does not do without.
    fn configured(&mut self) {
        let missing = [
            (
                !self.has(0x1014),
                0x1014,
                "COB-ID EMCY",
                "compile the stack with `CO_CONFIG_EM` without `CO_CONFIG_EM_PRODUCER`",
            ),
            (
                self.has(0x1005) && !self.has(0x1006),
                0x1006,
                "communication cycle period",
                "compile the stack with `CO_CONFIG_SYNC` set to 0, which leaves out SYNC",
            ),
            (
                !self.has(0x1018),
                0x1018,
                "identity object",
                "the stack's example reads the identity for LSS: give it what it needs there",
            ),
        ];
        for (is_missing, index, name, otherwise) in missing {
            if is_missing {
                let message = format!(
                    "`{}` has no {} ({name}), and CANopenNode in its usual configuration needs it",
                    self.device.key,
                    Index(index)
                );
                self.report(
                    codes::STACK_DIFFERS,
                    self.device.span,
                    message,
                    format!("add {}, or {otherwise}", Index(index)),
                );
            }
        }
        if let Some(object) =
            self.device.objects.range(Index(0x1301)..=Index(0x1340)).map(|(_, object)| object).next()
        {
            let message = format!(
                "`{}` has SRDOs ({}), and no entry gets the attributes by which CANopenNode maps it into one",
                self.device.key, object.index
            );
            self.report(
                codes::STACK_DIFFERS,
                object.span,
                message,
                "add `ODA_TSRDO` or `ODA_RSRDO` by hand to the entries of OD.c that may be mapped, or leave SRDOs to another stack",
            );
        }
    }

    /// Heartbeat consumers: the stack names the number of elements whether it uses it or not.
    fn consumers(&mut self, objects: &[StackObject<'_>]) {
        let object = objects.iter().find(|object| object.object.index.0 == 0x1016);
        let Some(object) = object else {
            let message = format!(
                "`{}` has no 1016h (consumer heartbeat time), and CANopenNode in its usual configuration needs it",
                self.device.key
            );
            let help = "add 1016h, or compile the stack with `CO_CONFIG_HB_CONS` set to 0";
            self.report(codes::STACK_DIFFERS, self.device.span, message, help);
            return;
        };
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
    fn pdos(&mut self, direction: Direction) {
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
            let message = format!(
                "the {}s of `{}` are not numbered without a gap, and CANopenNode counts them by their place: number {} is at place {}",
                direction.pdo(),
                self.device.key,
                highest + 1,
                numbers.len()
            );
            let help = "do nothing, unless the application calls PDOs by number: the stack's numbers are places in the list";
            let span = span(first + highest, self.device);
            self.report(codes::STACK_DIFFERS, span, message, help);
        }
        for place in numbers {
            let Some(object) = self.device.objects.get(&Index(first + place)) else { continue };
            self.communication(object);
        }
    }

    /// Entries without which the stack does not start a PDO.
    fn communication(&mut self, object: &Object) {
        for sub in [1, 2] {
            if object.entry(SubIndex(sub)).is_none() {
                let message = format!(
                    "{} has no sub-index {sub}, and CANopenNode does not start without it",
                    object.index
                );
                self.report(codes::STACK_DIFFERS, object.span, message, format!("add sub-index {sub}"));
            }
        }
    }

    /// Mappings that the stack takes otherwise.
    fn mappings(&mut self) {
        for pdo in &self.device.pdos {
            let name = format!("{} {}", pdo.direction.pdo(), pdo.number);
            let span =
                self.device.objects.get(&Index(pdo.mapping_index())).map_or(pdo.span, |object| object.span);
            if pdo.map.len() > MOST_MAPPED {
                let message =
                    format!("{name} maps {} entries, and CANopenNode at most {MOST_MAPPED}", pdo.map.len());
                self.report(
                    codes::STACK_DIFFERS,
                    span,
                    message,
                    "map fewer entries: the stack does not send or take this PDO",
                );
            }
            let in_bits = pdo.map.iter().find(|mapped| mapped.bits % 8 != 0);
            if let Some(mapped) = in_bits {
                let what = match mapped.target {
                    PdoTarget::Entry(id) => id.to_string(),
                    PdoTarget::Dummy(data_type) => data_type.to_string(),
                };
                let message =
                    format!("{name} maps {what} with {} bits, and CANopenNode whole bytes", mapped.bits);
                let help = "compile the stack with `CO_CONFIG_PDO_BITWISE_MAPPING`";
                self.report(codes::STACK_DIFFERS, span, message, help);
            }
        }
    }

    /// Bytes of which there may be fewer than there is room for: the stack has a length for texts alone.
    fn octets(&mut self, objects: &[StackObject<'_>]) {
        for slot in objects.iter().flat_map(StackObject::slots) {
            let entry = slot.entry;
            let is_fixed = entry.access == Access::Const && entry.default.is_some();
            if entry.data_type == DataType::OctetString && slot.variable().is_some() && !is_fixed {
                let message = format!(
                    "{} ({}) always has {} bytes for CANopenNode, which knows no shorter OCTET_STRING",
                    slot.id, entry.name, slot.length
                );
                let help =
                    "do nothing if all bytes are always used; else leave it to the application, as a DOMAIN";
                self.report(codes::STACK_DIFFERS, entry.span, message, help);
            }
        }
    }

    /// Identifiers that the stack would change, and those that it leaves alone.
    fn identifiers(&mut self) {
        for (id, entry) in node_id::changed_by_stack(self.device) {
            let message = format!(
                "{id} ({}) is the same for every node, and CANopenNode adds the node-ID to it, because it is a base of the pre-defined connection set",
                entry.name
            );
            self.report(
                codes::STACK_DIFFERS,
                entry.span,
                message,
                "choose another identifier, or let the default be `$NODEID` plus this one",
            );
        }
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

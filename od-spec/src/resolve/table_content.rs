//! What fills a table of the manual: whether it refers to things that are there.

use std::collections::BTreeSet;

use super::refs::Broken;
use super::scope::unknown;
use crate::ast::{CodeRange, ContentDecl, Name, Spec};
use crate::check::codes as rule_codes;
use crate::decode::lexical;
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::model::{Index, System, Text, TypeKind};
use crate::source::Spanned;

/// What contents of tables are checked against.
pub(super) struct Contents<'a> {
    system: &'a System,
    broken: &'a Broken,
    bit_fields: Known<'a>,
    enums: Known<'a>,
    machines: Known<'a>,
    constraints: Known<'a>,
    devices: Known<'a>,
    /// The indices that a device has.
    indices: BTreeSet<Index>,
}

/// Names of one kind that a table can refer to.
pub(super) struct Known<'a> {
    /// What they are, in a message.
    what: &'static str,
    /// Where they are defined.
    key: &'static str,
    /// Those that are in the model.
    names: BTreeSet<&'a str>,
    /// Those that are written, but may have been refused, which was said there.
    written: BTreeSet<&'a str>,
}

impl<'a> Contents<'a> {
    pub(super) fn of(root: &'a Spec, system: &'a System, broken: &'a Broken) -> Self {
        Self {
            system,
            broken,
            bit_fields: bit_fields(root, system),
            enums: types(root, system, "enum", is_enum),
            machines: Known {
                what: "state machine",
                key: "state-machines",
                names: system.machines.keys().map(String::as_str).collect(),
                written: root.machines.iter().map(|decl| decl.name.value.as_str()).collect(),
            },
            constraints: Known {
                what: "constraint",
                key: "constraints",
                names: system.constraints.iter().map(|constraint| constraint.name.as_str()).collect(),
                written: root.constraints.iter().map(|decl| decl.name.value.as_str()).collect(),
            },
            devices: Known {
                what: "device",
                key: "devices",
                names: system.devices.iter().map(|device| device.key.as_str()).collect(),
                written: BTreeSet::new(),
            },
            indices: system.devices.iter().flat_map(|device| device.objects.keys().copied()).collect(),
        }
    }

    pub(super) fn check(&self, content: &ContentDecl, diagnostics: &mut Diagnostics) {
        match content {
            ContentDecl::Overview(list) | ContentDecl::Objects(list) => self.objects(list, diagnostics),
            ContentDecl::Bits { named_type: Some(name), .. } => self.bit_fields.check(name, diagnostics),
            ContentDecl::Values(name) => self.enums.check(name, diagnostics),
            ContentDecl::States(name) | ContentDecl::Transitions(name) | ContentDecl::Commands(name) => {
                self.machines.check(name, diagnostics);
            }
            ContentDecl::Ladder { constraint: Some(name), labels } => {
                self.constraints.check(name, diagnostics);
                if let Some(labels) = labels {
                    self.labels(name, labels, diagnostics);
                }
            }
            ContentDecl::Pdos { device: Some(name), .. } => self.devices.check(name, diagnostics),
            ContentDecl::Errors(list) | ContentDecl::Reactions(list) => self.errors(list, diagnostics),
            ContentDecl::Rows { columns, rows } => check_rows(columns, rows, diagnostics),
            // What resolves it reports what is wrong with it.
            ContentDecl::Timing(_)
            | ContentDecl::Hysteresis(_)
            | ContentDecl::Flow(_)
            | ContentDecl::Axis(_)
            | ContentDecl::Prose(..)
            | ContentDecl::Bits { named_type: None, .. }
            | ContentDecl::Ladder { constraint: None, .. }
            | ContentDecl::Pdos { device: None, .. }
            | ContentDecl::Glossary
            | ContentDecl::History => {}
        }
    }

    /// Each entry of a ladder has a label.
    fn labels(&self, name: &Name, labels: &Spanned<Vec<Text>>, diagnostics: &mut Diagnostics) {
        let Some(constraint) = self.system.constraints.iter().find(|one| one.name == name.value) else {
            return;
        };
        let (entries, written) = (constraint.require.entries().len(), labels.value.len());
        if entries != written {
            let message = format!(
                "these are {written} labels, the constraint `{}` has {entries} entries",
                shorten(&name.value)
            );
            diagnostics.push(
                Diagnostic::new(rule_codes::COUNT_MISMATCH, labels.span, message)
                    .help("write one label per entry, in the order of `require:`"),
            );
        }
    }

    pub(super) fn objects(&self, list: &[Spanned<Index>], diagnostics: &mut Diagnostics) {
        for index in list {
            if !self.indices.contains(&index.value) && !self.broken.has(index.value) {
                let message = format!("there is no object {}", index.value);
                diagnostics.push(
                    Diagnostic::new(codes::UNKNOWN_ENTRY, index.span, message)
                        .help("correct the index, or define the object"),
                );
            }
        }
    }

    fn errors(&self, list: &[Name], diagnostics: &mut Diagnostics) {
        let below = |code: u32| self.system.errors.partition_point(|error| u32::from(error.code) < code);
        let has_all = |range: CodeRange| {
            let (first, behind) = (u32::from(range.first), u32::from(range.last) + 1);
            below(behind) - below(first) == range.codes().len()
        };
        for code in list.iter().filter(|code| code.value != "all") {
            let range = lexical::error_codes(&code.value);
            if !range.is_some_and(has_all) {
                let message = format!("there is no error code `{}`", shorten(&code.value));
                diagnostics.push(
                    Diagnostic::new(codes::UNKNOWN_REFERENCE, code.span, message)
                        .help("define it under `errors:`, or write `all`"),
                );
            }
        }
    }
}

/// The bit fields.
pub(super) fn bit_fields<'a>(root: &'a Spec, system: &'a System) -> Known<'a> {
    types(root, system, "bit field", is_bit_field)
}

fn types<'a>(
    root: &'a Spec,
    system: &'a System,
    what: &'static str,
    is_wanted: fn(&TypeKind) -> bool,
) -> Known<'a> {
    let types = system.types.values().filter(|named| is_wanted(&named.kind));
    // A type of the other kind is in the model, and is not what the table wants.
    let lost = root.types.iter().map(|decl| decl.name.value.as_str());
    Known {
        what,
        key: "types",
        names: types.map(|named| named.name.as_str()).collect(),
        written: lost.filter(|name| !system.types.contains_key(*name)).collect(),
    }
}

impl Known<'_> {
    /// Reports a name of nothing.
    pub(super) fn check(&self, name: &Name, diagnostics: &mut Diagnostics) {
        let is_there = |names: &BTreeSet<&str>| names.contains(name.value.as_str());
        if !is_there(&self.names) && !is_there(&self.written) {
            let help = format!("define it under `{}:`", self.key);
            let names = self.names.iter().copied();
            unknown(codes::UNKNOWN_REFERENCE, name, self.what, names, &help, diagnostics);
        }
    }
}

const fn is_bit_field(kind: &TypeKind) -> bool {
    matches!(kind, TypeKind::Bits(_))
}

const fn is_enum(kind: &TypeKind) -> bool {
    matches!(kind, TypeKind::Enum(_))
}

/// Each row has a cell per column.
fn check_rows(columns: &[Text], rows: &[Spanned<Vec<Text>>], diagnostics: &mut Diagnostics) {
    for row in rows.iter().filter(|row| row.value.len() != columns.len()) {
        let (cells, columns) = (row.value.len(), columns.len());
        let message = format!("this row has {cells} cells, the table has {columns} columns");
        diagnostics.push(
            Diagnostic::new(rule_codes::COUNT_MISMATCH, row.span, message)
                .help("write one cell per column; `\"\"` for an empty one"),
        );
    }
}

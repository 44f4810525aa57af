//! What fills a table of the manual: whether it refers to things that are there.

use super::refs::Broken;
use super::scope::unknown;
use crate::ast::{ContentDecl, Name, Spec};
use crate::check::codes as rule_codes;
use crate::decode::lexical;
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::model::{Index, System, Text, TypeKind};
use crate::source::Spanned;

/// What contents of tables are checked against.
pub(super) struct Contents<'a> {
    pub root: &'a Spec,
    pub system: &'a System,
    pub broken: &'a Broken,
}

/// Names of one kind that a table can refer to.
struct Known<'a> {
    /// What they are, in a message.
    what: &'static str,
    /// Where they are defined.
    key: &'static str,
    /// Those that are in the model.
    names: Vec<&'a str>,
    /// Those that are written, but may have been refused, which was said there.
    written: Vec<&'a str>,
}

impl Contents<'_> {
    pub(super) fn check(&self, content: &ContentDecl, diagnostics: &mut Diagnostics) {
        match content {
            ContentDecl::Overview(list) | ContentDecl::Objects(list) => self.objects(list, diagnostics),
            ContentDecl::Bits(name) => self.types("bit field", is_bit_field).check(name, diagnostics),
            ContentDecl::Values(name) => self.types("enum", is_enum).check(name, diagnostics),
            ContentDecl::States(name) | ContentDecl::Transitions(name) | ContentDecl::Commands(name) => {
                self.machines().check(name, diagnostics);
            }
            ContentDecl::Ladder(name) => self.constraints().check(name, diagnostics),
            ContentDecl::Pdos { device: Some(name), .. } => self.devices().check(name, diagnostics),
            ContentDecl::Errors(list) | ContentDecl::Reactions(list) => self.errors(list, diagnostics),
            ContentDecl::Rows { columns, rows } => check_rows(columns, rows, diagnostics),
            ContentDecl::Pdos { device: None, .. } | ContentDecl::Glossary | ContentDecl::History => {}
        }
    }

    fn objects(&self, list: &[Spanned<Index>], diagnostics: &mut Diagnostics) {
        for index in list {
            let is_known = self.system.devices.iter().any(|device| device.objects.contains_key(&index.value));
            if !is_known && !self.broken.has(index.value) {
                let message = format!("there is no object {}", index.value);
                diagnostics.push(
                    Diagnostic::new(codes::UNKNOWN_ENTRY, index.span, message)
                        .help("correct the index, or define the object"),
                );
            }
        }
    }

    fn types(&self, what: &'static str, is_wanted: fn(&TypeKind) -> bool) -> Known<'_> {
        let types = self.system.types.values().filter(|named| is_wanted(&named.kind));
        // A type of the other kind is in the model, and is not what the table wants.
        let lost = self.root.types.iter().map(|decl| decl.name.value.as_str());
        Known {
            what,
            key: "types",
            names: types.map(|named| named.name.as_str()).collect(),
            written: lost.filter(|name| !self.system.types.contains_key(*name)).collect(),
        }
    }

    fn machines(&self) -> Known<'_> {
        Known {
            what: "state machine",
            key: "state-machines",
            names: self.system.machines.keys().map(String::as_str).collect(),
            written: self.root.machines.iter().map(|decl| decl.name.value.as_str()).collect(),
        }
    }

    fn constraints(&self) -> Known<'_> {
        Known {
            what: "constraint",
            key: "constraints",
            names: self.system.constraints.iter().map(|constraint| constraint.name.as_str()).collect(),
            written: self.root.constraints.iter().map(|decl| decl.name.value.as_str()).collect(),
        }
    }

    fn devices(&self) -> Known<'_> {
        let names = self.system.devices.iter().map(|device| device.key.as_str()).collect();
        Known { what: "device", key: "devices", names, written: Vec::new() }
    }

    fn errors(&self, list: &[Name], diagnostics: &mut Diagnostics) {
        let has = |code: u16| self.system.errors.binary_search_by_key(&code, |error| error.code).is_ok();
        for code in list.iter().filter(|code| code.value != "all") {
            let range = lexical::error_codes(&code.value);
            if !range.is_some_and(|range| range.codes().all(has)) {
                let message = format!("there is no error code `{}`", shorten(&code.value));
                diagnostics.push(
                    Diagnostic::new(codes::UNKNOWN_REFERENCE, code.span, message)
                        .help("define it under `errors:`, or write `all`"),
                );
            }
        }
    }
}

impl Known<'_> {
    fn check(&self, name: &Name, diagnostics: &mut Diagnostics) {
        let is_there = |names: &[&str]| names.contains(&name.value.as_str());
        if !is_there(&self.names) && !is_there(&self.written) {
            let help = format!("define it under `{}:`", self.key);
            let names = self.names.iter().copied();
            diagnostics.push(unknown(codes::UNKNOWN_REFERENCE, name, self.what, names, &help));
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

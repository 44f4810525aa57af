//! Names in a whole program: C has one scope for all of them, and all macros.

use std::collections::BTreeMap;

use od_gen::plan::{Language, Role, ScopeKind, Words};
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::model::Dictionary;

use super::language::C;

/// What begins the names of the runtime and of CANopenNode: `od_get_u8`, `OD_ENTRY_H1000`, `ODA_SDO_R`, `CO_CONFIG_EM`.
const TAKEN: [&str; 5] = ["co", "od", "oda", "odr", "odt"];

/// The folder of a device, and what begins its names: `pmc`; `device_od` of a device `od`, as others have names that begin so.
pub(super) fn prefix(key: &str) -> String {
    let name =
        C.identifier(ScopeKind::Dictionary, Role::Type, &Words::of(key)).trim_end_matches('_').to_owned();
    let first = name.split('_').next().unwrap_or_default();
    if TAKEN.contains(&first) { format!("device_{name}") } else { name }
}

/// The names of one device: what kind of thing they are follows the device.
pub(super) struct Names {
    lower: String,
    upper: String,
}

impl Names {
    pub(super) fn of(device: &Dictionary) -> Self {
        let lower = prefix(&device.key);
        Self { upper: lower.to_ascii_uppercase(), lower }
    }

    /// `pmc`, as folders and files are called.
    pub(super) fn device(&self) -> &str {
        &self.lower
    }

    /// A macro: `PMC_LOW_SET_PRESSURE`, of `LOW` and `set_pressure`.
    pub(super) fn macro_of(&self, parts: &[&str]) -> String {
        let parts = parts.iter().map(|part| part.trim_matches('_').to_ascii_uppercase());
        [self.upper.clone()].into_iter().chain(parts).collect::<Vec<_>>().join("_")
    }

    /// A function: `pmc_get_set_pressure`, of `get` and `set_pressure`.
    pub(super) fn function(&self, parts: &[&str]) -> String {
        let parts = parts.iter().map(|part| part.trim_matches('_'));
        [self.lower.as_str()].into_iter().chain(parts).collect::<Vec<_>>().join("_")
    }

    /// A type: `pmc_drive_state_t`.
    pub(super) fn type_of(&self, name: &str) -> String {
        format!("{}_t", self.function(&[name]))
    }
}

/// Characters of a name that every compiler distinguishes (C99 5.2.4.1).
const DISTINGUISHED: usize = 63;

/// All names that files of one set define, each once. What different files of a device say in the same way, an include
/// guard for one, is reported apart by its kind.
#[derive(Default)]
pub(super) struct Register {
    names: BTreeMap<String, String>,
    /// Pairs that differ only beyond what every compiler distinguishes.
    alike: Vec<(String, String)>,
}

impl Register {
    /// Enters a name that the files define for `what`; a name that is there already is an error.
    pub(super) fn enter(
        &mut self,
        name: &str,
        what: &str,
        device: &Dictionary,
        diagnostics: &mut Diagnostics,
    ) {
        if let Some(other) = self.names.get(name) {
            diagnostics.push(
                Diagnostic::new(
                    codes::IDENTIFIER_CLASH,
                    device.span,
                    format!("`{name}` would name {what} and {other} in the C of `{}`", device.key),
                )
                .help(
                    "in C, all names of a program differ: change one of the names, give one of the entries `identifier:`, or \
                     rename a device whose key begins as that of another one",
                ),
            );
            return;
        }
        if let Some(beginning) = name.get(..DISTINGUISHED) {
            let alike = self.names.range(beginning.to_owned()..).next().map(|(other, _)| other);
            if let Some(other) = alike.filter(|other| other.starts_with(beginning)) {
                self.alike.push((other.clone(), name.to_owned()));
            }
        }
        self.names.insert(name.to_owned(), what.to_owned());
    }

    /// Reports the names of a device that not every compiler distinguishes, once for all.
    pub(super) fn report_alike(&mut self, device: &Dictionary, diagnostics: &mut Diagnostics) {
        let alike = std::mem::take(&mut self.alike);
        let Some((first, second)) = alike.first() else { return };
        let more = match alike.len() {
            1 => String::new(),
            count => format!("; {} more pairs", count - 1),
        };
        let message =
            format!("`{first}` and `{second}` begin with the same {DISTINGUISHED} characters{more}");
        diagnostics.push(
            Diagnostic::new(codes::NAMES_ALIKE, device.span, message).help(
                "give one of the entries a shorter `identifier:`, or a type, value or bit a shorter name",
            ),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn macros_of_the_runtimes_begin_as_no_device_does() {
        let headers =
            [include_str!("plain/runtime/od_runtime.h"), include_str!("canopennode/runtime/OD_extension.h")];
        let macros = headers.iter().flat_map(|header| header.lines()).filter_map(|line| {
            line.trim_start()
                .strip_prefix("#define ")?
                .split(|c: char| !c.is_alphanumeric() && c != '_')
                .next()
        });
        let macros: Vec<&str> = macros.collect();
        assert!(macros.len() > 20, "{macros:?}");
        for name in macros {
            assert!(prefix(name).starts_with("device_"), "{name}");
        }
    }

    #[test]
    fn a_device_and_a_kind_are_before_every_name() {
        let names = Names { lower: "pmc".to_owned(), upper: "PMC".to_owned() };
        assert_eq!(names.macro_of(&["LOW", "register_"]), "PMC_LOW_REGISTER");
        assert_eq!(names.function(&["get", "register_"]), "pmc_get_register");
        assert_eq!(names.type_of("drive_state"), "pmc_drive_state_t");
        assert_eq!(["int", "pitch drive 2"].map(prefix), ["int", "pitch_drive_2"]);
        assert_eq!(["OD", "od-lamp", "odo"].map(prefix), ["device_od", "device_od_lamp", "odo"]);
    }
}

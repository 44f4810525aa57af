//! Sites, and machines of a site, have folders of their own also where lower and upper case are one.

use std::collections::BTreeMap;

use super::{Check, Rule};
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::plant::Plant;
use crate::source::Span;

pub(super) const RULE: Rule = Rule { codes: &[CODE], check: Check::Plant(check) };

const CODE: &Code = &Code {
    id: "OD0743",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "two names of one folder",
    explanation: "The files of a plant are in a folder for each site and each machine. Two names that differ only in \
        case are one folder on Windows and macOS, and the files of one machine would replace those of the other. Give \
        one of the two another name.",
    clause: None,
    example: Some(Example::plant(
        "sites:\n  Hall: {type: P1, machines: {crane-a: {}, crane-A: {}}}",
        "sites:\n  Hall: {type: P1, machines: {crane-a: {}, crane-b: {}}}",
    )),
};

fn check(plant: &Plant, diagnostics: &mut Diagnostics) {
    let sites = plant.sites.iter().map(|site| (0, site.name.as_str(), site.span));
    one_by_one("sites", sites, diagnostics);
    let machines = plant.machines.iter().map(|machine| (machine.site, machine.name.as_str(), machine.span));
    one_by_one("machines", machines, diagnostics);
}

/// Reports names in one folder that differ only in case.
fn one_by_one<'a>(
    what: &str,
    names: impl Iterator<Item = (usize, &'a str, Span)>,
    diagnostics: &mut Diagnostics,
) {
    let mut seen: BTreeMap<(usize, String), (&str, Span)> = BTreeMap::new();
    for (folder, name, span) in names {
        let Some((other, first)) = seen.insert((folder, name.to_lowercase()), (name, span)) else { continue };
        if other != name {
            diagnostics.push(
                Diagnostic::new(CODE, span, format!("the {what} `{other}` and `{name}` have one folder"))
                    .with(first, format!("`{other}`"))
                    .help("give one of the two another name"),
            );
        }
    }
}

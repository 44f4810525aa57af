//! Findings that a specification allows: what a rule refuses and the device has all the same, or what is not a mistake
//! here.

use std::collections::{BTreeMap, BTreeSet};

use super::RULES;
use crate::ast::{AllowDecl, Spec};
use crate::diag::{Code, Diagnostic, Diagnostics, Severity, codes, shorten};
use crate::model::Index;
use crate::source::{FileId, Spanned};

/// The codes that a specification allows, each with the reason.
pub(crate) struct Allowed<'a> {
    by_code: BTreeMap<&'a str, Allow<'a>>,
    /// Those that a rule has found something for.
    used: BTreeSet<(&'a str, Covered)>,
}

/// A code that is allowed.
struct Allow<'a> {
    decl: &'a AllowDecl,
    /// The objects to which alone it is allowed, by where they begin: their ends, and which they are.
    objects: Option<BTreeMap<(FileId, u32), (u32, Index)>>,
}

impl<'a> Allow<'a> {
    fn of(decl: &'a AllowDecl) -> Self {
        let objects = decl.at.as_ref().map(|at| {
            let places = at.iter().flat_map(|object| {
                object.places.iter().map(|place| ((place.file, place.start), (place.end, object.index.value)))
            });
            // Of an object that is named twice, the first counts.
            places.rev().collect()
        });
        Self { decl, objects }
    }

    /// Whether a finding is allowed, and by what.
    fn covers(&self, finding: &Diagnostic) -> Option<Covered> {
        let Some(objects) = &self.objects else { return Some(Covered::Everywhere) };
        let place = finding.labels.first()?.span;
        let ((file, _), (end, index)) = objects.range(..=(place.file, place.start)).next_back()?;
        (*file == place.file && place.start < *end).then_some(Covered::At(*index))
    }
}

/// Where a rule may be broken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Covered {
    /// Anywhere in the file.
    Everywhere,
    /// At an object that is named.
    At(Index),
}

/// Whether a code is that of a rule over the model.
pub fn is_rule(code: &Code) -> bool {
    RULES.iter().any(|rule| rule.code == code)
}

/// Whether a specification can allow what a code says: that of a rule, or a warning; no error of reading.
pub fn can_be_allowed(code: &Code) -> bool {
    is_rule(code) || code.severity == Severity::Warning && codes::ALL.contains(&code)
}

impl<'a> Allowed<'a> {
    /// Nothing is allowed.
    #[cfg(test)]
    pub(crate) const fn none() -> Self {
        Self { by_code: BTreeMap::new(), used: BTreeSet::new() }
    }

    /// The codes under `allow:`; one that no rule has is reported.
    pub(crate) fn of(spec: &'a Spec, diagnostics: &mut Diagnostics) -> Self {
        let known = || {
            let of_rules = RULES.iter().map(|rule| rule.code);
            of_rules.chain(codes::ALL.iter().copied().filter(|code| can_be_allowed(code)))
        };
        let mut by_code = BTreeMap::new();
        for allow in &spec.allow {
            let code = &allow.code;
            if known().any(|known| known.id == code.value) {
                by_code.insert(code.value.as_str(), Allow::of(allow));
                for object in allow.at.iter().flatten().filter(|object| object.places.is_empty()) {
                    let message =
                        format!("{} is neither under `objects:` nor under `pdos:`", object.index.value);
                    diagnostics.push(
                        Diagnostic::new(codes::UNKNOWN_ENTRY, object.index.span, message)
                            .help("name objects of this file"),
                    );
                }
                continue;
            }
            let message =
                format!("found `{}`, expected the code of a rule or of a warning", shorten(&code.value));
            let diagnostic = Diagnostic::new(codes::UNKNOWN_WORD, code.span, message);
            let meant = diagnostics.suggestions.nearest(&code.value, known().map(|code| code.id));
            diagnostics.push(match meant.filter(|_| !code.value.starts_with("OD")) {
                Some(id) => diagnostic.did_you_mean(id),
                None => diagnostic
                    .help("write a code of `odgen explain all`; what cannot be read cannot be allowed"),
            });
        }
        Self { by_code, used: BTreeSet::new() }
    }

    /// Takes the findings that are allowed for notes, which give the reason.
    pub(crate) fn soften(&mut self, found: Diagnostics) -> Diagnostics {
        if self.by_code.is_empty() {
            return found;
        }
        let mut softened = Diagnostics::new();
        for finding in found.iter().cloned() {
            softened.push(self.softened(finding));
        }
        softened
    }

    /// The same for warnings alone.
    pub(crate) fn soften_warnings(&mut self, found: &mut Diagnostics) {
        for finding in found.as_mut_slice() {
            if finding.severity() == Severity::Warning {
                *finding = self.softened(finding.clone());
            }
        }
    }

    fn softened(&mut self, finding: Diagnostic) -> Diagnostic {
        let allow = self.by_code.get(finding.code.id);
        match allow.and_then(|allow| Some((allow.decl, allow.covers(&finding)?))) {
            Some((allow, covered)) => {
                self.used.insert((allow.code.value.as_str(), covered));
                let reason = allow.reason.get("en").unwrap_or_default();
                Diagnostic { severity: Severity::Note, ..finding.note(format!("`allow:` says: {reason}")) }
            }
            None => finding,
        }
    }

    /// Reports the codes and objects that nothing was found for.
    pub(crate) fn report_unused(&self, diagnostics: &mut Diagnostics) {
        for (code, Allow { decl: allow, .. }) in &self.by_code {
            let mut report = |span, what: String| {
                diagnostics.push(
                    Diagnostic::new(super::names::definitions_are_used::CODE, span, what)
                        .help("remove it; it would hide the next such mistake"),
                );
            };
            let Some(objects) = &allow.at else {
                if !self.used.contains(&(*code, Covered::Everywhere)) {
                    report(allow.code.span, format!("nothing has the error {code} that is allowed here"));
                }
                continue;
            };
            for Spanned { value: index, span } in objects.iter().map(|object| object.index) {
                if !self.used.contains(&(*code, Covered::At(index))) {
                    report(span, format!("{index} does not have the error {code} that is allowed here"));
                }
            }
        }
    }
}

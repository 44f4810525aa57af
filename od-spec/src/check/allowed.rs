//! Findings that a specification allows: what a rule refuses and the device has all the same.

use std::collections::BTreeMap;

use super::RULES;
use crate::ast::{Name, Spec};
use crate::decode::nearest;
use crate::diag::{Code, Diagnostic, Diagnostics, Severity, codes, shorten};
use crate::model::Text;

/// The codes that a specification allows, each with the reason.
pub(crate) struct Allowed<'a> {
    by_code: BTreeMap<&'a str, (&'a Name, &'a Text)>,
    /// Those that a rule has found something for.
    used: Vec<&'a str>,
}

/// Whether a specification can allow what a code says: that of a rule, and none of reading.
pub fn can_be_allowed(code: &Code) -> bool {
    RULES.iter().any(|rule| rule.code == code)
}

impl<'a> Allowed<'a> {
    /// Nothing is allowed.
    #[cfg(test)]
    pub(crate) const fn none() -> Self {
        Self { by_code: BTreeMap::new(), used: Vec::new() }
    }

    /// The codes under `allow:`; one that no rule has is reported.
    pub(crate) fn of(spec: &'a Spec, diagnostics: &mut Diagnostics) -> Self {
        let mut by_code = BTreeMap::new();
        for (code, reason) in &spec.allow {
            if RULES.iter().any(|rule| rule.code.id == code.value) {
                by_code.insert(code.value.as_str(), (code, reason));
                continue;
            }
            let message = format!("found `{}`, expected the code of a rule", shorten(&code.value));
            let known = RULES.iter().map(|rule| rule.code.id);
            let help = match (code.value.starts_with("OD"), nearest(&code.value, known)) {
                (false, Some(id)) => format!("did you mean `{id}`?"),
                (_, _) => {
                    "write a code of `odgen explain all`; what cannot be read cannot be allowed".to_owned()
                }
            };
            diagnostics.push(Diagnostic::new(codes::UNKNOWN_WORD, code.span, message).help(help));
        }
        Self { by_code, used: Vec::new() }
    }

    /// Takes the findings that are allowed for notes, which give the reason.
    pub(crate) fn soften(&mut self, found: Diagnostics) -> Diagnostics {
        if self.by_code.is_empty() {
            return found;
        }
        let mut softened = Diagnostics::new();
        for finding in found.iter().cloned() {
            softened.push(match self.by_code.get_key_value(finding.code.id) {
                Some((code, (_, reason))) => {
                    self.used.push(code);
                    let reason = reason.get("en").unwrap_or_default();
                    Diagnostic {
                        severity: Severity::Note,
                        ..finding.note(format!("`allow:` says: {reason}"))
                    }
                }
                None => finding,
            });
        }
        softened
    }

    /// Reports the codes that nothing was found for.
    pub(crate) fn report_unused(&self, diagnostics: &mut Diagnostics) {
        for (code, (name, _)) in &self.by_code {
            if !self.used.contains(code) {
                let message = format!("nothing has the error {code} that is allowed here");
                diagnostics.push(
                    Diagnostic::new(super::definitions_are_used::CODE, name.span, message)
                        .help("remove the line; it would hide the next such mistake"),
                );
            }
        }
    }
}

//! A case as settings of a DCF.

use od_spec::assign;
use od_spec::diag::{Diagnostics, Severity};
use od_spec::model::System;
use od_spec::source::{SourceMap, Spanned};

use crate::agreement::NODE;
use crate::agreement::case::{Case, Said};

pub(crate) fn said(system: &System, case: &Case) -> Said {
    let mut sources = SourceMap::new();
    let settings: Vec<_> = case
        .set
        .iter()
        .map(|set| {
            let text = format!("{:04X}.{:X}={}", set.id.index.0, set.id.sub.0, set.raw.written());
            let file = sources.add("--set", text.as_str());
            Spanned::new(text, sources.whole(file))
        })
        .collect();
    let mut diagnostics = Diagnostics::new();
    assign(system, &system.devices[0], NODE, &settings, &mut diagnostics);
    summary(&diagnostics)
}

/// The codes of the errors, or else of the warnings.
pub(crate) fn summary(diagnostics: &Diagnostics) -> Said {
    let codes = |severity: Severity| {
        let found = diagnostics.iter().filter(|diagnostic| diagnostic.severity() == severity);
        let mut codes: Vec<&str> = found.map(|diagnostic| diagnostic.code.id).collect();
        codes.dedup();
        codes.join(" ")
    };
    match (codes(Severity::Error), codes(Severity::Warning)) {
        (errors, _) if !errors.is_empty() => Said::Refused(errors),
        (_, warnings) if !warnings.is_empty() => Said::Warned(warnings),
        _ => Said::Accepted,
    }
}

//! Error codes.

use std::collections::BTreeMap;

use super::types::words;
use crate::ast::Spec;
use crate::diag::{Code, Diagnostic, Diagnostics};
use crate::model::ErrorCode;
use crate::source::Span;

pub(super) fn resolve(root: &Spec, diagnostics: &mut Diagnostics) -> Vec<ErrorCode> {
    let mut codes: BTreeMap<u16, (Span, ErrorCode)> = BTreeMap::new();
    for decl in &root.errors {
        let (first, last) = decl.codes.value;
        let Some(name) = &decl.name else { continue };
        if let Some((code, (before, _))) = codes.range(first..=last).next() {
            diagnostics.push(
                Diagnostic::new(
                    Code::DuplicateValue,
                    decl.codes.span,
                    format!("error code {code:04X}h is defined twice"),
                )
                .label("again here")
                .with(*before, "first here")
                .help("each code has one meaning"),
            );
            continue;
        }
        for code in first..=last {
            let error = ErrorCode {
                code,
                name: name.value.replace("{n}", &(u32::from(code - first) + 1).to_string()),
                devices: decl.on.iter().flatten().map(|key| key.value.clone()).collect(),
                priority: decl.priority.as_ref().map(|priority| priority.value.clone()),
                reaction: words(&decl.reaction),
                about: words(&decl.about),
            };
            codes.insert(code, (decl.codes.span, error));
        }
    }
    codes.into_values().map(|(_, error)| error).collect()
}

//! Error codes.

use std::collections::BTreeMap;

use super::libraries::{self, Libraries};
use super::types::words;
use crate::ast::{CodeRange, ErrorDecl, Spec};
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{Devices, ErrorCode, Text};
use crate::source::Span;

pub(super) fn resolve(
    root: &Spec,
    libraries: &Libraries<'_>,
    diagnostics: &mut Diagnostics,
) -> Vec<ErrorCode> {
    let mut codes: BTreeMap<u16, (Span, ErrorCode)> = BTreeMap::new();
    for decl in &root.errors {
        let CodeRange { first, last } = decl.codes.value;
        if let Some((code, (before, _))) = codes.range(first..=last).next() {
            diagnostics.push(
                Diagnostic::new(
                    codes::DUPLICATE_VALUE,
                    decl.codes.span,
                    format!("error code {code:04X}h is defined twice"),
                )
                .label("again here")
                .with(*before, "first here")
                .help("each code has one meaning"),
            );
            continue;
        }
        let library = match &decl.from {
            Some(from) => match libraries.named(from, diagnostics) {
                Some(library) => Some(library),
                None => continue,
            },
            None => None,
        };
        for code in first..=last {
            let below = library.and_then(|library| libraries.error(library, code));
            let Some(error) = error(decl, code, below, diagnostics) else { break };
            codes.insert(code, (decl.codes.span, error));
        }
    }
    codes.into_values().map(|(_, error)| error).collect()
}

/// One code of a declaration, over what the library says about it.
fn error(
    decl: &ErrorDecl,
    code: u16,
    below: Option<&ErrorDecl>,
    diagnostics: &mut Diagnostics,
) -> Option<ErrorCode> {
    if let (Some(from), None) = (&decl.from, below) {
        let missing = libraries::not_there(from, &format!("error code {code:04X}h"));
        diagnostics.push(missing.help("write the code in full, without `from:`"));
        return None;
    }
    let name = |decl: &ErrorDecl| {
        let number = u32::from(code.saturating_sub(decl.codes.value.first)) + 1;
        Some(decl.name.as_ref()?.value.replace("{n}", &number.to_string()))
    };
    let Some(name) = name(decl).or_else(|| name(below?)).or_else(|| decl.unsure.then(String::new)) else {
        diagnostics.push(
            Diagnostic::new(
                codes::MISSING_KEY,
                decl.codes.span,
                "an error code needs the key `name` or `from`",
            )
            .help("add `name:`, or `from:` with a library that defines the code"),
        );
        return None;
    };
    let text = |written: Text, below: Option<Text>| {
        if written.is_empty() { below.unwrap_or_default() } else { written }
    };
    Some(ErrorCode {
        code,
        name,
        devices: Devices::listed(decl.devices.iter().flatten().map(|key| key.value.as_str())),
        priority: decl
            .priority
            .as_ref()
            .or_else(|| below?.priority.as_ref())
            .map(|priority| priority.value.clone()),
        reaction: text(words(&decl.reaction), below.map(|below| words(&below.reaction))),
        about: text(words(&decl.about), below.map(|below| words(&below.about))),
    })
}

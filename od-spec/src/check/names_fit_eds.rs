//! Names can be written into an EDS that every tool reads alike.

use crate::diag::{Code, Diagnostic, Diagnostics};
use crate::model::Dictionary;
use crate::source::Span;

/// Longest `ParameterName` (CiA 306 4.6.3.2).
const LONGEST: usize = 241;

pub(super) fn check(device: &Dictionary, diagnostics: &mut Diagnostics) {
    for object in device.objects.values() {
        check_name(&object.name, object.span, diagnostics);
        if object.is_structured() {
            for entry in &object.entries {
                check_name(&entry.name, entry.span, diagnostics);
            }
        }
    }
}

fn check_name(name: &str, span: Span, diagnostics: &mut Diagnostics) {
    let problem = if name.trim().is_empty() {
        "the name is empty".to_owned()
    } else if crate::ascii::transliterate(name).len() > LONGEST {
        format!("the name has {} characters, an EDS holds {LONGEST}", name.chars().count())
    } else if let Some(c) = name.chars().find(|c| matches!(c, ';' | '#' | '=') || c.is_control()) {
        format!("the name holds {c:?}, which EDS readers take for a comment or key")
    } else {
        return;
    };
    diagnostics.push(Diagnostic::new(Code::NotForEds, span, problem).help("choose another name"));
}

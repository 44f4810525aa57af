//! Names can be written into an EDS that every tool reads alike.

use crate::ast::Spec;
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{Dictionary, Entry, Value};
use crate::source::Span;
use crate::yaml::shorten;

/// Longest `ParameterName` (CiA 306 4.6.3.2).
const LONGEST: usize = 241;

pub(super) fn check(device: &Dictionary, diagnostics: &mut Diagnostics) {
    check_header(device, diagnostics);
    for object in device.objects.values() {
        check_name(&object.name, object.span, diagnostics);
        if object.is_structured() {
            for entry in &object.entries {
                check_name(&entry.name, entry.span, diagnostics);
            }
        }
        for entry in &object.entries {
            check_text_default(entry, diagnostics);
        }
    }
}

/// Longest `DefaultValue` on a line of 255 characters.
const LONGEST_VALUE: usize = 255 - "DefaultValue=".len();

/// A default stands on one line, without quotes and in ASCII.
fn check_text_default(entry: &Entry, diagnostics: &mut Diagnostics) {
    let Some(default) = entry.default.as_ref().filter(|_| entry.eds.default) else { return };
    let shown = crate::model::format_value(entry, default);
    let is_text = matches!(default, Value::Text(_));
    let is_line = matches!(default, Value::Text(_) | Value::Bytes(_));
    let problem = if is_line && shown.chars().count() > LONGEST_VALUE {
        format!("the default has {} characters, an EDS line holds {LONGEST_VALUE}", shown.chars().count())
    } else if is_text && shown.trim() != shown {
        "blanks at the start or end of the default are lost in an EDS".to_owned()
    } else if is_text && !shown.is_ascii() {
        "the default has characters that an EDS cannot hold".to_owned()
    } else if let Some(c) = shown.chars().find(|c| is_text && is_unfit(*c)) {
        format!("the default holds `{}`, which EDS readers misread", c.escape_default())
    } else {
        return;
    };
    diagnostics.push(
        Diagnostic::new(codes::NOT_FOR_EDS, entry.span, problem).help(
            "choose another text, or withhold the default from the EDS with `eds: {default: withheld}`",
        ),
    );
}

/// The vendor's name stands in every EDS.
pub(super) fn check_vendor(root: &Spec, diagnostics: &mut Diagnostics) {
    let Some(name) = root.vendor.as_ref().and_then(|vendor| vendor.name.as_ref()) else { return };
    let length = crate::ascii::transliterate(&name.value).len();
    if length > 244 || name.value.chars().any(is_unfit) {
        diagnostics.push(
            Diagnostic::new(codes::NOT_FOR_EDS, name.span, "the vendor's name does not fit an EDS")
                .help("at most 244 characters, without `;`, `#` and `=`"),
        );
    }
}

/// Texts of `[FileInfo]` and `[DeviceInfo]` with the length that CiA 306 4.4 and 4.5 give them.
fn check_header(device: &Dictionary, diagnostics: &mut Diagnostics) {
    let texts = [
        ("description", &device.file.description, 243),
        ("created-by", &device.file.created_by, 245),
        ("modified-by", &device.file.modified_by, 244),
        ("product-name", &device.info.product_name, 243),
        ("order-code", &device.info.order_code, 245),
    ];
    for (at, (key, text, longest)) in texts.into_iter().enumerate() {
        if texts[..at].iter().any(|(_, other, _)| *other == text) {
            continue; // one is taken from the other
        }
        let length = crate::ascii::transliterate(text).len();
        let problem = if length > longest {
            format!("has {length} characters, an EDS holds {longest}")
        } else if let Some(c) = text.chars().find(|c| is_unfit(*c)) {
            format!("holds {}, which EDS readers misread", describe(c))
        } else {
            continue;
        };
        diagnostics.push(
            Diagnostic::new(
                codes::NOT_FOR_EDS,
                device.span,
                format!("`{key}` of device `{}` {problem}", device.key),
            )
            .help("choose another text"),
        );
    }
}

/// Characters that several readers do not take as part of a value.
fn is_unfit(c: char) -> bool {
    matches!(c, ';' | '#' | '=') || c.is_control()
}

/// A character in a message.
fn describe(c: char) -> String {
    if c.is_control() { "a control character".to_owned() } else { format!("`{c}`") }
}

fn check_name(name: &str, span: Span, diagnostics: &mut Diagnostics) {
    let problem = if crate::ascii::transliterate(name).len() > LONGEST {
        format!(
            "the name `{}` has {} characters, an EDS holds {LONGEST}",
            shorten(name),
            name.chars().count()
        )
    } else if crate::ascii::transliterate(name).chars().all(|c| c == '?')
        && !name.contains('?')
        && !name.is_empty()
    {
        "no character of the name has a form in ASCII".to_owned()
    } else if let Some(c) = name.chars().find(|c| is_unfit(*c)) {
        format!("the name `{}` holds {}, which EDS readers misread", shorten(name), describe(c))
    } else {
        return;
    };
    diagnostics.push(Diagnostic::new(codes::NOT_FOR_EDS, span, problem).help("choose another name"));
}

//! Error codes.

use std::collections::BTreeMap;

use super::libraries::{self, Libraries};
use super::refs::{Broken, NamesOf};
use super::types::{phrases, words};
use super::varied::Varied;
use crate::ast::{CodeRange, ErrorDecl, Spec};
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{Devices, EntryId, ErrorCode, ErrorKind, Text};
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

/// The entries that choose the reactions, by error code.
pub(super) fn option_codes(
    root: &Spec,
    libraries: &Libraries<'_>,
    names: &NamesOf<'_>,
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) -> BTreeMap<u16, EntryId> {
    let mut found = BTreeMap::new();
    let varied = Varied::of(root);
    for decl in &root.errors {
        // A library that is not there is reported where the codes are resolved.
        let from = decl.from.as_ref().and_then(|from| libraries.named(from, &mut Diagnostics::default()));
        let below = from.and_then(|library| libraries.error(library, decl.codes.value.first));
        let below = below.and_then(|below| below.option_code.as_ref());
        let Some(reference) = decl.option_code.as_ref().or(below) else { continue };
        let on = Devices::listed(decl.devices.iter().flatten().map(|key| key.value.as_str()));
        let Some(id) = names.entry(&on, reference, broken, diagnostics) else { continue };
        let keys = names.each(&on).map(|(device, _)| device.key.as_str());
        let help = "say in `devices:` for which device it is";
        if !varied.is_refused(id.index, reference.span, keys, help, diagnostics) {
            found.extend(decl.codes.value.codes().map(|code| (code, id)));
        }
    }
    found
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
        // Entries are known when the devices are: `option_codes`.
        option_code: None,
        kinds: kinds(decl, code, below, diagnostics),
        treated_by: Devices::listed(
            decl.treated_by
                .as_ref()
                .or(decl.devices.as_ref())
                .into_iter()
                .flatten()
                .map(|key| key.value.as_str()),
        ),
        reset: text(words(&decl.reset), below.map(|below| words(&below.reset))),
        about: text(words(&decl.about), below.map(|below| words(&below.about)))
            .leaving_open(words(&decl.gap)),
        search: phrases(decl.search.as_ref().or_else(|| below?.search.as_ref())),
        span: decl.codes.span,
    })
}

/// The kinds of error that are stated; those that cannot be are reported, once for a range.
fn kinds(
    decl: &ErrorDecl,
    code: u16,
    below: Option<&ErrorDecl>,
    diagnostics: &mut Diagnostics,
) -> Vec<ErrorKind> {
    let stated =
        if decl.register.is_empty() { below.map(|below| &below.register) } else { Some(&decl.register) };
    let mut kinds: Vec<ErrorKind> = stated.into_iter().flatten().map(|kind| kind.value).collect();
    kinds.sort_unstable();
    kinds.dedup();
    let Some(first) = decl.register.first().filter(|_| code == decl.codes.value.first) else { return kinds };
    if ErrorCode::is_no_error(code) {
        diagnostics.push(
            Diagnostic::new(
                codes::REGISTER_OF_NO_ERROR,
                first.span,
                format!("{code:04X}h is not an error, and sets no bit of the error register"),
            )
            .help("remove `register:`"),
        );
    }
    if let Some(class) = ErrorKind::of_code(code).filter(|class| !kinds.contains(class)) {
        let word = class.word();
        diagnostics.push(
            Diagnostic::new(
                codes::REGISTER_AGAINST_CLASS,
                first.span,
                format!("{code:04X}h is an error of the class `{word}`, and its bits in 1001h are others"),
            )
            .with(decl.codes.span, "the class is in the code")
            .help(format!("add `{word}`, or give the error a code of another class")),
        );
    }
    kinds
}

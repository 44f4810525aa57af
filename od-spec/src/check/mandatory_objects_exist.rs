//! Every device has 1000h, 1001h and 1018h.

use crate::diag::{Code, Diagnostic, Diagnostics};
use crate::model::{Dictionary, Index};
use crate::source::Span;

pub(super) fn check(device: &Dictionary, diagnostics: &mut Diagnostics) {
    let missing: Vec<String> = [0x1000, 0x1001, 0x1018]
        .map(Index)
        .into_iter()
        .filter(|index| !device.objects.contains_key(index))
        .map(|index| index.to_string())
        .collect();
    if let (false, Some(span)) = (missing.is_empty(), first_place(device)) {
        diagnostics.push(
            Diagnostic::new(Code::MandatoryMissing, span, format!("`{}` lacks {}", device.key, missing.join(", ")))
                .help("add `uses: [cia301]` at the top of the specification"),
        );
    }
}

/// Some place of the device's dictionary, to hang a message on that is about what is not there.
pub(super) fn first_place(device: &Dictionary) -> Option<Span> {
    device.objects.values().next().map(|object| object.span)
}

//! Every device has 1000h, 1001h and 1018h.

use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{Dictionary, Index};

pub(super) fn check(device: &Dictionary, diagnostics: &mut Diagnostics) {
    let missing: Vec<String> = [0x1000, 0x1001, 0x1018]
        .map(Index)
        .into_iter()
        .filter(|index| !device.objects.contains_key(index))
        .map(|index| index.to_string())
        .collect();
    if !missing.is_empty() {
        diagnostics.push(
            Diagnostic::new(
                codes::MANDATORY_MISSING,
                device.span,
                format!("`{}` lacks {}", device.key, missing.join(", ")),
            )
            .help("add `uses: [cia301]` at the top of the specification"),
        );
    }
}

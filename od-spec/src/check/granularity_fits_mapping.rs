//! Granularity 0 means "no mapping can be changed", and nothing else does.

use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::Dictionary;

pub(super) fn check(device: &Dictionary, diagnostics: &mut Diagnostics) {
    let Some(first) = device.pdos.first() else { return };
    let granularity = device.info.granularity;
    let variable = device.pdos.iter().find(|pdo| pdo.variable_mapping);
    let problem = match (granularity, variable) {
        (0, Some(pdo)) => Some((pdo.span, "granularity is 0, but this mapping can be changed")),
        (1.., None) => Some((first.span, "granularity is not 0, but no mapping can be changed")),
        _ => None,
    };
    if let Some((span, message)) = problem {
        diagnostics.push(
            Diagnostic::new(codes::GRANULARITY_MISMATCH, span, format!("`{}`: {message}", device.key))
                .help("correct the device's `granularity:`, or `mapping:` of the PDOs"),
        );
    }
}

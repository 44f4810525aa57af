//! Tools disagree about how a REAL value is written in an EDS.

use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{Dictionary, Value};

pub(super) fn check(device: &Dictionary, diagnostics: &mut Diagnostics) {
    for (id, _, entry) in device.entries() {
        if matches!(entry.default, Some(Value::Real(_))) && entry.eds.default {
            diagnostics.push(
                Diagnostic::new(codes::REAL_DEFAULT, entry.span, format!("PLC tools may misread the default of {id}"))
                    .help("withhold it from the EDS with `eds: {default: withheld}`, or scale the value to an integer"),
            );
        }
    }
}

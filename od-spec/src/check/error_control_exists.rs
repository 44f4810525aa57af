//! A device has heartbeat or node guarding (CiA 301, categories of 100Ch and 1017h).

use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{Dictionary, Index};

pub(super) fn check(device: &Dictionary, diagnostics: &mut Diagnostics) {
    let has = |index: u16| device.objects.contains_key(&Index(index));
    let guarding = has(0x100C) && has(0x100D);
    if !guarding && !has(0x1017) {
        diagnostics.push(
            Diagnostic::new(
                codes::NO_ERROR_CONTROL,
                device.span,
                format!("`{}` has neither heartbeat (1017h) nor node guarding (100Ch, 100Dh)", device.key),
            )
            .help("add the feature `heartbeat producer` of `cia301`"),
        );
    }
}

//! LSS needs the serial number, 1018h.4.

use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{Dictionary, Index, SubIndex};

pub(super) fn check(device: &Dictionary, diagnostics: &mut Diagnostics) {
    let identity = device.objects.get(&Index(0x1018));
    if let (true, Some(identity)) = (device.info.lss, identity)
        && identity.entry(SubIndex(4)).is_none()
    {
        diagnostics.push(
            Diagnostic::new(
                codes::LSS_WITHOUT_SERIAL,
                identity.span,
                format!("`{}` supports LSS, but 1018h has no serial number", device.key),
            )
            .help("add sub-index 4 to 1018h, or remove `lss: yes`"),
        );
    }
}

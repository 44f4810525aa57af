//! Objects lie in the areas that CiA 301 table 1 gives them.

use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::Dictionary;

pub(super) fn check(device: &Dictionary, diagnostics: &mut Diagnostics) {
    for object in device.objects.values() {
        let area = match object.index.0 {
            0x0000..=0x0FFF => "the area of data types",
            0xC000.. => "a reserved area",
            _ => continue,
        };
        diagnostics.push(
            Diagnostic::new(codes::INDEX_AREA, object.span, format!("{} lies in {area}", object.index))
                .help("1000h to 1FFFh: communication; 2000h to 5FFFh: manufacturer; 6000h to 9FFFh: device profiles; A000h to BFFFh: network variables"),
        );
    }
}

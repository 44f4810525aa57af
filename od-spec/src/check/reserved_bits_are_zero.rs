//! Defaults leave reserved bits at 0.

use super::own_place;
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{BitUsage, Dictionary, TypeKind, Value};

pub(super) fn check(device: &Dictionary, diagnostics: &mut Diagnostics) {
    for (id, _, entry) in device.entries() {
        let Some(TypeKind::Bits(fields)) = entry.named_type.as_ref().map(|named| &named.kind) else {
            continue;
        };
        let Some(raw) = entry.default.as_ref().and_then(Value::integer) else { continue };
        let set = |bit: u8| raw.checked_shr(u32::from(bit)).unwrap_or(0) & 1 == 1;
        let reserved = fields.iter().filter(|field| field.usage == BitUsage::Reserved);
        let special = entry.special.iter().any(|special| special.value == raw);
        if let Some(bit) =
            reserved.flat_map(|field| field.first..=field.last).find(|bit| set(*bit) && !special)
        {
            diagnostics.push(
                Diagnostic::new(
                    codes::RESERVED_BIT_SET,
                    own_place(device, entry.span),
                    format!("the default of {id} sets bit {bit}, which is reserved"),
                )
                .help("correct the default, or say what the bit means"),
            );
        }
    }
}

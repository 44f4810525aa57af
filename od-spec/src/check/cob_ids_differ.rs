//! PDOs that are valid after start-up have COB-IDs of their own.

use crate::diag::{Code, Diagnostic, Diagnostics};
use crate::model::{Dictionary, Pdo, Value};

pub(super) fn check(device: &Dictionary, diagnostics: &mut Diagnostics) {
    let valid: Vec<&Pdo> = device.pdos.iter().filter(|pdo| pdo.valid).collect();
    for (at, pdo) in valid.iter().enumerate() {
        for other in &valid[at + 1..] {
            if identifier(pdo) == identifier(other) {
                let name = |pdo: &Pdo| format!("{} {}", pdo.direction.pdo(), pdo.number);
                diagnostics.push(
                    Diagnostic::new(
                        Code::CobIdClash,
                        other.span,
                        format!("{} and {} of `{}` have one COB-ID", name(pdo), name(other), device.key),
                    )
                    .label(name(other))
                    .with(pdo.span, name(pdo))
                    .help("give one of them another `cob-id:`, or make it `valid: no`"),
                );
            }
        }
    }
}

/// The COB-ID without flag bits, and whether the node-ID is added.
fn identifier(pdo: &Pdo) -> (bool, i128) {
    match pdo.cob_id {
        Value::NodeId(offset) => (true, i128::from(offset & 0x1FFF_FFFF)),
        Value::Integer(raw) => (false, raw & 0x1FFF_FFFF),
        _ => (false, -1),
    }
}

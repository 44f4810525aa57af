//! PDOs that are valid after start-up have COB-IDs of their own.

use crate::diag::{Code, Diagnostic, Diagnostics};
use crate::model::{Dictionary, Pdo, Value};

pub(super) fn check(device: &Dictionary, diagnostics: &mut Diagnostics) {
    let valid: Vec<&Pdo> = device.pdos.iter().filter(|pdo| pdo.valid).collect();
    for (at, pdo) in valid.iter().enumerate() {
        for other in &valid[at + 1..] {
            if let Some(node) = clash(&pdo.cob_id, &other.cob_id) {
                let of_node = match (&pdo.cob_id, &other.cob_id) {
                    (Value::Integer(_), Value::Integer(_)) | (Value::NodeId(_), Value::NodeId(_)) => {
                        String::new()
                    }
                    _ => format!(" on node {node}"),
                };
                let name = |pdo: &Pdo| format!("{} {}", pdo.direction.pdo(), pdo.number);
                diagnostics.push(
                    Diagnostic::new(
                        Code::CobIdClash,
                        other.span,
                        format!(
                            "{} and {} of `{}` have one COB-ID{of_node}",
                            name(pdo),
                            name(other),
                            device.key
                        ),
                    )
                    .label(name(other))
                    .with(pdo.span, name(pdo))
                    .help("give one of them another `cob-id:`, or make it `valid: no`"),
                );
            }
        }
    }
}

/// The first node on which two COB-IDs are equal, whatever their flag bits.
fn clash(one: &Value, other: &Value) -> Option<u8> {
    let identifier = |value: &Value, node| value.integer_for(node).map(|raw| raw & 0x1FFF_FFFF);
    (1..=127).find(|node| identifier(one, *node).is_some_and(|id| identifier(other, *node) == Some(id)))
}

//! PDOs that are valid after start-up have COB-IDs of their own.

use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{Dictionary, EntryId, Index, Pdo, SubIndex, Value};

pub(super) fn check(device: &Dictionary, diagnostics: &mut Diagnostics) {
    let valid: Vec<&Pdo> = device.pdos.iter().filter(|pdo| pdo.valid).collect();
    for (at, pdo) in valid.iter().enumerate() {
        check_services(device, pdo, diagnostics);
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
                        codes::COB_ID_CLASH,
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

/// Services of the device whose COB-IDs a PDO must leave alone: index and name.
const SERVICES: [(u16, &str); 3] = [(0x1005, "SYNC"), (0x1012, "TIME"), (0x1014, "EMCY")];

fn check_services(device: &Dictionary, pdo: &Pdo, diagnostics: &mut Diagnostics) {
    for (index, service) in SERVICES {
        let id = EntryId { index: Index(index), sub: SubIndex(0) };
        let Some(own) = device.entry(id).and_then(|entry| entry.default.as_ref()) else { continue };
        if clash(&pdo.cob_id, own).is_some() {
            diagnostics.push(
                Diagnostic::new(
                    codes::COB_ID_CLASH,
                    pdo.span,
                    format!(
                        "{} {} of `{}` has the COB-ID of {service} ({id})",
                        pdo.direction.pdo(),
                        pdo.number,
                        device.key
                    ),
                )
                .help("give the PDO another `cob-id:`"),
            );
        }
    }
}

/// The first node on which two COB-IDs are equal, whatever their flag bits.
fn clash(one: &Value, other: &Value) -> Option<u8> {
    let identifier = |value: &Value, node| value.integer_for(node).map(|raw| raw & 0x1FFF_FFFF);
    (1..=127).find(|node| identifier(one, *node).is_some_and(|id| identifier(other, *node) == Some(id)))
}

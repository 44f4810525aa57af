//! What can be mapped has a PDO to be mapped into.

use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{Dictionary, Direction, Origin};

pub(super) fn check(device: &Dictionary, diagnostics: &mut Diagnostics) {
    for direction in [Direction::Receive, Direction::Transmit] {
        if device.pdos_of(direction).next().is_some() {
            continue;
        }
        let mappable = device.entries().filter(|(_, object, _)| object.origin == Origin::Manual);
        if let Some((id, _, entry)) = mappable.into_iter().find(|(.., entry)| entry.pdo.allows(direction)) {
            diagnostics.push(
                Diagnostic::new(
                    codes::NO_PDO,
                    entry.span,
                    format!("{id} can be mapped into {}s, but `{}` has none", direction.pdo(), device.key),
                )
                .help(format!("describe the device's {}s under `pdos:`", direction.pdo())),
            );
        }
    }
}

//! A case as SDO downloads into the generated dictionary.

use firmware_glue::{AbortCode, Constrained as _, Dictionary as _};
use od_spec::model::{Dictionary, EntryId, System, download};

use crate::agreement::NODE;
use crate::agreement::case::{Case, Said, Set};

#[allow(
    clippy::all,
    clippy::pedantic,
    reason = "what users' lints say about generated code is tested with od-generated"
)]
mod generated {
    od_macros::object_dictionary!("shared/agreement.od.yaml");
}

use generated::Plant;

/// One SDO download.
struct Download {
    id: EntryId,
    bytes: Vec<u8>,
}

pub(crate) fn said(system: &System, case: &Case) -> Said {
    let device = &system.devices[0];
    let mut plant = Plant::new(NODE);
    for Download { id, bytes } in downloads(system, case) {
        let outcome = plant.write_consistent(id.index.0, id.sub.0, &bytes, &mut ());
        if let Err(abort) = outcome {
            // What prepares the value, and what is next to it, is right.
            assert_eq!(id, case.set[0].id, "{}: {abort}", case.title());
            return Said::Aborted(abort);
        }
    }
    for set in &case.set {
        let held = plant.read(set.id.index.0, set.id.sub.0).map(|value| value.to_vec());
        // What can only be written shows nothing.
        let is_readable = device.entry(set.id).unwrap().access.is_readable();
        let expected = if is_readable { Ok(bytes(device, set)) } else { Err(AbortCode::WRITE_ONLY) };
        assert_eq!(held, expected, "{}: {}", case.title(), set.id);
    }
    Said::Accepted
}

fn bytes(device: &Dictionary, set: &Set) -> Vec<u8> {
    let entry = device.entry(set.id).unwrap_or_else(|| panic!("there is no entry {}", set.id));
    set.raw.bytes(entry.data_type)
}

/// The downloads in the order that a device needs; a value that its type does not have is downloaded as it is, last.
fn downloads(system: &System, case: &Case) -> Vec<Download> {
    let device = &system.devices[0];
    let values = case.set.iter().map(|set| (set.id, set.raw.value())).collect();
    match download(system, device, &values, NODE) {
        Ok(writes) => writes.into_iter().map(|write| Download { id: write.id, bytes: write.bytes }).collect(),
        Err(_) => {
            let direct = |set: &Set| Download { id: set.id, bytes: bytes(device, set) };
            case.set.iter().rev().map(direct).collect()
        }
    }
}

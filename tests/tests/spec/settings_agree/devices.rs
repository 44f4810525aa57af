//! The devices: what a specification says, and the generated dictionary.

use firmware_glue::{AbortCode, Constrained, Dictionary};
use od_generated::fullmo::Fullmo;
use od_generated::pmc::Pmc;
use od_generated::pmm::Pmm;
use od_spec::model::EntryId;

#[allow(
    clippy::all,
    clippy::pedantic,
    reason = "what users' lints say about generated code is tested with od-generated"
)]
mod agreement {
    od_macros::object_dictionary!("shared/agreement.od.yaml");
}

#[allow(
    clippy::all,
    clippy::pedantic,
    reason = "what users' lints say about generated code is tested with od-generated"
)]
mod everything {
    od_macros::object_dictionary!("readers/everything.od.yaml");
}

#[allow(
    clippy::all,
    clippy::pedantic,
    reason = "what users' lints say about generated code is tested with od-generated"
)]
mod bench {
    od_macros::object_dictionary!("shared/settings.od.yaml");
}

/// A node that is not unlocked for service.
pub(crate) trait Node {
    fn write(&mut self, id: EntryId, data: &[u8]) -> Result<(), AbortCode>;
    fn read(&self, id: EntryId) -> Result<Vec<u8>, AbortCode>;
}

impl<D: Constrained> Node for D {
    fn write(&mut self, id: EntryId, data: &[u8]) -> Result<(), AbortCode> {
        self.write_consistent(id.index.0, id.sub.0, data, &mut ()).map(drop)
    }

    fn read(&self, id: EntryId) -> Result<Vec<u8>, AbortCode> {
        Dictionary::read(self, id.index.0, id.sub.0).map(|value| value.to_vec())
    }
}

/// A node of a device without conditions between its entries.
struct Unconditional<D>(D);

impl<D: Dictionary<'static>> Node for Unconditional<D> {
    fn write(&mut self, id: EntryId, data: &[u8]) -> Result<(), AbortCode> {
        self.0.write(id.index.0, id.sub.0, data, &mut ()).map(drop)
    }

    fn read(&self, id: EntryId) -> Result<Vec<u8>, AbortCode> {
        self.0.read(id.index.0, id.sub.0).map(|value| value.to_vec())
    }
}

/// A device of a specification.
pub(crate) struct Device {
    pub(crate) specification: &'static str,
    pub(crate) key: &'static str,
    /// How many configurations are tried.
    pub(crate) rounds: u64,
    pub(crate) new: fn(u8) -> Box<dyn Node>,
}

const PITCH: &str = "od-spec/devices/pitch-control-system.od.yaml";

pub(crate) const DEVICES: &[Device] = &[
    Device { specification: PITCH, key: "pmc", rounds: 60, new: |node| Box::new(Pmc::new(node)) },
    Device { specification: PITCH, key: "pmm", rounds: 60, new: |node| Box::new(Pmm::new(node)) },
    Device {
        specification: "od-spec/devices/fullmo-drive.od.yaml",
        key: "fullmo",
        rounds: 60,
        new: |node| Box::new(Fullmo::new(node)),
    },
    Device {
        specification: "tests/readers/everything.od.yaml",
        key: "everything",
        rounds: 150,
        new: |node| Box::new(Unconditional(everything::Everything::new(node))),
    },
    Device {
        specification: "tests/shared/agreement.od.yaml",
        key: "plant",
        rounds: 250,
        new: |node| Box::new(agreement::Plant::new(node)),
    },
    Device {
        specification: "tests/shared/settings.od.yaml",
        key: "bench",
        rounds: 800,
        new: |node| Box::new(bench::Bench::new(node)),
    },
];

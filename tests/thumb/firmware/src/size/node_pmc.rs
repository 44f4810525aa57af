//! A whole node with the PMC: SDO server, PDOs, NMT, heartbeat, emergencies with their history, parameters in a flash.
#![no_std]
#![no_main]

use core::hint::black_box;

use embedded_storage::nor_flash::{ErrorType, NorFlash, NorFlashErrorKind, ReadNorFlash};
use firmware_glue::lss::LssHandler;
use firmware_glue::node::{NodeHandler, Reset};
use firmware_glue::pdo::engine::PdoHandler;
use firmware_glue::storage::{ALL, Command, ParameterStore};
use firmware_glue::{AbortCode, Application, NodeId};
use od_generated::pmc::Pmc as Device;

/// A flash that is somewhere else.
struct Flash;

impl ErrorType for Flash {
    type Error = NorFlashErrorKind;
}

impl ReadNorFlash for Flash {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Self::Error> {
        black_box((offset, bytes));
        black_box(Ok(()))
    }

    fn capacity(&self) -> usize {
        8192
    }
}

impl NorFlash for Flash {
    const WRITE_SIZE: usize = 8;
    const ERASE_SIZE: usize = 4096;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), Self::Error> {
        black_box((from, to));
        black_box(Ok(()))
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Self::Error> {
        black_box((offset, bytes));
        black_box(Ok(()))
    }
}

/// What a drive does in addition to driving.
struct Drive {
    store: Option<ParameterStore<Flash, 64>>,
}

const DRIVE: Drive = Drive { store: None };

impl Application<Device> for Drive {
    fn is_unlocked(&self) -> bool {
        black_box(false)
    }

    fn command(&mut self, od: &mut Device, command: Command) -> Result<(), AbortCode> {
        let store = self.store.as_mut().ok_or(AbortCode::HARDWARE)?;
        store.command(od, command).map(drop).map_err(AbortCode::from)
    }
}

impl PdoHandler<Device> for Drive {}

impl LssHandler for Drive {}

impl NodeHandler<Device> for Drive {
    fn restart(&mut self, od: &mut Device, node: NodeId, reset: Reset) {
        if reset == Reset::Node {
            self.store = ParameterStore::new(Flash, 0, 4096).ok();
        }
        if let Some(store) = &mut self.store {
            store.load(od, node, &ALL);
        }
    }
}

#[path = "../shared/node.rs"]
mod program;

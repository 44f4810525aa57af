//! canopen-rs: a `heapless::LinearMap` from addresses to values with their type, searched from its start.

use std::hint::black_box;

use canopen_rs::pdo::{pack, unpack};
use canopen_rs::{Address, MappingEntry, ObjectDictionary, PdoMapping, Value};

use crate::{Dictionary, Model};

pub struct CanopenRs<const N: usize> {
    od: ObjectDictionary<N>,
    transmit: PdoMapping<8>,
    receive: PdoMapping<8>,
}

impl<const N: usize> CanopenRs<N> {
    pub fn new(model: &Model, od: ObjectDictionary<N>) -> Box<Self> {
        // what `Node::configure_pdos_from_od` does
        let [setpoint, position, speed] = model.mapped;
        let mapping = |second| {
            let mut mapping = PdoMapping::new();
            for (index, bits) in [(setpoint, 16), (second, 32)] {
                let entry = MappingEntry::new(index, 0, bits);
                mapping.push(entry).expect("two entries fit");
            }
            mapping
        };
        Box::new(Self { od, transmit: mapping(position), receive: mapping(speed) })
    }
}

/// The dictionary of one model.
macro_rules! dictionary {
    ($name:ident, $model:expr) => {
        $crate::canopen_rs::CanopenRs::new($model, bench_canopen_rs::$name::device_od())
    };
}
pub(crate) use dictionary;

impl<const N: usize> Dictionary for CanopenRs<N> {
    const NAME: &str = "canopen-rs";

    fn read(&self, index: u16, sub: u8) -> Option<[u8; 2]> {
        let mut bytes = [0; 2];
        let value = self.od.read(Address::new(index, sub)).ok()?;
        (value.encode_le(&mut bytes) == Ok(bytes.len())).then_some(bytes)
    }

    fn write(&mut self, index: u16, sub: u8, bytes: [u8; 2]) -> bool {
        // the steps of `SdoServer::on_download_initiate`
        let address = Address::new(index, sub);
        let Some(entry) = self.od.entry(address) else { return false };
        let kind = entry.value.data_type();
        if !entry.access.is_writable() || kind.fixed_size() != Some(bytes.len()) {
            return false;
        }
        let Ok(value) = Value::decode_le(kind, &bytes) else { return false };
        self.od.write(address, value).is_ok()
    }

    fn find(&self, index: u16, sub: u8) -> bool {
        black_box(self.od.entry(Address::new(index, sub))).is_some()
    }

    fn setpoint(&self) -> Option<u16> {
        None
    }

    fn pack(&mut self, frame: &mut [u8; 8]) -> Option<usize> {
        pack(&self.transmit, &self.od, frame).ok()
    }

    fn unpack(&mut self, frame: &[u8]) -> Option<()> {
        unpack(&self.receive, &mut self.od, frame).ok()
    }
}

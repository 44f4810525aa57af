//! zencan-node: a sorted table of objects called through `dyn`, entries found by each object's own method.

use std::hint::black_box;

use zencan_node::common::NodeId;
use zencan_node::object_dict::{ODEntry, find_object};
use zencan_node::pdo::Pdo;

use crate::Dictionary;

pub struct Zencan<F> {
    table: &'static [ODEntry<'static>],
    tpdo: &'static Pdo<'static>,
    rpdo: &'static Pdo<'static>,
    setpoint: F,
}

impl<F: Fn() -> u16> Zencan<F> {
    pub fn new(
        table: &'static [ODEntry<'static>],
        tpdo: &'static Pdo<'static>,
        rpdo: &'static Pdo<'static>,
        setpoint: F,
    ) -> Self {
        // what `Node::new` does
        let node = NodeId::new(5).expect("5 is a node-ID");
        tpdo.init_defaults(node);
        rpdo.init_defaults(node);
        Self { table, tpdo, rpdo, setpoint }
    }
}

/// The dictionary of one model, with the name of its first setpoint. It is static: there is one in a program.
macro_rules! dictionary {
    ($model:ident, $setpoint:ident) => {{
        use bench_zencan::$model::{OD_TABLE, RPDOS, TPDOS, $setpoint};
        $crate::zencan::Zencan::new(&OD_TABLE, &TPDOS[0], &RPDOS[0], || $setpoint.get_value())
    }};
}
pub(crate) use dictionary;

impl<F: Fn() -> u16> Dictionary for Zencan<F> {
    const NAME: &str = "zencan";

    fn read(&self, index: u16, sub: u8) -> Option<[u8; 2]> {
        // a buffer longer than the value, as that of zencan's SDO server
        let mut buffer = [0; 8];
        let length = find_object(self.table, index)?.read(sub, 0, &mut buffer).ok()?;
        buffer[..length].try_into().ok()
    }

    fn write(&mut self, index: u16, sub: u8, bytes: [u8; 2]) -> bool {
        // the steps of zencan's SDO server (`SdoState::idle`), which is not public
        let Some(object) = find_object(self.table, index) else { return false };
        let Ok(info) = object.sub_info(sub) else { return false };
        if !info.access_type.is_writable() || info.data_type.is_str() || info.size != bytes.len() {
            return false;
        }
        object.write(sub, &bytes).is_ok()
    }

    fn find(&self, index: u16, sub: u8) -> bool {
        find_object(self.table, index).and_then(|object| black_box(object.sub_info(sub)).ok()).is_some()
    }

    fn setpoint(&self) -> Option<u16> {
        Some((self.setpoint)())
    }

    fn pack(&mut self, frame: &mut [u8; 8]) -> Option<usize> {
        // the steps of `Pdo::send_pdo`, which is not public, up to the buffer of the CAN driver
        let mut offset = 0;
        let valid = usize::from(self.tpdo.valid_maps.load());
        for mapped in self.tpdo.mapping_params.iter().take(valid) {
            let Some(entry) = mapped.load() else { break };
            let length = usize::from(entry.length);
            if offset + length > frame.len() {
                break;
            }
            entry.object.data.read(entry.sub, 0, &mut frame[offset..offset + length]).ok();
            offset += length;
        }
        Some(offset)
    }

    fn unpack(&mut self, frame: &[u8]) -> Option<()> {
        // the steps of `Pdo::store_pdo_data`, which is not public
        let mut offset = 0;
        let valid = usize::from(self.rpdo.valid_maps.load());
        for mapped in self.rpdo.mapping_params.iter().take(valid) {
            let Some(entry) = mapped.load() else { break };
            let length = usize::from(entry.length);
            if offset + length > frame.len() {
                break;
            }
            entry.object.data.write(entry.sub, &frame[offset..offset + length]).ok();
            offset += length;
        }
        Some(())
    }
}

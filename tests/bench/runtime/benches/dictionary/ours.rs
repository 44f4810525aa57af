//! Ours: a byte image and a constant table.

use std::hint::black_box;

use firmware_glue::Dictionary as _;
use firmware_glue::pdo::{Rpdo, Tpdo};

const NODE: u8 = 5;

macro_rules! models {
    ($($feature:literal $model:ident),*) => {$(
        #[cfg(feature = $feature)]
        pub mod $model {
            use super::*;
            use bench_ours::$model::{Controller, pdos::Tpdo1};

            /// The PDOs are kept, as the engine of a node keeps them.
            pub struct Ours(Controller, Tpdo, Rpdo);

            pub fn dictionary() -> Ours {
                let od = Controller::new(NODE);
                let (tpdo, rpdo) = (Tpdo::new(od.table(), 1), Rpdo::new(od.table(), 1));
                Ours(od, tpdo.expect("there is TPDO 1"), rpdo.expect("there is RPDO 1"))
            }

            impl crate::Dictionary for Ours {
                const NAME: &str = "ours";

                fn read(&self, index: u16, sub: u8) -> Option<[u8; 2]> {
                    self.0.read(index, sub).ok()?[..].try_into().ok()
                }

                fn write(&mut self, index: u16, sub: u8, bytes: [u8; 2]) -> bool {
                    self.0.write(index, sub, &bytes, &mut ()).is_ok()
                }

                fn find(&self, index: u16, sub: u8) -> bool {
                    // with access and size, which the peers' lookups give
                    black_box(self.0.info_at(index, sub)).is_ok()
                }

                fn setpoint(&self) -> Option<u16> {
                    Some(self.0.channel_1_setpoint())
                }

                fn pack(&mut self, frame: &mut [u8; 8]) -> Option<usize> {
                    let packed = self.1.pack(&mut self.0, &mut ()).ok()?;
                    frame[..packed.len()].copy_from_slice(&packed);
                    Some(packed.len())
                }

                fn pack_default(&self) -> Option<[u8; crate::model::PDO_SIZE]> {
                    Some(Tpdo1::of(&self.0).pack())
                }

                fn unpack(&mut self, frame: &[u8]) -> Option<()> {
                    self.2.unpack(&mut self.0, frame, &mut ()).ok().map(drop)
                }
            }
        }
    )*};
}

models!(
    "size150" size150,
    "size2000" size2000,
    "size10000" size10000,
    "gappy150" gappy150,
    "gappy2000" gappy2000,
    "gappy10000" gappy10000,
    "pmc" pmc,
    "pmm" pmm
);

//! A node that is `pmm`.
#![no_std]
#![no_main]

use panic_halt as _;

#[allow(dead_code)]
mod device {
    include!(concat!(env!("OUT_DIR"), "/pmm.rs"));
}

#[cortex_m_rt::entry]
fn main() -> ! {
    thumb_node::serve::<_, { device::Pmm::LARGEST_VALUE }>(device::Pmm::new(thumb_node::NODE))
}

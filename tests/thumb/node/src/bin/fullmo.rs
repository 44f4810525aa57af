//! A node that is `fullmo`.
#![no_std]
#![no_main]

use panic_halt as _;

#[allow(dead_code)]
mod device {
    include!(concat!(env!("OUT_DIR"), "/fullmo.rs"));
}

#[cortex_m_rt::entry]
fn main() -> ! {
    thumb_node::serve::<_, { device::Fullmo::LARGEST_VALUE }>(device::Fullmo::new(thumb_node::NODE))
}

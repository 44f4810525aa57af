//! A node that is `everything`.
#![no_std]
#![no_main]

use panic_halt as _;

#[allow(dead_code)]
mod device {
    include!(concat!(env!("OUT_DIR"), "/everything.rs"));
}

#[cortex_m_rt::entry]
fn main() -> ! {
    thumb_node::serve::<_, { device::Everything::LARGEST_VALUE }>(device::Everything::new(thumb_node::NODE))
}

// A node that is measured: frames come from outside, and what it says leaves it. `Device` is its dictionary, `Drive` its application.

use core::hint::black_box;

use cortex_m_rt::entry;
use firmware_glue::clock::Instant;
use firmware_glue::emcy::Emergency;
use firmware_glue::frame::Frame;
use firmware_glue::node::{Room, UpTo};
use firmware_glue::{Dictionary as _, Late, Node, NodeId};
use panic_halt as _;

use super::{DRIVE, Device, Drive};

type Whole = Node<[u8; Device::LARGEST_VALUE], 4, 4, 8, 2>;

static FRAME: Option<Frame> = None;
static ERROR: Option<u16> = None;

#[entry]
fn main() -> ! {
    // `entry` hands them out as `&'static mut`.
    static mut DICTIONARY: Late<Device> = Late::Empty;
    static mut NODE: Late<Whole> = Late::Empty;
    static mut APPLICATION: Drive = DRIVE;
    // At run time: a static with values has them in flash a second time.
    DICTIONARY.make(Device::new(1));
    let id = NodeId::new(black_box(5));
    let sdo_buffer = [0; Device::LARGEST_VALUE];
    let room = Room { tpdos: UpTo, rpdos: UpTo, errors: UpTo, watched: UpTo, sdo_buffer };
    if let Some(node) = DICTIONARY.made().and_then(|dictionary| Node::new(dictionary.table(), id, room).ok())
    {
        NODE.make(node);
    }
    loop {
        // By reference, as a firmware passes them on: else the address of each field is a constant of its own.
        let (Some(node), Some(dictionary)) = (black_box(NODE.made()), black_box(DICTIONARY.made())) else {
            continue;
        };
        let now = black_box(Instant::ZERO);
        if let Some(frame) = black_box(&FRAME) {
            black_box(node.handle(frame, dictionary, APPLICATION, now));
        }
        if let Some(code) = black_box(ERROR) {
            black_box(node.raise(dictionary, Emergency::new(code)));
            black_box(node.clear(dictionary, code));
        }
        black_box(node.poll(dictionary, APPLICATION, now));
        black_box(node.next_deadline(dictionary));
    }
}

//! A node with what the PMC of the demo firmware has not: strings that can be written, DOMAINs, numbers of 24 to 64 bits, SYNC, LSS, nodes
//! that it watches. tests/thumb/demo.py speaks to it as to the demo firmware, whose drivers it has.
#![no_std]
#![no_main]

#[path = "../../../../firmware-glue/examples/pitch-controller/src/clock.rs"]
mod clock;
#[path = "../../../../firmware-glue/examples/pitch-controller/src/slcan.rs"]
mod slcan;
#[path = "../../../../firmware-glue/examples/pitch-controller/src/uart.rs"]
mod uart;

#[allow(dead_code)]
mod everything {
    include!(concat!(env!("OUT_DIR"), "/everything.rs"));
}

use cortex_m_rt::entry;
use embedded_can::nb::Can;
use everything::{Entry, Everything};
use firmware_glue::frame::Frame;
use firmware_glue::lss::{BitRate, LssHandler, MaybeNode, Reply};
use firmware_glue::node::NodeHandler;
use firmware_glue::pdo_engine::PdoHandler;
use firmware_glue::{AbortCode, Application, Dictionary, Node, NodeId};
use panic_halt as _;

/// A DOMAIN in memory.
struct Bench {
    bytes: [u8; 2048],
    length: usize,
}

impl Application<Everything> for Bench {
    fn read_domain(
        &mut self,
        _: &mut Everything,
        entry: Entry,
        offset: u32,
        buffer: &mut [u8],
    ) -> Result<usize, AbortCode> {
        let is_there = entry == Entry::ADomain && self.length > 0;
        let whole = self.bytes.get(..self.length).filter(|_| is_there).ok_or(AbortCode::NO_DATA)?;
        let rest = usize::try_from(offset).ok().and_then(|offset| whole.get(offset..)).unwrap_or_default();
        let count = rest.len().min(buffer.len());
        buffer.iter_mut().zip(rest).for_each(|(to, from)| *to = *from);
        Ok(count)
    }

    fn write_domain(
        &mut self,
        _: &mut Everything,
        _: Entry,
        offset: u32,
        data: &[u8],
        last: bool,
    ) -> Result<(), AbortCode> {
        let offset = usize::try_from(offset).map_err(|_| AbortCode::OUT_OF_MEMORY)?;
        let end = offset.checked_add(data.len()).ok_or(AbortCode::OUT_OF_MEMORY)?;
        let place = self.bytes.get_mut(offset..end).ok_or(AbortCode::OUT_OF_MEMORY)?;
        place.iter_mut().zip(data).for_each(|(to, from)| *to = *from);
        // Until it is whole, there is none.
        self.length = if last { end } else { 0 };
        Ok(())
    }
}

impl PdoHandler<Everything> for Bench {}

impl NodeHandler<Everything> for Bench {}

impl LssHandler for Bench {
    fn has_bit_rate(&self, _: BitRate) -> bool {
        true
    }

    fn store(&mut self, _: MaybeNode, _: Option<BitRate>) -> Reply {
        Reply::Done
    }
}

#[entry]
fn main() -> ! {
    static mut BENCH: Bench = Bench { bytes: [0; 2048], length: 0 };

    if let Some(core) = cortex_m::Peripherals::take() {
        run(slcan::Slcan::new(uart::Uart::Frames.open()), clock::Clock::start(core.SYST), BENCH);
    }
    loop {
        cortex_m::asm::wfi();
    }
}

fn run<C: Can>(mut can: C, mut clock: clock::Clock, bench: &mut Bench) {
    let mut od = Everything::new(5);
    let buffer = [0; Everything::LARGEST_VALUE];
    let Ok(mut node) = Node::<_, 4, 4, 8, 4>::new(od.table(), NodeId::new(5), buffer) else { return };
    let mut waiting: Option<Frame> = None;
    loop {
        let now = clock.now();
        while let Some(frame) = waiting.take().or_else(|| node.poll(&mut od, bench, now)) {
            let Some(message) = frame.for_driver() else { continue };
            if can.transmit(&message).is_err() {
                waiting = Some(frame);
                break;
            }
        }
        if waiting.is_none() {
            match can.receive() {
                Ok(message) => {
                    let frame = Frame::of_driver(&message);
                    waiting = frame.and_then(|frame| node.handle(&frame, &mut od, bench, now));
                }
                Err(_) => cortex_m::asm::wfi(),
            }
        }
    }
}

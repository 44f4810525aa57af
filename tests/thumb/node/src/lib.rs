//! A node for any dictionary: it stores parameters and keeps a DOMAIN, and does nothing else. tests/thumb/demo.py speaks to it as to the demo
//! firmware, whose drivers it has; with dictionaries of other devices, among them one with every data type and service.
#![no_std]

#[path = "../../../../firmware-glue/examples/pitch-controller/src/clock.rs"]
mod clock;
#[path = "../../../../firmware-glue/examples/pitch-controller/src/flash.rs"]
mod flash;
#[path = "../../../../firmware-glue/examples/pitch-controller/src/slcan.rs"]
mod slcan;
#[path = "../../../../firmware-glue/examples/pitch-controller/src/uart.rs"]
mod uart;

use embedded_can::nb::Can;
use firmware_glue::frame::Frame;
use firmware_glue::lss::{BitRate, LssHandler, MaybeNode, Reply};
use firmware_glue::node::{NodeHandler, Reset, Room, UpTo};
use firmware_glue::pdo::engine::PdoHandler;
use firmware_glue::storage::{ALL, Command, ParameterStore};
use firmware_glue::{AbortCode, Application, Dictionary, EntryId, Node, NodeId, Storage};

/// The node-ID of all.
pub const NODE: u8 = 5;
/// The DOMAIN that is kept, of the device with everything.
const DOMAIN: EntryId = EntryId { index: 0x2018, sub: 0 };

/// The application.
struct Bench<'m> {
    store: ParameterStore<flash::RamFlash<'m>, 64>,
    domain: [u8; 2048],
    length: usize,
}

impl<D: Dictionary<'static>> Application<D> for Bench<'_> {
    fn command(&mut self, od: &mut D, command: Command) -> Result<(), AbortCode> {
        self.store.command(od, command).map(drop).map_err(AbortCode::from)
    }

    fn read_domain(
        &mut self,
        od: &mut D,
        entry: D::Entry,
        offset: u32,
        buffer: &mut [u8],
    ) -> Result<usize, AbortCode> {
        let is_there = od.table().id(od.row(entry)) == DOMAIN && self.length > 0;
        let whole = self.domain.get(..self.length).filter(|_| is_there).ok_or(AbortCode::NO_DATA)?;
        let rest = usize::try_from(offset).ok().and_then(|offset| whole.get(offset..)).unwrap_or_default();
        let count = rest.len().min(buffer.len());
        buffer.iter_mut().zip(rest).for_each(|(to, from)| *to = *from);
        Ok(count)
    }

    fn write_domain(
        &mut self,
        _: &mut D,
        _: D::Entry,
        offset: u32,
        data: &[u8],
        last: bool,
    ) -> Result<(), AbortCode> {
        let offset = usize::try_from(offset).map_err(|_| AbortCode::OUT_OF_MEMORY)?;
        let end = offset.checked_add(data.len()).ok_or(AbortCode::OUT_OF_MEMORY)?;
        let place = self.domain.get_mut(offset..end).ok_or(AbortCode::OUT_OF_MEMORY)?;
        place.iter_mut().zip(data).for_each(|(to, from)| *to = *from);
        // Until it is whole, there is none.
        self.length = if last { end } else { 0 };
        Ok(())
    }
}

impl<D: Dictionary<'static>> PdoHandler<D> for Bench<'_> {}

impl<D: Dictionary<'static>> NodeHandler<D> for Bench<'_> {
    fn restart(&mut self, od: &mut D, node: NodeId, reset: Reset) {
        let groups: &[Storage] = match reset {
            Reset::Node => &ALL,
            Reset::Communication => &[Storage::Communication],
        };
        self.store.load(od, node, groups);
    }
}

impl LssHandler for Bench<'_> {
    fn has_bit_rate(&self, _: BitRate) -> bool {
        true
    }

    fn store(&mut self, _: MaybeNode, _: Option<BitRate>) -> Reply {
        Reply::Done
    }
}

/// Serves a dictionary, whose largest value has `LARGEST` bytes.
pub fn serve<D: Dictionary<'static>, const LARGEST: usize>(od: D) -> ! {
    let mut memory = [0; flash::SIZE];
    if let Some(core) = cortex_m::Peripherals::take()
        && let Ok(store) = ParameterStore::new(flash::RamFlash::new(&mut memory), 0, flash::SLOT)
    {
        let can = slcan::Slcan::new(uart::Uart::Frames.open());
        let bench = Bench { store, domain: [0; 2048], length: 0 };
        run::<_, _, LARGEST>(od, can, clock::Clock::start(core.SYST), bench);
    }
    loop {
        cortex_m::asm::wfi();
    }
}

fn run<D: Dictionary<'static>, C: Can, const LARGEST: usize>(
    mut od: D,
    mut can: C,
    mut clock: clock::Clock,
    mut bench: Bench<'_>,
) {
    let room = Room {
        tpdos: UpTo::<16>,
        rpdos: UpTo::<16>,
        errors: UpTo::<32>,
        watched: UpTo::<8>,
        sdo_buffer: [0; LARGEST],
    };
    let Ok(mut node) = Node::new(od.table(), NodeId::new(NODE), room) else { return };
    let mut waiting: Option<Frame> = None;
    loop {
        let now = clock.now();
        while let Some(frame) = waiting.take().or_else(|| node.poll(&mut od, &mut bench, now)) {
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
                    waiting = frame.and_then(|frame| node.handle(&frame, &mut od, &mut bench, now));
                }
                Err(_) => cortex_m::asm::wfi(),
            }
        }
    }
}

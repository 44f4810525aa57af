//! The services that a node cannot do without, over the scaled model of 150 objects, put together by hand: SDO server (segments and
//! blocks, too), PDOs with SYNC, NMT, heartbeat. Frames come from outside, and what the node says leaves it.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use firmware_glue::clock::Instant;
use firmware_glue::frame::Frame;
use firmware_glue::nmt::{Command, ErrorControl, Nmt, Service, State, Transition};
use firmware_glue::pdo::engine::PdoEngine;
use firmware_glue::sdo::{Channel, SdoServer};
use firmware_glue::{Dictionary, Late, NodeId};
use panic_halt as _;
use thumb_scaled::scaled150::Controller;

struct Services {
    id: NodeId,
    nmt: Nmt,
    control: ErrorControl,
    pdos: PdoEngine<4, 4>,
    sdo: SdoServer<[u8; Controller::LARGEST_VALUE]>,
}

impl Services {
    fn new(dictionary: &Controller, id: NodeId) -> Option<Self> {
        Some(Self {
            id,
            nmt: Nmt::new(),
            control: ErrorControl::new(),
            pdos: PdoEngine::new(dictionary.table()).ok()?,
            sdo: SdoServer::new(Channel::predefined(id), [0; Controller::LARGEST_VALUE]),
        })
    }

    fn boot(&mut self, dictionary: &mut Controller, now: Instant) -> Frame {
        dictionary.reset(self.id.get());
        self.nmt.booted();
        self.control.boot_up(dictionary, self.id, now)
    }

    fn handle(&mut self, frame: &Frame, dictionary: &mut Controller, now: Instant) -> Option<Frame> {
        if let Some(command) = Command::of(frame, self.id) {
            match self.nmt.command(command) {
                Transition::None => {}
                Transition::To(State::Operational) => self.pdos.start(dictionary, now),
                Transition::To(_) => {
                    self.pdos.stop();
                    self.sdo.reset();
                }
                Transition::ResetNode | Transition::ResetCommunication => {
                    return Some(self.boot(dictionary, now));
                }
            }
            return None;
        }
        if self.nmt.state().allows(Service::Pdo) {
            self.pdos.handle(frame, dictionary, &mut (), now);
        }
        let serves = self.nmt.state().allows(Service::Sdo);
        if serves { self.sdo.handle(frame, dictionary, &mut (), now) } else { None }
    }

    fn poll(&mut self, dictionary: &mut Controller, now: Instant) -> Option<Frame> {
        let heartbeat = self.control.poll(dictionary, self.id, self.nmt.state(), now);
        let pdo = heartbeat.or_else(|| self.pdos.poll(dictionary, &mut (), now));
        pdo.or_else(|| self.sdo.poll(dictionary, &mut (), now))
    }
}

#[entry]
fn main() -> ! {
    // `entry` hands them out as `&'static mut`.
    static mut DICTIONARY: Late<Controller> = Late::Empty;
    static mut SERVICES: Late<Services> = Late::Empty;
    static FRAME: Option<Frame> = None;
    // At run time: a static with values has them in flash a second time.
    DICTIONARY.make(Controller::new(1));
    let id = NodeId::new(black_box(5));
    if let (Some(id), Some(dictionary)) = (id, DICTIONARY.made())
        && let Some(services) = Services::new(dictionary, id)
    {
        SERVICES.make(services);
    }
    loop {
        let made = (black_box(SERVICES.made()), black_box(DICTIONARY.made()));
        let (Some(services), Some(dictionary)) = made else { continue };
        let now = black_box(Instant::ZERO);
        if let Some(frame) = black_box(&FRAME) {
            black_box(services.handle(frame, dictionary, now));
        }
        black_box(services.poll(dictionary, now));
    }
}

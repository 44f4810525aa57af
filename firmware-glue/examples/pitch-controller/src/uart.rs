//! A UART of the board mps2-an386 (CMSDK APB UART), by its registers.
//!
//! The only module with `unsafe` code. Each use is an access to a register whose address, width and effects the manual of the board
//! gives; none touches memory of the program. On your board, a HAL takes its place.
#![allow(unsafe_code)]

use cortex_m::interrupt::InterruptNumber;
use cortex_m::peripheral::NVIC;
use cortex_m_rt::exception;

use crate::slcan::Wire;

/// Which UART.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Uart {
    /// UART 0, which carries the frames.
    Frames,
    /// UART 1, which prints what happens.
    #[cfg(feature = "names")]
    Console,
}

/// Registers, by their distance from the first one.
#[derive(Debug, Clone, Copy)]
enum Register {
    /// A byte that was received, or one to send.
    Data = 0x00,
    /// What the two buffers hold.
    State = 0x04,
    /// What is switched on.
    Control = 0x08,
    /// Interrupts that wait; writing a bit takes it back.
    Interrupt = 0x0C,
    /// Ticks of the clock for a bit, at least 16.
    BaudDivider = 0x10,
}

/// State: the byte to be sent is still there.
const TRANSMITTER_FULL: u32 = 1 << 0;
/// State: a byte has come.
const RECEIVER_FULL: u32 = 1 << 1;
/// Control: transmitter, receiver, and the interrupt of the receiver.
const ON: u32 = 1 << 0 | 1 << 1 | 1 << 3;
/// Interrupt: a byte has come.
const RECEIVED: u32 = 1 << 1;

/// The interrupt of the receiver of UART 0.
#[derive(Clone, Copy)]
struct ReceiverInterrupt;

// SAFETY: the board has this interrupt, and it always has this number.
unsafe impl InterruptNumber for ReceiverInterrupt {
    fn number(self) -> u16 {
        0
    }
}

impl Uart {
    /// Switches a UART on.
    pub fn open(self) -> Self {
        self.write(Register::BaudDivider, 16);
        self.write(Register::Control, ON);
        // SAFETY: the interrupt has a handler, `DefaultHandler` below, and no code relies on being without interrupts.
        unsafe { NVIC::unmask(ReceiverInterrupt) };
        self
    }

    const fn address(self, register: Register) -> usize {
        let base = match self {
            Self::Frames => 0x4000_4000,
            #[cfg(feature = "names")]
            Self::Console => 0x4000_5000,
        };
        base | register as usize
    }

    fn read(self, register: Register) -> u32 {
        // SAFETY: the address of a 32-bit register; reading it takes at most a received byte out of the UART.
        unsafe { (self.address(register) as *const u32).read_volatile() }
    }

    fn write(self, register: Register, value: u32) {
        // SAFETY: the address of a 32-bit register that may be written at any time.
        unsafe { (self.address(register) as *mut u32).write_volatile(value) }
    }
}

impl Wire for Uart {
    fn receive(&mut self) -> Option<u8> {
        let [byte, ..] = (self.read(Register::State) & RECEIVER_FULL != 0)
            .then(|| self.read(Register::Data))?
            .to_le_bytes();
        Some(byte)
    }

    fn send(&mut self, byte: u8) -> nb::Result<(), core::convert::Infallible> {
        if self.read(Register::State) & TRANSMITTER_FULL != 0 {
            return Err(nb::Error::WouldBlock);
        }
        self.write(Register::Data, u32::from(byte));
        Ok(())
    }
}

/// The only interrupt that is switched on: a byte has come. The main loop takes it; this only wakes it up.
#[exception]
unsafe fn DefaultHandler(_: i16) {
    Uart::Frames.write(Register::Interrupt, RECEIVED);
}

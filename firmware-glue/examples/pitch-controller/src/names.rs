//! Which entries are written, by name, on the second UART.

use crate::pmc::Entry;
use crate::slcan::Wire;
use crate::uart::Uart;

/// Reports a write.
pub fn print(console: &mut Uart, entry: Entry) {
    for byte in entry.name().bytes().chain(*b" written\r\n") {
        while console.send(byte).is_err() {}
    }
}

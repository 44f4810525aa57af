//! Serial ports.

use std::io::{self, Read, Write};
use std::path::Path;
use std::time::Duration;

use serial2::{SerialPort, Settings};

use super::port::{Manner, Port};

/// The time that an adapter needs to discard half a line of an earlier user.
const SETTLING: Duration = Duration::from_millis(50);

/// A serial port with an adapter: 8 bits, no parity, no flow control.
#[derive(Debug)]
pub struct Serial(SerialPort);

impl Serial {
    /// Opens a port, such as `/dev/ttyACM0` or `COM3`, with so many bits per second; an adapter that is a device of USB does not mind which.
    ///
    /// # Errors
    /// There is no such port, or it cannot be had or set up.
    pub fn open(path: &Path, baud: u32) -> io::Result<Self> {
        let port = SerialPort::open(path, |mut settings: Settings| {
            settings.set_raw();
            settings.set_baud_rate(baud)?;
            Ok(settings)
        })?;
        // An earlier user of the port may have left half a line in the adapter, and frames in the system.
        port.write_all(b"\r")?;
        std::thread::sleep(SETTLING);
        port.discard_input_buffer()?;
        Ok(Self(port))
    }
}

impl Read for Serial {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.0.read(buffer)
    }
}

impl Write for Serial {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

impl Port for Serial {
    fn prepare(&mut self, patience: Duration) -> io::Result<()> {
        self.0.set_write_timeout(patience)
    }

    fn wait_at_most(&mut self, time: Duration) -> io::Result<()> {
        // A timeout of 0 milliseconds would not be a timeout.
        self.0.set_read_timeout(time.max(Duration::from_millis(1)))
    }

    fn finish(&mut self) -> io::Result<()> {
        self.0.flush()
    }

    fn manner(&self) -> Manner {
        Manner::MayBeSilent
    }
}

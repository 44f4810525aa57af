//! Recorded traces, line by line.

use super::asc::Asc;
use super::line::{self, BadLine, Line};
use super::trc::Trc;

/// Reads the lines of one trace, from the first one on:
///
/// - what `candump` prints and logs, and SLCAN,
/// - `.trc` of PCAN-View and PCAN-Explorer, versions 1.0 to 2.1,
/// - `.asc` of CANalyzer and CANoe.
///
/// The lines about the file, with which the last two begin, state how the others are to be read.
#[derive(Debug, Default)]
pub struct Reader {
    format: Format,
}

/// How the lines of a trace are written.
#[derive(Debug, Default)]
enum Format {
    /// Each says all of a frame.
    #[default]
    Plain,
    Trc(Trc),
    Asc(Asc),
}

impl Reader {
    /// Reads the next line, without its end.
    ///
    /// # Errors
    /// [`BadLine`]: what is wrong with it.
    pub fn read<'l>(&mut self, line: &'l str) -> Result<Line<'l>, BadLine> {
        if let Some(trc) = Trc::begins(line)? {
            self.format = Format::Trc(trc);
            return Ok(Line::Empty);
        }
        if let Format::Plain = self.format
            && let Some(asc) = Asc::begins(line)
        {
            self.format = Format::Asc(asc);
            return Ok(Line::Empty);
        }
        match &mut self.format {
            Format::Plain => line::read(line),
            Format::Trc(trc) => trc.read(line),
            Format::Asc(asc) => asc.read(line),
        }
    }
}

#[cfg(test)]
mod tests;

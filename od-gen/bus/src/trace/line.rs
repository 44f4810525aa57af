//! Lines that say all of a frame themselves: what `candump` prints and logs, and SLCAN.

use firmware_glue::frame::{CanId, Frame};

use crate::slcan::{self, CanFrame};

/// A line of a trace.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Line<'l> {
    /// Nothing, or a comment after `#` or `;`.
    Empty,
    /// Something on the bus.
    Seen(Seen<'l>),
}

/// Something on the bus.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Seen<'l> {
    /// When and where, as the trace says it.
    pub head: Vec<&'l str>,
    /// What.
    pub what: What,
}

/// What was on the bus.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum What {
    /// A frame.
    Frame(CanFrame),
    /// A frame of CAN FD, with its identifier.
    Fd(u32),
    /// An error that the interface has seen.
    Error,
}

/// Why a line cannot be read: the bytes of it that are wrong, and what was expected there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BadLine {
    /// Where it is wrong, in bytes.
    pub at: std::ops::Range<usize>,
    /// What was expected.
    pub expected: String,
}

/// Bit 29 of an identifier of Linux: an error that the interface has seen.
const ERROR: u32 = 1 << 29;

/// Reads a line of a trace that has no lines about itself, without its end:
///
/// - `(1700000000.123456) can0 181#0102`, the log of `candump -L`; `181#R4` is a remote frame,
/// - `can0  181   [2]  01 02`, with or without a time before and a text after: what `candump` prints,
/// - `t181201020A5F`, a frame of SLCAN with or without a time stamp.
///
/// # Errors
/// [`BadLine`]: it is not one of these.
pub(super) fn read(line: &str) -> Result<Line<'_>, BadLine> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let Some(first) = words.first() else { return Ok(Line::Empty) };
    if first.starts_with(['#', ';']) {
        return Ok(Line::Empty);
    }
    if let Some(at) = words.iter().position(|word| word.starts_with('[') && word.ends_with(']')) {
        return printed(line, &words, at).map(Line::Seen);
    }
    if let Some(at) = words.iter().position(|word| word.contains('#')) {
        return log(line, &words, at).map(Line::Seen);
    }
    if let [only] = words.as_slice() {
        let bad = |fault: slcan::Fault| bad(line, only, fault.expected());
        return slcan::frame(only).map_err(bad).map(|(frame, _)| {
            let head = only.len().checked_sub(4).and_then(|at| only.get(at..)).filter(|_| has_time(only));
            Line::Seen(Seen { head: head.into_iter().collect(), what: What::Frame(frame) })
        });
    }
    Err(bad(
        line,
        first,
        "a frame as `candump` logs it (`(1.5) can0 181#0102`) or prints it, or a line of SLCAN; or in front of all \
         frames the first lines of a `.trc` or `.asc` file",
    ))
}

fn has_time(line: &str) -> bool {
    slcan::frame(line).is_ok_and(|(_, time)| time.is_some())
}

pub(super) fn bad(line: &str, word: &str, expected: impl Into<String>) -> BadLine {
    let start = (word.as_ptr() as usize).saturating_sub(line.as_ptr() as usize).min(line.len());
    BadLine { at: start..(start + word.len()).min(line.len()), expected: expected.into() }
}

/// Digits as a number; no more than fit.
pub(super) fn hexadecimal(digits: &str) -> Option<u32> {
    let is_all = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_hexdigit());
    is_all.then(|| u32::from_str_radix(digits, 16).ok()).flatten()
}

/// An identifier: three digits are one of 11 bits, eight one of 29.
fn identifier(line: &str, word: &str) -> Result<Identifier, BadLine> {
    match (word.len(), hexadecimal(word)) {
        (3, Some(id)) => u16::try_from(id)
            .ok()
            .and_then(CanId::new)
            .map(Identifier::Standard)
            .ok_or_else(|| bad(line, word, "an identifier up to 7FF")),
        (8, Some(id)) if id & ERROR != 0 => Ok(Identifier::Error),
        (8, Some(id)) if id < ERROR => Ok(Identifier::Extended(id)),
        _ => Err(bad(line, word, "an identifier of three or eight hexadecimal digits")),
    }
}

/// The identifier of a frame.
pub(super) enum Identifier {
    Standard(CanId),
    Extended(u32),
    Error,
}

impl Identifier {
    const fn number(&self) -> u32 {
        match self {
            Identifier::Standard(id) => id.get() as u32,
            Identifier::Extended(id) => *id,
            Identifier::Error => ERROR,
        }
    }

    /// What was on the bus, with this content; `None` where a frame has no room for it.
    pub(super) fn with(&self, content: &Content) -> Option<What> {
        let length = match content {
            Content::Data(bytes) => u8::try_from(bytes.len()).ok()?,
            Content::Remote(length) => *length,
        };
        Some(match (self, content) {
            (Identifier::Error, _) => What::Error,
            (Identifier::Extended(id), _) => What::Frame(CanFrame::Extended { id: *id, length }),
            (Identifier::Standard(id), Content::Data(bytes)) => {
                What::Frame(CanFrame::Standard(Frame::data(*id, bytes)?))
            }
            (Identifier::Standard(id), Content::Remote(_)) => {
                What::Frame(CanFrame::Standard(Frame::remote(*id, length)?))
            }
        })
    }
}

/// What a frame carries.
pub(super) enum Content {
    Data(Vec<u8>),
    Remote(u8),
}

/// `(1700000000.123456) can0 181#0102 R`.
fn log<'l>(line: &str, words: &[&'l str], at: usize) -> Result<Seen<'l>, BadLine> {
    let word = words[at];
    let (id, content) = word.split_once('#').unwrap_or((word, ""));
    let head = words[..at].to_vec();
    if let Some(behind) = words.get(at + 1)
        && (!matches!(*behind, "R" | "T") || words.len() > at + 2)
    {
        return Err(bad(line, behind, "nothing after the frame except its direction, `R` or `T`"));
    }
    let id = identifier(line, id)?;
    if content.starts_with('#') {
        return Ok(Seen { head, what: What::Fd(id.number()) });
    }
    let content = match content.strip_prefix('R') {
        Some("") => Content::Remote(0),
        Some(length) => match length.parse() {
            Ok(length @ 0..=8) => Content::Remote(length),
            _ => return Err(bad(line, length, "the length of a remote frame, 0 to 8")),
        },
        None => Content::Data(pairs(content).ok_or_else(|| {
            bad(line, word, "up to eight bytes of two hexadecimal digits after `#`, or `R` and a length")
        })?),
    };
    let what = id.with(&content).ok_or_else(|| bad(line, word, "up to eight bytes"))?;
    Ok(Seen { head, what })
}

/// Bytes as pairs of digits, with or without dots between them.
fn pairs(digits: &str) -> Option<Vec<u8>> {
    let digits = digits.replace('.', "");
    let byte = |at: usize| u8::try_from(hexadecimal(digits.get(at..at + 2)?)?).ok();
    (0..digits.len()).step_by(2).map(byte).collect()
}

/// `(1700000000.123456)  can0  TX B -  181   [2]  01 02   '..'`.
fn printed<'l>(line: &str, words: &[&'l str], at: usize) -> Result<Seen<'l>, BadLine> {
    let Some(before) = at.checked_sub(1) else {
        return Err(bad(line, words[at], "an identifier before the length"));
    };
    let id = identifier(line, words[before])?;
    let head = words[..before].to_vec();
    let digits = words[at].trim_matches(['[', ']']);
    if digits.len() == 2 {
        return Ok(Seen { head, what: What::Fd(id.number()) });
    }
    let length = digits.parse().ok().filter(|length| *length <= 8);
    let Some(length) = length else { return Err(bad(line, words[at], "a length from `[0]` to `[8]`")) };
    let behind = &words[at + 1..];
    let content = if behind.first().is_some_and(|word| *word == "remote") {
        Content::Remote(u8::try_from(length).unwrap_or(u8::MAX))
    } else {
        let bytes = bytes(line, behind, length, two_digits)?;
        // `candump -a` shows the bytes as characters, too.
        if let Some(more) =
            behind.get(length).filter(|word| !word.starts_with('\'') && **word != "ERRORFRAME")
        {
            return Err(bad(line, more, format!("no more than {length} bytes, as the length says")));
        }
        Content::Data(bytes)
    };
    let what = id.with(&content).ok_or_else(|| bad(line, words[at], "a length from `[0]` to `[8]`"))?;
    Ok(Seen { head, what })
}

/// The first words as so many bytes.
pub(super) fn bytes(
    line: &str,
    words: &[&str],
    length: usize,
    read: impl Fn(&str) -> Result<u8, &'static str>,
) -> Result<Vec<u8>, BadLine> {
    let byte = |at: usize| match words.get(at) {
        Some(word) => read(word).map_err(|expected| bad(line, word, expected)),
        None => Err(bad(line, end(line), format!("{length} bytes, as the length says"))),
    };
    (0..length).map(byte).collect()
}

/// A byte as almost all traces have it.
pub(super) fn two_digits(word: &str) -> Result<u8, &'static str> {
    let byte = hexadecimal(word).filter(|_| word.len() == 2).and_then(|byte| u8::try_from(byte).ok());
    byte.ok_or("a byte of two hexadecimal digits")
}

/// The place after the last word of a line.
pub(super) fn end(line: &str) -> &str {
    &line[line.trim_end().len()..]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(id: u16, bytes: &[u8]) -> What {
        What::Frame(CanFrame::Standard(
            CanId::new(id).and_then(|id| Frame::data(id, bytes)).expect("a frame"),
        ))
    }

    fn remote(id: u16, length: u8) -> What {
        let frame = CanId::new(id).and_then(|id| Frame::remote(id, length));
        What::Frame(CanFrame::Standard(frame.expect("a frame")))
    }

    fn seen(line: &str) -> (String, What) {
        match read(line) {
            Ok(Line::Seen(seen)) => (seen.head.join(" "), seen.what),
            other => panic!("{line}: {other:?}"),
        }
    }

    #[test]
    fn every_notation_is_read() {
        for (line, head, what) in [
            ("(1700000000.123456) can0 181#0102", "(1700000000.123456) can0", frame(0x181, &[1, 2])),
            ("(1.5) can0 181#01.02 R", "(1.5) can0", frame(0x181, &[1, 2])),
            ("can0 000#", "can0", frame(0, &[])),
            ("can0 701#R", "can0", remote(0x701, 0)),
            ("can0 701#R1", "can0", remote(0x701, 1)),
            ("  can0  181   [2]  01 02", "can0", frame(0x181, &[1, 2])),
            (
                " (000.000000)  can0  RX - -  181   [2]  41 42   'AB'",
                "(000.000000) can0 RX - -",
                frame(0x181, &[0x41, 0x42]),
            ),
            ("can0  701   [1]  remote request", "can0", remote(0x701, 1)),
            ("can0  701   [0]", "can0", frame(0x701, &[])),
            ("can0  701   [1]  23   '#'", "can0", frame(0x701, &[0x23])),
            ("t18120102", "", frame(0x181, &[1, 2])),
            ("t181201020A5F\r", "0A5F", frame(0x181, &[1, 2])),
            ("r7011", "", remote(0x701, 1)),
            ("can0 18DA00F1#01", "can0", What::Frame(CanFrame::Extended { id: 0x18DA_00F1, length: 1 })),
            ("can0 181##30102", "can0", What::Fd(0x181)),
            ("can0  181  [12]  00 01", "can0", What::Fd(0x181)),
            ("can0 20000004#0000000000000000", "can0", What::Error),
        ] {
            assert_eq!(seen(line), (head.to_owned(), what), "{line}");
        }
        for line in ["", "  \r", "# a remark", "; another"] {
            assert_eq!(read(line), Ok(Line::Empty));
        }
    }

    #[test]
    fn what_is_wrong_is_reported_with_its_place() {
        for (line, at) in [
            ("can0 1811#00", 5..9),
            ("can0 800#00", 5..8),
            ("can0 181#0", 5..10),
            ("can0 181#112233445566778899", 5..27),
            ("can0 181#R9", 10..11),
            ("can0 181#00 x", 12..13),
            ("can0  181   [2]  01", 19..19),
            ("can0  181   [1]  01 02", 20..22),
            ("can0  181   [1]  0g", 17..19),
            ("can0  181   [9]  0g", 12..15),
            ("[1] 00", 0..3),
            ("t1819", 0..5),
            ("hello world", 0..5),
        ] {
            match read(line) {
                Err(bad) => assert_eq!(bad.at, at, "{line}: {}", bad.expected),
                other => panic!("{line}: {other:?}"),
            }
        }
    }
}

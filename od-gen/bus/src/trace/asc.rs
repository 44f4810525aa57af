//! Lines of `.asc` files, which CANalyzer, CANoe and many loggers write.

use firmware_glue::frame::CanId;

use super::line::{BadLine, Content, Identifier, Line, Seen, What, bad, bytes};

/// How the lines of a file are to be read.
#[derive(Debug)]
pub(super) struct Asc {
    /// Of identifiers and bytes.
    radix: u32,
}

impl Asc {
    /// The format, where a line is one of those with which such a file begins.
    pub(super) fn begins(line: &str) -> Option<Self> {
        let mut words = line.split_whitespace();
        match (words.next()?, words.next()?) {
            ("date", _) => Some(Self { radix: 16 }),
            ("base", base) => Some(Self { radix: radix(base)? }),
            _ => None,
        }
    }

    /// Reads a line after the first one.
    pub(super) fn read<'l>(&mut self, line: &'l str) -> Result<Line<'l>, BadLine> {
        let words: Vec<&str> = line.split_whitespace().collect();
        let Some(first) = words.first() else { return Ok(Line::Empty) };
        match *first {
            "base" => {
                let base = words.get(1).copied().unwrap_or_default();
                self.radix = radix(base).ok_or_else(|| bad(line, base, "`hex` or `dec`"))?;
                return Ok(Line::Empty);
            }
            // `no internal events logged`, `Begin Triggerblock`, `End TriggerBlock`, `// version 9.0.0`.
            "date" | "internal" | "no" | "Begin" | "End" => return Ok(Line::Empty),
            _ if first.starts_with("//") => return Ok(Line::Empty),
            _ => {}
        }
        if first.parse::<f64>().is_err() {
            return Err(bad(line, first, "the time of a frame, or a line about the file"));
        }
        let [time, channel, rest @ ..] = words.as_slice() else { return Ok(Line::Empty) };
        if let ("CANFD", [bus, _, id, ..]) = (*channel, rest) {
            let digits = id.strip_suffix('x').unwrap_or(id);
            let id = self.number(digits).ok_or_else(|| bad(line, id, self.identifier_expected()))?;
            return Ok(Line::Seen(Seen { head: vec![time, bus], what: What::Fd(id) }));
        }
        // What has no channel is an event of the tool: `Start of measurement`.
        let ([id, rest @ ..], Ok(_)) = (rest, channel.parse::<u16>()) else { return Ok(Line::Empty) };
        let head = vec![*time, *channel];
        match *id {
            "ErrorFrame" => return Ok(Line::Seen(Seen { head, what: What::Error })),
            "Statistic:" => return Ok(Line::Empty),
            _ => {}
        }
        let [direction, kind, rest @ ..] = rest else {
            return Err(bad(line, id, "an identifier with `Rx` or `Tx`, `d` or `r`, and a length after it"));
        };
        if !matches!(*direction, "Rx" | "Tx" | "TxRq") {
            return Err(bad(line, direction, "`Rx` or `Tx`"));
        }
        let identifier = self.identifier(line, id)?;
        let length = rest
            .first()
            .and_then(|length| u8::from_str_radix(length, 16).ok())
            .filter(|length| *length <= 15);
        let wrong_length = || bad(line, rest.first().unwrap_or(kind), "a length from 0 to 8");
        let content = match *kind {
            // Older files do not say how much was asked for.
            "r" => Content::Remote(length.unwrap_or(0).min(8)),
            "d" => {
                let length = usize::from(length.ok_or_else(wrong_length)?.min(8));
                let byte = |word: &str| {
                    let byte = self.number(word).and_then(|byte| u8::try_from(byte).ok());
                    byte.ok_or("a byte, as all numbers of the file are written")
                };
                Content::Data(bytes(line, rest.get(1..).unwrap_or_default(), length, byte)?)
            }
            _ => return Err(bad(line, kind, "`d` for data or `r` for a remote frame")),
        };
        let what = identifier.with(&content).ok_or_else(wrong_length)?;
        Ok(Line::Seen(Seen { head, what }))
    }

    fn number(&self, digits: &str) -> Option<u32> {
        let is_all = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_hexdigit());
        is_all.then(|| u32::from_str_radix(digits, self.radix).ok()).flatten()
    }

    /// An identifier; an `x` after it makes it one of 29 bits.
    fn identifier(&self, line: &str, word: &str) -> Result<Identifier, BadLine> {
        let wrong = || bad(line, word, self.identifier_expected());
        if let Some(digits) = word.strip_suffix('x') {
            let id = self.number(digits).filter(|id| *id < 1 << 29).ok_or_else(wrong)?;
            return Ok(Identifier::Extended(id));
        }
        let id = self.number(word).and_then(|id| CanId::new(u16::try_from(id).ok()?));
        id.map(Identifier::Standard).ok_or_else(wrong)
    }

    fn identifier_expected(&self) -> String {
        let base = if self.radix == 16 { "hexadecimal" } else { "decimal" };
        format!("an identifier in {base}, with an `x` after it where it has 29 bits")
    }
}

/// How a file counts.
fn radix(word: &str) -> Option<u32> {
    match word {
        "hex" => Some(16),
        "dec" => Some(10),
        _ => None,
    }
}

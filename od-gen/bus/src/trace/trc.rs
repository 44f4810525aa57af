//! Lines of `.trc` files, which the tools of PEAK-System write: the file says which columns its lines have.

use firmware_glue::frame::CanId;

use super::line::{BadLine, Content, Identifier, Line, Seen, What, bad, bytes, end, hexadecimal, two_digits};

/// How the lines of a file are to be read.
#[derive(Debug)]
pub(super) struct Trc {
    columns: Vec<Column>,
}

/// What is in a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Column {
    /// Number, time, bus, direction and what is reserved: shown as they are.
    Other,
    /// Of version 2: what kind of line it is.
    Type,
    /// Of version 1: `Rx`, `Tx`, or what kind of line it is.
    Direction,
    Identifier,
    /// Number of bytes, or the code of this number: both are the same up to 8.
    Length,
    Data,
}

use Column::{Data, Direction, Identifier as Id, Length, Other, Type};

impl Trc {
    /// The format, where a line says the version of the file.
    pub(super) fn begins(line: &str) -> Result<Option<Self>, BadLine> {
        let Some(version) = line.trim().strip_prefix(";$FILEVERSION=") else { return Ok(None) };
        let columns: &[Column] = match version.trim() {
            "1.0" => &[Other, Other, Id, Length, Data],
            "1.1" => &[Other, Other, Direction, Id, Length, Data],
            "1.2" => &[Other, Other, Other, Direction, Id, Length, Data],
            "1.3" => &[Other, Other, Other, Direction, Id, Other, Length, Data],
            "2.0" => &[Other, Other, Type, Id, Other, Length, Data],
            "2.1" => &[Other, Other, Type, Other, Id, Other, Other, Length, Data],
            version => return Err(bad(line, version, "a version from 1.0 to 1.3, 2.0 or 2.1")),
        };
        Ok(Some(Self { columns: columns.to_vec() }))
    }

    /// Reads a line after that of the version.
    pub(super) fn read<'l>(&mut self, line: &'l str) -> Result<Line<'l>, BadLine> {
        if let Some(columns) = line.trim().strip_prefix(";$COLUMNS=") {
            self.columns = columns.split(',').map(|letter| column(line, letter)).collect::<Result<_, _>>()?;
            return Ok(Line::Empty);
        }
        let words: Vec<&str> = line.split_whitespace().collect();
        if words.first().is_none_or(|first| first.starts_with(';')) {
            return Ok(Line::Empty);
        }
        let at = |column: Column| self.columns.iter().position(|one| *one == column);
        let word =
            |column: Column| at(column).and_then(|at| words.get(at)).copied().unwrap_or_else(|| end(line));
        let head = self.columns.iter().zip(&words).filter(|(column, _)| **column == Other);
        let head: Vec<&str> = head.map(|(_, word)| *word).collect();
        let (kind, id) = (word(if at(Type).is_some() { Type } else { Direction }), word(Id));
        match kind {
            // States and counters of the adapter are not frames.
            "Warng" | "ST" | "EC" | "EV" => return Ok(Line::Empty),
            "Error" | "ER" => return Ok(Line::Seen(Seen { head, what: What::Error })),
            _ if id == "FFFFFFFF" => return Ok(Line::Empty),
            "FD" | "FB" | "FE" | "BI" => {
                let id = hexadecimal(id).ok_or_else(|| bad(line, id, IDENTIFIER))?;
                return Ok(Line::Seen(Seen { head, what: What::Fd(id) }));
            }
            "Rx" | "Tx" | "DT" | "RR" => {}
            _ if at(Type).is_none() && at(Direction).is_none() => {}
            _ => return Err(bad(line, kind, "the kind of the line, such as `Rx`, `Tx` or `DT`")),
        }
        let id = identifier(line, id)?;
        let length = word(Length).parse::<u8>().ok().filter(|length| *length <= 15);
        let length = length.ok_or_else(|| bad(line, word(Length), "a length from 0 to 8"))?.min(8);
        let data = at(Data).and_then(|at| words.get(at..)).unwrap_or_default();
        let content = if kind == "RR" || data.first() == Some(&"RTR") {
            Content::Remote(length)
        } else {
            Content::Data(bytes(line, data, length.into(), two_digits)?)
        };
        let what = id.with(&content).ok_or_else(|| bad(line, word(Length), "a length from 0 to 8"))?;
        Ok(Line::Seen(Seen { head, what }))
    }
}

const IDENTIFIER: &str = "an identifier of four or eight hexadecimal digits";

/// An identifier: four digits are one of 11 bits, more are one of 29.
fn identifier(line: &str, word: &str) -> Result<Identifier, BadLine> {
    let wrong = || bad(line, word, IDENTIFIER);
    let id = hexadecimal(word).filter(|id| *id < 1 << 29).ok_or_else(wrong)?;
    if word.len() > 4 {
        return Ok(Identifier::Extended(id));
    }
    let id = u16::try_from(id).ok().and_then(CanId::new);
    id.map(Identifier::Standard).ok_or_else(|| bad(line, word, "an identifier up to 07FF"))
}

/// The column of a letter.
fn column(line: &str, letter: &str) -> Result<Column, BadLine> {
    Ok(match letter.trim() {
        "T" => Type,
        "I" => Id,
        "l" | "L" => Length,
        "D" => Data,
        "N" | "O" | "B" | "d" | "R" | "S" | "A" => Other,
        letter => {
            return Err(bad(
                line,
                letter,
                "letters of columns with commas between them, as in `N,O,T,I,d,l,D`",
            ));
        }
    })
}

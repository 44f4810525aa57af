//! `odgen decode`.

use std::fs::File;
use std::io::{BufRead, BufReader, ErrorKind, Write as _};
use std::path::{Path, PathBuf};

use clap::Args;
use od_bus::trace::{BadLine, Decoder, Line, Node, Reader, Seen};
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::source::SourceMap;
use od_spec::visible::printable;

use crate::bus_nodes::BusNodes;
use crate::bus_nodes::NodesArgs;
use crate::exit::{ERRORS, SUCCESS};
use crate::messages::Messages;
use crate::report::{Report, not_printed, shown};

#[derive(Debug, Args)]
pub(crate) struct DecodeArgs {
    #[command(flatten)]
    pub nodes: NodesArgs,

    /// The trace: what `candump` prints or logs, lines of SLCAN, `.trc` of PCAN-View or `.asc` of CANalyzer; can be given several times [default: standard input]
    #[arg(long, value_name = "FILE")]
    pub trace: Vec<PathBuf>,

    #[command(flatten)]
    pub messages: Messages,
}

/// So many lines that cannot be read are shown of a trace, and the others counted.
const SHOWN: usize = 20;
/// No line of a trace is longer; what is, does not belong to a trace.
const LONGEST_LINE: usize = 4096;

pub(crate) fn run(args: &DecodeArgs, directory: &Path, report: &Report) -> u8 {
    decode(args, directory, report).unwrap_or_else(|code| code)
}

/// Decodes traces line by line, as they come; fails when a line cannot be read.
fn decode(args: &DecodeArgs, directory: &Path, report: &Report) -> Result<u8, u8> {
    let nodes = BusNodes::read(&args.nodes, directory, report)?;
    let mut decoder =
        Decoder::new(nodes.iter().map(|(id, system, device)| Node::new(id, system, device)).collect());
    if args.trace.is_empty() {
        return trace("<stdin>", std::io::stdin().lock(), &mut decoder, report);
    }
    let mut code = SUCCESS;
    for path in &args.trace {
        let file = File::open(path).map_err(|error| {
            let message = format!("cannot read {}: {error}", shown(path));
            report.refuse(Diagnostic::without_place(codes::UNREADABLE, message).help("check the path"))
        })?;
        code = code.max(trace(&shown(path), BufReader::new(file), &mut decoder, report)?);
    }
    Ok(code)
}

/// Decodes one trace.
fn trace(name: &str, mut from: impl BufRead, decoder: &mut Decoder<'_>, report: &Report) -> Result<u8, u8> {
    let (mut number, mut bad) = (0_usize, 0_usize);
    let mut out = std::io::stdout().lock();
    let mut bytes = Vec::new();
    let (mut lines, mut reader) = (Lines::default(), Reader::default());
    loop {
        let length = match lines.next(&mut from, &mut bytes) {
            Ok(None) => break,
            Ok(Some(length)) => length,
            Err(error) => {
                let message = format!("cannot read {name} after line {number}: {error}");
                return Err(report.refuse(Diagnostic::without_place(codes::UNREADABLE, message)));
            }
        };
        number += 1;
        let line = &*String::from_utf8_lossy(&bytes);
        let read = match length {
            Length::Whole => reader.read(line),
            Length::Cut => Err(BadLine {
                at: 0..line.len(),
                expected: format!("a line of at most {LONGEST_LINE} bytes"),
            }),
        };
        match read {
            Ok(Line::Empty) => {}
            Ok(Line::Seen(Seen { head, what })) => {
                let head = head.join(" ");
                let between = if head.is_empty() { "" } else { "  " };
                let described = format!("{head}{between}{}\n", decoder.describe(&what));
                let written = out.write_all(printable(&described, false).as_bytes());
                written.and_then(|()| out.flush()).map_err(|error| not_printed(&error))?;
            }
            Err(fault) => {
                bad += 1;
                if bad <= SHOWN {
                    complain(name, number, line, &fault, report);
                }
            }
        }
    }
    if bad > SHOWN {
        report.note(&format!("{name}: {} more lines cannot be read", bad - SHOWN));
    }
    Ok(if bad > 0 { ERRORS } else { SUCCESS })
}

/// Lines that end with a line feed, with both, or, as those of an SLCAN adapter do, with a carriage return alone. One ends as soon as
/// its end is there, also of a pipe, and no more of it is kept than a line has.
#[derive(Default)]
struct Lines {
    last: Last,
}

/// What the byte before was.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
enum Last {
    #[default]
    Other,
    Return,
}

/// Whether a line is there as it was.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Length {
    Whole,
    Cut,
}

impl Lines {
    /// The next line, without its end; `None` after the last one.
    fn next(&mut self, from: &mut impl BufRead, line: &mut Vec<u8>) -> std::io::Result<Option<Length>> {
        line.clear();
        let (mut length, mut is_begun) = (Length::Whole, false);
        loop {
            let bytes = match from.fill_buf() {
                Ok(bytes) => bytes,
                Err(error) if error.kind() == ErrorKind::Interrupted => continue,
                Err(error) => return Err(error),
            };
            let Some(first) = bytes.first() else { return Ok(is_begun.then_some(length)) };
            if std::mem::take(&mut self.last) == Last::Return && *first == b'\n' {
                from.consume(1);
                continue;
            }
            is_begun = true;
            let end = bytes.iter().position(|byte| matches!(byte, b'\r' | b'\n'));
            let part = bytes.get(..end.unwrap_or(bytes.len())).unwrap_or_default();
            let room = LONGEST_LINE.saturating_sub(line.len());
            if part.len() > room {
                length = Length::Cut;
            }
            line.extend(part.iter().take(room));
            if let Some(end) = end {
                if bytes.get(end) == Some(&b'\r') {
                    self.last = Last::Return;
                }
                from.consume(end + 1);
                return Ok(Some(length));
            }
            let all = bytes.len();
            from.consume(all);
        }
    }
}

/// Shows a line that cannot be read. A trace may be endless, so it is not kept: lines before this one are empty.
fn complain(name: &str, number: usize, line: &str, fault: &BadLine, report: &Report) {
    let mut sources = SourceMap::new();
    let end = (0..=LONGEST_LINE.min(line.len())).rev().find(|at| line.is_char_boundary(*at)).unwrap_or(0);
    let before = number.saturating_sub(1);
    let file = sources.add(name, "\n".repeat(before) + line.get(..end).unwrap_or_default());
    let place = |at: usize| before + at.min(end);
    let span = sources.whole(file).part(place(fault.at.start), place(fault.at.end));
    let mut diagnostics = Diagnostics::new();
    diagnostics.push(
        Diagnostic::new(codes::BAD_TRACE_LINE, span, format!("expected {}", fault.expected))
            .help("take the line out, or give the trace as `candump`, PCAN-View (`.trc`) or CANalyzer (`.asc`) write it"),
    );
    report.show(&diagnostics, &sources);
}

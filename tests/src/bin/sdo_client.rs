//! The SDO client of firmware-glue, for servers that others wrote: `sdo-client NODE`.
//!
//! A line of standard input begins a transfer: `read segments|blocks INDEX.SUB`, or `write segments|blocks INDEX.SUB BYTES`, all numbers in
//! hexadecimal. Every line of standard output is a frame (`send BYTES`), which is answered by the frames that come back, one a line, and
//! an empty line; or the end: `done BYTES`, `refused CODE` by the server, `failed CODE`.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a command talks to its user")]

use std::io::{BufRead as _, Lines, StdinLock};
use std::process::ExitCode;

use firmware_glue::clock::Instant;
use firmware_glue::frame::Frame;
use firmware_glue::sdo::{Channel, Failure, Filled, SdoClient, Step, Way};
use firmware_glue::{AbortCode, EntryId, NodeId};

fn main() -> ExitCode {
    let node = std::env::args().nth(1).and_then(|node| node.parse().ok());
    let Some(channel) = node.and_then(NodeId::new).map(Channel::predefined) else {
        eprintln!("usage: sdo-client NODE");
        return ExitCode::from(2);
    };
    let mut lines = std::io::stdin().lock().lines();
    while let Some(Ok(line)) = lines.next() {
        let Some(command) = Command::parse(&line) else {
            eprintln!("no transfer: {line}");
            return ExitCode::from(2);
        };
        match command.run(channel, &mut lines) {
            Ok(bytes) => println!("done {}", hex(&bytes)),
            Err(Failure::Server(code)) => println!("refused {:08x}", code.0),
            Err(Failure::Client(code)) => println!("failed {:08x}", code.0),
        }
    }
    ExitCode::SUCCESS
}

struct Command {
    id: EntryId,
    way: Way,
    /// What is written; nothing when something is read.
    data: Option<Vec<u8>>,
}

impl Command {
    fn parse(line: &str) -> Option<Self> {
        let mut words = line.split(' ');
        let (verb, way, id, data) = (words.next()?, words.next()?, words.next()?, words.next());
        let way = match way {
            "segments" => Way::Segments,
            "blocks" => Way::Blocks,
            _ => return None,
        };
        let data = match verb {
            "read" => None,
            "write" => Some(bytes(data?)?),
            _ => return None,
        };
        let (index, sub) = id.split_once('.')?;
        let id =
            EntryId { index: u16::from_str_radix(index, 16).ok()?, sub: u8::from_str_radix(sub, 16).ok()? };
        Some(Self { id, way, data })
    }

    /// The bytes that were read or written.
    fn run(self, channel: Channel, lines: &mut Lines<StdinLock<'_>>) -> Result<Vec<u8>, Failure> {
        let client = SdoClient { way: self.way, ..SdoClient::new(channel) };
        if let Some(data) = self.data {
            let (mut writing, request) =
                client.start_write(self.id, &data[..], Instant::ZERO).map_err(Failure::Client)?;
            exchange(channel, lines, request, |heard, now| match heard {
                Some(frame) => writing.handle(&frame, now),
                None => writing.poll(now),
            })?;
            return Ok(data);
        }
        let mut buffer = vec![0; 1 << 16];
        let (mut reading, request) = client.start_read(self.id, Filled::new(&mut buffer), Instant::ZERO);
        exchange(channel, lines, request, |heard, now| match heard {
            Some(frame) => reading.handle(&frame, now),
            None => reading.poll(now),
        })?;
        Ok(reading.sink().bytes().to_vec())
    }
}

/// Sends and hears until the transfer is over. Time goes on while nothing is sent.
fn exchange(
    channel: Channel,
    lines: &mut Lines<StdinLock<'_>>,
    request: Frame,
    mut step: impl FnMut(Option<Frame>, Instant) -> Step,
) -> Result<(), Failure> {
    let mut sending = vec![request];
    for now in (0..).step_by(100).map(Instant::from_millis) {
        let mut outcome = None;
        let mut take = |taken: Step, sending: &mut Vec<Frame>| {
            sending.extend(taken.send);
            outcome = outcome.or(taken.outcome);
        };
        for frame in std::mem::take(&mut sending) {
            println!("send {}", hex(frame.bytes().unwrap_or_default()));
            for line in lines.by_ref().map_while(Result::ok).take_while(|line| !line.is_empty()) {
                let heard = bytes(&line).and_then(|bytes| Frame::data(channel.answer, &bytes));
                take(step(heard, now), &mut sending);
            }
        }
        take(step(None, now), &mut sending);
        if let Some(outcome) = outcome {
            for frame in sending {
                println!("send {}", hex(frame.bytes().unwrap_or_default()));
                lines.by_ref().map_while(Result::ok).take_while(|line| !line.is_empty()).for_each(drop);
            }
            return outcome.map(drop);
        }
    }
    Err(Failure::Client(AbortCode::TIMEOUT))
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |text, byte| format!("{text}{byte:02x}"))
}

fn bytes(text: &str) -> Option<Vec<u8>> {
    (0..text.len()).step_by(2).map(|at| u8::from_str_radix(text.get(at..at + 2)?, 16).ok()).collect()
}

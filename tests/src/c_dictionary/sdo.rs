//! Frames of SDO transfers, and what the server in Rust answers to them.

use firmware_glue::clock::Instant;
use firmware_glue::frame::Frame;
use firmware_glue::sdo::{Channel, SdoServer};
use firmware_glue::storage::Command;
use firmware_glue::{Dictionary, EntryId, NodeId};

use super::trial::Exchange;
use crate::Failure;

/// A client that reads and writes every entry of a dictionary.
#[derive(Debug)]
pub struct SdoTrial<D> {
    dictionary: D,
    server: SdoServer<Vec<u8>>,
    channel: Channel,
    exchange: Vec<Exchange>,
}

impl<'t, D: Dictionary<'t>> SdoTrial<D> {
    /// A client of a node with this ID.
    ///
    /// # Errors
    /// It is no node-ID.
    pub fn new(dictionary: D, node: u8) -> Result<Self, Failure> {
        let channel = Channel::predefined(NodeId::new(node).ok_or("no node-ID")?);
        let server = SdoServer::new(channel, vec![0; dictionary.table().largest_value()]);
        let start = Exchange { request: vec![node], answer: Vec::new() };
        Ok(Self { dictionary, server, channel, exchange: vec![start] })
    }

    /// All frames, and the answers.
    pub fn exchange(mut self) -> Vec<Exchange> {
        let rows = u16::try_from(self.dictionary.table().parts().entries.len()).unwrap_or(u16::MAX);
        for row in 0..rows {
            let table = self.dictionary.table();
            let (id, shared) = (table.id(row), *table.attributes(row));
            let value = self.read(id);
            let size = usize::from(shared.size);
            // A number of another length than it says is refused sooner or later.
            let lengths = if shared.data_type.is_string() {
                vec![1, 4, 5, 7, 8, size, size + 1]
            } else {
                vec![1, 2, 3, 4, size]
            };
            for length in lengths {
                let bytes: Vec<u8> = (b'1'..=b'5').cycle().take(length).collect();
                self.write(id, &bytes, true);
                // How long a text in one frame is, its length alone says.
                if length > 4 || !shared.data_type.is_string() {
                    self.write(id, &bytes, false);
                }
            }
            match Command::of(id) {
                Some(Command::Save(_)) => self.write(id, b"save", true),
                Some(Command::Restore(_)) => self.write(id, b"load", true),
                None => self.write(id, &value, true),
            }
            self.read(id);
            self.mistakes(id);
        }
        self.exchange
    }

    /// Asks, and gives the answer, of which there is none for an abort.
    fn ask(&mut self, request: [u8; 8]) -> Option<[u8; 8]> {
        let frame = Frame::full(self.channel.request, request);
        let answer = self.server.handle(&frame, &mut self.dictionary, &mut (), Instant::ZERO);
        let answer = answer.and_then(|answer| answer.bytes()?.try_into().ok());
        let bytes = answer.map(|answer: [u8; 8]| answer.to_vec()).unwrap_or_default();
        self.exchange.push(Exchange { request: request.to_vec(), answer: bytes });
        answer
    }

    fn read(&mut self, id: EntryId) -> Vec<u8> {
        let Some(answer) = self.ask(frame(0x40, id, 0)) else { return Vec::new() };
        let mut value = Vec::new();
        match answer[0] {
            0x41 => {
                for toggle in [0x60, 0x70].into_iter().cycle() {
                    let Some(answer) = self.ask([toggle, 0, 0, 0, 0, 0, 0, 0]) else { break };
                    value.extend_from_slice(&answer[1..8 - usize::from(answer[0] >> 1 & 7)]);
                    if answer[0] & 0x81 != 0 {
                        break;
                    }
                }
            }
            command if command & 0xE3 == 0x43 => {
                value.extend_from_slice(&answer[4..8 - usize::from(command >> 2 & 3)]);
            }
            _ => {}
        }
        value
    }

    /// Writes a value; with its length, or, in segments, without.
    fn write(&mut self, id: EntryId, value: &[u8], with_length: bool) {
        let length = u32::try_from(value.len()).unwrap_or(u32::MAX);
        if value.is_empty() {
            return;
        }
        if let 1..=4 = value.len() {
            let mut bytes = [0; 4];
            bytes[..value.len()].copy_from_slice(value);
            let unused = u8::try_from(4 - value.len()).unwrap_or_default();
            let command = if with_length { 0x23 | unused << 2 } else { 0x22 };
            self.ask(frame(command, id, u32::from_le_bytes(bytes)));
            return;
        }
        let begin = if with_length { frame(0x21, id, length) } else { frame(0x20, id, 0) };
        let mut pieces = value.chunks(7).peekable();
        let mut toggle = 0;
        let mut is_taken = self.ask(begin).is_some_and(|answer| answer[0] == 0x60);
        while let Some(piece) = pieces.next().filter(|_| is_taken) {
            let unused = u8::try_from(7 - piece.len()).unwrap_or_default();
            let mut request = [toggle | unused << 1 | u8::from(pieces.peek().is_none()), 0, 0, 0, 0, 0, 0, 0];
            request[1..=piece.len()].copy_from_slice(piece);
            is_taken = self.ask(request).is_some_and(|answer| answer[0] & 0xE0 == 0x20);
            toggle ^= 0x10;
        }
    }

    /// What a client does wrong: aborts, an unknown command, a toggle bit.
    fn mistakes(&mut self, id: EntryId) {
        self.ask(frame(0x80, id, 0x0800_0000));
        if self.ask(frame(0x40, id, 0)).is_some_and(|answer| answer[0] == 0x41) {
            self.ask([0x70, 0, 0, 0, 0, 0, 0, 0]);
        }
    }
}

fn frame(command: u8, EntryId { index, sub }: EntryId, data: u32) -> [u8; 8] {
    let [low, high] = index.to_le_bytes();
    let [a, b, c, d] = data.to_le_bytes();
    [command, low, high, sub, a, b, c, d]
}

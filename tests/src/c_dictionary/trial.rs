//! What dictionaries are asked: every entry at the ends of what it takes and beyond, communication objects through their states, PDOs with mappings of
//! all kinds, and then anything.

use firmware_glue::table::{Attributes, Flags, Place, Table};
use firmware_glue::{DataType, Dictionary, EntryId};

use super::protocol::{Reference, STORAGES};
use crate::fuzz::Random;

/// A request and its answer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Exchange {
    /// The request.
    pub request: Vec<u8>,
    /// The answer of the dictionary in Rust.
    pub answer: Vec<u8>,
}

/// Requests that are made while a dictionary in Rust answers them.
#[derive(Debug)]
pub struct Trial<D> {
    reference: Reference<D>,
    random: Random,
    exchange: Vec<Exchange>,
}

/// The application is unlocked.
const UNLOCKED: u8 = 1;
/// The application refuses every value.
const REFUSES: u8 = 2;

/// Numbers that COB-IDs, mappings and times turn at.
const TURNS: [u32; 34] = [
    0,
    1,
    2,
    3,
    5,
    127,
    128,
    240,
    241,
    252,
    253,
    254,
    255,
    0x7F,
    0x80,
    0x81,
    0x101,
    0x180,
    0x181,
    0x205,
    0x581,
    0x5FF,
    0x601,
    0x67F,
    0x6E0,
    0x701,
    0x7FF,
    0x0001_0064,
    0x0005_0000,
    0x0005_03E8,
    0x2000_0080,
    0x4000_0080,
    0x8000_0205,
    0xC000_0181,
];

impl<'t, D: Dictionary<'t>> Trial<D> {
    /// A trial of a dictionary; the same seed makes the same requests.
    pub fn new(reference: Reference<D>, seed: u64) -> Self {
        let mut trial = Self { reference, random: Random::new(seed), exchange: Vec::new() };
        trial.ask(&[b'f', 0, 0, 5]);
        trial
    }

    /// All requests, and the answers.
    pub fn exchange(mut self, random: usize) -> Vec<Exchange> {
        self.missing();
        self.entries();
        self.all_values();
        for _ in 0..3 {
            self.ask(&[b'f', 0, 0, 5]);
            self.pdos();
        }
        self.all_values();
        for at in 0..random {
            self.anything();
            if at % 50 == 49 {
                let group = u8::try_from(self.below(5)).unwrap_or_default();
                self.ask(&[b'C', group, 0, 5]);
                self.ask(b"i");
            }
            if at % 500 == 499 {
                self.all_values();
                let node = self.below(127) + 1;
                self.ask(&[b'f', 0, 0, u8::try_from(node).unwrap_or(1)]);
            }
        }
        self.all_values();
        self.exchange
    }

    fn table(&self) -> &'t Table<'t> {
        self.reference.dictionary.table()
    }

    fn rows(&self) -> u16 {
        u16::try_from(self.table().parts().entries.len()).unwrap_or(u16::MAX)
    }

    fn below(&mut self, end: usize) -> usize {
        self.random.below(end.max(1))
    }

    fn ask(&mut self, request: &[u8]) -> &[u8] {
        let answer = self.reference.answer(request);
        self.exchange.push(Exchange { request: request.to_vec(), answer });
        self.exchange.last().map_or(&[], |exchange| exchange.answer.as_slice())
    }

    fn access(
        &mut self,
        operation: u8,
        EntryId { index, sub }: EntryId,
        application: u8,
        data: &[u8],
    ) -> bool {
        let [low, high] = index.to_le_bytes();
        let request: Vec<u8> = [operation, low, high, sub, application].iter().chain(data).copied().collect();
        self.ask(&request).starts_with(&[0; 4])
    }

    /// Writes, and reads what came of it.
    fn write(&mut self, id: EntryId, application: u8, data: &[u8]) -> bool {
        let is_done = self.access(b'w', id, application, data);
        self.access(b'r', id, 0, &[]);
        is_done
    }

    fn all_values(&mut self) {
        self.ask(b"i");
        if self.reference.consistency.is_some() {
            self.ask(b"b");
        }
        for (number, storage) in (0..).zip(STORAGES) {
            let stored = self.reference.dictionary.stored(storage).to_vec();
            self.ask(&[b'g', number, 0, 5]);
            let other = EntryId { index: 0, sub: number };
            for (application, data) in
                [(0, &stored[..]), (UNLOCKED, &stored[..stored.len() / 2]), (UNLOCKED, &stored[..])]
            {
                if data.len() < 4000 {
                    self.access(b'R', other, application, data);
                }
            }
            if self.below(2) == 0 {
                self.ask(&[b'g', number, 0, 6]);
            }
        }
        self.ask(b"i");
    }

    fn missing(&mut self) {
        let mut indices = vec![0, 1, 0x1F, 0xFFFF];
        for row in 0..=self.rows() {
            self.access(b'k', EntryId { index: row, sub: 0 }, 0, &[]);
            let EntryId { index, sub } = self.table().id(row);
            indices.extend([index.wrapping_sub(1), index.wrapping_add(1), index.wrapping_add(32)]);
            for sub in [sub.wrapping_add(1), 255] {
                self.access(b'r', EntryId { index, sub }, 0, &[]);
                self.access(b'w', EntryId { index, sub }, UNLOCKED, &[0]);
            }
        }
        for index in indices {
            self.access(b'r', EntryId { index, sub: 0 }, 0, &[]);
            self.access(b'w', EntryId { index, sub: 3 }, UNLOCKED, &[0]);
        }
    }

    fn entries(&mut self) {
        for row in 0..self.rows() {
            let id = self.table().id(row);
            let shared = *self.table().attributes(row);
            self.access(b'u', id, 0, &[]);
            self.access(b'd', id, UNLOCKED, &[1, 2]);
            self.access(b'l', id, 0, &[]);
            for data in self.candidates(row, &shared) {
                self.write(id, UNLOCKED, &data);
            }
            let size = usize::from(shared.size).min(600);
            for length in [0, 1, size.saturating_sub(1), size, size + 1, size + 2] {
                for application in [0, UNLOCKED, UNLOCKED | REFUSES] {
                    self.write(id, application, &vec![0; length]);
                }
                self.write(id, UNLOCKED, &vec![0xFF; length]);
                self.write(id, UNLOCKED, &vec![b'~'; length]);
            }
            if row % 16 == 15 {
                self.ask(&[b'f', 0, 0, 5]);
            }
        }
    }

    /// Values at every end that the entry has.
    fn candidates(&mut self, row: u16, shared: &Attributes) -> Vec<Vec<u8>> {
        let size = usize::from(shared.size);
        if shared.data_type.is_string() {
            return self.texts(size);
        }
        if size == 0 || size > 8 {
            return vec![vec![0; size]];
        }
        let parts = self.table().parts();
        let mut numbers = vec![0, 1, -1, i64::MIN, i64::MAX];
        for bits in [7u32, 8, 15, 16, 23, 24, 31, 32, 39, 47, 55] {
            numbers.extend([(1 << bits) - 1, 1 << bits, -(1 << bits), -(1 << bits) - 1]);
        }
        let limits = parts.limits.get(usize::from(shared.limits));
        let ends = limits.into_iter().flat_map(|limits| [limits.low, limits.high]);
        let listed =
            parts.values.get(usize::from(shared.values)).into_iter().flat_map(|list| list.iter().copied());
        for number in ends.chain(listed) {
            numbers.extend([number.saturating_sub(1), number, number.saturating_add(1)]);
        }
        let mut candidates: Vec<Vec<u8>> = numbers
            .into_iter()
            .map(|number| {
                let bytes = bits_of(shared.data_type, number).to_le_bytes();
                bytes.get(..size).unwrap_or(&bytes).to_vec()
            })
            .collect();
        if row < parts.first_application_row {
            let turns = TURNS.iter().map(|turn| turn.to_le_bytes());
            candidates.extend(turns.map(|bytes| bytes.get(..size).unwrap_or(&bytes).to_vec()));
            let signatures = [*b"save", *b"load"].into_iter().filter(|_| size == 4).map(Vec::from);
            candidates.extend(signatures);
        }
        candidates
    }

    fn texts(&mut self, size: usize) -> Vec<Vec<u8>> {
        let mut texts = vec![
            b"a".to_vec(),
            b"a\0".to_vec(),
            b"a\0b".to_vec(),
            b"\0\0".to_vec(),
            vec![0x7F],
            vec![0x1F, 0],
        ];
        texts.extend([
            b"a\0b\0".to_vec(),
            b"a\0\0\0b\0".to_vec(),
            b"a\0\0".to_vec(),
            vec![b'q'; size],
            vec![b'q'; size / 2],
        ]);
        for _ in 0..4 {
            let length = self.below(size + 2);
            texts.push((0..length).map(|_| u8::try_from(self.below(256)).unwrap_or_default()).collect());
        }
        texts
    }

    fn pdos(&mut self) {
        let pdos: Vec<u16> = self.table().parts().pdos.iter().map(|pdo| pdo.index).collect();
        for index in [0x13FF, 0x1400, 0x17FF, 0x1800, 0x19FF].into_iter().chain(pdos) {
            self.exchange_pdo(index);
            let cob_id = EntryId { index, sub: 1 };
            let now = self.number(cob_id);
            self.write(cob_id, UNLOCKED, &(now | 1 << 31).to_le_bytes());
            self.exchange_pdo(index);
            let mapping = index.wrapping_add(0x200);
            self.write(EntryId { index: mapping, sub: 0 }, UNLOCKED, &[0]);
            let count = u8::try_from(self.below(9)).unwrap_or_default();
            for sub in 1..=count {
                let parameter = self.parameter();
                self.write(EntryId { index: mapping, sub }, UNLOCKED, &parameter.to_le_bytes());
            }
            for count in [count, count.saturating_sub(1), count / 2, 1] {
                if self.write(EntryId { index: mapping, sub: 0 }, UNLOCKED, &[count]) {
                    break;
                }
            }
            self.write(cob_id, UNLOCKED, &(0x185 + u32::from(index % 0x200)).to_le_bytes());
            self.exchange_pdo(index);
        }
    }

    /// Sends and receives a PDO, by the index of its communication object.
    fn exchange_pdo(&mut self, index: u16) {
        let number = if index < 0x1800 { index.wrapping_sub(0x13FF) } else { index - 0x17FF };
        let number = EntryId { index: number, sub: 0 };
        self.access(b'p', number, 0, &[]);
        for _ in 0..4 {
            let length = self.below(10);
            let narrow = self.below(2) == 0;
            let byte = |trial: &mut Self| {
                u8::try_from(trial.below(if narrow { 4 } else { 256 })).unwrap_or_default()
            };
            let data: Vec<u8> = (0..length).map(|_| byte(self)).collect();
            let application = [0, UNLOCKED, UNLOCKED | REFUSES][self.below(3)];
            self.access(b'n', number, application, &data);
        }
    }

    /// A mapping parameter, right ones more often than not.
    fn parameter(&mut self) -> u32 {
        if self.below(8) == 0 {
            let dummy = u32::try_from(self.below(9)).unwrap_or_default();
            let bits = [0, 1, 8, 16, 32, 8, 16, 32, 8][usize::try_from(dummy).unwrap_or_default()];
            return dummy << 16 | bits;
        }
        let direction = self.below(8);
        for _ in 0..60 {
            let row = self.row();
            let (EntryId { index, sub }, shared) = (self.table().id(row), *self.table().attributes(row));
            let flags = [Flags::RECEIVE, Flags::TRANSMIT];
            if direction > 0 && !shared.flags.has(flags[direction % 2]) {
                continue;
            }
            let bits = if shared.data_type == DataType::Boolean { 1 } else { u32::from(shared.size) * 8 };
            let bits = if self.below(16) == 0 { bits + 8 } else { bits };
            return u32::from(index) << 16 | u32::from(sub) << 8 | bits & 0xFF;
        }
        0
    }

    /// Puts bytes where the value of an entry lies, as the device itself does.
    fn put(&mut self, row: u16, data: &[u8]) {
        let shared = *self.table().attributes(row);
        let Some(entry) = self.table().parts().entries.get(usize::from(row)) else { return };
        if shared.place == Place::Image {
            let place = EntryId { index: entry.place, sub: shared.page };
            let mut data = data.get(..usize::from(shared.size)).unwrap_or(data).to_vec();
            if shared.data_type == DataType::Boolean {
                // What no BOOLEAN is, tables that are made at run time do not take for one.
                for byte in &mut data {
                    *byte &= 1;
                }
            }
            self.access(b's', place, 0, &data);
        }
    }

    fn row(&mut self) -> u16 {
        let rows = usize::from(self.rows());
        u16::try_from(self.below(rows)).unwrap_or_default()
    }

    /// The number that an entry has now.
    fn number(&mut self, id: EntryId) -> u32 {
        let value =
            self.reference.dictionary.read(id.index, id.sub).map(|value| value.to_vec()).unwrap_or_default();
        value.iter().take(4).rev().fold(0, |number, byte| number << 8 | u32::from(*byte))
    }

    fn anything(&mut self) {
        let row = self.row();
        let (id, shared) = (self.table().id(row), *self.table().attributes(row));
        let candidates = self.candidates(row, &shared);
        let chosen = self.below(candidates.len());
        let data = match self.below(4) {
            0 => (self.number(id) ^ 1 << self.below(32))
                .to_le_bytes()
                .iter()
                .copied()
                .take(shared.size.into())
                .collect(),
            1 => (0..shared.size).map(|_| u8::try_from(self.below(256)).unwrap_or_default()).collect(),
            _ => candidates.get(chosen).cloned().unwrap_or_default(),
        };
        let application = [0, UNLOCKED, UNLOCKED, UNLOCKED | REFUSES][self.below(4)];
        let is_consistent = self.reference.consistency.is_some() && self.below(2) == 0;
        self.access(if is_consistent { b'c' } else { b'w' }, id, application, &data);
        if self.below(3) == 0 {
            self.put(row, &data);
        }
        self.access(b'u', id, 0, &[]);
        if self.below(10) == 0 {
            let pdos = self.table().parts().pdos;
            let chosen = self.below(pdos.len());
            if let Some(pdo) = pdos.get(chosen) {
                self.exchange_pdo(pdo.index);
            }
        }
        if self.reference.consistency.is_some() {
            self.ask(b"b");
        }
    }
}

/// The bits of a value by the number that tables compare: see [`Limits`](firmware_glue::table::Limits).
fn bits_of(data_type: DataType, number: i64) -> u64 {
    let real = |sign: u32| if number < 0 { number.unsigned_abs() | 1 << sign } else { number.unsigned_abs() };
    match data_type {
        DataType::Unsigned64 => number.cast_unsigned() ^ 1 << 63,
        DataType::Real32 => real(31),
        DataType::Real64 => real(63),
        _ => number.cast_unsigned(),
    }
}

//! The requests of `tests/c/answer.h`, answered by a dictionary in Rust.

use firmware_glue::pdo::{self, PdoError};
use firmware_glue::storage::Command;
use firmware_glue::{AbortCode, Application, Constrained, Dictionary, Storage};

/// A dictionary in Rust, asked as the one in C is.
#[derive(Debug)]
pub struct Reference<D> {
    /// The dictionary.
    pub dictionary: D,
    /// What its constraints say, where it has any that can be asked.
    pub consistency: Option<Consistency<D>>,
}

/// How the constraints of a dictionary are asked.
#[derive(Debug)]
pub struct Consistency<D> {
    /// The position of the first that is broken, counted from 1; 0 for none.
    pub broken: fn(&D) -> u32,
    /// A write that keeps them.
    pub write: Write<D>,
}

/// A write to an index and sub-index.
type Write<D> = fn(&mut D, u16, u8, &[u8], &mut Recorder) -> Result<(), AbortCode>;

impl<D> Clone for Consistency<D> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<D> Copy for Consistency<D> {}

impl<D: Constrained> Reference<D> {
    /// A generated dictionary.
    pub fn generated(dictionary: D) -> Self {
        let consistency = Consistency {
            broken: |dictionary: &D| {
                let broken = D::CONSTRAINTS.iter().position(|constraint| !(constraint.holds)(dictionary));
                broken.map_or(0, |at| u32::try_from(at).map_or(u32::MAX, |at| at + 1))
            },
            write: |dictionary: &mut D, index, sub, data, application| {
                dictionary.write_consistent(index, sub, data, application).map(drop)
            },
        };
        Self { dictionary, consistency: Some(consistency) }
    }
}

impl<'t, D: Dictionary<'t>> Reference<D> {
    /// A dictionary without constraints.
    pub const fn plain(dictionary: D) -> Self {
        Self { dictionary, consistency: None }
    }
}

/// The application: it notes who asks it what.
#[derive(Debug, Default)]
pub struct Recorder {
    unlocked: bool,
    refuses: bool,
    calls: Vec<u8>,
    count: u16,
}

impl Recorder {
    fn note(&mut self, kind: u8, row: u16) {
        self.calls.push(kind);
        self.calls.extend(row.to_le_bytes());
        self.count += 1;
    }
}

impl<'t, D: Dictionary<'t>> Application<D> for Recorder {
    fn is_unlocked(&self) -> bool {
        self.unlocked
    }

    fn refresh(&mut self, dictionary: &mut D, entry: D::Entry) {
        self.note(0, dictionary.row(entry));
    }

    fn accept(&mut self, dictionary: &mut D, entry: D::Entry, _: &[u8]) -> Result<(), AbortCode> {
        self.note(1, dictionary.row(entry));
        if self.refuses { Err(AbortCode::LOCAL_CONTROL) } else { Ok(()) }
    }

    fn command(&mut self, _: &mut D, command: Command) -> Result<(), AbortCode> {
        let (Command::Save(sub) | Command::Restore(sub)) = command;
        self.note(if matches!(command, Command::Save(_)) { 3 } else { 4 }, sub.into());
        if self.refuses { Err(AbortCode::HARDWARE) } else { Ok(()) }
    }

    fn changed(&mut self, dictionary: &mut D, entry: D::Entry) {
        self.note(2, dictionary.row(entry));
    }
}

impl<'t, D: Dictionary<'t>> Reference<D> {
    /// The answer to a request.
    pub fn answer(&mut self, request: &[u8]) -> Vec<u8> {
        let byte = |at: usize| request.get(at).copied().unwrap_or_default();
        let (index, sub) = (u16::from_le_bytes([byte(1), byte(2)]), byte(3));
        let data = request.get(5..).unwrap_or_default();
        let mut application =
            Recorder { unlocked: byte(4) & 1 != 0, refuses: byte(4) & 2 != 0, ..Recorder::default() };
        let outcome = self.outcome(byte(0), index, sub, data, &mut application);
        let (code, value) = match outcome {
            Ok(value) => (0, value),
            Err((code, value)) => (code, value),
        };
        let head = code.to_le_bytes().into_iter().chain(application.count.to_le_bytes());
        head.chain(application.calls).chain(value).collect()
    }

    fn outcome(
        &mut self,
        operation: u8,
        index: u16,
        sub: u8,
        data: &[u8],
        application: &mut Recorder,
    ) -> Result<Vec<u8>, (u32, Vec<u8>)> {
        let refused = |code: AbortCode| (code.0, Vec::new());
        let done = |result: Result<(), AbortCode>| result.map(|()| Vec::new()).map_err(refused);
        let od = &mut self.dictionary;
        match operation {
            b'r' => od.read(index, sub).map(|value| value.to_vec()).map_err(refused),
            b'u' => od.upload(index, sub, application).map(|value| value.to_vec()).map_err(refused),
            b'w' => done(od.write(index, sub, data, application).map(drop)),
            b'd' => done(od.download_domain(index, sub, 0, data, true, application)),
            b'l' => done(od.upload_domain(index, sub, 0, &mut [0; 8], application).map(drop)),
            b'c' => match &self.consistency {
                Some(consistency) => done((consistency.write)(od, index, sub, data, application)),
                None => Err(refused(AbortCode::GENERAL)),
            },
            b'b' => match &self.consistency {
                Some(consistency) => match (consistency.broken)(od) {
                    0 => Ok(Vec::new()),
                    position => Err((position, Vec::new())),
                },
                None => Err(refused(AbortCode::GENERAL)),
            },
            b'p' => match pdo::pack(od, index, application) {
                Ok(frame) => Ok(frame.to_vec()),
                Err(error) => Err((number(error), Vec::new())),
            },
            b'n' => {
                let (code, received) = match pdo::unpack(od, index, data, application) {
                    Ok(received) => (0, Some(received)),
                    Err(error) => (number(error), None),
                };
                let too_long = received.is_some_and(|received| received.too_long);
                let refused = received.and_then(|received| received.refused);
                let row = refused.map_or(u16::MAX, |refused| od.row(refused.entry));
                let abort = refused.map_or(0, |refused| refused.code.0);
                let value =
                    [u8::from(too_long)].into_iter().chain(row.to_le_bytes()).chain(abort.to_le_bytes());
                Err((code, value.collect()))
            }
            b'f' => {
                od.reset(sub);
                Ok(Vec::new())
            }
            b'g' => {
                if let Some(storage) = STORAGES.get(usize::from(index)) {
                    od.reset_stored(*storage, sub);
                }
                Ok(Vec::new())
            }
            b's' => {
                let place = od.image_mut().iter_mut().skip(usize::from(sub) << 16 | usize::from(index));
                place.zip(data).for_each(|(byte, new)| *byte = *new);
                Ok(Vec::new())
            }
            b'k' => {
                let rows = od.table().parts().entries.len();
                let id = (usize::from(index) < rows).then(|| od.table().id(index));
                Ok(id.map_or_else(Vec::new, |id| [&id.index.to_le_bytes()[..], &[id.sub]].concat()))
            }
            b'R' => {
                let storage = STORAGES.get(usize::from(sub)).copied().unwrap_or(Storage::No);
                let layout = od.layout(storage).wrapping_add(u32::from(!application.unlocked));
                od.restore(storage, layout, data).map(|()| Vec::new()).map_err(|_| (1, Vec::new()))
            }
            b'C' => {
                let storage = STORAGES.get(usize::from(index)).copied().unwrap_or(Storage::No);
                match od.correct_stored(storage, sub) {
                    None => Ok(Vec::new()),
                    Some(entry) => Err((u32::from(od.row(entry)) + 1, Vec::new())),
                }
            }
            b'i' => Ok(od.image().to_vec()),
            _ => Err(refused(AbortCode::GENERAL)),
        }
    }
}

/// Storage groups by their numbers in C.
pub(super) const STORAGES: [Storage; 5] =
    [Storage::No, Storage::Communication, Storage::Application, Storage::Manufacturer, Storage::Remanent];

/// The number of an error in C.
const fn number(error: PdoError) -> u32 {
    match error {
        PdoError::NoPdo => 1,
        PdoError::NotValid => 2,
        PdoError::NotMapped => 3,
        PdoError::TooShort => 4,
        PdoError::NoValue(_) => 5,
        // None that the C knows.
        _ => u32::MAX,
    }
}

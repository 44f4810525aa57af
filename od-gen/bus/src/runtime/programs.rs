//! Programs that can be loaded into a virtual node (CiA 302-3): it keeps what is written to 1F50h, and runs nothing.

use std::collections::BTreeMap;

use firmware_glue::nmt::State as NmtState;
use firmware_glue::node::Reset;
use firmware_glue::{AbortCode, Dictionary as _, EntryId};

use super::LiveDictionary;
use crate::program::{CONTROL, Command, DATA, FLASH, FlashStatus, IDENTIFICATION, State};

/// The programs of a node, by their sub-index: those of which the dictionary has both data (1F50h) and control (1F51h).
#[derive(Debug)]
pub(super) struct Programs {
    programs: BTreeMap<u8, Program>,
    nmt: NmtState,
}

#[derive(Debug)]
struct Program {
    state: State,
    /// What 1F56h is; of the program that the device came with, what the dictionary says.
    identification: Option<u32>,
}

impl Programs {
    pub(super) fn of(dictionary: &LiveDictionary<'_>) -> Self {
        let has = |index, sub: &u8| dictionary.find(index, *sub).is_ok();
        let subs = (1..=254).filter(|sub| has(DATA, sub) && has(CONTROL, sub));
        let with_device = |sub| (sub, Program { state: State::Started, identification: None });
        Self { programs: subs.map(with_device).collect(), nmt: NmtState::PreOperational }
    }

    /// The node is in another state.
    pub(super) const fn enter(&mut self, state: NmtState) {
        self.nmt = state;
    }

    /// The node starts again, and with it each program that there is.
    pub(super) fn restart(&mut self, reset: Reset) {
        match reset {
            Reset::Communication => {}
            Reset::Node => {
                for program in self.programs.values_mut().filter(|program| program.state == State::Stopped) {
                    program.state = State::Started;
                }
            }
        }
    }

    /// Carries out a command of 1F51h.
    pub(super) fn accept(&mut self, entry: EntryId, value: &[u8]) -> Result<(), AbortCode> {
        let Some(program) = self.programs.get_mut(&entry.sub).filter(|_| entry.index == CONTROL) else {
            return Ok(());
        };
        let command = value.first().and_then(|code| Command::of(*code)).ok_or(AbortCode::INVALID_VALUE)?;
        if self.nmt != NmtState::PreOperational {
            return Err(AbortCode::DEVICE_STATE);
        }
        match (command, program.state) {
            (Command::Stop, State::Missing) | (Command::Start, State::Started) => {}
            (Command::Stop, _) => program.state = State::Stopped,
            (Command::Start | Command::Reset, State::Missing) | (Command::Clear, State::Started) => {
                return Err(AbortCode::DEVICE_STATE);
            }
            (Command::Start | Command::Reset, _) => program.state = State::Started,
            (Command::Clear, _) => (program.state, program.identification) = (State::Missing, Some(0)),
        }
        Ok(())
    }

    /// Whether an entry can be written now: program data only where no program is.
    pub(super) fn takes(&self, entry: EntryId) -> Result<(), AbortCode> {
        match self.programs.get(&entry.sub).filter(|_| entry.index == DATA) {
            Some(program) if program.state != State::Missing => Err(AbortCode::DEVICE_STATE),
            Some(_) | None => Ok(()),
        }
    }

    /// An entry was written as a whole.
    pub(super) fn loaded(&mut self, entry: EntryId, data: &[u8]) {
        if let Some(program) = self.programs.get_mut(&entry.sub).filter(|_| entry.index == DATA) {
            (program.state, program.identification) = (State::Stopped, Some(checksum(data)));
        }
    }

    /// Says in 1F51h, 1F56h and 1F57h what there is, as far as the dictionary has these.
    pub(super) fn report(&self, dictionary: &mut LiveDictionary<'_>) {
        for (sub, program) in &self.programs {
            let flash = match program.state {
                State::Missing => FlashStatus::NO_PROGRAM,
                State::Stopped | State::Started | State::Other(_) => FlashStatus::GOOD,
            };
            let entry = |index| EntryId { index, sub: *sub };
            let stated = dictionary.value(entry(IDENTIFICATION)).filter(|value| *value != [0; 4]);
            let mut hold = |index, value: &[u8]| {
                // What the dictionary states as a constant, or does not have, stays as it is.
                let _ = dictionary.hold(entry(index), value);
            };
            hold(CONTROL, &[program.state.code()]);
            hold(FLASH, &flash.0.to_le_bytes());
            match program.identification {
                Some(identification) => hold(IDENTIFICATION, &identification.to_le_bytes()),
                // 0 would say that there is no program.
                None if stated.is_none() => hold(IDENTIFICATION, &FACTORY.to_le_bytes()),
                None => {}
            }
        }
    }
}

/// What identifies the program that a device came with, where its dictionary does not say.
const FACTORY: u32 = 1;

/// CRC-32, as Ethernet has it.
fn checksum(data: &[u8]) -> u32 {
    let with = |crc: u32, byte: &u8| {
        let shifted = |crc: u32, _| crc >> 1 ^ if crc & 1 == 1 { 0xEDB8_8320 } else { 0 };
        (0..8).fold(crc ^ u32::from(*byte), shifted)
    };
    !data.iter().fold(u32::MAX, with)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_checksum_is_that_of_ethernet() {
        assert_eq!(checksum(b"123456789"), 0xCBF4_3926);
    }
}

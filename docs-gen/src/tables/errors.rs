//! Error codes and what the devices do about them.

use od_spec::model::{Dictionary, ErrorCode};

use super::Columns;
use super::variants::device_keys;
use crate::cell::entry_anchor;
use crate::language::Word;
use crate::source::Source;
use crate::view::{Align, Cell, Grid, Row};

/// Where links to an error code lead.
pub(crate) fn anchor(code: u16) -> String {
    format!("error-{code:04X}")
}

impl Source<'_> {
    /// An error code as people know it: `8611h`.
    pub(crate) fn error_code(&self, code: u16) -> String {
        self.wording.hexadecimal(code.into(), 4)
    }

    /// A link to what the list of errors says about a code.
    pub(crate) fn error_link(&self, code: u16) -> Cell {
        let text = self.error_code(code);
        if self.wanted(&[code]).next().is_none() {
            return Cell::plain(text);
        }
        Cell::default().link(text, anchor(code), "errors")
    }

    /// The wanted codes of the devices shown; none means all.
    fn wanted(&self, codes: &[u16]) -> impl Iterator<Item = &ErrorCode> {
        self.system
            .errors
            .iter()
            .filter(move |error| codes.is_empty() || codes.contains(&error.code))
            .filter(|error| self.shows_any(&error.devices))
    }

    /// One row per code, with a column for each device.
    pub(crate) fn errors(&self, codes: &[u16]) -> Grid {
        let mut columns =
            Columns::new().left(self, "code", Word::AlarmCode).left(self, "name", Word::Meaning);
        if self.devices.len() > 1 {
            for device in &self.devices {
                columns = columns.with("device", device.key.to_uppercase(), Align::Center);
            }
        }
        let columns =
            columns.center(self, "priority", Word::Priority).left(self, "description", Word::Description);
        let rows = self
            .wanted(codes)
            .map(|error| {
                let mut cells = vec![Cell::plain(self.error_code(error.code)), Cell::plain(&error.name)];
                if self.devices.len() > 1 {
                    cells.extend(self.devices.iter().map(|device| {
                        Cell::plain(if error.devices.includes(&device.key) { "X" } else { "" })
                    }));
                }
                cells.push(error.priority.as_ref().map_or_else(Cell::default, Cell::plain));
                cells.push(self.text(&error.about));
                Row::of(cells)
            })
            .collect();
        columns.grid(rows, &["code", "name", "device"])
    }

    /// One row per code with the reaction.
    pub(crate) fn reactions(&self, codes: &[u16]) -> Grid {
        let rows = self
            .wanted(codes)
            .map(|error| {
                Row::of(vec![Cell::plain(&error.name), self.error_link(error.code), self.reaction(error)])
            })
            .collect();
        Columns::new()
            .left(self, "name", Word::Errors)
            .left(self, "code", Word::AlarmCode)
            .left(self, "reaction", Word::Reaction)
            .grid(rows, &["name", "code", "reaction"])
    }

    /// All codes with priority, reaction and the bits that show them.
    pub(crate) fn error_reference(&self) -> Grid {
        let rows = self
            .wanted(&[])
            .map(|error| {
                let devices = self.devices.iter().copied();
                let devices: Vec<&Dictionary> =
                    devices.filter(|device| error.devices.includes(&device.key)).collect();
                Row {
                    anchor: anchor(error.code),
                    ..Row::of(vec![
                        Cell::plain(self.error_code(error.code)),
                        Cell::plain(&error.name),
                        Cell::plain(device_keys(&devices)),
                        error.priority.as_ref().map_or_else(Cell::default, Cell::plain),
                        self.reaction(error),
                        self.reported_by(error.code),
                        self.text(&error.about),
                    ])
                }
            })
            .collect();
        Columns::new()
            .left(self, "code", Word::AlarmCode)
            .left(self, "name", Word::Meaning)
            .left(self, "device", Word::Device)
            .center(self, "priority", Word::Priority)
            .left(self, "reaction", Word::Reaction)
            .left(self, "reported_by", Word::ReportedBy)
            .left(self, "description", Word::Description)
            .grid(rows, &["code", "name"])
    }

    /// What the devices do, and what entry chooses it.
    fn reaction(&self, error: &ErrorCode) -> Cell {
        let cell = self.text(&error.reaction);
        let Some(id) = error.option_code else { return cell };
        let its_device =
            |device: &&Dictionary| error.devices.includes(&device.key) && device.entry(id).is_some();
        // Where the devices shown do not have it, the one that has it is another.
        let mut devices = self.devices.iter().copied().chain(&self.system.devices);
        let Some(device) = devices.find(its_device) else { return cell };
        let words = self.word(Word::ChosenBy);
        let (before, behind) = words.split_once("{n}").unwrap_or((words, ""));
        cell.line().text(before).and(self.named_entry(device, id)).text(behind)
    }

    /// The bits that are set together with a code. Where devices differ, they are named.
    fn reported_by(&self, code: u16) -> Cell {
        let mut cell = Cell::default();
        for id in self.showing(code).iter().copied() {
            let bits = |device: &Dictionary| {
                device.entry(id).map_or_else(Vec::new, |entry| entry.bits_of_error(code))
            };
            let variants = self.variants(id.index, |device, _| bits(device));
            for devices in &variants {
                let Some(device) = devices.first() else { continue };
                for bit in bits(device) {
                    let place = if variants.len() > 1 {
                        format!("{} {id}", device_keys(devices))
                    } else {
                        id.to_string()
                    };
                    let text = format!("{place} {} {bit}", self.word(Word::Bit));
                    cell = cell.line().link(text, format!("{}.b{bit}", entry_anchor(id)), &*device.key);
                }
            }
        }
        cell
    }
}

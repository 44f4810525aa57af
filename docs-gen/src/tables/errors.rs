//! Error codes and what the devices do about them.

use od_spec::model::{AnyError, Devices, Dictionary, ErrorCode, Fact, Text};

use super::Columns;
use super::variants::device_keys;
use crate::language::Word;
use crate::source::Source;
use crate::view::cell::entry_anchor;
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

    /// The wanted codes of the devices shown, in their order; none means all.
    fn wanted(&self, codes: &[u16]) -> impl Iterator<Item = &ErrorCode> {
        let errors = &self.system.errors;
        let all: Vec<&ErrorCode> = if codes.is_empty() {
            errors.iter().collect()
        } else {
            let found = |code: &u16| errors.binary_search_by_key(code, |error| error.code).ok();
            codes.iter().filter_map(found).map(|at| &errors[at]).collect()
        };
        all.into_iter().filter(|error| self.shows_any(&error.devices))
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
        let columns = columns
            .center(self, "priority", Word::Priority)
            .left(self, "register", Word::ErrorRegister)
            .left(self, "description", Word::Description);
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
                cells.push(self.register(error));
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
                        self.devices_cell(&devices),
                        error.priority.as_ref().map_or_else(Cell::default, Cell::plain),
                        self.reaction(error),
                        self.reported_by(error.code),
                        self.register(error),
                        self.reset(error, &devices),
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
            .left(self, "register", Word::ErrorRegister)
            .left(self, "reset", Word::ResetBy)
            .left(self, "description", Word::Description)
            .grid(rows, &["code", "name"])
    }

    /// What holds for every error, a row for each device that says something about it; what it leaves open is said to be open.
    pub(crate) fn any_error(&self) -> Grid {
        let rows =
            self.devices.iter().filter(|device| device.any_error != AnyError::default()).map(|device| {
                let on = Devices::one(&device.key);
                let AnyError { shown, reaction, reset, .. } = &device.any_error;
                let said = [(shown, Fact::Shown), (reaction, Fact::Reaction), (reset, Fact::Reset)];
                let said = said.map(|(text, fact)| {
                    let cell = self.text_on(&on, text).stated(self.stated_of_device(device, fact));
                    if cell.is_empty() { Cell::plain(self.word(Word::NotStated)) } else { cell }
                });
                Row::of(std::iter::once(self.devices_cell(&[*device])).chain(said).collect())
            });
        Columns::new()
            .left(self, "device", Word::Device)
            .left(self, "shown", Word::ReportedBy)
            .left(self, "reaction", Word::Reaction)
            .left(self, "reset", Word::ResetBy)
            .grid(rows.collect(), &["shown", "reaction", "reset"])
    }

    /// The devices of a row; nothing where only one is shown.
    fn devices_cell(&self, devices: &[&Dictionary]) -> Cell {
        if self.devices.len() > 1 { Cell::plain(device_keys(devices)) } else { Cell::default() }
    }

    /// The columns of the list of codes that have no description, in words; empty where there are none.
    pub(crate) fn unsaid_of_errors(&self, list: &Grid) -> String {
        let columns =
            [("reaction", Word::Reaction), ("reported_by", Word::ReportedBy), ("reset", Word::ResetBy)];
        let is_missing = |key: &str| list.columns.iter().all(|column| column.key != key);
        let missing = columns.into_iter().filter(|(key, _)| is_missing(key));
        missing.map(|(_, word)| self.word(word)).collect::<Vec<_>>().join(", ")
    }

    /// The kinds of error that are stated; what follows from the class of the code is no news.
    fn register(&self, error: &ErrorCode) -> Cell {
        let kinds = error.kinds.iter().map(|kind| self.wording.error_kind(*kind));
        Cell::plain(kinds.collect::<Vec<_>>().join(", "))
    }

    /// What resets an error on these devices; where they differ, each is named.
    fn reset(&self, error: &ErrorCode, devices: &[&Dictionary]) -> Cell {
        let mut groups: Vec<(&Text, Vec<&Dictionary>)> = Vec::new();
        for device in devices {
            let text = error.reset_on(device);
            match groups.iter_mut().find(|(other, _)| *other == text) {
                Some((_, devices)) => devices.push(device),
                None => groups.push((text, vec![device])),
            }
        }
        let several = groups.len() > 1;
        groups.iter().filter(|(text, _)| !text.is_empty()).fold(Cell::default(), |cell, (text, devices)| {
            let keys = devices.iter().map(|device| device.key.clone()).collect();
            let cell = cell.line();
            let cell = if several { cell.text(format!("{}: ", device_keys(devices))) } else { cell };
            cell.and(self.text_on(&Devices::Only(keys), text))
        })
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
        let (before, behind) = words.split_once("{1}").unwrap_or((words, ""));
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

//! Dictionaries that are served without being compiled: the plan that prints Rust, as lists that a program owns.
//!
//! A virtual node answers by the same code as the firmware ([`firmware_glue::Dictionary`]), with the same table. What the table
//! does not hold, the conditions, is evaluated from the plan.
//!
//! A table borrows its lists, and some of these lists name others. So there are three steps, each of which is kept while the next
//! is used: [`Device`] owns everything, [`Device::lists`] are the lists of lists, [`Lists::table`] is the table.

mod bus;
mod condition;
mod glue;
mod host;
mod lists;
mod node;
mod programs;

use firmware_glue::table::{Row, Table};
use firmware_glue::{AbortCode, Dictionary, Entries, EntryId, TableDictionary, WrongSize};
use od_gen::plan::{decided_anyhow, plan};
use od_gen::rust::Rust;
use od_spec::diag::{Diagnostic, Diagnostics, Severity, codes};
use od_spec::model::{self, System};

pub use self::bus::Bus;
pub use self::host::Checks;
pub use self::lists::{Device, Lists};
pub use self::node::{NoNode, VirtualNode};

/// The lists of a device. What no dictionary can have (more than 16 MiB of values, numbers that leave 64 bits) is reported, and
/// nothing comes out. The names that code would have are not visible, so none of them is too few or too many; a text
/// without a capacity gets that of an EDS: its default, and at least 32 bytes.
pub fn device(system: &System, device: &model::Dictionary, diagnostics: &mut Diagnostics) -> Option<Device> {
    let device = decided_anyhow(device, &Rust);
    let mut found = Diagnostics::new();
    let plan = plan(system, &device, &Rust, &mut found);
    let is_whole = plan.entries.len() == device.entries().count();
    let mut is_usable = is_whole;
    for diagnostic in found.iter().filter(|one| !is_whole || !is_about_names(one)) {
        is_usable &= diagnostic.severity() != Severity::Error;
        diagnostics.push(diagnostic.clone());
    }
    is_usable.then(|| Device::of(&plan))
}

fn is_about_names(diagnostic: &Diagnostic) -> bool {
    [codes::IDENTIFIER_CLASH, codes::NO_IDENTIFIER].contains(&diagnostic.code)
}

/// The dictionary of a virtual node: a table, values, and the conditions between them.
#[derive(Debug, Clone)]
pub struct LiveDictionary<'t> {
    values: TableDictionary<'t, Vec<u8>>,
    device: &'t Device,
}

impl<'t> LiveDictionary<'t> {
    /// A dictionary with the values after a factory reset, for a node-ID from 1 to 127.
    ///
    /// # Errors
    /// [`WrongSize`] when the table is not that of the device.
    pub fn new(device: &'t Device, table: &'t Table<'t>, node_id: u8) -> Result<Self, WrongSize> {
        let image = vec![0; device.image_size()];
        Ok(Self { values: TableDictionary::new(table, image, node_id)?, device })
    }

    /// The names of the constraints that the present values break.
    pub fn broken_constraints(&self) -> impl Iterator<Item = &'t str> {
        let device = self.device;
        let broken = |constraint: &&lists::Constraint| !constraint.holds(&|row| self.number(row));
        device.constraints().iter().filter(broken).map(|constraint| constraint.name.as_str())
    }

    /// What LSS can set up, if the device has it.
    fn lss(&self) -> Option<&'t lists::Lss> {
        self.device.lss()
    }

    /// Puts a value as the device itself does, whatever a client may write; of an alias, into the entry that it shows.
    ///
    /// # Errors
    /// Why the entry cannot have it.
    pub fn hold(&mut self, entry: EntryId, value: &[u8]) -> Result<(), AbortCode> {
        let row = self.values.table().find(entry.index, entry.sub)?;
        self.values.hold(row, value)
    }

    /// The value of an entry, whatever its access; `None` where it has none that could be shown.
    pub fn value(&self, entry: EntryId) -> Option<Vec<u8>> {
        let row = self.values.table().find(entry.index, entry.sub).ok()?;
        self.values.held(row).ok().map(|value| value.to_vec())
    }

    /// Whether every constraint that holds now would hold with a value of an entry; a value that the entry cannot have changes nothing.
    pub(crate) fn stays_consistent(&self, entry: EntryId, value: &[u8]) -> bool {
        let mut with = self.clone();
        if with.hold(entry, value).is_err() {
            return true;
        }
        let mut constraints = self.device.constraints().iter();
        constraints.all(|one| one.holds(&|row| with.number(row)) || !one.holds(&|row| self.number(row)))
    }

    /// The number in a row as a condition sees it: 0 for what is not a number, and for what an alias cannot show.
    fn number(&self, row: Row) -> i128 {
        let shared = self.values.table().attributes(row);
        self.values.held(row).map_or(0, |value| condition::number(shared.data_type, &value))
    }
}

impl Entries for LiveDictionary<'_> {
    type Entry = EntryId;
}

impl<'t> Dictionary<'t> for LiveDictionary<'t> {
    fn table(&self) -> &'t Table<'t> {
        self.values.table()
    }

    fn entry(&self, row: Row) -> Option<EntryId> {
        self.values.entry(row)
    }

    fn row(&self, entry: EntryId) -> Row {
        self.values.row(entry)
    }

    fn image(&self) -> &[u8] {
        self.values.image()
    }

    fn image_mut(&mut self) -> &mut [u8] {
        self.values.image_mut()
    }

    fn is_lss_slave(&self) -> bool {
        self.lss().is_some()
    }

    fn condition(&self, number: u16) -> bool {
        let condition = self.device.conditions().get(usize::from(number));
        condition.is_none_or(|condition| condition.holds(&|row| self.number(row)))
    }
}

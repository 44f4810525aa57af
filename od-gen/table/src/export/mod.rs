//! A device as tables that can be imported again.

mod csv;
mod held;
mod tables;
mod workbook;

use od_spec::model::{Dictionary, System};

pub(crate) use tables::pdo_rows;

/// The tables of a device as a file.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Exported {
    /// The file.
    pub bytes: Vec<u8>,
    /// What the device has and tables do not hold, each kind with its number.
    pub not_held: Vec<String>,
}

/// A table of an export.
pub(crate) struct Table {
    pub name: &'static str,
    pub titles: Vec<String>,
    pub rows: Vec<Vec<Value>>,
}

/// A cell of an export.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Value {
    Text(String),
    Number(i64),
}

impl Value {
    pub(crate) fn text(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Number(number) => number.to_string(),
        }
    }

    fn is_empty(&self) -> bool {
        matches!(self, Self::Text(text) if text.is_empty())
    }
}

/// The device as a workbook with a sheet for each table; `None` if it has more rows or longer texts than a workbook holds.
pub fn xlsx(system: &System, device: &Dictionary) -> Option<Exported> {
    let held = held::held(system, device);
    let bytes = workbook::write(&tables::tables(&held.system, &held.device))?;
    Some(Exported { bytes, not_held: held.lost })
}

/// The device as a text with the tables one after the other, divided by semicolons.
pub fn csv(system: &System, device: &Dictionary) -> Exported {
    let held = held::held(system, device);
    let text = csv::write(&tables::tables(&held.system, &held.device));
    Exported { bytes: text.into_bytes(), not_held: held.lost }
}

/// The device without what tables do not hold: importing its tables gives this again.
pub fn as_held(system: &System, device: &Dictionary) -> (System, Dictionary) {
    let held = held::held(system, device);
    (held.system, held.device)
}

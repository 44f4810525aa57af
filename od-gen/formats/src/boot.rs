//! What different tools write into a node when it boots, made from the same DCF: in which order, and what of it is dangerous.
//!
//! CiA 306 says what is in a DCF, and not what a tool does with it. A PLC that creates an SDO for every entry writes
//! the defaults, too; a configuration tool writes what differs; a master with a concise DCF writes what was made for
//! it.

use std::fmt::Write as _;

use od_spec::Commissioning;
use od_spec::model::{
    DataType, Dictionary, EdsPolicy, Entry, EntryId, Index, NoSuchValue, Storage, System, Value,
};
use od_spec::wording::{Notation, Wording};

const WORDING: Wording = Wording::english(Notation::Diagnostic);

/// CODESYS, asked to create all SDOs, leaves the objects of the communication profile to its own settings.
const FIRST_OF_CODESYS: Index = Index(0x2000);

/// Who writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Writer {
    /// A PLC that creates an SDO for every writable entry that has a value in the DCF, be it the default.
    EverySdo,
    /// A master with a concise DCF (CiA 302), in the order of [`od_spec::model::download`].
    ConciseDcf,
    /// A configuration tool that downloads the parameter values of the DCF.
    ParameterValues,
}

impl Writer {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::EverySdo, Self::ConciseDcf, Self::ParameterValues];

    /// Who that is.
    const fn words(self) -> &'static str {
        match self {
            Self::EverySdo => {
                "a PLC that creates an SDO for every writable entry with a value in the DCF, by index"
            }
            Self::ConciseDcf => "a master with a concise DCF, in the order that the device takes",
            Self::ParameterValues => {
                "a configuration tool that downloads the DCF's parameter values, by index"
            }
        }
    }
}

/// What is to be known about a write.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mark {
    /// The entry is locked: factory data.
    Locked,
    /// The entry triggers a command, and is flagged as not to be written.
    Command,
    /// It was not set, and the device keeps it: the default goes over whatever was stored.
    OverStored,
    /// It was not set, and it shows an entry that was set before: the default goes over that.
    OverSet,
    /// It was not set: the default is written.
    Default,
    /// It was set, to another value than the default, and goes over what the device keeps.
    SetStored,
    /// It was set, to another value than the default.
    Set,
    /// It was set to its default.
    SetToDefault,
    /// A step on the way: something is switched off, and on again.
    Step,
}

impl Mark {
    /// Whether it may destroy what was not meant.
    pub const fn is_dangerous(self) -> bool {
        match self {
            Mark::Locked | Mark::Command | Mark::OverStored | Mark::OverSet => true,
            Mark::Default | Mark::SetStored | Mark::Set | Mark::SetToDefault | Mark::Step => false,
        }
    }

    const fn sign(self) -> &'static str {
        match self {
            Mark::Locked | Mark::Command | Mark::OverStored | Mark::OverSet => "!!",
            Mark::SetStored => "*s",
            Mark::Set => "* ",
            Mark::Default | Mark::SetToDefault | Mark::Step => "  ",
        }
    }
}

/// One write.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct BootWrite {
    /// The entry.
    pub id: EntryId,
    /// The value.
    pub value: Value,
    /// What is to be known about it.
    pub mark: Mark,
}

/// What is written into a node, in order.
///
/// # Errors
/// A value that no entry of the device can have.
pub fn writes(
    system: &System,
    device: &Dictionary,
    node: &Commissioning,
    writer: Writer,
) -> Result<Vec<BootWrite>, NoSuchValue> {
    let every = || device.entries().filter(|(.., entry)| entry.data_type != DataType::Domain);
    Ok(match writer {
        Writer::EverySdo => every()
            .filter_map(|(id, _, entry)| {
                let eds = shown(entry, node, id);
                let default = entry.default.as_ref().filter(|_| eds.default);
                let value = node.values.get(&id).or(default).filter(|_| eds.access.is_writable())?;
                let mark = match mark(entry, node, id, value) {
                    Mark::Default if is_set_before(device, node, id) => Mark::OverSet,
                    mark => mark,
                };
                Some(BootWrite { id, value: value.clone(), mark })
            })
            .collect(),
        Writer::ParameterValues => every()
            .filter_map(|(id, _, entry)| {
                let eds = shown(entry, node, id);
                let value = node.values.get(&id).filter(|_| eds.access.is_writable() && !eds.no_write)?;
                Some(BootWrite { id, value: value.clone(), mark: mark(entry, node, id, value) })
            })
            .collect(),
        Writer::ConciseDcf => node
            .download(system, device)?
            .into_iter()
            .filter_map(|write| {
                let entry = device.entry(write.id)?;
                let meant = node.values.get(&write.id).or(entry.default.as_ref());
                let is_meant = |value: &&Value| {
                    value.bytes_for(entry.data_type, node.node).as_deref() == Some(write.bytes.as_slice())
                };
                Some(match meant.filter(is_meant) {
                    Some(value) => {
                        let mark = mark(entry, node, write.id, value);
                        BootWrite { id: write.id, value: value.clone(), mark }
                    }
                    None => {
                        let value = Value::Integer(number(&write.bytes));
                        BootWrite { id: write.id, value, mark: Mark::Step }
                    }
                })
            })
            .collect(),
    })
}

/// What the DCF of the node shows of an entry.
fn shown(entry: &Entry, node: &Commissioning, id: EntryId) -> EdsPolicy {
    if node.unlocked.contains(&id) { entry.eds_while_unlocked() } else { entry.eds }
}

/// Only integers have steps on the way.
fn number(bytes: &[u8]) -> i128 {
    bytes.iter().rev().fold(0, |number, byte| number << 8 | i128::from(*byte))
}

fn mark(entry: &Entry, node: &Commissioning, id: EntryId, value: &Value) -> Mark {
    let is_default = entry.default.as_ref().is_some_and(|default| {
        let same = default.integer_for(node.node).zip(value.integer_for(node.node));
        default == value || same.is_some_and(|(one, other)| one == other)
    });
    match node.values.contains_key(&id) {
        _ if entry.locked => Mark::Locked,
        _ if entry.eds.no_write => Mark::Command,
        true if is_default => Mark::SetToDefault,
        true if is_kept(entry.stored) => Mark::SetStored,
        true => Mark::Set,
        false if is_kept(entry.stored) => Mark::OverStored,
        false => Mark::Default,
    }
}

/// Whether an entry that shows the same value was set, and is written first.
fn is_set_before(device: &Dictionary, node: &Commissioning, id: EntryId) -> bool {
    let holder = |id: EntryId| {
        device.entry(id).and_then(|entry| entry.alias.as_ref()).map_or(id, |alias| alias.target)
    };
    node.values.keys().any(|set| *set < id && holder(*set) == holder(id))
}

/// Whether the entry is a parameter of the application, which a user may have measured or set; communication parameters
/// are the PLC's affair.
const fn is_kept(stored: Storage) -> bool {
    match stored {
        Storage::Application | Storage::Manufacturer | Storage::Remanent => true,
        Storage::No | Storage::Communication => false,
    }
}

/// What each kind of tool would write into the node at boot, in order, as text.
///
/// # Errors
/// A value that no entry of the device can have.
pub fn explain(system: &System, device: &Dictionary, node: &Commissioning) -> Result<String, NoSuchValue> {
    let mut out =
        format!("What is written into {} node {} at boot, made from this DCF:\n", device.key, node.node);
    for (number, writer) in (1..).zip(Writer::ALL) {
        let writes = writes(system, device, node, writer)?;
        let _ = write!(out, "\n{number}. {}: {}\n", writer.words(), counted(writes.iter()));
        if writer == Writer::EverySdo {
            let of_codesys = writes.iter().filter(|write| write.id.index >= FIRST_OF_CODESYS);
            let _ = writeln!(out, "   CODESYS does so from {FIRST_OF_CODESYS} on: {}", counted(of_codesys));
        }
        for write in &writes {
            line(device, node, write, &mut out);
        }
    }
    out.push_str(
        "\n*  set, and not the default; s: over a value that the device keeps\n!! locked, a command, or a default that was not set and that goes over what was set or is kept\n",
    );
    Ok(out)
}

/// How many writes there are, and how many of them may destroy something.
fn counted<'w>(writes: impl Iterator<Item = &'w BootWrite>) -> String {
    let (mut all, mut dangerous) = (0, 0);
    for write in writes {
        all += 1;
        dangerous += usize::from(write.mark.is_dangerous());
    }
    if dangerous == 0 {
        format!("{all} writes")
    } else {
        format!("{all} writes, {dangerous} of them DANGEROUS")
    }
}

fn line(device: &Dictionary, node: &Commissioning, write: &BootWrite, out: &mut String) {
    let BootWrite { id, value, mark } = write;
    let Some(entry) = device.entry(*id) else { return };
    let name = device.entry_name(*id).unwrap_or_default();
    let text = |value: &Value| WORDING.value(Some(id.index), entry, &resolved(value, node.node));
    let default = || match &entry.default {
        Some(default) => format!("the default is {}", text(default)),
        None => "there is no default".to_owned(),
    };
    let words = match mark {
        Mark::Locked => format!("LOCKED, factory data; {}", default()),
        Mark::Command => "a command, which tools must not write".to_owned(),
        Mark::OverStored => {
            format!("not set; {}", WORDING.storage(entry.stored))
        }
        Mark::OverSet => "not set, and it goes over the value that was set before".to_owned(),
        Mark::Default => "the default".to_owned(),
        Mark::SetStored => format!("set; {}; {}", default(), WORDING.storage(entry.stored)),
        Mark::Set => format!("set; {}", default()),
        Mark::SetToDefault => "set, to the default".to_owned(),
        Mark::Step => "a step on the way".to_owned(),
    };
    let _ = writeln!(out, "{} {:<9} {name} = {}  ({words})", mark.sign(), id.to_string(), text(value));
}

/// A formula as the number that it is on the node.
fn resolved(value: &Value, node: u8) -> Value {
    match value.integer_for(node) {
        Some(raw) => Value::Integer(raw),
        None => value.clone(),
    }
}

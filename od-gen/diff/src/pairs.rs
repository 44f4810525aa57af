//! Which device of one system is which of the other.

use std::fmt;

use od_spec::model::{Dictionary, System};

use super::Question;
use super::change::{Change, Class, Place};

/// Why devices cannot be paired.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Unpaired {
    /// Neither system has a device with this key.
    NoSuchDevice {
        /// The key.
        key: String,
        /// Those that there are.
        keys: Vec<String>,
    },
    /// One side describes one device, and none of the other side's has its key.
    WhichDevice {
        /// The keys of the other side.
        keys: Vec<String>,
    },
}

impl fmt::Display for Unpaired {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSuchDevice { key, .. } => write!(f, "there is no device `{key}`"),
            Self::WhichDevice { .. } => {
                f.write_str("one side describes one device, and the other several, none of them by its name")
            }
        }
    }
}

impl std::error::Error for Unpaired {}

/// The devices to compare, and those that only one side has.
pub(super) struct Pairs<'a> {
    pub pairs: Vec<(&'a Dictionary, &'a Dictionary)>,
    pub unpaired: Vec<Change>,
}

/// Pairs devices by key; the only one of each side in any case.
pub(super) fn pair<'a>(question: &Question<'a>) -> Result<Pairs<'a>, Unpaired> {
    let (old, new) = match question.device {
        None => (all(question.old), all(question.new)),
        Some(key) => {
            let found = question.old.device(key).is_some() || question.new.device(key).is_some();
            if !found {
                let keys = question.old.devices.iter().chain(&question.new.devices);
                let mut keys: Vec<String> = keys.map(|device| device.key.clone()).collect();
                keys.sort();
                keys.dedup();
                return Err(Unpaired::NoSuchDevice { key: key.to_owned(), keys });
            }
            (chosen(question.old, key), chosen(question.new, key))
        }
    };
    if let ([before], [after]) = (old.as_slice(), new.as_slice()) {
        return Ok(Pairs { pairs: vec![(before, after)], unpaired: Vec::new() });
    }
    let other = |device: &Dictionary, side: &[&'a Dictionary]| -> Option<&'a Dictionary> {
        side.iter().find(|one| one.key == device.key).copied()
    };
    let pairs: Vec<_> = new.iter().filter_map(|after| Some((other(after, &old)?, *after))).collect();
    // An EDS describes one device, and says nothing about the others of its system.
    if !question.scope.is_everything() && (old.len() == 1 || new.len() == 1) {
        if pairs.is_empty() {
            let several = if old.len() == 1 { &new } else { &old };
            let keys = several.iter().map(|device| device.key.clone()).collect();
            return Err(Unpaired::WhichDevice { keys });
        }
        return Ok(Pairs { pairs, unpaired: Vec::new() });
    }
    let gone = old.iter().filter(|device| other(device, &new).is_none()).map(|device| {
        Change::removed(Place::Device, &device.name)
            .named(&device.key)
            .so(Class::Plc, "no device of this kind is described any more")
            .so(Class::Firmware, "its generated code is gone")
    });
    let came = new.iter().filter(|device| other(device, &old).is_none()).map(|device| {
        Change::added(Place::Device, &device.name)
            .named(&device.key)
            .so(Class::Addition, "nothing uses it yet")
    });
    Ok(Pairs { unpaired: gone.chain(came).collect(), pairs })
}

fn all(system: &System) -> Vec<&Dictionary> {
    system.devices.iter().collect()
}

/// The device with this key, or the only one.
fn chosen<'a>(system: &'a System, key: &str) -> Vec<&'a Dictionary> {
    match (system.device(key), system.devices.as_slice()) {
        (Some(device), _) | (None, [device]) => vec![device],
        (None, _) => Vec::new(),
    }
}

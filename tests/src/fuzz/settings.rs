//! What is demanded of every list of settings, however wrong.

use std::collections::BTreeSet;

use od_formats::eds;
use od_spec::diag::{Diagnostics, Severity};
use od_spec::model::{Dictionary, System, Value};
use od_spec::source::{SourceMap, Spanned};
use od_spec::{Commissioning, Compiled, NoFiles, ParameterValues, Strictness, assign, compile_as, read_text};

use super::bounds::caught;
use super::findings;
use super::notation::{Notation, SETTINGS};
use super::{Complaint, Seed, Subject};
use crate::{Failure, compile_with_sources};

/// Settings for the devices of the repository, a line each. The name of a text says whose they are.
#[derive(Debug)]
pub struct Settings {
    devices: Vec<Target>,
}

/// A device that takes settings.
#[derive(Debug)]
struct Target {
    name: String,
    sources: SourceMap,
    system: System,
    device: usize,
    /// The settings that mutants begin with.
    seed: BTreeSet<String>,
}

/// Where the devices are described.
const SPECIFICATIONS: [&str; 3] = [
    "od-spec/devices/pitch-control-system.od.yaml",
    "od-spec/devices/fullmo-drive.od.yaml",
    "tests/ui/ok_everything.od.yaml",
];

/// The node whose settings they are.
const NODE: u8 = 5;
/// Of a text with more lines, the others are left.
const MOST_SETTINGS: usize = 100;

impl Settings {
    /// Settings for all devices of the repository.
    ///
    /// # Errors
    /// A specification cannot be read.
    pub fn new() -> Result<Self, Failure> {
        let mut devices = Vec::new();
        for path in SPECIFICATIONS {
            let (system, sources) = compile_with_sources(path)?;
            devices.extend(system.devices.iter().enumerate().map(|(at, device)| Target {
                name: format!("{}.settings", device.key),
                sources: sources.clone(),
                system: system.clone(),
                device: at,
                seed: lines(device).collect(),
            }));
        }
        Ok(Self { devices })
    }

    /// Texts to begin with, one for each device.
    pub fn seeds(&self) -> Vec<Seed> {
        let seed = |target: &Target| {
            let text: String = target.seed.iter().flat_map(|line| [line.as_str(), "\n"]).collect();
            Seed { name: target.name.clone(), bytes: text.into_bytes() }
        };
        self.devices.iter().map(seed).collect()
    }
}

/// A setting of every entry: its default, or something like it.
fn lines(device: &Dictionary) -> impl Iterator<Item = String> + '_ {
    device.entries().map(|(id, _, entry)| {
        let value = match &entry.default {
            Some(Value::Integer(value)) => value.to_string(),
            Some(Value::NodeId(offset)) => format!("$NODEID+{offset}"),
            Some(Value::Real(real)) => real.number().to_string(),
            Some(Value::Text(text)) => text.clone(),
            Some(Value::Bytes(_)) | None => "1".to_owned(),
        };
        format!("{:04X}.{:X}={value}", id.index.0, id.sub.0)
    })
}

impl Subject for Settings {
    fn notation(&self) -> &Notation {
        &SETTINGS
    }

    fn complaints(&self, name: &str, bytes: &[u8]) -> Vec<Complaint> {
        let Ok(text) = read_text(name, bytes.to_vec()) else { return Vec::new() };
        let wrong = self.devices.iter().filter(|target| target.name == name).flat_map(|target| {
            // Of many settings one is refused nearly always, and then nothing is said of the others: each new one is taken
            // alone, and those that are accepted together.
            let new = text.lines().filter(|line| !target.seed.contains(*line)).take(MOST_SETTINGS);
            let mut accepted = Vec::new();
            let mut wrong = caught(|| target.take(&text).wrong).unwrap_or_else(|what| vec![what]);
            for line in new {
                match caught(|| target.take(line)) {
                    Ok(taken) => {
                        accepted.extend(taken.is_accepted.then_some(line));
                        wrong.extend(taken.wrong);
                    }
                    Err(what) => wrong.push(what),
                }
            }
            wrong
                .extend(caught(|| target.take(&accepted.join("\n")).wrong).unwrap_or_else(|what| vec![what]));
            wrong
        });
        wrong.map(|what| Complaint { step: "settings".to_owned(), what }).collect()
    }
}

/// What became of settings.
#[derive(Debug, Default)]
struct Taken {
    is_accepted: bool,
    wrong: Vec<String>,
}

impl Target {
    /// What goes wrong when the settings are made.
    fn take(&self, text: &str) -> Taken {
        let Some(device) = self.system.devices.get(self.device) else { return Taken::default() };
        let mut sources = self.sources.clone();
        let settings: Vec<_> = text
            .lines()
            .map(|line| {
                let file = sources.add("--set", line);
                Spanned::new(line.to_owned(), sources.whole(file))
            })
            .collect();
        let mut diagnostics = Diagnostics::new();
        let values = assign(&self.system, device, NODE, &settings, &mut diagnostics);
        let said = findings::wrong(&self.name, &diagnostics, &sources).into_iter();
        let mut wrong: Vec<String> = said.map(|(format, what)| format!("{format}: {what}")).collect();
        let is_accepted = !diagnostics.has_errors();
        if is_accepted {
            wrong.extend(self.read_back(device, values));
        }
        Taken { is_accepted, wrong }
    }

    /// The DCF keeps the standard, and states what was set.
    fn read_back(&self, device: &Dictionary, values: ParameterValues) -> Vec<String> {
        let mut node = Commissioning::of_node(device, NODE);
        node.values = values;
        let dcf = eds::write_dcf(&self.system, device, &node, "a.dcf");
        let mut sources = SourceMap::new();
        let root = sources.add("a.dcf", String::from_utf8_lossy(&dcf));
        let Compiled { node: read, diagnostics, .. } =
            compile_as(Strictness::Standard, &mut sources, root, &mut NoFiles);
        let mut wrong: Vec<String> = diagnostics
            .iter()
            .filter(|one| one.severity() == Severity::Error)
            .take(1)
            .map(|one| format!("a.dcf: {}: {}", one.code.id, one.message))
            .collect();
        let Some(read) = read.map(|read| read.at(None)) else {
            wrong.push("a.dcf: has no node".to_owned());
            return wrong;
        };
        let lost = node.values.iter().find_map(|(id, value)| {
            let stated = read.values.get(id);
            let entry = device.entry(*id)?;
            let bytes = |value: &Value| value.bytes_for(entry.data_type, NODE);
            (stated.and_then(bytes) != bytes(value))
                .then(|| format!("a.dcf: {id} is {stated:?} instead of {value:?}"))
        });
        wrong.extend(lost);
        wrong
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fullmo() -> Settings {
        let mut settings = Settings::new().unwrap();
        settings.devices.retain(|target| target.name.starts_with("fullmo"));
        settings
    }

    #[test]
    fn right_and_wrong_settings_are_no_complaint() {
        let settings = fullmo();
        let name = &settings.devices[0].name;
        for text in ["1017.0=100", "1017.0=70000", "=", "", "9999=1"] {
            assert_eq!(settings.complaints(name, text.as_bytes()), [], "{text}");
        }
        assert!(settings.devices[0].take("1017.0=100").is_accepted);
        assert!(!settings.devices[0].take("1017.0=70000").is_accepted);
    }

    #[test]
    fn a_value_that_gets_lost_is_a_complaint() {
        let settings = fullmo();
        let target = &settings.devices[0];
        let device = &target.system.devices[target.device];
        let (id, ..) = device.entries().next().unwrap();
        let values = ParameterValues::from([(id, Value::Integer(1 << 40))]);
        assert!(!target.read_back(device, values).is_empty());
    }
}

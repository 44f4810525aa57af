//! A case as a specification: the clean one, with the value as a default, or, for a PDO, in the keys that the language has for it.

use std::collections::BTreeMap;

use od_spec::model::{DataType, Dictionary, Direction, EntryId, Index, Pdo, Ratio, SubIndex, System, Value};
use od_spec::source::SourceMap;
use od_spec::{NoFiles, compile};

use crate::agreement::CLEAN;
use crate::agreement::case::{Case, Raw, Said, Set};
use crate::agreement::settings::summary;

pub(crate) fn said(system: &System, case: &Case) -> Said {
    let clean = std::fs::read_to_string(od_tests::root().join(CLEAN)).unwrap();
    let Some(text) = changed(&clean, &system.devices[0], &case.set) else { return Said::NoWords };
    let mut sources = SourceMap::new();
    let root = sources.add("changed.od.yaml", text.as_str());
    let compiled = compile(&mut sources, root, &mut NoFiles);
    summary(&compiled.diagnostics)
}

/// The specification with the values; `None` if the language has no words for one of them.
fn changed(clean: &str, device: &Dictionary, sets: &[Set]) -> Option<String> {
    let mut lines = Lines(clean.lines().map(ToOwned::to_owned).collect());
    for set in sets {
        if let Some(pdo) = device.pdos.iter().find(|pdo| pdo.mapping_index() == set.id.index.0) {
            lines.set_key(&lines.of_pdo(pdo), "map", &map(device, pdo, sets)?);
        } else if let Some(pdo) = device.pdos.iter().find(|pdo| pdo.communication_index() == set.id.index.0) {
            communication(&mut lines, pdo, set)?;
        } else {
            let (id, raw) = held(device, set)?;
            lines.set_key(&lines.of_entry(id), "default", &scalar(raw));
        }
    }
    Some(lines.0.join("\n") + "\n")
}

/// A value as a YAML scalar that is nothing but this text.
fn scalar(raw: Raw) -> String {
    match raw {
        Raw::Number(_) | Raw::Real(_) => raw.written(),
        Raw::Text(_) | Raw::Octets(_) => format!("\"{}\"", raw.written()),
    }
}

/// The entry that holds a value: of a view, its target, as long as that is a whole number of its steps.
fn held(device: &Dictionary, set: &Set) -> Option<(EntryId, Raw)> {
    let alias = device.entry(set.id).and_then(|entry| entry.alias.as_ref());
    match (alias, set.raw) {
        (Some(alias), Raw::Number(number)) => {
            let target = Ratio::whole(number).checked_div(alias.factor)?.to_whole()?;
            Some((alias.target, Raw::Number(target)))
        }
        (Some(_) | None, raw) => Some((set.id, raw)),
    }
}

/// A communication parameter in the keys of a PDO.
fn communication(lines: &mut Lines, pdo: &Pdo, set: &Set) -> Option<()> {
    let Raw::Number(raw) = set.raw else { return None };
    let line = lines.of_pdo(pdo);
    let key = match set.id.sub.0 {
        1 => {
            let yes_no = |bit: u32| if raw >> bit & 1 == 1 { ("no", "yes") } else { ("yes", "no") };
            lines.set_key(&line, "cob-id", &format!("0x{:X}", raw & 0x3FFF_FFFF));
            lines.set_key(&line, "valid", yes_no(31).0);
            lines.set_key(&line, "no-rtr", yes_no(30).1);
            return Some(());
        }
        2 => "transmission",
        3 => "inhibit-time",
        5 => "event-timer",
        6 => "sync-start",
        _ => return None,
    };
    lines.set_key(&line, key, &raw.to_string());
    Some(())
}

/// A mapping as a list of what is mapped. Lengths follow from the types, and the count from the list: a mapping that
/// contradicts itself cannot be written.
fn map(device: &Dictionary, pdo: &Pdo, sets: &[Set]) -> Option<String> {
    let given: BTreeMap<u8, i128> = sets
        .iter()
        .filter(|set| set.id.index.0 == pdo.mapping_index())
        .filter_map(|set| match set.raw {
            Raw::Number(number) => Some((set.id.sub.0, number)),
            Raw::Real(_) | Raw::Text(_) | Raw::Octets(_) => None,
        })
        .collect();
    let parameter = |sub: u8| {
        let id = EntryId { index: Index(pdo.mapping_index()), sub: SubIndex(sub) };
        given.get(&sub).copied().or_else(|| device.entry(id)?.default.as_ref().and_then(Value::integer))
    };
    let count = u8::try_from(parameter(0)?).ok()?;
    if given.keys().any(|sub| *sub > count) {
        return None;
    }
    let words: Vec<String> =
        (1..=count).map(|sub| mapped(device, u32::try_from(parameter(sub)?).ok()?)).collect::<Option<_>>()?;
    Some(format!("[{}]", words.join(", ")))
}

/// A mapping parameter by its name in the language: a data type, or an entry.
fn mapped(device: &Dictionary, parameter: u32) -> Option<String> {
    let [length, sub, low, high] = parameter.to_le_bytes();
    let index = u16::from_le_bytes([low, high]);
    let placeholder = DataType::ALL.into_iter().find(|data_type| data_type.code() == index && sub == 0);
    let id = EntryId { index: Index(index), sub: SubIndex(sub) };
    let data_type = placeholder.or_else(|| device.entry(id).map(|entry| entry.data_type));
    let is_of_length = data_type.is_none_or(|data_type| data_type.bits() == Some(length.into()));
    if index == 0 || !is_of_length {
        return None;
    }
    Some(placeholder.map_or_else(|| format!("0x{index:04X}.{sub}"), |data_type| data_type.name().to_owned()))
}

/// The lines of the specification.
struct Lines(Vec<String>);

/// Number of a line.
struct Line(usize);

impl Lines {
    /// The line that begins with a text, after another one.
    fn find(&self, after: usize, start: &str) -> Line {
        let found = self.0.iter().skip(after).position(|line| line.starts_with(start));
        Line(after + found.unwrap_or_else(|| panic!("no line `{start}` after line {after}")))
    }

    fn of_entry(&self, id: EntryId) -> Line {
        let object = self.find(0, &format!("  0x{:04X}:", id.index.0));
        let is_on_one_line = self.0[object.0].ends_with('}');
        if is_on_one_line {
            return object;
        }
        let end = self.0.iter().skip(object.0 + 1).position(|line| !line.starts_with("    ")).unwrap();
        let mut inside = self.0[object.0 + 1..=object.0 + end].iter();
        let entry = inside.position(|line| line.trim_start().starts_with(&format!("{}: {{", id.sub.0)));
        Line(object.0 + 1 + entry.unwrap_or_else(|| panic!("no line for {id}")))
    }

    fn of_pdo(&self, pdo: &Pdo) -> Line {
        let direction = match pdo.direction {
            Direction::Receive => "    receive:",
            Direction::Transmit => "    transmit:",
        };
        let block = self.find(self.find(0, "pdos:").0, direction);
        self.find(block.0, &format!("      {}: {{", pdo.number))
    }

    /// Gives a key of the map that ends a line a value.
    fn set_key(&mut self, line: &Line, key: &str, value: &str) {
        let text = &mut self.0[line.0];
        let prefix = format!("{key}: ");
        let Some(start) = text.find(&prefix).map(|at| at + prefix.len()) else {
            let end = text.rfind('}').unwrap();
            text.insert_str(end, &format!(", {prefix}{value}"));
            return;
        };
        let rest = &text[start..];
        let length = match rest.find(']').filter(|_| rest.starts_with('[')) {
            Some(bracket) => bracket + 1,
            None => rest.find([',', '}']).unwrap(),
        };
        text.replace_range(start..start + length, value);
    }
}

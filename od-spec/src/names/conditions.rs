//! Names and indices in conditions.

use std::ops::Range;

use super::collector::{At, Collector, scope};
use super::known::Scope;
use super::{By, DefinitionId, Kind};
use crate::decode::lexical;
use crate::expr::{EntryRef, Lookup, Named, Operand, PLACEHOLDER, without_names};
use crate::model::{EntryId, Index, SubIndex};
use crate::yaml::Node;

/// Reads what a condition refers to.
pub(super) fn condition<'t>(collector: &mut Collector<'_, 't>, at: At<'_, 't>) {
    let devices = at.devices();
    let mut asked = Asked { collector, at, devices };
    // What cannot be read was reported; what is before it is read.
    let _ = without_names(at.text.value, &mut asked);
}

struct Asked<'c, 'a, 'p, 't> {
    collector: &'c mut Collector<'a, 't>,
    at: At<'p, 't>,
    devices: Vec<&'t str>,
}

/// What represents an unknown entry.
const UNKNOWN: EntryId = EntryId { index: Index(0), sub: SubIndex(0) };

impl<'t> Asked<'_, '_, '_, 't> {
    /// The devices that an entry is looked for on, and a reference to the one that is named in front of it.
    fn on<'d>(&mut self, device: Option<&'d str>, before: usize) -> Vec<&'d str>
    where
        't: 'd,
    {
        let Some(key) = device else { return self.devices.clone() };
        if let Some(start) = self.at.text.value[..before].rfind(key) {
            let found = self.collector.known.named(Kind::Device, Scope::Everywhere, key, self.at.file());
            let targets = found.into_iter().collect();
            self.collector.add(self.at, start..start + key.len(), Kind::Device, By::Name, targets);
        }
        vec![key]
    }

    /// The name with the first number that its placeholder represents.
    fn with_number(&self, name: &str) -> String {
        if !name.contains(PLACEHOLDER) {
            return name.to_owned();
        }
        let numbers = self.at.beside("n").map(Node::one_or_more).unwrap_or_default();
        let first = numbers.iter().find_map(|node| lexical::numbers(Node::text(node)?.value));
        name.replace(PLACEHOLDER, &first.map_or(0, |range| range.first).to_string())
    }

    /// The named type of an entry.
    fn type_of(&self, entry: &EntryRef) -> Option<DefinitionId> {
        let device = entry.device.as_deref();
        let device = device.map(|key| [key]);
        let devices = device.as_ref().map_or(self.devices.as_slice(), |one| one.as_slice());
        let scope = scope(devices);
        let known = self.collector.known;
        let mut found = self.collector.resolved.devices(scope);
        let resolved =
            found.find_map(|device| Some(device.entry(entry.id)?.named_type.as_ref()?.name.as_str()));
        let name = resolved.or_else(|| known.type_of_entry(self.at.file(), entry.id, scope))?;
        self.collector.type_of(name, self.at.file())
    }
}

impl Lookup for Asked<'_, '_, '_, '_> {
    fn entry(&mut self, name: &Named<'_>) -> Option<EntryId> {
        let full = self.with_number(name.text);
        let devices = self.on(name.device, name.range.start);
        self.collector.named_entry(self.at, name.range.clone(), &full, &devices);
        let scope = scope(&devices);
        let found = self.collector.resolved.named(&full, scope).next().map(|(_, id)| id);
        let written = || self.collector.known.objects.named(&full, scope).map(|found| found.first);
        found.or_else(written).or(Some(UNKNOWN))
    }

    fn operand(&mut self, compared: &EntryRef, name: &Named<'_>) -> Option<Operand> {
        let owner = self.type_of(compared);
        let value = owner.and_then(|owner| {
            self.collector.known.named(Kind::Value, Scope::In(owner), name.text, self.at.file())
        });
        match value {
            Some(value) => {
                self.collector.add(self.at, name.range.clone(), Kind::Value, By::Name, vec![value]);
                Some(Operand::Entry(UNKNOWN))
            }
            None => self.entry(name).map(Operand::Entry),
        }
    }

    fn bit(&mut self, of: &EntryRef, name: &Named<'_>) -> Option<u8> {
        let owner = self.type_of(of);
        let bit = owner.and_then(|owner| {
            self.collector.known.named(Kind::Bit, Scope::In(owner), name.text, self.at.file())
        });
        self.collector.add(self.at, name.range.clone(), Kind::Bit, By::Name, bit.into_iter().collect());
        Some(0)
    }

    fn numbered(&mut self, entry: &EntryRef, range: Range<usize>) {
        let text = &self.at.text.value[range.clone()];
        let start = text.find(':').map_or(range.start, |colon| {
            let behind = &text[colon + 1..];
            range.end - behind.trim_start().len()
        });
        let devices = self.on(entry.device.as_deref(), start);
        self.collector.numbered(self.at, (entry.id.index, entry.id.sub), start..range.end, &devices);
    }
}

//! Changes of a model so that the language takes it: the least that removes what a message is about.

use od_spec::diag::Diagnostic;
use od_spec::model::{
    DataType, Dictionary, Entry, EntryId, Fact, Index, PdoMapping, Phrases, Role, Storage, SubIndex, System,
    Text, Value,
};
use od_spec::wording::format_value;

use super::node::Spot;
use super::options::Place;
use super::remarks::Repair;

/// A model that is changed until the language takes it.
#[derive(Debug, Clone)]
pub(super) struct Draft {
    pub system: System,
    pub device: Dictionary,
}

impl Draft {
    /// Leaves out what sub-index 0 of an array or record cannot say in a specification: there it is an UNSIGNED8.
    pub(super) fn settle_counts(&mut self, repairs: &mut Vec<Repair>) {
        let counts: Vec<EntryId> = self
            .device
            .entries()
            .filter(|(id, object, entry)| {
                id.sub.0 == 0 && object.is_structured() && entry.data_type != DataType::Unsigned8
            })
            .map(|(id, ..)| id)
            .collect();
        let fits = |value: &Value| match value {
            Value::Integer(number) => u8::try_from(*number).is_ok(),
            Value::NodeId(offset) => *offset + 127 <= 255,
            Value::Real(_) | Value::Text(_) | Value::Bytes(_) => false,
        };
        for id in counts {
            let Some(entry) = self.device.entry(id) else { continue };
            let (low, high) = entry.limits();
            let because = format!("sub-index 0 is no {}, but an UNSIGNED8", entry.data_type);
            let values =
                [(Fact::Default, entry.default.clone()), (Fact::LowLimit, low), (Fact::HighLimit, high)];
            for (fact, value) in values {
                if value.is_some_and(|value| !fits(&value)) {
                    let repair = self.drop_fact(id, fact);
                    repairs.extend(repair.map(|repair| Repair { because: because.clone(), ..repair }));
                }
            }
        }
    }

    /// Leaves out what a message is about, which is written so: the fact, or, where it must not be missing, the object.
    /// `None` where nothing can be done.
    pub(super) fn mend(&mut self, text: &str, spot: Spot, error: &Diagnostic) -> Option<Repair> {
        let mut repair = match spot {
            Spot::EntryFact(id, fact) => self.drop_fact(id, fact),
            Spot::ObjectFact(index, fact) => self.drop_object_fact(index, fact),
            Spot::Entry(_) | Spot::Object(_) => None,
        }
        .or_else(|| self.drop_object(spot.index()))?;
        // What was written says more than the model does, in the words of a specification.
        if let Some(fact) = repair.fact
            && let Some(value) = text.strip_prefix(fact.word()).and_then(|rest| rest.strip_prefix(": "))
        {
            value.clone_into(&mut repair.original);
        }
        repair.because = format!("{} ({})", error.message, error.code.id);
        Some(repair)
    }

    fn entry(&mut self, id: EntryId) -> Option<&mut Entry> {
        let object = self.device.objects.get_mut(&id.index)?;
        object.entries.iter_mut().find(|entry| entry.sub == id.sub)
    }

    /// Leaves a fact of an entry out, if there is one to leave out.
    fn drop_fact(&mut self, id: EntryId, fact: Fact) -> Option<Repair> {
        let derived = self.derived(id);
        let entry = self.entry(id)?;
        let original = match fact {
            Fact::Default => {
                let original = entry.default.clone().filter(|default| derived.as_ref() != Some(default))?;
                entry.default = derived;
                format_value(entry, &original)
            }
            Fact::LowLimit | Fact::HighLimit => {
                let limits = entry.limits();
                let limit = if fact == Fact::LowLimit { limits.0 } else { limits.1 }?;
                let (raw, real) = if fact == Fact::LowLimit {
                    (&mut entry.low, &mut entry.real_limits.low)
                } else {
                    (&mut entry.high, &mut entry.real_limits.high)
                };
                (*raw, *real) = (None, None);
                limit.integer().map_or_else(|| format_value(entry, &limit), |raw| raw.to_string())
            }
            Fact::Mapping => {
                let mapping = std::mem::replace(&mut entry.pdo, PdoMapping::None);
                (mapping != PdoMapping::None).then(|| mapping.word().to_owned())?
            }
            Fact::Storage => {
                let storage = std::mem::replace(&mut entry.stored, Storage::No);
                (storage != Storage::No).then(|| storage.word().to_owned())?
            }
            Fact::Special => {
                let names: Vec<String> = entry.special.drain(..).map(|special| special.name).collect();
                (!names.is_empty()).then(|| names.join(", "))?
            }
            Fact::Unit => entry.unit.take()?.name.clone(),
            Fact::Type | Fact::Meaning => entry.named_type.take()?.name.clone(),
            Fact::Capacity => entry.capacity.take()?.to_string(),
            Fact::Identifier => entry.identifier.take()?,
            Fact::Category => entry.category.take()?.word().to_owned(),
            Fact::Since => entry.since.take()?,
            Fact::WriteCondition => entry.writable_when.take()?.text,
            Fact::BitErrors => {
                let count = entry.bit_errors.drain(..).count();
                (count > 0).then(|| "error codes of bits".to_owned())?
            }
            Fact::Warning => {
                let warning = std::mem::take(&mut entry.warning);
                (!warning.is_empty()).then(|| "a warning".to_owned())?
            }
            Fact::About => {
                let about = std::mem::take(&mut entry.about);
                (!about.is_empty()).then(|| "a description".to_owned())?
            }
            Fact::Search => {
                let search = std::mem::take(&mut entry.search);
                (!search.is_empty()).then(|| "words to look for".to_owned())?
            }
            Fact::Access => {
                std::mem::take(&mut entry.locked).then(|| format!("{} locked", entry.access.word()))?
            }
            Fact::Eds => {
                let eds = super::eds::keys(entry, super::eds::EdsDefaults::All);
                if eds.is_empty() {
                    return None;
                }
                super::eds::forget(entry);
                "what the EDS shows otherwise".to_owned()
            }
            _ => return None,
        };
        let now = (fact == Fact::Default && Role::of(id.index) == Role::ErrorHistory).then(|| "0".to_owned());
        Some(repair(Place::Entry(id), Some(fact), original, now))
    }

    /// The value that an entry has where none is stated.
    fn derived(&self, id: EntryId) -> Option<Value> {
        let object = self.device.objects.get(&id.index)?;
        // A device starts without errors, however many it can list.
        if object.role() == Role::ErrorHistory && id.sub == SubIndex(0) {
            return Some(Value::Integer(0));
        }
        if object.is_structured() && id.sub == SubIndex(0) {
            return super::entry::derived_count(object);
        }
        super::entry::device_value(&self.system, &self.device, id.index, id.sub)
    }

    fn drop_object_fact(&mut self, index: Index, fact: Fact) -> Option<Repair> {
        let object = self.device.objects.get_mut(&index)?;
        let original = match fact {
            Fact::Identifier => object.identifier.take()?,
            Fact::Category => object.category.take()?.word().to_owned(),
            Fact::Since => object.since.take()?,
            Fact::Links => {
                let links: Vec<String> = object.linked().map(|index| index.to_string()).collect();
                object.links.clear();
                (!links.is_empty()).then(|| links.join(", "))?
            }
            Fact::Warning => {
                object.warning = Text::default();
                "a warning".to_owned()
            }
            Fact::About => {
                object.about = Text::default();
                "a description".to_owned()
            }
            Fact::Search => {
                object.search = Phrases::default();
                "words to look for".to_owned()
            }
            _ => return None,
        };
        Some(repair(Place::Object(index), Some(fact), original, None))
    }

    fn drop_object(&mut self, index: Index) -> Option<Repair> {
        let gone = self.device.objects.remove(&index)?;
        Some(repair(Place::Device, None, format!("{index} ({})", gone.name), None))
    }
}

/// A repair whose reason the message gives.
fn repair(place: Place, fact: Option<Fact>, original: String, now: Option<String>) -> Repair {
    Repair { place, fact, original, now, because: String::new() }
}

//! Changes of a model so that the language takes it: the least that removes what a message is about.

use od_spec::diag::Diagnostic;
use od_spec::model::{
    Dictionary, Entry, EntryId, Fact, Index, PdoMapping, Role, Storage, SubIndex, System, Text, Value,
};
use od_spec::wording::format_value;

use super::emit::Written;
use super::names::{readable, shortened};
use super::node::Spot;
use super::options::Place;
use super::remarks::Repair;

/// A model that is changed until the language takes it.
#[derive(Debug, Clone)]
pub(super) struct Draft {
    pub system: System,
    pub device: Dictionary,
}

/// How much is given up for a message.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Effort {
    /// The fact that it is about.
    Fact,
    /// The object that it is about: nothing less helped.
    Object,
}

impl Draft {
    /// Changes what a message is about; `None` where nothing can be done.
    pub(super) fn mend(&mut self, written: &Written, error: &Diagnostic, effort: Effort) -> Option<Repair> {
        let at = usize::try_from(error.labels.first()?.span.start).ok()?;
        let (range, spot) = written.spots.get(written.narrowest(at)?)?;
        let because = format!("{} ({})", error.message, error.code.id);
        let mut repair = match (spot, effort) {
            (Spot::EntryFact(id, _) | Spot::Entry(id), Effort::Object) => self.drop_object(id.index),
            (Spot::Object(index) | Spot::ObjectFact(index, _), Effort::Object) => self.drop_object(*index),
            (Spot::EntryFact(id, fact), Effort::Fact) => {
                self.drop_fact(*id, *fact).or_else(|| self.mend_entry(*id))
            }
            (Spot::Entry(id), Effort::Fact) => self.mend_entry(*id),
            (Spot::ObjectFact(index, fact), Effort::Fact) => self.mend_object_fact(*index, *fact),
            (Spot::Object(index), Effort::Fact) => self.mend_object(*index),
            (Spot::Type(name), _) => self.drop_type(name),
            (Spot::Unit(name), _) => self.drop_unit(name),
            (Spot::Device | Spot::Pdo(..), _) => self.mend_header(),
            (Spot::Vendor, _) => self.mend_vendor(),
        }?;
        // What was written tells more than the model does, in the words of a specification.
        let text = written.text.get(range.clone()).unwrap_or_default();
        if let (Some(fact), Spot::EntryFact(..) | Spot::ObjectFact(..)) = (repair.fact, spot)
            && let Some(value) = text.strip_prefix(fact.word()).and_then(|rest| rest.strip_prefix(": "))
        {
            value.clone_into(&mut repair.original);
        }
        repair.because = because;
        Some(repair)
    }

    fn entry(&mut self, id: EntryId) -> Option<&mut Entry> {
        let object = self.device.objects.get_mut(&id.index)?;
        object.entries.iter_mut().find(|entry| entry.sub == id.sub)
    }

    /// The facts of an entry one after the other; at last the entry.
    fn mend_entry(&mut self, id: EntryId) -> Option<Repair> {
        const ORDER: [Fact; 16] = [
            Fact::Default,
            Fact::Eds,
            Fact::WriteCondition,
            Fact::BitErrors,
            Fact::Special,
            Fact::LowLimit,
            Fact::HighLimit,
            Fact::Mapping,
            Fact::Storage,
            Fact::Capacity,
            Fact::Unit,
            Fact::Meaning,
            Fact::Identifier,
            Fact::Warning,
            Fact::About,
            Fact::Access,
        ];
        ORDER.iter().find_map(|fact| self.drop_fact(id, *fact)).or_else(|| self.drop_entry(id))
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

    fn mend_object(&mut self, index: Index) -> Option<Repair> {
        let subs: Vec<SubIndex> =
            self.device.objects.get(&index)?.entries.iter().map(|entry| entry.sub).collect();
        // An entry is left out only when none has a fact to leave out.
        let facts = [
            Fact::Eds,
            Fact::Special,
            Fact::Default,
            Fact::LowLimit,
            Fact::HighLimit,
            Fact::Mapping,
            Fact::Storage,
            Fact::Unit,
            Fact::Meaning,
        ];
        for fact in facts {
            for sub in &subs {
                if let Some(repair) = self.drop_fact(EntryId { index, sub: *sub }, fact) {
                    return Some(repair);
                }
            }
        }
        self.drop_object(index)
    }

    fn mend_object_fact(&mut self, index: Index, fact: Fact) -> Option<Repair> {
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
            _ => return self.drop_object(index),
        };
        Some(repair(Place::Object(index), Some(fact), original, None))
    }

    fn drop_entry(&mut self, id: EntryId) -> Option<Repair> {
        let object = self.device.objects.get_mut(&id.index)?;
        if id.sub.0 == 0 || !object.is_structured() || object.entries.len() <= 2 {
            return self.drop_object(id.index);
        }
        let at = object.entries.iter().position(|entry| entry.sub == id.sub)?;
        let gone = object.entries.remove(at);
        let highest = object.entries.last().map(|last| Value::Integer(last.sub.0.into()));
        if object.role() != Role::PdoMapping
            && let Some(count) = object.entries.first_mut()
        {
            count.default = highest;
        }
        Some(repair(Place::Object(id.index), None, format!("sub-index {} ({})", id.sub, gone.name), None))
    }

    fn drop_object(&mut self, index: Index) -> Option<Repair> {
        let gone = self.device.objects.remove(&index)?;
        Some(repair(Place::Device, None, format!("{index} ({})", gone.name), None))
    }

    fn drop_type(&mut self, name: &str) -> Option<Repair> {
        let entries = self.device.objects.values_mut().flat_map(|object| &mut object.entries);
        let typed = entries.filter(|entry| entry.named_type.as_ref().is_some_and(|named| named.name == name));
        let count = typed.map(|entry| entry.named_type = None).count();
        (count > 0).then(|| repair(Place::Device, None, format!("the type {name}"), None))
    }

    fn drop_unit(&mut self, name: &str) -> Option<Repair> {
        let entries = self.device.objects.values_mut().flat_map(|object| &mut object.entries);
        let measured = entries.filter(|entry| entry.unit.as_ref().is_some_and(|unit| unit.name == name));
        let count = measured.map(|entry| entry.unit = None).count();
        (count > 0).then(|| repair(Place::Device, None, format!("the unit {name}"), None))
    }

    /// The texts of the EDS's header without what readers misread, and as short as it has to be.
    fn mend_header(&mut self) -> Option<Repair> {
        let Dictionary { file, info, .. } = &mut self.device;
        let texts = [
            &mut file.description,
            &mut file.created_by,
            &mut file.modified_by,
            &mut info.product_name,
            &mut info.order_code,
        ];
        let mut changed = Vec::new();
        for text in texts {
            let plain = shortened(&readable(text), 243).trim().to_owned();
            if plain != *text {
                changed.push(std::mem::replace(text, plain));
            }
        }
        (!changed.is_empty()).then(|| {
            repair(Place::Device, Some(Fact::Eds), changed.join("; "), Some("without it".to_owned()))
        })
    }

    fn mend_vendor(&mut self) -> Option<Repair> {
        let plain = shortened(&readable(&self.system.vendor.name), 244).trim().to_owned();
        let original = std::mem::replace(&mut self.system.vendor.name, plain);
        let now = self.system.vendor.name.clone();
        (now != original).then(|| repair(Place::Device, Some(Fact::Name), original, Some(now)))
    }
}

/// A repair whose reason the message gives.
fn repair(place: Place, fact: Option<Fact>, original: String, now: Option<String>) -> Repair {
    Repair { place, fact, original, now, because: String::new() }
}

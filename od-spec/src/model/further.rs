//! What an EDS or DCF says in addition to the facts of the model: kept in its own words, and written into such files
//! again.

use std::collections::{BTreeMap, BTreeSet};

use super::Index;

/// What an EDS or DCF says that no other part of the model holds.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Further {
    /// The lines of `[Comments]`; `None` where a specification leaves them to what is made of it.
    pub comments: Option<Vec<String>>,
    /// Keys in sections about something that the model holds, by the name of the section: `DeviceInfo`, `2000`, `2001sub1`.
    pub keys: BTreeMap<String, Vec<KeyValue>>,
    /// Sections about nothing that the model holds, without those of modules.
    pub sections: Vec<FurtherSection>,
    /// The modules that a bus coupler takes, by number.
    pub modules: BTreeMap<u32, Module>,
    /// Of a DCF: the numbers of the modules that are plugged in, in order.
    pub connected: Vec<u32>,
}

impl Further {
    /// Whether nothing is said.
    pub fn is_empty(&self) -> bool {
        let Self { comments, keys, sections, modules, connected } = self;
        comments.as_ref().is_none_or(Vec::is_empty)
            && keys.is_empty()
            && sections.is_empty()
            && modules.is_empty()
            && connected.is_empty()
    }

    /// Whether some module brings an object, or further sub-indices of it.
    pub fn is_of_modules(&self, index: Index) -> bool {
        self.modules.values().any(|module| module.brings.contains(&index) || module.extends.contains(&index))
    }

    /// The sections that follow the objects.
    pub fn all_sections(&self) -> impl Iterator<Item = &FurtherSection> {
        self.sections.iter().chain(self.modules.values().flat_map(|module| &module.sections))
    }

    /// How many keys there are, also those of modules.
    pub fn count(&self) -> usize {
        let of_sections = self.all_sections().map(|section| section.keys.len()).sum::<usize>();
        of_sections + self.keys.values().map(Vec::len).sum::<usize>()
    }
}

/// A module that is plugged into a bus coupler.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Module {
    /// Product name.
    pub product_name: String,
    /// Order code.
    pub order_code: String,
    /// Objects that are there once as soon as such a module is.
    pub brings: BTreeSet<Index>,
    /// Objects that get further sub-indices with each such module.
    pub extends: BTreeSet<Index>,
    /// Everything that the file says about it.
    pub sections: Vec<FurtherSection>,
}

/// A section in the words of its file.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct FurtherSection {
    /// The name; one of the standard in its spelling.
    pub name: String,
    /// The keys in order.
    pub keys: Vec<KeyValue>,
}

/// A key with its value, in the words of its file.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct KeyValue {
    /// The key; one of the standard in its spelling.
    pub key: String,
    /// The value.
    pub value: String,
}

impl FurtherSection {
    pub(crate) const fn new(name: String, keys: Vec<KeyValue>) -> Self {
        Self { name, keys }
    }
}

impl KeyValue {
    pub(crate) const fn new(key: String, value: String) -> Self {
        Self { key, value }
    }
}

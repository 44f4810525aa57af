//! What CANopenEditor keeps of an object for the stack CANopenNode, and no standard has.

use std::collections::BTreeMap;

use super::{PdoMapping, Storage, SubIndex};

/// The group of what nothing stores.
const USUAL_GROUP: &str = "RAM";

/// The longest name that becomes a part of one in C.
const LONGEST_NAME: usize = 64;

/// What CANopenEditor keeps of an object for the stack CANopenNode. The lengths of texts are not here:
/// they are the [`capacity`](super::Entry::capacity) of an entry.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct EditorNotes {
    /// The group that its values lie in: `PERSIST_COMM`, of the variable `OD_PERSIST_COMM`. `None` for
    /// the usual one, `RAM`.
    pub storage_group: Option<String>,
    /// The counter that it adds to: `TPDO`, of `OD_CNT_TPDO`.
    pub count_label: Option<String>,
    /// Whether a write of the application may request the TPDOs that map it.
    pub requests_tpdos: bool,
    /// Into which SRDOs its entries may be mapped; one that is not here into none.
    pub srdos: BTreeMap<SubIndex, PdoMapping>,
}

impl EditorNotes {
    /// Whether a text can be the name of a group or counter, which is a part of a name in C.
    pub(crate) fn is_name(text: &str) -> bool {
        text.len() <= LONGEST_NAME && text.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
    }

    /// Names the group of the values, where it is not the usual one.
    pub(crate) fn name_group(&mut self, group: Option<String>) {
        self.storage_group = group.filter(|group| group != USUAL_GROUP);
    }

    /// Whether nothing is kept.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// What is kept of the object as a whole: each property with its value.
    pub fn of_object(&self) -> impl Iterator<Item = (EditorProperty, &str)> {
        let label = self.count_label.as_deref().map(|label| (EditorProperty::CountLabel, label));
        let group = self.storage_group.as_deref().map(|group| (EditorProperty::StorageGroup, group));
        let flags = self.requests_tpdos.then_some((EditorProperty::TpdoRequests, "true"));
        label.into_iter().chain(group).chain(flags)
    }

    /// What is kept of one of its entries: into which SRDOs it may be mapped.
    pub fn of_entry(&self, sub: SubIndex) -> Option<(EditorProperty, &'static str)> {
        let word = match self.srdos.get(&sub)? {
            PdoMapping::None => "no",
            PdoMapping::Receive => "rx",
            PdoMapping::Transmit => "tx",
            PdoMapping::Both => "trx",
        };
        Some((EditorProperty::SrdoAccess, word))
    }
}

/// A property that CANopenEditor adds to an object or entry.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EditorProperty {
    /// Which counter the object adds to.
    CountLabel,
    /// In which group its values lie.
    StorageGroup,
    /// Whether it may request TPDOs.
    TpdoRequests,
    /// Into which SRDOs an entry may be mapped.
    SrdoAccess,
    /// The fewest characters that a text has room for.
    StringLength,
}

impl EditorProperty {
    /// Its name in an XDD.
    pub const fn name(self) -> &'static str {
        match self {
            Self::CountLabel => "CO_countLabel",
            Self::StorageGroup => "CO_storageGroup",
            Self::TpdoRequests => "CO_flagsPDO",
            Self::SrdoAccess => "CO_accessSRDO",
            Self::StringLength => "CO_stringLengthMin",
        }
    }

    /// Its key in an EDS, which follows a `;` so that it is a comment to all other readers.
    pub const fn key(self) -> &'static str {
        match self {
            Self::StorageGroup => "StorageLocation",
            Self::TpdoRequests => "TPDODetectCos",
            Self::CountLabel | Self::SrdoAccess | Self::StringLength => self.name(),
        }
    }

    /// Whether a name in an XDD or a key in an EDS is this property.
    pub(crate) fn is_called(self, name: &str) -> bool {
        name.eq_ignore_ascii_case(self.name()) || name.eq_ignore_ascii_case(self.key())
    }

    /// The property that a name in an XDD or a key in an EDS says.
    pub fn of_name(name: &str) -> Option<Self> {
        const ALL: [EditorProperty; 5] = [
            EditorProperty::CountLabel,
            EditorProperty::StorageGroup,
            EditorProperty::TpdoRequests,
            EditorProperty::SrdoAccess,
            EditorProperty::StringLength,
        ];
        ALL.into_iter().find(|property| property.is_called(name))
    }
}

impl Storage {
    /// What keeps the values of a storage group, by its name. A group with a name of the maker's is
    /// stored by one of the commands that CiA 301 leaves to the maker.
    pub fn of_group(group: &str) -> Self {
        match group.to_ascii_uppercase().as_str() {
            "PERSIST_COMM" => Self::Communication,
            "PERSIST_APP" => Self::Application,
            name if name.ends_with("_AUTO") => Self::Remanent,
            name if name.starts_with("RAM") || name.starts_with("ROM") => Self::No,
            _ => Self::Manufacturer,
        }
    }
}

//! What an entry is in its object, and which data type it then has by CiA 301.

use crate::model::{DataType, EntryId, Index, SubIndex};

/// The data type that CiA 301 gives an entry of an object with sub-indices, or without a sub-index an object that is one value.
pub(crate) type StandardTypes = fn(Index, Option<SubIndex>) -> Option<DataType>;

/// What an entry is in its object.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Form {
    /// The value of a VAR.
    Value,
    /// A DOMAIN, which needs no data type.
    Domain,
    /// Sub-index 0 of an ARRAY or RECORD.
    Count,
    /// A further sub-index.
    Member,
    /// What holds for all elements of an ARRAY.
    Elements,
}

impl Form {
    /// What a sub-index of an ARRAY or RECORD is that is no DOMAIN.
    pub(crate) const fn of_sub(id: EntryId) -> Self {
        if id.sub.0 == 0 { Self::Count } else { Self::Member }
    }

    /// The data type that CiA 301 gives an entry.
    pub(crate) fn standard_type(self, id: EntryId, standard: StandardTypes) -> Option<DataType> {
        let sub = match self {
            Self::Domain => return None,
            Self::Value => None,
            Self::Count | Self::Member => Some(id.sub),
            Self::Elements => Some(SubIndex(1)),
        };
        standard(id.index, sub)
    }
}

//! What can be wrong with the parts of a table.

use core::fmt;

/// Why parts do not make a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TableError {
    /// What is wrong.
    pub fault: Fault,
    /// Where: the position in the list of [`Parts`](crate::table::Parts) that the fault names; 0 where it is no list.
    pub at: usize,
}

/// `directory.order[1]: a block is where it is looked for`.
impl fmt::Display for TableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}[{}]: {}", self.fault.list(), self.at, self.fault.rule())
    }
}

impl core::error::Error for TableError {}

macro_rules! faults {
    ($($name:ident = $list:literal, $rule:literal;)+) => {
        /// A rule that parts of a table break.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[non_exhaustive]
        pub enum Fault {
            $(#[doc = concat!("`", $list, "`: ", $rule, ".")] $name,)+
        }

        impl Fault {
            /// The list of [`Parts`](crate::table::Parts) that breaks it.
            pub const fn list(self) -> &'static str {
                match self { $(Self::$name => $list,)+ }
            }

            /// What would be right.
            pub const fn rule(self) -> &'static str {
                match self { $(Self::$name => $rule,)+ }
            }
        }
    };
}

faults! {
    BlockOrder = "directory.order", "each is the place of a block with objects, and its number and the objects before it ascend";
    BlockPlace = "directory.order", "a block is where it is looked for";
    BlockCount = "directory.order", "all blocks with objects are there, and have as many objects as the table";
    ObjectOrder = "objects", "the first begins in row 0, each has 1 to 256 entries, and the number of entries ends them";
    EntryCount = "entries", "there are at most 65,534";
    EntryAttributes = "entries", "the position is in the list of attributes";
    EntryPlace = "entries", "the value lies within the image or the constants, the view is in the list of aliases";
    EntryOverlap = "entries", "no two values have a byte of the image in common";
    EntryStorage = "entries", "a value lies in a stored part of the image if, and only if, that part has its storage";
    EntryType = "entries", "an alias has the type of its view";
    AttributeSize = "attributes", "the size is the one of the data type; of a UNICODE_STRING, it is even";
    AttributePlace = "attributes", "DOMAINs, and no others, are with the application; aliases are integers";
    AttributeAccess = "attributes", "constants cannot be written";
    AttributeLimits = "attributes", "limits and values are in their lists; numbers have limits, integers values";
    SparseOrder = "sparse", "each is an object with as many entries as sub-indices, by ascending row";
    SparseSubs = "sparse", "the sub-indices ascend";
    SparseFlag = "entries", "an entry is marked as sparse if, and only if, its object is listed";
    AliasTarget = "aliases", "the target is an integer in the image or the constants";
    AliasView = "aliases", "the view has a type of less than 64 bits, and its products fit into 64";
    LimitOrder = "limits", "the smallest value is not above the largest";
    ValueOrder = "values", "the values ascend";
    NodeIdPlace = "node_id_places", "it is an integer entry of the image";
    RegionOrder = "regions", "parts of the image ascend and do not overlap, and each storage but none has at most one";
    PdoIndex = "pdos", "the index is 1400h to 15FFh or 1800h to 19FFh, and ascends";
    PdoRows = "pdos", "the rows are those of its COB-ID and of its number of mapped entries, whose parameters follow without gaps";
    PdoMapping = "pdos", "the mapped rows are what the mapping parameters say after a factory reset";
    FirstApplicationRow = "first_application_row", "it is the first row at or above index 2000h";
    Granularity = "granularity", "it is at most 64";
}

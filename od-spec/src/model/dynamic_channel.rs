//! Network variables that a PLC creates in a device.

use super::{Access, DataType, Index};

/// A segment of indices at which the tool of a PLC may create network variables (CiA 302 part 4); they are not objects
/// of the device until then.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct DynamicChannel {
    /// The first index.
    pub first: Index,
    /// The last index.
    pub last: Index,
    /// Data type of every variable.
    pub data_type: DataType,
    /// Access over the bus.
    pub access: Access,
    /// Where the variables begin in the process picture.
    pub offset: u32,
    /// Difference of the addresses of two variables, where it is said; it is of BOOLEANs.
    pub difference: Option<u32>,
}

//! `uniqueID`: by what name parts of an XDD refer to each other.

use od_spec::model::{Index, Object, ObjectKind, SubIndex};

/// The name by which an object refers to its parameter.
pub(super) fn uid_of_object(index: Index) -> String {
    format!("UID_OBJ_{:04X}", index.0)
}

/// The name by which an entry of a structured object refers to its parameter.
pub(super) fn uid_of_entry(index: Index, sub: SubIndex) -> String {
    format!("UID_SUB_{:04X}{:02X}", index.0, sub.0)
}

/// The name by which a structured object's parameter refers to its type.
pub(super) fn uid_of_type(object: &Object) -> String {
    let kind = if object.kind == ObjectKind::Array { "ARR" } else { "REC" };
    format!("UID_{kind}_{:04X}", object.index.0)
}

//! The keys of the language, by chapter: one line for each key decodes specifications, suggests corrections, and prints the
//! JSON Schema and the language reference.

mod constraints;
mod devices;
mod entry;
mod errors;
mod file;
mod libraries;
mod machines;
mod manual;
mod mark;
mod objects;
mod parameters;
mod pdos;
mod plant;
mod shape;
mod table;
mod types;

pub use constraints::CONSTRAINT;
pub use devices::{CHANNEL, DEVICE, FILE, NOTES};
pub use entry::{CONSUMER, ENTRY, ENTRY_EDS_KEYS, SPECIAL};
pub use errors::{ANY_ERROR, ERROR};
pub use file::{ALLOWED, PART, PART_OF, PARTS, REVISION, SOURCE, SPEC, SPEC_VERSION, VENDOR};
pub use libraries::{AXES, FEATURE};
pub use machines::{COMMAND, MACHINE, STATE, TRANSITION};
pub use manual::{
    AXIS, BLOCK, CONTENT, ERRATUM, FIGURE, INFLOW, MARK, SECTION, SIGNAL, SPAN, SWITCH, TABLE_BITS,
    TABLE_LADDER, TABLE_PDOS, TABLE_ROWS, TIMING, TIMING_STEP,
};
pub(crate) use mark::is_marked;
pub use objects::{ARRAY, OBJECT, SUB0};
pub use parameters::{PARAMETER_FILE, PARAMETERS_VERSION};
pub use pdos::{
    PDO, PDO_COMMUNICATION, PDO_DIRECTIONS, PDO_MAPPED_ENTRY, PDO_MAPPING, PDO_PARAMETER, PDO_PARAMETERS,
    PDO_RESERVED, PDOS,
};
pub use plant::{MASTER, PLANT, PLANT_DEVICE, PLANT_MACHINE, PLANT_NODE, PLANT_TYPE, PLANT_VERSION, SITE};
pub use shape::{CHANNELS, Choice, Key, KeyKind, Keys, NameOf, Need, NumberedName, Shape, VERSION};
pub use types::{BIT, ENUM_VALUE, MODE_BIT, TYPE, UNIT};

pub(crate) use constraints::constraint_keys;
pub(crate) use devices::{channel_keys, device_keys, file_keys, notes_keys};
pub(crate) use entry::entry_keys;
pub(crate) use errors::{any_error_keys, error_keys};
pub(crate) use file::{revision_keys, source_keys, vendor_keys};
pub(crate) use machines::{command_keys, machine_keys, state_keys, transition_keys};
pub(crate) use manual::{
    axis_keys, block_keys, erratum_keys, mark_keys, signal_keys, span_keys, switch_keys, timing_keys,
    timing_step_keys,
};
pub(crate) use pdos::{pdo_communication_keys, pdo_keys, pdo_mapping_keys, pdo_parameters_keys};
pub(crate) use types::unit_keys;

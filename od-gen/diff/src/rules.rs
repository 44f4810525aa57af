//! What a change of each fact breaks, and why. This is the table; the other files find the changes.
//!
//! | fact | change | class | why |
//! |---|---|---|---|
//! | presence | added | addition | nothing uses what was not there; a match over all entries in firmware has to name it |
//! | | removed | plc, firmware | SDO access is aborted, mapping refused; the accessor is gone |
//! | name | other words | plc, firmware | tools make symbols from `ParameterName`; identifiers are made from it |
//! | | case, punctuation | documents | the symbols stay |
//! | object type | VAR or DOMAIN against ARRAY or RECORD | plc | sub-index 0 is a value on one side and a count on the other |
//! | | ARRAY against RECORD | documents | every value keeps its address |
//! | data type | any | plc | another length or sign on the bus |
//! | access | reading or writing lost, lock added | plc | SDO access is aborted |
//! | | reading or writing gained, lock removed | addition | |
//! | | `const` to `ro` | behaviour | a value that was read once may change |
//! | PDO mapping | direction lost, gained | plc, addition | a mapping that a project downloads is refused |
//! | default | COB-ID | plc | messages that a project waits for have another identifier |
//! | | identity, device type | plc | masters compare them at start-up |
//! | | any other | behaviour | what the device does until the entry is written |
//! | limits | narrower on a writable entry | plc | values that were accepted are refused |
//! | | wider on a writable entry | addition | |
//! | | wider on a read-only entry | behaviour | it may have values that it could not have before |
//! | | narrower on a read-only entry | documents | each value was possible before |
//! | unit | another scale, offset or quantity | plc | the same raw value means something else, and no tool notices |
//! | | said first, or no longer | documents | the value is what it was |
//! | special value | gone, or another meaning | plc | the raw value means something else |
//! | | added where it was an ordinary value | behaviour | |
//! | | added outside the limits | addition | |
//! | enum value, bit | gone, or with the meaning of another one | plc | the number means something else |
//! | | another name | behaviour | the same thing may be meant or not; this cannot be known |
//! | | added | addition | |
//! | active level | any | plc | 1 means what 0 meant |
//! | edge | any | behaviour | the same write may trigger or not |
//! | storage | any | behaviour | what survives power-off |
//! | layout of a storage group | any | stored | a device does not restore what was stored in another layout |
//! | write condition | added or another, removed | plc, addition | writes that were accepted are refused |
//! | alias | target, factor | plc | the raw value means something else |
//! | | rounding, what lies outside | behaviour | |
//! | what the EDS shows | access | plc, addition | tools obey the EDS |
//! | | default, flags | behaviour | tools write other entries into the device at start-up |
//! | capacity | smaller, larger on a writable entry | plc, addition | longer strings are refused |
//! | | any on a read-only entry | behaviour | |
//! | what a PDO carries | any | plc | the bytes mean something else |
//! | bit rate, placeholder, dynamic channel, LSS, boot-up, multiplexing, PDOs | lost, gained | plc, addition | |
//! | granularity | coarser or none, finer | plc, addition | |
//! | vendor number, product code | any | plc | a master refuses another device; tools do not find the EDS |
//! | revision | any | addition | it says that something changed, and is raised for that |
//! | error code | gone, added | plc, addition | a program waits for a code that never comes |
//! | reaction, option code, priority and reset of an error, what shows it | any | behaviour | |
//! | error register of an error | any | plc | |
//! | state, command | gone or another pattern | plc | |
//! | | added | behaviour, addition | a program meets a state that it does not know |
//! | transition | gone or between other states, added | plc, behaviour | |
//! | | another event or action, made by the device otherwise | behaviour | |
//! | command | other transitions | behaviour | |
//! | condition between entries | added or another, removed | plc, addition | a configuration that was accepted is refused |
//! | descriptions, links between objects, category, issue, error codes of bits, manual, errata | any | documents | |
//!
//! Whether firmware breaks is asked of the plan of the generated code ([`super::code`]), whether stored parameters are lost of its
//! layout ([`super::stored`]); each adds its consequence to the change that causes it.

use od_gen::plan::Words;
use od_spec::model::{
    Access, Alias, Direction, EdsPolicy, Entry, EntryId, ObjectKind, PdoMapping, Role, SpecialValue, Unit,
};

use super::change::{Class, Consequence};
use super::scope::Scope;

pub(super) type Consequences = Vec<Consequence>;

fn one(class: Class, because: &'static str) -> Consequences {
    vec![Consequence::new(class, because)]
}

/// Whether two names become the same symbols: they differ only in case and punctuation.
pub(super) fn same_words(one: &str, other: &str) -> bool {
    Words::of(one) == Words::of(other)
}

/// A name that an EDS shows as `ParameterName`.
pub(super) fn parameter_name(before: &str, after: &str) -> Consequences {
    if same_words(before, after) {
        return one(Class::Documents, "the symbols that tools make of it stay");
    }
    one(Class::Plc, "tools make symbols from names in the EDS")
}

/// VAR, ARRAY, RECORD, DOMAIN.
pub(super) fn object_kind(before: ObjectKind, after: ObjectKind) -> Consequences {
    let is_structured = |kind| matches!(kind, ObjectKind::Array | ObjectKind::Record);
    match (is_structured(before), is_structured(after)) {
        (true, true) => one(Class::Documents, "every value keeps its sub-index"),
        (false, false) => one(Class::Plc, "a block of data is read in another way than a value"),
        (true, false) | (false, true) => one(Class::Plc, "sub-index 0 means something else"),
    }
}

/// A data type.
pub(super) fn data_type() -> Consequences {
    one(Class::Plc, "another length or sign on the bus")
}

/// Access over the bus, with the lock.
pub(super) fn access(before: (Access, bool), after: (Access, bool)) -> Consequences {
    let ((old, was_locked), (new, is_locked)) = (before, after);
    let mut list = Vec::new();
    match (old.is_readable(), new.is_readable()) {
        (true, false) => list.extend(one(Class::Plc, "reading is refused")),
        (false, true) => list.extend(one(Class::Addition, "it can be read")),
        (true, true) | (false, false) => {}
    }
    match (old.is_writable(), new.is_writable()) {
        (true, false) => list.extend(one(Class::Plc, "writing is refused")),
        (false, true) => list.extend(one(Class::Addition, "it can be written")),
        (true, true) => match (was_locked, is_locked) {
            (false, true) => list.extend(one(Class::Plc, "writing is refused until the device is unlocked")),
            (true, false) => list.extend(one(Class::Addition, "it can be written without unlocking")),
            (true, true) | (false, false) => {}
        },
        (false, false) => {}
    }
    if old == Access::Const && new != Access::Const {
        list.extend(one(Class::Behaviour, "a value that was constant may change"));
    }
    if list.is_empty() {
        list.extend(one(Class::Documents, "reading and writing are as before"));
    }
    list
}

/// Into which PDOs an entry may be mapped.
pub(super) fn mapping(before: PdoMapping, after: PdoMapping) -> Consequences {
    let lost = |direction| before.allows(direction) && !after.allows(direction);
    if lost(Direction::Receive) || lost(Direction::Transmit) {
        return one(Class::Plc, "a mapping that holds it is refused");
    }
    one(Class::Addition, "it can be mapped")
}

/// The value after factory reset.
pub(super) fn default(id: EntryId, entry: &Entry) -> Consequences {
    if is_cob_id(id) {
        return one(Class::Plc, "the message has another identifier or other flags");
    }
    let because = if entry.access == Access::Const {
        "the constant has another value"
    } else {
        "the device starts with another value"
    };
    match (Role::of(id.index), id.sub.0) {
        (Role::DeviceType, _) => device_type(),
        (Role::Identity, 1 | 2) => identity(),
        (Role::Identity, 3) => revision(),
        _ => one(Class::Behaviour, because),
    }
}

/// A default that is the same amount in a unit of another scale.
pub(super) fn rescaled() -> Consequences {
    one(Class::Behaviour, "the same amount is another raw value")
}

/// Whether an entry is the identifier of a message (CiA 301).
const fn is_cob_id(id: EntryId) -> bool {
    matches!(
        (id.index.0, id.sub.0),
        (0x1005 | 0x1012 | 0x1014, 0)
            | (0x1028, 1..)
            | (0x1200..=0x12FF, 1 | 2)
            | (0x1400..=0x15FF | 0x1800..=0x19FF, 1)
    )
}

/// 1000h.
pub(super) fn device_type() -> Consequences {
    one(Class::Plc, "a master that compares the device type refuses the device")
}

/// Vendor number and product code.
pub(super) fn identity() -> Consequences {
    one(Class::Plc, "a master that compares the identity refuses the device")
}

/// 1018h.3.
pub(super) fn revision() -> Consequences {
    one(Class::Addition, "it shows that something changed")
}

/// A limit: how far the allowed values reach on one side, where more is further out.
pub(super) fn limit(entry: &Entry, before: i128, after: i128) -> Consequences {
    match (after.cmp(&before), entry.access.is_writable()) {
        (std::cmp::Ordering::Equal, _) => one(Class::Documents, "the data type has the same limit"),
        (std::cmp::Ordering::Less, true) => one(Class::Plc, "values that were accepted are refused"),
        (std::cmp::Ordering::Greater, true) => one(Class::Addition, "more values are accepted"),
        (std::cmp::Ordering::Less, false) => one(Class::Documents, "each value was possible before"),
        (std::cmp::Ordering::Greater, false) => {
            one(Class::Behaviour, "values can lie outside the old limits")
        }
    }
}

/// A unit, at an entry or where it is defined.
pub(super) fn unit(before: Option<&Unit>, after: Option<&Unit>) -> Consequences {
    let (Some(before), Some(after)) = (before, after) else {
        return one(Class::Documents, "the value itself is the same");
    };
    let meaning =
        |unit: &Unit| (unit.base_symbol().to_owned(), unit.step(), unit.offset_in(unit.base_symbol()));
    let formula = |unit: &Unit| unit.formula.as_ref().map(|formula| formula.alternatives.clone());
    if meaning(before) == meaning(after) && formula(before) == formula(after) {
        return one(Class::Documents, "one raw step is worth the same");
    }
    one(Class::Plc, "the same raw value means something else")
}

/// A special value that came.
pub(super) fn special_added(old: &Entry, value: i128) -> Consequences {
    if old.allows(value) {
        return one(Class::Behaviour, "the raw value was an ordinary one");
    }
    one(Class::Addition, "the raw value was not used")
}

/// A special value that went.
pub(super) fn special_removed() -> Consequences {
    one(Class::Plc, "the raw value means something else")
}

/// A raw value with a name, or a bit, that is called otherwise.
pub(super) fn meaning(before: &str, after: &str, is_anothers: bool) -> Consequences {
    if same_words(before, after) {
        return one(Class::Documents, "the same words");
    }
    if is_anothers {
        return one(Class::Plc, "it means what another one meant");
    }
    one(Class::Behaviour, "it may mean something else")
}

/// Special values by raw value, called otherwise.
pub(super) fn special_renamed(old: &[SpecialValue], before: &str, after: &str) -> Consequences {
    meaning(before, after, old.iter().any(|special| same_words(&special.name, after)))
}

/// What keeps a value over power-off.
pub(super) fn storage() -> Consequences {
    one(Class::Behaviour, "another command or none keeps it over power-off")
}

/// The condition of a write; `None` before or after where there is none.
pub(super) fn condition(is_required: bool) -> Consequences {
    if is_required {
        return one(Class::Plc, "writes that were accepted can be refused");
    }
    one(Class::Addition, "writes are accepted at any time")
}

/// What an entry is another view of.
pub(super) fn alias(before: Option<&Alias>, after: Option<&Alias>) -> Consequences {
    let shown = |alias: Option<&Alias>| alias.map(|alias| (alias.target, alias.factor));
    if shown(before) == shown(after) {
        return one(Class::Behaviour, "values between two steps or outside the range are shown otherwise");
    }
    match (before, after) {
        (Some(_), Some(_)) => one(Class::Plc, "it shows another value"),
        (None, _) => one(Class::Behaviour, "writing it changes another entry"),
        (_, None) => one(Class::Behaviour, "it does not follow another entry any more"),
    }
}

/// What an EDS shows of an entry, where that does not follow from the facts that changed anyhow.
pub(super) fn eds(before: EdsPolicy, after: EdsPolicy) -> Consequences {
    let mut list = Vec::new();
    if before.access != after.access {
        list.extend(access((before.access, false), (after.access, false)));
    }
    if before.default != after.default || before.flags() != after.flags() {
        list.extend(one(Class::Behaviour, "tools write other entries into the device"));
    }
    list
}

/// The most bytes of a string.
pub(super) fn capacity(scope: Scope, entry: &Entry, before: Option<u16>, after: Option<u16>) -> Consequences {
    let (Some(before), Some(after)) = (before, after) else {
        return one(Class::Documents, "the string itself is the same");
    };
    if !scope.access(entry).0.is_writable() {
        return one(Class::Behaviour, "the string can have another length");
    }
    if after < before {
        return one(Class::Plc, "strings that were accepted are refused");
    }
    one(Class::Addition, "longer strings are accepted")
}

/// What a PDO carries.
pub(super) fn map() -> Consequences {
    one(Class::Plc, "the bytes of the PDO mean something else")
}

/// Something that a device can do.
pub(super) fn ability(is_lost: bool) -> Consequences {
    if is_lost {
        return one(Class::Plc, "a project that uses it fails");
    }
    one(Class::Addition, "more is supported")
}

/// The smallest step of a PDO mapping, in bits; 0 where none can be changed.
pub(super) fn granularity(before: u8, after: u8) -> Consequences {
    match (before, after) {
        (_, 0) => one(Class::Plc, "a project that changes a mapping is refused"),
        (0, _) => one(Class::Addition, "mappings can be changed"),
        (before, after) if after > before => one(Class::Plc, "mappings with finer parts are refused"),
        _ => one(Class::Addition, "mappings can have finer parts"),
    }
}

//! The facts of an entry, as every output has to state them, and how they compare.

use std::collections::BTreeMap;

use od_spec::ascii::transliterate;
use od_spec::model::{Access, Entry, PdoMapping, Ratio, Storage, TypeKind, Value};

/// Who may do what, whatever the words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reach {
    Constant,
    Read,
    Write,
    ReadWrite,
    ReadAndServiceWrites,
    ServiceWrites,
}

impl Reach {
    pub(crate) fn of(access: Access, is_locked: bool) -> Self {
        match (access, is_locked) {
            (Access::Const, _) => Self::Constant,
            (Access::Ro, _) => Self::Read,
            (Access::Wo, false) => Self::Write,
            (Access::Wo, true) => Self::ServiceWrites,
            (Access::Rw | Access::Rwr | Access::Rww, false) => Self::ReadWrite,
            (Access::Rw | Access::Rwr | Access::Rww, true) => Self::ReadAndServiceWrites,
        }
    }
}

/// One raw step: so much of a symbol, which is in ASCII.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Step {
    pub scale: Ratio,
    pub symbol: String,
}

/// Limits as an output states them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Limits {
    /// Those of the model, to the letter.
    Exact { low: Option<i128>, high: Option<i128> },
    /// Those that narrow the data type; a side that is not stated is an end of it, and those of an enum are its values.
    Narrowing { low: Option<i128>, high: Option<i128> },
}

/// What one output says about one entry.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Facts {
    pub default: Reported<Option<Value>>,
    pub limits: Limits,
    pub step: Option<Step>,
    /// Names by raw value, in ASCII.
    pub special: BTreeMap<i128, String>,
    pub reach: Reach,
    pub storage: Storage,
    pub mapping: PdoMapping,
}

/// A fact that an output may leave to another.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Reported<T> {
    Said(T),
    Elsewhere,
}

/// Where an output and the model disagree: the fact, what is said, what is so.
pub(crate) fn disagreements(said: &Facts, entry: &Entry) -> Vec<String> {
    let mut list = Vec::new();
    let mut compare = |fact: &str, said: String, model: String| {
        if said != model {
            list.push(format!("{fact}: said {said}, is {model}"));
        }
    };
    if let Reported::Said(default) = &said.default {
        compare("default", format!("{default:?}"), format!("{:?}", entry.default));
    }
    let step =
        entry.unit.as_ref().map(|unit| Step { scale: unit.scale, symbol: transliterate(&unit.symbol) });
    compare("unit", format!("{:?}", said.step), format!("{step:?}"));
    let special: BTreeMap<i128, String> =
        entry.special.iter().map(|special| (special.value, transliterate(&special.name))).collect();
    compare("special", format!("{:?}", said.special), format!("{special:?}"));
    compare("access", format!("{:?}", said.reach), format!("{:?}", Reach::of(entry.access, entry.locked)));
    compare("storage", format!("{:?}", said.storage), format!("{:?}", entry.stored));
    compare("mapping", format!("{:?}", said.mapping), format!("{:?}", entry.pdo));
    let ends = entry.data_type.range();
    let is_enum = matches!(entry.named_type.as_ref().map(|named| &named.kind), Some(TypeKind::Enum(_)));
    match said.limits {
        Limits::Exact { low, high } => {
            compare("limits", format!("{low:?} {high:?}"), format!("{:?} {:?}", entry.low, entry.high));
        }
        Limits::Narrowing { low: None, high: None } if is_enum => {}
        Limits::Narrowing { low, high } => {
            let filled = (low.or(ends.map(|(low, _)| low)), high.or(ends.map(|(_, high)| high)));
            let model = (entry.low.or(ends.map(|(low, _)| low)), entry.high.or(ends.map(|(_, high)| high)));
            compare("limits", format!("{filled:?}"), format!("{model:?}"));
        }
    }
    list
}

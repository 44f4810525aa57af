//! The resolved model: what the specification says, with nothing left open.
//!
//! A [`System`] holds what its devices share and one [`Dictionary`] per device. Every backend works
//! from here and from nothing else.

mod arranged;
mod axis;
mod condition;
mod device;
mod document;
mod download;
mod dynamic_channel;
mod editor;
mod error_kind;
mod fact;
mod flow;
mod further;
mod held;
mod hysteresis;
mod machine;
mod named_type;
mod object;
mod pdo;
mod pdo_parameter;
mod phrases;
mod ratio;
mod real;
mod role;
mod text;
mod timing;
mod types;
mod unit;
mod value;
mod views;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

pub(crate) use arranged::{Course, Stuck};
pub use axis::{Axis, AxisMark, AxisReach, AxisSpan};
pub use condition::{
    ArithmeticOp, CompareOp, Comparison, EntryRef, Expr, Incomputable, Outcome, Term, Values,
};
pub use device::{AnyError, BIT_RATES, Date, DateTime, DeviceInfo, Dictionary, FileInfo};
pub use document::{
    Basis, BitTable, Content, Document, Erratum, ErratumKind, ErratumPlace, Figure, Issue, LadderTable,
    PdoTable, Prose, ProseKind, Section, Table, TableContent, TableId, Unprinted,
};
pub use download::{NoSuchValue, Write, download};
pub use dynamic_channel::DynamicChannel;
pub use editor::{EditorNotes, EditorProperty};
pub use error_kind::ErrorKind;
pub use fact::{Author, Departure, Fact, Facts, Part, Statement};
pub use flow::{Block, Flow, Inflow};
pub use further::{Further, FurtherSection, KeyValue, Module};
pub(crate) use held::Held;
pub use hysteresis::{Switch, SwitchBack, SwitchPoints, SwitchSide};
pub use machine::{BitPattern, ByDevice, Command, PatternBit, State, StateMachine, Transition};
pub use named_type::{
    BitErrors, BitField, BitUsage, Edge, EnumValue, EnumValues, ModeMeaning, NamedType, TypeKind,
};
pub use object::{Alias, EdsPolicy, Entry, Object, ObjectKind, Origin, RealLimits, SpecialValue};
pub use pdo::{Mapped, Pdo, PdoTarget};
pub use pdo_parameter::{CommunicationParameter, usual as usual_pdo_names, usual_pdo_storage};
pub use phrases::Phrases;
pub use ratio::Ratio;
pub use real::Real;
pub use role::Role;
pub use text::Text;
pub use timing::{Level, NamedBits, Signal, SignalCarrier, Timing, TimingStep};
pub use types::{
    Access, AccessRight, Category, DataType, Direction, EntryId, Family, Index, Outside, PdoMapping,
    Rounding, Storage, SubIndex,
};
pub use unit::{Base, Unit};
pub use value::{Value, convert};
pub use views::{Carrier, Devices, PdoField, View};

use crate::source::Span;

/// What a system was read from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SystemSource {
    /// A specification, whose author can be asked to say more.
    Specification,
    /// An EDS or DCF, which says what that format has keys for.
    Eds,
}

/// Everything that one specification describes.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct System {
    /// What it was read from.
    pub source: SystemSource,
    /// Title of the product or family.
    pub title: String,
    /// Language codes; the first is the default.
    pub languages: Vec<String>,
    /// The printed manual, its revision and its chapters.
    pub document: Document,
    /// The maker.
    pub vendor: Vendor,
    /// Units by name.
    pub units: BTreeMap<String, Arc<Unit>>,
    /// Named types by name.
    pub types: BTreeMap<String, Arc<NamedType>>,
    /// Error codes, ascending.
    pub errors: Vec<ErrorCode>,
    /// State machines by name.
    pub machines: BTreeMap<String, StateMachine>,
    /// Conditions between entries, in the order of the specification.
    pub constraints: Vec<Constraint>,
    /// What the printed manual says otherwise, in the order of the specification.
    pub errata: Vec<Erratum>,
    /// One dictionary per device, in the order of the specification.
    pub devices: Vec<Dictionary>,
    /// The positions of the constraints that a device can break.
    pub(crate) constraints_by_device: BTreeMap<String, Vec<usize>>,
}

impl System {
    /// The constraints that a device can break, in order.
    pub fn constraints_about(&self, key: &str) -> impl Iterator<Item = &Constraint> {
        let positions = self.constraints_by_device.get(key).map_or(&[][..], Vec::as_slice);
        positions.iter().filter_map(|position| self.constraints.get(*position))
    }

    /// Takes the constraints, which the devices can break.
    pub(crate) fn constrain(&mut self, constraints: Vec<Constraint>) {
        self.constraints_by_device.clear();
        for (position, constraint) in constraints.iter().enumerate() {
            let keys: BTreeSet<&String> =
                constraint.seen_from.iter().chain(constraint.devices.keys()).collect();
            for key in keys {
                self.constraints_by_device.entry(key.clone()).or_default().push(position);
            }
        }
        self.constraints = constraints;
    }

    /// The device with this key.
    pub fn device(&self, key: &str) -> Option<&Dictionary> {
        self.devices.iter().find(|device| device.key == key)
    }

    /// The default language.
    pub fn language(&self) -> &str {
        self.languages.first().map_or("en", String::as_str)
    }
}

/// The maker of a device.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Vendor {
    /// Company name.
    pub name: String,
    /// Vendor-ID assigned by CiA (1018h.1); 0 when unknown.
    pub number: u32,
    /// Where the name is written.
    pub name_span: Option<Span>,
    /// Where the number is written.
    pub number_span: Option<Span>,
}

/// An emergency and error code (603Fh, 1003h).
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct ErrorCode {
    /// The code.
    pub code: u16,
    /// Name.
    pub name: String,
    /// Devices that report it.
    pub devices: Devices,
    /// Priority, as the manual classes it.
    pub priority: Option<String>,
    /// What the device does.
    pub reaction: Text,
    /// The entry whose value chooses the reaction (CiA 402: 605Eh and its like).
    pub option_code: Option<EntryId>,
    /// What resets it, where that is not what resets every error of a device; see [`ErrorCode::reset_on`].
    pub reset: Text,
    /// The kinds of error as which 1001h reports it, as far as they are stated, ascending; see [`ErrorCode::register`].
    pub kinds: Vec<ErrorKind>,
    /// Devices that treat it as priority, reaction and option code say.
    pub treated_by: Devices,
    /// More about it.
    pub about: Text,
    /// Words by which readers look for it.
    pub search: Phrases,
    /// Where its code is written.
    pub span: Span,
}

impl ErrorCode {
    /// The code for "no error".
    pub const NONE: u16 = 0x0000;

    /// Whether a code is of the class 00xxh, which says that an error is gone or that there is none (CiA 301 table 21).
    pub const fn is_no_error(code: u16) -> bool {
        code >> 8 == 0
    }

    /// The bits of 1001h that it sets: those that are stated, or else that of its class; with any, the generic one.
    pub fn register(&self) -> u8 {
        if Self::is_no_error(self.code) {
            return 0;
        }
        let of_class = ErrorKind::of_code(self.code);
        let kinds = self.kinds.iter().copied().chain(of_class.filter(|_| self.kinds.is_empty()));
        kinds.chain([ErrorKind::Generic]).fold(0, |bits, kind| bits | 1 << kind.bit())
    }

    /// What resets the error on a device: what it says itself, or else what the device says of every error. Empty where
    /// no one says it, and for the code that means that there is no error.
    pub fn reset_on<'a>(&'a self, device: &'a Dictionary) -> &'a Text {
        if self.reset.is_empty() && self.code != Self::NONE { &device.any_error.reset } else { &self.reset }
    }
}

/// What a constraint has in common with others that were written with it, as one for several numbers.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Series {
    /// The name that they share, with `{n}` for the number.
    pub name: String,
    /// The number of this one.
    pub number: u32,
}

/// A condition between entries that every configuration must meet.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Constraint {
    /// Name.
    pub name: String,
    /// The series that it belongs to, where one condition was written for several numbers.
    pub series: Option<Series>,
    /// Why.
    pub about: Text,
    /// The condition.
    pub require: Expr,
    /// The condition counts only while this one holds.
    pub when: Option<Expr>,
    /// Devices whose entries it names; a list even where it names those of every device.
    pub devices: Devices,
    /// Devices on which it is tried: those that have every entry named without a device. Never empty.
    pub seen_from: Vec<String>,
    /// Where the condition is written.
    pub span: Span,
    /// Where it names entries, in the order of [`Expr::entries`].
    pub places: Vec<Span>,
}

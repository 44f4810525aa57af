//! A specification as written: every leaf with its place, `None` where nothing is written.

mod entry;
mod pdos;
pub(crate) mod plant;
mod setting;
mod texts;

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use crate::expr::{AnyName, Expr, without_names};
use crate::keys::{
    any_error_keys, axis_keys, block_keys, channel_keys, command_keys, constraint_keys, device_keys,
    erratum_keys, error_keys, file_keys, machine_keys, mark_keys, notes_keys, revision_keys, signal_keys,
    source_keys, span_keys, state_keys, switch_keys, timing_keys, timing_step_keys, transition_keys,
    unit_keys, vendor_keys,
};
use crate::model::{
    Access, Basis, BitPattern, BitUsage, ByDevice, Date, DateTime, Direction, Edge, EditorNotes, ErratumKind,
    ErrorKind, Fact, Index, Outside, PdoMapping, Phrases, ProseKind, Ratio, Rounding, Series, SubIndex, Text,
};
use crate::source::{FileId, Span, Spanned};

pub(crate) use entry::{BitErrorDecl, DefaultDecl, EdsDecl, EntryDecl, SpecialDecl, adopted};
pub(crate) use pdos::{
    MappingKind, PdoCommunicationDecl, PdoDecl, PdoMappingDecl, PdoParameterDecl, PdoParametersDecl, PdosDecl,
};

pub(crate) use setting::Reference;
pub use setting::SettingDecl;
pub use texts::Untranslated;
pub(crate) use texts::{Named, TextMention};

pub(crate) type Words = Option<Spanned<Text>>;
pub(crate) type Name = Spanned<String>;

/// The structure of a table of [`crate::keys`]: first what is known without its keys, then a field for each key.
macro_rules! declaration {
    ($(#[$meta:meta])* $name:ident { $($(#[$head_meta:meta])* $head:ident: $head_type:ty,)* } {
        $($key:literal $($need:ident)?: $shape:expr => $field:ident: $type:ty, $about:literal
            $(, $example:literal)?;)+
    }) => {
        $(#[$meta])*
        pub(crate) struct $name {
            $($(#[$head_meta])* pub $head: $head_type,)*
            $(pub $field: $type,)+
        }

        impl $crate::ast::Lacking for $name {
            fn lacking(&self) -> Vec<&'static str> {
                let lacking: &[Option<&str>] = &[$($(declaration!(@$need $key, self.$field),)?)+];
                lacking.iter().flatten().copied().collect()
            }
        }
    };
    (@required $key:literal, $field:expr) => { None };
    (@inherited $key:literal, $field:expr) => { $field.is_empty().then_some($key) };
}
use declaration;

/// A declaration that may take keys from a library.
pub(crate) trait Lacking {
    /// The keys that it needs and has neither of its own nor from elsewhere.
    fn lacking(&self) -> Vec<&'static str>;
}

/// A field of a declaration that may have nothing in it.
trait MayBeEmpty {
    fn is_empty(&self) -> bool;
}

impl<T> MayBeEmpty for Vec<T> {
    fn is_empty(&self) -> bool {
        self.as_slice().is_empty()
    }
}

impl<T> MayBeEmpty for Option<T> {
    fn is_empty(&self) -> bool {
        self.is_none()
    }
}

/// One file.
#[derive(Debug)]
pub(crate) struct Spec {
    pub file: FileId,
    pub span: Span,
    /// A key of the top level was refused, or `devices:` is not a map: devices may be meant by it.
    pub unsure: bool,
    pub profile: Option<Name>,
    pub title: Option<Name>,
    pub languages: Vec<Name>,
    pub source: Option<SourceDecl>,
    pub revision: Option<IssueDecl>,
    pub history: Vec<IssueDecl>,
    pub vendor: Option<VendorDecl>,
    pub uses: Vec<Name>,
    pub allow: Vec<AllowDecl>,
    pub glossary: Vec<(Name, Text)>,
    pub devices: Vec<DeviceDecl>,
    pub units: Vec<UnitDecl>,
    pub types: Vec<TypeDecl>,
    pub axes: Option<Axes>,
    pub features: Vec<FeatureDecl>,
    pub objects: Vec<ObjectDecl>,
    pub pdos: Vec<(Name, PdosDecl)>,
    pub errors: Vec<ErrorDecl>,
    pub machines: Vec<MachineDecl>,
    pub constraints: Vec<ConstraintDecl>,
    pub errata: Vec<ErratumDecl>,
    pub sections: Vec<SectionDecl>,
    /// What the texts name.
    pub mentions: Vec<TextMention>,
    /// The texts that lack a language.
    pub untranslated: Vec<Untranslated>,
    pub front_end: FrontEnd,
}

impl Spec {
    /// The languages that are shown; without `languages:`, English only.
    pub(crate) fn shown_languages(&self) -> Vec<String> {
        match self.languages.as_slice() {
            [] => vec!["en".to_owned()],
            languages => languages.iter().map(|language| language.value.clone()).collect(),
        }
    }
}

/// A rule that may be broken.
#[derive(Debug)]
pub(crate) struct AllowDecl {
    pub code: Name,
    pub reason: Text,
    /// The objects that may break it; `None` where all may.
    pub at: Option<Vec<AllowedObject>>,
}

/// An object that may break a rule.
#[derive(Debug)]
pub(crate) struct AllowedObject {
    pub index: Spanned<Index>,
    /// What the file says of it: under `objects:`, and of a PDO's parameters under `pdos:`.
    pub places: Vec<Span>,
}

/// In which form a device was written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FrontEnd {
    /// A specification: what follows from the device is filled in.
    Specification,
    /// An EDS or DCF, which says everything itself.
    Eds,
}

/// Objects of a library that repeat for every axis.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Axes {
    pub span: Span,
    pub first: Index,
    pub last: Index,
    pub count: u16,
}

impl Axes {
    /// Axis (from 1) and index on axis 1 of an index on a further axis.
    pub(crate) fn locate(self, index: Index) -> Option<(u16, Index)> {
        let size = self.last.0.checked_sub(self.first.0)?.checked_add(1)?;
        let offset = index.0.checked_sub(self.first.0)?;
        let axis = offset / size + 1;
        (2..=self.count).contains(&axis).then_some((axis, Index(self.first.0 + offset % size)))
    }

    /// The index on an axis (from 1) of an index on axis 1; indices outside the axes are the same on all.
    pub(crate) fn shift(self, index: Index, axis: u16) -> Option<Index> {
        if !(self.first..=self.last).contains(&index) {
            return Some(index);
        }
        let size = self.last.0.checked_sub(self.first.0)?.checked_add(1)?;
        Some(Index(index.0.checked_add(size.checked_mul(axis.checked_sub(1)?)?)?))
    }
}

source_keys! { declaration
    #[derive(Debug)]
    SourceDecl {}
}

revision_keys! { declaration
    #[derive(Debug)]
    IssueDecl {}
}

vendor_keys! { declaration
    #[derive(Debug)]
    VendorDecl {}
}

device_keys! { declaration
    #[derive(Debug)]
    DeviceDecl {
        key: Name,
    }
}

channel_keys! { declaration
    #[derive(Debug)]
    ChannelDecl {
        range: Spanned<IndexRange>,
    }
}

/// Indices from the first to the last.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct IndexRange {
    pub first: Index,
    pub last: Index,
}

file_keys! { declaration
    #[derive(Debug)]
    FileDecl {}
}

/// Keys of a section of the EDS.
#[derive(Debug)]
pub(crate) struct FileSectionDecl {
    pub name: Name,
    /// With their values.
    pub keys: Vec<(Name, Name)>,
}

notes_keys! { declaration
    #[derive(Debug)]
    NotesDecl {
        range: Spanned<IndexRange>,
    }
}

any_error_keys! { declaration
    #[derive(Debug)]
    AnyErrorDecl {}
}

unit_keys! { declaration
    #[derive(Debug)]
    UnitDecl {
        name: Name,
    }
}

/// What the raw value 0 of a unit means, in its symbol.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Offset(pub Ratio);

/// One symbol of a unit in a more basic one.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BaseDecl {
    pub factor: Ratio,
    pub symbol: String,
}

/// A condition.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum ConditionDecl {
    /// It names entries by index.
    Plain(Expr),
    /// It has names that have to be looked up.
    Named(String),
}

impl ConditionDecl {
    /// Reads a condition.
    pub(crate) fn read(text: &str) -> Option<Self> {
        let named = || without_names(text, &mut AnyName).ok().map(|_| Self::Named(text.to_owned()));
        Expr::parse(text).ok().map(Self::Plain).or_else(named)
    }
}

/// Numbers that follow each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct NumberRange {
    pub first: u8,
    pub last: u8,
}

/// A term of a condition that is written alone.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Formula(pub Expr);

#[derive(Debug)]
pub(crate) struct TypeDecl {
    /// A key of the type or of its bits was refused.
    pub unsure: bool,
    pub name: Name,
    pub base: Option<Name>,
    pub about: Words,
    pub gap: Words,
    pub values: Option<Vec<ValueDecl>>,
    pub bits: Option<Vec<BitDecl>>,
    pub rest: Option<Spanned<BitUsage>>,
}

#[derive(Debug)]
pub(crate) struct ValueDecl {
    pub value: Spanned<i128>,
    pub name: Option<Name>,
    pub supported: Option<Spanned<bool>>,
    pub about: Words,
    pub gap: Words,
    pub search: Option<Spanned<Phrases>>,
}

#[derive(Debug)]
pub(crate) struct BitDecl {
    pub bits: Spanned<BitRange>,
    pub usage: BitUsage,
    pub name: Option<Name>,
    pub about: Words,
    pub gap: Words,
    pub search: Option<Spanned<Phrases>>,
    pub errors: Vec<Spanned<i128>>,
    pub mnemonic: Option<Name>,
    pub clamp: Option<Name>,
    pub active: Option<Spanned<i128>>,
    pub edge: Option<Edge>,
    pub priority: Option<Name>,
    pub values: Vec<ValueDecl>,
    pub modes: Vec<ModeBitDecl>,
}

/// A bit, or the bits from the lowest to the highest of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct BitRange {
    pub first: u8,
    pub last: u8,
}

/// What a bit means in one mode of operation.
#[derive(Debug)]
pub(crate) struct ModeBitDecl {
    pub mode: Name,
    pub name: Option<Name>,
    pub about: Words,
    pub gap: Words,
}

#[derive(Debug)]
pub(crate) struct FeatureDecl {
    pub name: Name,
    pub implied: bool,
    pub objects: Vec<Spanned<Index>>,
    pub needs: Vec<Name>,
    /// Channels in each element of its arrays.
    pub channels: Option<Spanned<i128>>,
    /// The feature that has as many elements.
    pub channels_of: Option<Name>,
}

/// A feature as a device selects it.
#[derive(Debug, Clone)]
pub(crate) struct FeatureChoice {
    pub name: Name,
    pub channels: ChannelNumber,
}

/// How many channels a device has of a feature.
#[derive(Debug, Clone, Copy)]
pub(crate) enum ChannelNumber {
    /// It does not say.
    None,
    /// What it says was refused.
    Refused,
    /// So many.
    Stated(Spanned<i128>),
}

#[derive(Debug, Clone)]
pub(crate) struct ObjectDecl {
    pub index: Spanned<Index>,
    /// Bytes that its entries take, about: what is written once for all elements counts for each.
    pub weight: usize,
    pub devices: Option<Vec<Name>>,
    pub from: Option<Name>,
    /// The object that it is like; what is written here differs.
    pub like: Option<Spanned<Index>>,
    pub alias: Option<Name>,
    pub outside: Option<Spanned<Outside>>,
    pub rounding: Option<Spanned<Rounding>>,
    pub array: Option<Box<ArrayDecl>>,
    pub record: Option<RecordDecl>,
    pub sub0: Option<Box<EntryDecl>>,
    pub omit: Vec<Spanned<i128>>,
    pub links: Option<Vec<Spanned<Index>>>,
    /// What CANopenEditor keeps of it; a specification says it at the device.
    pub editor: Option<Box<EditorNotes>>,
    pub entry: EntryDecl,
}

impl ObjectDecl {
    /// The entries that are written one by one; of a VAR there is none.
    pub(crate) fn written(&self) -> impl Iterator<Item = &EntryDecl> {
        let elements = self.array.iter().flat_map(|array| &array.elements);
        let members = self.record.iter().flat_map(|record| &record.members);
        self.sub0.as_deref().into_iter().chain(elements.chain(members).map(|(_, entry)| entry))
    }

    /// [`written`](Self::written), with their sub-indices.
    pub(crate) fn entries_mut(&mut self) -> impl Iterator<Item = (SubIndex, &mut EntryDecl)> {
        let elements = self.array.iter_mut().flat_map(|array| &mut array.elements);
        let members = self.record.iter_mut().flat_map(|record| &mut record.members);
        let count = self.sub0.iter_mut().map(|entry| (SubIndex(0), &mut **entry));
        count.chain(elements.chain(members).map(|(sub, entry)| (sub.value, entry)))
    }

    /// How many entries it has, sub-index 0 among them, if all of them are right.
    pub(crate) fn entries(&self) -> usize {
        let elements = self.array.as_ref().map(|array| {
            let count = array.count.map_or(0, |count| count.value);
            let highest = array.elements.last().map_or(0, |(sub, _)| i128::from(sub.value.0));
            // What is beyond the sub-indices is refused as a number.
            usize::try_from(count.max(highest).clamp(0, 254)).unwrap_or(0)
        });
        let members = self.record.as_ref().map(|record| record.members.len());
        1 + elements.or(members).unwrap_or(0)
    }
}

#[derive(Debug, Clone)]
pub(crate) struct ArrayDecl {
    pub span: Span,
    pub count: Option<Spanned<i128>>,
    /// Element name, as a pattern with `{n}`, is `entry.name`.
    pub entry: EntryDecl,
    pub elements: Vec<(Spanned<SubIndex>, EntryDecl)>,
}

#[derive(Debug, Clone)]
pub(crate) struct RecordDecl {
    pub span: Span,
    pub members: Vec<(Spanned<SubIndex>, EntryDecl)>,
}

error_keys! { declaration
    #[derive(Debug)]
    ErrorDecl {
        codes: Spanned<CodeRange>,
        /// Something here was refused.
        unsure: bool,
    }
}

/// Sub-indices from the first to the last.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct SubIndexRange {
    pub first: SubIndex,
    pub last: SubIndex,
}

impl SubIndexRange {
    /// The sub-indices, ascending.
    pub(crate) fn subs(self) -> impl ExactSizeIterator<Item = SubIndex> {
        let count = self.last.0.saturating_sub(self.first.0).saturating_add(1);
        (0..count).map(move |at| SubIndex(self.first.0 + at))
    }
}

/// Error codes from the first to the last.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct CodeRange {
    pub first: u16,
    pub last: u16,
}

impl CodeRange {
    /// The codes, ascending.
    pub(crate) const fn codes(self) -> RangeInclusive<u16> {
        self.first..=self.last
    }
}

machine_keys! { declaration
    #[derive(Debug, Clone)]
    MachineDecl {
        name: Name,
        /// Something here was refused.
        unsure: bool,
    }
}

state_keys! { declaration
    #[derive(Debug, Clone)]
    StateDecl {
        name: Name,
    }
}

transition_keys! { declaration
    #[derive(Debug, Clone)]
    TransitionDecl {
        number: Spanned<i128>,
    }
}

command_keys! { declaration
    #[derive(Debug, Clone)]
    CommandDecl {
        name: Name,
    }
}

constraint_keys! { declaration
    #[derive(Debug)]
    ConstraintDecl {
        name: Name,
        /// The number whose constraint it is, where it was written once for several.
        series: Option<Series>,
    }
}

erratum_keys! { declaration
    #[derive(Debug)]
    ErratumDecl {}
}

#[derive(Debug)]
pub(crate) struct SectionDecl {
    pub number: Option<Name>,
    pub title: Words,
    pub content: Vec<PartDecl>,
    pub search: Option<Spanned<Phrases>>,
}

/// A text or table of a section.
#[derive(Debug)]
pub(crate) struct PartDecl {
    pub number: Option<Spanned<i128>>,
    pub title: Words,
    pub figure: Option<Spanned<FigureDecl>>,
    /// The objects whose warnings it says.
    pub warns_for: Vec<Spanned<Index>>,
    /// The columns that are printed.
    pub columns: Vec<Name>,
    /// The numbers of its rows in the order as printed.
    pub order: Option<Spanned<Vec<Spanned<i128>>>>,
    /// The keys that say what it is; exactly one is right.
    pub contents: Vec<Spanned<ContentDecl>>,
}

/// `figure:` of a table.
#[derive(Debug)]
pub(crate) struct FigureDecl {
    /// None where it was refused.
    pub number: Option<Spanned<i128>>,
    pub title: Words,
}

timing_keys! { declaration
    #[derive(Debug)]
    TimingDecl {}
}

signal_keys! { declaration
    #[derive(Debug)]
    SignalDecl {}
}

/// The levels of a signal, of which none was refused.
#[derive(Debug)]
pub(crate) struct Levels(pub Vec<Name>);

timing_step_keys! { declaration
    #[derive(Debug)]
    TimingStepDecl {}
}

switch_keys! { declaration
    #[derive(Debug)]
    SwitchDecl {}
}

block_keys! { declaration
    #[derive(Debug)]
    BlockDecl {
        /// Something here was refused.
        unsure: bool,
    }
}

/// What a block takes from another.
#[derive(Debug)]
pub(crate) struct InflowDecl {
    pub block: Option<Name>,
    pub carries: Words,
}

axis_keys! { declaration
    #[derive(Debug)]
    AxisDecl {}
}

mark_keys! { declaration
    #[derive(Debug)]
    MarkDecl {}
}

span_keys! { declaration
    #[derive(Debug)]
    SpanDecl {}
}

#[derive(Debug)]
pub(crate) enum ContentDecl {
    Prose(ProseKind, Vec<Text>),
    Overview(Vec<Spanned<Index>>),
    Objects(Vec<Spanned<Index>>),
    Bits { named_type: Option<Name>, masks: Option<Spanned<i128>> },
    Values(Name),
    Errors(Vec<Name>),
    Reactions(Vec<Name>),
    States(Name),
    Transitions(Name),
    Commands(Name),
    Ladder { constraint: Option<Name>, labels: Option<Spanned<Vec<Text>>> },
    Timing(TimingDecl),
    Hysteresis(Vec<Spanned<SwitchDecl>>),
    Flow(Vec<Spanned<BlockDecl>>),
    Axis(AxisDecl),
    Pdos { device: Option<Name>, direction: Option<Spanned<Direction>> },
    Rows { columns: Vec<Text>, rows: Vec<Spanned<Vec<Text>>> },
    Glossary,
    History,
}

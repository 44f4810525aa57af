//! A specification as written: every leaf with its place, `None` where nothing is written.

use crate::expr::Expr;
use crate::model::{
    Access, AccessRight, BitPattern, BitUsage, Category, Date, DateTime, Direction, Edge, ErratumKind, Fact,
    Facts, Index, Outside, PdoMapping, Ratio, Rounding, Statement, Storage, SubIndex, Text,
};
use crate::source::{FileId, Span, Spanned};

pub(crate) type Words = Option<Spanned<Text>>;
pub(crate) type Name = Spanned<String>;

/// One file.
#[derive(Debug)]
pub(crate) struct Spec {
    pub file: FileId,
    pub span: Span,
    /// A key of the top level was refused, or `devices:` is no map: devices may be meant by it.
    pub unsure: bool,
    pub profile: Option<Name>,
    pub title: Option<Name>,
    pub languages: Vec<Name>,
    pub source: Option<SourceDecl>,
    pub revision: Option<IssueDecl>,
    pub history: Vec<IssueDecl>,
    pub vendor: Option<VendorDecl>,
    pub uses: Vec<Name>,
    pub glossary: Vec<(Name, Text)>,
    pub devices: Vec<DeviceDecl>,
    pub units: Vec<UnitDecl>,
    pub types: Vec<TypeDecl>,
    pub axes: Option<Axes>,
    pub features: Vec<FeatureDecl>,
    pub objects: Vec<ObjectDecl>,
    pub pdos: Vec<(Name, Vec<PdoDecl>)>,
    pub errors: Vec<ErrorDecl>,
    pub machines: Vec<MachineDecl>,
    pub constraints: Vec<ConstraintDecl>,
    pub errata: Vec<ErratumDecl>,
    pub sections: Vec<SectionDecl>,
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

#[derive(Debug)]
pub(crate) struct SourceDecl {
    pub title: Option<Name>,
    pub edition: Option<Name>,
    pub about: Words,
}

#[derive(Debug)]
pub(crate) struct IssueDecl {
    pub number: Option<Name>,
    pub date: Option<Spanned<Date>>,
    pub about: Words,
}

#[derive(Debug)]
pub(crate) struct VendorDecl {
    pub name: Option<Name>,
    pub number: Option<Spanned<i128>>,
}

#[derive(Debug)]
pub(crate) struct DeviceDecl {
    pub key: Name,
    pub name: Option<Name>,
    pub about: Words,
    pub product_name: Option<Name>,
    pub product: Option<Spanned<i128>>,
    pub product_revision: Option<Spanned<i128>>,
    pub order_code: Option<Name>,
    pub bit_rates: Vec<Spanned<i128>>,
    pub device_type: Option<Spanned<i128>>,
    pub granularity: Option<Spanned<i128>>,
    pub boot_up_master: Option<Spanned<bool>>,
    pub boot_up_slave: Option<Spanned<bool>>,
    pub group_messaging: Option<Spanned<bool>>,
    pub lss: Option<Spanned<bool>>,
    pub dummies: Vec<Name>,
    pub features: Vec<Name>,
    pub eds: Option<FileDecl>,
    pub eds_defaults: Option<Name>,
}

#[derive(Debug)]
pub(crate) struct FileDecl {
    pub description: Option<Name>,
    pub created: Option<Spanned<DateTime>>,
    pub created_by: Option<Name>,
    pub modified: Option<Spanned<DateTime>>,
    pub modified_by: Option<Name>,
    pub version: Option<Spanned<i128>>,
    pub revision: Option<Spanned<i128>>,
}

#[derive(Debug)]
pub(crate) struct UnitDecl {
    pub name: Name,
    pub symbol: Option<Name>,
    pub scale: Option<Spanned<Ratio>>,
    pub base: Option<Spanned<(Ratio, String)>>,
    pub formula: Option<Spanned<Expr>>,
    pub about: Words,
}

#[derive(Debug)]
pub(crate) struct TypeDecl {
    /// A key of the type or of its bits was refused.
    pub unsure: bool,
    pub name: Name,
    pub base: Option<Name>,
    pub about: Words,
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
}

#[derive(Debug)]
pub(crate) struct BitDecl {
    pub bits: Spanned<(u8, u8)>,
    pub usage: BitUsage,
    pub name: Option<Name>,
    pub about: Words,
    pub errors: Vec<Spanned<i128>>,
    pub clamp: Option<Name>,
    pub active: Option<Spanned<i128>>,
    pub edge: Option<Edge>,
    pub priority: Option<Name>,
    pub values: Vec<ValueDecl>,
    pub modes: Vec<(Name, Option<Name>, Words)>,
}

#[derive(Debug)]
pub(crate) struct FeatureDecl {
    pub name: Name,
    pub implied: bool,
    pub objects: Vec<Spanned<Index>>,
    pub needs: Vec<Name>,
}

#[derive(Debug, Clone)]
pub(crate) struct ObjectDecl {
    pub index: Spanned<Index>,
    pub on: Option<Vec<Name>>,
    pub from: Option<Name>,
    pub alias: Option<Name>,
    pub outside: Option<Spanned<Outside>>,
    pub rounding: Option<Spanned<Rounding>>,
    pub array: Option<ArrayDecl>,
    pub record: Option<RecordDecl>,
    pub sub0: Option<EntryDecl>,
    pub omit: Vec<Spanned<i128>>,
    pub entry: EntryDecl,
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

macro_rules! entry_decl {
    ($($field:ident: $type:ty = $fact:ident,)+) => {
        /// What is written about an entry, at the entry itself or at something it inherits from.
        #[derive(Debug, Clone)]
        pub(crate) struct EntryDecl {
            pub span: Span,
            /// Something here was refused: what seems to be missing may be meant by it.
            pub unsure: bool,
            $(pub $field: Option<Spanned<$type>>,)+
        }

        impl EntryDecl {
            /// Nothing written.
            pub(crate) const fn empty(span: Span) -> Self {
                Self { span, unsure: false, $($field: None,)+ }
            }

            /// What is written here, and where nothing is, what is written below.
            pub(crate) fn over(&self, below: &EntryDecl) -> EntryDecl {
                EntryDecl {
                    span: self.span,
                    unsure: self.unsure || below.unsure,
                    $($field: self.$field.clone().or_else(|| below.$field.clone()),)+
                }
            }

            /// Where each fact is written, and whether by the maker, whose file is `maker`.
            pub(crate) fn facts(&self, maker: FileId) -> Facts {
                let places = [$((Fact::$fact, self.$field.as_ref().map(|fact| fact.span)),)+];
                let stated = places.into_iter().filter_map(|(fact, span)| Some((fact, span?)));
                stated.map(|(fact, span)| (fact, Statement::written(span, maker))).collect()
            }

            /// The facts written here that differ from those below.
            pub(crate) fn differences(&self, below: &EntryDecl) -> Vec<Fact> {
                let mut facts = Vec::new();
                $(if self.$field.is_some() && self.$field != below.$field {
                    facts.push(Fact::$fact);
                })+
                facts
            }
        }
    };
}

entry_decl! {
    name: String = Name,
    type_name: String = Type,
    unit: String = Unit,
    access: AccessRight = Access,
    pdo: PdoMapping = Mapping,
    default: String = Default,
    min: String = LowLimit,
    max: String = HighLimit,
    special: Vec<SpecialDecl> = Special,
    stored: Storage = Storage,
    category: Category = Category,
    since: String = Since,
    writable_when: Expr = WriteCondition,
    bit_errors: Vec<BitErrorDecl> = BitErrors,
    capacity: i128 = Capacity,
    identifier: String = Identifier,
    eds: EdsDecl = Eds,
    about: Text = About,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SpecialDecl {
    pub value: Spanned<i128>,
    pub name: Option<Name>,
    pub about: Words,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BitErrorDecl {
    pub bits: Spanned<(u8, u8)>,
    pub codes: Vec<Spanned<i128>>,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct EdsDecl {
    pub default: Option<bool>,
    pub access: Option<Access>,
    pub no_write: bool,
    pub no_scan: bool,
}

#[derive(Debug)]
pub(crate) struct PdoDecl {
    pub direction: Direction,
    pub number: Spanned<u16>,
    pub span: Span,
    pub cob_id: Option<Name>,
    pub valid: Option<Spanned<bool>>,
    pub no_rtr: Option<Spanned<bool>>,
    pub transmission: Option<Spanned<i128>>,
    pub inhibit_time: Option<Spanned<i128>>,
    pub event_timer: Option<Spanned<i128>>,
    pub sync_start: Option<Spanned<i128>>,
    pub fixed: bool,
    pub capacity: Option<Spanned<i128>>,
    pub map: Vec<Name>,
    pub about: Words,
}

#[derive(Debug)]
pub(crate) struct ErrorDecl {
    pub codes: Spanned<(u16, u16)>,
    /// Something here was refused.
    pub unsure: bool,
    pub name: Option<Name>,
    pub from: Option<Name>,
    pub on: Option<Vec<Name>>,
    pub priority: Option<Name>,
    pub reaction: Words,
    pub about: Words,
}

#[derive(Debug, Clone)]
pub(crate) struct MachineDecl {
    pub name: Name,
    /// Something here was refused.
    pub unsure: bool,
    pub from: Option<Name>,
    pub on: Option<Vec<Name>>,
    pub status: Option<Name>,
    pub command: Option<Name>,
    pub states: Vec<(Name, Option<Spanned<BitPattern>>, Words)>,
    pub transitions: Vec<TransitionDecl>,
    pub commands: Vec<CommandDecl>,
}

#[derive(Debug, Clone)]
pub(crate) struct TransitionDecl {
    pub number: Spanned<i128>,
    pub from: Vec<Name>,
    pub to: Option<Name>,
    pub event: Words,
    pub action: Words,
}

#[derive(Debug, Clone)]
pub(crate) struct CommandDecl {
    pub name: Name,
    pub pattern: Option<Spanned<BitPattern>>,
    pub send: Option<Spanned<i128>>,
    pub transitions: Vec<Spanned<i128>>,
    pub about: Words,
}

#[derive(Debug)]
pub(crate) struct ConstraintDecl {
    pub name: Name,
    pub on: Option<Vec<Name>>,
    pub require: Option<Spanned<Expr>>,
    pub when: Option<Spanned<Expr>>,
    pub about: Words,
}

#[derive(Debug)]
pub(crate) struct ErratumDecl {
    pub at: Vec<Name>,
    pub on: Option<Vec<Name>>,
    pub kind: Option<Spanned<ErratumKind>>,
    pub place: Words,
    pub prints: Words,
    pub reads: Words,
    pub because: Words,
}

#[derive(Debug)]
pub(crate) struct SectionDecl {
    pub number: Option<Name>,
    pub title: Words,
    pub tables: Vec<TableDecl>,
}

#[derive(Debug)]
pub(crate) struct TableDecl {
    /// A key was refused.
    pub unsure: bool,
    pub span: Span,
    pub number: Option<Spanned<i128>>,
    pub title: Words,
    /// The keys that say what fills the table; exactly one is right.
    pub contents: Vec<Spanned<ContentDecl>>,
}

#[derive(Debug)]
pub(crate) enum ContentDecl {
    Overview(Vec<Spanned<Index>>),
    Objects(Vec<Spanned<Index>>),
    Bits(Name),
    Values(Name),
    Errors(Vec<Name>),
    Reactions(Vec<Name>),
    States(Name),
    Transitions(Name),
    Commands(Name),
    Ladder(Name),
    Pdos(Option<Name>, Option<Spanned<Direction>>),
    Rows(Vec<Text>, Vec<Spanned<Vec<Text>>>),
    Glossary,
    History,
}

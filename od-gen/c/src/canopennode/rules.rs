//! The rules of a device as rows: what the extension of each object asks before a value is written.

use std::collections::BTreeSet;

use od_gen::plan::{Plan, PlannedAlias, PlannedEntry, Pool};
use od_spec::model::{DataType, Dictionary, Direction, EntryId, Family, Index, PdoTarget, SubIndex};

use super::cell::Cell;
use super::objects::{Memory, Slot, StackObject};

/// "None" in a row's references.
pub(super) const NONE: u16 = u16::MAX;

/// Flags of a row.
pub(super) const LOCKED: u8 = 1;
pub(super) const LISTED: u8 = 2;

/// How a value lies in memory, by the numbers of the runtime's `OD_number_t`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Number {
    None,
    Boolean,
    Unsigned,
    Signed,
    UnsignedBytes,
    SignedBytes,
    Real,
    Visible,
    Unicode,
}

impl Number {
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::None => "OD_NUMBER_NONE",
            Self::Boolean => "OD_NUMBER_BOOLEAN",
            Self::Unsigned => "OD_NUMBER_UNSIGNED",
            Self::Signed => "OD_NUMBER_SIGNED",
            Self::UnsignedBytes => "OD_NUMBER_UNSIGNED_BYTES",
            Self::SignedBytes => "OD_NUMBER_SIGNED_BYTES",
            Self::Real => "OD_NUMBER_REAL",
            Self::Visible => "OD_NUMBER_VISIBLE",
            Self::Unicode => "OD_NUMBER_UNICODE",
        }
    }

    /// That of a data type.
    pub(super) fn of(data_type: DataType) -> Self {
        let is_whole = data_type.bits().is_some_and(|bits| matches!(bits, 8 | 16 | 32 | 64));
        match data_type.family() {
            Family::Boolean => Self::Boolean,
            Family::Unsigned if is_whole => Self::Unsigned,
            Family::Unsigned => Self::UnsignedBytes,
            Family::Signed if is_whole => Self::Signed,
            Family::Signed => Self::SignedBytes,
            Family::Real => Self::Real,
            Family::VisibleString => Self::Visible,
            Family::UnicodeString => Self::Unicode,
            Family::OctetString | Family::Time | Family::Domain => Self::None,
        }
    }
}

/// Bytes of a number; 0 for anything else.
pub(super) fn size(data_type: DataType) -> u8 {
    data_type.bits().and_then(|bits| u8::try_from(bits.div_ceil(8)).ok()).unwrap_or(0)
}

/// What is asked of an entry, or of elements that are alike.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Rule {
    pub number: Number,
    pub size: u8,
    pub flags: u8,
    pub limits: u16,
    pub values: u16,
    pub condition: u16,
    pub view: u16,
}

/// A rule and the sub-indices that it is about.
pub(super) struct RuleRow {
    pub first: u8,
    pub last: u8,
    pub rule: Rule,
}

/// An object that has an extension.
pub(super) struct RuledObject<'o, 'a> {
    pub object: &'o StackObject<'a>,
    pub rules: Vec<RuleRow>,
}

/// All rows of a device.
#[derive(Default)]
pub(super) struct Rules<'o, 'a> {
    pub objects: Vec<RuledObject<'o, 'a>>,
    pub limits: Pool<(i64, i64)>,
    pub values: Pool<Vec<i64>>,
    /// Positions in the plan's conditions.
    pub conditions: Pool<u16>,
    /// Positions in the plan's aliases.
    pub views: Vec<usize>,
    /// Entries that a TPDO can carry.
    pub transmitted: Vec<EntryId>,
    /// Objects with flags by which the application requests the TPDOs that map them.
    pub requestable: Vec<Index>,
    /// Entries with rules that are not kept, as the stack has the objects.
    pub left_to_stack: Vec<EntryId>,
}

/// Whether the stack puts an extension of its own before an object, which has then no other.
pub(super) const fn has_extension_of_stack(index: u16) -> bool {
    matches!(
        index,
        0x1003 | 0x1005 | 0x100C | 0x100D | 0x1010 | 0x1011 | 0x1012 | 0x1014..=0x1017 | 0x1019 | 0x1200..=0x13FF | 0x1400..=0x1BFF
    )
}

/// What TPDOs can carry.
enum Carried {
    /// What is mappable, as a mapping can be changed.
    Mappable,
    /// What is mapped.
    Only(BTreeSet<EntryId>),
}

impl Carried {
    fn by_tpdos(device: &Dictionary) -> Self {
        let mut mappings = device.objects.range(Index(0x1A00)..Index(0x1C00)).map(|(_, object)| object);
        if mappings.any(|mapping| mapping.entries.iter().any(|entry| entry.access.is_writable())) {
            return Self::Mappable;
        }
        let mapped =
            device.pdos.iter().filter(|pdo| pdo.direction == Direction::Transmit).flat_map(|pdo| &pdo.map);
        Self::Only(
            mapped
                .filter_map(|mapped| match mapped.target {
                    PdoTarget::Entry(id) => Some(id),
                    PdoTarget::Dummy(_) => None,
                })
                .collect(),
        )
    }

    fn include(&self, slot: &Slot<'_>) -> bool {
        slot.entry.pdo.allows(Direction::Transmit)
            && match self {
                Self::Mappable => true,
                Self::Only(mapped) => mapped.contains(&slot.id),
            }
    }
}

impl<'o, 'a> Rules<'o, 'a> {
    /// The first entry that can be written under a condition, by the row of the condition.
    pub(super) fn first_under(&self, condition: usize) -> Option<EntryId> {
        self.objects.iter().find_map(|RuledObject { object, rules }| {
            let row = rules.iter().find(|row| usize::from(row.rule.condition) == condition)?;
            Some(EntryId { index: object.object.index, sub: SubIndex(row.first) })
        })
    }

    pub(super) fn of(plan: &Plan<'_>, objects: &'o [StackObject<'a>]) -> Self {
        let mut rules = Self::default();
        let carried = Carried::by_tpdos(plan.device);
        for object in objects {
            let slots = object.slots();
            if has_extension_of_stack(object.object.index.0) {
                let restricted = slots.iter().filter(|slot| is_restricted(plan, slot)).map(|slot| slot.id);
                rules.left_to_stack.extend(restricted);
                continue;
            }
            let mut rows: Vec<RuleRow> = Vec::new();
            for slot in &slots {
                let Some(rule) = rules.rule(plan, slot) else { continue };
                let sub = slot.id.sub.0;
                match rows.last_mut() {
                    Some(row) if row.rule == rule && row.last + 1 == sub => row.last = sub,
                    _ => rows.push(RuleRow { first: sub, last: sub, rule }),
                }
            }
            // What lies nowhere is refused, until the application has an extension for it.
            let lies_nowhere = slots.iter().any(|slot| matches!(slot.memory, Memory::Stack));
            if !rows.is_empty() || lies_nowhere {
                rules.objects.push(RuledObject { object, rules: rows });
            }
            // The flags by which a TPDO is requested are those of an extension.
            let requests_tpdos = object.object.editor.as_ref().is_some_and(|notes| notes.requests_tpdos);
            let transmitted = slots.iter().filter(|slot| carried.include(slot));
            let before = rules.transmitted.len();
            rules.transmitted.extend(transmitted.map(|slot| slot.id));
            if requests_tpdos || rules.transmitted.len() > before {
                rules.requestable.push(object.object.index);
            }
        }
        rules
    }

    /// The rule of an entry, if anything is asked of it.
    fn rule(&mut self, plan: &Plan<'_>, slot: &Slot<'_>) -> Option<Rule> {
        let (row, planned) = planned(plan, slot.id)?;
        let view = plan.aliases.iter().position(|alias| alias.row == row);
        let is_shown = plan.aliases.iter().any(|alias| alias.target == row);
        if !slot.entry.access.is_writable() && view.is_none() && !is_shown {
            return None;
        }
        let attributes = plan.attributes.get(usize::from(planned.attributes))?;
        let number = Number::of(planned.entry.data_type);
        let limits = plan
            .limits
            .get(usize::from(attributes.limits))
            .map_or(NONE, |limits| self.limits.position(*limits));
        let values = plan
            .values
            .get(usize::from(attributes.values))
            .map_or(NONE, |values| self.values.position(values.clone()));
        let condition = match attributes.condition {
            NONE => NONE,
            condition => self.conditions.position(condition),
        };
        let view = view.map_or(NONE, |at| {
            self.views.push(at);
            u16::try_from(self.views.len() - 1).unwrap_or(NONE)
        });
        let flag = |flag: u8, is_set: bool| if is_set { flag } else { 0 };
        let flags = flag(LOCKED, attributes.flags.locked) | flag(LISTED, attributes.flags.only_values);
        let has_values_of_its_own = match Cell::of(slot.entry) {
            Some(Cell::Boolean | Cell::Characters(_) | Cell::WideCharacters(_)) => true,
            Some(Cell::Integer(_) | Cell::Real32 | Cell::Real64 | Cell::Bytes(_)) | None => false,
        };
        let asks = flags != 0
            || [limits, values, condition, view].iter().any(|row| *row != NONE)
            || has_values_of_its_own;
        asks.then_some(Rule {
            number,
            size: size(planned.entry.data_type),
            flags,
            limits,
            values,
            condition,
            view,
        })
    }

    /// The rows of views, in order.
    pub(super) fn aliases<'p>(&self, plan: &'p Plan<'_>) -> Vec<&'p PlannedAlias> {
        self.views.iter().filter_map(|at| plan.aliases.get(*at)).collect()
    }
}

/// The row and what is planned of an entry.
fn planned<'p, 'a>(plan: &'p Plan<'a>, id: EntryId) -> Option<(u16, &'p PlannedEntry<'a>)> {
    let row = plan.row(id)?;
    Some((row, plan.entry(row)?))
}

/// Whether the specification allows less than the type.
fn is_restricted(plan: &Plan<'_>, slot: &Slot<'_>) -> bool {
    let attributes =
        planned(plan, slot.id).and_then(|(_, planned)| plan.attributes.get(usize::from(planned.attributes)));
    slot.entry.access.is_writable()
        && attributes.is_some_and(|attributes| {
            attributes.flags.locked
                || attributes.flags.only_values
                || [attributes.limits, attributes.condition].iter().any(|row| *row != NONE)
        })
}

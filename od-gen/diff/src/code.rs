//! Which changes break firmware: what generated code calls an entry, and what its values are there, before and after.

use std::collections::BTreeMap;

use od_gen::plan::{Place as Lies, Plan, PlannedEntry, plan};
use od_gen::rust::{Rust, call};
use od_spec::diag::Diagnostics;
use od_spec::model::{Dictionary, EntryId, Fact, Index, System};

use super::change::{Change, Class, Consequence, Kind, Place};

/// The names of a device in generated code.
pub(super) struct Code {
    /// The dictionary's type.
    dictionary: String,
    entries: BTreeMap<EntryId, EntryCode>,
    /// The fields of each PDO, by the index of its mapping parameter.
    pdos: BTreeMap<Index, Vec<String>>,
}

/// An entry in generated code.
struct EntryCode {
    /// How it is read.
    call: Option<String>,
    /// Its names where entries of many objects are together.
    names: [String; 2],
    /// What its values are.
    values: [String; Part::ALL.len()],
}

impl Code {
    /// `None` where no code can be made, so that there is none to break.
    pub(super) fn of(system: &System, device: &Dictionary) -> Option<Self> {
        let mut diagnostics = Diagnostics::new();
        let plan = plan(system, device, &Rust, &mut diagnostics);
        if diagnostics.has_errors() {
            return None;
        }
        let entries = plan.entries.iter().map(|entry| (entry.id, EntryCode::of(&plan, entry))).collect();
        let fields = plan.pdos.iter().map(|pdo| {
            let names = pdo.fields.iter().map(|field| field.name.clone()).collect();
            (Index(pdo.pdo.mapping_index()), names)
        });
        let pdos = fields.collect();
        Some(Self { dictionary: plan.name, entries, pdos })
    }
}

impl EntryCode {
    fn of(plan: &Plan<'_>, entry: &PlannedEntry<'_>) -> Self {
        let kind = &entry.kind;
        let special = kind.special.and_then(|at| plan.specials.get(at)).map(|special| special.name.clone());
        let setter = match entry.place {
            Lies::Image(_) => "set",
            Lies::Alias if entry.entry.access.is_writable() => "set through another entry",
            Lies::Constant(_) | Lies::Alias | Lies::Application => "",
        };
        let values = Part::ALL.map(|part| match part {
            Part::Number => kind.data_type.name().to_owned(),
            Part::Type => kind.named.clone().unwrap_or_default(),
            Part::Unit => kind.unit.clone().unwrap_or_default(),
            Part::Special => special.clone().unwrap_or_default(),
            Part::Setter => setter.to_owned(),
        });
        let names = [entry.variant.clone(), entry.name.clone()];
        Self { call: call(plan, entry), names, values }
    }
}

/// What the value of an entry consists of in generated code.
#[derive(Clone, Copy)]
enum Part {
    /// The number.
    Number,
    /// The enum or bit field around it.
    Type,
    /// The unit around it.
    Unit,
    /// The special values in addition to it.
    Special,
    /// How code sets it, if it can.
    Setter,
}

impl Part {
    const ALL: [Self; 5] = [Self::Number, Self::Type, Self::Unit, Self::Special, Self::Setter];

    /// The facts that it follows from; those of a later row where none of an earlier one has changed.
    const fn causes(self) -> &'static [&'static [Fact]] {
        match self {
            Self::Number => &[&[Fact::Type], &[Fact::ObjectType]],
            Self::Type => &[&[Fact::Meaning]],
            // A number with a type of its own has no unit and no special values around it.
            Self::Unit => &[&[Fact::Unit], &[Fact::Type, Fact::Meaning]],
            Self::Special => &[&[Fact::Special], &[Fact::Type, Fact::Meaning]],
            Self::Setter => &[&[Fact::Alias], &[Fact::Access, Fact::Default]],
        }
    }

    const fn consequence(self) -> Consequence {
        Consequence::new(
            Class::Firmware,
            match self {
                Self::Number | Self::Type | Self::Unit | Self::Special => {
                    "generated code has another type for it"
                }
                Self::Setter => "generated code has no setter for it, or another one",
            },
        )
    }
}

/// Facts that names in generated code are made from.
const NAMES: &[&[Fact]] = &[&[Fact::Name, Fact::Identifier]];

const OTHER_NAME: Consequence = Consequence::new(Class::Firmware, "generated code has another name for it");
const NO_FIELD: Consequence = Consequence::new(Class::Firmware, "the PDO has lost a field in generated code");
const GONE: Consequence = Consequence::new(Class::Firmware, "it is gone from generated code");

/// Adds to each change what it breaks in firmware, and a change where several together do.
pub(super) fn judge(old: &Code, new: &Code, device: &str, changes: &mut Vec<Change>) {
    if old.dictionary != new.dictionary {
        let place = Place::Device;
        let change = Change::text(place, Fact::Identifier, &old.dictionary, &new.dictionary);
        changes.extend(change.map(|change| change.named(device).with([OTHER_NAME])));
    }
    for change in &mut *changes {
        let Some(index) = change.place.index() else { continue };
        let fields = |code: &Code| code.pdos.get(&index).cloned().unwrap_or_default();
        let now = fields(new);
        if change.fact == Fact::Map && fields(old).iter().any(|field| !now.contains(field)) {
            change.follows([NO_FIELD]);
        }
        if change.fact == Fact::Presence && change.kind() == Kind::Removed {
            change.follows([GONE]);
        }
    }
    for (id, before) in &old.entries {
        let Some(after) = new.entries.get(id) else { continue };
        let is_called_otherwise = before.call.is_some() && before.call != after.call;
        if is_called_otherwise || before.names != after.names {
            let calls = [&before.call, &after.call].map(|call| call.clone().unwrap_or_default());
            attribute(*id, NAMES, &OTHER_NAME, calls, changes);
        }
        let values = before.values.iter().zip(&after.values);
        for (part, (old, new)) in Part::ALL.into_iter().zip(values) {
            // A setter that comes breaks nothing.
            let is_new_setter = matches!(part, Part::Setter) && old.is_empty();
            if old == new || is_new_setter {
                continue;
            }
            attribute(*id, part.causes(), &part.consequence(), [old.clone(), new.clone()], changes);
        }
    }
}

/// Gives a consequence to the changes of an entry, or of its object, that can be the cause; where there is none, it is a
/// change of its own.
fn attribute(
    id: EntryId,
    causes: &[&[Fact]],
    consequence: &Consequence,
    [before, after]: [String; 2],
    changes: &mut Vec<Change>,
) {
    for place in [Place::entry(id), Place::Object(id.index)] {
        for facts in causes {
            let is_cause = |change: &&mut Change| change.place == place && facts.contains(&change.fact);
            let mut has_cause = false;
            for cause in changes.iter_mut().filter(is_cause) {
                cause.follows([consequence.clone()]);
                has_cause = true;
            }
            if has_cause {
                return;
            }
        }
    }
    let name = changes.iter().find(|change| change.place.index() == Some(id.index));
    let name = name.map(|change| change.name.split('.').next().unwrap_or_default().to_owned());
    let change = Change::text(Place::Object(id.index), Fact::Identifier, &before, &after);
    changes.extend(change.map(|change| change.named(name.unwrap_or_default()).with([consequence.clone()])));
}

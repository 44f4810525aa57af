//! The facts of an entry before and after.

use od_spec::model::{
    Access, Alias, BitErrors, EdsPolicy, Entry, EntryId, Expr, Fact, NamedType, SpecialValue, Unit, Value,
};

use super::change::{Change, Class, Place};
use super::scope::Scope;
use super::texts::{phrases, texts};
use super::words::{self, VALUES, WORDS};
use super::{rules, types};

/// An entry on both sides.
#[derive(Clone, Copy)]
pub(super) struct Pair<'a> {
    pub id: EntryId,
    pub old: &'a Entry,
    pub new: &'a Entry,
    /// Whether the object has sub-indices; if not, its own facts are said at the object.
    pub is_structured: bool,
    pub scope: Scope,
    pub language: &'a str,
}

impl Pair<'_> {
    fn place(&self) -> Place {
        if self.is_structured { Place::entry(self.id) } else { Place::Object(self.id.index) }
    }

    fn of(&self, fact: Fact, before: Option<String>, after: Option<String>) -> Option<Change> {
        Change::of(self.place(), fact, before, after)
    }

    fn text(&self, fact: Fact, before: impl Into<String>, after: impl Into<String>) -> Option<Change> {
        self.of(fact, Some(before.into()), Some(after.into()))
    }

    /// Everything that differs.
    pub(super) fn changes(&self) -> Vec<Change> {
        let mut changes: Vec<Change> = [
            self.name(),
            self.data_type(),
            self.capacity(),
            self.meaning(),
            self.unit(),
            self.access(),
            self.mapping(),
            self.default(),
            self.storage(),
            self.condition(),
            self.alias(),
            self.category(),
            self.since(),
            self.identifier(),
        ]
        .into_iter()
        .flatten()
        .collect();
        changes.extend(self.limits());
        changes.extend(self.special());
        changes.extend(self.bit_errors());
        for (fact, old, new) in [
            (Fact::Warning, &self.old.warning, &self.new.warning),
            (Fact::About, &self.old.about, &self.new.about),
        ] {
            changes.extend(texts(&self.place(), fact, old, new, self.language));
        }
        changes.extend(phrases(&self.place(), &self.old.search, &self.new.search, self.language));
        changes.extend(self.eds());
        changes
    }

    fn name(&self) -> Option<Change> {
        let (before, after) = (self.scope.name(&self.old.name), self.scope.name(&self.new.name));
        let consequences = rules::parameter_name(&before, &after);
        Some(self.text(Fact::Name, before, after)?.with(consequences))
    }

    fn data_type(&self) -> Option<Change> {
        let change = self.text(Fact::Type, self.old.data_type.name(), self.new.data_type.name())?;
        Some(change.with(rules::data_type()))
    }

    fn capacity(&self) -> Option<Change> {
        let (before, after) = (self.old.capacity, self.new.capacity);
        // Of a constant it follows from the value.
        let is_stated = |entry: &Entry| entry.access != Access::Const;
        if !is_stated(self.old) && !is_stated(self.new) {
            return None;
        }
        let bytes = |capacity: Option<u16>| capacity.map(|bytes| format!("{bytes} bytes"));
        let change = self.of(Fact::Capacity, bytes(before), bytes(after))?;
        Some(change.with(rules::capacity(self.scope, self.new, before, after)))
    }

    /// Another enum or bit field; what differs inside of one that stays is said once, at the type.
    fn meaning(&self) -> Option<Change> {
        let name = |named: Option<&NamedType>| named.map(|named| named.name.clone());
        let (before, after) = (self.old.named_type.as_deref(), self.new.named_type.as_deref());
        let change = self.of(Fact::Meaning, name(before), name(after))?;
        Some(change.with(types::replaced(before, after, self.new.access.is_writable())))
    }

    /// Another unit; what differs inside of one that stays is said once, at the unit.
    fn unit(&self) -> Option<Change> {
        let (before, after) = (self.old.unit.as_deref(), self.new.unit.as_deref());
        let name = |unit: Option<&Unit>| unit.map(|unit| unit.name.clone());
        if name(before) == name(after) {
            return None;
        }
        let described = |unit: Option<&Unit>| unit.map(words::unit);
        let (old, new) = match (described(before), described(after)) {
            // Two names for one unit.
            (old, new) if old == new => (name(before), name(after)),
            different => different,
        };
        Some(self.of(Fact::Unit, old, new)?.with(rules::unit(before, after)))
    }

    fn access(&self) -> Option<Change> {
        let (before, after) = (self.scope.access(self.old), self.scope.access(self.new));
        let shown = |entry: &Entry, (access, locked)| {
            let mut shown = entry.clone();
            (shown.access, shown.locked) = (access, locked);
            WORDS.access(&shown)
        };
        if before == after {
            return None;
        }
        // In an EDS `rw`, `rwr` and `rww` state the PDO mapping, which is a fact of its own.
        if !self.scope.is_everything() && before.0.is_writable() && after.0.is_writable() {
            let same_reading = before.0.is_readable() == after.0.is_readable();
            if same_reading && self.scope.mapping(self.old) != self.scope.mapping(self.new) {
                return None;
            }
        }
        let change = self.text(Fact::Access, shown(self.old, before), shown(self.new, after))?;
        Some(change.with(rules::access(before, after)))
    }

    fn mapping(&self) -> Option<Change> {
        let (before, after) = (self.scope.mapping(self.old), self.scope.mapping(self.new));
        let change = self.text(Fact::Mapping, WORDS.mapping(before), WORDS.mapping(after))?;
        Some(change.with(rules::mapping(before, after)))
    }

    fn default(&self) -> Option<Change> {
        let (before, after) = self.scope.defaults(self.old, self.new)?;
        let mut before_text = before.map(|value| words::value(self.id.index, self.old, value));
        let mut after_text = after.map(|value| words::value(self.id.index, self.new, value));
        if before_text == after_text {
            // The same words for two raw values.
            let raw = |value: &Value| match value.integer() {
                Some(raw) => raw.to_string(),
                None => format!("{value:?}"),
            };
            (before_text, after_text) = (before.map(raw), after.map(raw));
        }
        let raws = (before.and_then(Value::integer), after.and_then(Value::integer));
        let consequences =
            if self.is_rescaled(raws) { rules::rescaled() } else { rules::default(self.id, self.new) };
        Some(self.of(Fact::Default, before_text, after_text)?.with(consequences))
    }

    /// Whether two raw values are one physical value, in a unit of another scale.
    fn is_rescaled(&self, (before, after): (Option<i128>, Option<i128>)) -> bool {
        let amount = |entry: &Entry, raw: Option<i128>| {
            let unit = entry.unit.as_ref()?;
            Some((unit.base_symbol().to_owned(), unit.quantity(raw?)?))
        };
        before != after && amount(self.old, before).is_some_and(|old| Some(old) == amount(self.new, after))
    }

    fn limits(&self) -> Vec<Change> {
        let (old, new) = (self.scope.limits(self.old), self.scope.limits(self.new));
        let ends = |entry: &Entry| entry.data_type.range().unwrap_or((-i128::MAX, i128::MAX));
        let shown = |entry: &Entry, limit: &Option<Value>| {
            limit.as_ref().map(|limit| words::value(self.id.index, entry, limit))
        };
        let reach = |entry: &Entry, limit: &Option<Value>| match limit {
            Some(Value::Integer(raw)) => Some(*raw),
            Some(Value::Real(real)) => Some(real.order(entry.data_type).into()),
            Some(Value::NodeId(_) | Value::Text(_) | Value::Bytes(_)) | None => None,
        };
        let side = |fact, before: &Option<Value>, after: &Option<Value>, reach: (i128, i128)| {
            if before == after {
                return None;
            }
            let change = self.of(fact, shown(self.old, before), shown(self.new, after))?;
            Some(change.with(rules::limit(self.new, reach.0, reach.1)))
        };
        // Each side reaches as far as the limit or, without one, the data type; downwards that is the negative number.
        let (low_ends, high_ends) =
            ((ends(self.old).0, ends(self.new).0), (ends(self.old).1, ends(self.new).1));
        let low_reach =
            (-reach(self.old, &old.0).unwrap_or(low_ends.0), -reach(self.new, &new.0).unwrap_or(low_ends.1));
        let high_reach =
            (reach(self.old, &old.1).unwrap_or(high_ends.0), reach(self.new, &new.1).unwrap_or(high_ends.1));
        [side(Fact::LowLimit, &old.0, &new.0, low_reach), side(Fact::HighLimit, &old.1, &new.1, high_reach)]
            .into_iter()
            .flatten()
            .collect()
    }

    fn special(&self) -> Vec<Change> {
        let (old, new) = (&self.old.special, &self.new.special);
        let mut raws: Vec<i128> = old.iter().chain(new).map(|special| special.value).collect();
        raws.sort_unstable();
        raws.dedup();
        let find = |list: &[SpecialValue], raw| list.iter().find(|special| special.value == raw).cloned();
        let mut changes = Vec::new();
        for raw in raws {
            let (before, after) = (find(old, raw), find(new, raw));
            let part = format!("special value {}", VALUES.special_number(self.new, raw));
            let names = [&before, &after].map(|one| one.as_ref().map(|special| special.name.clone()));
            let [old_name, new_name] = names;
            if let Some(change) = self.of(Fact::Special, old_name, new_name) {
                let consequences = match (&before, &after) {
                    (Some(before), Some(after)) => rules::special_renamed(old, &before.name, &after.name),
                    (None, _) => rules::special_added(self.old, raw),
                    (_, None) => rules::special_removed(),
                };
                changes.push(change.part(part.clone()).with(consequences));
            }
            if let (Some(before), Some(after)) = (&before, &after) {
                let about = texts(&self.place(), Fact::About, &before.about, &after.about, self.language);
                changes.extend(about.into_iter().map(|change| change.part(part.clone())));
            }
        }
        changes
    }

    fn storage(&self) -> Option<Change> {
        let change =
            self.text(Fact::Storage, WORDS.storage(self.old.stored), WORDS.storage(self.new.stored))?;
        Some(change.with(rules::storage()))
    }

    fn condition(&self) -> Option<Change> {
        let (before, after) = (self.old.writable_when.as_ref(), self.new.writable_when.as_ref());
        let meaning = |condition: Option<&Expr>| condition.map(|one| one.alternatives.clone());
        if meaning(before) == meaning(after) {
            return None;
        }
        let text = |condition: Option<&Expr>| condition.map(|one| one.text.clone());
        Some(
            self.of(Fact::WriteCondition, text(before), text(after))?.with(rules::condition(after.is_some())),
        )
    }

    fn alias(&self) -> Option<Change> {
        let shown = |alias: Option<&Alias>| {
            alias.map(|alias| {
                let rounding = alias.rounding.word();
                let outside = alias.outside.word();
                format!("{} × {}, rounding {rounding}, outside {outside}", alias.target, alias.factor)
            })
        };
        let (before, after) = (self.old.alias.as_ref(), self.new.alias.as_ref());
        Some(self.of(Fact::Alias, shown(before), shown(after))?.with(rules::alias(before, after)))
    }

    fn category(&self) -> Option<Change> {
        let word = |entry: &Entry| entry.category.map(|category| WORDS.category(category).to_owned());
        let change = self.of(Fact::Category, word(self.old), word(self.new))?;
        Some(change.so(Class::Documents, "the device has it either way"))
    }

    fn since(&self) -> Option<Change> {
        let change = self.of(Fact::Since, self.old.since.clone(), self.new.since.clone())?;
        Some(change.so(Class::Documents, "a remark about the manual"))
    }

    fn identifier(&self) -> Option<Change> {
        let change = self.of(Fact::Identifier, self.old.identifier.clone(), self.new.identifier.clone())?;
        Some(change.so(Class::Documents, "generated code has the same names"))
    }

    fn bit_errors(&self) -> Vec<Change> {
        let codes = |list: &[BitErrors], bit: u8| {
            let errors = list.iter().find(|errors| errors.bit == bit)?;
            Some(errors.error_codes().map(|code| format!("{code:04X}h")).collect::<Vec<_>>().join(", "))
        };
        let (old, new) = (&self.old.bit_errors, &self.new.bit_errors);
        let mut bits: Vec<u8> = old.iter().chain(new).map(|errors| errors.bit).collect();
        bits.sort_unstable();
        bits.dedup();
        let changes = bits.into_iter().filter_map(|bit| {
            let change = self.of(Fact::BitErrors, codes(old, bit), codes(new, bit))?;
            Some(change.part(format!("bit {bit}")).so(Class::Documents, "bit and code keep their meanings"))
        });
        changes.collect()
    }

    /// What the EDS shows, where that does not follow from other changes of the entry.
    fn eds(&self) -> Option<Change> {
        let (before, mut after) = (self.old.eds, self.new.eds);
        let rights = |entry: &Entry| (entry.access, entry.locked, entry.pdo);
        if rights(self.old) != rights(self.new) || !self.scope.is_everything() {
            after.access = before.access;
        }
        let protection = |entry: &Entry| (rights(entry), entry.stored, entry.alias.is_some());
        if protection(self.old) != protection(self.new)
            || !self.scope.is_everything()
            || (self.old.default.is_none() && self.new.default.is_none())
        {
            after.default = before.default;
        }
        if self.old.locked != self.new.locked {
            after.no_write = before.no_write;
        }
        let shown = |policy: EdsPolicy| {
            let default = if policy.default { "written" } else { "withheld" };
            format!("access {}, default {default}, flags {}", policy.access.word(), policy.flags())
        };
        Some(self.text(Fact::Eds, shown(before), shown(after))?.with(rules::eds(before, after)))
    }
}

//! Values between which there are conditions are written in an order in which a device takes each of them: the conditions of a
//! write hold when it comes, and no constraint breaks in between.

use std::collections::{BTreeMap, VecDeque};

use super::{Constraint, Dictionary, EntryId, Expr, Held, Outcome, Ratio, System, Value};

/// Values that no order brings into the device.
pub(crate) struct Stuck {
    /// What can be written, in this order.
    pub ordered: Vec<EntryId>,
    /// What cannot be written after it, in the order in which it was given.
    pub left: Vec<EntryId>,
}

/// A device in the course of a download.
pub(crate) struct Course<'a> {
    system: &'a System,
    device: &'a Dictionary,
    node: u8,
    /// The constraints that the device keeps by itself.
    constraints: Vec<&'a Constraint>,
    /// What was written.
    written: BTreeMap<EntryId, i128>,
}

impl<'a> Course<'a> {
    /// A device with its defaults.
    pub(crate) fn new(system: &'a System, device: &'a Dictionary, node: u8) -> Self {
        let is_own = |condition: &Expr| {
            condition.entries().iter().all(|entry| entry.device.as_ref().is_none_or(|key| *key == device.key))
        };
        let constraints = system.constraints.iter().filter(|constraint| {
            constraint.seen_from.contains(&device.key)
                && is_own(&constraint.require)
                && constraint.when.as_ref().is_none_or(is_own)
        });
        Self { system, device, node, constraints: constraints.collect(), written: BTreeMap::new() }
    }

    /// The writes in an order in which each is taken; of those that are, the first comes first.
    ///
    /// # Errors
    /// There is no such order.
    pub(crate) fn order<'v>(
        mut self,
        values: impl IntoIterator<Item = (EntryId, &'v Value)>,
    ) -> Result<Vec<EntryId>, Stuck> {
        let mut left: VecDeque<(EntryId, &Value)> = values.into_iter().collect();
        let mut ordered = Vec::with_capacity(left.len());
        while let Some(at) = left.iter().position(|(id, value)| self.takes(*id, value)) {
            let Some((id, value)) = left.remove(at) else { break };
            if let Some((holder, raw)) = self.holder(id, value) {
                self.written.insert(holder, raw);
            }
            ordered.push(id);
        }
        if left.is_empty() {
            Ok(ordered)
        } else {
            Err(Stuck { ordered, left: left.into_iter().map(|(id, _)| id).collect() })
        }
    }

    /// The entry that holds what is written, and the raw value that it gets.
    fn holder(&self, id: EntryId, value: &Value) -> Option<(EntryId, i128)> {
        let raw = value.integer_for(self.node)?;
        match self.device.entry(id)?.alias.as_ref() {
            Some(alias) => Some((alias.target, Ratio::whole(raw).checked_div(alias.factor)?.to_whole()?)),
            None => Some((id, raw)),
        }
    }

    fn takes(&self, id: EntryId, value: &Value) -> bool {
        let before = self.held(&self.written);
        let target = self.device.entry(id).and_then(|entry| entry.alias.as_ref()).map(|alias| alias.target);
        let is_writable = |id: EntryId| {
            let condition = self.device.entry(id).and_then(|entry| entry.writable_when.as_ref());
            condition.is_none_or(|condition| !fails(condition, before))
        };
        if ![Some(id), target].into_iter().flatten().all(is_writable) {
            return false;
        }
        let Some((holder, raw)) = self.holder(id, value) else { return true };
        let concerned: Vec<&Constraint> =
            self.constraints.iter().copied().filter(|constraint| self.names(constraint, holder)).collect();
        if concerned.is_empty() {
            return true;
        }
        let mut written = self.written.clone();
        written.insert(holder, raw);
        let after = self.held(&written);
        concerned.iter().all(|constraint| is_broken(constraint, before) || !is_broken(constraint, after))
    }

    /// Whether a constraint asks for an entry, or for a view of it.
    fn names(&self, constraint: &Constraint, holder: EntryId) -> bool {
        let shows = |id: EntryId| {
            let alias = self.device.entry(id).and_then(|entry| entry.alias.as_ref());
            id == holder || alias.is_some_and(|alias| alias.target == holder)
        };
        let conditions = [Some(&constraint.require), constraint.when.as_ref()];
        conditions
            .into_iter()
            .flatten()
            .any(|condition| condition.entries().iter().any(|entry| shows(entry.id)))
    }

    const fn held<'h>(&'h self, written: &'h BTreeMap<EntryId, i128>) -> Held<'h> {
        Held { system: self.system, device: self.device, node: Some(self.node), written }
    }
}

fn fails(condition: &Expr, held: Held<'_>) -> bool {
    matches!(condition.evaluate(&held), Outcome::Fails { .. })
}

fn is_broken(constraint: &Constraint, held: Held<'_>) -> bool {
    let counts = constraint.when.as_ref().is_none_or(|when| when.evaluate(&held) == Outcome::Holds);
    counts && fails(&constraint.require, held)
}

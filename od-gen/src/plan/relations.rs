//! What entries are together: PDOs, state machines, error codes and constraints.

use std::collections::BTreeMap;

use od_spec::diag::Diagnostics;
use od_spec::expr::Expr;
use od_spec::model::{DataType, EntryId, Index, Pdo, PdoTarget, StateMachine, SubIndex, SystemSource, Value};
use od_spec::source::Span;

use super::condition::{self, Unusable};
use super::language::{Role, ScopeKind};
use super::layout::Place;
use super::names::Scope;
use super::{
    Plan, PlannedConstraint, PlannedError, PlannedField, PlannedMachine, PlannedPdo, ServedPdo, too_large,
};

impl Plan<'_> {
    pub(super) fn pdos(&mut self, diagnostics: &mut Diagnostics) {
        for pdo in &self.device.pdos {
            let name = self.identifier(
                ScopeKind::Dictionary,
                Role::Type,
                &format!("{}{}", pdo.direction.pdo(), pdo.number),
            );
            let mut fields = Vec::new();
            let mut scope = Scope::default();
            for field in pdo.fields() {
                if let PdoTarget::Entry(id) = field.mapped.target
                    && let Some(row) = self.row(id)
                    && let Some(entry) = self.entry(row)
                {
                    let field_name = self.field_name(&entry.name, &fields);
                    scope.claim(&field_name, &format!("{id} in {name}"), pdo.span, diagnostics);
                    let (first_bit, bits) = (field.first_bit, field.mapped.bits);
                    fields.push(PlannedField { name: field_name, row, first_bit, bits });
                }
            }
            let served = self.served(pdo, &fields);
            self.pdos.push(PlannedPdo { pdo, name, fields, bits: pdo.bits(), served });
        }
    }

    /// The name of a mapped entry among those before it. A PDO of an EDS may map an entry twice; the second one has a number.
    fn field_name(&self, entry: &str, before: &[PlannedField]) -> String {
        let is_free = |name: &String| before.iter().all(|field| field.name != *name);
        match self.system.source {
            SystemSource::Specification => entry.to_owned(),
            SystemSource::Eds => [entry.to_owned()]
                .into_iter()
                .chain(
                    (2..=before.len() + 1)
                        .map(|n| self.identifier(ScopeKind::PdoFields, Role::Field, &format!("{entry} {n}"))),
                )
                .find(is_free)
                .unwrap_or_else(|| entry.to_owned()),
        }
    }

    /// The rows of a PDO's parameters, if these are of the types that CiA 301 gives them, and without a gap.
    fn served(&self, pdo: &Pdo, fields: &[PlannedField]) -> Option<ServedPdo> {
        let row = |index: u16, sub: u8, data_type: DataType| {
            let row = self.row(EntryId { index: Index(index), sub: SubIndex(sub) })?;
            let planned = self.entry(row)?;
            (planned.entry.data_type == data_type && planned.entry.alias.is_none()).then_some(row)
        };
        let cob_id = row(pdo.communication_index(), 1, DataType::Unsigned32)?;
        let mapping = row(pdo.mapping_index(), 0, DataType::Unsigned8)?;
        for sub in 1..=pdo.capacity {
            let parameter = row(pdo.mapping_index(), sub, DataType::Unsigned32)?;
            if parameter != mapping.checked_add(sub.into())? {
                return None;
            }
        }
        // Placeholders are not rows; a mapping with any of them is searched, and so is one that does not lie in one
        // piece, or that an EDS states wrongly.
        let count = self.entry(mapping)?.entry.default.as_ref().and_then(Value::integer);
        let known = fields.len() == pdo.map.len()
            && fields.len() <= 64
            && count == i128::try_from(fields.len()).ok()
            && fields.iter().all(|field| self.has_width(field))
            && self.lies_in_one_piece(mapping, fields.len());
        let rows = fields.iter().filter(|_| known).map(|field| field.row).collect();
        Some(ServedPdo { cob_id, mapping, rows })
    }

    /// Whether a field is as wide as its entry.
    fn has_width(&self, field: &PlannedField) -> bool {
        let attributes =
            self.entry(field.row).and_then(|planned| self.attributes.get(usize::from(planned.attributes)));
        attributes.is_some_and(|entry| match entry.data_type {
            DataType::Boolean => field.bits == 1,
            _ => usize::from(field.bits) == entry.size * 8,
        })
    }

    /// Whether the mapping parameters after a number of mapped entries are all constants, or lie in the image one after
    /// the other.
    fn lies_in_one_piece(&self, number: u16, mapped: usize) -> bool {
        let places: Vec<Place> =
            self.entries.iter().skip(usize::from(number) + 1).take(mapped).map(|entry| entry.place).collect();
        places.windows(2).all(|two| match two {
            [Place::Image(one), Place::Image(next)] => *next == one + 4,
            [Place::Constant(_), Place::Constant(_)] => true,
            _ => false,
        })
    }

    pub(super) fn machines(&mut self, diagnostics: &mut Diagnostics) {
        let (system, device) = (self.system, self.device);
        let mut scope = Scope::default();
        for machine in system.machines.values().filter(|machine| machine.devices.includes(&device.key)) {
            let (Some(status), Some(command)) = (self.row(machine.status), self.row(machine.command)) else {
                continue;
            };
            let name = self.identifier(ScopeKind::Machines, Role::Type, &machine.name);
            let what = format!("state machine `{}`", machine.name);
            scope.claim(&name, &what, self.place(machine.span), diagnostics);
            let states = machine.states.iter().map(|state| (state.name.as_str(), state.span));
            let states = self.machine_variants(machine, "state", states, diagnostics);
            let commands = machine.commands.iter().map(|command| (command.name.as_str(), command.span));
            let commands = self.machine_variants(machine, "command", commands, diagnostics);
            self.machines.push(PlannedMachine { machine, name, status, command, states, commands });
        }
    }

    /// Identifiers of the states or commands of a machine.
    fn machine_variants<'n>(
        &self,
        machine: &StateMachine,
        what: &str,
        names: impl Iterator<Item = (&'n str, Span)>,
        diagnostics: &mut Diagnostics,
    ) -> Vec<String> {
        let mut scope = Scope::default();
        let identifiers = names.map(|(name, span)| {
            let identifier = self.identifier(ScopeKind::MachineVariants, Role::Variant, name);
            let what = format!("{what} `{name}` of `{}`", machine.name);
            scope.claim(&identifier, &what, self.place(span), diagnostics);
            identifier
        });
        identifiers.collect()
    }

    pub(super) fn errors(&mut self, diagnostics: &mut Diagnostics) {
        let (system, device) = (self.system, self.device);
        let (mut scope, mut variants) = (Scope::default(), Scope::default());
        for error in &system.errors {
            if error.devices.includes(&device.key) {
                let name = self.identifier(ScopeKind::Errors, Role::Constant, &error.name);
                let (what, place) = (format!("error {:04X}h", error.code), self.place(error.span));
                let variant = self.identifier(ScopeKind::Errors, Role::Variant, &error.name);
                if scope.claim(&name, &what, place, diagnostics) {
                    variants.claim(&variant, &what, place, diagnostics);
                }
                self.errors.push(PlannedError { name, variant, error });
            }
        }
        let treated = self.errors.iter().filter(|planned| planned.error.treated_by.includes(&device.key));
        let mut priorities: BTreeMap<&String, Span> = BTreeMap::new();
        for planned in treated {
            if let Some(priority) = &planned.error.priority {
                priorities.entry(priority).or_insert(planned.error.span);
            }
        }
        let mut scope = Scope::default();
        let priorities = priorities.into_iter().map(|(priority, span)| {
            let variant = self.identifier(ScopeKind::Errors, Role::Variant, priority);
            scope.claim(&variant, &format!("priority `{priority}`"), self.place(span), diagnostics);
            (variant, priority.clone())
        });
        self.priorities = priorities.collect();
    }

    pub(super) fn plan_constraints(&mut self, diagnostics: &mut Diagnostics) {
        let (system, device) = (self.system, self.device);
        let mut scope = Scope::default();
        for constraint in
            system.constraints.iter().filter(|constraint| constraint.devices.includes(&device.key))
        {
            let planned = |expr| condition::plan(expr, device);
            let foreign = |expr: &Expr| {
                expr.entries().iter().any(|entry| {
                    entry.device.as_ref().is_some_and(|key| *key != device.key)
                        || device.entry(entry.id).is_none()
                })
            };
            // Whether the condition counts at all cannot be decided here.
            if constraint.when.as_ref().is_some_and(foreign) {
                continue;
            }
            let when = constraint.when.as_ref().map(planned).transpose();
            let (when, require) = match (when, planned(&constraint.require)) {
                (Ok(when), Ok(require)) => (when, require),
                (Err(Unusable::Elsewhere), _) | (_, Err(Unusable::Elsewhere)) => continue,
                (Err(Unusable::TooLarge), _) | (_, Err(Unusable::TooLarge)) => {
                    diagnostics
                        .push(too_large(constraint.span, &format!("constraint `{}`", constraint.name)));
                    continue;
                }
            };
            let function = self.identifier(ScopeKind::Constraints, Role::Function, &constraint.name);
            scope.claim(
                &function,
                &format!("constraint `{}`", constraint.name),
                constraint.span,
                diagnostics,
            );
            self.constraints.push(PlannedConstraint {
                name: &constraint.name,
                function,
                about: &constraint.about,
                when,
                require,
                partial: foreign(&constraint.require),
            });
        }
    }
}

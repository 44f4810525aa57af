//! What entries are together: PDOs, state machines, error codes and constraints.

use od_spec::diag::Diagnostics;
use od_spec::expr::Expr;
use od_spec::model::{Direction, PdoTarget};

use super::{Plan, PlannedConstraint, PlannedField, PlannedMachine, PlannedPdo, too_large};
use crate::rust::condition::{self, Unusable};
use crate::rust::names::{Scope, camel, screaming, snake};

impl Plan<'_> {
    pub(super) fn pdos(&mut self, diagnostics: &mut Diagnostics) {
        for pdo in &self.device.pdos {
            let name = format!(
                "{}{}",
                if pdo.direction == Direction::Receive { "Rpdo" } else { "Tpdo" },
                pdo.number
            );
            let mut fields = Vec::new();
            let mut scope = Scope::default();
            for field in pdo.fields() {
                if let PdoTarget::Entry(id) = field.mapped.target
                    && let Some(row) = self.row(id)
                    && let Some(entry) = self.entry(row)
                {
                    scope.claim(&entry.name, &format!("{id} in {name}"), pdo.span, diagnostics);
                    let (first_bit, bits) = (field.first_bit, field.mapped.bits);
                    fields.push(PlannedField { name: entry.name.clone(), row, first_bit, bits });
                }
            }
            self.pdos.push(PlannedPdo { pdo, name, fields, bits: pdo.bits() });
        }
    }

    pub(super) fn machines(&mut self, diagnostics: &mut Diagnostics) {
        let (system, device) = (self.system, self.device);
        let mut scope = Scope::default();
        for machine in system.machines.values().filter(|machine| machine.devices.includes(&device.key)) {
            let (Some(status), Some(command)) = (self.row(machine.status), self.row(machine.command)) else {
                continue;
            };
            let name = camel(&machine.name);
            scope.claim(&name, &format!("state machine `{}`", machine.name), device.span, diagnostics);
            let mut named = |names: Vec<&str>, what: &str| -> Vec<String> {
                let mut own = Scope::default();
                let names = names.into_iter().map(|text| {
                    let name = camel(text);
                    own.claim(
                        &name,
                        &format!("{what} `{text}` of `{}`", machine.name),
                        device.span,
                        diagnostics,
                    );
                    name
                });
                names.collect()
            };
            let states = named(machine.states.iter().map(|state| state.name.as_str()).collect(), "state");
            let commands =
                named(machine.commands.iter().map(|command| command.name.as_str()).collect(), "command");
            self.machines.push(PlannedMachine { machine, name, status, command, states, commands });
        }
    }

    pub(super) fn errors(&mut self, diagnostics: &mut Diagnostics) {
        let (system, device) = (self.system, self.device);
        let mut scope = Scope::default();
        for error in &system.errors {
            if error.devices.includes(&device.key) {
                let name = screaming(&error.name);
                scope.claim(&name, &format!("error {:04X}h", error.code), device.span, diagnostics);
                self.errors.push((name, error));
            }
        }
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
            // Whether the condition counts at all cannot be told from here.
            if constraint.when.as_ref().is_some_and(foreign) {
                continue;
            }
            let when = constraint.when.as_ref().map(planned).transpose();
            let (when, require) = match (when, planned(&constraint.require)) {
                (Ok(when), Ok(require)) => (when, require),
                (Err(Unusable::Elsewhere), _) | (_, Err(Unusable::Elsewhere)) => continue,
                _ => {
                    diagnostics
                        .push(too_large(constraint.span, &format!("constraint `{}`", constraint.name)));
                    continue;
                }
            };
            let function = snake(&constraint.name);
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

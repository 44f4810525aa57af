//! What is found on many nodes is said once: at its place, with the first node it is about and how many more there are.

use std::collections::BTreeMap;

use super::rules::{self, Check};
use super::{Bus, Plant, Settled};
use crate::diag::{Code, Diagnostic, Diagnostics, Label};
use crate::source::Span;

/// What makes two findings one: the code, the places, and of a single place the words.
type Key = (&'static Code, Vec<(Span, String)>, String);

/// Findings that may be about many nodes or machines.
#[derive(Default)]
struct Said {
    /// Position of each finding in the list.
    known: BTreeMap<Key, usize>,
    /// Each with the node or machine that it is about first, and how many there are.
    list: Vec<(Diagnostic, String, usize)>,
}

impl Said {
    fn push(&mut self, diagnostic: &Diagnostic, about: String, count: usize) {
        let labels =
            diagnostic.labels.iter().map(|Label { span, text }| (*span, text.clone())).collect::<Vec<_>>();
        // A condition between devices is broken for each of them: where the places are the same, it is one finding.
        let words = if labels.len() > 1 { String::new() } else { diagnostic.message.clone() };
        let key = (diagnostic.code, labels, words);
        let next = self.list.len();
        let at = *self.known.entry(key).or_insert(next);
        match self.list.get_mut(at) {
            Some((.., more)) => *more += count,
            None => self.list.push((diagnostic.clone(), about, count)),
        }
    }

    /// The findings; `things` is what they are counted in.
    fn into_diagnostics(self, things: [&str; 2], diagnostics: &mut Diagnostics) {
        for (diagnostic, about, count) in self.list {
            let note = match count - 1 {
                0 => format!("on {about}"),
                more => format!("on {about}, and {more} more {}", things[usize::from(more > 1)]),
            };
            diagnostics.push(diagnostic.note(note));
        }
    }
}

impl Plant {
    /// Everything that is wrong with the values and on the buses, of a plant whose classes are settled, in their order. What
    /// is found on many nodes is said once.
    pub fn check(&self, settled: &[Settled]) -> Diagnostics {
        let mut diagnostics = Diagnostics::new();
        let mut of_nodes = Said::default();
        for (class, settled) in self.classes.iter().zip(settled) {
            let about = self.nodes.get(class.first).map(|node| self.name_of(node)).unwrap_or_default();
            for diagnostic in &settled.diagnostics {
                of_nodes.push(diagnostic, about.clone(), class.count);
            }
        }
        of_nodes.into_diagnostics(["node", "nodes"], &mut diagnostics);
        let mut of_buses = Said::default();
        for kind in &self.buses {
            let Some(bus) = Bus::of(self, settled, kind.first) else { continue };
            let machine = self.machines.get(kind.first);
            let about = machine.map(|machine| format!("{} {}", self.site_of(machine), machine.name));
            let about = about.unwrap_or_default();
            for rule in rules::RULES {
                let Check::Bus(check) = rule.check else { continue };
                let mut found = Diagnostics::new();
                check(&bus, &mut found);
                // What several nodes inherit is one thing on a machine.
                found.sort();
                for diagnostic in &found {
                    of_buses.push(diagnostic, about.clone(), kind.count);
                }
            }
        }
        of_buses.into_diagnostics(["machine", "machines"], &mut diagnostics);
        for rule in rules::RULES {
            if let Check::Plant(check) = rule.check {
                check(self, &mut diagnostics);
            }
        }
        diagnostics.sort();
        diagnostics
    }
}

//! Objects and entries that one identifier would name are distinguished by their index and sub-index.

use std::collections::{BTreeMap, BTreeSet};

use od_spec::model::{Dictionary, EntryId, Index, Object, ObjectKind};

use crate::plan::language::{Companion, Language, Role, ScopeKind};
use crate::plan::names::Words;

/// How much of its own name something keeps; the next step is taken where two still clash.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Step {
    /// Its name, and after it the index or sub-index: `speed_2000`.
    Numbered,
    /// Nothing but its index or sub-index: `object_2000`.
    NumberOnly,
}

/// What has a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Named {
    Object(Index),
    /// An entry of an ARRAY or RECORD.
    Entry(EntryId),
}

/// A scope; of the members of a group there is one for each object.
type ScopeOf = (ScopeKind, Option<Index>);

/// Gives an identifier to every object and entry that would share one. Which of them gets which depends on no order.
pub(super) fn tell_apart(device: &mut Dictionary, language: &dyn Language) {
    let mut steps = BTreeMap::new();
    // Each round takes at least one step, and nothing can take more than two.
    loop {
        let mut clashes = Claims::of_objects(device, language).clashing;
        if clashes.is_empty() {
            clashes = Claims::of_entries(device, language).clashing;
        }
        let mut changed = false;
        for named in clashes {
            let next = match steps.get(&named) {
                None if has_words(device, named) => Step::Numbered,
                None | Some(Step::Numbered) => Step::NumberOnly,
                Some(Step::NumberOnly) => continue,
            };
            steps.insert(named, next);
            rename(device, named, next);
            changed = true;
        }
        if !changed {
            return;
        }
    }
}

/// Whether a name has a letter or digit that an identifier could have.
fn has_words(device: &Dictionary, named: Named) -> bool {
    let name = match named {
        Named::Object(index) => device.objects.get(&index).map(|object| object.name.as_str()),
        Named::Entry(id) => device.entry(id).map(|entry| entry.name.as_str()),
    };
    name.is_some_and(|name| !Words::of(name).snake().is_empty())
}

fn rename(device: &mut Dictionary, named: Named, step: Step) {
    match named {
        Named::Object(index) => {
            let Some(object) = device.objects.get_mut(&index) else { return };
            let identifier = match step {
                Step::Numbered => format!("{} {:04X}", object.name, index.0),
                Step::NumberOnly => format!("object {:04X}", index.0),
            };
            // The entry of a VAR is called like its object.
            if let (ObjectKind::Var | ObjectKind::Domain, [only]) =
                (object.kind, object.entries.as_mut_slice())
            {
                only.identifier = Some(identifier.clone());
            }
            object.identifier = Some(identifier);
        }
        Named::Entry(id) => {
            let object = device.objects.get_mut(&id.index);
            let entry = object.and_then(|object| object.entries.iter_mut().find(|entry| entry.sub == id.sub));
            let Some(entry) = entry else { return };
            entry.identifier = Some(match step {
                Step::Numbered => format!("{} {}", entry.name, id.sub),
                Step::NumberOnly => format!("sub {}", id.sub),
            });
        }
    }
}

/// Who asks for which identifier.
#[derive(Default)]
struct Claims {
    taken: BTreeMap<(ScopeOf, String), Named>,
    clashing: BTreeSet<Named>,
}

impl Claims {
    /// What the accessors of objects and the types of groups are called, with everything that may be printed with them.
    fn of_objects(device: &Dictionary, language: &dyn Language) -> Self {
        let mut claims = Self::default();
        for object in device.objects.values() {
            let words = Words::of(object.label());
            let named = Named::Object(object.index);
            let accessors = (ScopeKind::Accessors, None);
            let mut functions =
                vec![(named, language.identifier(ScopeKind::Accessors, Role::Function, &words))];
            if object.is_structured() {
                claims.claim(
                    (ScopeKind::Groups, None),
                    language.identifier(ScopeKind::Groups, Role::Type, &words),
                    named,
                );
                functions.extend(object.entries.first().map(|sub0| {
                    let id = EntryId { index: object.index, sub: sub0.sub };
                    let words = words.and(sub0.label());
                    (Named::Entry(id), language.identifier(ScopeKind::Accessors, Role::Function, &words))
                }));
            }
            for (named, function) in functions {
                for companion in companions(object) {
                    if let Some(companion) = language.companion(*companion, &function) {
                        claims.claim(accessors, companion, named);
                    }
                }
                claims.claim(accessors, function, named);
            }
        }
        claims
    }

    /// What entries are called in their group and among all others.
    fn of_entries(device: &Dictionary, language: &dyn Language) -> Self {
        let mut claims = Self::default();
        for object in device.objects.values() {
            let of_object = Words::of(object.label());
            let members = (ScopeKind::GroupMembers, Some(object.index));
            for entry in &object.entries {
                let label = entry.label();
                let (named, words) = if object.is_structured() {
                    let id = EntryId { index: object.index, sub: entry.sub };
                    (Named::Entry(id), of_object.and(label))
                } else {
                    (Named::Object(object.index), of_object.clone())
                };
                let member = language.identifier(ScopeKind::GroupMembers, Role::Function, &Words::of(label));
                if let Some(setter) = language.companion(Companion::Setter, &member) {
                    claims.claim(members, setter, named);
                }
                claims.claim(members, member, named);
                for (scope, role) in [(ScopeKind::Entries, Role::Variant), (ScopeKind::Fields, Role::Field)] {
                    claims.claim((scope, None), language.identifier(scope, role, &words), named);
                }
            }
        }
        claims
    }

    fn claim(&mut self, scope: ScopeOf, identifier: String, named: Named) {
        if identifier.is_empty() {
            self.clashing.insert(named);
            return;
        }
        match self.taken.insert((scope, identifier), named) {
            // The number of elements gives way to its own object.
            Some(Named::Object(index)) if matches!(named, Named::Entry(id) if id.index == index) => {
                self.clashing.insert(named);
            }
            Some(other) if other != named => self.clashing.extend([other, named]),
            Some(_) | None => {}
        }
    }
}

/// What may be printed with the accessor of an object; which of it is settled when the values have their places.
fn companions(object: &Object) -> &'static [Companion] {
    if object.is_structured() { &[Companion::Setter, Companion::Mutable] } else { &[Companion::Setter] }
}

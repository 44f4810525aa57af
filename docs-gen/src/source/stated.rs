//! Who states a fact: the maker, a standard, or neither.

use od_spec::model::{
    Author, Basis, Dictionary, Entry, EntryId, Erratum, ErratumPlace, Fact, NamedType, Object, Origin, Role,
    StateMachine, Unprinted,
};

use crate::source::Source;
use crate::view::Stated;

impl Source<'_> {
    /// Who states these facts of an entry. A maker's words and a standard's mix only in an object that the maker writes: one that a
    /// feature brings as a whole is the standard's, and says so in its notes.
    pub(crate) fn stated(
        &self,
        device: &Dictionary,
        object: &Object,
        entry: &Entry,
        facts: &[Fact],
    ) -> Stated {
        let id = EntryId { index: object.index, sub: entry.sub };
        let is_count = object.is_structured() && entry.sub.0 == 0;
        let is_meant = |place: &ErratumPlace| match place {
            ErratumPlace::Object(index) => *index == id.index && !is_count,
            ErratumPlace::Entry(one) => *one == id,
        };
        let errata = self.errata_of_object(id.index).iter().map(|at| &self.system.errata[*at]);
        let mut unprinted = errata
            .filter(|erratum| erratum.devices.includes(&device.key) && erratum.at.iter().any(is_meant))
            .filter_map(|erratum| erratum.unprinted.as_ref());
        if let Some(one) = unprinted.find(|one| facts.iter().any(|fact| one.facts.contains(fact))) {
            return by(one.basis);
        }
        // What a device has as a whole is the value of an entry, too.
        let of_device = match (object.role(), entry.sub.0) {
            (Role::PdoCommunication | Role::PdoMapping, _) => Some(Fact::PdoCount),
            (Role::Identity, 1) => Some(Fact::Vendor),
            (Role::Identity, 2) => Some(Fact::Product),
            (Role::Identity, 3) => Some(Fact::ProductRevision),
            _ => None,
        };
        if let Some(fact) = of_device.filter(|_| facts.contains(&Fact::Default)) {
            return self.stated_of_device(device, fact);
        }
        let is_standard =
            object.origin == Origin::Manual && facts.iter().any(|fact| entry.is_only_standard(*fact));
        if is_standard { Stated::Standard } else { Stated::Manual }
    }

    /// Who states the default of an entry of a device.
    pub(crate) fn stated_default(&self, device: &Dictionary, id: EntryId) -> Stated {
        let object = device.objects.get(&id.index);
        let entry = object.and_then(|object| Some((object, object.entry(id.sub)?)));
        entry.map_or(Stated::Manual, |(object, entry)| self.stated(device, object, entry, &[Fact::Default]))
    }

    /// Who states a fact of a device as a whole.
    pub(crate) fn stated_of_device(&self, device: &Dictionary, fact: Fact) -> Stated {
        let errata = self.system.errata.iter();
        let mut unprinted = errata
            .filter(|erratum| erratum.at.is_empty() || fact == Fact::PdoCount)
            .filter(|erratum| erratum.devices.includes(&device.key))
            .filter_map(|erratum| erratum.unprinted.as_ref());
        unprinted.find(|one| one.facts.contains(&fact)).map_or(Stated::Manual, |one| by(one.basis))
    }

    /// Who states what a value of a type means, or a bit of it.
    pub(crate) fn stated_of_type(&self, named: &NamedType, number: i128) -> Stated {
        let of_type = self.lookup.unprinted_types.get(&named.name).into_iter().flatten();
        let mut unprinted = of_type.filter_map(|at| self.system.errata[*at].unprinted.as_ref());
        match unprinted.find(|one| one.of.is_empty() || one.of.contains(&number)) {
            Some(one) => by(one.basis),
            None if named.stated.author == Author::Library => Stated::Standard,
            None => Stated::Manual,
        }
    }

    /// Who states how a state machine works.
    pub(crate) fn stated_of_machine(&self, machine: &StateMachine) -> Stated {
        let is_meant = |erratum: &&Erratum| {
            let entries = [machine.status, machine.command];
            erratum.at.iter().any(|place| entries.iter().any(|entry| entry.index == place.index()))
        };
        let errata = self.system.errata.iter().filter(|erratum| self.is_about(erratum)).filter(is_meant);
        let mut unprinted = errata.filter_map(|erratum| erratum.unprinted.as_ref());
        let of_machine = unprinted.find(|one| one.facts.contains(&Fact::Transitions));
        of_machine.map_or(Stated::Manual, |one| by(one.basis))
    }
}

/// Whether an erratum says that what values or bits mean is not printed.
pub(super) fn leaves_meaning_open(unprinted: &Unprinted) -> bool {
    unprinted.facts.contains(&Fact::Meaning)
}

const fn by(basis: Basis) -> Stated {
    match basis {
        Basis::Standard => Stated::Standard,
        Basis::Assumption => Stated::Assumed,
    }
}

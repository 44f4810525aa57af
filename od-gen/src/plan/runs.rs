//! Runs of objects that differ in nothing but a number in their names: `module 1 cells` to `module 8 cells`. Code reaches them
//! by that number.

use std::collections::BTreeMap;

use super::groups::{Groups, is_accessible};
use super::language::{Companion, Role, ScopeKind};
use super::names::{Scope, Words};
use super::{Place, Plan, PlannedEntry, PlannedObject, Shape};

/// Objects that one accessor reaches by their number.
pub struct PlannedRun {
    /// Name of the accessor.
    pub name: String,
    /// The number of the first object.
    pub first: u16,
    /// Positions in the plan, by number.
    pub objects: Vec<usize>,
    /// How far each value lies after the same one of the object before, in the image.
    pub steps: Vec<usize>,
}

impl PlannedRun {
    /// The number of the last object.
    pub fn last(&self) -> u16 {
        let further = u16::try_from(self.objects.len().saturating_sub(1)).unwrap_or(u16::MAX);
        self.first.saturating_add(further)
    }
}

/// A name without one of its numbers: the words, and which of them was the number.
type Pattern = (Words, usize);

impl Plan<'_> {
    /// Finds the runs and gives them names that nothing else has; `accessors` holds those that are given already.
    pub(super) fn plan_runs(&mut self, accessors: &mut Scope) {
        let mut by_pattern: BTreeMap<Pattern, Vec<(u16, usize)>> = BTreeMap::new();
        for (position, object) in self.objects.iter().enumerate() {
            let words = Words::of(object.object.label());
            for (at, number, rest) in words.numbers() {
                by_pattern.entry((rest, at)).or_default().push((number, position));
            }
        }
        by_pattern.retain(|_, numbered| numbered.len() > 1);
        if by_pattern.is_empty() {
            return;
        }
        let groups = self.groups();
        for ((words, _), numbered) in by_pattern {
            let name = self.language.identifier(ScopeKind::Accessors, Role::Function, &words);
            let Some((first, steps)) = self.run(&numbered, &groups) else { continue };
            let companion = self.language.companion(self.companion(&numbered), &name);
            let names: Vec<&str> = [name.as_str()].into_iter().chain(companion.as_deref()).collect();
            if accessors.claim_if_free(&names) {
                let objects = numbered.into_iter().map(|(_, position)| position).collect();
                self.runs.push(PlannedRun { name, first, objects, steps });
            }
        }
    }

    /// What is printed with the accessor of such objects.
    fn companion(&self, numbered: &[(u16, usize)]) -> Companion {
        let first = numbered.first().and_then(|(_, position)| self.objects.get(*position));
        match first.map(|object| &object.shape) {
            Some(Shape::Group { .. }) => Companion::Mutable,
            Some(Shape::Var | Shape::Indexed { .. }) | None => Companion::Setter,
        }
    }

    /// The first number and the steps of objects that are alike, in the order of their numbers, and lie at equal distances.
    fn run(&self, numbered: &[(u16, usize)], groups: &Groups) -> Option<(u16, Vec<usize>)> {
        let &[(first, position), (_, second), ..] = numbered else { return None };
        let (object, second) = (self.objects.get(position)?, self.objects.get(second)?);
        let (start, next) = (self.offsets(object)?, self.offsets(second)?);
        let steps: Vec<usize> =
            start.iter().zip(next).map(|(start, next)| next.checked_sub(*start)).collect::<Option<_>>()?;
        let fits = |further: u16, number: u16, at: usize| {
            let other = self.objects.get(at)?;
            let far = usize::from(further);
            let expected = start.iter().zip(&steps).map(|(start, step)| start + far * step);
            let is_there = first.checked_add(further) == Some(number)
                && self.are_alike((position, object), (at, other), groups)
                && self.offsets(other)?.into_iter().eq(expected);
            is_there.then_some(())
        };
        let mut others = (1u16..).zip(numbered.iter().skip(1));
        others.all(|(further, &(number, at))| fits(further, number, at).is_some()).then_some((first, steps))
    }

    /// Whether one accessor can serve two objects, except for the places of their values.
    fn are_alike(
        &self,
        one: (usize, &PlannedObject<'_>),
        other: (usize, &PlannedObject<'_>),
        groups: &Groups,
    ) -> bool {
        let same_entry = |one: &PlannedEntry<'_>, other: &PlannedEntry<'_>| {
            one.kind == other.kind
                && one.size == other.size
                && one.entry.is_limited() == other.entry.is_limited()
        };
        match (&one.1.shape, &other.1.shape) {
            (Shape::Group { .. }, Shape::Group { .. }) => {
                groups.first(one.0).is_some() && groups.first(one.0) == groups.first(other.0)
            }
            (Shape::Var, Shape::Var) | (Shape::Indexed { .. }, Shape::Indexed { .. }) => {
                let entries = |object| self.values_of(object).collect::<Vec<_>>();
                let (one, other) = (entries(one.1), entries(other.1));
                one.len() == other.len() && one.iter().zip(other).all(|(one, other)| same_entry(one, other))
            }
            (Shape::Var | Shape::Indexed { .. } | Shape::Group { .. }, _) => false,
        }
    }

    /// The entries whose values the accessor of an object reaches: of an array those after sub-index 0.
    pub fn values_of(&self, object: &PlannedObject<'_>) -> impl Iterator<Item = &PlannedEntry<'_>> {
        let is_value = |entry: &&PlannedEntry<'_>| match object.shape {
            Shape::Var => true,
            Shape::Indexed { .. } => entry.id.sub.0 != 0,
            Shape::Group { .. } => is_accessible(entry),
        };
        self.entries_of(object).filter(is_value)
    }

    /// Where the values lie; `None` where one does not lie in the image.
    fn offsets(&self, object: &PlannedObject<'_>) -> Option<Vec<usize>> {
        let offset = |entry: &PlannedEntry<'_>| match entry.place {
            Place::Image(at) => Some(at),
            Place::Constant(_) | Place::Alias | Place::Application => None,
        };
        self.values_of(object).map(offset).collect()
    }
}

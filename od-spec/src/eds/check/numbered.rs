//! Numbered lists: objects, comments, elements, links, modules.

use std::collections::BTreeSet;

use super::edits;
use crate::diag::Edit;
use crate::eds::names::{List, ModuleTopic, Topic};
use crate::eds::number::lenient_integer;
use crate::eds::view::{Entry, Part, View};
use crate::model::Index;
use crate::order::Arrange as _;

/// A section that counts its entries and numbers them.
pub(super) struct NumberedList<'v, 'd> {
    pub part: &'v Part<'d>,
    pub form: Form,
    /// The entries by number; of two with one number, the first in the text.
    pub entries: Vec<(u32, Entry<'d>)>,
}

/// How such a section is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Form {
    /// The key that counts the entries.
    pub count: &'static str,
    /// What is before an entry's number.
    pub prefix: &'static str,
    /// What the numbers say.
    pub numbers: Numbers,
}

/// What the numbers of a list say.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Numbers {
    /// Nothing but the order: they are 1, 2, 3 and so on.
    Order,
    /// A sub-index or a place: gaps are right.
    Place,
}

/// The form of a section; `None` for one that is not a numbered list.
pub(super) const fn form(topic: Topic) -> Option<Form> {
    const fn form(count: &'static str, prefix: &'static str, numbers: Numbers) -> Form {
        Form { count, prefix, numbers }
    }
    Some(match topic {
        Topic::Objects(_) => form("SupportedObjects", "", Numbers::Order),
        Topic::Comments | Topic::Module(_, ModuleTopic::Comments) => form("Lines", "Line", Numbers::Order),
        Topic::ObjectLinks(_) => form("ObjectLinks", "", Numbers::Order),
        Topic::Module(_, ModuleTopic::FixedObjects | ModuleTopic::SubExtends) => {
            form("NrOfEntries", "", Numbers::Order)
        }
        // The place on the bus coupler.
        Topic::ConnectedModules => form("NrOfEntries", "", Numbers::Order),
        Topic::Elements(..) => form("NrOfEntries", "", Numbers::Place),
        Topic::FileInfo
        | Topic::DeviceInfo
        | Topic::DummyUsage
        | Topic::Commissioning
        | Topic::Object(_)
        | Topic::Sub(..)
        | Topic::DynamicChannels
        | Topic::Tools
        | Topic::Tool(_)
        | Topic::SupportedModules
        | Topic::Module(_, ModuleTopic::ModuleInfo | ModuleTopic::Fixed(..) | ModuleTopic::SubExtension(_))
        | Topic::Unknown => return None,
    })
}

/// All numbered lists.
pub(super) fn all<'v, 'd>(view: &'v View<'d>) -> impl Iterator<Item = (Topic, NumberedList<'v, 'd>)> {
    view.topics().filter_map(|(topic, part)| Some((topic, NumberedList::read(part, form(topic)?))))
}

/// The lists of objects that there are.
pub(super) fn of_objects<'v, 'd>(view: &'v View<'d>) -> Vec<(List, NumberedList<'v, 'd>)> {
    let lists = List::ALL.into_iter();
    let read = |list| Some((list, NumberedList::read(view.list(list)?, form(Topic::Objects(list))?)));
    lists.filter_map(read).collect()
}

/// An index that a list names; `None` for anything else.
pub(super) fn index(entry: &Entry<'_>) -> Option<Index> {
    lenient_integer(entry.value.value).and_then(|number| u16::try_from(number).ok()).map(Index)
}

impl<'v, 'd> NumberedList<'v, 'd> {
    pub(super) fn read(part: &'v Part<'d>, form: Form) -> Self {
        let number = |entry: &Entry<'_>| {
            let (front, digits) = entry.key.value.split_at_checked(form.prefix.len())?;
            let is_number = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
            (is_number && front.eq_ignore_ascii_case(form.prefix)).then(|| digits.parse().ok())?
        };
        let mut entries: Vec<_> = part.entries().filter_map(|entry| Some((number(&entry)?, entry))).collect();
        entries.arrange_by_key(|(number, _)| *number);
        Self { part, form, entries }
    }

    /// Whether the numbers are 1, 2, 3 and so on, in whatever order.
    pub(super) fn is_in_sequence(&self) -> bool {
        let numbers: BTreeSet<u32> = self.entries.iter().map(|(number, _)| *number).collect();
        numbers.len() == self.entries.len() && numbers.into_iter().eq((1..).take(self.entries.len()))
    }

    /// The entries that only repeat the one before them, by where their keys begin.
    pub(super) fn repeated(&self) -> BTreeSet<u32> {
        let is_same = |one: &Entry<'_>, other: &Entry<'_>| {
            let (one, other) = (one.value.value, other.value.value);
            one == other || lenient_integer(one).is_some_and(|number| lenient_integer(other) == Some(number))
        };
        let of_one_number = self.entries.chunk_by(|(one, _), (other, _)| one == other);
        let repeated = of_one_number.flat_map(|entries| {
            let (first, others) = (&entries[0].1, &entries[1..]);
            others.iter().take_while(move |(_, entry)| is_same(first, entry))
        });
        repeated.map(|(_, entry)| entry.key.span.start).collect()
    }

    /// The changes after which some entries are gone, others are added after them, and all of them are numbered and
    /// counted.
    pub(super) fn rewritten(&self, view: &View<'_>, without: &BTreeSet<u32>, more: &[Index]) -> Vec<Edit> {
        let mut edits = Vec::new();
        let is_gone = |entry: &Entry<'_>| without.contains(&entry.key.span.start);
        let kept: Vec<&(u32, Entry<'_>)> = self.entries.iter().filter(|(_, entry)| !is_gone(entry)).collect();
        for (at, (number, entry)) in (1u32..).zip(&kept) {
            if *number != at {
                edits.push(Edit { span: entry.key.span, text: format!("{}{at}", self.form.prefix) });
            }
        }
        let gone = self.entries.iter().filter(|(_, entry)| is_gone(entry));
        edits.extend(gone.map(|(_, entry)| edits::remove(view, entry.line)));
        let count = kept.len() + more.len();
        edits.extend(self.count_as(view, count));
        let last = self.part.sections.last().map(edits::last_line);
        if let Some(last) = last.filter(|_| !more.is_empty()) {
            let lines: Vec<String> = (kept.len() + 1..)
                .zip(more)
                .map(|(at, index)| format!("{}{at}=0x{:04X}", self.form.prefix, index.0))
                .collect();
            edits.push(edits::below(view, last, lines.iter().map(String::as_str)));
        }
        edits
    }

    /// The change after which the count is `count`, if one is needed.
    pub(super) fn count_as(&self, view: &View<'_>, count: usize) -> Option<Edit> {
        let Some(entry) = self.part.key(self.form.count) else {
            let header = self.part.sections.first()?.header();
            let line = format!("{}={count}", self.form.count);
            return Some(edits::below(view, header, [line.as_str()]));
        };
        let is_right = lenient_integer(entry.value.value) == i128::try_from(count).ok();
        let text = edits::number_like(entry.value.value, i128::try_from(count).ok()?);
        (!is_right).then_some(Edit { span: entry.value.span, text })
    }
}

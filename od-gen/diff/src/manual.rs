//! The printed manual that a specification represents: issues, glossary, sections, errata. All of it is for people.

use std::collections::BTreeMap;

use od_spec::model::{Erratum, ErratumPlace, Fact, Issue, Section, System};
use od_spec::wording::Language;

use super::change::{Change, Class, Place};
use super::texts::texts;

const FOR_PEOPLE: &str = "the manual, not the device";

/// What differs.
pub(super) fn changes(old: &System, new: &System, language: &str) -> Vec<Change> {
    let (before, after) = (&old.document, &new.document);
    let source = Change::of(Place::System, Fact::Document, before.source.clone(), after.source.clone());
    let mut changes: Vec<Change> = source.map(|change| change.part("source")).into_iter().collect();
    let issue = |issue: Option<&Issue>| issue.map(|issue| issue.number.clone());
    let revision = Change::of(
        Place::System,
        Fact::Document,
        issue(before.revision.as_ref()),
        issue(after.revision.as_ref()),
    );
    changes.extend(revision.map(|change| change.part("issue")));
    changes.extend(texts(&Place::System, Fact::About, &before.about, &after.about, language));

    let issues =
        |list: &[Issue]| by_key(list.iter().map(|one| (format!("issue {}", one.number), one.clone())));
    let with_date = |one: &Issue| Language::ENGLISH.date(one.date);
    changes.extend(listed(&issues(&before.history), &issues(&after.history), Fact::Document, with_date));

    let terms = |system: &System| {
        by_key(system.document.glossary.iter().map(|(term, text)| (format!("term {term}"), text.clone())))
    };
    let meaning = |text: &od_spec::model::Text| text.get(language).unwrap_or_default().to_owned();
    changes.extend(listed(&terms(old), &terms(new), Fact::Document, meaning));

    let sections = |system: &System| {
        by_key(system.document.sections.iter().map(|one| (section(one, language), one.clone())))
    };
    let title = |one: &Section| one.title.get(language).unwrap_or_default().to_owned();
    changes.extend(listed(&sections(old), &sections(new), Fact::Document, title));

    let errata =
        |system: &System| by_key(system.errata.iter().map(|one| (erratum(one, language), one.clone())));
    let reads = |one: &Erratum| one.reads.get(language).unwrap_or_default().to_owned();
    changes.extend(listed(&errata(old), &errata(new), Fact::Errata, reads));
    changes.into_iter().map(|change| change.so(Class::Documents, FOR_PEOPLE)).collect()
}

fn section(section: &Section, language: &str) -> String {
    if section.number.is_empty() {
        return format!("section {}", section.title.get(language).unwrap_or_default());
    }
    format!("section {}", section.number)
}

fn erratum(erratum: &Erratum, language: &str) -> String {
    let places: Vec<String> = erratum.at.iter().map(ErratumPlace::to_string).collect();
    let printed = erratum.place.get(language).unwrap_or_default();
    let parts = [places.join(", "), format!("({})", erratum.kind.word()), printed.to_owned()];
    let parts: Vec<&str> = parts.iter().map(String::as_str).filter(|part| !part.is_empty()).collect();
    format!("erratum {}", parts.join(" "))
}

/// Things by what they are called; several may have one name.
fn by_key<T>(things: impl Iterator<Item = (String, T)>) -> BTreeMap<String, Vec<T>> {
    let mut map: BTreeMap<String, Vec<T>> = BTreeMap::new();
    for (key, thing) in things {
        map.entry(key).or_default().push(thing);
    }
    map
}

/// What came, went or is another, with what is said of each.
fn listed<T: PartialEq>(
    old: &BTreeMap<String, Vec<T>>,
    new: &BTreeMap<String, Vec<T>>,
    fact: Fact,
    shown: impl Fn(&T) -> String,
) -> Vec<Change> {
    let mut keys: Vec<&String> = old.keys().chain(new.keys()).collect();
    keys.sort_unstable();
    keys.dedup();
    let all = |things: &[T]| things.iter().map(&shown).collect::<Vec<_>>().join("; ");
    let changes = keys.into_iter().filter_map(|key| {
        let change = match (old.get(key), new.get(key)) {
            (Some(before), Some(after)) if before == after => return None,
            (Some(before), Some(after)) => Change::text(Place::System, fact, &all(before), &all(after))
                // The difference lies in what is not shown.
                .unwrap_or_else(|| Change::unsaid(Place::System, fact)),
            (Some(before), None) => Change::removed(Place::System, all(before)),
            (None, Some(after)) => Change::added(Place::System, all(after)),
            (None, None) => return None,
        };
        Some(change.part(key))
    });
    changes.collect()
}

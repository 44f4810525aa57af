//! Differences that are as they should be, each with its reason.

use od_gen::yaml::{Place, Repair};
use od_spec::ascii::transliterate;
use od_spec::model::{DataType, Dictionary, EntryId, Fact, SubIndex, Value};

use super::{Checked, Difference, Stated, Step};

/// What the second model of a comparison was made by.
#[derive(Debug, Clone, Copy)]
pub(super) enum Round<'a> {
    /// By an import, with what it says it has changed.
    Import(&'a [Repair]),
    /// By putting the file right, with the codes of what was wrong.
    Fix(&'a [&'a str]),
}

impl Round<'_> {
    const fn step(self) -> Step {
        match self {
            Round::Import(_) => Step::Import,
            Round::Fix(_) => Step::Fixing,
        }
    }
}

/// A difference of one file that is as it should be.
#[derive(Debug)]
struct Exception {
    file: &'static str,
    fact: Stated,
    reason: &'static str,
}

const EXCEPTIONS: [Exception; 0] = [];

/// The longest text that our EDS have in a line of `[FileInfo]` and `[DeviceInfo]`.
const LONGEST_TEXT: usize = 243;

/// The exceptions of files for which nothing was found.
pub fn unused(found: &[(&str, &Checked)]) -> Vec<String> {
    let is_used = |exception: &Exception| {
        found
            .iter()
            .filter(|(file, _)| *file == exception.file)
            .any(|(_, checked)| checked.excepted.iter().any(|(reason, _)| *reason == exception.reason))
    };
    let idle = EXCEPTIONS.iter().filter(|one| !is_used(one));
    idle.map(|one| format!("{}: {}: {}", one.file, one.fact, one.reason)).collect()
}

/// Takes away what is as it should be, and tells of the rest.
pub(super) fn except(
    round: Round<'_>,
    file: &str,
    before: &Dictionary,
    found: Vec<Difference>,
    checked: &mut Checked,
) {
    for difference in found {
        let listed = EXCEPTIONS.iter().find(|one| one.file == file && one.fact == difference.fact);
        let general = match round {
            Round::Import(repairs) => imported(&difference, before, repairs),
            Round::Fix(codes) => fixed(&difference, codes),
        };
        let Some(reason) = general.or(listed.map(|one| one.reason)) else {
            checked.problem(round.step(), told(&difference, round));
            continue;
        };
        match checked.excepted.iter_mut().find(|(known, _)| *known == reason) {
            Some((_, count)) => *count += 1,
            None => checked.excepted.push((reason, 1)),
        }
    }
}

/// The difference, with why the import says that it has changed the place.
fn told(difference: &Difference, round: Round<'_>) -> String {
    let because = match round {
        Round::Import(repairs) => repairs.iter().find(|repair| is_about(repair, difference.place)),
        Round::Fix(_) => None,
    };
    match because {
        Some(repair) => format!("{difference}; the import says: {}", repair.comment()),
        None => difference.to_string(),
    }
}

fn is_about(repair: &Repair, place: Option<EntryId>) -> bool {
    match &repair.place {
        Place::Object(index) => place == Some(EntryId { index: *index, sub: SubIndex(0) }),
        Place::Entry(entry) => place == Some(*entry),
        Place::Device => place.is_none(),
    }
}

/// Why an import has another fact than its original.
fn imported(difference: &Difference, before: &Dictionary, repairs: &[Repair]) -> Option<&'static str> {
    let renamed = |repair: &Repair| repair.fact == Some(Fact::Name) && is_about(repair, difference.place);
    let Some(id) = difference.place else {
        let text = match difference.fact {
            Stated::Device("description") => &before.file.description,
            Stated::Device("created by") => &before.file.created_by,
            Stated::Device("modified by") => &before.file.modified_by,
            Stated::Device("product name") => &before.info.product_name,
            Stated::Device("order code") => &before.info.order_code,
            _ => return None,
        };
        return (transliterate(text).len() > LONGEST_TEXT).then_some("a text that is too long for a line");
    };
    let entry = before.entry(id)?;
    let is_counted = before.objects.get(&id.index).is_some_and(od_spec::model::Object::is_structured);
    match difference.fact {
        Stated::Name => {
            repairs.iter().any(renamed).then_some("a name that clashes, or that an EDS cannot hold")
        }
        Stated::Type | Stated::Default | Stated::LowLimit | Stated::HighLimit
            if is_counted && id.sub.0 == 0 && entry.data_type != DataType::Unsigned8 =>
        {
            Some("a sub-index 0 of another type than UNSIGNED8, which no specification can have")
        }
        Stated::Default | Stated::Mapping if entry.data_type == DataType::Domain => {
            Some("a DOMAIN, of which an EDS of ours shows neither a value nor a mapping")
        }
        Stated::Default => match &entry.default {
            Some(Value::Text(text)) if transliterate(text).contains('?') && !text.contains('?') => {
                Some("a text with characters that ASCII does not have")
            }
            _ => None,
        },
        Stated::Existence
        | Stated::Kind
        | Stated::Access
        | Stated::Mapping
        | Stated::Type
        | Stated::LowLimit
        | Stated::HighLimit
        | Stated::Flags
        | Stated::Device(_) => None,
    }
}

/// Why a file that was put right has another fact than before.
fn fixed(difference: &Difference, codes: &[&str]) -> Option<&'static str> {
    let is_date = matches!(difference.fact, Stated::Device("created" | "modified"));
    (is_date && codes.contains(&"EDS210")).then_some("a date or time that could not be read before")
}

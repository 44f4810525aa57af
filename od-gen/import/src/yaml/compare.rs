//! Whether a text gives the object that it was written for.

use od_spec::model::{Dictionary, Entry, EnumValue, Index, NamedType, Object, Text, TypeKind};

use super::context::same_unit;

/// How exact an object has to come back.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Likeness {
    /// Everything that the model says.
    Said,
    /// Without descriptions: the parameters of PDOs.
    Parameters,
}

impl Likeness {
    fn of_texts(self, wanted: &Text, found: &Text) -> bool {
        match self {
            Self::Said => same_text(wanted, found),
            Self::Parameters => true,
        }
    }
}

/// The objects that are not as they should be, and those that are too many.
pub(super) fn differing(wanted: &Dictionary, found: &Dictionary) -> Vec<Index> {
    let missing = wanted.objects.values().filter(|object| {
        let made = found.objects.get(&object.index);
        !made.is_some_and(|made| same_object(object, made, likeness(object, made)))
    });
    let more = found.objects.keys().filter(|index| !wanted.objects.contains_key(index));
    missing.map(|object| object.index).chain(more.copied()).collect()
}

/// The parameter objects that `pdos:` makes have their own descriptions.
fn likeness(wanted: &Object, found: &Object) -> Likeness {
    use od_spec::model::Origin;
    match found.origin {
        Origin::Pdo if wanted.role().is_pdo_parameter() => Likeness::Parameters,
        Origin::Pdo | Origin::Manual | Origin::Profile => Likeness::Said,
    }
}

/// Whether an object says what is wanted; it may say more where the model is silent.
fn same_object(wanted: &Object, found: &Object, likeness: Likeness) -> bool {
    wanted.name == found.name
        && wanted.identifier == found.identifier
        && said(wanted.category.as_ref(), found.category.as_ref())
        && said(wanted.since.as_ref(), found.since.as_ref())
        && likeness.of_texts(&wanted.about, &found.about)
        && wanted.linked().eq(found.linked())
        && wanted.kind == found.kind
        && wanted.entries.len() == found.entries.len()
        && wanted
            .entries
            .iter()
            .zip(&found.entries)
            .all(|(wanted, found)| same_entry(wanted, found, likeness))
}

fn same_entry(wanted: &Entry, found: &Entry, likeness: Likeness) -> bool {
    let condition = |entry: &Entry| entry.writable_when.as_ref().map(|condition| condition.text.clone());
    let codes = |entry: &Entry| -> Vec<(u8, Vec<u16>)> {
        entry.bit_errors.iter().map(|errors| (errors.bit, errors.error_codes().collect())).collect()
    };
    wanted.name == found.name
        && wanted.identifier == found.identifier
        && wanted.stored == found.stored
        && likeness.of_texts(&wanted.about, &found.about)
        && wanted.sub == found.sub
        && wanted.data_type == found.data_type
        && same_named(wanted, found)
        && (wanted.access, wanted.locked, wanted.pdo) == (found.access, found.locked, found.pdo)
        && wanted.default == found.default
        && wanted.limits() == found.limits()
        && wanted.hull() == found.hull()
        && wanted.unit.as_ref().is_none_or(|unit| found.unit.as_ref().is_some_and(|one| same_unit(one, unit)))
        && (wanted.special.is_empty() || wanted.special == found.special)
        && said(wanted.category.as_ref(), found.category.as_ref())
        && said(wanted.since.as_ref(), found.since.as_ref())
        && said(super::entry::capacity(wanted).as_ref(), found.capacity.as_ref())
        && condition(wanted) == condition(found)
        && codes(wanted) == codes(found)
        && wanted.eds.access == found.eds.access
        && wanted.eds.flags() == found.eds.flags()
        && (wanted.default.is_none() || wanted.eds.default == found.eds.default)
}

/// Whether a fact is as wanted, if it is.
fn said<T: PartialEq>(wanted: Option<&T>, found: Option<&T>) -> bool {
    wanted.is_none() || wanted == found
}

fn same_text(wanted: &Text, found: &Text) -> bool {
    wanted.is_empty() || wanted == found
}

/// Whether the values of an entry mean what is wanted. A type that is called like its entry has no name of its own.
pub(super) fn same_named(entry: &Entry, found: &Entry) -> bool {
    match (entry.named_type.as_deref(), found.named_type.as_deref()) {
        (Some(wanted), Some(found)) => {
            let named = wanted.name == found.name || wanted.name.eq_ignore_ascii_case(&entry.name);
            named && same_meaning(wanted, found)
        }
        (Some(_), None) => false,
        (None, None) => true,
        // Bits may get a meaning; an enum would restrict the values.
        (None, Some(found)) => matches!(found.kind, TypeKind::Bits(_)),
    }
}

/// Whether a type has the values or bits that are wanted; it may say more about them.
fn same_meaning(wanted: &NamedType, found: &NamedType) -> bool {
    let kind = match (&wanted.kind, &found.kind) {
        (TypeKind::Enum(wanted), TypeKind::Enum(found)) => same_values(wanted, found),
        (TypeKind::Bits(wanted), TypeKind::Bits(found)) => {
            wanted.len() == found.len()
                && wanted.iter().zip(found).all(|(wanted, found)| {
                    let mut described = wanted.clone();
                    if described.about.is_empty() {
                        described.about.clone_from(&found.about);
                    }
                    if same_values(&described.values, &found.values) {
                        described.values.clone_from(&found.values);
                    }
                    described == *found
                })
        }
        (TypeKind::Enum(_), TypeKind::Bits(_)) | (TypeKind::Bits(_), TypeKind::Enum(_)) => false,
    };
    kind && wanted.base == found.base && same_text(&wanted.about, &found.about)
}

fn same_values(wanted: &[EnumValue], found: &[EnumValue]) -> bool {
    wanted.len() == found.len()
        && wanted.iter().zip(found).all(|(wanted, found)| {
            (wanted.value, &wanted.name, wanted.supported) == (found.value, &found.name, found.supported)
                && same_text(&wanted.about, &found.about)
        })
}

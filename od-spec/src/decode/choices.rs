//! Keys of a map that depend on each other: one is missing, or one is too many.

use crate::diag::{Diagnostic, codes};
use crate::keys::{Choice, Keys, Shape};
use crate::scalar;
use crate::source::{Span, Spanned};
use crate::yaml::Node;

/// The first choice of a map that its keys break. `owner` is the place that represents the map.
pub(super) fn check(entries: &[(Spanned<String>, Node)], keys: &Keys, owner: Span) -> Option<Diagnostic> {
    keys.choices.iter().find_map(|choice| broken(*choice, entries, keys, owner))
}

fn broken(
    choice: Choice,
    entries: &[(Spanned<String>, Node)],
    keys: &Keys,
    owner: Span,
) -> Option<Diagnostic> {
    let written: Vec<&Spanned<String>> = entries
        .iter()
        .filter(|(name, value)| {
            choice.keys().contains(&name.value.as_str()) && states(choice, keys, name, value)
        })
        .map(|(name, _)| name)
        .collect();
    match (choice, written.as_slice()) {
        (Choice::One(all) | Choice::Any(all), []) => {
            let names: Vec<String> = all.iter().map(|key| format!("`{key}`")).collect();
            let message = match all.len() {
                0..=4 => format!("{} needs the key {}", keys.name, names.join(" or ")),
                count => format!("{} needs one of {count} keys", keys.name),
            };
            let help = format!("add one of {}", names.join(", "));
            Some(Diagnostic::new(codes::MISSING_KEY, owner, message).help(help))
        }
        (Choice::One(_), [first, second, ..]) => Some(exclusive(first, second)),
        (Choice::Together(all), [first, ..]) => {
            let missing = all.iter().find(|key| written.iter().all(|name| name.value != **key))?;
            // The missing key may not be added to one that excludes it.
            if let Some(other) = excluded_by(missing, entries, keys) {
                return Some(exclusive(first, other));
            }
            let message = format!("{} with `{}` needs the key `{missing}`", keys.name, first.value);
            let help = format!("add `{missing}:`, or remove `{}:`", first.value);
            Some(Diagnostic::new(codes::MISSING_KEY, first.span, message).help(help))
        }
        // What is inherited is seen where the map is laid over what it inherits from.
        (Choice::One(_) | Choice::Any(_) | Choice::AnyInherited(_) | Choice::Together(_), _) => None,
    }
}

/// Whether a key states anything: `no` leaves a thing out, and so does an empty map of which something is needed.
fn states(choice: Choice, keys: &Keys, name: &Spanned<String>, value: &Node) -> bool {
    match keys.get(&name.value).map(|key| key.shape) {
        Some(Shape::YesNo) => value.text().and_then(|text| scalar::yes_no(text.value)) != Some(false),
        Some(Shape::MapOf(..)) if matches!(choice, Choice::Any(_)) => !value.entries().is_empty(),
        _ => true,
    }
}

/// A key of the map that is an alternative to another one.
fn excluded_by<'a>(
    key: &str,
    entries: &'a [(Spanned<String>, Node)],
    keys: &Keys,
) -> Option<&'a Spanned<String>> {
    let groups = keys.choices.iter().filter_map(|choice| match choice {
        Choice::One(all) if all.contains(&key) => Some(all),
        Choice::One(_) | Choice::Any(_) | Choice::AnyInherited(_) | Choice::Together(_) => None,
    });
    groups
        .flat_map(|all| {
            entries.iter().map(|(name, _)| name).filter(|name| all.contains(&name.value.as_str()))
        })
        .next()
}

fn exclusive(one: &Spanned<String>, other: &Spanned<String>) -> Diagnostic {
    let (first, second) = if one.span <= other.span { (one, other) } else { (other, one) };
    let message = format!("`{}` and `{}` exclude each other", first.value, second.value);
    Diagnostic::new(codes::CONFLICTING_KEYS, second.span, message)
        .with(first.span, "the other key")
        .help("keep one of the two")
}

//! The values of a DCF for the device of a specification.

use od_spec::Commissioning;
use od_spec::model::{Dictionary, EntryId};
use od_spec::wording::format_value;

/// A node of a specification's device, and what of the file's node it does not have.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Transferred {
    /// The node.
    pub node: Commissioning,
    /// What could not be taken, with the reason.
    pub left_out: Vec<String>,
}

/// Takes the values of a node from the device that its DCF describes to that of a specification.
pub fn transfer(from: &Dictionary, node: &Commissioning, to: &Dictionary) -> Transferred {
    let mut taken = node.clone();
    let mut left_out = Vec::new();
    taken.values.retain(|id, value| {
        let why = match (from.entry(*id), to.entry(*id)) {
            (_, None) => Some("the specification has no such entry".to_owned()),
            (Some(of_file), Some(entry)) if of_file.data_type != entry.data_type => Some(format!(
                "it is {} in the file, and {} in the specification",
                of_file.data_type, entry.data_type
            )),
            (_, Some(_)) => None,
        };
        let Some(why) = why else { return true };
        let name = from.entry_name(*id).unwrap_or_default();
        let shown = from.entry(*id).map(|entry| format_value(entry, value)).unwrap_or_default();
        left_out.push(format!("{id} ({name}) = {shown}: {why}"));
        false
    });
    left_out.extend(other_defaults(from, &taken, to));
    Transferred { node: taken, left_out }
}

/// Defaults that the file states otherwise than the specification, at entries that it does not set: it is unknown which
/// of them the device has.
fn other_defaults<'a>(
    from: &'a Dictionary,
    node: &'a Commissioning,
    to: &'a Dictionary,
) -> impl Iterator<Item = String> + 'a {
    let is_open = |id: &EntryId| !node.values.contains_key(id);
    from.entries().filter(move |(id, ..)| is_open(id)).filter_map(move |(id, _, of_file)| {
        let entry = to.entry(id).filter(|entry| entry.access.is_writable())?;
        let (stated, default) = (of_file.default.as_ref()?, entry.default.as_ref()?);
        let is_same = stated == default
            || stated.integer_for(node.node).is_some_and(|raw| default.integer_for(node.node) == Some(raw));
        (!is_same && of_file.data_type == entry.data_type).then(|| {
            format!(
                "{id} ({}): the file does not set it, and names another default, {} for {}",
                entry.name,
                format_value(entry, stated),
                format_value(entry, default)
            )
        })
    })
}

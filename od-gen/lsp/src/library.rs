//! What the standards say about an object, by the libraries that come with the compiler.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use od_spec::model::{Entry, EntryId};
use od_spec::{LIBRARIES, Library, library};

/// A library reads slowly, and is the same in every session.
static READ: Mutex<BTreeMap<&'static str, &'static Library>> = Mutex::new(BTreeMap::new());

/// A built-in library.
pub(super) fn built_in(name: &str) -> Option<&'static Library> {
    let (name, _) = LIBRARIES.iter().find(|(known, _)| *known == name)?;
    let mut read = READ.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = read.get(name) {
        return Some(known);
    }
    let known: &'static Library = Box::leak(Box::new(library(name)?));
    read.insert(name, known);
    Some(known)
}

/// An entry as a library describes it.
pub(super) fn entry(profile: &str, id: EntryId) -> Option<&'static Entry> {
    let object = built_in(profile)?.objects.get(&id.index)?;
    object.object.entry(id.sub).or_else(|| object.further.iter().find(|entry| entry.sub == id.sub))
}

//! The built-in libraries as models: what `from:` and features give.

pub(crate) mod kept;
pub(crate) mod shipped;

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::ast::{ObjectDecl, Spec};
use crate::compile::compile_with;
use crate::decode::read_own;
use crate::files::NoFiles;
use crate::library::shipped::LIBRARIES;
use crate::model::{Entry, Index, NamedType, Object, SubIndex, Unit};
use crate::source::SourceMap;
use crate::standard;

/// A built-in library: what a specification that uses it can take from it.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Library {
    /// Name, such as `cia301`.
    pub name: String,
    /// Its objects, on every axis.
    pub objects: BTreeMap<Index, LibraryObject>,
    /// Its features, in the order of the library.
    pub features: Vec<Feature>,
    /// Its units by name.
    pub units: BTreeMap<String, std::sync::Arc<Unit>>,
    /// Its types by name.
    pub types: BTreeMap<String, std::sync::Arc<NamedType>>,
}

/// An object of a library.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct LibraryObject {
    /// The object as `{from: NAME}` gives it.
    pub object: Object,
    /// Of an array, the elements after those of the object that a larger `count:` would give it.
    pub further: Vec<Entry>,
}

/// A feature of a library.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Feature {
    /// Name.
    pub name: String,
    /// Whether every device has it that uses the library.
    pub implied: bool,
    /// The objects that it brings.
    pub objects: Vec<Index>,
    /// Features that it cannot be without.
    pub needs: Vec<String>,
    /// Whether a device says how many channels it has: its arrays have as many elements as these need.
    pub is_counted: bool,
}

/// A built-in library.
///
/// ```
/// use od_spec::model::Index;
///
/// let library = od_spec::library("cia301").expect("it is built in");
/// assert_eq!(library.objects[&Index(0x1017)].object.name, "Producer heartbeat time");
/// assert_eq!(library.objects[&Index(0x1003)].further.len(), 253);
/// assert!(od_spec::library("cia999").is_none());
/// ```
pub fn library(name: &str) -> Option<Library> {
    library_in(name, &["en".to_owned()])
}

/// [`library`], with its texts in these languages, as a specification that lists them takes them.
pub fn library_in(name: &str, languages: &[String]) -> Option<Library> {
    let (name, text) = LIBRARIES.iter().find(|(library, _)| *library == name)?;
    let mut sources = SourceMap::new();
    let id = sources.add(format!("<{name}>"), *text);
    let spec = read_own(&shipped::tree(name, id, &sources)?, &[]);
    let indices = indices(&spec);
    let plain = |_: &ObjectDecl| String::new();
    let mut system = probe(name, languages, &indices, plain)?;
    // Element 254 is the last that there can be.
    let patterned = |decl: &ObjectDecl| decl.array.as_ref().is_some_and(|array| array.entry.name.is_some());
    let arrays: Vec<_> = indices.iter().copied().filter(|(_, decl)| patterned(decl)).collect();
    let mut longest = probe(name, languages, &arrays, |_| ", array: {count: 254}".to_owned())?;
    let mut further = longest.devices.pop().map(|device| device.objects).unwrap_or_default();
    let objects = system
        .devices
        .pop()?
        .objects
        .into_iter()
        .filter(|(index, _)| indices.iter().any(|(one, _)| one == index));
    let objects = objects.map(|(index, object)| {
        let last = object.entries.last().map_or(SubIndex(0), |entry| entry.sub);
        let longer = further.remove(&index).map(|longer| longer.entries).unwrap_or_default();
        let further = longer.into_iter().filter(|entry| entry.sub > last).collect();
        (index, LibraryObject { object, further })
    });
    Some(Library {
        name: (*name).to_owned(),
        objects: objects.collect(),
        features: spec
            .features
            .iter()
            .map(|feature| Feature {
                name: feature.name.value.clone(),
                implied: feature.implied,
                objects: feature.objects.iter().map(|index| index.value).collect(),
                needs: feature.needs.iter().map(|need| need.value.clone()).collect(),
                is_counted: feature.channels.is_some() || feature.channels_of.is_some(),
            })
            .collect(),
        units: system.units,
        types: system.types,
    })
}

/// The indices of a library's objects on every axis, each with its declaration.
fn indices(library: &Spec) -> Vec<(Index, &ObjectDecl)> {
    let mut indices = BTreeMap::new();
    for decl in &library.objects {
        let axes = library.axes.map_or(1, |axes| axes.count);
        let on_axis = |axis| library.axes.and_then(|axes| axes.shift(decl.index.value, axis));
        for index in (2..=axes).filter_map(on_axis) {
            indices.entry(index).or_insert(decl);
        }
        indices.insert(decl.index.value, decl);
    }
    indices.into_iter().collect()
}

/// A device that takes these objects from a library, with further keys each.
fn probe(
    library: &str,
    languages: &[String],
    indices: &[(Index, &ObjectDecl)],
    keys: impl Fn(&ObjectDecl) -> String,
) -> Option<crate::model::System> {
    let mut text = format!(
        "od-spec: 1\ntitle: t\nlanguages: [{}]\nuses: [{library}]\ndevices: {{d: {{name: d}}}}\nobjects:\n",
        languages.join(", ")
    );
    for (index, decl) in indices {
        // Writing into a text cannot fail.
        let _ = writeln!(text, "  0x{:04X}: {{from: {library}{}}}", index.0, keys(decl));
    }
    let mut sources = SourceMap::new();
    let root = sources.add("", text);
    compile_with(standard::rules(&[]), &mut sources, root, &mut NoFiles).system
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_built_in_library_is_there_with_all_its_objects() {
        for (name, text) in LIBRARIES {
            let library = library(name).unwrap();
            let objects = text.split("\nobjects:\n").nth(1).unwrap();
            let end = objects.lines().take_while(|line| !line.starts_with(char::is_alphabetic));
            let written = end.filter(|line| line.starts_with("  0x")).count();
            // Of the drive's objects, those of the first axis are written.
            let count = library.objects.keys().filter(|index| index.0 < 0x6800).count();
            assert!(written > 20 && count == written, "{name}: {count} of {written}");
            for feature in &library.features {
                assert!(
                    feature.objects.iter().all(|index| library.objects.contains_key(index)),
                    "{feature:?}"
                );
                assert!(
                    feature.needs.iter().all(|need| library.features.iter().any(|one| one.name == *need))
                );
            }
        }
    }

    #[test]
    fn objects_of_further_axes_are_there_under_their_own_names() {
        let library = library("cia402").unwrap();
        assert_eq!(library.objects[&Index(0x6840)].object.name, "Controlword axis 2");
    }

    #[test]
    fn an_array_without_a_pattern_has_no_further_elements() {
        let library = library("cia301").unwrap();
        let store = &library.objects[&Index(0x1010)];
        assert_eq!((store.object.entries.len(), store.further.len()), (5, 0));
        let heartbeat = &library.objects[&Index(0x1016)];
        assert_eq!(heartbeat.further.first().map(|entry| entry.sub), Some(SubIndex(2)));
    }
}

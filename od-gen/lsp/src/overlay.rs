//! The files of a specification, as editors show them where they are open, and as they are on the disk elsewhere.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;

use od_gen::source::{plain, read_file};
use od_spec::diag::Diagnostics;
use od_spec::source::{FileId, SourceFile};
use od_spec::yaml::Node;
use od_spec::{Loader, may_be_specification, part_of};

use super::buffer::Buffer;
use super::place::Place;
use super::trees::Trees;

/// Open buffers by their places.
pub(super) type Buffers = BTreeMap<Place, Buffer>;

/// The bytes of a place: its buffer, or its file.
pub(super) fn bytes_of(place: &Place, buffers: &Buffers) -> Result<Vec<u8>, String> {
    if let Some(buffer) = buffers.get(place) {
        return Ok(buffer.text.clone().into_bytes());
    }
    match place {
        Place::File(path) => read_file(path),
        Place::Library(_) | Place::Elsewhere(_) => Err("it is not open".to_owned()),
    }
}

/// Reads buffers before files and no text twice, and remembers which places were asked for, whether there is something or not.
pub(super) struct Overlay<'a> {
    buffers: &'a Buffers,
    trees: &'a Trees,
    /// What the answer depends on.
    pub asked: BTreeSet<Place>,
}

impl<'a> Overlay<'a> {
    pub(super) const fn new(buffers: &'a Buffers, trees: &'a Trees) -> Self {
        Self { buffers, trees, asked: BTreeSet::new() }
    }
}

impl Loader for Overlay<'_> {
    fn load(&mut self, path: &str, from: &str) -> Result<Vec<u8>, String> {
        let from = Path::new(from);
        if !from.is_absolute() {
            return Err("a text that was never saved has no folder; save it first".to_owned());
        }
        let place = Place::File(plain(&from.parent().unwrap_or(Path::new("")).join(path)));
        let bytes = bytes_of(&place, self.buffers);
        self.asked.insert(place);
        bytes
    }

    fn tree(
        &mut self,
        file: FileId,
        source: &SourceFile,
        diagnostics: &mut Diagnostics,
    ) -> Option<Arc<Node>> {
        self.trees.tree(file, source, diagnostics)
    }
}

/// The specification that a document is a part of, if it says so and there is one; of any other document, the document.
pub(super) fn whole(place: &Place, buffers: &Buffers) -> Place {
    let Place::File(path) = place else { return place.clone() };
    if !path.as_os_str().as_encoded_bytes().ends_with(b".yaml") {
        return place.clone();
    }
    let read = |bytes: &[u8]| part_of(bytes).map(ToOwned::to_owned);
    let named = match buffers.get(place) {
        Some(buffer) => read(buffer.text.as_bytes()),
        None => read_file(path).ok().and_then(|bytes| read(&bytes)),
    };
    let whole = named
        .map(|name| Place::File(plain(&path.parent().unwrap_or(Path::new("")).join(name))))
        .filter(|whole| bytes_of(whole, buffers).is_ok_and(|text| may_be_specification(&text)));
    whole.unwrap_or_else(|| place.clone())
}

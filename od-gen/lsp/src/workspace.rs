//! What is open, and the specifications that it belongs to.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use lsp_types::{TextDocumentContentChangeEvent, TextDocumentItem, Uri};
use od_gen::source::read_file;
use od_spec::eds::is_eds;
use od_spec::xdd::is_xdd;

use super::analysis::Analysis;
use super::buffer::Buffer;
use super::copies;
use super::overlay::{Buffers, whole};
use super::place::Place;
use super::position::Encoding;
use super::satellites;
use super::snapshot::Snapshot;
use super::trees::Trees;
use super::uri::uri_of;

/// What is open, and the specifications that it belongs to.
///
/// A specification is analysed as long as one of its files is open: a part keeps the specification that it names as its
/// own. What is stale is analysed again when a request needs it.
#[derive(Debug, Default)]
pub(super) struct Workspace {
    buffers: Buffers,
    projects: BTreeMap<Place, Project>,
    /// The folders that the editor shows.
    pub folders: Vec<PathBuf>,
}

/// Whether a file may be stored in an encoding other than UTF-8.
fn is_stored_somehow(name: &str, text: &str) -> bool {
    is_eds(name, text) || is_xdd(name, text)
}

/// A specification of which a file is open.
#[derive(Debug, Default)]
struct Project {
    /// What was found last; `None` where something changed since.
    now: Option<Arc<Analysis>>,
    /// The last analysis that gave a model.
    good: Option<Arc<Analysis>>,
    /// The syntax trees of its files.
    trees: Arc<Trees>,
    /// The places that the last analysis asked for.
    asked: BTreeSet<Place>,
    /// The open documents that belong to it.
    members: BTreeSet<Place>,
}

impl Workspace {
    /// A document is open in the editor from now on.
    pub(super) fn open(&mut self, document: TextDocumentItem) {
        let place = Place::of_uri(&document.uri);
        self.buffers.insert(place.clone(), Buffer::new(document.uri, document.version, document.text));
        self.saved(&place);
    }

    /// A document is as its file is, as far as the editor knows.
    pub(super) fn saved(&mut self, place: &Place) {
        if let Place::File(path) = place
            && let Some(buffer) = self.buffers.get_mut(place)
            && is_stored_somehow(&path.to_string_lossy(), &buffer.text)
            && let Ok(bytes) = read_file(path)
        {
            buffer.compare(bytes);
        }
        self.changed(place);
    }

    /// An open document has another text; `false` if it is not open.
    pub(super) fn change(
        &mut self,
        uri: &Uri,
        version: i32,
        changes: Vec<TextDocumentContentChangeEvent>,
        encoding: Encoding,
    ) -> bool {
        let place = Place::of_uri(uri);
        let Some(buffer) = self.buffers.get_mut(&place) else { return false };
        buffer.change(changes, encoding);
        buffer.version = version;
        self.changed(&place);
        true
    }

    /// A document is open no longer: what is in its file counts.
    pub(super) fn close(&mut self, uri: &Uri) {
        let place = Place::of_uri(uri);
        if self.buffers.remove(&place).is_some() {
            self.changed(&place);
        }
    }

    /// What depends on a document is stale, and the document may belong to another specification.
    pub(super) fn changed(&mut self, place: &Place) {
        for project in self.projects.values_mut() {
            if project.asked.contains(place) || project.members.contains(place) {
                project.now = None;
            }
        }
        // Whether a document is a part may hang on a file that came or went.
        let mut members: BTreeMap<Place, BTreeSet<Place>> = BTreeMap::new();
        for open in self.buffers.keys() {
            members.entry(whole(open, &self.buffers)).or_default().insert(open.clone());
        }
        self.projects.retain(|root, _| members.contains_key(root));
        for (root, members) in members {
            let project = self.projects.entry(root).or_default();
            if project.members != members {
                project.members = members;
                project.now = None;
            }
        }
    }

    /// A specification with something that changed since it was analysed.
    pub(super) fn stale(&self) -> Option<Place> {
        self.projects.iter().find(|(_, project)| project.now.is_none()).map(|(root, _)| root.clone())
    }

    /// The analysis of a specification as it is now.
    pub(super) fn analysed(&mut self, root: &Place) -> Option<Arc<Analysis>> {
        let project = self.projects.get_mut(root)?;
        if let Some(now) = &project.now {
            return Some(Arc::clone(now));
        }
        let buffers = &self.buffers;
        let members = project.members.iter();
        let now = Arc::new(Analysis::of(root, members, buffers, &project.trees, |place| uri(place, buffers)));
        if now.has_models() {
            project.good = Some(Arc::clone(&now));
        }
        project.asked.clone_from(&now.asked);
        project.now = Some(Arc::clone(&now));
        Some(now)
    }

    /// What requests about an open document are answered from.
    pub(super) fn snapshot(&mut self, uri: &Uri, encoding: Encoding) -> Option<Snapshot> {
        let place = Place::of_uri(uri);
        let root = self.projects.iter().find(|(_, project)| project.members.contains(&place))?.0.clone();
        let now = self.analysed(&root)?;
        let file = now.file(&place)?;
        let good = self.projects.get(&root)?.good.clone();
        Some(Snapshot::of(now, good, file, encoding))
    }

    /// What requests about everything that is open are answered from: each specification once, by its main file.
    pub(super) fn snapshots(&mut self, encoding: Encoding) -> Vec<Snapshot> {
        let roots: Vec<Place> = self.projects.keys().cloned().collect();
        let snapshot = |root: &Place| {
            let now = self.analysed(root)?;
            let (file, good) = (now.file(root)?, self.projects.get(root)?.good.clone());
            Some(Snapshot::of(now, good, file, encoding))
        };
        roots.iter().filter_map(snapshot).collect()
    }

    /// The analyses of everything that is open, as they are now.
    pub(super) fn analyses(&mut self) -> Vec<Arc<Analysis>> {
        let roots: Vec<Place> = self.projects.keys().cloned().collect();
        roots.iter().filter_map(|root| self.analysed(root)).collect()
    }

    /// The parameter files and plants that name a specification: those that are open, and those next to it or in a folder of
    /// the editor.
    pub(super) fn satellites(&mut self, root: &Place) -> Vec<Arc<Analysis>> {
        let open = self.analyses();
        let mut places: BTreeSet<Place> = BTreeSet::new();
        for folder in self.folders.iter().map(PathBuf::as_path).chain(folder_of(root)) {
            satellites::below(folder, &mut places);
        }
        for analysis in &open {
            if let Some(place) = analysis.own_place() {
                places.remove(place);
            }
        }
        let buffers = &self.buffers;
        let closed = places.iter().filter(|place| !buffers.contains_key(place)).map(|place| {
            Arc::new(Analysis::of(place, [].iter(), buffers, &Arc::default(), |place| uri(place, buffers)))
        });
        open.iter().cloned().chain(closed).filter(|analysis| analysis.is_about_nodes_of(root)).collect()
    }

    /// The analysis of a document as it would be with other texts of some files.
    pub(super) fn trial(&self, place: &Place, texts: &BTreeMap<Place, String>) -> Option<Analysis> {
        let mut buffers = self.buffers.clone();
        for (place, text) in texts {
            buffers.insert(place.clone(), Buffer::new(uri(place, &self.buffers)?, 0, text.clone()));
        }
        Some(Analysis::of(place, [].iter(), &buffers, &Arc::default(), |place| uri(place, &self.buffers)))
    }

    /// The version of an open document.
    pub(super) fn version(&self, place: &Place) -> Option<i32> {
        self.buffers.get(place).map(|buffer| buffer.version)
    }
}

/// The folder of a file.
fn folder_of(place: &Place) -> Option<&Path> {
    match place {
        Place::File(path) => path.parent(),
        Place::Library(_) | Place::Elsewhere(_) => None,
    }
}

/// How the client calls a place: as it did when it opened it, or by the path.
fn uri(place: &Place, buffers: &Buffers) -> Option<Uri> {
    match (buffers.get(place), place) {
        (Some(buffer), _) => Some(buffer.uri.clone()),
        (None, Place::File(path)) => uri_of(path),
        (None, Place::Library(name)) => copies::library(name),
        (None, Place::Elsewhere(_)) => None,
    }
}

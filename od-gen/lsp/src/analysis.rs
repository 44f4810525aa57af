//! One document compiled with everything that it names: the same as `odgen check` does with a file.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, LazyLock, OnceLock};

use lsp_types::{Range, Uri};
use od_readers::remark;
use od_spec::diag::{Diagnostic, Diagnostics};
use od_spec::eds::is_eds;
use od_spec::model::{System, SystemSource};
use od_spec::names::Names;
use od_spec::plant::{Settled, is_plant, plant};
use od_spec::source::{FileId, SourceMap, Span};
use od_spec::xdd::is_xdd;
use od_spec::yaml::{self, Node};
use od_spec::{Compiled, add_source, compile, is_parameter_file, is_specification, parameter_file};

use super::overlay::{Buffers, Overlay, bytes_of};
use super::place::Place;
use super::position::{Encoding, Lines};
use super::trees::Trees;
use super::unread;

/// What a document is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// A specification, a part of one, or a library.
    Specification,
    /// An EDS or DCF.
    Eds,
    /// An XDD or XDC.
    Xdd,
    /// A plant file.
    Plant,
    /// A parameter file.
    Parameters,
    /// Something that is none of our business.
    Foreign,
}

impl Kind {
    /// What a text is, by its name and how it begins.
    fn of(name: &str, text: &str) -> Self {
        if is_xdd(name, text) {
            Kind::Xdd
        } else if is_eds(name, text) {
            Kind::Eds
        } else if is_parameter_file(text) {
            Kind::Parameters
        } else if is_plant(text) {
            Kind::Plant
        } else if name.ends_with(".od.yaml") || is_specification(text) {
            Kind::Specification
        } else {
            Kind::Foreign
        }
    }
}

/// One document compiled with everything that it names.
#[derive(Debug)]
pub(super) struct Analysis {
    /// What the document is.
    pub kind: Kind,
    /// All texts: the document, its parts, the libraries, and what is open and says that it belongs to it.
    pub sources: SourceMap,
    /// The document; `None` if it cannot be read.
    pub root: Option<FileId>,
    /// The model, if nothing is wrong.
    pub system: Option<System>,
    /// What is to be said about the texts, notes included.
    pub diagnostics: Diagnostics,
    /// The places that were asked for, whether there is something or not.
    pub asked: BTreeSet<Place>,
    files: BTreeMap<FileId, FileFacts>,
    trees: Arc<Trees>,
    names: OnceLock<Names>,
}

/// The lines of a text of other sources.
static NO_LINES: LazyLock<Lines> = LazyLock::new(|| Lines::of(""));

/// What is known about a text beside the text.
#[derive(Debug)]
struct FileFacts {
    place: Place,
    uri: Option<Uri>,
    lines: OnceLock<Lines>,
    tree: OnceLock<Option<Arc<Node>>>,
    outline: OnceLock<Node>,
}

impl Analysis {
    /// Compiles the document at a place. `members` are open documents that say they are parts of it, `trees` what was read of its
    /// files before, and `uri` tells how the client calls a place.
    pub(super) fn of<'a>(
        place: &Place,
        members: impl Iterator<Item = &'a Place>,
        buffers: &Buffers,
        trees: &Arc<Trees>,
        uri: impl Fn(&Place) -> Option<Uri>,
    ) -> Self {
        let mut analysis = Self {
            kind: Kind::Foreign,
            sources: SourceMap::new(),
            root: None,
            system: None,
            diagnostics: Diagnostics::new(),
            asked: BTreeSet::from([place.clone()]),
            files: BTreeMap::new(),
            trees: Arc::clone(trees),
            names: OnceLock::new(),
        };
        let mut loader = Overlay::new(buffers, trees);
        analysis.read(place, &mut loader, buffers);
        analysis.asked.append(&mut loader.asked);
        analysis.note_files(&uri);
        // What belongs to the document by its own words, and is not named by it, or could not be reached.
        for member in members {
            if analysis.file(member).is_none()
                && let Some(buffer) = buffers.get(member)
            {
                analysis.sources.add(member.name(), buffer.text.as_str());
                analysis.note_files(&uri);
            }
        }
        analysis
    }

    fn read(&mut self, place: &Place, loader: &mut Overlay<'_>, buffers: &Buffers) {
        let name = place.name();
        let Ok(bytes) = bytes_of(place, buffers) else { return };
        let root = match add_source(&mut self.sources, &name, bytes) {
            Ok(root) => root,
            Err(diagnostic) => {
                self.diagnostics.push(*diagnostic);
                // The text is shown all the same.
                let text = buffers.get(place).map_or("", |buffer| buffer.text.as_str());
                self.root = Some(self.sources.add(name, text));
                return;
            }
        };
        self.root = Some(root);
        self.kind = Kind::of(&name, self.sources.file(root).text());
        match self.kind {
            Kind::Specification | Kind::Eds | Kind::Xdd => {
                let mut compiled = compile(&mut self.sources, root, loader);
                remark(&self.sources, root, &mut compiled);
                let Compiled { system, diagnostics, .. } = compiled;
                (self.system, self.diagnostics) = (system, diagnostics);
                if self.kind == Kind::Specification && self.sources.files().count() == 1 {
                    unread::add(&mut self.sources, root, loader);
                }
            }
            Kind::Plant => self.diagnostics = of_plant(&mut self.sources, root, loader),
            Kind::Parameters => {
                parameter_file(&self.sources, root, &mut self.diagnostics);
                self.diagnostics.sort();
            }
            Kind::Foreign => {}
        }
    }

    fn note_files(&mut self, uri: impl Fn(&Place) -> Option<Uri>) {
        for (id, file) in self.sources.files() {
            self.files.entry(id).or_insert_with(|| {
                let place = Place::of_source(file.name());
                let uri = uri(&place);
                FileFacts {
                    place,
                    uri,
                    lines: OnceLock::new(),
                    tree: OnceLock::new(),
                    outline: OnceLock::new(),
                }
            });
        }
    }

    /// The file at a place.
    pub(super) fn file(&self, place: &Place) -> Option<FileId> {
        self.files.iter().find(|(_, facts)| facts.place == *place).map(|(id, _)| *id)
    }

    /// All files, in the order in which they were read.
    pub(super) fn files(&self) -> impl Iterator<Item = FileId> {
        self.files.keys().copied()
    }

    /// Where a file is.
    pub(super) fn place(&self, file: FileId) -> Option<&Place> {
        self.files.get(&file).map(|facts| &facts.place)
    }

    /// How the client calls a file; of a built-in library, its copy.
    pub(super) fn uri(&self, file: FileId) -> Option<&Uri> {
        self.files.get(&file)?.uri.as_ref()
    }

    /// The lines of a file.
    pub(super) fn lines(&self, file: FileId) -> &Lines {
        let lines = || Lines::of(self.sources.file(file).text());
        self.files.get(&file).map_or(&NO_LINES, |facts| facts.lines.get_or_init(lines))
    }

    /// The syntax tree of a file; `None` where the text is no YAML, or an EDS.
    pub(super) fn tree(&self, file: FileId) -> Option<&Node> {
        let read = || match self.kind {
            Kind::Specification | Kind::Plant | Kind::Parameters => {
                self.trees.tree(file, self.sources.file(file), &mut Diagnostics::new())
            }
            Kind::Eds | Kind::Xdd | Kind::Foreign => None,
        };
        self.files.get(&file)?.tree.get_or_init(read).as_deref()
    }

    /// The syntax tree of a file of a specification; where the text is no YAML, what can be read of it.
    pub(super) fn outline(&self, file: FileId) -> Option<&Node> {
        if self.kind != Kind::Specification {
            return None;
        }
        let lenient = || yaml::lenient(file, self.sources.file(file).text());
        self.tree(file).or_else(|| Some(self.files.get(&file)?.outline.get_or_init(lenient)))
    }

    /// What the specification defines, and what refers to it.
    pub(super) fn names(&self) -> &Names {
        self.names.get_or_init(|| match self.root {
            Some(root) => Names::of(&self.sources, root, |file| self.outline(file), self.system.as_ref()),
            None => Names::default(),
        })
    }

    /// The range of a span of these sources.
    pub(super) fn range(&self, span: Span, encoding: Encoding) -> Range {
        self.lines(span.file).range(self.sources.file(span.file).text(), span, encoding)
    }

    /// What is said about a file, or about no place in any where it is the document itself.
    pub(super) fn about(&self, file: FileId) -> impl Iterator<Item = &Diagnostic> {
        self.diagnostics.iter().filter(move |diagnostic| match diagnostic.labels.first() {
            Some(label) => label.span.file == file,
            None => Some(file) == self.root,
        })
    }
}

/// What `odgen plant check` says about a plant.
fn of_plant(sources: &mut SourceMap, root: FileId, loader: &mut Overlay<'_>) -> Diagnostics {
    let read = plant(sources, root, loader);
    let mut diagnostics = read.diagnostics;
    for file in read.files {
        // An EDS of others is checked where it is opened.
        if file.source != Some(SystemSource::Eds) {
            diagnostics.append(file.diagnostics);
        }
    }
    if let Some(plant) = read.plant {
        let settled: Vec<Settled> =
            (0..plant.classes.len()).filter_map(|class| plant.settle(class)).collect();
        diagnostics.append(plant.check(&settled));
    }
    diagnostics.sort();
    diagnostics
}

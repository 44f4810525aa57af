//! One document compiled with everything that it names: the same as `odgen check` does with a file.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, LazyLock, OnceLock};

use lsp_types::{Range, Uri};
use od_readers::remark;
use od_spec::diag::{Diagnostic, Diagnostics};
use od_spec::eds::is_eds;
use od_spec::model::{System, SystemSource};
use od_spec::names::{DeviceKeys, Names};
use od_spec::plant::{Settled, is_plant, plant};
use od_spec::source::{FileId, SourceMap, Span};
use od_spec::xdd::is_xdd;
use od_spec::yaml::{self, Node};
use od_spec::{Compiled, OnDevice, add_source, compile, is_parameter_file, is_specification, on_device};

use super::buffer::Buffer;
use super::overlay::{Buffers, Overlay, bytes_of};
use super::place::Place;
use super::position::{Encoding, Lines};
use super::trees::Trees;
use super::unread;

/// Bytes of the largest document that is checked while it is edited: some 50,000 entries, which take two seconds.
pub(super) const LARGEST: usize = 4 << 20;

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
    /// A file that is not for this server.
    Foreign,
    /// A file that is too large to be checked while it is edited.
    TooLarge,
}

impl Kind {
    /// What a text is, by its name and how it begins.
    fn of(name: &str, text: &str) -> Self {
        let kind = if is_xdd(name, text) {
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
        };
        if kind != Kind::Foreign && text.len() > LARGEST { Kind::TooLarge } else { kind }
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
    /// What describes devices: the document itself, or the files that a parameter file or a plant names.
    pub described: Vec<Described>,
    /// What is to be said about the texts, notes included.
    pub diagnostics: Diagnostics,
    /// The places that were asked for, whether there is something or not.
    pub asked: BTreeSet<Place>,
    /// The encoding of the file and the first character in question, if the editor has read it in another one.
    pub misread: Option<(&'static str, usize)>,
    files: BTreeMap<FileId, FileFacts>,
    trees: Arc<Trees>,
}

/// A specification, EDS, DCF, XDD or XDC, with what it defines.
#[derive(Debug)]
pub(super) struct Described {
    /// Its file.
    pub root: FileId,
    /// The model, if nothing is wrong.
    pub system: Option<Arc<System>>,
    /// What the document calls its devices, if it is a parameter file or a plant.
    pub devices: DeviceKeys,
    names: OnceLock<Names>,
}

impl Described {
    const fn new(root: FileId, system: Option<Arc<System>>, devices: DeviceKeys) -> Self {
        Self { root, system, devices, names: OnceLock::new() }
    }
}

/// The names of what describes nothing.
static NO_NAMES: LazyLock<Names> = LazyLock::new(Names::default);

/// The lines of a text of other sources.
static NO_LINES: LazyLock<Lines> = LazyLock::new(|| Lines::of(""));

/// What is known about a text.
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
    /// files before, and `uri` gives the client's name of a place.
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
            described: Vec::new(),
            diagnostics: Diagnostics::new(),
            asked: BTreeSet::from([place.clone()]),
            misread: buffers.get(place).and_then(Buffer::misread),
            files: BTreeMap::new(),
            trees: Arc::clone(trees),
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
                self.diagnostics = diagnostics;
                self.described = vec![Described::new(root, system.map(Arc::new), DeviceKeys::new())];
                if self.kind == Kind::Specification && self.sources.files().count() == 1 {
                    unread::add(&mut self.sources, root, loader);
                }
            }
            Kind::Plant => self.read_plant(root, loader),
            Kind::Parameters => self.read_parameters(root, loader),
            Kind::Foreign | Kind::TooLarge => {}
        }
    }

    /// What `odgen plant check` reports about a plant.
    fn read_plant(&mut self, root: FileId, loader: &mut Overlay<'_>) {
        let read = plant(&mut self.sources, root, loader);
        self.diagnostics = read.diagnostics;
        for device in &read.devices {
            let Some(name) = read.files.get(device.file).map(|file| &file.name) else { continue };
            let Some((file, _)) = self.sources.files().find(|(_, file)| file.name() == name) else {
                continue;
            };
            let at = self.described.iter().position(|one| one.root == file).unwrap_or_else(|| {
                self.described.push(Described::new(
                    file,
                    Some(Arc::clone(&device.system)),
                    DeviceKeys::new(),
                ));
                self.described.len() - 1
            });
            self.described[at].devices.insert(device.key.clone(), device.dictionary.key.clone());
        }
        for file in read.files {
            let of_name = self.sources.files().find(|(_, source)| source.name() == file.name);
            if let Some((root, _)) = of_name
                && self.described.iter().all(|one| one.root != root)
            {
                self.described.push(Described::new(root, None, DeviceKeys::new()));
            }
            // A foreign EDS is checked where it is opened.
            if file.source != Some(SystemSource::Eds) {
                self.diagnostics.append(file.diagnostics);
            }
        }
        if let Some(plant) = read.plant {
            let settled: Vec<Settled> =
                (0..plant.classes.len()).filter_map(|class| plant.settle(class)).collect();
            self.diagnostics.append(plant.check(&settled));
        }
        self.diagnostics.sort();
    }

    /// A parameter file, and its values on the device that it names.
    fn read_parameters(&mut self, root: FileId, loader: &mut Overlay<'_>) {
        let OnDevice { spec, system, device, diagnostics, .. } = on_device(&mut self.sources, root, loader);
        self.diagnostics = diagnostics;
        // In a parameter file, the device has no key.
        let devices = device.map(|key| (String::new(), key)).into_iter().collect();
        self.described =
            spec.map(|file| Described::new(file, system.map(Arc::new), devices)).into_iter().collect();
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

    /// Where the document is.
    pub(super) fn own_place(&self) -> Option<&Place> {
        self.place(self.root?)
    }

    /// Whether it is a parameter file or a plant, and names the specification at a place; while it is not valid YAML, whether
    /// the name of that file is in it.
    pub(super) fn is_about_nodes_of(&self, spec: &Place) -> bool {
        let may_be = |root: FileId| {
            let (text, path) = (self.sources.file(root).text(), spec.name());
            self.tree(root).is_none() && path.rsplit('/').next().is_some_and(|name| text.contains(name))
        };
        match self.kind {
            Kind::Plant | Kind::Parameters => {
                self.described.iter().any(|one| self.place(one.root) == Some(spec))
                    || self.root.is_some_and(may_be)
            }
            Kind::Specification | Kind::Eds | Kind::Xdd | Kind::Foreign | Kind::TooLarge => false,
        }
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

    /// Whether a file has the syntax of specifications.
    pub(super) fn is_yaml(&self, file: FileId) -> bool {
        let source = self.sources.file(file);
        let is_one = |kind| matches!(kind, Kind::Specification | Kind::Plant | Kind::Parameters);
        // A plant or parameter file may name an EDS or XDD.
        is_one(self.kind)
            && (Some(file) == self.root
                || !is_eds(source.name(), source.text()) && !is_xdd(source.name(), source.text()))
    }

    /// The syntax tree of a file; `None` if the text is not YAML.
    pub(super) fn tree(&self, file: FileId) -> Option<&Node> {
        let read = || {
            let tree = || self.trees.tree(file, self.sources.file(file), &mut Diagnostics::new());
            self.is_yaml(file).then(tree).flatten()
        };
        self.files.get(&file)?.tree.get_or_init(read).as_deref()
    }

    /// The syntax tree of a file; if the text is not YAML at the moment, what can be read of it.
    pub(super) fn outline(&self, file: FileId) -> Option<&Node> {
        if !self.is_yaml(file) {
            return None;
        }
        let lenient = || yaml::lenient(file, self.sources.file(file).text());
        self.tree(file).or_else(|| Some(self.files.get(&file)?.outline.get_or_init(lenient)))
    }

    /// The first model.
    pub(super) fn system(&self) -> Option<&System> {
        self.described.first()?.system.as_deref()
    }

    /// Whether nothing that describes devices has errors.
    pub(super) fn has_models(&self) -> bool {
        !self.described.is_empty() && self.described.iter().all(|one| one.system.is_some())
    }

    /// What the specification defines, and what refers to it.
    pub(super) fn names(&self) -> &Names {
        self.names_of(0)
    }

    /// What one of the specifications defines, and what refers to it.
    pub(super) fn names_of(&self, at: usize) -> &Names {
        let Some(one) = self.described.get(at) else { return &NO_NAMES };
        let is_of_another = |file: FileId| {
            let others = self.described.iter().filter(|other| other.root != one.root);
            others.map(|other| other.root).any(|root| file.is_one_with(root))
        };
        let tree = |file| self.outline(file).filter(|_| !is_of_another(file));
        one.names.get_or_init(|| {
            Names::with_settings(&self.sources, one.root, tree, one.system.as_deref(), &one.devices)
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

//! Where each name of a specification is defined, and where it is referred to: for editors.
//!
//! The definitions are read from the syntax trees alone, and the references from every scalar whose key, by the table of
//! keys, holds a name ([`NameOf`](crate::keys::NameOf), an entry, a type, a condition …). So the index is also complete where
//! something else is wrong, and a compilation that wants none pays nothing for it. What a name of an entry means on a
//! device is asked of the model, by the lookup that compiling uses, as long as there is one.

mod collector;
mod conditions;
mod definitions;
mod known;
mod objects;
mod place;
mod references;
mod resolved;
mod settings;
#[cfg(test)]
mod tests;
mod walk;

use std::ops::Range;

use crate::model::{EntryId, Index, SubIndex, System};
use crate::source::{FileId, SourceMap, Span};
use crate::yaml::Node;

pub use place::{Place, Spot};
pub use settings::{DeviceKeys, SettingOf};
pub use walk::Step;

/// What something is that has a name or a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A part of the specification.
    File,
    /// A library.
    Library,
    /// A device, by its key.
    Device,
    /// A unit.
    Unit,
    /// An enum or a bit field.
    Type,
    /// A value of an enum, or of a run of bits.
    Value,
    /// A bit or a run of bits, or what it is in a mode of operation.
    Bit,
    /// A feature of a library.
    Feature,
    /// An object.
    Object,
    /// An entry of an object.
    Entry,
    /// The parameters of a PDO.
    Pdo,
    /// An error code, or a run of them.
    Error,
    /// A state machine.
    Machine,
    /// A state.
    State,
    /// A transition.
    Transition,
    /// A command of a state machine.
    Command,
    /// A constraint.
    Constraint,
    /// A block of a diagram.
    Block,
    /// A mark of an axis.
    Mark,
}

impl Kind {
    /// What to call it in a message.
    pub const fn word(self) -> &'static str {
        match self {
            Kind::File => "file",
            Kind::Library => "library",
            Kind::Device => "device",
            Kind::Unit => "unit",
            Kind::Type => "type",
            Kind::Value => "value",
            Kind::Bit => "bit",
            Kind::Feature => "feature",
            Kind::Object => "object",
            Kind::Entry => "entry",
            Kind::Pdo => "PDO",
            Kind::Error => "error code",
            Kind::Machine => "state machine",
            Kind::State => "state",
            Kind::Transition => "transition",
            Kind::Command => "command",
            Kind::Constraint => "constraint",
            Kind::Block => "block",
            Kind::Mark => "mark",
        }
    }
}

/// The number of a [`Definition`] in its [`Names`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct DefinitionId(u32);

/// How the name of something is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spelling {
    /// As it is.
    Written,
    /// With a placeholder for a number.
    Pattern,
    /// Not where it is defined: it has a number only, or its name follows from something else.
    Elsewhere,
}

/// Something that has a name, a number or both.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Definition {
    /// What it is.
    pub kind: Kind,
    /// Its name as it is written; without one, its number.
    pub name: String,
    /// Where the name is written; without one, [`key`](Self::key).
    pub span: Span,
    /// How the name is written.
    pub spelling: Spelling,
    /// The key or item that describes it.
    pub key: Span,
    /// What it is a part of: the type of a value, the object of an entry.
    pub owner: Option<DefinitionId>,
    /// Of an object, its index, or the first and last of a run.
    pub indices: Option<(Index, Index)>,
    /// Of an entry, its sub-index, or the first and last of a run.
    pub subs: Option<(SubIndex, SubIndex)>,
    /// The devices that have it; `None` for all.
    pub devices: Option<Vec<String>>,
}

/// How something is referred to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum By {
    /// By its name.
    Name,
    /// By its identifier.
    Identifier,
    /// By its name with a placeholder in it.
    Pattern,
    /// By its number.
    Number,
    /// By a word of the language, such as a data type, `all` or `any`.
    Word,
}

/// A place that refers to something.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Reference {
    /// The part of a scalar that refers to it; where the scalar has escapes or several lines, the whole scalar.
    pub span: Span,
    /// The scalar.
    pub scalar: Span,
    /// Where the part is in the text of the scalar.
    pub range: Range<usize>,
    /// What is referred to.
    pub kind: Kind,
    /// How.
    pub by: By,
    /// What it can be: one thing, or one for each device that has its own; none where nothing has the name.
    pub targets: Vec<DefinitionId>,
    /// Of an object or entry, which one it is; of a run, the first.
    pub entry: Option<EntryId>,
}

/// What is at a place.
#[derive(Debug, Clone, Copy)]
pub enum Found<'n> {
    /// Something is defined there.
    Definition(DefinitionId, &'n Definition),
    /// Something is referred to there.
    Reference(&'n Reference),
}

/// The definitions and references of a specification, its parts and its libraries.
#[derive(Debug, Clone, Default)]
pub struct Names {
    definitions: Vec<Definition>,
    /// By place.
    references: Vec<Reference>,
    /// Where names and keys of definitions are, by place.
    places: Vec<(Span, DefinitionId)>,
}

impl Names {
    /// Reads the index of a specification. `sources` holds it, its parts and its libraries, `tree` gives the syntax tree of each; what
    /// is no YAML has none. `system` is what the texts mean, where nothing is wrong in them.
    pub fn of<'t>(
        sources: &SourceMap,
        root: FileId,
        tree: impl Fn(FileId) -> Option<&'t Node>,
        system: Option<&System>,
    ) -> Self {
        Self::with_settings(sources, root, tree, system, &DeviceKeys::new())
    }

    /// The same, with what a parameter file or a plant among the sources refers to; `devices` is what that calls the devices of
    /// the specification.
    pub fn with_settings<'t>(
        sources: &SourceMap,
        root: FileId,
        tree: impl Fn(FileId) -> Option<&'t Node>,
        system: Option<&System>,
        devices: &DeviceKeys,
    ) -> Self {
        let trees: Vec<(FileId, &'t Node)> =
            sources.files().filter_map(|(file, _)| Some((file, tree(file)?))).collect();
        // A plant has keys of the same names, and defines nothing of a specification.
        let is_specification = |(_, tree): &(FileId, &Node)| !walk::is_of_nodes(tree);
        let described: Vec<_> = trees.iter().copied().filter(is_specification).collect();
        let known = definitions::collect(sources, root, &described);
        let references = references::collect(sources, root, &trees, &known, system, devices);
        let definitions = known.into_list();
        let mut places: Vec<(Span, DefinitionId)> = (0..)
            .zip(&definitions)
            .flat_map(|(at, one)| [(one.span, DefinitionId(at)), (one.key, DefinitionId(at))])
            .collect();
        places.sort_unstable();
        places.dedup();
        Self { definitions, references, places }
    }

    /// A definition.
    pub fn definition(&self, id: DefinitionId) -> &Definition {
        &self.definitions[id.0 as usize]
    }

    /// All definitions, in the order of the files.
    pub fn definitions(&self) -> impl Iterator<Item = (DefinitionId, &Definition)> {
        (0..).map(DefinitionId).zip(&self.definitions)
    }

    /// All references, by place.
    pub fn references(&self) -> &[Reference] {
        &self.references
    }

    /// What refers to something, by place.
    pub fn references_to(&self, id: DefinitionId) -> impl Iterator<Item = &Reference> {
        self.references.iter().filter(move |reference| reference.targets.contains(&id))
    }

    /// What is defined or referred to at a byte of a file; also directly after its last one.
    pub fn at(&self, file: FileId, offset: u32) -> Option<Found<'_>> {
        let holds = |span: &Span| span.file == file && (span.start..=span.end).contains(&offset);
        let upto = self.references.partition_point(|one| (one.span.file, one.span.start) <= (file, offset));
        // Parts of one scalar lie side by side; the one that begins at the place goes before the one that ends there.
        let reference = self.references[..upto].iter().rev().take(4).find(|one| holds(&one.span));
        let upto = self.places.partition_point(|(span, _)| (span.file, span.start) <= (file, offset));
        let near = self.places[..upto].iter().rev().take_while(|(span, _)| span.file == file).take(16);
        let definition =
            near.filter(|(span, _)| holds(span)).min_by_key(|(span, id)| (span.end - span.start, *id));
        match (reference, definition) {
            (Some(reference), _) => Some(Found::Reference(reference)),
            (None, Some((_, id))) => Some(Found::Definition(*id, self.definition(*id))),
            (None, None) => None,
        }
    }
}

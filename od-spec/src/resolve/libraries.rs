//! What a specification takes from its libraries by `from:`.

use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::scope::unknown;
use crate::ast::{Axes, EntryDecl, ErrorDecl, FeatureDecl, MachineDecl, Name, ObjectDecl, Spec};
use crate::diag::{Code, Diagnostic, Diagnostics, codes};
use crate::library::shipped::LIBRARIES;
use crate::model::Index;
use crate::source::{FileId, Spanned};

/// The libraries of a specification; of what has one name or number in them, the first counts.
pub(super) struct Libraries<'a> {
    by_name: BTreeMap<&'a str, &'a Spec>,
    objects: BTreeMap<(FileId, Index), &'a ObjectDecl>,
    features: BTreeMap<&'a str, (&'a Spec, &'a FeatureDecl)>,
    /// The features that every device has.
    implied: Vec<&'a FeatureDecl>,
    machines: BTreeMap<(FileId, &'a str), &'a MachineDecl>,
    errors: OnceCell<BTreeMap<(FileId, u16), &'a ErrorDecl>>,
    /// The names of features by each of their words, in small letters.
    by_word: OnceCell<BTreeMap<String, Vec<&'a str>>>,
    all: &'a [Arc<Spec>],
}

impl<'a> Libraries<'a> {
    pub(super) fn of(all: &'a [Arc<Spec>]) -> Self {
        let mut libraries = Self {
            by_name: BTreeMap::new(),
            objects: BTreeMap::new(),
            features: BTreeMap::new(),
            implied: Vec::new(),
            machines: BTreeMap::new(),
            errors: OnceCell::new(),
            by_word: OnceCell::new(),
            all,
        };
        for library in all {
            if let Some(name) = &library.profile {
                libraries.by_name.entry(&name.value).or_insert(library);
            }
            for decl in &library.objects {
                libraries.objects.entry((library.file, decl.index.value)).or_insert(decl);
            }
            for feature in &library.features {
                libraries.features.entry(&feature.name.value).or_insert((library, feature));
                libraries.implied.extend(feature.implied.then_some(feature));
            }
            for machine in &library.machines {
                libraries.machines.entry((library.file, &machine.name.value)).or_insert(machine);
            }
        }
        libraries
    }

    /// Whether there are none.
    pub(super) const fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// The library of this name, which `from:` gives.
    pub(super) fn named(&self, from: &Name, diagnostics: &mut Diagnostics) -> Option<&'a Spec> {
        let found = self.by_name.get(from.value.as_str()).copied();
        if found.is_none() {
            let known = self.all.iter().filter_map(|library| Some(library.profile.as_ref()?.value.as_str()));
            if LIBRARIES.iter().any(|(name, _)| *name == from.value) {
                let message = format!("the library `{}` is not used here", from.value);
                diagnostics.push(not_used(codes::UNKNOWN_LIBRARY, from, message, &from.value));
                return None;
            }
            let otherwise = "name the library in `uses:` at the top of the file";
            unknown(codes::UNKNOWN_LIBRARY, from, "library", known, otherwise, diagnostics);
        }
        found
    }

    /// The name of the first library that has an object of this index, on any axis.
    pub(super) fn defining(&self, index: Index) -> Option<&'a str> {
        let defining = self.all.iter().find(|library| self.object(library, index).is_some());
        defining.and_then(|library| Some(library.profile.as_ref()?.value.as_str()))
    }

    /// An object as a library declares it.
    pub(super) fn written(&self, library: &Spec, index: Index) -> Option<&'a ObjectDecl> {
        self.objects.get(&(library.file, index)).copied()
    }

    /// What a library says about an object, on any axis.
    pub(super) fn object(&self, library: &Spec, index: Index) -> Option<ObjectDecl> {
        if let Some(decl) = self.written(library, index) {
            return Some(decl.clone());
        }
        let axes = library.axes?;
        let (axis, first) = axes.locate(index)?;
        on_axis(self.written(library, first)?, axes, axis)
    }

    /// The feature of a name, and its library.
    pub(super) fn feature(&self, name: &str) -> Option<(&'a Spec, &'a FeatureDecl)> {
        self.features.get(name).copied()
    }

    /// The features that every device has.
    pub(super) fn implied(&self) -> &[&'a FeatureDecl] {
        &self.implied
    }

    /// The names of all features, in the order of the libraries.
    pub(super) fn features(&self) -> impl Iterator<Item = &'a str> + Clone {
        let features = self.all.iter().flat_map(|library| &library.features);
        features.map(|feature| feature.name.value.as_str())
    }

    /// The features that have a word in their names.
    pub(super) fn features_with(&self, word: &str) -> &[&'a str] {
        let by_word = self.by_word.get_or_init(|| {
            let mut by_word: BTreeMap<String, Vec<&'a str>> = BTreeMap::new();
            for name in self.features() {
                let words: BTreeSet<String> = name.to_lowercase().split(' ').map(ToOwned::to_owned).collect();
                for word in words {
                    by_word.entry(word).or_default().push(name);
                }
            }
            by_word
        });
        by_word.get(&word.to_lowercase()).map_or(&[], Vec::as_slice)
    }

    /// The state machine of a name in a library.
    pub(super) fn machine(&self, library: &Spec, name: &str) -> Option<&'a MachineDecl> {
        self.machines.get(&(library.file, name)).copied()
    }

    /// What a library says about an error code.
    pub(super) fn error(&self, library: &Spec, code: u16) -> Option<&'a ErrorDecl> {
        let errors = self.errors.get_or_init(|| {
            let mut errors = BTreeMap::new();
            for library in self.all {
                for decl in &library.errors {
                    for code in decl.codes.value.codes() {
                        errors.entry((library.file, code)).or_insert(decl);
                    }
                }
            }
            errors
        });
        errors.get(&(library.file, code)).copied()
    }
}

/// Something of a built-in library that the specification does not use.
pub(super) fn not_used(code: &'static Code, name: &Name, message: String, library: &str) -> Diagnostic {
    Diagnostic::new(code, name.span, message)
        .help(format!("add `{library}` to `uses:` at the top of the file"))
}

/// A library lacks what `from:` takes from it.
pub(super) fn not_there(from: &Name, what: &str) -> Diagnostic {
    Diagnostic::new(
        codes::NOT_IN_LIBRARY,
        from.span,
        format!("library `{}` does not define {what}", from.value),
    )
}

/// An object of axis 1 on a further axis: `Controlword axis 2`.
pub(super) fn on_axis(decl: &ObjectDecl, axes: Axes, axis: u16) -> Option<ObjectDecl> {
    let index = axes.shift(decl.index.value, axis)?;
    if axis == 1 || index == decl.index.value {
        return Some(decl.clone());
    }
    let name = decl.entry.name.as_ref();
    let name = name.map(|name| Spanned::new(format!("{} axis {axis}", name.value), name.span));
    let shifted = |link: &Spanned<Index>| Some(Spanned::new(axes.shift(link.value, axis)?, link.span));
    let links = decl.links.as_ref().map(|links| links.iter().filter_map(shifted).collect());
    Some(ObjectDecl {
        index: Spanned::new(index, decl.index.span),
        links,
        entry: EntryDecl { name, ..decl.entry.clone() },
        ..decl.clone()
    })
}

//! Texts in several languages.

use std::collections::{BTreeMap, BTreeSet};

use roxmltree::Node;

use super::parameters::Parameter;
use super::tree::{Tree, children};
use crate::ast::{EntryDecl, Spec};
use crate::model::{EntryId, Index, SubIndex, Text};
use crate::source::{Span, Spanned};

/// An object as a whole, or one of its entries.
type Described = (Index, Option<SubIndex>);

/// Descriptions by object and entry, and the languages of a file.
pub(crate) struct Texts {
    /// The language that a comment of the translation is in.
    main: String,
    /// Other languages with their first text.
    others: BTreeSet<String>,
    place: Option<Span>,
    /// Of an object as a whole, or of its entries: texts in other languages.
    by_object: BTreeMap<Described, Vec<(String, String)>>,
}

impl Texts {
    /// No texts yet; the main language is the first that the file names and has texts in.
    pub(super) fn of(tree: Tree<'_>) -> Self {
        let described: BTreeSet<String> = tree
            .xml
            .descendants()
            .filter(|node| node.is_element() && node.tag_name().name() == "description")
            .filter_map(|node| language(tree, node))
            .collect();
        let stated = tree.first("ProfileBody").and_then(|body| tree.attribute(body, "supportedLanguages"));
        let named = stated.map_or("", |stated| stated.value).split_whitespace().map(code);
        let main = named.into_iter().find(|name| described.contains(name));
        let english = || "en".to_owned();
        let first = || described.first().filter(|_| !described.contains("en")).cloned();
        let main = main.or_else(first).unwrap_or_else(english);
        Self {
            main,
            others: BTreeSet::new(),
            place: stated.map(|stated| stated.span),
            by_object: BTreeMap::new(),
        }
    }

    /// The lines of the description in the main language; keeps those in others.
    pub(super) fn lines<'x>(
        &mut self,
        tree: Tree<'x>,
        of: Described,
        parameter: Parameter<'_, 'x>,
    ) -> Vec<&'x str> {
        let mut lines = Vec::new();
        for description in children(parameter.node, "description") {
            let Some(text) = tree.text(description) else { continue };
            let language = language(tree, description).unwrap_or_else(|| self.main.clone());
            if language == self.main {
                lines.extend(text.value.lines().map(str::trim).filter(|line| !line.is_empty()));
            } else {
                self.others.insert(language.clone());
                self.by_object.entry(of).or_default().push((language, text.value.to_owned()));
            }
        }
        lines
    }

    /// Gives a declaration the languages of its texts; comments alone are taken as English.
    pub(crate) fn add_to(&self, spec: &mut Spec) {
        if self.others.is_empty() && self.main == "en" {
            return;
        }
        let place = self.place.unwrap_or(spec.span);
        let languages = std::iter::once(&self.main).chain(&self.others);
        spec.languages = languages.map(|language| Spanned::new(language.clone(), place)).collect();
        for object in &mut spec.objects {
            let index = object.index.value;
            self.translate(&mut object.entry, (index, None));
            for (sub, entry) in object.entries_mut() {
                self.translate(entry, (index, Some(sub)));
            }
        }
    }

    fn translate(&self, entry: &mut EntryDecl, of: Described) {
        let others = self.by_object.get(&of).map_or(&[][..], Vec::as_slice);
        let others = others.iter().map(|(language, text)| (language.as_str(), text.as_str()));
        if let Some(about) = &mut entry.about {
            let main = about.value.get("en").map(str::to_owned);
            let main = main.iter().map(|text| (self.main.as_str(), text.as_str()));
            about.value = Text::new(main.chain(others));
        } else if !self.by_object.get(&of).is_none_or(Vec::is_empty) {
            entry.about = Some(Spanned::new(Text::new(others), entry.span));
        }
        if let Some(warning) = &mut entry.warning {
            let text = warning.value.get("en").unwrap_or_default().to_owned();
            warning.value = Text::new([(self.main.as_str(), text.as_str())]);
        }
    }
}

/// Where the texts of an entry are kept: a VAR is its object.
pub(super) const fn key_of(id: EntryId, is_sub: bool) -> Described {
    (id.index, if is_sub { Some(id.sub) } else { None })
}

fn language<'x>(tree: Tree<'x>, node: Node<'x, 'x>) -> Option<String> {
    tree.attribute(node, "lang").map(|lang| code(lang.value)).filter(|code| code.len() == 2)
}

/// The language of a code that may name a country, too: `en-us` is English.
fn code(lang: &str) -> String {
    lang.split(['-', '_']).next().unwrap_or_default().to_ascii_lowercase()
}

//! Documentation comments: what the manual says about an object, in a few lines.

use std::fmt::Write as _;

use od_spec::model::{BitErrors, Entry, Object, Outside, SubIndex, Text};
use od_spec::wording::{Notation, Wording};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::plan::{Plan, PlannedEntry, PlannedObject, Shape};

/// How the documentation words facts.
pub(super) const WORDING: Wording = Wording::english(Notation::Rust);

/// `#[doc]` attributes, one for each line.
pub(super) fn doc(text: &str) -> TokenStream {
    let lines = text.lines().map(|line| if line.is_empty() { String::new() } else { format!(" {line}") });
    let lines = lines.map(|line| raw(&line).unwrap_or_else(|| Literal::string(&line)));
    quote!(#(#[doc = #lines])*)
}

/// A literal without escapes: documentation is a large part of the code, and a printer without optimisations spends much of its
/// time on reading escapes.
fn raw(line: &str) -> Option<Literal> {
    use std::str::FromStr as _;
    (!line.contains(['"', '\r', '\0'])).then(|| Literal::from_str(&format!("r\"{line}\"")).ok()).flatten()
}

/// Text in which nothing is markup: rustdoc takes brackets for links and angles for tags.
pub(super) fn escape(text: &str) -> String {
    text.chars().fold(String::with_capacity(text.len()), |mut out, c| {
        if matches!(c, '[' | ']' | '<' | '>' | '*' | '_' | '`' | '\\') {
            out.push('\\');
        }
        out.push(if c.is_control() { ' ' } else { c });
        out
    })
}

impl Plan<'_> {
    /// A text in the language of the specification.
    pub(super) fn words(&self, text: &Text) -> String {
        text.get(self.system.language()).map(escape).unwrap_or_default()
    }

    /// The danger that comes from an object or entry, as a paragraph.
    fn warning(&self, warning: &Text) -> String {
        let warning = self.words(warning);
        if warning.is_empty() { warning } else { format!("\n\n**Warning:** {warning}") }
    }

    /// Heading, meaning and facts of an entry; `root` begins the paths of links.
    pub(super) fn entry_doc(&self, planned: &PlannedEntry<'_>, root: &str) -> String {
        let entry = planned.entry;
        let mut text = format!("`{}` {}", planned.id, escape(&entry.name));
        let about = self.words(&entry.about);
        text.push_str(if about.is_empty() { "." } else { ": " });
        text.push_str(&about);
        text.push_str(&self.warning(&entry.warning));
        text.push_str("\n\n");
        text.push_str(&self.facts_doc(planned, root));
        text
    }

    /// Facts of an entry, and its relations to others.
    fn facts_doc(&self, planned: &PlannedEntry<'_>, root: &str) -> String {
        sentences(&facts(planned), &self.relations(planned, root))
    }

    /// Relations of an entry to others, a sentence each.
    fn relations(&self, planned: &PlannedEntry<'_>, root: &str) -> Vec<String> {
        let relations = [
            self.related(planned, root),
            self.pdos_of(planned, root),
            condition(planned.entry),
            errors(planned.entry),
        ];
        relations.into_iter().flatten().collect()
    }

    /// What is the same for all elements of an array, and then what is not, for each run of equal elements.
    pub(super) fn elements_doc(&self, elements: &[&PlannedEntry<'_>], root: &str) -> String {
        /// More of them hide the accessor; the documents have a row for each element.
        const MOST_RUNS: usize = 8;
        let common = common(elements.iter().copied());
        let mut runs: Vec<(SubIndex, SubIndex, String)> = Vec::new();
        for element in elements {
            let mut own = facts(element);
            own.retain(|fact| !common.contains(fact));
            let (text, sub) = (sentences(&own, &self.relations(element, root)), element.id.sub);
            match runs.last_mut() {
                Some((_, last, same)) if *same == text => *last = sub,
                _ => runs.push((sub, sub, text)),
            }
        }
        let text = sentences(&common, &[]);
        match runs.as_slice() {
            [] => text,
            [(_, _, own)] => [text.as_str(), own].join(" ").trim_end().to_owned(),
            runs if runs.len() > MOST_RUNS => {
                format!("{text} Each element differs in what else is said of it.")
            }
            runs => {
                let lines = runs.iter().filter(|(_, _, own)| !own.is_empty()).map(|(first, last, own)| {
                    let to = if first == last { String::new() } else { format!(" to {last}") };
                    format!("- Sub-index {first}{to}: {own}")
                });
                format!("{text}\n\n{}", lines.collect::<Vec<_>>().join("\n"))
            }
        }
    }

    /// What is said of a member that several objects have: what is the same for all of them.
    pub(super) fn shared_doc<'p>(
        &self,
        first: &PlannedEntry<'_>,
        others: impl Iterator<Item = &'p PlannedEntry<'p>>,
    ) -> String {
        let common = common(others);
        let mut text = format!("Sub-index {}: {}", first.id.sub, escape(&first.entry.name));
        let about = self.words(&first.entry.about);
        if !about.is_empty() {
            text.push_str(": ");
            text.push_str(&about);
        }
        let end = if text.ends_with('.') { "" } else { "." };
        let warning = self.warning(&first.entry.warning);
        format!("{text}{end}{warning}\n\n{}.", common.join(", "))
    }

    /// Heading and meaning of an object whose group others have, too, and the facts of its members.
    pub(super) fn object_with_members_doc(&self, object: &PlannedObject<'_>, root: &str) -> String {
        let members = self.accessible(object).map(|planned| {
            let text = format!(
                "- `{}` {}: {}",
                planned.id,
                escape(&planned.entry.name),
                self.facts_doc(planned, root)
            );
            text + "\n"
        });
        format!("{}\n\n{}", self.object_doc(object.object), members.collect::<Vec<_>>().concat().trim_end())
    }

    /// Heading, meaning and warning of an object that is more than one entry.
    pub(super) fn object_doc(&self, object: &Object) -> String {
        self.object_heading(object) + &self.object_warning(object)
    }

    /// The same of an array whose elements are read by their sub-index, and the facts of these.
    pub(super) fn object_with_elements_doc(&self, object: &Object, elements: &[&PlannedEntry<'_>]) -> String {
        format!(
            "{} `sub` is the sub-index, 1 to {}; `None` for any other.{}\n\n{}",
            self.object_heading(object),
            elements.len(),
            self.object_warning(object),
            self.elements_doc(elements, "")
        )
    }

    fn object_heading(&self, object: &Object) -> String {
        let about = self.words(&object.about);
        let end = if about.is_empty() { "." } else { ": " };
        format!("`{}` {}{end}{about}", object.index, escape(&object.name))
    }

    /// The danger that comes from an object as a whole; the only entry of a VAR states it itself.
    fn object_warning(&self, object: &Object) -> String {
        if object.is_structured() { self.warning(&object.warning) } else { String::new() }
    }

    /// What shows the entry, or what it shows.
    fn related(&self, planned: &PlannedEntry<'_>, root: &str) -> Option<String> {
        let row = self.row(planned.id)?;
        if let Some(alias) = self.aliases.iter().find(|alias| alias.row == row) {
            let target = self.entry(alias.target)?;
            let mut text = format!("A view of {} (`{}`)", self.link(alias.target, root)?, target.id);
            if alias.numerator != 1 || alias.denominator != 1 {
                let rounding = WORDING.rounding(alias.rounding);
                let (numerator, denominator) = (alias.numerator, alias.denominator);
                let _ = write!(text, ", times {numerator}/{denominator}, {rounding}");
            }
            let (low, high) = alias.data_type.range()?;
            let _ = match alias.outside {
                Outside::Saturate => write!(text, "; saturates at {low} and {high}."),
                Outside::Wrap => write!(text, "; outside its type, its low bits."),
                Outside::Abort => write!(text, "; nothing outside its type."),
            };
            return Some(text);
        }
        let mut views = self.aliases.iter().filter(|alias| alias.target == row).filter_map(|alias| {
            let bits = alias.data_type.bits()?;
            Some(format!(
                "{bits}-bit view: {} (`{}`).",
                self.link(alias.row, root)?,
                self.entry(alias.row)?.id
            ))
        });
        views.next().map(|first| views.fold(first, |text, view| format!("{text} {view}")))
    }

    /// A link to the accessor of an entry.
    fn link(&self, row: u16, root: &str) -> Option<String> {
        let planned = self.entry(row)?;
        let object = self.objects.get(planned.object)?;
        Some(match &object.shape {
            Shape::Group { type_name } => {
                format!("[`{0}`]({root}records::{type_name}::{0})", planned.member)
            }
            Shape::Var | Shape::Indexed { .. } => format!("[`{0}`]({root}{1}::{0})", object.name, self.name),
        })
    }

    /// The PDOs that carry the entry by default.
    fn pdos_of(&self, planned: &PlannedEntry<'_>, root: &str) -> Option<String> {
        let row = self.row(planned.id)?;
        let carriers = self.pdos.iter().filter(|pdo| pdo.fields.iter().any(|field| field.row == row));
        let names: Vec<String> = carriers
            .map(|pdo| {
                let off = if pdo.pdo.valid { "" } else { ", off by default" };
                let (direction, number, name) = (pdo.pdo.direction.pdo(), pdo.pdo.number, &pdo.name);
                format!("{direction} {number} ([`{name}`]({root}pdos::{name}){off})")
            })
            .collect();
        (!names.is_empty()).then(|| format!("In {}.", names.join(", ")))
    }
}

fn condition(entry: &Entry) -> Option<String> {
    let condition = entry.writable_when.as_ref()?;
    Some(format!("Writable while `{}`.", condition.text))
}

/// The errors that the entry shows in addition to those of its type.
fn errors(entry: &Entry) -> Option<String> {
    let of_bit = |errors: &BitErrors| {
        let codes: Vec<String> = errors.error_codes().map(|code| format!("{code:04X}h")).collect();
        format!("{} at bit {}", codes.join(" and "), errors.bit)
    };
    let bits: Vec<String> = entry.bit_errors.iter().map(of_bit).collect();
    (!bits.is_empty()).then(|| format!("Errors: {}.", bits.join(", ")))
}

/// The facts of an entry, in text that is not markup.
fn facts(planned: &PlannedEntry<'_>) -> Vec<String> {
    crate::facts::facts(planned, WORDING, escape)
}

/// The facts that are the same for all of some entries, in the order of the first.
fn common<'p>(entries: impl Iterator<Item = &'p PlannedEntry<'p>>) -> Vec<String> {
    let common = entries.map(facts).reduce(|mut common, its| {
        common.retain(|fact| its.contains(fact));
        common
    });
    common.unwrap_or_default()
}

/// Facts in one sentence, and others after it.
fn sentences(facts: &[String], more: &[String]) -> String {
    let mut text = facts.join(", ");
    if !text.is_empty() {
        text.push('.');
    }
    for sentence in more {
        if !text.is_empty() {
            text.push(' ');
        }
        text.push_str(sentence);
    }
    text
}

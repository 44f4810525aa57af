//! The printed manual: issues, sections, tables, errata.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use super::figures::Figures;
use super::numbers::to_u16;
use super::places::{self, Places};
use super::refs::{Broken, NamesOf};
use super::table_content::Contents;
use super::types::{phrases, words};
use super::varied::Varied;
use super::{printed_order, unprinted};
use crate::ast::{CodeRange, ContentDecl, IssueDecl, Name, Named, PartDecl, SectionDecl, Spec};
use crate::decode::lexical;
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::limits;
use crate::model::{
    BitTable, Content, Devices, Dictionary, Document, Erratum, ErratumKind, ErratumPlace, Figure, Index,
    Issue, LadderTable, PdoTable, Prose, ProseKind, Section, System, Table, TableContent,
};
use crate::running_text::Numbered;
use crate::source::{Span, Spanned};

pub(super) fn resolve(root: &Spec, figures: &Figures<'_, '_>, diagnostics: &mut Diagnostics) -> Document {
    let source = root.source.as_ref();
    Document {
        source: source.and_then(|source| {
            let title = source.title.as_ref()?.value.clone();
            Some(match &source.edition {
                Some(edition) => format!("{title}, {}", edition.value),
                None => title,
            })
        }),
        subtitle: source.map(|source| words(&source.subtitle)).unwrap_or_default(),
        address: source.map(|source| words(&source.address)).unwrap_or_default(),
        about: source.map(|source| words(&source.about)).unwrap_or_default(),
        revision: root.revision.as_ref().and_then(issue),
        history: root.history.iter().filter_map(issue).collect(),
        glossary: root.glossary.iter().map(|(name, text)| (name.value.clone(), text.clone())).collect(),
        sections: root.sections.iter().map(|decl| section(decl, figures, diagnostics)).collect(),
    }
}

fn issue(decl: &IssueDecl) -> Option<Issue> {
    let (number, date) = (decl.number.as_ref()?.value.clone(), decl.date.as_ref()?.value);
    Some(Issue { number, date, about: words(&decl.about) })
}

fn section(decl: &SectionDecl, figures: &Figures<'_, '_>, diagnostics: &mut Diagnostics) -> Section {
    let mut section = Section {
        number: decl.number.as_ref().map_or(String::new(), |number| number.value.clone()),
        title: words(&decl.title),
        tables: Vec::new(),
        content: Vec::new(),
        search: phrases(decl.search.as_ref()),
    };
    for part in &decl.content {
        match part.contents.first().map(|content| &content.value) {
            Some(ContentDecl::Prose(kind, items)) => {
                let warns_for = part.warns_for.iter().map(|index| index.value).collect();
                section.content.push(Content::Prose(Prose { kind: *kind, items: items.clone(), warns_for }));
            }
            Some(content) => {
                if let Some(table) = table(part, content, figures, diagnostics) {
                    section.content.push(Content::Table(section.tables.len()));
                    section.tables.push(table);
                }
            }
            None => {}
        }
    }
    section
}

fn table(
    decl: &PartDecl,
    content: &ContentDecl,
    figures: &Figures<'_, '_>,
    diagnostics: &mut Diagnostics,
) -> Option<Table> {
    let indices = |list: &[Spanned<Index>]| list.iter().map(|index| index.value).collect();
    let content = match content {
        // It is not a table.
        ContentDecl::Prose(..) => return None,
        ContentDecl::Overview(list) => TableContent::Overview(indices(list)),
        ContentDecl::Objects(list) => TableContent::Objects(indices(list)),
        ContentDecl::Bits { named_type, masks } => TableContent::Bits(BitTable {
            named_type: named_type.as_ref()?.value.clone(),
            masks: masks.as_ref().and_then(|masks| u8::try_from(masks.value).ok()),
        }),
        ContentDecl::Values(name) => TableContent::Values(name.value.clone()),
        ContentDecl::Errors(list) => TableContent::Errors(error_codes(list)),
        ContentDecl::Reactions(list) => TableContent::Reactions(error_codes(list)),
        ContentDecl::States(name) => TableContent::States(name.value.clone()),
        ContentDecl::Transitions(name) => TableContent::Transitions(name.value.clone()),
        ContentDecl::Commands(name) => TableContent::Commands(name.value.clone()),
        ContentDecl::Ladder { constraint, labels } => TableContent::Ladder(LadderTable {
            constraint: constraint.as_ref()?.value.clone(),
            labels: labels.as_ref().map_or_else(Vec::new, |labels| labels.value.clone()),
        }),
        ContentDecl::Timing(decl) => TableContent::Timing(figures.timing(decl, diagnostics)?),
        ContentDecl::Hysteresis(decls) => TableContent::Hysteresis(figures.switches(decls, diagnostics)?),
        ContentDecl::Flow(decls) => TableContent::Flow(figures.flow(decls, diagnostics)?),
        ContentDecl::Axis(decl) => TableContent::Axis(figures.axis(decl, diagnostics)?),
        ContentDecl::Pdos { device, direction } => {
            let (device, direction) = (device.as_ref()?.value.clone(), direction.as_ref()?.value);
            TableContent::Pdos(PdoTable { device, direction })
        }
        ContentDecl::Rows { columns, rows } => TableContent::Rows {
            columns: columns.clone(),
            rows: rows.iter().map(|row| row.value.clone()).collect(),
        },
        ContentDecl::Glossary => TableContent::Glossary,
        ContentDecl::History => TableContent::History,
    };
    let number = decl.number.as_ref().map(|number| to_u16(number.value));
    let title = words(&decl.title);
    let figure = decl.figure.as_ref().and_then(|figure| {
        let number = to_u16(figure.value.number.as_ref()?.value);
        let own = words(&figure.value.title);
        Some(Figure { number, title: if own.is_empty() { title.clone() } else { own } })
    });
    let order = decl.order.iter().flat_map(|order| &order.value).map(|number| number.value).collect();
    are_columns(&decl.columns, content.columns(), diagnostics);
    let columns = decl.columns.iter().map(|column| column.value.clone()).collect();
    Some(Table { number, title, figure, content, columns, order })
}

/// Reports the keys of columns that no such table has.
fn are_columns(written: &[Name], known: &[&str], diagnostics: &mut Diagnostics) {
    for column in written.iter().filter(|column| !known.contains(&column.value.as_str())) {
        let message = format!("the table has no column `{}`", shorten(&column.value));
        let list = known.iter().map(|key| format!("`{key}`")).collect::<Vec<_>>().join(", ");
        let meant = diagnostics.suggestions.nearest(&column.value, known.iter().copied());
        let diagnostic = Diagnostic::new(codes::UNKNOWN_REFERENCE, column.span, message);
        diagnostics.push(match meant {
            Some(word) => diagnostic.did_you_mean(word),
            None => diagnostic.help(format!("its columns are {list}")),
        });
    }
}

/// Codes of a list; `all` is the empty list.
fn error_codes(list: &[Name]) -> Vec<u16> {
    list.iter().filter_map(|code| lexical::error_codes(&code.value)).flat_map(CodeRange::codes).collect()
}

pub(super) fn errata(
    root: &Spec,
    system: &System,
    names: &NamesOf<'_>,
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) -> Vec<Erratum> {
    let mut errata = Vec::new();
    let varied = Varied::of(root);
    let places = Places::of(&system.document);
    // Without tables, the document is not described.
    let is_described = system.document.tables().next().is_some();
    let mut room = limits::TABLES_OF_ERRATA;
    for decl in &root.errata {
        let on = Devices::listed(decl.devices.iter().flatten().map(|key| key.value.as_str()));
        let mut at = Vec::new();
        for reference in &decl.at {
            if let Some(place) = place(reference, &on, names, broken, diagnostics) {
                let keys = names.each(&on).map(|(device, _)| device.key.as_str());
                let help = "say in `devices:` for which device it is";
                varied.is_refused(place.index(), reference.span, keys, help, diagnostics);
                at.push(place);
            }
        }
        let place = words(&decl.place);
        let named = places::read(place.get(system.language()).unwrap_or_default(), &at, &places);
        let Some(rest) = room.checked_sub(named.tables.len()) else {
            if let Some(place) = &decl.place {
                let message =
                    format!("the places of the errata name more than {} tables", limits::TABLES_OF_ERRATA);
                diagnostics.push(Diagnostic::new(codes::TOO_MUCH, place.span, message).help(
                    "name the tables where something differs; what holds for the whole manual names none",
                ));
            }
            break;
        };
        room = rest;
        if is_described
            && let Some((kind, number)) = named.unknown
            && let Some(span) = decl.place.as_ref().map(|place| place.span)
        {
            let (title, word) = (kind.title(), kind.word());
            diagnostics.push(
                Diagnostic::new(codes::UNKNOWN_REFERENCE, span, format!("there is no {title} {number}"))
                    .help(format!("correct the number, or add the {word} to `document:`")),
            );
        }
        if let (Some(prints), Some(reads)) = (&decl.prints, &decl.reads)
            && prints.value == reads.value
            && decl.kind.as_ref().is_some_and(|kind| is_always_stated(kind.value))
        {
            diagnostics.push(
                Diagnostic::new(codes::NO_CHANGE, reads.span, "this is what the manual prints")
                    .with(prints.span, "it is here")
                    .help("say how the manual is read, or remove the erratum"),
            );
        }
        let Some(kind) = decl.kind else { continue };
        let unprinted = unprinted::of(decl, kind.value, &at, system, diagnostics);
        let devices = if decl.devices.is_some() { on } else { owners(&at, system) };
        errata.push(Erratum {
            at,
            devices,
            kind: kind.value,
            place,
            prints: words(&decl.prints),
            reads: words(&decl.reads),
            because: words(&decl.because),
            tables: named.tables,
            unprinted,
        });
    }
    errata
}

/// Whether every manual has to print the fact: an erratum about another one may say that nothing is printed, and nothing assumed.
const fn is_always_stated(kind: ErratumKind) -> bool {
    match kind {
        ErratumKind::Index
        | ErratumKind::Name
        | ErratumKind::Type
        | ErratumKind::Sign
        | ErratumKind::Access
        | ErratumKind::ObjectType
        | ErratumKind::SubIndex
        | ErratumKind::Count => true,
        ErratumKind::Default
        | ErratumKind::Limit
        | ErratumKind::Unit
        | ErratumKind::Pdo
        | ErratumKind::Stored
        | ErratumKind::Bits
        | ErratumKind::Values
        | ErratumKind::Table
        | ErratumKind::Text
        | ErratumKind::Gap
        | ErratumKind::Profile => false,
    }
}

/// The devices that have one of the places; all, if none is named.
fn owners(at: &[ErratumPlace], system: &System) -> Devices {
    let has = |device: &Dictionary| {
        at.iter().any(|place| match place {
            ErratumPlace::Object(index) => device.objects.contains_key(index),
            ErratumPlace::Entry(id) => device.entry(*id).is_some(),
        })
    };
    let owners: Vec<&Dictionary> = system.devices.iter().filter(|device| has(device)).collect();
    if owners.len() == system.devices.len() {
        return Devices::All;
    }
    Devices::listed(owners.iter().map(|device| device.key.as_str()))
}

fn place(
    reference: &Name,
    on: &Devices,
    names: &NamesOf<'_>,
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) -> Option<ErratumPlace> {
    if let Some(entry) = lexical::entry_by_index(&reference.value) {
        let mut objects = names.objects(on, entry.index).into_iter();
        if objects.any(|object| entry.sub.is_none_or(|sub| object.entry(sub).is_some())) {
            return Some(match entry.sub {
                Some(_) => ErratumPlace::Entry(entry.id()),
                None => ErratumPlace::Object(entry.index),
            });
        }
    }
    // By name, or wrong: the name lookup reports it.
    let id = names.find(on, reference, broken, diagnostics)?;
    Some(if id.sub.0 == 0 { ErratumPlace::Object(id.index) } else { ErratumPlace::Entry(id) })
}

/// Checks what the tables refer to.
pub(super) fn check(root: &Spec, system: &System, broken: &Broken, diagnostics: &mut Diagnostics) {
    let mut tables: BTreeMap<i128, Span> = BTreeMap::new();
    let mut figures: BTreeMap<i128, Span> = BTreeMap::new();
    let mut sections: BTreeMap<&str, Span> = BTreeMap::new();
    let contents = Contents::of(root, system, broken);
    for number in root.sections.iter().filter_map(|section| section.number.as_ref()) {
        is_new("section", number.value.as_str(), number, &mut sections, diagnostics);
    }
    named_in_texts(root, system, diagnostics);
    for decl in root.sections.iter().flat_map(|section| &section.content) {
        if let Some(number) = &decl.number {
            is_new("table", number.value, number, &mut tables, diagnostics);
        }
        if let Some(number) = decl.figure.as_ref().and_then(|figure| figure.value.number.as_ref()) {
            is_new("figure", number.value, number, &mut figures, diagnostics);
        }
        // None or several were reported by the keys of a text or table.
        let [content] = decl.contents.as_slice() else { continue };
        contents.check(&content.value, diagnostics);
        printed_order::check(decl, content, system, diagnostics);
        contents.objects(&decl.warns_for, diagnostics);
        let is_warning = matches!(content.value, ContentDecl::Prose(ProseKind::Warning, _));
        if let Some(first) = decl.warns_for.first().filter(|_| !is_warning) {
            diagnostics.push(
                Diagnostic::new(codes::CONFLICTING_KEYS, first.span, "`for` has no effect without `warning`")
                    .with(content.span, "the content is here")
                    .help("remove the key; only a `warning` has objects"),
            );
        }
        let is_prose = matches!(content.value, ContentDecl::Prose(..));
        if let Some(figure) = decl.figure.as_ref().filter(|_| !is_prose && !is_drawn(&content.value)) {
            let message = "nothing is drawn of this content, so that it is not a figure";
            diagnostics.push(
                Diagnostic::new(codes::CONFLICTING_KEYS, figure.span, message)
                    .with(content.span, "the content is here")
                    .help("remove the key; it belongs to `bits`, `states`, `ladder`, `timing`, `hysteresis`, `flow` and `axis`"),
            );
        }
        if let (ContentDecl::Prose(kind, _), Some((table, what))) = (&content.value, of_table(decl)) {
            let message = format!("`{}` has {what}", kind.word());
            diagnostics.push(
                Diagnostic::new(codes::CONFLICTING_KEYS, table, message)
                    .with(content.span, "a text is here")
                    .help("remove the key; it belongs to tables"),
            );
        }
    }
}

/// The place of the first key that only tables have, and what a text has not.
fn of_table(decl: &PartDecl) -> Option<(Span, &'static str)> {
    if let Some(column) = decl.columns.first() {
        return Some((column.span, "no columns"));
    }
    let number = decl.number.as_ref().map(|number| number.span);
    let of_both = number.or_else(|| decl.title.as_ref().map(|title| title.span));
    let figure = decl.figure.as_ref().map(|figure| (figure.span, "no picture"));
    of_both.map(|span| (span, "neither number nor title")).or(figure)
}

/// Reports a number that was used before.
fn is_new<N: Ord + Copy + fmt::Display, T>(
    what: &str,
    number: N,
    place: &Spanned<T>,
    before: &mut BTreeMap<N, Span>,
    diagnostics: &mut Diagnostics,
) {
    if let Some(before) = before.insert(number, place.span) {
        let message = format!("{what} {} is written twice", shorten(&number.to_string()));
        diagnostics.push(
            Diagnostic::new(codes::DUPLICATE_VALUE, place.span, message)
                .label("again here")
                .with(before, "first here")
                .help(format!("give each {what} a number of its own")),
        );
    }
}

/// Reports what texts name and the manual or the devices do not have.
fn named_in_texts(root: &Spec, system: &System, diagnostics: &mut Diagnostics) {
    let mut numbered: BTreeSet<(Numbered, String)> = BTreeSet::new();
    for section in &system.document.sections {
        numbered.insert((Numbered::Section, section.number.trim_end_matches('.').to_owned()));
        for table in &section.tables {
            numbered.extend(table.number.map(|number| (Numbered::Table, number.to_string())));
            let figure = table.figure.as_ref().map(|figure| figure.number.to_string());
            numbered.extend(figure.map(|number| (Numbered::Figure, number)));
        }
    }
    // What is not described at all is described elsewhere.
    let is_described =
        |kind: Numbered| numbered.iter().any(|(one, number)| *one == kind && !number.is_empty());
    let described =
        [Numbered::Table, Numbered::Figure, Numbered::Section].map(|kind| (kind, is_described(kind)));
    for mention in &root.mentions {
        let (what, help) = match &mention.named {
            Named::Numbered(kind, number) => {
                let key = (*kind, number.clone());
                if !described.contains(&(*kind, true)) || numbered.contains(&key) {
                    continue;
                }
                let help = "correct the number, or name the document that has it before it";
                (format!("{} {}", kind.word(), shorten(number)), help)
            }
            Named::Object(index) => {
                let mut devices = system.devices.iter().peekable();
                if devices.peek().is_none() || devices.any(|device| device.objects.contains_key(index)) {
                    continue;
                }
                (format!("object {index}"), "correct the index; no device of the specification has it")
            }
        };
        let message = format!("there is no {what}");
        diagnostics.push(Diagnostic::new(codes::NAMED_IN_TEXT, mention.place, message).help(help));
    }
}

/// Whether the documents draw a picture of a content.
const fn is_drawn(content: &ContentDecl) -> bool {
    match content {
        ContentDecl::Bits { .. }
        | ContentDecl::States(_)
        | ContentDecl::Ladder { .. }
        | ContentDecl::Timing(_)
        | ContentDecl::Hysteresis(_)
        | ContentDecl::Flow(_)
        | ContentDecl::Axis(_) => true,
        ContentDecl::Prose(..)
        | ContentDecl::Overview(_)
        | ContentDecl::Objects(_)
        | ContentDecl::Values(_)
        | ContentDecl::Errors(_)
        | ContentDecl::Reactions(_)
        | ContentDecl::Transitions(_)
        | ContentDecl::Commands(_)
        | ContentDecl::Pdos { .. }
        | ContentDecl::Rows { .. }
        | ContentDecl::Glossary
        | ContentDecl::History => false,
    }
}

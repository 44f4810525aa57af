//! A table of objects as a specification.

use std::collections::{BTreeMap, BTreeSet};

use od_import::yaml::{self, Options, Place};
use od_spec::diag::{Diagnostic, Diagnostics, Severity, codes};
use od_spec::model::{Dictionary, Fact, Index, ObjectKind, System};
use od_spec::source::{SourceMap, Span, Spanned};
use od_spec::{NoFiles, compile};

use crate::asked::{Asked, quoted};
use crate::columns::Assigned;
use crate::draft::{About, Draft, MANDATORY, covers, entry_id};
use crate::export::{Value, pdo_rows};
use crate::facts::{EntryFacts, Facts, ListAt, ListOf, ObjectFacts};
use crate::read::{self, Notation};
use crate::settle::{settle, shape};
use crate::understand::Reader;

/// A specification that was made from tables.
#[derive(Debug)]
#[non_exhaustive]
pub struct Imported {
    /// The text; it compiles.
    pub specification: yaml::Specification,
    /// How many objects the tables have.
    pub objects: usize,
    /// How many cells and rows were not understood; the text has a comment for each.
    pub asked: usize,
    /// What was not understood, and where.
    pub diagnostics: Diagnostics,
}

/// Makes the specification of the tables in a file, whose texts are added to `sources`. `name` is that of the file,
/// `title` that of the device where no table has another.
///
/// # Errors
/// The file cannot be read, has no table of objects, or nothing of it makes a specification.
pub fn import(
    sources: &mut SourceMap,
    name: &str,
    bytes: Vec<u8>,
    notation: Notation,
    columns: Option<&Assigned>,
    title: &str,
) -> Result<Imported, Diagnostics> {
    let refused = |diagnostic: Diagnostic| {
        let mut diagnostics = Diagnostics::new();
        diagnostics.push(diagnostic);
        diagnostics
    };
    let sheets = read::sheets(sources, name, bytes, notation).map_err(|one| refused(*one))?;
    let sources = &*sources;
    let mut facts = Facts::default();
    let mut asked = Asked::new(sources);
    for sheet in &sheets {
        let assigned = columns.map(|Assigned(header)| header);
        Reader { facts: &mut facts, asked: &mut asked, assigned }.read(sheet);
    }
    if facts.objects.is_empty() {
        return Err(refused(no_table(sources, name)));
    }
    settle(&mut facts, &mut asked);
    complete(&mut facts, &mut asked);
    let objects = facts.objects.len();
    let title: String =
        title.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_' | '.')).collect();
    let title = if title.trim().is_empty() { "device" } else { title.trim() };
    let system = accepted(&mut facts, &mut asked, title)
        .map_err(|problem| refused(*no_specification(name, &problem)))?;
    let Some(device) = system.devices.first() else { return Err(refused(no_table(sources, name))) };
    compare_pdos(&mut facts, &mut asked, device);
    let options = comments(facts, &system, name);
    let specification = yaml::specification(&system, device, &options)
        .map_err(|problem| refused(*no_specification(name, &problem)))?;
    Ok(Imported { specification, objects, asked: asked.cells(), diagnostics: asked.into_diagnostics() })
}

fn no_table(sources: &SourceMap, name: &str) -> Diagnostic {
    let message = format!("`{name}` has no table of objects that is understood");
    let help = "title the columns `Index`, `Name`, `Type`, `Access`, or say what they hold: `--columns \"Index=A, Name=C\"`";
    match sources.files().next() {
        Some((file, _)) => {
            Diagnostic::new(codes::NO_TABLE, sources.whole(file).part(0, 0), message).help(help)
        }
        None => Diagnostic::without_place(codes::NO_TABLE, message).help(help),
    }
}

/// The compiler refuses what is left of the tables; its places are in no file of the user.
fn no_specification(name: &str, problem: &Diagnostics) -> Box<Diagnostic> {
    let first = problem.iter().find(|one| one.severity() == Severity::Error);
    let reason = first.map_or_else(String::new, |first| format!(": {} ({})", first.message, first.code.id));
    let message = format!("the tables of `{name}` make no specification{reason}");
    Box::new(Diagnostic::without_place(codes::NO_TABLE, message).help("correct the table"))
}

/// Names what the tables leave without a name, and gives lists the type of their entries.
fn complete(facts: &mut Facts, asked: &mut Asked<'_>) {
    const HELP: &str = "complete the table, or the specification";
    identity(facts);
    for (index, object) in &mut facts.objects {
        let unnamed = |entry: &EntryFacts| entry.get(Fact::Name).is_none();
        let mut name = |entry: &mut EntryFacts, name: String| {
            let span = entry.span;
            let comment = asked.cell(span, &format!("there is no name for {name}"), HELP);
            entry.comments.push(comment);
            entry.stated.insert(Fact::Name, Spanned::new(name, span));
        };
        if unnamed(&object.own) {
            name(&mut object.own, format!("object {index:04X}h"));
        }
        for (sub, entry) in object.subs.iter_mut().filter(|(sub, _)| **sub != 0) {
            if unnamed(entry) {
                name(entry, format!("entry {sub}"));
            }
        }
    }
    let named: BTreeSet<ListOf> = facts.lists.iter().map(|list| list.of.clone()).collect();
    for entry in
        facts.objects.values_mut().flat_map(|object| object.subs.values_mut().chain([&mut object.own]))
    {
        let is_missing = |list: &Spanned<String>| !named.contains(&ListOf::Named(list.value.clone()));
        if let Some(list) = entry.list.take_if(|list| is_missing(list)) {
            let message =
                format!("there is no table of bits or values for the type name {}", quoted(&list.value));
            entry.comments.push(asked.cell(list.span, &message, HELP));
        }
    }
    let of_entry = |facts: &Facts, of: &ListOf| match of {
        ListOf::Entry(index, sub) => {
            let object = facts.objects.get(index)?;
            let entry = sub.and_then(|sub| object.subs.get(&sub)).unwrap_or(&object.own);
            entry.data_type.or(object.own.data_type)
        }
        ListOf::Named(name) => {
            let mut entries =
                facts.objects.values().flat_map(|object| object.subs.values().chain([&object.own]));
            entries.find(|entry| entry.list.as_ref().is_some_and(|list| list.value == *name))?.data_type
        }
    };
    let bases: Vec<_> =
        facts.lists.iter().map(|list| list.base.or_else(|| of_entry(facts, &list.of))).collect();
    let mut comments = Vec::new();
    for (list, base) in facts.lists.iter_mut().zip(bases) {
        list.base = base;
        if base.is_none() {
            let message = "a list of values or bits belongs to no entry with a type";
            comments.push((list.of.clone(), asked.cell(list.span, message, HELP)));
        } else if list.is_bits() && !covers(list) && matches!(list.of, ListOf::Entry(..)) {
            let place = asked.place(list.span);
            comments.push((
                list.of.clone(),
                format!("{place}: the bits that the table does not list are taken as reserved"),
            ));
        }
    }
    for (of, comment) in comments {
        comment_at_list(facts, &of, comment);
    }
}

/// The device is what its objects say, where no table of the device says it.
fn identity(facts: &mut Facts) {
    let of_objects = [
        ("device-type", 0x1000, 0),
        ("vendor number", 0x1018, 1),
        ("product", 0x1018, 2),
        ("product-revision", 0x1018, 3),
    ];
    for (key, index, sub) in of_objects {
        let Some(object) = facts.objects.get(&index) else { continue };
        let entry = if sub == 0 { Some(&object.own) } else { object.subs.get(&sub) };
        let value = entry.and_then(|entry| entry.get(Fact::Default));
        if let Some(value) = value.filter(|value| od_spec::scalar::integer(&value.value).is_ok()) {
            facts.device.entry(key.to_owned()).or_insert_with(|| value.clone());
        }
    }
}

/// Adds a comment where a list is used.
fn comment_at_list(facts: &mut Facts, of: &ListOf, comment: String) {
    if let ListOf::Entry(index, sub) = of
        && let Some(object) = facts.objects.get_mut(index)
    {
        let span = object.span;
        object.entry(*sub, span).comments.push(comment);
    } else {
        facts.comments.push(comment);
    }
}

/// Compiles what the tables say, and leaves out what the compiler refuses, until it takes the rest.
fn accepted(facts: &mut Facts, asked: &mut Asked<'_>, title: &str) -> Result<System, Diagnostics> {
    loop {
        let draft = Draft::of(facts, title);
        let mut sources = SourceMap::new();
        let root = sources.add("table.od.yaml", draft.text.as_str());
        let compiled = compile(&mut sources, root, &mut NoFiles);
        if let Some(system) = compiled.system {
            return Ok(system);
        }
        let mut is_less = false;
        let mut refused: BTreeMap<About, String> = BTreeMap::new();
        for error in compiled.diagnostics.iter().filter(|one| one.severity() == Severity::Error) {
            let place = error.labels.first().map(|label| label.span).filter(|span| span.file == root);
            let line = place.map(|span| sources.file(root).line_col(span.start).line - 1);
            let about = line.and_then(|line| draft.lines.get(line)).unwrap_or(&About::File).clone();
            // Of several messages about one line, the first may take the others with it.
            refused.entry(about).or_insert_with(|| format!("{} ({})", error.message, error.code.id));
        }
        // From the last one on, as those before it keep their places in their lists.
        for (about, problem) in refused.iter().rev() {
            is_less |= leave_out(facts, asked, about, problem);
        }
        let is_bare = |object: &ObjectFacts| {
            matches!(shape(object), ObjectKind::Array | ObjectKind::Record)
                && object.subs.keys().all(|sub| *sub == 0)
        };
        let bare: Vec<u16> =
            facts.objects.iter().filter(|(_, object)| is_bare(object)).map(|(index, _)| *index).collect();
        for index in bare {
            is_less |=
                leave_out(facts, asked, &About::Object(index), "it has no sub-index that is understood");
        }
        if !is_less {
            return Err(compiled.diagnostics);
        }
    }
}

/// Takes out what a line says, with a comment; `false` if there is nothing to take out.
fn leave_out(facts: &mut Facts, asked: &mut Asked<'_>, about: &About, problem: &str) -> bool {
    const HELP: &str = "correct the table, or complete the specification";
    let mut ask = |span: Span, what: &str| asked.cell(span, &format!("{what}: {problem}"), HELP);
    match about {
        About::File => false,
        About::Device(key) => facts.device.remove(key).is_some_and(|cell| {
            facts.comments.push(ask(cell.span, &format!("{key} {}", quoted(&cell.value))));
            true
        }),
        About::Unit(at, Some(key)) if *key != "symbol" => {
            facts.units.get_mut(*at).and_then(|unit| unit.keys.remove(key)).is_some_and(|cell| {
                facts.comments.push(ask(cell.span, &format!("{key} {}", quoted(&cell.value))));
                true
            })
        }
        About::Unit(at, _) => {
            let is_there = *at < facts.units.len();
            if is_there {
                let unit = facts.units.remove(*at);
                facts.comments.push(ask(unit.name.span, &format!("unit {}", quoted(&unit.name.value))));
            }
            is_there
        }
        About::List(at, Some(row)) => {
            let Some(list) = facts.lists.get_mut(*at).filter(|list| *row < list.rows.len()) else {
                return false;
            };
            let (gone, of) = (list.rows.remove(*row), list.of.clone());
            if let ListAt::Bits(bits) = &gone.at {
                list.rows.retain(|row| !matches!(&row.at, ListAt::ValueOfBits(of, _) if of == bits));
            }
            let name = gone.name.map(|name| name.value).unwrap_or_default();
            comment_at_list(facts, &of, ask(gone.span, &quoted(&name)));
            true
        }
        About::List(at, None) => {
            let is_there = *at < facts.lists.len();
            if is_there {
                let list = facts.lists.remove(*at);
                comment_at_list(facts, &list.of, ask(list.span, "a list of values or bits"));
            }
            is_there
        }
        About::Error(code) => facts.errors.remove(code).is_some_and(|error| {
            facts.comments.push(ask(error.span, &format!("error code {code:04X}h")));
            true
        }),
        About::Fact(index, sub, fact) => {
            let Some(object) = facts.objects.get_mut(index) else { return false };
            let (entry, span) = match sub {
                None => (&mut object.own, object.span),
                Some(sub) => match object.subs.get_mut(sub) {
                    Some(entry) => (entry, object.span),
                    None => return false,
                },
            };
            let gone = match fact {
                Fact::Type => match entry.list.take() {
                    Some(list) => Some((list.value, list.span)),
                    None => entry.data_type.take().map(|one| (one.value.to_string(), one.span)),
                },
                Fact::Access => entry.access.take().map(|one| (one.value.access.word().to_owned(), one.span)),
                Fact::About => (!entry.about.is_empty()).then(|| (String::new(), span)),
                Fact::Warning => (!entry.warning.is_empty()).then(|| (String::new(), span)),
                fact => entry.stated.remove(fact).map(|cell| (cell.value, cell.span)),
            };
            match fact {
                Fact::About => entry.about.clear(),
                Fact::Warning => entry.warning.clear(),
                _ => {}
            }
            match gone {
                Some((value, span)) => {
                    let shown = if value.is_empty() { String::new() } else { format!(" {}", quoted(&value)) };
                    entry.comments.push(ask(span, &format!("{}{shown}", fact.word())));
                    true
                }
                // The type of a list that is attached to the entry.
                None => false,
            }
        }
        About::Entry(index, Some(sub)) => {
            let Some(object) = facts.objects.get_mut(index) else { return false };
            object.subs.remove(sub).is_some_and(|entry| {
                let name = entry.get(Fact::Name).map_or("", |name| name.value.as_str());
                object.own.comments.push(ask(entry.span, &format!("sub-index {sub} {}", quoted(name))));
                object.own.comments.extend(entry.comments);
                true
            })
        }
        About::Object(index) | About::Entry(index, None) => {
            facts.objects.remove(index).is_some_and(|object| {
                let name = object.own.get(Fact::Name).map_or("", |name| name.value.as_str());
                facts.comments.push(ask(object.span, &format!("{index:04X}h {}", quoted(name))));
                let entries = std::iter::once(object.own).chain(object.subs.into_values());
                facts.comments.extend(entries.flat_map(|entry| entry.comments));
                true
            })
        }
    }
}

/// Asks about rows of tables of PDOs that the objects contradict: the objects count.
fn compare_pdos(facts: &mut Facts, asked: &mut Asked<'_>, device: &Dictionary) {
    let known: BTreeSet<Vec<String>> =
        pdo_rows(device).iter().map(|row| filled(row.iter().map(Value::text))).collect();
    for row in std::mem::take(&mut facts.pdos) {
        let cells = filled(row.value.iter().cloned());
        if !known.contains(&cells) {
            let message = format!("found {}, which the objects do not say", quoted(&cells.join(" | ")));
            let help = "change the values of the PDO parameters at 1400h to 1BFFh, which count";
            facts.comments.push(asked.cell(row.span, &message, help));
        }
    }
}

/// The cells that are not empty.
fn filled(cells: impl Iterator<Item = String>) -> Vec<String> {
    cells.filter(|cell| !cell.is_empty()).collect()
}

/// The comments of a specification, each at what it is about.
fn comments(facts: Facts, system: &System, name: &str) -> Options {
    let base_name = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let mut options = Options { head: vec![format!("Made from {base_name}.")], ..Options::default() };
    let added: Vec<String> = MANDATORY
        .into_iter()
        .filter(|index| !facts.objects.contains_key(index))
        .map(|index| Index(index).to_string())
        .collect();
    if !added.is_empty() {
        options.head.push(format!("Every device has {}, which the table does not have.", added.join(", ")));
    }
    let is_guessed = |object: &ObjectFacts| object.kind.is_none() && shape(object) == ObjectKind::Record;
    let guessed = facts.objects.iter().filter(|(_, object)| is_guessed(object));
    let guessed: Vec<String> = guessed.map(|(index, _)| Index(*index).to_string()).collect();
    if !guessed.is_empty() {
        options.head.push(format!(
            "The table does not say whether these objects are arrays or records; they are written as records: {}.",
            guessed.join(", ")
        ));
    }
    if !facts.device.contains_key("bit-rates") {
        let open = "The table does not say which bit rates the device has: write them as `bit-rates:`.";
        options.comments.entry(Place::Device).or_default().push(open.to_owned());
    }
    let device = system.devices.first();
    for (index, object) in facts.objects {
        let entries = std::iter::once((None, object.own))
            .chain(object.subs.into_iter().map(|(sub, one)| (Some(sub), one)));
        for (sub, entry) in entries {
            let id = entry_id(index, sub);
            let is_there = sub.is_some() && device.is_some_and(|device| device.entry(id).is_some());
            let place = if is_there { Place::Entry(id) } else { Place::Object(Index(index)) };
            if !entry.comments.is_empty() {
                options.comments.entry(place).or_default().extend(entry.comments);
            }
        }
    }
    if !facts.comments.is_empty() {
        options.foot.push("Rows and cells of the table that are not in the specification:".to_owned());
        options.foot.extend(facts.comments.into_iter().map(|line| format!("- {line}")));
    }
    options
}

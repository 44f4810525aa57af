//! From rows to facts.

use std::ops::RangeInclusive;

use od_spec::model::{DataType, Fact, ObjectKind};
use od_spec::scalar;
use od_spec::source::{Span, Spanned};
use od_spec::words;

use crate::asked::{Asked, quoted};
use crate::columns::{self, Column, Header, TableKind, header};
use crate::draft::is_device_key;
use crate::facts::{
    Accessed, EntryFacts, ErrorFacts, Facts, ListAt, ListFacts, ListOf, ListRow, ObjectFacts, Texts,
    UnitFacts,
};
use crate::sheet::{Cell, Row, RowKind, Sheet};
use crate::spelling::{
    Base, access, bits, ends, error_codes, indices, is_hex_only, is_nothing, marked_hex, sub_indices, yes_no,
};

const CORRECT: &str = "correct the cell, or complete the specification";

/// Reads sheets one after the other.
pub(crate) struct Reader<'a, 's> {
    pub facts: &'a mut Facts,
    pub asked: &'a mut Asked<'s>,
    /// The titles of a table that has none that are understood.
    pub assigned: Option<&'a Header>,
}

/// What a row of objects is about.
#[derive(Clone)]
struct Topic {
    indices: RangeInclusive<u16>,
    subs: Option<RangeInclusive<u8>>,
}

/// The table that a row belongs to.
enum Within {
    /// No table, or running text.
    Nothing,
    Table(Header),
    /// A table whose titles say nothing that is read.
    Other,
}

impl Reader<'_, '_> {
    /// Reads the rows of a sheet.
    pub(crate) fn read(&mut self, sheet: &Sheet) {
        let mut within = self.assigned.map_or(Within::Nothing, |header| Within::Table(header.clone()));
        let mut topic: Option<Topic> = None;
        // The list that rows of values or bits go on with.
        let mut list: Option<usize> = None;
        for (at, row) in sheet.rows.iter().enumerate() {
            let ends_table = row.kind == RowKind::Text && (row.cells.is_empty() || row.first().is_some());
            if ends_table && self.assigned.is_none() {
                within = Within::Nothing;
            }
            if row.kind == RowKind::Text || row.first().is_none() {
                continue;
            }
            let rest = sheet.rows.get(at + 1..).unwrap_or_default();
            if self.assigned.is_none()
                && let Some(found) = header(row).map(|found| with_hex_subs(found, rest))
            {
                self.titles(row, &found);
                // Without a column of indices, rows belong to the object above.
                if found.kind != TableKind::Objects || found.position(Column::Index).is_some() {
                    topic = topic.filter(|_| matches!(found.kind, TableKind::Bits | TableKind::Values));
                }
                list = None;
                within = Within::Table(found);
                continue;
            }
            let header = match &within {
                Within::Table(header) => header,
                Within::Nothing if row.filled().nth(1).is_some() => {
                    self.foreign_table(row, topic.as_ref());
                    within = Within::Other;
                    continue;
                }
                // A caption, or a row of a table that was asked about.
                Within::Nothing | Within::Other => {
                    self.comment(row, topic.as_ref());
                    continue;
                }
            };
            let is_read = match header.kind {
                TableKind::Objects => match Self::topic(row, header, topic.as_ref()) {
                    Some(found) => {
                        self.object_row(row, header, &found);
                        topic = Some(found);
                        true
                    }
                    None => false,
                },
                TableKind::Bits | TableKind::Values => {
                    list = self.list_row(row, header, topic.as_ref(), list);
                    list.is_some()
                }
                TableKind::Types => self.type_row(row, header),
                TableKind::Units => self.unit_row(row, header),
                TableKind::Errors => self.error_row(row, header),
                TableKind::Device => self.device_row(row, header),
                TableKind::Pdos => {
                    let cells = row.cells.iter().map(|cell| cell.text.clone()).collect();
                    let span = row.first().map(|cell| cell.span);
                    self.facts.pdos.extend(span.map(|span| Spanned::new(cells, span)));
                    true
                }
            };
            if !is_read {
                let is_named = header.cell(row, Column::Index).is_some_and(|cell| !is_nothing(&cell.text));
                if header.kind == TableKind::Objects && is_named {
                    // What follows belongs to what this row names.
                    topic = None;
                }
                self.other(row, topic.as_ref());
                if self.assigned.is_none() && begins_another(row) {
                    within = Within::Other;
                }
            }
        }
    }

    /// Notes the language of titles, and asks about those that are unknown.
    fn titles(&mut self, row: &Row, header: &Header) {
        if let Some(language) = header.language {
            *self.facts.languages.entry(language).or_default() += 1;
        }
        if header.kind == TableKind::Pdos {
            return;
        }
        for (at, cell) in row.filled() {
            if header.columns.get(at).copied().flatten().is_none() {
                let message = format!("the title {} is not understood", quoted(&cell.text));
                let comment = self.asked.cell(
                    cell.span,
                    &message,
                    "say what the column holds with `--columns`, or rename it; its cells are comments",
                );
                self.facts.comments.push(comment);
            }
        }
    }

    /// A row that is about nothing by itself: a comment at the object above, or at the file.
    fn other(&mut self, row: &Row, topic: Option<&Topic>) {
        let Some(first) = row.first() else { return };
        let message =
            format!("found the row {}, expected an object, a value or a bit", quoted(&row.quoted()));
        let help = "add what it says to the specification; a comment has its text";
        self.asked.cell(first.span, &message, help);
        self.comment(row, topic);
    }

    /// The first row of a table whose titles say nothing that is read: it is asked about once.
    fn foreign_table(&mut self, row: &Row, topic: Option<&Topic>) {
        let Some(first) = row.first() else { return };
        let message = format!(
            "found a table that begins with {}, not with titles that are understood",
            quoted(&row.quoted())
        );
        let help = "say what its columns hold with `--columns`, or rename them; its rows are comments";
        self.asked.cell(first.span, &message, help);
        self.comment(row, topic);
    }

    /// Keeps a row as a comment.
    fn comment(&mut self, row: &Row, topic: Option<&Topic>) {
        let Some(first) = row.first() else { return };
        let comment = format!("{}: {}", self.asked.place(first.span), row.quoted());
        match topic.and_then(|topic| self.facts.objects.get_mut(topic.indices.start())) {
            Some(object) => object.own.comments.push(comment),
            None => self.facts.comments.push(comment),
        }
    }

    /// What a row of objects is about; `None` if it names no object.
    fn topic(row: &Row, header: &Header, above: Option<&Topic>) -> Option<Topic> {
        let text = |column: Column| {
            header.cell(row, column).map(|cell| cell.text.as_str()).filter(|text| !is_nothing(text))
        };
        let subs = match text(Column::Sub) {
            Some(sub) => Some(sub_indices(sub, header.sub_base)?),
            None => None,
        };
        let Some(index) = text(Column::Index) else {
            return Some(Topic { indices: above?.indices.clone(), subs: Some(subs?) });
        };
        let Some(found) = indices(index, header.index_base) else {
            // Below an object, manuals list sub-indices in the column of indices.
            let has_subs = header.position(Column::Sub).is_some();
            let subs = sub_indices(index, header.sub_base).filter(|_| !has_subs)?;
            return Some(Topic { indices: above?.indices.clone(), subs: Some(subs) });
        };
        let of_index = found.sub.map(|sub| sub..=sub);
        let differ = of_index.is_some() && subs.is_some() && of_index != subs;
        (!differ).then_some(Topic { indices: found.indices, subs: of_index.or(subs) })
    }

    fn object_row(&mut self, row: &Row, header: &Header, topic: &Topic) {
        let Some(span) = row.first().map(|cell| cell.span) else { return };
        for index in topic.indices.clone() {
            self.facts.objects.entry(index).or_insert_with(|| ObjectFacts::new(span));
            match &topic.subs {
                None => self.cells(row, header, index, None),
                Some(subs) => subs.clone().for_each(|sub| self.cells(row, header, index, Some(sub))),
            }
        }
    }

    fn cells(&mut self, row: &Row, header: &Header, index: u16, sub: Option<u8>) {
        let Some(span) = row.first().map(|cell| cell.span) else { return };
        if let Some(object) = self.facts.objects.get_mut(&index) {
            object.entry(sub, span);
        }
        for (at, cell) in row.filled() {
            let column = header.columns.get(at).copied().flatten();
            let language = header.languages.get(at).cloned().flatten();
            let comment = match self.cell(column, language, cell, index, sub) {
                Ok(()) => continue,
                Err(Problem::NotUnderstood(expected)) => {
                    let title = column.map_or("", Column::title);
                    let message = format!("{title}: found {}, expected {expected}", quoted(&cell.text));
                    self.asked.cell(cell.span, &message, CORRECT)
                }
                Err(Problem::Unknown) => format!("{}: {}", self.asked.place(cell.span), cell.text),
            };
            if let Some(object) = self.facts.objects.get_mut(&index) {
                object.entry(sub, span).comments.push(comment);
            }
        }
    }

    /// Takes a cell as the fact of its column.
    fn cell(
        &mut self,
        column: Option<Column>,
        language: Option<String>,
        cell: &Cell,
        index: u16,
        sub: Option<u8>,
    ) -> Result<(), Problem> {
        let Some(object) = self.facts.objects.get_mut(&index) else { return Ok(()) };
        let (text, span) = (cell.text.as_str(), cell.span);
        let Some(column) = column else { return Err(Problem::Unknown) };
        if is_nothing(text) && column != Column::Mapping {
            return Ok(());
        }
        if column == Column::Kind {
            return kind_cell(object, sub, cell);
        }
        if column == Column::Type
            && let Some(kind) = object_kind(text).filter(|kind| *kind != ObjectKind::Domain && sub.is_none())
        {
            // Manuals have `RECORD` in the column of types.
            return set(&mut object.kind, kind, span, "object type");
        }
        let facts = object.entry(sub, span);
        let fact = match column {
            Column::Index | Column::Sub => return Ok(()),
            Column::Type => return type_cell(facts, cell),
            Column::List => return set(&mut facts.list, text.to_owned(), span, "type name"),
            Column::Access => {
                let word = text.strip_suffix("locked").map_or(text, str::trim_end);
                let access = access(word).ok_or("an access type such as ro or rw")?;
                let found = Accessed { access, locked: word.len() < text.len() };
                return set(&mut facts.access, found, span, "access type");
            }
            Column::Range => {
                let (low, high) = ends(text).ok_or("a range such as 0..100")?;
                state(facts, Fact::LowLimit, low, span)?;
                return state(facts, Fact::HighLimit, high, span);
            }
            Column::Scale => return set(&mut facts.scale, text.to_owned(), span, "scale"),
            Column::Description => return text_cell(&mut facts.about, language, cell, "description"),
            Column::Warning => return text_cell(&mut facts.warning, language, cell, "warning"),
            Column::Name => return state(facts, Fact::Name, &on_a_line(text), span),
            Column::Mapping => Fact::Mapping,
            Column::Default => Fact::Default,
            Column::Low => Fact::LowLimit,
            Column::High => Fact::HighLimit,
            Column::Unit => Fact::Unit,
            Column::Storage => Fact::Storage,
            Column::Capacity => Fact::Capacity,
            Column::Special => Fact::Special,
            Column::Category => Fact::Category,
            Column::Since => Fact::Since,
            Column::Condition => Fact::WriteCondition,
            Column::Identifier => Fact::Identifier,
            Column::Offset
            | Column::Base
            | Column::Symbol
            | Column::Bit
            | Column::Value
            | Column::Supported
            | Column::Register
            | Column::Priority
            | Column::Reaction
            | Column::Reset
            | Column::ErrorCode
            | Column::Property
            | Column::Kind
            | Column::Pdo => return Err(Problem::Unknown),
        };
        state(facts, fact, text, span)
    }

    /// Reads a row of a list; returns the list that it is in. `None` if it is not one of a list.
    fn list_row(
        &mut self,
        row: &Row,
        header: &Header,
        topic: Option<&Topic>,
        open: Option<usize>,
    ) -> Option<usize> {
        let span = row.first()?.span;
        let text = |column: Column| header.cell(row, column);
        let bits_of = |cell: &Cell| bits(&cell.text);
        let is_bits = header.kind == TableKind::Bits && text(Column::Value).is_none();
        let at = match (text(Column::Bit), text(Column::Value)) {
            (Some(of), None) if is_bits => ListAt::Bits(bits_of(of)?),
            (Some(of), Some(value)) => ListAt::ValueOfBits(bits_of(of)?, value_of(&value.text)?),
            (None, Some(value)) => ListAt::Value(value_of(&value.text)?),
            (Some(_) | None, None) => return None,
        };
        let list = match text(Column::List) {
            Some(name) => self.list_of(ListOf::Named(name.text.clone()), span),
            None => match open {
                Some(list) => list,
                None => {
                    let topic = topic?;
                    let sub = topic.subs.as_ref().map(|subs| *subs.start());
                    self.list_of(ListOf::Entry(*topic.indices.start(), sub), span)
                }
            },
        };
        let named = text(Column::Name);
        let mut about = Texts::new();
        for (at, cell) in row.filled() {
            match header.columns.get(at).copied().flatten() {
                Some(Column::Description) if named.is_some() || header.position(Column::Name).is_some() => {
                    let language = header.languages.get(at).cloned().flatten();
                    about.insert(language, Spanned::new(cell.text.clone(), cell.span));
                }
                None => {
                    let comment = format!("{}: {}", self.asked.place(cell.span), cell.text);
                    self.facts.comments.push(comment);
                }
                Some(_) => {}
            }
        }
        let name =
            named.or_else(|| text(Column::Description).filter(|_| header.position(Column::Name).is_none()));
        let name = name.map(|cell| {
            let text = on_a_line(&cell.text);
            // `1 = ready`: what a bit means is what it means at 1.
            let at_one = text.strip_prefix('1').map(str::trim_start).and_then(|text| text.strip_prefix('='));
            let text = at_one.filter(|_| is_bits).map_or(text.as_str(), str::trim_start).to_owned();
            Spanned::new(text, cell.span)
        });
        let errors = text(Column::ErrorCode).map(|cell| Spanned::new(cell.text.clone(), cell.span));
        let supported = text(Column::Supported).and_then(|cell| yes_no(&cell.text)) != Some(false);
        let base = text(Column::Type).map(|cell| (words::data_type(&cell.text), cell));
        if let Some((None, cell)) = base {
            let found =
                format!("Type: found {}, expected a data type such as UNSIGNED16", quoted(&cell.text));
            let comment = self.asked.cell(cell.span, &found, CORRECT);
            self.facts.comments.push(comment);
        }
        let list_facts = self.facts.lists.get_mut(list)?;
        if let Some((Some(base), cell)) = base {
            list_facts.base.get_or_insert_with(|| Spanned::new(base, cell.span));
        }
        list_facts.rows.push(ListRow { at, name, supported, errors, about, span });
        Some(list)
    }

    /// The position of a list, which is made where there is none.
    fn list_of(&mut self, of: ListOf, span: Span) -> usize {
        let lists = &mut self.facts.lists;
        lists.iter().position(|list| list.of == of).unwrap_or_else(|| {
            lists.push(ListFacts { of, base: None, about: Texts::new(), rows: Vec::new(), span });
            lists.len() - 1
        })
    }

    /// Reads what a type of bits or values is for.
    fn type_row(&mut self, row: &Row, header: &Header) -> bool {
        let Some(name) = header.cell(row, Column::List) else { return false };
        let list = self.list_of(ListOf::Named(name.text.clone()), name.span);
        for (at, cell) in row.filled() {
            let language = || header.languages.get(at).cloned().flatten();
            if header.columns.get(at).copied().flatten() == Some(Column::Description)
                && let Some(list) = self.facts.lists.get_mut(list)
            {
                list.about.insert(language(), Spanned::new(cell.text.clone(), cell.span));
            }
        }
        true
    }

    fn unit_row(&mut self, row: &Row, header: &Header) -> bool {
        let Some(name) = header.cell(row, Column::Unit) else { return false };
        let mut unit = UnitFacts {
            name: Spanned::new(on_a_line(&name.text), name.span),
            keys: [].into(),
            about: Texts::new(),
        };
        for (at, cell) in row.filled() {
            let value = Spanned::new(cell.text.clone(), cell.span);
            let key = match header.columns.get(at).copied().flatten() {
                Some(Column::Symbol) => "symbol",
                Some(Column::Scale) => "scale",
                Some(Column::Offset) => "offset",
                Some(Column::Base) => "base",
                Some(Column::Description) => {
                    unit.about.insert(header.languages.get(at).cloned().flatten(), value);
                    continue;
                }
                Some(_) => continue,
                None => {
                    let comment = format!("{}: {}", self.asked.place(cell.span), cell.text);
                    self.facts.comments.push(comment);
                    continue;
                }
            };
            unit.keys.insert(key, value);
        }
        self.facts.units.push(unit);
        true
    }

    fn error_row(&mut self, row: &Row, header: &Header) -> bool {
        let Some(code) = header.cell(row, Column::ErrorCode) else { return false };
        let Some(codes) = error_codes(&code.text) else { return false };
        for number in codes {
            let mut error = ErrorFacts { keys: [].into(), texts: [].into(), span: code.span };
            for (at, cell) in row.filled() {
                let value = Spanned::new(cell.text.clone(), cell.span);
                let language = || header.languages.get(at).cloned().flatten();
                let mut text =
                    |key| drop(error.texts.entry(key).or_default().insert(language(), value.clone()));
                let key = match header.columns.get(at).copied().flatten() {
                    Some(Column::Name) => "name",
                    Some(Column::Priority) => "priority",
                    Some(Column::Register) => "register",
                    Some(Column::Reaction) => {
                        text("reaction");
                        continue;
                    }
                    Some(Column::Reset) => {
                        text("reset");
                        continue;
                    }
                    Some(Column::Description) if header.position(Column::Name).is_some() => {
                        text("about");
                        continue;
                    }
                    Some(Column::Description) => "name",
                    Some(_) => continue,
                    None => {
                        let comment = format!("{}: {}", self.asked.place(cell.span), cell.text);
                        self.facts.comments.push(comment);
                        continue;
                    }
                };
                error.keys.insert(key, value);
            }
            self.facts.errors.entry(number).or_insert(error);
        }
        true
    }

    fn device_row(&mut self, row: &Row, header: &Header) -> bool {
        let (Some(key), Some(value)) = (header.cell(row, Column::Property), header.cell(row, Column::Value))
        else {
            return false;
        };
        if !is_device_key(&key.text) {
            return false;
        }
        self.facts.device.insert(key.text.clone(), Spanned::new(value.text.clone(), value.span));
        true
    }
}

/// Why a cell says no fact.
enum Problem {
    /// It is not what was expected.
    NotUnderstood(String),
    /// Its column is unknown, about which the title was asked.
    Unknown,
}

impl From<&str> for Problem {
    fn from(expected: &str) -> Self {
        Self::NotUnderstood(expected.to_owned())
    }
}

/// Sets a fact; the first of two different ones is kept.
fn set<T: PartialEq>(fact: &mut Option<Spanned<T>>, value: T, span: Span, what: &str) -> Result<(), Problem> {
    match fact {
        Some(before) if before.value == value => Ok(()),
        Some(_) => Err(Problem::NotUnderstood(format!("the {what} of an earlier row, which is kept"))),
        None => {
            *fact = Some(Spanned::new(value, span));
            Ok(())
        }
    }
}

/// Sets one of the facts that are kept as text.
fn state(facts: &mut EntryFacts, fact: Fact, text: &str, span: Span) -> Result<(), Problem> {
    let mut stated = facts.stated.remove(&fact);
    let result = set(&mut stated, text.to_owned(), span, fact.word());
    facts.stated.extend(stated.map(|stated| (fact, stated)));
    result
}

fn text_cell(texts: &mut Texts, language: Option<String>, cell: &Cell, what: &str) -> Result<(), Problem> {
    let mut text = texts.remove(&language);
    let result = set(&mut text, cell.text.clone(), cell.span, what);
    texts.extend(text.map(|text| (language, text)));
    result
}

/// The object type that a word names.
fn object_kind(text: &str) -> Option<ObjectKind> {
    let code = words::object_code(text)?;
    let kinds = [ObjectKind::Var, ObjectKind::Array, ObjectKind::Record, ObjectKind::Domain];
    kinds.into_iter().find(|kind| kind.code() == code)
}

fn kind_cell(object: &mut ObjectFacts, sub: Option<u8>, cell: &Cell) -> Result<(), Problem> {
    let kind = object_kind(&cell.text).ok_or("an object type such as VAR, ARRAY or RECORD")?;
    match sub {
        None => set(&mut object.kind, kind, cell.span, "object type"),
        // Each sub-index is a VAR.
        Some(_) if kind == ObjectKind::Var => Ok(()),
        Some(_) => Err("VAR at a sub-index".into()),
    }
}

/// A data type, of a string with the number of its bytes: `VISIBLE_STRING(16)`.
fn type_cell(facts: &mut EntryFacts, cell: &Cell) -> Result<(), Problem> {
    let text = cell.text.as_str();
    let expected = "a data type such as UNSIGNED16";
    let Some((word, length)) = text.trim_end_matches([')', ']']).split_once(['(', '[']) else {
        let found = words::data_type(text).ok_or(expected)?;
        return set(&mut facts.data_type, found, cell.span, "type");
    };
    let found = words::data_type(word).filter(|found| found.is_string()).ok_or(expected)?;
    let length: u16 = length.trim().parse().map_err(|_| expected)?;
    set::<DataType>(&mut facts.data_type, found, cell.span, "type")?;
    state(facts, Fact::Capacity, &length.to_string(), cell.span)
}

/// A text without line breaks.
fn on_a_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// A whole number of a list.
fn value_of(text: &str) -> Option<i128> {
    let text = text.trim();
    marked_hex(text).map(i128::from).or_else(|| scalar::integer(&text.replace('−', "-")).ok())
}

/// A header with the sub-indices in hexadecimal, if one of them can only be that.
fn with_hex_subs(header: Header, below: &[Row]) -> Header {
    let Some(at) = header.position(Column::Sub) else { return header };
    let rows = below.iter().take_while(|row| row.kind == RowKind::Table && columns::header(row).is_none());
    let mut cells = rows.filter_map(|row| row.cells.get(at));
    let sub_base =
        if cells.any(|cell| is_hex_only(&cell.text)) { Base::Hexadecimal } else { header.sub_base };
    Header { sub_base, ..header }
}

/// Whether a row that names no object has the titles of another table: a caption is a single cell, and an index with a mistake
/// has a digit.
fn begins_another(row: &Row) -> bool {
    let first = row.first();
    row.filled().count() > 1 && first.is_some_and(|cell| !cell.text.bytes().any(|b| b.is_ascii_digit()))
}

//! The model in front of the printer: chosen devices, language, and where each thing is shown.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use od_spec::expr::{EntryRef, Expr, Term};
use od_spec::model::{
    BitErrors, BitField, DataType, Dictionary, Document, Entry, EntryId, Erratum, ErratumPlace, Index,
    Object, Ratio, System, TableContent, TableId, Text, TypeKind, Unit, Value,
};

use crate::Options;
use crate::cell::{entry_anchor, slug};
use crate::language::{Language, Word};
use crate::view::Cell;

/// Names of pages that chapters leave to others.
const PAGES: [&str; 10] = [
    "readme",
    "index",
    "errors",
    "aliases",
    "units",
    "storage",
    "constraints",
    "machines",
    "errata",
    "tables",
];

/// Name of the page of a chapter; may be empty.
pub(crate) fn chapter_page(number: &str, title: &str) -> String {
    slug(&format!("{number} {title}"))
}

/// What would otherwise be searched for again and again.
#[derive(Default)]
struct Lookup {
    /// Positions of the errata about each object, ascending.
    errata: BTreeMap<Index, Vec<usize>>,
    /// Entries with error codes of their own for the bits of their type, by the type's name.
    bit_errors: BTreeMap<String, Vec<EntryId>>,
    /// Entries with bits that show an error code.
    showing: BTreeMap<u16, Vec<EntryId>>,
    /// Positions of the sections that show an object.
    places: BTreeMap<Index, Vec<usize>>,
    /// [`Source::chapters`].
    chapters: Vec<(String, Vec<(usize, usize)>)>,
}

/// The model, seen by the printer.
pub(crate) struct Source<'a> {
    pub system: &'a System,
    /// The devices to show.
    pub devices: Vec<&'a Dictionary>,
    pub language: Language<'a>,
    /// Calls of the accessors in generated Rust, by device and entry.
    pub accessors: &'a BTreeMap<(String, EntryId), String>,
    /// The page, where pages are small, that shows an object in detail.
    homes: BTreeMap<Index, String>,
    lookup: Rc<Lookup>,
}

impl<'a> Source<'a> {
    pub(crate) fn new(system: &'a System, options: &'a Options) -> Self {
        let chosen =
            |device: &&Dictionary| options.devices.is_empty() || options.devices.contains(&device.key);
        let devices: Vec<&Dictionary> = system.devices.iter().filter(chosen).collect();
        let language = Language { code: options.language.as_deref().unwrap_or_else(|| system.language()) };
        let mut source = Self {
            system,
            devices,
            language,
            accessors: &options.accessors,
            homes: BTreeMap::new(),
            lookup: Rc::default(),
        };
        source.homes = source.find_homes();
        source.lookup = Rc::new(source.look_up());
        source
    }

    /// The same for the page of one device, which shows every object of the device itself.
    pub(crate) fn only(&self, device: &'a Dictionary) -> Self {
        let homes = device.objects.keys().map(|index| (*index, device.key.clone())).collect();
        Self { devices: vec![device], homes, lookup: Rc::clone(&self.lookup), ..*self }
    }

    fn look_up(&self) -> Lookup {
        let mut lookup = Lookup { chapters: self.chapters(), ..Lookup::default() };
        for (at, erratum) in self.system.errata.iter().enumerate().filter(|(_, one)| self.is_about(one)) {
            let indices: BTreeSet<Index> = erratum.at.iter().map(|place| place.index()).collect();
            for index in indices {
                lookup.errata.entry(index).or_default().push(at);
            }
        }
        let mut seen: BTreeSet<EntryId> = BTreeSet::new();
        for (id, _, entry) in self.devices.iter().flat_map(|device| device.entries()) {
            let Some(named) = &entry.named_type else { continue };
            let TypeKind::Bits(fields) = &named.kind else { continue };
            let own = entry.bit_errors.iter().flat_map(BitErrors::error_codes);
            let codes: BTreeSet<u16> = fields.iter().flat_map(BitField::error_codes).chain(own).collect();
            for code in codes {
                let entries = lookup.showing.entry(code).or_default();
                if !entries.contains(&id) {
                    entries.push(id);
                }
            }
            if !entry.bit_errors.is_empty() && seen.insert(id) {
                lookup.bit_errors.entry(named.name.clone()).or_default().push(id);
            }
        }
        for (at, section) in self.document().sections.iter().enumerate() {
            for table in &section.tables {
                let (TableContent::Objects(list) | TableContent::Overview(list)) = &table.content else {
                    continue;
                };
                for index in list {
                    let places = lookup.places.entry(*index).or_default();
                    if places.last() != Some(&at) {
                        places.push(at);
                    }
                }
            }
        }
        lookup
    }

    /// Entries with error codes of their own for the bits of a type.
    pub(crate) fn with_bit_errors(&self, named: &str) -> &[EntryId] {
        self.lookup.bit_errors.get(named).map_or(&[], Vec::as_slice)
    }

    /// Entries with bits that show an error code.
    pub(crate) fn showing(&self, code: u16) -> &[EntryId] {
        self.lookup.showing.get(&code).map_or(&[], Vec::as_slice)
    }

    /// Positions of the sections whose tables show an object.
    pub(crate) fn sections_of(&self, index: Index) -> &[usize] {
        self.lookup.places.get(&index).map_or(&[], Vec::as_slice)
    }

    fn find_homes(&self) -> BTreeMap<Index, String> {
        let mut homes = BTreeMap::new();
        for (page, sections) in self.chapters() {
            for (section, _) in sections {
                for table in &self.system.document.sections[section].tables {
                    let TableContent::Objects(list) = &table.content else { continue };
                    for index in list {
                        homes.entry(*index).or_insert_with(|| page.clone());
                    }
                }
            }
        }
        for device in &self.devices {
            for index in device.objects.keys() {
                homes.entry(*index).or_insert_with(|| device.key.clone());
            }
        }
        homes
    }

    /// The document's sections by chapter: name of the page; position and depth of each section.
    pub(crate) fn chapters(&self) -> Vec<(String, Vec<(usize, usize)>)> {
        let mut chapters: Vec<(String, Vec<(usize, usize)>)> = Vec::new();
        for (at, section) in self.system.document.sections.iter().enumerate() {
            let level = self.level(at);
            match chapters.last_mut() {
                Some((_, sections)) if level > 1 => sections.push((at, level)),
                _ => {
                    let title = section.title.get(self.system.language()).unwrap_or_default();
                    let page = chapter_page(&section.number, title);
                    let taken = |name: &str| {
                        PAGES.contains(&name)
                            || self.system.devices.iter().any(|device| device.key == name)
                            || chapters.iter().any(|(page, _)| page == name)
                    };
                    let page =
                        if page.is_empty() || taken(&page) { format!("chapter-{}", at + 1) } else { page };
                    chapters.push((page, vec![(at, level)]));
                }
            }
        }
        chapters
    }

    /// Depth of a section: the parts of its number. One without a number that stands inside a chapter belongs to it.
    fn level(&self, at: usize) -> usize {
        let sections = &self.system.document.sections;
        let parts = |number: &str| number.split('.').filter(|part| !part.is_empty()).count();
        let numbered =
            |sections: &[od_spec::model::Section]| sections.iter().any(|one| !one.number.is_empty());
        let next = sections[at..].iter().find(|section| !section.number.is_empty());
        match parts(&sections[at].number) {
            0 if numbered(&sections[..at]) && next.is_some_and(|next| parts(&next.number) > 1) => 2,
            0 => 1,
            parts => parts,
        }
    }

    /// The page that has a section.
    pub(crate) fn page_of(&self, section: usize) -> String {
        let has =
            |(_, sections): &&(String, Vec<(usize, usize)>)| sections.iter().any(|(at, _)| *at == section);
        self.lookup.chapters.iter().find(has).map_or_else(String::new, |(page, _)| page.clone())
    }

    pub(crate) const fn document(&self) -> &'a Document {
        &self.system.document
    }

    /// A word of the specification in the document's language.
    pub(crate) fn spec_word(&self, word: &str) -> String {
        self.language.spec_word(word)
    }

    /// A fixed word.
    pub(crate) fn word(&self, word: Word) -> &'static str {
        self.language.word(word)
    }

    /// A text of the specification.
    pub(crate) fn text(&self, text: &Text) -> Cell {
        Cell::words(text, self.language)
    }

    /// The page that shows an object in detail.
    pub(crate) fn home(&self, index: Index) -> &str {
        self.homes.get(&index).map_or("", String::as_str)
    }

    /// A link to an entry, as `6040h` or `3020h.5`; of a device that is not shown, the id alone.
    pub(crate) fn entry_link(&self, id: EntryId) -> Cell {
        self.link(id.index, id.to_string(), entry_anchor(id))
    }

    /// A link to something of an object, if a device shown has the object.
    pub(crate) fn link(&self, index: Index, text: String, anchor: String) -> Cell {
        self.link_on(&[], index, text, anchor)
    }

    /// A link to something of an object of these devices; none means any.
    pub(crate) fn link_on(&self, devices: &[String], index: Index, text: String, anchor: String) -> Cell {
        let meant = |device: &&&Dictionary| devices.is_empty() || devices.contains(&device.key);
        let has = |device: &&&Dictionary| device.objects.contains_key(&index);
        let Some(device) = self.devices.iter().filter(meant).find(has) else { return Cell::plain(text) };
        // What no chapter details stands on the page of its device: each device has one.
        let home = self.home(index);
        let is_device = self.devices.iter().any(|device| device.key == home);
        Cell::default().link(text, anchor, if is_device { &device.key } else { home })
    }

    /// A link to an entry of a device.
    pub(crate) fn entry_link_on(&self, device: &Dictionary, id: EntryId) -> Cell {
        self.link_on(std::slice::from_ref(&device.key), id.index, id.to_string(), entry_anchor(id))
    }

    /// A link to an entry with its name.
    pub(crate) fn named_entry(&self, device: &Dictionary, id: EntryId) -> Cell {
        self.entry_link_on(device, id).text(format!(" {}", device.entry_name(id).unwrap_or_default()))
    }

    /// Whether an erratum is about one of the devices shown.
    pub(crate) fn is_about(&self, erratum: &Erratum) -> bool {
        erratum.devices.is_empty() || self.devices.iter().any(|device| erratum.devices.contains(&device.key))
    }

    /// Numbers of the errata about an object, as a whole or any of its entries.
    pub(crate) fn errata_of_object(&self, index: Index) -> &[usize] {
        self.lookup.errata.get(&index).map_or(&[], Vec::as_slice)
    }

    /// Numbers of the errata that name one entry; those of an object of one value name its only entry.
    pub(crate) fn errata_of_entry(&self, object: &Object, entry: &Entry) -> Vec<usize> {
        let id = EntryId { index: object.index, sub: entry.sub };
        let names = |at: &&usize| {
            self.system.errata[**at].at.iter().any(|place| match place {
                ErratumPlace::Object(index) => *index == object.index && !object.is_structured(),
                ErratumPlace::Entry(one) => *one == id,
            })
        };
        self.errata_of_object(object.index).iter().filter(names).copied().collect()
    }

    /// The anchor of a table.
    pub(crate) fn table_anchor(&self, id: TableId) -> String {
        let section = &self.document().sections[id.section];
        let table = &section.tables[id.table];
        match table.number {
            Some(number) => format!("table-{number}"),
            None => {
                let before = section.tables[..id.table].iter().filter(|table| table.number.is_none()).count();
                let section = section_anchor(self.document(), id.section);
                let anchor = format!("{section}-{}", kind_of(&table.content));
                if before == 0 { anchor } else { format!("{anchor}-{}", before + 1) }
            }
        }
    }

    /// A value the way the manual writes it, with the raw value behind it where that is another number.
    pub(crate) fn value(&self, entry: &Entry, value: &Value) -> String {
        match value {
            Value::Integer(raw) => self.integer(entry, *raw),
            Value::NodeId(offset) => {
                format!("{} + {}", hex(u128::from(*offset), 3), self.word(Word::NodeId))
            }
            Value::Real(number) => self.language.number(&format!("{number:?}")),
            Value::Text(text) if text.is_empty() => "\"\"".to_owned(),
            Value::Text(text) => text.clone(),
            Value::Bytes(bytes) => {
                bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(" ")
            }
        }
    }

    fn integer(&self, entry: &Entry, raw: i128) -> String {
        if let Some(special) = entry.special.iter().find(|special| special.value == raw) {
            return format!("{raw} ({})", special.name);
        }
        if entry.data_type == DataType::Boolean {
            return raw.to_string();
        }
        match entry.named_type.as_ref().map(|named| &named.kind) {
            Some(TypeKind::Enum(values)) => {
                let number = enum_number(entry.data_type, raw);
                let name = values.iter().find(|value| value.value == raw).map(|value| &value.name);
                name.map_or(number.clone(), |name| format!("{number}: {name}"))
            }
            Some(TypeKind::Bits(_)) => bit_pattern(entry.data_type, raw),
            None => entry.unit.as_ref().map_or_else(
                || raw.to_string(),
                |unit| {
                    let physical = self.physical(unit, raw);
                    if unit.scale == Ratio::ONE { physical } else { format!("{physical} ({raw})") }
                },
            ),
        }
    }

    /// A raw value in its unit: `50.0 °C`.
    pub(crate) fn physical(&self, unit: &Unit, raw: i128) -> String {
        self.localized(unit, &unit.show(raw))
    }

    /// A number with the symbol of a unit, which itself stays as it is.
    fn localized(&self, unit: &Unit, text: &str) -> String {
        match text.strip_suffix(&unit.symbol) {
            Some(number) => self.language.number(number) + &unit.symbol,
            None => self.language.number(text),
        }
    }

    /// What one raw step is worth: `0.1 °C`.
    pub(crate) fn step(&self, unit: &Unit) -> String {
        self.localized(unit, &unit.step_text())
    }

    /// The limits of an entry: `0 to 100`, `≤ 90.0 °C (900)`.
    pub(crate) fn range(&self, entry: &Entry) -> String {
        let is_enum = matches!(entry.named_type.as_ref().map(|named| &named.kind), Some(TypeKind::Enum(_)));
        let own = entry.data_type.range();
        let (low, high) = (
            entry.low.filter(|low| own.is_none_or(|(lowest, _)| *low != lowest)),
            entry.high.filter(|high| own.is_none_or(|(_, highest)| *high != highest)),
        );
        let one = |raw: i128| match &entry.unit {
            Some(unit) if unit.scale != Ratio::ONE => {
                format!("{} ({raw})", self.physical(unit, raw))
            }
            Some(unit) => self.physical(unit, raw),
            None => raw.to_string(),
        };
        if is_enum {
            return String::new();
        }
        match (low.or(entry.low.filter(|_| high.is_some())), high.or(entry.high.filter(|_| low.is_some()))) {
            (Some(low), Some(high)) => format!("{} {} {}", one(low), self.word(Word::ToRange), one(high)),
            (Some(low), None) => format!("≥ {}", one(low)),
            (None, Some(high)) => format!("≤ {}", one(high)),
            (None, None) => String::new(),
        }
    }

    /// The device of an entry that a condition names: the one it says, or else one that is shown.
    pub(crate) fn device_of(&self, devices: &[String], entry: &EntryRef) -> Option<&'a Dictionary> {
        let meant = |device: &&Dictionary| match &entry.device {
            Some(key) => &device.key == key,
            None => (devices.is_empty() || devices.contains(&device.key)) && device.entry(entry.id).is_some(),
        };
        self.devices.iter().copied().find(meant).or_else(|| self.system.devices.iter().find(meant))
    }

    /// A condition in words: names with links instead of bare indices, numbers with the unit they are compared in.
    pub(crate) fn condition(&self, condition: &Expr, devices: &[String]) -> Cell {
        let mut cell = Cell::default();
        for (at, comparison) in condition.comparisons.iter().enumerate() {
            if at > 0 {
                cell = cell.text(format!(" {} ", self.word(Word::And)));
            }
            let rest = comparison.rest.iter().map(|(_, term)| term);
            let terms = std::iter::once(&comparison.first).chain(rest);
            let symbol = terms.into_iter().find_map(|term| self.symbol(term, devices)).unwrap_or_default();
            cell = self.term(cell, &comparison.first, devices, 0, &symbol);
            let mut left = &comparison.first;
            for (operator, term) in &comparison.rest {
                cell = cell.text(format!(" {} ", relation(*operator)));
                cell = self.term(cell, term, devices, 0, &symbol);
                if let Some(name) = self.value_name(left, term, devices) {
                    cell = cell.text(format!(" ({name})"));
                }
                left = term;
            }
        }
        cell
    }

    /// The symbol in which a term is compared: that of its unit's base.
    pub(crate) fn symbol(&self, term: &Term, devices: &[String]) -> Option<String> {
        use od_spec::expr::ArithmeticOp as Op;
        match term {
            Term::Number(_) | Term::Bit(..) => None,
            Term::Entry(entry) => {
                let unit = self.device_of(devices, entry)?.entry(entry.id)?.unit.as_ref()?;
                Some(unit.base_symbol().to_owned())
            }
            Term::Binary(left, Op::Add | Op::Subtract, right) => {
                self.symbol(left, devices).or_else(|| self.symbol(right, devices))
            }
            Term::Binary(left, Op::Multiply, right) => {
                match (self.symbol(left, devices), self.symbol(right, devices)) {
                    (Some(symbol), None) | (None, Some(symbol)) => Some(symbol),
                    _ => None,
                }
            }
            Term::Binary(left, Op::Divide, right) => {
                self.symbol(left, devices).filter(|_| self.symbol(right, devices).is_none())
            }
        }
    }

    /// The name of the number that an enum is compared with.
    fn value_name(&self, left: &Term, right: &Term, devices: &[String]) -> Option<&'a str> {
        let (Term::Entry(entry), Term::Number(number)) = (left, right) else { return None };
        let named = self.device_of(devices, entry)?.entry(entry.id)?.named_type.as_ref()?;
        let TypeKind::Enum(values) = &named.kind else { return None };
        let value = values.iter().find(|value| Some(value.value) == number.to_whole())?;
        Some(&value.name)
    }

    /// An entry of a condition: its name and its id, with the device where the condition names one.
    fn operand(&self, cell: Cell, entry: &EntryRef, devices: &[String]) -> Cell {
        let device = self.device_of(devices, entry);
        let name = device.and_then(|device| device.entry_name(entry.id)).unwrap_or_default();
        let said = entry.device.as_ref().filter(|_| self.system.devices.len() > 1);
        let text = match said {
            Some(key) => format!("{} {}", key.to_uppercase(), entry.id),
            None => entry.id.to_string(),
        };
        let meant: &[String] = entry.device.as_ref().map_or(devices, std::slice::from_ref);
        let link = self.link_on(meant, entry.id.index, text, entry_anchor(entry.id));
        cell.text(format!("{name} (")).and(link).text(")")
    }

    /// A term; a number that is compared or added is in the unit of `symbol`.
    pub(crate) fn term(&self, cell: Cell, term: &Term, devices: &[String], around: u8, symbol: &str) -> Cell {
        use od_spec::expr::ArithmeticOp as Op;
        match term {
            Term::Number(number) => {
                let number = self.language.number(&number.to_string());
                cell.text(if symbol.is_empty() { number } else { format!("{number} {symbol}") })
            }
            Term::Entry(entry) => self.operand(cell, entry, devices),
            Term::Bit(entry, bit) => {
                let words = self.word(Word::BitOf).replace("{n}", &bit.to_string());
                self.operand(cell.text(format!("{words} ")), entry, devices)
            }
            Term::Binary(left, Op::Subtract, right) if **left == Term::Number(Ratio::whole(0)) => {
                self.term(cell.text("−"), right, devices, 3, symbol)
            }
            Term::Binary(left, operator, right) => {
                let (sign, level) = match operator {
                    Op::Add => ("+", 1),
                    Op::Subtract => ("−", 1),
                    Op::Multiply => ("×", 2),
                    Op::Divide => ("/", 2),
                };
                // A factor is a bare number.
                let symbol = if level == 2 { "" } else { symbol };
                let brackets = level < around;
                let cell = if brackets { cell.text("(") } else { cell };
                let cell = self.term(cell, left, devices, level, symbol).text(format!(" {sign} "));
                // The right side of `-` and `/` needs brackets at its own level, too.
                let right_level = level + u8::from(matches!(operator, Op::Subtract | Op::Divide));
                let cell = self.term(cell, right, devices, right_level, symbol);
                if brackets { cell.text(")") } else { cell }
            }
        }
    }
}

/// An operator as it is printed.
pub(crate) const fn relation(operator: od_spec::expr::CompareOp) -> &'static str {
    use od_spec::expr::CompareOp as Op;
    match operator {
        Op::Less => "<",
        Op::LessOrEqual => "≤",
        Op::Equal => "=",
        Op::NotEqual => "≠",
        Op::GreaterOrEqual => "≥",
        Op::Greater => ">",
    }
}

/// The anchor of a section: its number, or else its title and, where another has the same, its place.
pub(crate) fn section_anchor(document: &Document, section: usize) -> String {
    let own = |section: &od_spec::model::Section| match section.number.as_str() {
        "" => slug(section.title.iter().next().map_or("", |(_, title)| title)),
        number => number.trim_end_matches('.').replace(char::is_whitespace, "-"),
    };
    let name = own(&document.sections[section]);
    let before = document.sections[..section].iter().filter(|other| own(other) == name).count();
    if before == 0 && !name.is_empty() {
        format!("section-{name}")
    } else {
        format!("section-{name}-no-{section}")
    }
}

/// What fills a table, as the specification's key says it.
pub(crate) const fn kind_of(content: &TableContent) -> &'static str {
    match content {
        TableContent::Overview(_) => "overview",
        TableContent::Objects(_) => "objects",
        TableContent::Bits(_) => "bits",
        TableContent::Values(_) => "values",
        TableContent::Errors(_) => "errors",
        TableContent::Reactions(_) => "reactions",
        TableContent::States(_) => "states",
        TableContent::Transitions(_) => "transitions",
        TableContent::Commands(_) => "commands",
        TableContent::Ladder(_) => "ladder",
        TableContent::Pdos(_) => "pdos",
        TableContent::Rows { .. } => "rows",
        TableContent::Glossary => "glossary",
        TableContent::History => "history",
    }
}

/// The field's notation of a hexadecimal number: `0180h`.
pub(crate) fn hex(value: u128, digits: usize) -> String {
    format!("{value:0digits$X}h")
}

/// A raw value as hexadecimal digits of its type's width: `FFh` for -1 in 8 bits.
pub(crate) fn bit_pattern(data_type: DataType, raw: i128) -> String {
    let bits = data_type.bits().unwrap_or(64);
    hex(raw.rem_euclid(1 << bits).unsigned_abs(), usize::from(bits.div_ceil(4)))
}

/// A value of an enum: decimal and, where that is another way to write it, hexadecimal: `-113 (8Fh)`.
pub(crate) fn enum_number(data_type: DataType, raw: i128) -> String {
    let small = (0..10).contains(&raw) || (data_type.is_signed() && raw >= 0);
    if small { raw.to_string() } else { format!("{raw} ({})", bit_pattern(data_type, raw)) }
}

//! Cells in the notation of a specification: what they mean depends on type, access and language.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

use od_import::yaml::spelled;
use od_spec::library;
use od_spec::model::{
    CommunicationParameter, DataType, Fact, Family, Index, Object, ObjectKind, Ratio, Role, Storage, SubIndex,
};
use od_spec::source::{Span, Spanned};

use crate::asked::{Asked, quoted};
use crate::facts::{Accessed, EntryFacts, Facts, ListOf, ObjectFacts, Texts, UnitFacts};
use crate::spelling::{Language, mapping, marked_hex, number, of_node_id, plain, yes_no};

const CORRECT: &str = "correct the cell, or complete the specification";

/// Puts every cell into the notation of a specification; what is not understood becomes a comment.
pub(crate) fn settle(facts: &mut Facts, asked: &mut Asked<'_>) {
    let language = facts.language();
    let mut units = Units::new(std::mem::take(&mut facts.units));
    let listed: BTreeSet<ListOf> = facts.lists.iter().map(|list| list.of.clone()).collect();
    for (index, object) in &mut facts.objects {
        if !matches!(shape(object), ObjectKind::Array | ObjectKind::Record)
            && let Some(sub) = object.subs.remove(&0)
        {
            join(&mut object.own, sub);
        }
        fill_in(*index, object);
        let ObjectFacts { own, subs, .. } = object;
        let (of_all, access_of_all) = (own.data_type, own.access);
        for (sub, entry) in
            std::iter::once((None, own)).chain(subs.iter_mut().map(|(sub, one)| (Some(*sub), one)))
        {
            let data_type = entry.data_type.or(of_all.filter(|_| sub != Some(0)));
            let access = entry.access.or(access_of_all.filter(|_| sub != Some(0)));
            let has_list = entry.list.is_some() || listed.contains(&ListOf::Entry(*index, sub));
            let mut settler = Settler { language, asked, units: &mut units, has_list };
            settler.entry(entry, data_type.map(|one| one.value), access.map(|one| one.value));
        }
    }
    facts.units = units.list;
}

/// The objects that every device may have, by the standard.
static STANDARD: LazyLock<BTreeMap<Index, Object>> = LazyLock::new(|| {
    let libraries = ["cia301", "cia302"].into_iter().filter_map(library);
    let objects = libraries.flat_map(|library| library.objects);
    objects.map(|(index, one)| (index, one.object)).filter(|(index, _)| index.0 < 0x2000).collect()
});

/// The type and access of an entry, and the shape of an object, that the table does not say and CiA 301 does.
fn fill_in(index: u16, object: &mut ObjectFacts) {
    let span = object.span;
    let standard = STANDARD.get(&Index(index));
    let is_structured = standard.is_none_or(Object::is_structured);
    if let Some(standard) = standard
        && object.kind.is_none()
        && is_structured
        && object.subs.keys().any(|sub| *sub != 0)
    {
        object.kind = Some(Spanned::new(standard.kind, span));
    }
    let own = (!is_structured).then_some((0, &mut object.own));
    for (sub, entry) in object.subs.iter_mut().map(|(sub, entry)| (*sub, entry)).chain(own) {
        let known = standard.and_then(|standard| standard.entry(SubIndex(sub)));
        let data_type = known.map(|known| known.data_type).or_else(|| of_pdo(index, sub));
        let mut filled = Vec::new();
        if let (Some(data_type), None) = (data_type, &entry.data_type) {
            entry.data_type = Some(Spanned::new(data_type, span));
            filled.push("type");
        }
        if let (Some(known), None) = (known, &entry.access) {
            entry.access = Some(Spanned::new(Accessed { access: known.access, locked: false }, span));
            filled.push("access");
        }
        // Sub-index 0 of an object with others is a count by definition.
        if !filled.is_empty() && (sub != 0 || !is_structured) {
            entry.comments.push(format!("{}: that of CiA 301, as the table has none", filled.join(" and ")));
        }
    }
}

/// The type of a parameter of a PDO. Its access is the maker's choice.
fn of_pdo(index: u16, sub: u8) -> Option<DataType> {
    match Role::of(Index(index)) {
        Role::PdoCommunication => {
            let mut all = CommunicationParameter::ALL.into_iter();
            all.find(|parameter| parameter.sub() == sub).map(CommunicationParameter::data_type)
        }
        Role::PdoMapping if sub > 0 => Some(DataType::Unsigned32),
        _ => None,
    }
}

/// Settles the cells of one entry after the other.
struct Settler<'a, 's> {
    language: Language,
    asked: &'a mut Asked<'s>,
    units: &'a mut Units,
    /// Whether the values of the entry have names.
    has_list: bool,
}

impl Settler<'_, '_> {
    fn entry(&mut self, entry: &mut EntryFacts, data_type: Option<DataType>, access: Option<Accessed>) {
        let scale = entry.scale.take();
        for (fact, cell) in std::mem::take(&mut entry.stated) {
            let span = cell.span;
            let settled = match fact {
                Fact::Mapping => {
                    let found = mapping(&cell.value, access.map(|one| one.access));
                    found.map(|found| found.word().to_owned()).ok_or("yes, no, or the direction of PDOs")
                }
                Fact::Default | Fact::LowLimit | Fact::HighLimit => {
                    value(&cell.value, data_type, self.has_list, self.language)
                }
                Fact::Unit => self.unit(&cell, scale.as_ref()),
                Fact::Storage => storage(&cell.value),
                Fact::Capacity => plain_number(&cell.value).ok_or("a number of bytes"),
                Fact::Special => special(&cell.value),
                Fact::Category => word(&cell.value, &["mandatory", "optional", "conditional"])
                    .ok_or("mandatory, optional or conditional"),
                _ => Ok(cell.value.clone()),
            };
            match settled {
                Ok(text) if text.is_empty() => {}
                Ok(text) => drop(entry.stated.insert(fact, Spanned::new(text, span))),
                Err(expected) => {
                    let message =
                        format!("{}: found {}, expected {expected}", fact.word(), quoted(&cell.value));
                    entry.comments.push(self.asked.cell(span, &message, CORRECT));
                }
            }
        }
        if let Some(scale) = scale.filter(|_| !entry.stated.contains_key(&Fact::Unit)) {
            let message = format!("Scale: found {}, expected it next to a unit", quoted(&scale.value));
            entry.comments.push(self.asked.cell(scale.span, &message, CORRECT));
        }
    }

    /// The name of the unit of a cell, which is defined where it is new.
    fn unit(
        &mut self,
        cell: &Spanned<String>,
        scale: Option<&Spanned<String>>,
    ) -> Result<String, &'static str> {
        let text = cell.value.trim();
        if matches!(plain(text).as_str(), "none" | "keine" | "ohne" | "dimensionless") && !text.contains('%')
        {
            return Ok(String::new());
        }
        if self.units.is_named(text) {
            return Ok(spelled(text));
        }
        let (step, symbol) = step_and_symbol(text, self.language).ok_or("a unit such as bar or 0.1 bar")?;
        let step = match scale {
            None => step,
            Some(scale) => {
                let text = number(&scale.value, self.language).filter(|(_, rest)| rest.is_empty());
                let text = text.map_or_else(|| scale.value.clone(), |(number, _)| number);
                let read = od_spec::scalar::ratio(&text).filter(|one| one.numerator() > 0);
                read.filter(|_| step == Ratio::ONE).ok_or("a unit with one scale, such as 0.1")?
            }
        };
        Ok(spelled(&self.units.of(step, &symbol, cell.span)))
    }
}

/// A unit of a cell: what one step is worth, and the symbol.
fn step_and_symbol(text: &str, language: Language) -> Option<(Ratio, String)> {
    let is_symbol = |text: &str| {
        text.starts_with(|c: char| c.is_alphabetic() || matches!(c, '%' | '°' | '‰' | '$'))
            && text.chars().count() <= 24
            && !text.contains([';', ',', '\n', ':', '='])
    };
    if let Some((per, symbol)) = text.split_once('/')
        && per.trim() == "1"
        && is_symbol(symbol)
    {
        // `1/min` is a symbol, `1/10 bar` has a step.
        return Some((Ratio::ONE, format!("1/{symbol}")));
    }
    if is_symbol(text) {
        return Some((Ratio::ONE, text.to_owned()));
    }
    let (step, symbol) = match text.split_once(' ').filter(|(step, _)| step.contains('/')) {
        Some((step, symbol)) => (od_spec::scalar::ratio(step)?, symbol.trim()),
        None => {
            let (step, symbol) = number(text, language)?;
            (od_spec::scalar::ratio(&step)?, symbol)
        }
    };
    let symbol = symbol.strip_prefix(['*', '·', '×']).map_or(symbol, str::trim_start);
    let is_rate = symbol.strip_prefix("1/").is_some_and(is_symbol);
    (step.numerator() > 0 && (is_symbol(symbol) || is_rate)).then(|| (step, symbol.to_owned()))
}

/// The units of a specification.
struct Units {
    list: Vec<UnitFacts>,
    /// Names of those that cells bring, by step and symbol.
    named: BTreeMap<(String, String), String>,
}

/// Names of symbols that cannot be in an identifier.
const NAMES: [(&str, &str); 8] = [
    ("%", "percent"),
    ("‰", "permille"),
    ("°C", "celsius"),
    ("°", "degree"),
    ("1/min", "per minute"),
    ("min-1", "per minute"),
    ("1/s", "per second"),
    ("$", "dollar"),
];

impl Units {
    const fn new(list: Vec<UnitFacts>) -> Self {
        Self { list, named: BTreeMap::new() }
    }

    /// Whether a table of units defines one of this name.
    fn is_named(&self, name: &str) -> bool {
        self.list.iter().any(|unit| unit.name.value == name && !unit.keys.is_empty())
    }

    /// The name of a unit with a step.
    fn of(&mut self, step: Ratio, symbol: &str, span: Span) -> String {
        let shown = if step.denominator() == 1 {
            step.numerator().to_string()
        } else {
            format!("{}/{}", step.numerator(), step.denominator())
        };
        let key = (shown.clone(), symbol.to_owned());
        if let Some(name) = self.named.get(&key) {
            return name.clone();
        }
        let word = NAMES.iter().find(|(known, _)| *known == symbol).map_or(symbol, |(_, name)| *name);
        let prefix = match (step.numerator(), step.denominator()) {
            (1, 1) => String::new(),
            (1, 10) => "deci".to_owned(),
            (1, 100) => "centi".to_owned(),
            (1, 1000) => "milli".to_owned(),
            _ => format!("{} ", shown.replace('/', " by ")),
        };
        let name = format!("{prefix}{word}");
        let is_taken = |name: &str| self.list.iter().any(|unit| unit.name.value == name);
        let numbered = (2..1000).map(|number| format!("{name} {number}"));
        let free = std::iter::once(name.clone()).chain(numbered).find(|name| !is_taken(name)).unwrap_or(name);
        let mut keys = BTreeMap::from([("symbol", Spanned::new(symbol.to_owned(), span))]);
        if step != Ratio::ONE {
            keys.insert("scale", Spanned::new(shown, span));
        }
        self.list.push(UnitFacts { name: Spanned::new(free.clone(), span), keys, about: Texts::new() });
        self.named.insert(key, free.clone());
        free
    }
}

/// A default or limit as a specification writes it. Empty where there is none.
fn value(
    text: &str,
    data_type: Option<DataType>,
    has_list: bool,
    language: Language,
) -> Result<String, &'static str> {
    let of_type = data_type.map(DataType::family);
    match of_type {
        Some(Family::VisibleString | Family::UnicodeString | Family::OctetString) => {
            return Ok(spelled(in_quotes(text).unwrap_or(text)));
        }
        Some(Family::Boolean) => {
            let is_true = yes_no(text).ok_or("yes or no")?;
            return Ok(if is_true { "yes" } else { "no" }.to_owned());
        }
        Some(Family::Signed | Family::Unsigned | Family::Real | Family::Time | Family::Domain) | None => {}
    }
    let is_exponent = |text: &str| {
        text.starts_with(|c: char| c.is_ascii_digit() || c == '-')
            && text.contains(['e', 'E'])
            && text.parse::<f64>().is_ok_and(f64::is_finite)
    };
    if of_type == Some(Family::Real) && is_exponent(text) {
        return Ok(text.to_owned());
    }
    if let Some(offset) = of_node_id(text) {
        return Ok(if offset == 0 { "$NODEID".to_owned() } else { format!("$NODEID + 0x{offset:X}") });
    }
    if let Some((number, symbol)) = twice(text).map(|one| (one, "")).or_else(|| number(text, language)) {
        if symbol.is_empty() {
            return Ok(number);
        }
        return Ok(spelled(&format!("{number} {symbol}")));
    }
    // The name of a value.
    if has_list { Ok(spelled(text)) } else { Err("a number such as 100, 64h or 2.5 bar") }
}

/// A number that is written in two ways: `100 (64h)`.
fn twice(text: &str) -> Option<String> {
    let (one, other) = text.strip_suffix(')')?.split_once('(')?;
    let plain = |text: &str| {
        let text = text.trim();
        marked_hex(text).map(i128::from).or_else(|| od_spec::scalar::integer(text).ok())
    };
    let (one, other) = (plain(one)?, plain(other)?);
    (one == other).then(|| one.to_string())
}

/// What is between two quotes.
fn in_quotes(text: &str) -> Option<&str> {
    text.strip_prefix('"')?.strip_suffix('"')
}

fn storage(text: &str) -> Result<String, &'static str> {
    if yes_no(text) == Some(false) || plain(text) == "n" {
        return Ok(String::new());
    }
    let words = [Storage::Communication, Storage::Application, Storage::Manufacturer, Storage::Remanent];
    word(text, &words.map(Storage::word)).ok_or("no, communication, application, manufacturer or remanent")
}

fn word(text: &str, words: &[&str]) -> Option<String> {
    let text = plain(text);
    words.iter().find(|word| plain(word) == text).map(|word| (*word).to_owned())
}

fn plain_number(text: &str) -> Option<String> {
    od_spec::scalar::integer(text).ok().map(|number| number.to_string())
}

/// `255: off`, each on a line, or with semicolons between them.
fn special(text: &str) -> Result<String, &'static str> {
    let part = |part: &str| {
        let (value, name) = part.split_once([':', '='])?;
        let value = value.trim();
        let number = marked_hex(value).map(i128::from).or_else(|| od_spec::scalar::integer(value).ok())?;
        Some(format!("{number}: {}", spelled(name.trim())))
    };
    let parts = |separator: char| text.split(separator).map(part).collect::<Option<Vec<_>>>();
    let found = parts('\n').filter(|_| text.contains('\n')).or_else(|| parts(';')).or_else(|| parts('\n'));
    found.map(|parts| format!("{{{}}}", parts.join(", "))).ok_or("values with their names, such as 255: off")
}

/// Whether a fact is kept as its text, which is not put into quotes yet.
pub(crate) const fn is_text(fact: Fact) -> bool {
    matches!(fact, Fact::Name | Fact::Identifier | Fact::Since | Fact::WriteCondition)
}

/// The shape of an object: as it is said, or as its sub-indices show.
pub(crate) fn shape(object: &ObjectFacts) -> ObjectKind {
    let has_subs = object.subs.keys().any(|sub| *sub != 0);
    match &object.kind {
        Some(kind) => kind.value,
        None if has_subs => ObjectKind::Record,
        None => ObjectKind::Var,
    }
}

/// What is said about sub-index 0 of a VAR is about the object; where they differ, the object counts.
fn join(own: &mut EntryFacts, sub: EntryFacts) {
    own.data_type = own.data_type.or(sub.data_type);
    own.list = own.list.take().or(sub.list);
    own.access = own.access.or(sub.access);
    for (fact, cell) in sub.stated {
        own.stated.entry(fact).or_insert(cell);
    }
    for (language, text) in sub.about {
        own.about.entry(language).or_insert(text);
    }
    own.comments.extend(sub.comments);
}

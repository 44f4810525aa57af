//! Names in conditions: entries, bits and values of enums become indices and numbers.

use std::collections::BTreeMap;

use super::bit_values;
use super::refs::{Broken, Names};
use super::scope::unknown;
use crate::ast::Name;
use crate::check::codes as rule_codes;
use crate::decode::inside;
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::expr::{ConditionError, EntryRef, Expr, Lookup, Named, Operand, PLACEHOLDER, without_names};
use crate::model::{Entry, EntryId, EnumValue, Fact, Index, Object, Ratio, TypeKind};
use crate::source::{Span, Spanned};

/// The objects of a device, and their names.
pub(super) struct Described<'a> {
    key: &'a str,
    objects: &'a BTreeMap<Index, Object>,
    names: Names<'a>,
}

impl<'a> Described<'a> {
    pub(super) fn new(key: &'a str, objects: &'a BTreeMap<Index, Object>) -> Self {
        Self { key, objects, names: Names::new(objects.values()) }
    }

    fn entry(&self, id: EntryId) -> Option<&'a Entry> {
        self.objects.get(&id.index)?.entry(id.sub)
    }
}

/// Looks the names up in the write conditions of a device.
pub(super) fn write_conditions(
    key: &str,
    objects: &mut BTreeMap<Index, Object>,
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) {
    let unresolved = |entry: &Entry| entry.writable_when.as_ref().is_some_and(Expr::is_unresolved);
    let is_stated = |entry: &Entry| entry.facts.get(Fact::WriteCondition).is_some();
    let entries =
        objects.values().flat_map(|object| object.entries.iter().map(|entry| (object.index, entry)));
    let open: Vec<(EntryId, Spanned<String>)> = entries
        .filter(|(_, entry)| unresolved(entry) && is_stated(entry))
        .filter_map(|(index, entry)| {
            let text = entry.writable_when.as_ref()?.text.clone();
            Some((EntryId { index, sub: entry.sub }, Spanned::new(text, entry.place(Fact::WriteCondition))))
        })
        .collect();
    if open.is_empty() {
        return;
    }
    let described = Described::new(key, objects);
    let found: Vec<(EntryId, Option<Expr>)> = open
        .iter()
        .map(|(id, text)| {
            (*id, resolve(text, &described, std::slice::from_ref(&described), broken, diagnostics))
        })
        .collect();
    for (id, condition) in found {
        set(objects, id, condition);
    }
    // Views have the condition of what they show.
    let views = objects.values().flat_map(|object| object.entries.iter().map(|entry| (object.index, entry)));
    let views: Vec<(EntryId, Option<Expr>)> = views
        .filter(|(_, entry)| unresolved(entry))
        .map(|(index, entry)| {
            let target = entry.alias.as_ref().map(|alias| alias.target);
            let target = target.and_then(|target| objects.get(&target.index)?.entry(target.sub));
            let condition = target.and_then(|target| target.writable_when.clone());
            (EntryId { index, sub: entry.sub }, condition)
        })
        .collect();
    for (id, condition) in views {
        set(objects, id, condition);
    }
}

fn set(objects: &mut BTreeMap<Index, Object>, id: EntryId, condition: Option<Expr>) {
    let entries = objects.get_mut(&id.index).map(|object| object.entries.iter_mut());
    if let Some(entry) = entries.into_iter().flatten().find(|entry| entry.sub == id.sub) {
        entry.writable_when = condition;
    }
}

/// A condition whose names are those of a device, and of others where it names these.
pub(super) fn resolve(
    text: &Spanned<String>,
    own: &Described<'_>,
    all: &[Described<'_>],
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) -> Option<Expr> {
    let shown = Spanned::new(text.value.as_str(), text.span);
    if text.value.contains(PLACEHOLDER) {
        diagnostics.push(
            Diagnostic::new(codes::BAD_NOTATION, text.span, "`{n}` has no number here")
                .help("write a number; only a constraint can have several"),
        );
        return None;
    }
    let before = diagnostics.errors_found();
    let read = without_names(&text.value, &mut OfDevice { text: shown, own, all, broken, diagnostics });
    if diagnostics.errors_found() > before {
        return None;
    }
    match read.and_then(|plain| Expr::parse(&plain)) {
        Ok(mut condition) => {
            // It has another length than what is written.
            let whole = 0..condition.text.len();
            condition.places.fill(whole);
            Some(condition)
        }
        Err(ConditionError { message, .. }) => {
            diagnostics.push(
                Diagnostic::new(
                    codes::BAD_NOTATION,
                    text.span,
                    format!("cannot read this condition: {message}"),
                )
                .help("correct the condition, or the numbers of `{n}`"),
            );
            None
        }
    }
}

/// Whom a condition on a device asks for its names.
struct OfDevice<'a, 'd> {
    text: Spanned<&'a str>,
    own: &'a Described<'a>,
    all: &'a [Described<'a>],
    broken: &'a Broken,
    diagnostics: &'d mut Diagnostics,
}

impl<'a> OfDevice<'a, '_> {
    fn place(&self, name: &Named<'_>) -> Span {
        inside(self.text, &name.range)
    }

    fn device(&self, key: Option<&str>) -> Option<&'a Described<'a>> {
        match key {
            Some(key) if key != self.own.key => self.all.iter().find(|one| one.key == key),
            Some(_) | None => Some(self.own),
        }
    }

    fn find(&self, entry: &EntryRef) -> Option<&'a Entry> {
        self.device(entry.device.as_deref())?.entry(entry.id)
    }
}

/// A condition compares values, and an object with several has none of its own.
fn whole_object(object: &Object, place: Span) -> Diagnostic {
    let (name, index) = (shorten(&object.name), object.index);
    let first = object.entries.iter().find(|entry| entry.sub.0 > 0);
    let example = first
        .map_or_else(|| format!("0x{:04X}.1", index.0), |entry| format!("{name}.{}", shorten(&entry.name)));
    Diagnostic::new(
        codes::BAD_NOTATION,
        place,
        format!("`{name}` has several entries, and a condition compares one"),
    )
    .help(format!("name one, such as `{example}`; `0x{:04X}.0` is how many there are", index.0))
}

/// The named values of an entry.
fn values(entry: &Entry) -> &[EnumValue] {
    match entry.named_type.as_ref().map(|named| &named.kind) {
        Some(TypeKind::Enum(values)) => values,
        Some(TypeKind::Bits(_)) | None => &[],
    }
}

/// The raw value that an entry calls so.
fn value(entry: &Entry, name: &str) -> Option<i128> {
    let listed = values(entry).iter().find(|value| value.name == name).map(|value| value.value);
    let special = || entry.special.iter().find(|special| special.name == name).map(|special| special.value);
    listed.or_else(special)
}

/// What a raw value is where conditions compare.
fn quantity(entry: &Entry, raw: i128) -> Option<Ratio> {
    entry.unit.as_ref().map_or(Some(Ratio::whole(raw)), |unit| unit.quantity(raw))
}

impl Lookup for OfDevice<'_, '_> {
    fn entry(&mut self, name: &Named<'_>) -> Option<EntryId> {
        let place = self.place(name);
        let Some(described) = self.device(name.device) else {
            let key = name.device.unwrap_or_default();
            let at = self.text.value[..name.range.start].rfind(key).unwrap_or(name.range.start);
            let key: Name = Spanned::new(key.to_owned(), inside(self.text, &(at..at + key.len())));
            let keys = self.all.iter().map(|one| one.key);
            let otherwise = "name a device of the specification";
            unknown(codes::UNKNOWN_DEVICE, &key, "device", keys, otherwise, self.diagnostics);
            return None;
        };
        let reference = Spanned::new(name.text.to_owned(), place);
        let exists = |id| described.entry(id).is_some();
        let id = described.names.find(&reference, exists, self.broken, self.diagnostics)?;
        let object = described.objects.get(&id.index).filter(|object| object.is_structured());
        // Its sub-index 0 is how many entries it has, which is never meant by its name.
        if let Some(object) = object.filter(|object| id.sub.0 == 0 && object.is_called(name.text)) {
            self.diagnostics.push(whole_object(object, place));
            return None;
        }
        Some(id)
    }

    fn operand(&mut self, compared: &EntryRef, name: &Named<'_>) -> Option<Operand> {
        // What cannot be found is reported by itself, and its values cannot be known.
        let entry = self.find(compared)?;
        let as_entry = self.own.names.get(name.text);
        let is_entry = as_entry.first().is_some();
        let Some(raw) = value(entry, name.text) else {
            let names = values(entry).iter().map(|value| value.name.as_str());
            let meant = self.diagnostics.suggestions.nearest(name.text, names).filter(|_| !is_entry);
            let Some(meant) = meant else { return self.entry(name).map(Operand::Entry) };
            let message = format!("`{}` is not a value of `{}`", shorten(name.text), shorten(&entry.name));
            self.diagnostics.push(
                Diagnostic::new(rule_codes::UNKNOWN_ENUM_VALUE, inside(self.text, &name.range), message)
                    .did_you_mean(meant),
            );
            return None;
        };
        if let Some(id) = as_entry.first() {
            let message = format!(
                "`{}` is a value of `{}`, and the name of {id}",
                shorten(name.text),
                shorten(&entry.name)
            );
            self.diagnostics.push(
                Diagnostic::new(codes::BAD_NOTATION, self.place(name), message)
                    .help(format!("write {raw} for the value, or the index for the entry")),
            );
            return None;
        }
        quantity(entry, raw).map(Operand::Number)
    }

    fn bit(&mut self, of: &EntryRef, name: &Named<'_>) -> Option<u8> {
        let place = self.place(name);
        // An entry that nothing has was reported.
        let entry = self.find(of)?;
        let Some(TypeKind::Bits(fields)) = entry.named_type.as_ref().map(|named| &named.kind) else {
            let message = format!("the type of `{}` is not a bit field", shorten(&entry.name));
            self.diagnostics.push(
                Diagnostic::new(codes::UNKNOWN_BIT, place, message).help("write the number of the bit"),
            );
            return None;
        };
        let field = bit_values::field(
            fields,
            &Spanned::new(name.text.to_owned(), place),
            bit_values::BY_NUMBER,
            self.diagnostics,
        )?;
        if field.first != field.last {
            let message = format!("`{}` is bits {} to {}", shorten(name.text), field.first, field.last);
            self.diagnostics.push(
                Diagnostic::new(codes::UNKNOWN_BIT, place, message)
                    .help("write the number of one of them; `bit` asks for one"),
            );
            return None;
        }
        Some(field.first)
    }
}

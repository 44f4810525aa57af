//! Functions that read and write single entries, from inside the device: no access, lock or limit is applied.

use od_gen::plan::{Place, PlannedEntry, PlannedObject, ValueKind, default_integer, is_accessible};
use od_spec::model::Outside;

use super::super::page::Page;
use super::raw::Raw;
use super::{dictionary_type, inline, table};

/// The type of an entry's values.
pub(super) fn value_type(page: &Page<'_, '_>, kind: &ValueKind, raw: Raw) -> String {
    kind.named.as_ref().map_or_else(|| raw.type_name(), |named| page.names.type_of(named))
}

/// What reads and writes an entry.
pub(super) fn of_entry(page: &mut Page<'_, '_>, entry: &PlannedEntry<'_>) {
    let raw = Raw::of(page.plan, &entry.kind);
    match (entry.place, raw) {
        (Place::Application, _) | (_, Raw::Nothing) => {}
        (Place::Alias, _) => view(page, entry, raw),
        (Place::Image(_), Raw::String) => {
            get_string(page, entry);
            set_string(page, entry);
        }
        (Place::Constant(_), Raw::String) => get_string(page, entry),
        (Place::Image(at), _) => {
            let pointer = format!("&od->image[{at}]");
            getter(page, entry, raw, raw.load(&pointer));
            setter(page, entry, raw, raw.store(&pointer, "value"));
        }
        // A number of entries that never changes is a constant of the shape.
        (Place::Constant(_), _) if !is_accessible(entry) => {}
        (Place::Constant(at), _) => {
            let number = entry.entry.default.as_ref().filter(|_| default_integer(entry.entry).is_some());
            let literal = number.and_then(|number| raw.literal(number));
            let constant = literal.or_else(|| raw.load(&format!("&{}.constants[{at}]", table(page.names))));
            getter(page, entry, raw, constant);
        }
    }
}

/// Enters the name of a function.
fn function(page: &mut Page<'_, '_>, parts: &[&str], entry: &PlannedEntry<'_>) -> String {
    let name = page.names.function(parts);
    page.enter(&name, &entry.id.to_string());
    name
}

fn getter(page: &mut Page<'_, '_>, entry: &PlannedEntry<'_>, raw: Raw, value: Option<String>) {
    let Some(value) = value else { return };
    let name = function(page, &["get", &entry.name], entry);
    let od = format!("const {} *od", dictionary_type(page.names));
    let of = value_type(page, &entry.kind, raw);
    inline(&mut page.text, &of, &name, &[&od], |text| {
        if !value.contains("od->") {
            text.line("(void)od;");
        }
        text.line(&format!("return {value};"));
    });
}

/// A setter; of a width that C does not have, one that returns whether the value fits.
fn setter(page: &mut Page<'_, '_>, entry: &PlannedEntry<'_>, raw: Raw, store: Option<String>) {
    let Some(store) = store else { return };
    let name = function(page, &["set", &entry.name], entry);
    let od = format!("{} *od", dictionary_type(page.names));
    let value = format!("{} value", value_type(page, &entry.kind, raw));
    let outside = raw.is_outside();
    let returned = if outside.is_some() { "bool" } else { "void" };
    inline(&mut page.text, returned, &name, &[&od, &value], |text| {
        if let Some(outside) = &outside {
            text.block(&format!("if ({outside}) {{"), "}", |text| text.line("return false;"));
        }
        text.line(&store);
        if outside.is_some() {
            text.line("return true;");
        }
    });
}

fn get_string(page: &mut Page<'_, '_>, entry: &PlannedEntry<'_>) {
    let name = function(page, &["get", &entry.name], entry);
    let (od, table) = (format!("const {} *od", dictionary_type(page.names)), table(page.names));
    let row = page.names.macro_of(&["ENTRY", &entry.name]);
    inline(&mut page.text, "od_bytes_t", &name, &[&od], |text| {
        text.line(&format!("return od_get_string(&{table}, od->image, {row});"));
    });
}

fn set_string(page: &mut Page<'_, '_>, entry: &PlannedEntry<'_>) {
    let name = function(page, &["set", &entry.name], entry);
    let (od, table) = (format!("{} *od", dictionary_type(page.names)), table(page.names));
    let row = page.names.macro_of(&["ENTRY", &entry.name]);
    inline(&mut page.text, "bool", &name, &[&od, "const uint8_t *bytes", "size_t length"], |text| {
        text.line(&format!("return od_set_string(&{table}, od->image, {row}, bytes, length);"));
    });
}

/// What shows another entry. One that may have nothing to show returns so.
fn view(page: &mut Page<'_, '_>, entry: &PlannedEntry<'_>, raw: Raw) {
    let plan = page.plan;
    let row = plan.row(entry.id);
    let Some(alias) = plan.aliases.iter().find(|alias| Some(alias.row) == row) else { return };
    let (Raw::Integer(integer, bits), Some(target)) = (raw, plan.entry(alias.target)) else { return };
    let (od, table) = (dictionary_type(page.names), table(page.names));
    let of = value_type(page, &entry.kind, raw);
    let row = page.names.macro_of(&["ENTRY", &entry.name]);
    let name = function(page, &["get", &entry.name], entry);
    let (read, value) = (format!("const {od} *od"), format!("{of} *value"));
    // A word on a signed type is shown with its sign, of which its own bits stay.
    let is_word = entry.entry.data_type.is_signed() && !integer.signed;
    let mask = (is_word && bits < integer.bits.into()).then(|| integer.literal((1 << bits) - 1));
    let number = match &mask {
        Some(mask) => format!("({of})((uint64_t)number & {mask})"),
        None => format!("({of})number"),
    };
    let get = format!("od_get_view(&{table}, od->image, {row}, &number)");
    if alias.outside == Outside::Abort {
        inline(&mut page.text, "bool", &name, &[&read, &value], |text| {
            text.line("int64_t number;");
            text.line(&format!("bool is_shown = {get};"));
            text.line(&format!("*value = {number};"));
            text.line("return is_shown;");
        });
    } else {
        inline(&mut page.text, &of, &name, &[&read], |text| {
            text.line("int64_t number;");
            text.line(&format!("(void){get};"));
            text.line(&format!("return {number};"));
        });
    }
    if entry.entry.access.is_writable() && matches!(target.place, Place::Image(_)) && !is_word {
        let name = function(page, &["set", &entry.name], entry);
        let (write, value) = (format!("{od} *od"), format!("{of} value"));
        inline(&mut page.text, "bool", &name, &[&write, &value], |text| {
            text.line(&format!("return od_set_view(&{table}, od->image, {row}, (int64_t)value);"));
        });
    }
}

/// What reads and writes an element by its sub-index, where all are alike and lie one after the other. False for a
/// sub-index that there is not, or a value that does not fit.
pub(super) fn of_elements(page: &mut Page<'_, '_>, planned: &PlannedObject<'_>) {
    let elements: Vec<_> = page.plan.entries_of(planned).filter(|entry| entry.id.sub.0 > 0).collect();
    let Some(first) = elements.first() else { return };
    let Place::Image(start) = first.place else { return };
    let raw = Raw::of(page.plan, &first.kind);
    let pointer = format!("&od->image[{start}U + (((size_t)sub - 1U) * {}U)]", first.size);
    let (Some(load), Some(store)) = (raw.load(&pointer), raw.store(&pointer, "value")) else { return };
    let of = value_type(page, &first.kind, raw);
    let highest = elements.len();
    let is_missing =
        if highest == 255 { "sub < 1U".to_owned() } else { format!("(sub < 1U) || (sub > {highest}U)") };
    let od = dictionary_type(page.names);
    page.text.gap();
    page.text.comment(&format!(
        "{} by sub-index, 1 to {highest}; false for another one, and for a value that does not fit.",
        planned.object.name
    ));
    let name = function(page, &["get_element_of", &planned.name], first);
    let (read, out) = (format!("const {od} *od"), format!("{of} *value"));
    inline(&mut page.text, "bool", &name, &[&read, "uint8_t sub", &out], |text| {
        text.block(&format!("if ({is_missing}) {{"), "}", |text| text.line("return false;"));
        text.line(&format!("*value = {load};"));
        text.line("return true;");
    });
    let name = function(page, &["set_element_of", &planned.name], first);
    let (write, value) = (format!("{od} *od"), format!("{of} value"));
    let refused = match raw.is_outside() {
        Some(outside) => format!("{is_missing} || {outside}"),
        None => is_missing,
    };
    inline(&mut page.text, "bool", &name, &[&write, "uint8_t sub", &value], |text| {
        text.block(&format!("if ({refused}) {{"), "}", |text| text.line("return false;"));
        text.line(&store);
        text.line("return true;");
    });
}

//! `OD.h`: how many objects there are, the variables of their values, and short names for the objects.

use std::collections::BTreeMap;

use od_spec::model::{Dictionary, SubIndex};
use od_spec::wording::{Notation, Wording};

use super::super::prefix::Prefix;
use super::super::text::Text;
use super::cell::Cell;
use super::counters::{COUNTERS, SETTINGS, of_labels};
use super::docs::Docs;
use super::groups::{AUTOMATIC, COMMAND, Group, GroupStorage, RESTORE};
use super::objects::{Shape, Slot, StackObject, groups_of};
use super::rules::Rules;

/// What is between the lines that keep the file from being read twice.
pub(super) fn print(
    text: &mut Text,
    docs: Docs<'_, '_>,
    prefix: &Prefix,
    objects: &[StackObject<'_>],
    rules: &Rules<'_, '_>,
) {
    text.comment("Include `301/CO_ODinterface.h` of the stack before this file: it defines the types.");
    text.gap();
    text.line("#ifdef __cplusplus");
    text.line("extern \"C\" {");
    text.line("#endif");
    counters(text, prefix, objects);
    elements(text, prefix, objects);
    for group in groups_of(objects) {
        variables(text, docs, prefix, group, objects);
    }
    dictionary(text, prefix);
    storage(text, docs.plan.device, prefix, objects);
    entries(text, prefix, objects);
    sub_indices(text, prefix, objects);
    if !rules.views.is_empty() {
        text.gap();
        text.comment("Some entries are views of others: what shows them is compiled.");
        text.line(&format!("#define {prefix}_HAS_VIEWS"));
    }
    configuration(text, prefix, objects);
    text.gap();
    text.line("#ifdef __cplusplus");
    text.line("}");
    text.line("#endif");
}

fn counters(text: &mut Text, prefix: &Prefix, objects: &[StackObject<'_>]) {
    text.gap();
    text.comment("How many objects of each kind there are: the stack makes room by these numbers.");
    for counter in &COUNTERS {
        let count = counter.count(objects);
        if count > 0 {
            text.define(&format!("{prefix}_CNT_{}", counter.name), &format!("{count}"));
        }
    }
    for (label, count) in of_labels(objects) {
        text.define(&format!("{prefix}_CNT_{label}"), &format!("{count}"));
    }
}

fn elements(text: &mut Text, prefix: &Prefix, objects: &[StackObject<'_>]) {
    let mut arrays =
        objects.iter().filter_map(|object| Some((object.object.index, object.elements()?))).peekable();
    if arrays.peek().is_none() {
        return;
    }
    text.gap();
    text.comment("Elements of each ARRAY, without sub-index 0.");
    for (index, count) in arrays {
        text.define(&format!("{prefix}_CNT_ARR_{:04X}", index.0), &format!("{count}"));
    }
}

/// The values of a group, in the order of the objects.
fn variables(
    text: &mut Text,
    docs: Docs<'_, '_>,
    prefix: &Prefix,
    group: Group<'_>,
    objects: &[StackObject<'_>],
) {
    let name = group.name;
    let words = Wording::english(Notation::Rust);
    let about = match words.storage(group.storage) {
        "" if group.is_usual() => "Values that are lost at power-off.".to_owned(),
        "" => "Values of a group that no command stores.".to_owned(),
        kept => format!(
            "Values that are {kept}. Another order of the members makes another layout: what was stored before does not fit it."
        ),
    };
    text.gap();
    text.doc(&about);
    text.block("typedef struct {", &format!("}} {prefix}_{name}_t;"), |text| {
        for object in objects {
            members(text, docs, prefix, group, object);
        }
    });
    text.gap();
    text.comment("Before the variable, for the linker: a section, for one.");
    text.line(&format!("#ifndef {prefix}_ATTR_{name}"));
    text.line(&format!("#define {prefix}_ATTR_{name}"));
    text.line("#endif");
    text.line(&format!("extern {prefix}_ATTR_{name} {prefix}_{name}_t {prefix}_{name};"));
}

fn members(text: &mut Text, docs: Docs<'_, '_>, prefix: &Prefix, group: Group<'_>, object: &StackObject<'_>) {
    let cell_in = |slot: &Slot<'_>| slot.variable().filter(|(of, _)| *of == group).map(|(_, cell)| cell);
    let variable = object.variable();
    match &object.shape {
        Shape::Var(slot) => {
            if let Some(cell) = cell_in(slot) {
                text.doc(&docs.object(object));
                text.line(&declaration(cell, &variable, ""));
            }
        }
        Shape::Array { count, elements } => {
            if let Some(cell) = cell_in(count) {
                text.doc(&docs.member(count));
                text.line(&declaration(cell, &format!("{variable}_sub0"), ""));
            }
            if let Some(cell) = elements.first().and_then(cell_in) {
                text.doc(&docs.object(object));
                text.line(&declaration(
                    cell,
                    &variable,
                    &format!("[{prefix}_CNT_ARR_{:04X}]", object.object.index.0),
                ));
            }
        }
        Shape::Record(slots) => {
            if !slots.iter().any(|slot| cell_in(slot).is_some()) {
                return;
            }
            text.doc(&docs.object(object));
            text.block("struct {", &format!("}} {variable};"), |text| {
                for slot in slots {
                    if let Some(cell) = cell_in(slot) {
                        text.doc(&docs.member(slot));
                        text.line(&declaration(cell, &slot.name, ""));
                    }
                }
            });
        }
    }
}

fn declaration(cell: Cell, name: &str, elements: &str) -> String {
    format!("{} {name}{elements}{};", cell.type_name(), cell.dimension())
}

fn dictionary(text: &mut Text, prefix: &Prefix) {
    text.gap();
    text.comment("The dictionary.");
    text.line(&format!("#ifndef {prefix}_ATTR_OD"));
    text.line(&format!("#define {prefix}_ATTR_OD"));
    text.line("#endif");
    text.line(&format!("extern {prefix}_ATTR_OD OD_t *{prefix};"));
}

/// What the application's list of storage has for each group.
fn storage(text: &mut Text, device: &Dictionary, prefix: &Prefix, objects: &[StackObject<'_>]) {
    let stored = || groups_of(objects).into_iter().filter_map(|group| Some((group, group.stored(device)?)));
    if stored().next().is_none() {
        return;
    }
    text.gap();
    text.comment(&prefix.in_text(
        "Storage: members of an entry of the application's `CO_storage_entry_t` list, which goes to the stack's storage. An entry takes what else a \
         driver needs: `{OD_STORAGE_PERSIST_COMM, .filename = \"comm\"}`. All of them, for a driver that needs nothing else: `CO_storage_entry_t \
         list[] = {OD_STORAGE_ENTRIES};`",
    ));
    for (group, GroupStorage { sub, attributes }) in stored() {
        let by =
            [(COMMAND, "stored by 1010h"), (AUTOMATIC, "stored by itself"), (RESTORE, "restored by 1011h")];
        let by: Vec<&str> =
            by.into_iter().filter(|(flag, _)| attributes & flag != 0).map(|(_, word)| word).collect();
        let by = if by.is_empty() {
            "no command stores it: the device has no 1010h".to_owned()
        } else {
            by.join(", ")
        };
        text.doc(&format!("Sub-index {sub}; {by}."));
        let name = group.name;
        text.line(&format!("#define {prefix}_STORAGE_{name} \\"));
        text.line(&format!(
            "    .addr = &{prefix}_{name}, .len = sizeof({prefix}_{name}), .subIndexOD = {sub}U, .attr = 0x{attributes:02X}U"
        ));
    }
    let all: Vec<String> =
        stored().map(|(group, _)| format!("{{{prefix}_STORAGE_{}}}", group.name)).collect();
    text.doc("All groups that are stored.");
    text.define(&format!("{prefix}_STORAGE_ENTRIES"), &all.join(", "));
}

/// Short names of the objects, and the same with what they are called.
fn entries(text: &mut Text, prefix: &Prefix, objects: &[StackObject<'_>]) {
    text.gap();
    text.comment("Objects of the dictionary.");
    for (at, object) in objects.iter().enumerate() {
        text.define(
            &format!("{prefix}_ENTRY_H{:04X}", object.object.index.0),
            &format!("(&{prefix}->list[{at}])"),
        );
    }
    text.gap();
    text.comment("Objects of the dictionary, with their names.");
    // No two are equal: the index is in each.
    let names: BTreeMap<usize, String> = objects
        .iter()
        .enumerate()
        .map(|(at, object)| (at, format!("{:04X}_{}", object.object.index.0, object.name)))
        .collect();
    for (at, name) in names {
        text.define(&format!("{prefix}_ENTRY_H{name}"), &format!("(&{prefix}->list[{at}])"));
    }
}

/// The sub-indices of records, by the names of their entries.
fn sub_indices(text: &mut Text, prefix: &Prefix, objects: &[StackObject<'_>]) {
    let records: Vec<(&StackObject<'_>, &[Slot<'_>])> = objects
        .iter()
        .filter_map(|object| match &object.shape {
            Shape::Record(slots) => Some((object, slots.as_slice())),
            Shape::Var(_) | Shape::Array { .. } => None,
        })
        .collect();
    if records.is_empty() {
        return;
    }
    text.gap();
    text.comment("Sub-indices of records, by the names of their entries.");
    for (object, slots) in records {
        for slot in slots.iter().filter(|slot| slot.id.sub != SubIndex(0)) {
            let name = format!("{prefix}_SUB_H{:04X}_{}", object.object.index.0, slot.name);
            text.define(&name, &format!("({}U)", slot.id.sub));
        }
    }
}

fn configuration(text: &mut Text, prefix: &Prefix, objects: &[StackObject<'_>]) {
    text.gap();
    text.comment("The configuration of the stack, where several dictionaries are compiled together.");
    text.line("#ifdef CO_MULTIPLE_OD");
    text.line(&format!("#define {prefix}_INIT_CONFIG(config) {{ \\"));
    for setting in &SETTINGS {
        let (member, value) = setting.assignment(prefix, objects);
        text.line(&format!("    (config).{member} = {value}; \\"));
    }
    text.line("}");
    text.line("#endif");
}

//! `OD.c`: the values, the objects, and the list of them that the stack searches.

use od_spec::model::{DataType, Dictionary};

use super::super::prefix::Prefix;
use super::super::text::Text;
use super::cell::Cell;
use super::groups::{Group, has_groups};
use super::initial::initialiser;
use super::objects::{Memory, Shape, Slot, StackObject, groups_of};

/// Everything after the head of the file.
pub(super) fn print(text: &mut Text, device: &Dictionary, prefix: &Prefix, objects: &[StackObject<'_>]) {
    text.comment("The stack shows the types of objects only to files that define this.");
    text.line("#define OD_DEFINITION");
    text.line("#include \"301/CO_ODinterface.h\"");
    text.line(&format!("#include \"{prefix}.h\""));
    let groups = groups_of(objects);
    for group in &groups {
        let values = Values { device, groups: &groups, group: *group };
        variables(text, prefix, values, objects);
    }
    object_types(text, objects);
    object_values(text, prefix, objects);
    list(text, prefix, objects);
}

/// The values of a group, among all groups.
#[derive(Clone, Copy)]
struct Values<'g, 'a> {
    device: &'a Dictionary,
    groups: &'g [Group<'a>],
    group: Group<'a>,
}

impl Values<'_, '_> {
    /// What a value of the group begins with. A command that stores or restores says so, where the dictionary does not.
    fn of(self, slot: &Slot<'_>) -> Option<String> {
        let (_, cell) = slot.variable().filter(|(of, _)| *of == self.group)?;
        let is_command = slot.entry.default.is_none()
            && slot.entry.data_type == DataType::Unsigned32
            && has_groups(self.device, self.groups, slot.id) == Some(true);
        Some(if is_command { "0x00000001UL".to_owned() } else { initialiser(slot.id, slot.entry, cell) })
    }
}

/// A group with what it begins with.
fn variables(text: &mut Text, prefix: &Prefix, values: Values<'_, '_>, objects: &[StackObject<'_>]) {
    let name = values.group.name;
    text.gap();
    text.block(&format!("{prefix}_ATTR_{name} {prefix}_{name}_t {prefix}_{name} = {{"), "};", |text| {
        for object in objects {
            members(text, values, object);
        }
    });
}

fn members(text: &mut Text, values: Values<'_, '_>, object: &StackObject<'_>) {
    let value_in = |slot: &Slot<'_>| values.of(slot);
    let variable = object.variable();
    match &object.shape {
        Shape::Var(slot) => {
            if let Some(value) = value_in(slot) {
                text.value(&format!(".{variable}"), &value);
            }
        }
        Shape::Array { count, elements } => {
            if let Some(value) = value_in(count) {
                text.value(&format!(".{variable}_sub0"), &value);
            }
            let values: Vec<String> = elements.iter().filter_map(value_in).collect();
            if !values.is_empty() {
                text.block(&format!(".{variable} = {{"), "},", |text| text.items(values.into_iter()));
            }
        }
        Shape::Record(slots) => {
            let values: Vec<(&str, String)> =
                slots.iter().filter_map(|slot| Some((slot.name.as_str(), value_in(slot)?))).collect();
            if !values.is_empty() {
                text.block(&format!(".{variable} = {{"), "},", |text| {
                    for (member, value) in values {
                        text.value(&format!(".{member}"), &value);
                    }
                });
            }
        }
    }
}

/// The type of all objects together.
fn object_types(text: &mut Text, objects: &[StackObject<'_>]) {
    text.gap();
    text.block("typedef struct {", "} ODObjs_t;", |text| {
        for object in objects {
            let name = object.constant();
            text.line(&match &object.shape {
                Shape::Var(_) => format!("OD_obj_var_t {name};"),
                Shape::Array { .. } => format!("OD_obj_array_t {name};"),
                Shape::Record(slots) => format!("OD_obj_record_t {name}[{}];", slots.len()),
            });
        }
    });
}

fn object_values(text: &mut Text, prefix: &Prefix, objects: &[StackObject<'_>]) {
    text.gap();
    text.block("static CO_PROGMEM ODObjs_t ODObjs = {", "};", |text| {
        for object in objects {
            let open = format!(".{} = {{", object.constant());
            text.block(&open, "},", |text| match &object.shape {
                Shape::Var(slot) => {
                    text.value(".dataOrig", &address(prefix, object, slot));
                    text.value(".attribute", &slot.attributes.expression());
                    text.value(".dataLength", &length(slot));
                }
                Shape::Array { count, elements } => array(text, prefix, object, count, elements),
                Shape::Record(slots) => {
                    for slot in slots {
                        text.block("{", "},", |text| {
                            text.value(".dataOrig", &address(prefix, object, slot));
                            text.value(".subIndex", &format!("{}U", slot.id.sub));
                            text.value(".attribute", &slot.attributes.expression());
                            text.value(".dataLength", &length(slot));
                        });
                    }
                }
            });
        }
    });
}

fn array(
    text: &mut Text,
    prefix: &Prefix,
    object: &StackObject<'_>,
    count: &Slot<'_>,
    elements: &[Slot<'_>],
) {
    let Some(first) = elements.first() else { return };
    text.value(".dataOrig0", &address(prefix, object, count));
    text.value(".dataOrig", &address(prefix, object, first));
    text.value(".attribute0", &count.attributes.expression());
    text.value(".attribute", &first.attributes.expression());
    text.value(".dataElementLength", &length(first));
    // From one element to the next: of a string, with what ends it.
    let stride = first.variable().map_or("0U".to_owned(), |(_, cell)| match cell.dimension() {
        dimension if dimension.is_empty() => format!("sizeof({})", cell.type_name()),
        dimension => format!("sizeof({}{dimension})", cell.type_name()),
    });
    text.value(".dataElementSizeof", &stride);
}

/// Where a value lies: the address of its first byte.
fn address(prefix: &Prefix, object: &StackObject<'_>, slot: &Slot<'_>) -> String {
    match (&slot.memory, object.path(slot)) {
        (Memory::Variable { group, cell }, Some(path)) => {
            let first = match cell {
                Cell::Boolean | Cell::Integer(_) | Cell::Real32 | Cell::Real64 => "",
                Cell::Bytes(_) | Cell::Characters(_) | Cell::WideCharacters(_) => "[0]",
            };
            format!("&{prefix}_{}.{path}{first}", group.name)
        }
        (Memory::Variable { .. } | Memory::Stack | Memory::View, _) => "NULL".to_owned(),
    }
}

fn length(slot: &Slot<'_>) -> String {
    format!("{}U", slot.length)
}

/// The list, in the order of the indices, and an entry that ends it.
fn list(text: &mut Text, prefix: &Prefix, objects: &[StackObject<'_>]) {
    text.gap();
    text.comment("By ascending index, as the stack searches it by bisection.");
    text.block(&format!("static {prefix}_ATTR_OD OD_entry_t ODList[] = {{"), "};", |text| {
        for object in objects {
            let count = object.slots().len();
            text.line(&format!(
                "{{0x{:04X}U, {count}U, {}, &ODObjs.{}, NULL}},",
                object.object.index.0,
                object.kind(),
                object.constant()
            ));
        }
        text.line("{0x0000U, 0U, 0U, NULL, NULL}");
    });
    text.gap();
    text.block("static OD_t ODDictionary = {", "};", |text| {
        text.line(&format!("{}U,", objects.len()));
        text.line("&ODList[0]");
    });
    text.gap();
    text.line(&format!("{prefix}_ATTR_OD OD_t *{prefix} = &ODDictionary;"));
}

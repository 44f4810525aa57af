//! The dictionary by itself: a header and a source for each device, and the reader and writer that they all share.

mod accessors;
mod entries;
mod pdos;
mod raw;
mod tables;

pub(crate) use self::entries::index_name;
use super::names::Names;
use super::page::Page;
use super::text::{Text, head};
use od_gen::Artifact;

/// The files of every dictionary.
pub(super) fn runtime() -> [Artifact; 2] {
    let file = |name: &str, text: &str, purpose: &str| Artifact {
        path: format!("c/{name}"),
        bytes: text.as_bytes().to_vec(),
        purpose: purpose.to_owned(),
    };
    [
        file("od_runtime.h", include_str!("runtime/od_runtime.h"), "what dictionaries in C have in common"),
        file(
            "od_runtime.c",
            include_str!("runtime/od_runtime.c"),
            "the reader and writer of dictionaries in C",
        ),
    ]
}

/// The name of a device's header or source.
pub(super) fn file(names: &Names, ending: &str) -> String {
    format!("{}_od.{ending}", names.device())
}

/// What is between the lines that keep the header from being read twice.
pub(super) fn header(page: &mut Page<'_, '_>) {
    page.text.line("#include \"OD_types.h\"");
    page.text.line("#include \"od_runtime.h\"");
    page.text.gap();
    page.text.line("#ifdef __cplusplus");
    page.text.line("extern \"C\" {");
    page.text.line("#endif");
    dictionary(page);
    entries::entries(page);
    pdos::pdos(page);
    page.text.gap();
    page.text.line("#ifdef __cplusplus");
    page.text.line("}");
    page.text.line("#endif");
}

/// The source.
pub(super) fn source(page: &mut Page<'_, '_>, about: &str) {
    head(&mut page.text, about);
    page.text.line(&format!("#include \"{}\"", file(page.names, "h")));
    tables::tables(page);
}

/// The type of the dictionary, and what the runtime does with it.
fn dictionary(page: &mut Page<'_, '_>) {
    let plan = page.plan;
    let (size, largest) = (
        plan.layout.factory.len(),
        plan.attributes.iter().map(|attributes| attributes.size).max().unwrap_or_default(),
    );
    page.text.gap();
    page.text.doc("Bytes of all values.");
    page.define(&["OD", "SIZE"], &format!("({size}UL)"), "the size of the image");
    page.text.doc(
        "Bytes of the largest value that SDO reads or writes as a whole, DOMAINs left out: what a server's buffer has to hold.",
    );
    page.define(&["OD", "LARGEST", "VALUE"], &format!("({largest}U)"), "the size of the largest value");
    page.text.gap();
    let about = page.words(&plan.device.about).to_owned();
    let facts = format!(
        "The values of the {}: {} objects, {} entries.",
        plan.device.name,
        plan.objects.len(),
        plan.entries.len()
    );
    page.text.doc(format!("{facts} {about}").trim());
    let name = dictionary_type(page.names);
    page.enter(&name, "the dictionary");
    // C has no arrays of nothing.
    let size = if size == 0 { "1".to_owned() } else { page.names.macro_of(&["OD", "SIZE"]) };
    page.text.block("typedef struct {", &format!("}} {name};"), |text| {
        text.line(&format!("uint8_t image[{size}];"));
    });
    page.text.gap();
    page.text.doc("What every entry is.");
    let table = table(page.names);
    page.enter(&table, "the table");
    page.text.line(&format!("extern const od_table_t {table};"));
    calls(page);
}

/// The type of a device's values.
fn dictionary_type(names: &Names) -> String {
    names.type_of("od")
}

/// The table of a device.
fn table(names: &Names) -> String {
    names.function(&["od", "table"])
}

/// Functions of the runtime that are called for this dictionary.
fn calls(page: &mut Page<'_, '_>) {
    let (od, table) = (dictionary_type(page.names), table(page.names));
    let read = format!("const {od} *od");
    let write = format!("{od} *od");
    let id = "uint16_t index, uint8_t sub";
    let data = "const uint8_t *data, size_t length";
    let application = "const od_application_t *application";
    let calls: [(&str, &str, String, String, &str); 11] = [
        (
            "void",
            "reset",
            format!("{write}, uint8_t node_id"),
            format!("od_reset(&{table}, od->image, node_id)"),
            "Gives every value what it has after a factory reset, for a node-ID from 1 to 127. Before anything else.",
        ),
        (
            "void",
            "reset_stored",
            format!("{write}, uint8_t storage, uint8_t node_id"),
            format!("od_reset_stored(&{table}, od->image, storage, node_id)"),
            "The same for the values of one storage group.",
        ),
        (
            "bool",
            "restore",
            format!("{write}, uint8_t storage, uint32_t layout, const uint8_t *bytes, size_t length"),
            format!("od_restore(&{table}, od->image, storage, layout, bytes, length)"),
            "Takes back the bytes of a storage group, which `od_stored` of the table gives, if they are of this layout.",
        ),
        (
            "bool",
            "correct_stored",
            format!("{write}, uint8_t storage, uint8_t node_id, od_row_t *first"),
            format!("od_correct_stored(&{table}, od->image, storage, node_id, first)"),
            "Corrects what a group has that its entries cannot have any more; true, and the first of them, if there was any.",
        ),
        (
            "uint32_t",
            "read",
            format!("{read}, {id}, od_value_t *value"),
            format!("od_read(&{table}, od->image, index, sub, value)"),
            "The value of an entry, as an SDO client reads it: OD_OK or the abort code.",
        ),
        (
            "uint32_t",
            "upload",
            format!("{read}, {id}, od_value_t *value, {application}"),
            format!("od_upload(&{table}, od->image, index, sub, value, application)"),
            "The same, after the application had the chance to bring the value up to date.",
        ),
        (
            "uint32_t",
            "write",
            format!("{write}, {id}, {data}, {application}"),
            format!("od_write(&{table}, od->image, index, sub, data, length, application)"),
            "Writes an entry as an SDO client does, with all checks: OD_OK or the abort code; a refused write changes nothing.",
        ),
        (
            "uint32_t",
            "write_consistent",
            format!("{write}, {id}, {data}, {application}"),
            format!("od_write_consistent(&{table}, od->image, index, sub, data, length, application)"),
            "The same, and refuses a value with which a condition between entries breaks that held before.",
        ),
        (
            "const od_constraint_t *",
            "broken_constraint",
            read.clone(),
            format!("od_broken_constraint(&{table}, od->image)"),
            "The first condition between entries that does not hold, or NULL.",
        ),
        (
            "uint8_t",
            "pack",
            format!("{read}, uint16_t number, uint8_t data[8], uint8_t *length, {application}"),
            format!("od_pack(&{table}, od->image, number, data, length, application)"),
            "The data of TPDO `number`, 1 to 512: OD_PDO_OK or why not.",
        ),
        (
            "uint8_t",
            "unpack",
            format!("{write}, uint16_t number, {data}, od_received_t *received, {application}"),
            format!("od_unpack(&{table}, od->image, number, data, length, received, application)"),
            "Takes the data of RPDO `number`, 1 to 512: OD_PDO_OK or why not; what single entries refused is in `received`.",
        ),
    ];
    for (returned, name, parameters, call, about) in calls {
        let function = page.names.function(&["od", name]);
        page.enter(&function, &format!("`{name}` of the dictionary"));
        page.text.gap();
        page.text.doc(about);
        let parameters: Vec<&str> = parameters.split(", ").collect();
        inline(&mut page.text, returned, &function, &parameters, |text| {
            let call = if returned == "void" { format!("{call};") } else { format!("return {call};") };
            text.line(&call);
        });
    }
}

/// A function in the header.
fn inline(text: &mut Text, returned: &str, name: &str, parameters: &[&str], body: impl FnOnce(&mut Text)) {
    let returned = if returned.ends_with('*') { returned.to_owned() } else { format!("{returned} ") };
    text.signature(&format!("static inline {returned}{name}"), parameters);
    text.block("{", "}", body);
}

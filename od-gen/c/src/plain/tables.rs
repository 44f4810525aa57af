//! The table: the same numbers as the Rust's, which `firmware-glue` explains.

use od_gen::plan::{
    Attributes, Block, Condition, Directory, Flags, NONE, Place, PlaceKind, Plan, PlannedConstraint,
};
use od_spec::model::{DataType, EntryId, Outside, Rounding, Storage};

use super::super::conditions::{self, Entries};
use super::super::literal::{Integer, string};
use super::super::names::Names;
use super::super::page::Page;
use super::super::text::{Text, WIDTH};
use super::table;

/// Numbers of limits and lists.
const NUMBER: Integer = Integer { signed: true, bits: 64 };

/// The parts of the table, and the table.
pub(super) fn tables(page: &mut Page<'_, '_>) {
    let plan = page.plan;
    let indices: Vec<u16> = plan.objects.iter().map(|object| object.object.index.0).collect();
    let directory = Directory::of(&indices);
    let mut members = vec![
        Member::number("first_application_row", first_application_row(plan)),
        Member::number("object_count", plan.objects.len()),
        Member::number("entry_count", plan.entries.len()),
        Member::number("image_size", plan.layout.factory.len()),
        Member::number("granularity", plan.device.info.granularity.into()),
        Member::number("dummies", dummies(plan)),
    ];
    let mut lists = Lists { names: page.names, text: &mut page.text, members: &mut members };
    lists.directory(&directory);
    let rows = plan.objects.iter().map(|object| usize::from(object.first_row)).chain([plan.entries.len()]);
    lists.list(
        "Rows of the first entries of the objects, by ascending index, and the number of entries.",
        "od_row_t",
        "objects",
        None,
        rows.map(unsigned),
    );
    lists.list("Entries by row: attributes and place.", "od_entry_t", "entries", None, entries(plan));
    lists.list(
        "What entries have in common.",
        "od_attributes_t",
        "attributes",
        None,
        plan.attributes.iter().map(attributes),
    );
    lists.sparse(plan);
    lists.list("Views of other entries.", "od_alias_t", "aliases", None, plan.aliases.iter().map(alias));
    let views = if plan.aliases.is_empty() { "NULL" } else { "&od_views" };
    lists.members.push(Member { name: "views", value: views.to_owned() });
    let limits = plan.limits.iter().map(|(low, high)| {
        format!("{{{}, {}}}", NUMBER.literal((*low).into()), NUMBER.literal((*high).into()))
    });
    lists.list("Smallest and largest values.", "od_limits_t", "limits", None, limits);
    lists.values(plan);
    let bytes = |bytes: &[u8]| bytes.iter().map(|byte| format!("0x{byte:02X}U")).collect::<Vec<_>>();
    lists.list(
        "Values that never change.",
        "uint8_t",
        "constants",
        None,
        bytes(&plan.layout.constants).into_iter(),
    );
    lists.list(
        "The image after a factory reset of node 0.",
        "uint8_t",
        "factory",
        None,
        bytes(&plan.layout.factory).into_iter(),
    );
    let node_ids = plan.layout.node_ids.iter().map(|(offset, size)| format!("{{{offset}UL, {size}U}}"));
    lists.list(
        "Values that get the node-ID added to them.",
        "od_node_id_t",
        "node_ids",
        Some("node_id_count"),
        node_ids,
    );
    let regions = plan.layout.regions.iter().map(|region| {
        format!(
            "{{{}, {}UL, {}UL, 0x{:08X}UL}}",
            storage(region.storage),
            region.start,
            region.end,
            region.layout
        )
    });
    lists.list(
        "Parts of the image that are stored together.",
        "od_region_t",
        "regions",
        Some("region_count"),
        regions,
    );
    let pdos = plan.pdos.iter().filter_map(|planned| {
        let served = planned.served.as_ref()?;
        let index = planned.pdo.communication_index();
        Some(format!("{{0x{index:04X}U, {}U, {}U}}", served.cob_id, served.mapping))
    });
    lists.list("PDOs by ascending index.", "od_pdo_t", "pdos", Some("pdo_count"), pdos);
    lists.conditions(plan);
    lists.constraints(plan);
    page.text.gap();
    let table = table(page.names);
    page.text.block(&format!("const od_table_t {table} = {{"), "};", |text| {
        for Member { name, value } in &members {
            text.line(&format!(".{name} = {value},"));
        }
    });
}

/// Entries as rows of the table; of one that the device does not have, the runtime gives 0.
struct Rows<'p, 'a> {
    plan: &'p Plan<'a>,
    names: &'p Names,
}

impl Rows<'_, '_> {
    fn name(&self, id: EntryId) -> String {
        let entry = self.plan.row(id).and_then(|row| self.plan.entry(row));
        entry.map_or_else(|| "OD_NONE".to_owned(), |entry| self.names.macro_of(&["ENTRY", &entry.name]))
    }
}

impl Entries for Rows<'_, '_> {
    fn number(&self, id: EntryId) -> String {
        format!("od_number(table, image, {})", self.name(id))
    }

    fn count(&self, id: EntryId) -> String {
        format!("od_count(table, image, {})", self.name(id))
    }
}

/// A member of the table.
struct Member {
    name: &'static str,
    value: String,
}

impl Member {
    fn number(name: &'static str, value: usize) -> Self {
        Self { name, value: unsigned(value) }
    }
}

fn unsigned(number: usize) -> String {
    format!("{number}U")
}

/// Lists as they are written, and the members that lead to them.
struct Lists<'w> {
    names: &'w Names,
    text: &'w mut Text,
    members: &'w mut Vec<Member>,
}

impl Lists<'_> {
    /// A list that the table has, with its number of items where that is counted; of nothing, there is none.
    fn list(
        &mut self,
        about: &str,
        of: &str,
        name: &'static str,
        count: Option<&'static str>,
        items: impl Iterator<Item = String>,
    ) {
        let items: Vec<String> = items.collect();
        let value = if items.is_empty() { "NULL" } else { name };
        self.members.push(Member { name, value: value.to_owned() });
        self.members.extend(count.map(|count| Member::number(count, items.len())));
        if !items.is_empty() {
            self.text.gap();
            self.text.doc(about);
            array(self.text, of, name, items);
        }
    }

    fn directory(&mut self, directory: &Directory) {
        let blocks = directory.blocks.iter().map(|block| match block {
            Some(Block { number, objects, present }) => {
                format!("{{0x{number:03X}U, {objects}U, 0x{present:08X}UL}}")
            }
            None => "{0xFFFFU, 0U, 0x00000000UL}".to_owned(),
        });
        self.list(
            "Indices in blocks of 32: where each block is looked for, the objects below it, and a bit for each of its own.",
            "od_block_t",
            "blocks",
            Some("block_count"),
            blocks,
        );
        let seeds = directory.seeds.iter().map(|seed| format!("{seed}U"));
        self.list(
            "What gives blocks places that no other has.",
            "uint8_t",
            "seeds",
            Some("seed_count"),
            seeds,
        );
        let order = directory.order.iter().copied().map(unsigned);
        self.list(
            "Places of the blocks, by ascending index.",
            "uint16_t",
            "order",
            Some("order_count"),
            order,
        );
    }

    fn sparse(&mut self, plan: &Plan<'_>) {
        let mut items = Vec::new();
        for object in &plan.objects {
            let subs: Vec<u8> = object.object.entries.iter().map(|entry| entry.sub.0).collect();
            if subs.iter().enumerate().all(|(at, sub)| at == usize::from(*sub)) {
                continue;
            }
            let name = format!("subs_{:04x}", object.object.index.0);
            self.text.gap();
            array(self.text, "uint8_t", &name, subs.iter().map(|sub| format!("{sub}U")));
            items.push(format!("{{{}U, {}U, {name}}}", object.first_row, subs.len()));
        }
        self.list(
            "Objects whose sub-indices have gaps.",
            "od_sparse_t",
            "sparse",
            Some("sparse_count"),
            items.into_iter(),
        );
    }

    fn values(&mut self, plan: &Plan<'_>) {
        let mut items = Vec::new();
        for (at, list) in plan.values.iter().enumerate() {
            let name = format!("values_{at}");
            items.push(match list.as_slice() {
                [] => "{0U, NULL}".to_owned(),
                list => {
                    self.text.gap();
                    array(
                        self.text,
                        "int64_t",
                        &name,
                        list.iter().map(|value| NUMBER.literal((*value).into())),
                    );
                    format!("{{{}U, {name}}}", list.len())
                }
            });
        }
        self.list("Lists of single values.", "od_values_t", "values", None, items.into_iter());
    }

    fn conditions(&mut self, plan: &Plan<'_>) {
        let mut items = Vec::new();
        for (at, condition) in plan.conditions.iter().enumerate() {
            let Condition { text, .. } = condition;
            let name = format!("condition_{at}");
            self.function(
                &name,
                &format!("Writable while {text}."),
                &conditions::holds(plan, &Rows { plan, names: self.names }, condition),
            );
            items.push(name);
        }
        if items.is_empty() {
            self.members.push(Member { name: "conditions", value: "NULL".to_owned() });
            return;
        }
        self.text.gap();
        self.text.doc("Write conditions, by number.");
        self.text.block("static od_condition_t *const conditions[] = {", "};", |text| {
            text.items(items.into_iter());
        });
        self.members.push(Member { name: "conditions", value: "conditions".to_owned() });
    }

    fn constraints(&mut self, plan: &Plan<'_>) {
        let mut items = Vec::new();
        for (at, planned) in plan.constraints.iter().enumerate() {
            let PlannedConstraint { name, when, require, partial, .. } = planned;
            let when = when.as_ref().map(|when| format!(", while {}", when.text)).unwrap_or_default();
            let partial = if *partial { " Only what can be known from this device." } else { "" };
            let about = format!("{name}: {}{when}.{partial}", require.text);
            let function = format!("constraint_{at}");
            self.function(
                &function,
                &about,
                &conditions::constraint(plan, &Rows { plan, names: self.names }, planned),
            );
            items.push(format!("{{{}, {function}}}", string(od_spec::ascii::transliterate(name).as_bytes())));
        }
        self.list(
            "Conditions between entries.",
            "od_constraint_t",
            "constraints",
            Some("constraint_count"),
            items.into_iter(),
        );
    }

    /// A function of the values in an image.
    fn function(&mut self, name: &str, about: &str, holds: &str) {
        self.text.gap();
        self.text.doc(about);
        self.text.line(&format!("static bool {name}(const od_table_t *table, const uint8_t *image)"));
        self.text.block("{", "}", |text| {
            if !holds.contains("table") {
                text.line("(void)table;");
                text.line("(void)image;");
            }
            text.broken(&format!("return {holds};"));
        });
    }
}

fn array(text: &mut Text, of: &str, name: &str, items: impl IntoIterator<Item = String>) {
    let items: Vec<String> = items.into_iter().collect();
    let line = format!("static const {of} {name}[] = {{{}}};", items.join(", "));
    if line.len() <= WIDTH {
        text.line(&line);
        return;
    }
    text.block(&format!("static const {of} {name}[] = {{"), "};", |text| text.items(items.into_iter()));
}

fn first_application_row(plan: &Plan<'_>) -> usize {
    let first = plan.objects.iter().find(|object| object.object.index.0 >= 0x2000);
    first.map_or(plan.entries.len(), |object| usize::from(object.first_row))
}

/// A bit for each placeholder.
fn dummies(plan: &Plan<'_>) -> usize {
    plan.device
        .info
        .dummies
        .iter()
        .map(|data_type| data_type.code())
        .filter(|code| (1..=7).contains(code))
        .fold(0, |bits, code| bits | 1 << code)
}

fn entries(plan: &Plan<'_>) -> impl Iterator<Item = String> {
    plan.entries.iter().map(|entry| {
        let place = match entry.place {
            Place::Image(at) | Place::Constant(at) => at & 0xFFFF,
            Place::Alias => {
                let row = plan.row(entry.id);
                plan.aliases.iter().position(|alias| Some(alias.row) == row).unwrap_or_default()
            }
            Place::Application => 0,
        };
        format!("{{{}U, {place}U}}", entry.attributes)
    })
}

fn attributes(of: &Attributes) -> String {
    let Attributes { data_type, flags, place, storage: stored, page, size, limits, values, condition } = of;
    let place = match place {
        PlaceKind::Image => "OD_PLACE_IMAGE",
        PlaceKind::Constant => "OD_PLACE_CONSTANT",
        PlaceKind::Alias => "OD_PLACE_ALIAS",
        PlaceKind::Application => "OD_PLACE_APPLICATION",
    };
    let [limits, values, condition] = [limits, values, condition].map(|at| match *at {
        NONE => "OD_NONE".to_owned(),
        at => format!("{at}U"),
    });
    format!(
        "{{{}, {}, {place}, {}, {page}U, {size}U, {limits}, {values}, {condition}}}",
        data_type_name(*data_type),
        flag_names(*flags),
        storage(*stored)
    )
}

fn flag_names(flags: Flags) -> String {
    let Flags { read, write, locked, receive, transmit, sparse, only_values } = flags;
    let set = [
        (read, "OD_FLAG_READ"),
        (write, "OD_FLAG_WRITE"),
        (locked, "OD_FLAG_LOCKED"),
        (receive, "OD_FLAG_RECEIVE"),
        (transmit, "OD_FLAG_TRANSMIT"),
        (sparse, "OD_FLAG_SPARSE"),
        (only_values, "OD_FLAG_ONLY_VALUES"),
    ];
    let names: Vec<&str> = set.iter().filter(|(is_set, _)| *is_set).map(|(_, name)| *name).collect();
    if names.is_empty() { "0U".to_owned() } else { names.join(" | ") }
}

const fn storage(storage: Storage) -> &'static str {
    match storage {
        Storage::No => "OD_STORAGE_NO",
        Storage::Communication => "OD_STORAGE_COMMUNICATION",
        Storage::Application => "OD_STORAGE_APPLICATION",
        Storage::Manufacturer => "OD_STORAGE_MANUFACTURER",
        Storage::Remanent => "OD_STORAGE_REMANENT",
    }
}

fn alias(planned: &od_gen::plan::PlannedAlias) -> String {
    let rounding = match planned.rounding {
        Rounding::Down => "OD_ROUND_DOWN",
        Rounding::Up => "OD_ROUND_UP",
        Rounding::Nearest => "OD_ROUND_NEAREST",
        Rounding::Zero => "OD_ROUND_ZERO",
    };
    let outside = match planned.outside {
        Outside::Saturate => "OD_OUTSIDE_SATURATE",
        Outside::Wrap => "OD_OUTSIDE_WRAP",
        Outside::Abort => "OD_OUTSIDE_ABORT",
    };
    format!(
        "{{{}U, {}, {rounding}, {outside}, {}UL, {}UL}}",
        planned.target,
        data_type_name(planned.data_type),
        planned.numerator,
        planned.denominator
    )
}

const fn data_type_name(data_type: DataType) -> &'static str {
    match data_type {
        DataType::Boolean => "OD_TYPE_BOOLEAN",
        DataType::Integer8 => "OD_TYPE_INTEGER8",
        DataType::Integer16 => "OD_TYPE_INTEGER16",
        DataType::Integer24 => "OD_TYPE_INTEGER24",
        DataType::Integer32 => "OD_TYPE_INTEGER32",
        DataType::Integer40 => "OD_TYPE_INTEGER40",
        DataType::Integer48 => "OD_TYPE_INTEGER48",
        DataType::Integer56 => "OD_TYPE_INTEGER56",
        DataType::Integer64 => "OD_TYPE_INTEGER64",
        DataType::Unsigned8 => "OD_TYPE_UNSIGNED8",
        DataType::Unsigned16 => "OD_TYPE_UNSIGNED16",
        DataType::Unsigned24 => "OD_TYPE_UNSIGNED24",
        DataType::Unsigned32 => "OD_TYPE_UNSIGNED32",
        DataType::Unsigned40 => "OD_TYPE_UNSIGNED40",
        DataType::Unsigned48 => "OD_TYPE_UNSIGNED48",
        DataType::Unsigned56 => "OD_TYPE_UNSIGNED56",
        DataType::Unsigned64 => "OD_TYPE_UNSIGNED64",
        DataType::Real32 => "OD_TYPE_REAL32",
        DataType::Real64 => "OD_TYPE_REAL64",
        DataType::VisibleString => "OD_TYPE_VISIBLE_STRING",
        DataType::OctetString => "OD_TYPE_OCTET_STRING",
        DataType::UnicodeString => "OD_TYPE_UNICODE_STRING",
        DataType::TimeOfDay => "OD_TYPE_TIME_OF_DAY",
        DataType::TimeDifference => "OD_TYPE_TIME_DIFFERENCE",
        DataType::Domain => "OD_TYPE_DOMAIN",
    }
}

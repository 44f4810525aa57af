//! What a table is made of, owned.

use firmware_glue::image::NodeIdPlace;
use firmware_glue::table::{
    Alias, Attributes, Block, Directory, Dummies, EntryRow, Limits, Parts, Pdo, Region, Row, SparseObject,
    Table,
};
use firmware_glue::{DataType, TableError, View};
use od_gen::plan::{self, Place, Plan};

use super::condition::Condition;
use super::glue;

/// A device as a program serves it without compiling it: the lists of its table, and the conditions between its entries.
#[derive(Debug, Clone)]
pub struct Device {
    blocks: Vec<Block>,
    seeds: Vec<u8>,
    order: Vec<u16>,
    pdos: Vec<OwnedPdo>,
    first_application_row: Row,
    objects: Vec<Row>,
    entries: Vec<EntryRow>,
    attributes: Vec<Attributes>,
    sparse: Vec<OwnedSparse>,
    aliases: Vec<Alias>,
    limits: Vec<Limits>,
    values: Vec<Vec<i64>>,
    constants: Vec<u8>,
    factory: Vec<u8>,
    node_id_places: Vec<NodeIdPlace>,
    regions: Vec<Region>,
    granularity: u8,
    dummies: Dummies,
    conditions: Vec<Condition>,
    constraints: Vec<Constraint>,
    lss: Option<Lss>,
}

/// What LSS can set up in a device that has it.
#[derive(Debug, Clone)]
pub(super) struct Lss {
    /// Bit rates in kbit/s.
    pub(super) bit_rates: Vec<u16>,
}

/// A PDO with the rows of its default mapping.
#[derive(Debug, Clone)]
struct OwnedPdo {
    index: u16,
    cob_id: Row,
    mapping: Row,
    rows: Vec<Row>,
}

impl OwnedPdo {
    fn borrowed(&self) -> Pdo<'_> {
        Pdo { index: self.index, cob_id: self.cob_id, mapping: self.mapping, rows: &self.rows }
    }
}

/// An object with gaps between its sub-indices.
#[derive(Debug, Clone)]
struct OwnedSparse {
    first: Row,
    subs: Vec<u8>,
}

impl OwnedSparse {
    fn borrowed(&self) -> SparseObject<'_> {
        SparseObject { first: self.first, subs: &self.subs }
    }
}

/// A condition that all values together have to meet.
#[derive(Debug, Clone)]
pub(super) struct Constraint {
    pub(super) name: String,
    when: Option<Condition>,
    require: Condition,
}

impl Constraint {
    pub(super) fn holds(&self, numbers: &dyn Fn(Row) -> i128) -> bool {
        self.when.as_ref().is_some_and(|when| when.is_not_met(numbers)) || self.require.holds(numbers)
    }
}

/// The lists of a device that name other lists.
#[derive(Debug)]
pub struct Lists<'d> {
    device: &'d Device,
    pdos: Vec<Pdo<'d>>,
    sparse: Vec<SparseObject<'d>>,
    values: Vec<&'d [i64]>,
}

impl Device {
    pub(super) fn of(plan: &Plan<'_>) -> Self {
        let indices: Vec<u16> = plan.objects.iter().map(|object| object.object.index.0).collect();
        let directory = plan::Directory::of(&indices);
        let condition = |condition: &plan::Condition| Condition::of(plan, condition);
        Self {
            blocks: directory.blocks.iter().map(|block| block.map_or(Block::FREE, block_of)).collect(),
            seeds: directory.seeds,
            order: directory.order.iter().map(|at| row(*at)).collect(),
            pdos: plan.pdos.iter().filter_map(pdo).collect(),
            first_application_row: first_application_row(plan),
            objects: plan
                .objects
                .iter()
                .map(|object| object.first_row)
                .chain([row(plan.entries.len())])
                .collect(),
            entries: plan.entries.iter().map(|entry| entry_row(plan, entry)).collect(),
            attributes: plan.attributes.iter().map(attributes).collect(),
            sparse: plan.objects.iter().filter_map(sparse).collect(),
            aliases: plan.aliases.iter().map(alias).collect(),
            limits: plan.limits.iter().map(|(low, high)| Limits { low: *low, high: *high }).collect(),
            values: plan.values.to_vec(),
            constants: plan.layout.constants.clone(),
            factory: plan.layout.factory.clone(),
            node_id_places: plan.layout.node_ids.iter().map(node_id_place).collect(),
            regions: plan.layout.regions.iter().map(region).collect(),
            granularity: plan.device.info.granularity,
            dummies: plan
                .device
                .info
                .dummies
                .iter()
                .fold(Dummies::NONE, |dummies, data_type| dummies.with(glue::data_type(*data_type))),
            conditions: plan.conditions.iter().map(condition).collect(),
            constraints: plan
                .constraints
                .iter()
                .map(|constraint| Constraint {
                    name: constraint.name.to_owned(),
                    when: constraint.when.as_ref().map(condition),
                    require: condition(&constraint.require),
                })
                .collect(),
            lss: plan.device.info.lss.then(|| Lss { bit_rates: plan.device.info.bit_rates.clone() }),
        }
    }

    /// The lists of its table that name others.
    pub fn lists(&self) -> Lists<'_> {
        Lists {
            device: self,
            pdos: self.pdos.iter().map(OwnedPdo::borrowed).collect(),
            sparse: self.sparse.iter().map(OwnedSparse::borrowed).collect(),
            values: self.values.iter().map(Vec::as_slice).collect(),
        }
    }

    /// Bytes that its values need.
    pub fn image_size(&self) -> usize {
        self.factory.len()
    }

    /// The write conditions, by the numbers that the table has for them.
    pub(super) fn conditions(&self) -> &[Condition] {
        &self.conditions
    }

    pub(super) fn constraints(&self) -> &[Constraint] {
        &self.constraints
    }

    pub(super) const fn lss(&self) -> Option<&Lss> {
        self.lss.as_ref()
    }
}

impl Lists<'_> {
    /// The table.
    ///
    /// # Errors
    /// [`TableError`]: a rule that the lists break. That of a plan break none; it is looked at all the same, because nothing
    /// but this table is between a client and the values.
    pub fn table(&self) -> Result<Table<'_>, TableError> {
        let device = self.device;
        Table::checked(Parts {
            directory: Directory { blocks: &device.blocks, seeds: &device.seeds, order: &device.order },
            pdos: &self.pdos,
            first_application_row: device.first_application_row,
            objects: &device.objects,
            entries: &device.entries,
            attributes: &device.attributes,
            sparse: &self.sparse,
            aliases: &device.aliases,
            limits: &device.limits,
            values: &self.values,
            constants: &device.constants,
            factory: &device.factory,
            node_id_places: &device.node_id_places,
            regions: &device.regions,
            granularity: device.granularity,
            dummies: device.dummies,
        })
    }
}

/// A position as 16 bits; the plan has reported what has more.
fn row(at: usize) -> Row {
    Row::try_from(at).unwrap_or(Row::MAX)
}

/// An offset in the image as 32 bits; the plan has reported what has more than 24.
fn offset(at: usize) -> u32 {
    u32::try_from(at).unwrap_or(u32::MAX)
}

fn block_of(plan::Block { number, objects, present }: plan::Block) -> Block {
    Block::new(number, row(objects), present)
}

fn pdo(planned: &plan::PlannedPdo<'_>) -> Option<OwnedPdo> {
    let plan::ServedPdo { cob_id, mapping, rows } = planned.served.as_ref()?;
    let index = planned.pdo.communication_index();
    Some(OwnedPdo { index, cob_id: *cob_id, mapping: *mapping, rows: rows.clone() })
}

fn first_application_row(plan: &Plan<'_>) -> Row {
    let first = plan.objects.iter().find(|object| object.object.index.0 >= 0x2000);
    first.map_or(row(plan.entries.len()), |object| object.first_row)
}

fn entry_row(plan: &Plan<'_>, entry: &plan::PlannedEntry<'_>) -> EntryRow {
    let place = match entry.place {
        Place::Image(at) | Place::Constant(at) => row(at & 0xFFFF),
        Place::Alias => plan
            .row(entry.id)
            .and_then(|row| plan.aliases.iter().position(|alias| alias.row == row))
            .map_or(0, row),
        Place::Application => 0,
    };
    EntryRow { attributes: entry.attributes, place }
}

fn attributes(planned: &plan::Attributes) -> Attributes {
    Attributes {
        data_type: glue::data_type(planned.data_type),
        flags: glue::flags(planned.flags),
        place: glue::place(planned.place),
        storage: glue::storage(planned.storage),
        page: u8::try_from(planned.page).unwrap_or(u8::MAX),
        size: row(planned.size),
        limits: planned.limits,
        values: planned.values,
        condition: planned.condition,
    }
}

fn sparse(planned: &plan::PlannedObject<'_>) -> Option<OwnedSparse> {
    let subs: Vec<u8> = planned.object.entries.iter().map(|entry| entry.sub.0).collect();
    let gapless = subs.iter().enumerate().all(|(at, sub)| at == usize::from(*sub));
    (!gapless).then_some(OwnedSparse { first: planned.first_row, subs })
}

fn alias(planned: &plan::PlannedAlias) -> Alias {
    let plan::PlannedAlias { target, data_type, numerator, denominator, rounding, outside, .. } = *planned;
    let (data_type, outside): (DataType, _) = (glue::data_type(data_type), glue::outside(outside));
    let view = match (numerator, denominator) {
        (1, 1) => View::plain(data_type, outside),
        _ => View::scaled(data_type, outside, numerator, denominator, glue::rounding(rounding)),
    };
    Alias { target, view }
}

fn node_id_place(&(at, size): &(usize, usize)) -> NodeIdPlace {
    NodeIdPlace { offset: offset(at), size: u8::try_from(size).unwrap_or(u8::MAX) }
}

fn region(planned: &plan::Region) -> Region {
    let storage = glue::storage(planned.storage);
    Region { storage, start: offset(planned.start), end: offset(planned.end), layout: planned.layout }
}

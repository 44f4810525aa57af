//! A row for each value of each node.

use od_spec::plant::{Plant, Settled};

use super::values::values;

/// What the columns are called.
pub(super) const COLUMNS: [&str; NODE + VALUE] = [
    "site",
    "machine",
    "type",
    "machine serial",
    "machine comment",
    "position",
    "device",
    "node-ID",
    "bit rate",
    "node serial",
    "node comment",
    "entry",
    "name",
    "value",
    "raw value",
    "said by",
    "locked",
];

/// So many columns are about the node, and so many about the value.
const NODE: usize = 11;
const VALUE: usize = 6;

/// A cell of the table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Cell {
    /// A text, which is not a number even if it looks like one: the name of a machine, a value with its unit.
    Text(String),
    /// A number.
    Number(i128),
}

impl Cell {
    /// As it is written where everything is text.
    pub(super) fn text(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Number(number) => number.to_string(),
        }
    }

    fn of(text: impl Into<String>) -> Self {
        Self::Text(text.into())
    }

    fn number(number: Option<impl Into<i128>>) -> Self {
        number.map_or_else(|| Self::of(""), |number| Self::Number(number.into()))
    }
}

/// Gives the cells of each node, and those of its values: a row each. A node without values has one row.
pub(super) fn each(
    plant: &Plant,
    settled: &[Settled],
    mut take: impl FnMut(&[Cell; NODE], &[[Cell; VALUE]]),
) {
    // What the values of a class are is written once, however many nodes have it.
    let of_class: Vec<Vec<[Cell; VALUE]>> = (0..)
        .zip(settled)
        .map(|(class, settled)| {
            let rows = values(plant, class, settled).into_iter().map(|value| {
                [
                    Cell::of(value.id.to_string()),
                    Cell::Text(value.name),
                    Cell::Text(value.value),
                    Cell::number(value.raw),
                    Cell::Text(value.from.words()),
                    Cell::of(if value.is_unlocked { "locked" } else { "" }),
                ]
            });
            rows.collect()
        })
        .collect();
    let nothing: [[Cell; VALUE]; 1] = [std::array::from_fn(|_| Cell::of(""))];
    for node in &plant.nodes {
        let Some(machine) = plant.machines.get(node.machine) else { continue };
        let of_type = plant.types.get(machine.of_type).map_or("", |one| &one.name);
        let bit_rate = plant.classes.get(node.class).map_or(0, |class| class.own.bit_rate);
        let own = [
            Cell::of(plant.site_of(machine)),
            Cell::of(&machine.name),
            Cell::of(of_type),
            Cell::of(machine.serial.as_ref().map_or("", |serial| &serial.value)),
            Cell::of(machine.comment.as_deref().unwrap_or_default()),
            Cell::of(&node.position),
            Cell::of(plant.devices.get(node.device).map_or("", |device| &device.key)),
            Cell::Number(node.node.value.into()),
            Cell::Number(bit_rate.into()),
            Cell::number(node.serial.map(|serial| serial.value)),
            Cell::of(node.comment.as_deref().unwrap_or_default()),
        ];
        match of_class.get(node.class).map(Vec::as_slice) {
            None | Some([]) => take(&own, &nothing),
            Some(rows) => take(&own, rows),
        }
    }
}

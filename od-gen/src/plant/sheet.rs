//! A row for each value of each node, as a table that spreadsheets open.
//!
//! Columns are divided by `;`: spreadsheets of the countries that write `0,5` expect it, and the others take it too. The text is
//! UTF-8 and begins with a byte order mark, without which Excel takes it for the code page of its country. A value with its unit is
//! one cell, so that no spreadsheet makes a date of `1.10`; a cell that would be taken for a formula begins with `'`.

use std::fmt::Write as _;

use od_spec::plant::{Plant, Settled};

use super::values::values;

const BYTE_ORDER_MARK: char = '\u{FEFF}';
const COLUMNS: [&str; 17] = [
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

/// The table. A node without values has one row.
pub(super) fn write(plant: &Plant, settled: &[Settled]) -> String {
    let mut text = String::from(BYTE_ORDER_MARK);
    row(&mut text, &COLUMNS.map(str::to_owned));
    // What the values of a class are is written once, however many nodes have it.
    let of_class: Vec<Vec<[String; 6]>> = (0..)
        .zip(settled)
        .map(|(class, settled)| {
            let rows = values(plant, class, settled).into_iter().map(|value| {
                [
                    value.id.to_string(),
                    value.name,
                    value.value,
                    value.raw.map(|raw| raw.to_string()).unwrap_or_default(),
                    value.from.words(),
                    if value.is_unlocked { "locked".to_owned() } else { String::new() },
                ]
            });
            rows.collect()
        })
        .collect();
    for node in &plant.nodes {
        let Some(machine) = plant.machines.get(node.machine) else { continue };
        let of_type = plant.types.get(machine.of_type).map_or("", |one| &one.name);
        let bit_rate = plant.classes.get(node.class).map_or(0, |class| class.own.bit_rate);
        let own = [
            plant.site_of(machine).to_owned(),
            machine.name.clone(),
            of_type.to_owned(),
            machine.serial.as_ref().map(|serial| serial.value.clone()).unwrap_or_default(),
            machine.comment.clone().unwrap_or_default(),
            node.position.clone(),
            plant.devices.get(node.device).map(|device| device.key.clone()).unwrap_or_default(),
            node.node.value.to_string(),
            bit_rate.to_string(),
            node.serial.map(|serial| serial.value.to_string()).unwrap_or_default(),
            node.comment.clone().unwrap_or_default(),
        ];
        let mut prefix = String::new();
        cells(&mut prefix, &own);
        match of_class.get(node.class).map(Vec::as_slice) {
            None | Some([]) => {
                text.push_str(&prefix);
                text.push(';');
                row(&mut text, &std::array::from_fn::<_, 6, _>(|_| String::new()));
            }
            Some(rows) => {
                for values in rows {
                    text.push_str(&prefix);
                    text.push(';');
                    row(&mut text, values);
                }
            }
        }
    }
    text
}

fn row(text: &mut String, of: &[String]) {
    cells(text, of);
    text.push_str("\r\n");
}

fn cells(text: &mut String, of: &[String]) {
    for (at, cell) in of.iter().enumerate() {
        if at > 0 {
            text.push(';');
        }
        let plain = cell.replace(['\r', '\n'], " ");
        let is_number = plain.parse::<i128>().is_ok();
        let guard = if !is_number && plain.starts_with(['=', '+', '-', '@', '\t']) { "'" } else { "" };
        if plain.contains([';', '"']) {
            let _ = write!(text, "\"{guard}{}\"", plain.replace('"', "\"\""));
        } else {
            let _ = write!(text, "{guard}{plain}");
        }
    }
}

//! The files of a plant: for each machine the DCF and the concise DCF of its nodes and the list of them, and for all machines
//! what differs where.

mod cell;
mod messages;
mod nodelist;
mod overview;
mod rows;
mod sheet;
mod values;
mod workbook;

#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use od_formats::concise;
use od_formats::eds::DcfPieces;
use od_gen::{Pool, SharedFile};
use od_spec::diag::Diagnostic;
use od_spec::plant::{Plant, PlantNode, Settled};
use od_spec::rule_codes;

pub use values::{PlantValue, default_of, values};

/// The name of the overview.
pub const OVERVIEW: &str = "overview.md";
/// The name of the sheet.
pub const SHEET: &str = "values.csv";
/// The name of the workbook with the same table.
pub const WORKBOOK: &str = "values.xlsx";

/// What nodes have in common that are alike and are at positions of one name: one piece of work.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Job {
    class: usize,
    position: String,
}

/// The files of a [`Job`], except for what single nodes have of their own.
#[derive(Debug, Clone)]
pub struct Made {
    dcf: DcfPieces,
    concise: Arc<[u8]>,
}

/// What there is to do, each kind of node once.
pub fn jobs(plant: &Plant) -> Vec<Job> {
    let jobs: BTreeSet<Job> = plant.nodes.iter().map(job).collect();
    jobs.into_iter().collect()
}

fn job(node: &PlantNode) -> Job {
    Job { class: node.class, position: node.position.clone() }
}

/// Does a job; the order is of no importance. What it has in common with others is in memory once, in the pool.
///
/// # Errors
/// A value that no entry of the device can have, which rules have reported before.
pub fn make(plant: &Plant, settled: &[Settled], job: &Job, pool: &Pool) -> Result<Made, Box<Diagnostic>> {
    let no_class = || {
        let message = format!("the plant has no class {}", job.class);
        Box::new(Diagnostic::without_place(rule_codes::VALUE_DOES_NOT_FIT, message))
    };
    let class = plant.classes.get(job.class).ok_or_else(no_class)?;
    let device = plant.devices.get(class.own.device).ok_or_else(no_class)?;
    let node = &settled.get(job.class).ok_or_else(no_class)?.commissioning;
    let writes = node.download(&device.system, &device.dictionary).map_err(|no_value| {
        let message = format!(
            "the concise DCF of {} at position {} cannot be made: {no_value}",
            device.key, job.position
        );
        Box::new(Diagnostic::without_place(rule_codes::VALUE_DOES_NOT_FIT, message).help("correct the value"))
    })?;
    let file = format!("{}-{}.dcf", job.position, device.key);
    let dcf = DcfPieces::new(&device.system, &device.dictionary, node, &file, pool);
    Ok(Made { dcf, concise: concise::write(&writes).into() })
}

/// All files of a plant, machine by machine; `made` in the order of the jobs. There is no workbook of a plant with more values than
/// one can hold.
pub fn files(plant: &Plant, settled: &[Settled], jobs: &[Job], made: &[Made]) -> Vec<SharedFile> {
    let workbook = workbook::write(plant, settled, workbook::MOST_ROWS);
    files_with(workbook, plant, settled, jobs, made)
}

fn files_with(
    workbook: Option<Vec<u8>>,
    plant: &Plant,
    settled: &[Settled],
    jobs: &[Job],
    made: &[Made],
) -> Vec<SharedFile> {
    let made: BTreeMap<&Job, &Made> = jobs.iter().zip(made).collect();
    let whole = |path: String, text: String| SharedFile { path, pieces: vec![text.into_bytes().into()] };
    let tables = if workbook.is_some() { &[WORKBOOK, SHEET][..] } else { &[SHEET] };
    let mut files = vec![
        whole(OVERVIEW.to_owned(), overview::write(plant, settled, tables)),
        whole(SHEET.to_owned(), sheet::write(plant, settled)),
    ];
    files.extend(workbook.map(|bytes| SharedFile { path: WORKBOOK.to_owned(), pieces: vec![bytes.into()] }));
    for machine in &plant.machines {
        let folder = format!("{}/{}", plant.site_of(machine), machine.name);
        let nodes = plant.nodes.get(machine.nodes.clone()).unwrap_or_default();
        files.push(whole(format!("{folder}/nodelist.cpj"), nodelist::write(plant, machine, nodes)));
        for node in nodes {
            let (Some(made), Some(settled), Some(device)) =
                (made.get(&job(node)), settled.get(node.class), plant.devices.get(node.device))
            else {
                continue;
            };
            let path = format!("{folder}/{}", stem(plant, node));
            let pieces = made.dcf.dcf(&device.dictionary, &plant.commissioning(node, settled));
            files.push(SharedFile { path: format!("{path}.dcf"), pieces });
            files.push(SharedFile { path: format!("{path}.bin"), pieces: vec![Arc::clone(&made.concise)] });
        }
    }
    files
}

/// The name of a node's files without their ending: `B-pmc`.
pub fn stem(plant: &Plant, node: &PlantNode) -> String {
    format!("{}-{}", node.position, plant.devices.get(node.device).map_or("", |device| &device.key))
}

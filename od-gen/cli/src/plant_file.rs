//! Plants from files, for all commands that take one.

mod machine;

use std::path::{Path, PathBuf};

use od_gen::source::open;
use od_gen::{CHECK, condensed};
use od_spec::model::SystemSource;
use od_spec::plant::{Plant, Settled, plant};
use od_spec::source::SourceMap;

pub(crate) use machine::{machine, names_plant, no_plant};

use crate::exit::ERRORS;
use crate::parallel::in_order;
use crate::progress::Progress;
use crate::report::Report;

/// A plant without errors.
pub(crate) struct Read {
    pub(crate) plant: Plant,
    /// What each class is set to.
    pub(crate) settled: Vec<Settled>,
    pub(crate) sources: SourceMap,
    /// The files that were read.
    pub(crate) files: Vec<PathBuf>,
}

/// Reads a plant and shows what is wrong with it.
pub(crate) fn read(path: &Path, report: &Report) -> Result<Read, u8> {
    let mut sources = SourceMap::new();
    let mut loader = report.loader();
    let help = "check the path; a plant file begins with `od-plant: 1`";
    let root = open(path, help, &mut sources).map_err(|diagnostic| report.refuse(*diagnostic))?;
    let read = plant(&mut sources, root, &mut loader);
    let mut diagnostics = read.diagnostics;
    for file in read.files {
        if file.source == Some(SystemSource::Eds) {
            if let Some(line) = condensed(&file.name, CHECK, &file.diagnostics) {
                report.note(&line);
            }
        } else {
            diagnostics.append(file.diagnostics);
        }
    }
    let Some(plant) = read.plant else {
        diagnostics.sort();
        report.show(&diagnostics, &sources);
        return Err(ERRORS);
    };
    let settled = settle(&plant, report);
    diagnostics.append(plant.check(&settled));
    diagnostics.sort();
    report.show_used(path, "odgen plant check", &diagnostics, &sources);
    if diagnostics.has_errors() {
        return Err(ERRORS);
    }
    loader.read.push(path.to_owned());
    Ok(Read { plant, settled, sources, files: loader.read })
}

/// Works out what the nodes are set to, on all cores.
fn settle(plant: &Plant, report: &Report) -> Vec<Settled> {
    let classes: Vec<usize> = (0..plant.classes.len()).collect();
    let mut progress = Progress::new("checked", "kinds of nodes", classes.len(), report.audience());
    let mut settled = Vec::with_capacity(classes.len());
    in_order(
        &classes,
        |class| plant.settle(*class),
        |finished, results| {
            settled.extend(results.into_iter().flatten());
            progress.show(finished);
        },
    );
    progress.clear();
    settled
}

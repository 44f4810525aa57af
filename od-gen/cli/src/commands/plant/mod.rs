//! `odgen plant`.

mod args;
mod show;

use std::io::Write;
use std::path::{Path, PathBuf};

use od_gen::files::{Existing, Outcome, WriteError, left_over_of_folders, remove, write_set_watched};
use od_gen::{Pool, SharedFile};
use od_plant::{Job, SHEET, WORKBOOK, files, jobs, make};
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::file_name;
use od_spec::plant::Plant;
use od_spec::source::SourceMap;

use crate::exit::ERRORS;
use crate::output::{forced, not_written};
use crate::parallel::in_order;
use crate::plant_file::{Read, read};
use crate::progress::Progress;
use crate::report::{Report, print, shown};
pub(crate) use args::PlantArgs;
use args::{PlantBuildArgs, PlantCommand};

pub(crate) fn run(args: &PlantArgs, report: &Report) -> u8 {
    let done = match &args.command {
        PlantCommand::Build(args) => build(args, report),
        PlantCommand::Check(args) => read(&args.plant, report).map(|read| print(&summary(&read.plant))),
        PlantCommand::Show(args) => show::run(args, report),
    };
    done.unwrap_or_else(|code| code)
}

fn build(args: &PlantBuildArgs, report: &Report) -> Result<u8, u8> {
    let Read { plant, settled, files: read, .. } = read(&args.plant, report)?;
    let jobs = jobs(&plant);
    let mut progress = Progress::new("made", "kinds of nodes", jobs.len(), report.audience());
    let pool = Pool::default();
    let (mut made, mut refused) = (Vec::with_capacity(jobs.len()), Diagnostics::new());
    in_order(
        &jobs,
        |job: &Job| make(&plant, &settled, job, &pool),
        |finished, results| {
            for result in results {
                match result {
                    Ok(one) => made.push(one),
                    Err(diagnostic) => refused.push(*diagnostic),
                }
            }
            progress.show(finished);
        },
    );
    progress.clear();
    if refused.has_errors() {
        report.show(&refused, &SourceMap::new());
        return Err(ERRORS);
    }
    let set = files(&plant, &settled, &jobs, &made);
    if let Some(path) = overwritten(&args.out, &set, &read) {
        let message = format!("cannot write {path}: it is read to make it");
        return Err(report.refuse(
            Diagnostic::without_place(codes::WRITE_FAILED, message)
                .help("build into another directory, with `--out`"),
        ));
    }
    let progress = |of| Progress::new("wrote", "files", of, report.audience());
    let existing = forced(args.force, Existing::Generated);
    let outcomes =
        written(&args.out, &set, existing, progress).map_err(|error| report.refuse(not_written(&error)))?;
    let changed = outcomes.iter().filter(|outcome| **outcome == Outcome::Changed).count();
    let size: usize = set.iter().flat_map(|file| &file.pieces).map(|piece| piece.len()).sum();
    let text = format!(
        "{}  {}  {} files, {} kB; {changed} changed, {} unchanged\n",
        summary(&plant),
        shown(&args.out),
        set.len(),
        size.div_ceil(1024),
        outcomes.len() - changed
    );
    let text = text + &without_workbook(&set);
    let left = left_from_before(args, &set).map_err(|error| report.refuse(not_written(&error)))?;
    let code = print(&(text + &left));
    // The process ends next: taking everything apart would only cost the user time.
    std::mem::forget((plant, settled, set, made, pool));
    Ok(code)
}

/// Writes the files, and says how far it is; `new` makes the line for so many files.
fn written<W: Write>(
    out: &Path,
    set: &[SharedFile],
    existing: Existing,
    new: impl Fn(usize) -> Progress<W>,
) -> Result<Vec<Outcome>, WriteError> {
    let mut progress: Option<Progress<W>> = None;
    let mut watch = |written: usize, of: usize| progress.get_or_insert_with(|| new(of)).show(written);
    let outcomes = write_set_watched(out, set, existing, &mut watch);
    progress.iter_mut().for_each(Progress::clear);
    outcomes
}

/// That a plant with very many values has no workbook.
fn without_workbook(set: &[SharedFile]) -> String {
    if set.iter().any(|file| file.path == WORKBOOK) {
        return String::new();
    }
    format!("  no {WORKBOOK}: there are more values than a workbook has rows for; {SHEET} has them all\n")
}

/// `3 machines at 1 site, 18 nodes`.
fn summary(plant: &Plant) -> String {
    let count = |number: usize, what: &str| format!("{number} {what}{}", if number == 1 { "" } else { "s" });
    let unlocked = plant.layers.iter().map(|layer| layer.layer.unlocked.len()).sum::<usize>();
    let locked = if unlocked == 0 {
        String::new()
    } else {
        format!("; {} unlocked", count(unlocked, "locked entry").replace("entrys", "entries"))
    };
    format!(
        "  {}: {} at {}, {} of {}{locked}\n",
        plant.title,
        count(plant.machines.len(), "machine"),
        count(plant.sites.len(), "site"),
        count(plant.nodes.len(), "node"),
        count(plant.classes.len(), "kind"),
    )
}

/// The first file of the set that was read to make it.
fn overwritten(out: &Path, set: &[SharedFile], read: &[PathBuf]) -> Option<String> {
    let read: Vec<PathBuf> = read.iter().filter_map(|path| path.canonicalize().ok()).collect();
    let out = out.canonicalize().ok()?;
    // Where nothing that was read lies below the directory, nothing is written over.
    let below: Vec<&PathBuf> = read.iter().filter(|path| path.starts_with(&out)).collect();
    let found = set.iter().find(|file| below.iter().any(|path| **path == out.join(&file.path)))?;
    Some(file_name::shown(out.join(&found.path)))
}

/// Names what an earlier build made for nodes that are no more, and removes it if that is wanted.
fn left_from_before(args: &PlantBuildArgs, set: &[SharedFile]) -> Result<String, WriteError> {
    /// So many files are named.
    const NAMED: usize = 5;
    let left = left_over_of_folders(&args.out, set)?;
    if left.is_empty() {
        return Ok(String::new());
    }
    let mut names: Vec<String> = left.iter().take(NAMED).map(|path| shown(&args.out.join(path))).collect();
    if left.len() > NAMED {
        names.push(format!("{} more", left.len() - NAMED));
    }
    let names = names.join(", ");
    if args.prune {
        remove(&args.out, &left)?;
        return Ok(format!("  removed, as no node of the plant has it any more: {names}\n"));
    }
    Ok(format!("  made before, and of no node of the plant any more: {names}; `--prune` removes it\n"))
}

#[cfg(test)]
mod tests {
    use std::sync::{Arc, Mutex, PoisonError};

    use super::*;

    /// A terminal of which the test keeps what is written.
    #[derive(Clone, Default)]
    struct Terminal(Arc<Mutex<Vec<u8>>>);

    impl Write for Terminal {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            self.0.lock().unwrap_or_else(PoisonError::into_inner).write(bytes)
        }

        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }

    fn set(names: &[&str]) -> Vec<SharedFile> {
        let file = |name: &&str| SharedFile { path: (*name).to_owned(), pieces: vec![(*b"text").into()] };
        names.iter().map(file).collect()
    }

    #[test]
    fn a_build_says_how_many_files_it_wrote() {
        let out = std::env::temp_dir().join(format!("odgen-wrote-{}", std::process::id()));
        let names: Vec<String> = (0..12).map(|number| format!("{number}.txt")).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let terminal = Terminal::default();
        let new = |of| Progress::on(terminal.clone(), "wrote", "files", of);
        let outcomes = written(&out, &set(&names), Existing::Generated, new);
        let _ = std::fs::remove_dir_all(&out);
        assert!(outcomes.is_ok_and(|outcomes| outcomes.len() == 12));
        let text = terminal.0.lock().unwrap_or_else(PoisonError::into_inner).clone();
        let text = String::from_utf8_lossy(&text).into_owned();
        // The list of the files is one, too.
        assert!(text.contains("wrote 1 of 13 files\r"), "{text:?}");
        assert!(text.ends_with("\r\u{1b}[2K"), "the line is taken away: {text:?}");
    }

    #[test]
    fn a_workbook_that_is_not_written_is_reported() {
        assert_eq!(without_workbook(&set(&[SHEET, WORKBOOK])), "");
        assert!(without_workbook(&set(&[SHEET])).starts_with("  no values.xlsx: "));
    }
}

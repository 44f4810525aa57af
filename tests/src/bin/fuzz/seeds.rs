//! The texts to begin with, by what they are.

use std::path::{Path, PathBuf};

use od_tests::foreign::{self, find};
use od_tests::fuzz::{Seed, XddFiles};
use od_tests::shipped::in_one_file;
use od_tests::{Failure, root};

/// The EDS and DCF of this repository: those that try the rules, those of the shipped devices, and what the commands are shown with.
const EDS: [&str; 3] = ["tests/eds", "generated/eds", "od-gen/cli/tests/cli/eds"];
/// Its specifications and libraries.
const SPECIFICATIONS: [&str; 3] = ["od-spec/profiles", "tests/ui", "tests/shared"];
/// The shipped specifications, which are in several files.
const SHIPPED: [&str; 2] = ["pitch-control-system", "fullmo-drive"];

/// Every EDS and DCF of the repository, and of the files and directories that are named, in the order of their names.
pub(crate) fn eds(more: &[PathBuf]) -> Result<Vec<Seed>, Failure> {
    read(&EDS, more, |directory, paths| {
        find(directory, foreign::EDS, paths)?;
        Ok(())
    })
}

/// Every XDD and XDC of the repository, those of the shipped devices, and those that are named.
pub(crate) fn xdd(more: &[PathBuf]) -> Result<Vec<Seed>, Failure> {
    let mut seeds = read(&EDS, more, |directory, paths| find(directory, foreign::XDD, paths))?;
    seeds.extend(XddFiles::shipped()?);
    // As they are, and with every attribute on a line of its own.
    let lines = seeds.iter().map(XddFiles::in_lines).collect::<Vec<_>>();
    seeds.extend(lines);
    Ok(seeds)
}

/// The same for specifications and libraries.
pub(crate) fn specifications(more: &[PathBuf]) -> Result<Vec<Seed>, Failure> {
    let mut seeds = read(&SPECIFICATIONS, more, |directory, paths| {
        for entry in
            std::fs::read_dir(directory).map_err(|error| format!("{}: {error}", directory.display()))?
        {
            let path = entry?.path();
            let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            // What is refused as it is is refused after nearly every change.
            if name.ends_with(".od.yaml") && !name.starts_with("err_") {
                paths.push(path);
            }
        }
        Ok(())
    })?;
    let shipped =
        SHIPPED.map(|name| Seed { name: format!("{name}.od.yaml"), bytes: in_one_file(name).into_bytes() });
    seeds.extend(shipped);
    Ok(seeds)
}

/// Finds files of a kind in a directory.
type Find = fn(&Path, &mut Vec<PathBuf>) -> Result<(), Failure>;

fn read(directories: &[&str], more: &[PathBuf], find: Find) -> Result<Vec<Seed>, Failure> {
    let mut seeds = Vec::new();
    for path in directories.iter().map(|directory| root().join(directory)).chain(more.iter().cloned()) {
        let mut paths = Vec::new();
        if path.is_dir() {
            find(&path, &mut paths)?;
        } else {
            paths.push(path);
        }
        paths.sort();
        for path in paths {
            seeds.push(seed(&path)?);
        }
    }
    Ok(seeds)
}

fn seed(path: &Path) -> Result<Seed, Failure> {
    let bytes = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    Ok(Seed { name, bytes })
}

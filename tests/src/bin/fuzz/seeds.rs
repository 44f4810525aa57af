//! The texts to begin with.

use std::path::{Path, PathBuf};

use od_tests::foreign::find;
use od_tests::fuzz::Seed;
use od_tests::{Failure, root};

/// The files of this repository: those that try the rules, those of the shipped devices, and what the commands are shown with.
const OWN: [&str; 3] = ["tests/eds", "generated/eds", "od-gen/tests/cli/eds"];

/// Every EDS and DCF of the repository, and of the files and directories that are named, in the order of their names.
pub(crate) fn read(more: &[PathBuf]) -> Result<Vec<Seed>, Failure> {
    let own = OWN.iter().map(|directory| root().join(directory));
    let mut seeds = Vec::new();
    for path in own.chain(more.iter().cloned()) {
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

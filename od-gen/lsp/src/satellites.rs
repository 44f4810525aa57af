//! Parameter files and plants in folders.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use od_gen::source::read_file;
use od_spec::plant::is_plant;
use od_spec::{is_parameter_file, read_text};

use super::place::Place;

/// Most files and folders that are looked at.
const MOST: usize = 5_000;
/// How deep folders are looked into.
const DEPTH: usize = 6;
/// Folders that others write.
const FOREIGN: [&str; 2] = ["node_modules", "target"];

/// Adds the parameter files and plants below a folder.
pub(super) fn below(folder: &Path, found: &mut BTreeSet<Place>) {
    let mut left = MOST;
    look(folder, DEPTH, &mut left, found);
}

fn look(folder: &Path, depth: usize, left: &mut usize, found: &mut BTreeSet<Place>) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        *left = left.saturating_sub(1);
        if *left == 0 {
            return;
        }
        let (path, name) = (entry.path(), entry.file_name());
        let name = name.to_string_lossy();
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        if is_folder && depth > 0 && !name.starts_with('.') && !FOREIGN.contains(&&*name) {
            look(&path, depth - 1, left, found);
        } else if !is_folder && [".yaml", ".yml"].iter().any(|end| name.ends_with(end)) && is_of_nodes(&path)
        {
            found.insert(Place::File(path));
        }
    }
}

/// Whether a file is a parameter file or a plant.
fn is_of_nodes(path: &Path) -> bool {
    let text = read_file(path).ok().and_then(|bytes| read_text(&path.to_string_lossy(), bytes).ok());
    text.is_some_and(|text| is_parameter_file(&text) || is_plant(&text))
}

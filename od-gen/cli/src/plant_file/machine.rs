//! The machine of a plant that a command line names.

use std::path::Path;

use od_gen::source::read_file;
use od_spec::diag::{Diagnostic, codes, nearest};
use od_spec::plant::{Machine, Plant, is_plant};

use crate::report::shown;

/// So many machines are named.
const NAMED: usize = 10;

/// Whether a file is a plant file.
pub(crate) fn names_plant(path: &Path) -> bool {
    read_file(path).is_ok_and(|bytes| is_plant(&String::from_utf8_lossy(&bytes)))
}

/// What is said of a machine where there is no plant.
pub(crate) fn no_plant(path: &Path, help: &'static str) -> Diagnostic {
    let message = format!("{} is not a plant file, and only a plant has machines", shown(path));
    Diagnostic::without_place(codes::BAD_NOTATION, message).help(help)
}

/// The machine with a name, at a site where one is named; without a name, the only one.
pub(crate) fn machine<'a>(
    plant: &'a Plant,
    site: Option<&str>,
    name: Option<&str>,
) -> Result<&'a Machine, Box<Diagnostic>> {
    let refuse = |message: String, help: String| {
        Err(Box::new(Diagnostic::without_place(codes::UNKNOWN_WORD, message).help(help)))
    };
    if let Some(site) = site.filter(|site| !plant.sites.iter().any(|known| known.name == **site)) {
        let names = plant.sites.iter().map(|site| site.name.as_str());
        let help = match nearest(site, names.clone()) {
            Some(word) => format!("did you mean `{word}`?"),
            None => format!("the sites are {}", list(names)),
        };
        return refuse(format!("there is no site `{site}`"), help);
    }
    let here = plant.machines.iter().filter(|one| site.is_none_or(|site| plant.site_of(one) == site));
    let found: Vec<&Machine> = here.clone().filter(|one| name.is_none_or(|name| one.name == name)).collect();
    match (found.as_slice(), name) {
        ([only], _) => Ok(only),
        ([], Some(name)) => {
            let names = here.map(|one| one.name.as_str());
            let help = match nearest(name, names.clone()) {
                Some(word) => format!("did you mean `{word}`?"),
                None => format!("the machines are {}", list(names)),
            };
            refuse(format!("there is no machine `{name}`"), help)
        }
        ([], None) => refuse("there is no machine".to_owned(), "add one to the plant file".to_owned()),
        (several, Some(name)) => {
            let sites = several.iter().map(|one| plant.site_of(one));
            refuse(
                format!("{} sites have a machine `{name}`", several.len()),
                format!("add `--site NAME`: {}", list(sites)),
            )
        }
        (several, None) => refuse(
            format!("no machine is named, and there are {}", several.len()),
            format!("add `--machine NAME`: {}", list(several.iter().map(|one| one.name.as_str()))),
        ),
    }
}

/// `a`, `b` and how many more.
fn list<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let mut names: Vec<String> = names.map(|name| format!("`{name}`")).collect();
    let more = names.len().saturating_sub(NAMED);
    names.truncate(NAMED);
    if more > 0 {
        names.push(format!("{more} more"));
    }
    names.join(", ")
}

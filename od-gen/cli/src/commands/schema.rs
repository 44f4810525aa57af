//! `odgen schema`: schemas for editors.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use od_gen::source::open;
use od_reference::{plant_schema, plant_schema_of};
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::model::{Dictionary, System};
use od_spec::plant::{is_plant, plant};
use od_spec::source::{FileId, SourceMap};

use crate::exit::ERRORS;
use crate::report::{Report, print, print_json, shown};

#[derive(Debug, Args)]
pub(crate) struct SchemaArgs {
    /// Specification, EDS or DCF, of whose device the schema of parameter files is printed
    #[arg(long, value_name = "SPEC")]
    pub params: Option<PathBuf>,

    /// Key of the device [default: the only one]
    #[arg(long, value_name = "KEY", requires = "params")]
    pub device: Option<String>,

    /// The schema of plant files; of a plant, or of specifications, EDS and DCF files, with what their devices have
    #[arg(long, conflicts_with = "params", num_args = 0.., value_name = "PLANT|SPEC")]
    pub plant: Option<Vec<PathBuf>>,
}

pub(crate) fn run(args: &SchemaArgs, report: &Report) -> u8 {
    if let Some(files) = &args.plant {
        return of_plants(files, report);
    }
    let Some(spec) = &args.params else { return print(&od_reference::json_schema()) };
    let Some(system) = report.compile(spec) else { return ERRORS };
    match report.device_or_only(&system, args.device.as_deref()) {
        Ok(device) => print_json(od_reference::parameter_schema(&system, device).as_bytes()),
        Err(code) => code,
    }
}

/// Prints the schema: of any plant, of the plant that is named, or of plants with the devices of files.
fn of_plants(files: &[PathBuf], report: &Report) -> u8 {
    if files.is_empty() {
        return print_json(plant_schema().as_bytes());
    }
    let mut devices = Vec::new();
    for path in files {
        let mut sources = SourceMap::new();
        let help = "check the path; a plant file begins with `od-plant: 1`";
        let root = match open(path, help, &mut sources) {
            Ok(root) => root,
            Err(diagnostic) => return report.refuse(*diagnostic),
        };
        let found = if is_plant(sources.file(root).text()) {
            of_plant(&mut sources, root, report)
        } else {
            of_file(path, report)
        };
        match found {
            Ok(found) => devices.extend(found),
            Err(code) => return code,
        }
    }
    if let Some(key) = twice(&devices) {
        let message = format!("two devices have the key `{key}`");
        return report.refuse(
            Diagnostic::without_place(codes::UNKNOWN_DEVICE, message)
                .help("name the plant, in which each device has a key of its own"),
        );
    }
    let devices: Vec<(&str, &System, &Dictionary)> =
        devices.iter().map(|one| (one.key.as_str(), &*one.system, &*one.dictionary)).collect();
    print_json(plant_schema_of(&devices).as_bytes())
}

/// A device by its key in a plant.
struct Keyed {
    key: String,
    system: Arc<System>,
    dictionary: Arc<Dictionary>,
}

/// The devices of a plant. What else is wrong with it does not matter: it is being written.
fn of_plant(sources: &mut SourceMap, root: FileId, report: &Report) -> Result<Vec<Keyed>, u8> {
    let read = plant(sources, root, &mut report.loader());
    let devices: Vec<Keyed> = read
        .devices
        .into_iter()
        .map(|device| Keyed { key: device.key, system: device.system, dictionary: device.dictionary })
        .collect();
    if devices.is_empty() {
        let mut diagnostics: Diagnostics = read.diagnostics;
        for file in read.files {
            diagnostics.append(file.diagnostics);
        }
        diagnostics.sort();
        report.show(&diagnostics, sources);
        return Err(ERRORS);
    }
    Ok(devices)
}

/// The devices of a specification, EDS or DCF, by their own keys.
fn of_file(path: &Path, report: &Report) -> Result<Vec<Keyed>, u8> {
    let system = report.compile(path).ok_or(ERRORS)?;
    if system.devices.is_empty() {
        let message = format!("{} has no device", shown(path));
        let help = "name a plant, or specifications, EDS and DCF files of devices";
        return Err(report.refuse(Diagnostic::without_place(codes::UNKNOWN_DEVICE, message).help(help)));
    }
    let system = Arc::new(system);
    let keyed = |device: &Dictionary| Keyed {
        key: device.key.clone(),
        system: Arc::clone(&system),
        dictionary: Arc::new(device.clone()),
    };
    Ok(system.devices.iter().map(keyed).collect())
}

/// A key that two devices have.
fn twice(devices: &[Keyed]) -> Option<&str> {
    let mut keys: Vec<&str> = devices.iter().map(|one| one.key.as_str()).collect();
    keys.sort_unstable();
    keys.windows(2).find(|pair| pair[0] == pair[1]).map(|pair| pair[0])
}

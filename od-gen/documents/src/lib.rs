//! Reference documentation as files, with the calls of accessors in Rust, and the index of tables for programs.
//!
//! `docs-gen` prints pages and knows no generator; here they meet the accessors of the generated Rust.

pub use docs_gen::{Format, Options, TemplateError, Templates};

use od_gen::{Artifact, rust};
use od_spec::model::{Devices, System};
use serde::Serialize;

/// What documents of these devices show; no key means all devices.
pub fn options(system: &System, devices: &[String], language: Option<&str>) -> Options {
    let devices = Devices::listed(devices);
    let chosen = system.devices.iter().filter(|device| devices.includes(&device.key));
    let mut options =
        Options { devices: devices.clone(), language: language.map(str::to_owned), ..Options::default() };
    for device in chosen {
        options.accessors.insert(device.key.clone(), rust::accessors(system, device).into_iter().collect());
    }
    options
}

/// The documents of a specification by the name of `stem`, below `root`, and `tables.json` where it describes a manual.
///
/// # Errors
/// A template has a mistake, or asks for something that the context does not have.
pub fn artifacts(
    system: &System,
    root: &str,
    stem: &str,
    options: &Options,
    templates: &[Templates],
) -> Result<Vec<Artifact>, TemplateError> {
    let context = docs_gen::context(system, options);
    let mut list = Vec::new();
    for templates in templates {
        for page in templates.print(&context)? {
            let path = format!("{root}{stem}/{}", page.path);
            list.push(Artifact { path, bytes: page.text.into_bytes(), purpose: String::new() });
        }
    }
    let index = docs_gen::table_index(system, options);
    if !index.tables.is_empty() {
        let path = format!("{root}{stem}/tables.json");
        let purpose = "what takes the place of each printed table".to_owned();
        list.push(Artifact { path, bytes: json(&index), purpose });
    }
    Ok(list)
}

/// What templates see, as JSON.
pub fn dump_context(system: &System, options: &Options) -> Vec<u8> {
    json(&docs_gen::context(system, options))
}

fn json(value: &impl Serialize) -> Vec<u8> {
    // Maps with text keys and plain values only, into memory: this cannot fail.
    let mut text = serde_json::to_vec_pretty(value).unwrap_or_default();
    text.push(b'\n');
    text
}

//! `--modules`: what is plugged into a bus coupler.

use std::collections::BTreeMap;
use std::path::Path;

use od_formats::eds::write_eds;
use od_gen::source::{FileLoader, compile_file_with_modules};
use od_spec::diag::Diagnostic;
use od_spec::eds::codes::UNKNOWN_MODULE;
use od_spec::model::{Dictionary, Further, Module, SystemSource};
use od_spec::source::SourceMap;
use od_spec::{Compiled, NoFiles, compile_with_modules};

use crate::report::shown;

/// So many modules are named in a message.
const NAMED: usize = 12;
/// So many can be plugged in: 1027h has sub-indices up to FEh, one for each of them.
const MOST: usize = 254;

/// The device of a file with modules plugged in, which are named by number, order code or product name. Of a specification,
/// its EDS is the file, as that is what modules are made for.
pub(crate) fn plugged_in(
    names: &[String],
    path: &Path,
    key: Option<&str>,
    coupler: &Compiled,
    sources: &mut SourceMap,
) -> Result<Compiled, Box<Diagnostic>> {
    let coupler = coupler.system.as_ref().and_then(|system| {
        let is_meant = |device: &&Dictionary| key.is_none_or(|key| device.key == key);
        Some((system, system.devices.iter().find(is_meant)?))
    });
    let alone = coupler.map(|(_, device)| device);
    let nothing = Further::default();
    let further = alone.and_then(|device| device.further.as_deref()).unwrap_or(&nothing);
    if further.modules.is_empty() {
        let message = format!("{} describes no modules", shown(path));
        let help = "take the EDS of a bus coupler, which describes them under `[SupportedModules]`";
        return Err(refusal(message, help));
    }
    let numbers = names.iter().map(|name| number(name.trim(), &further.modules));
    let numbers: Vec<u32> = numbers.collect::<Result<_, _>>()?;
    if numbers.len() > MOST {
        let message = format!("{} modules are named, and 1027h has entries for {MOST}", numbers.len());
        return Err(refusal(message, "name no more than that"));
    }
    *sources = SourceMap::new();
    let whole = match coupler.filter(|(system, _)| system.source == SystemSource::Specification) {
        Some((system, device)) => {
            let eds = String::from_utf8_lossy(&write_eds(system, device)).into_owned();
            let root = sources.add(format!("{}.eds", device.key), eds);
            compile_with_modules(sources, root, &mut NoFiles, &numbers)
        }
        None => compile_file_with_modules(path, sources, &mut FileLoader::default(), &numbers),
    };
    let count = |device: &Dictionary| device.entries().count();
    let with = whole.system.as_ref().and_then(|system| system.devices.first());
    let has_objects = |module: &Module| !module.brings.is_empty() || !module.extends.is_empty();
    let is_more = numbers.iter().filter_map(|number| further.modules.get(number)).any(has_objects);
    if !further.connected.is_empty() || (is_more && with.map(count) <= alone.map(count)) {
        let message = format!("{} has the objects of modules already", shown(path));
        return Err(refusal(message, "take the EDS of the bus coupler alone"));
    }
    Ok(whole)
}

/// The number of a module.
fn number(name: &str, modules: &BTreeMap<u32, Module>) -> Result<u32, Box<Diagnostic>> {
    if let Some(number) = name.parse().ok().filter(|number| modules.contains_key(number)) {
        return Ok(number);
    }
    let is_called = |module: &Module| {
        module.order_code.eq_ignore_ascii_case(name) || module.product_name.eq_ignore_ascii_case(name)
    };
    let called: Vec<u32> =
        modules.iter().filter(|(_, module)| is_called(module)).map(|(number, _)| *number).collect();
    match called.as_slice() {
        [number] => Ok(*number),
        [] => {
            let message = format!("there is no module `{name}`");
            Err(refusal(message, &format!("the modules are {}", list(modules))))
        }
        several => {
            let several: Vec<String> = several.iter().map(u32::to_string).collect();
            let message = format!("`{name}` is the name of several modules: {}", several.join(", "));
            Err(refusal(message, "name one of them by its number"))
        }
    }
}

/// `1 (8 inputs, DI8), 2 (4 inputs, DI4)`.
fn list(modules: &BTreeMap<u32, Module>) -> String {
    let named = modules.iter().take(NAMED);
    let named =
        named.map(|(number, module)| format!("{number} ({}, {})", module.product_name, module.order_code));
    let mut list: Vec<String> = named.collect();
    if modules.len() > NAMED {
        list.push(format!("{} more", modules.len() - NAMED));
    }
    list.join(", ")
}

fn refusal(message: String, help: &str) -> Box<Diagnostic> {
    Box::new(Diagnostic::without_place(UNKNOWN_MODULE, message).help(help))
}

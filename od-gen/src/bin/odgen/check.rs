//! `odgen check`.

use std::path::Path;

use od_gen::rust;
use od_gen::source::{FileLoader, compile_file};
use od_spec::source::SourceMap;
use od_spec::{Compiled, departures};

use super::args::CheckArgs;
use super::report::Report;
use super::specs;
use super::{ERRORS, SUCCESS};

pub(crate) fn run(args: &CheckArgs, directory: &Path, report: &Report) -> u8 {
    let specs = match specs::all(&args.specs, directory, report) {
        Ok(specs) => specs,
        Err(code) => return code,
    };
    let mut code = SUCCESS;
    for path in &specs {
        let mut sources = SourceMap::new();
        let Compiled { system, mut diagnostics, .. } =
            compile_file(path, &mut sources, &mut FileLoader::default());
        for device in system.iter().filter(|_| args.rust).flat_map(|system| &system.devices) {
            if let Some(system) = &system {
                let _ = rust::tokens(system, device, &mut diagnostics);
            }
        }
        report.show(&diagnostics, &sources);
        if let Some(system) = &system {
            report.show_notes(&departures(system), &sources, args.notes);
        }
        if diagnostics.has_errors() || system.is_none() || (args.deny_warnings && !diagnostics.is_empty()) {
            code = ERRORS;
        }
    }
    code
}

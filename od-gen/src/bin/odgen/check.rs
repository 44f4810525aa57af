//! `odgen check`.

use od_gen::source::{FileLoader, compile_file};
use od_spec::source::SourceMap;

use super::args::CheckArgs;
use super::report::Report;
use super::{ERRORS, FINE};

pub(crate) fn run(args: &CheckArgs, report: &Report) -> u8 {
    let mut code = FINE;
    for path in &args.specs {
        let mut sources = SourceMap::new();
        let compiled = compile_file(path, &mut sources, &mut FileLoader::default());
        report.show(&compiled.diagnostics, &sources);
        if compiled.system.is_none() || (args.deny_warnings && !compiled.diagnostics.is_empty()) {
            code = ERRORS;
        }
    }
    code
}

//! `odgen library`: the libraries of standard objects.

use clap::Args;
use od_spec::diag::{Diagnostic, codes};

use crate::report::{Report, print};

#[derive(Debug, Args)]
pub(crate) struct LibraryArgs {
    /// Name, such as `cia402`
    pub name: Option<String>,
}

pub(crate) fn run(args: &LibraryArgs, report: &Report) -> u8 {
    let names = od_spec::LIBRARIES.iter().map(|(name, _)| *name);
    let Some(name) = args.name.as_deref() else {
        return print(&(names.collect::<Vec<_>>().join("\n") + "\n"));
    };
    match od_spec::LIBRARIES.iter().find(|(known, _)| *known == name) {
        Some((_, text)) => print(text),
        None => report.refuse(
            Diagnostic::without_place(codes::UNKNOWN_WORD, format!("found `{name}`, expected a library"))
                .help(format!("the libraries are {}", names.collect::<Vec<_>>().join(", "))),
        ),
    }
}

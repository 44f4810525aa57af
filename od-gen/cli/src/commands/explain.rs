//! `odgen explain`: what a code means.

use clap::Args;
use od_spec::diag::Code;
use od_spec::visible::visible;

use crate::exit::USAGE;
use crate::report::print;

#[derive(Debug, Args)]
pub(crate) struct ExplainArgs {
    /// A code such as OD0507, or `all`
    pub code: String,
}

pub(crate) fn run(args: &ExplainArgs) -> u8 {
    let id = args.code.as_str();
    if id.eq_ignore_ascii_case("all") {
        let line = |code: &Code| format!("{code}  {:7}  {}\n", code.severity.word(), code.title);
        return print(&od_spec::all_codes().into_iter().map(line).collect::<String>());
    }
    match od_spec::code(id) {
        Some(code) => print(&od_reference::explained(code)),
        None => {
            let id = visible(id);
            anstream::eprintln!(
                "error: there is no code `{id}`; codes look like `OD0301`, `odgen explain all` lists them"
            );
            USAGE
        }
    }
}

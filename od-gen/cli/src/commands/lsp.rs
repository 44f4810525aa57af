//! `odgen lsp`.

use clap::Args;
use od_lsp::{Exit, serve_stdio};
use od_spec::diag::{Diagnostic, codes};

use crate::exit::{ERRORS, SUCCESS};
use crate::report::Report;

#[derive(Debug, Args)]
pub(crate) struct LspArgs {
    /// Use standard input and output, as editors ask for; there is no other way
    #[arg(long)]
    pub stdio: bool,
}

pub(crate) fn run(report: &Report) -> u8 {
    match serve_stdio() {
        Ok(Exit::Agreed) => SUCCESS,
        Ok(Exit::Sudden) => ERRORS,
        Err(error) => {
            let message = format!("cannot serve the editor: {error}");
            report.refuse(
                Diagnostic::without_place(codes::UNREADABLE, message)
                    .help("an editor starts `odgen lsp` and speaks the Language Server Protocol with it"),
            )
        }
    }
}

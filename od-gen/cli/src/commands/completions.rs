//! `odgen completions`: scripts for shells.

use clap::Args;

use crate::report::print;

#[derive(Debug, Args)]
pub(crate) struct CompletionsArgs {
    /// The shell
    #[arg(value_enum)]
    pub shell: clap_complete::Shell,
}

/// Prints the script of a command line.
pub(crate) fn run(args: &CompletionsArgs, command_line: &mut clap::Command) -> u8 {
    let mut text = Vec::new();
    clap_complete::generate(args.shell, command_line, "odgen", &mut text);
    print(&String::from_utf8_lossy(&text))
}

//! How messages are written, as the command line says it.

use clap::{Args, ValueEnum};

/// How messages are written, said after the command. `odgen docs` and `odgen diff` have formats of their own; there it
/// is said before the command.
#[derive(Debug, Args)]
pub(crate) struct Messages {
    /// How messages are written
    #[arg(long, value_enum)]
    pub format: Option<Format>,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// With the source lines, as rustc does
    #[default]
    Human,
    /// One line each
    Short,
    /// One JSON object per line
    Json,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Color {
    /// On a terminal
    #[default]
    Auto,
    /// Always
    Always,
    /// Never
    Never,
}

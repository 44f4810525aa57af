//! Arguments of `odgen diff`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

#[derive(Debug, Args)]
pub(crate) struct DiffArgs {
    /// The dictionary before the changes; with --git the specification
    #[arg(value_name = "OLD")]
    pub old: PathBuf,

    /// The dictionary after the changes
    #[arg(value_name = "NEW", required_unless_present = "git", conflicts_with = "git")]
    pub new: Option<PathBuf>,

    /// Specification of the device that parameter files are for; they are compared with each other, or with a DCF
    #[arg(long, value_name = "SPEC", conflicts_with = "git")]
    pub spec: Option<PathBuf>,

    /// Compare a specification with itself as it was at a revision of git, such as `HEAD` or `v1.08`
    #[arg(long, value_name = "REV")]
    pub git: Option<String>,

    /// Only this device
    #[arg(long, value_name = "KEY")]
    pub device: Option<String>,

    /// How the differences are written
    #[arg(long, value_enum, default_value_t)]
    pub format: DiffFormat,

    /// Fail with exit code 3 when a change is of this class or of a heavier one
    #[arg(long, value_enum, value_name = "CLASS")]
    pub exit_code: Option<DiffClass>,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum DiffFormat {
    /// For people, with reasons and proposals
    #[default]
    Human,
    /// One line for each change
    Short,
    /// Tables and an entry for a changelog
    Markdown,
    /// One JSON object
    Json,
}

/// The classes of changes, the lightest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum DiffClass {
    /// Documents only: whatever differs
    Documents,
    /// Compatible additions
    Addition,
    /// The device does something else
    Behaviour,
    /// Firmware does not compile any more
    Firmware,
    /// Stored parameters are lost
    Stored,
    /// PLC projects break
    Plc,
}

impl From<DiffClass> for od_diff::Class {
    fn from(class: DiffClass) -> Self {
        match class {
            DiffClass::Documents => Self::Documents,
            DiffClass::Addition => Self::Addition,
            DiffClass::Behaviour => Self::Behaviour,
            DiffClass::Firmware => Self::Firmware,
            DiffClass::Stored => Self::Stored,
            DiffClass::Plc => Self::Plc,
        }
    }
}

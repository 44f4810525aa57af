//! Arguments of `odgen check`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use od_spec::diag::readers::Reader;

use crate::messages::Format;
use crate::progress::Audience;

#[derive(Debug, Args)]
pub(crate) struct CheckArgs {
    /// Specifications, EDS, DCF, XDD and XDC files, parameter files that name theirs, directories to look for specifications
    /// and EDS files in, or `-` for standard input [default: the `*.od.yaml` of the current directory]
    #[arg(value_name = "FILE")]
    pub files: Vec<PathBuf>,

    /// Report these findings as errors: a code such as EDS503, the codes that begin with EDS5, `warnings` or `notes`
    #[arg(long, value_name = "CODE")]
    pub deny: Vec<String>,

    /// Treat warnings as errors, as `--deny warnings` does
    #[arg(long)]
    pub deny_warnings: bool,

    /// Leave these findings out, named in the same way; errors in a specification stay
    #[arg(long, value_name = "CODE")]
    pub allow: Vec<String>,

    /// Check EDS and DCF files strictly against the standard, as your own files and not as files of others that are
    /// only read
    #[arg(long)]
    pub strict: bool,

    /// Report as errors only what makes this reader refuse an EDS or DCF
    #[arg(long = "for", value_enum, value_name = "READER")]
    pub readers: Vec<ReaderName>,

    /// Also show notes: what is not wrong but worth knowing, such as objects that depart from the standard they are taken from
    #[arg(long)]
    pub notes: bool,

    /// Also list every text that lacks one of the languages of its specification
    #[arg(long)]
    pub translations: bool,

    /// Show every place of a finding that an EDS or DCF has in many places, up to 1,000, not only the first three
    #[arg(long)]
    pub all: bool,

    /// Also check what matters only to Rust code: names that become one identifier, strings without a capacity
    #[arg(long)]
    pub rust: bool,

    /// What standard input is called; the name shows what it is, as it does for a file
    #[arg(long, value_name = "NAME", default_value = "<stdin>", hide_default_value = true)]
    pub stdin_name: String,

    /// How findings are written [default: human]
    #[arg(long, value_enum)]
    pub format: Option<CheckFormat>,
}

/// How findings are written. SARIF and GitHub's workflow commands go to standard output, the others to standard error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum CheckFormat {
    /// With the source lines, as rustc does, and a summary
    Human,
    /// One line each
    Short,
    /// One JSON object per line
    Json,
    /// One SARIF 2.1.0 document, for code scanning services
    Sarif,
    /// Workflow commands of GitHub Actions, which show findings next to the source
    Github,
}

impl CheckFormat {
    /// How messages about the command itself are written.
    pub(crate) fn of_messages(self) -> Format {
        match self {
            CheckFormat::Human => Format::Human,
            CheckFormat::Short | CheckFormat::Sarif | CheckFormat::Github => Format::Short,
            CheckFormat::Json => Format::Json,
        }
    }

    /// Who reads the findings.
    pub(crate) const fn audience(self) -> Audience {
        match self {
            CheckFormat::Human | CheckFormat::Short => Audience::People,
            CheckFormat::Json | CheckFormat::Sarif | CheckFormat::Github => Audience::Programs,
        }
    }
}

impl From<Format> for CheckFormat {
    fn from(format: Format) -> Self {
        match format {
            Format::Human => CheckFormat::Human,
            Format::Short => CheckFormat::Short,
            Format::Json => CheckFormat::Json,
        }
    }
}

/// Readers whose refusals are predicted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum ReaderName {
    /// dcfchk, the checker of lely's dcf-tools
    #[value(alias = "dcfchk")]
    Lely,
    /// The Python library canopen
    PythonCanopen,
    /// The Python package eds-utils
    EdsUtils,
    /// The JavaScript library canopen
    NodeCanopen,
    /// The Rust crate canopen-host
    CanopenHost,
}

impl From<ReaderName> for Reader {
    fn from(name: ReaderName) -> Self {
        match name {
            ReaderName::Lely => Reader::Dcfchk,
            ReaderName::PythonCanopen => Reader::PythonCanopen,
            ReaderName::EdsUtils => Reader::EdsUtils,
            ReaderName::NodeCanopen => Reader::NodeCanopen,
            ReaderName::CanopenHost => Reader::CanopenHost,
        }
    }
}

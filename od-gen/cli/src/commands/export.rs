//! `odgen export`: a device as a workbook or as CSV.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::Args;
use od_gen::Artifact;
use od_gen::files::Existing;
use od_spec::diag::{Diagnostic, codes};
use od_table::{csv, xlsx};

use crate::exit::ERRORS;
use crate::messages::Messages;
use crate::output::{file_name, forced, save};
use crate::report::{Report, print, shown};
use crate::specs;

#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("file").required(true).multiple(true))]
pub(crate) struct ExportArgs {
    /// The specification, EDS, DCF, XDD or XDC [default: the only `*.od.yaml` of the current directory]
    pub spec: Option<PathBuf>,

    /// Key of the device [default: the only one]
    #[arg(long, value_name = "KEY")]
    pub device: Option<String>,

    /// Workbook to write, with a sheet for objects, bits, values, units, PDOs and errors
    #[arg(long, value_name = "FILE", group = "file")]
    pub xlsx: Option<PathBuf>,

    /// Text to write, with the same tables one after the other
    #[arg(long, value_name = "FILE", group = "file")]
    pub csv: Option<PathBuf>,

    /// Replace files of these names
    #[arg(long)]
    pub force: bool,

    #[command(flatten)]
    pub messages: Messages,
}

pub(crate) fn run(args: &ExportArgs, directory: &Path, report: &Report) -> u8 {
    export(args, directory, report).unwrap_or_else(|code| code)
}

fn export(args: &ExportArgs, directory: &Path, report: &Report) -> Result<u8, u8> {
    let spec = specs::one(args.spec.as_deref(), directory, report)?;
    let (used, _) = report.compile_with_sources(&spec).ok_or(ERRORS)?;
    let device = report.device_or_only(&used.system, args.device.as_deref())?;
    let mut written = Vec::new();
    if let Some(path) = &args.xlsx {
        let made = xlsx(&used.system, device).ok_or_else(|| {
            let message = format!("the tables of `{}` are larger than a workbook can be", device.key);
            report.refuse(
                Diagnostic::without_place(codes::WRITE_FAILED, message)
                    .help("write them as CSV: `--csv FILE`"),
            )
        })?;
        written.push((path, made));
    }
    written.extend(args.csv.as_ref().map(|path| (path, csv(&used.system, device))));
    if let Some((_, made)) = written.first() {
        for what in &made.not_held {
            report.note(&format!("not in the tables: {what}"));
        }
    }
    let mut lines = String::new();
    for (path, made) in written {
        let name = file_name(path, "the tables", std::slice::from_ref(&spec))
            .map_err(|diagnostic| report.refuse(diagnostic))?;
        let _ = writeln!(lines, "  {}  {} kB", shown(path), made.bytes.len().div_ceil(1024));
        let set = [Artifact { path: name, bytes: made.bytes, purpose: String::new() }];
        let folder = path.parent().unwrap_or(Path::new(""));
        save(folder, &set, forced(args.force, Existing::None))
            .map_err(|diagnostic| report.refuse(diagnostic))?;
    }
    Ok(print(&lines))
}

//! `odgen params`: the values of a DCF as a parameter file.

use std::path::{Path, PathBuf};

use clap::Args;
use od_gen::Artifact;
use od_gen::files::Existing;
use od_import::parameters::{About, ParameterText, Transferred, transfer, write};
use od_spec::Commissioning;
use od_spec::diag::{Diagnostic, codes};
use od_spec::file_name;
use od_spec::model::Dictionary;

use crate::exit::ERRORS;
use crate::messages::Messages;
use crate::output::{forced, save};
use crate::report::{Report, Used, print, print_file, shown};

#[derive(Debug, Args)]
pub(crate) struct ParamsArgs {
    /// The DCF, saved from a device by any tool
    #[arg(value_name = "DCF")]
    pub file: PathBuf,

    /// Specification of the device, whose names, units and defaults count [default: those of the DCF itself]
    #[arg(long, value_name = "SPEC")]
    pub spec: Option<PathBuf>,

    /// Key of the device in the specification [default: the only one]
    #[arg(long, value_name = "KEY", requires = "spec")]
    pub device: Option<String>,

    /// File to write [default: it is printed]
    #[arg(long, short, value_name = "FILE")]
    pub out: Option<PathBuf>,

    /// Replace a file of this name
    #[arg(long)]
    pub force: bool,

    #[command(flatten)]
    pub messages: Messages,
}

pub(crate) fn run(args: &ParamsArgs, report: &Report) -> u8 {
    params(args, report).unwrap_or_else(|code| code)
}

fn params(args: &ParamsArgs, report: &Report) -> Result<u8, u8> {
    let (file, sources) = report.compile_with_sources(&args.file).ok_or(ERRORS)?;
    let (of_file, node) = dcf(&file, &args.file).map_err(|diagnostic| report.refuse(diagnostic))?;
    let written = match &args.spec {
        None => {
            let about = About {
                system: &file.system,
                sources: &sources,
                device: of_file,
                names_device: false,
                node_id: file.node_id(None),
            };
            write(about, &node, Vec::new())
        }
        Some(spec) => {
            let (used, sources) = report.compile_with_sources(spec).ok_or(ERRORS)?;
            let device = report.device_or_only(&used.system, args.device.as_deref())?;
            let about = About {
                system: &used.system,
                sources: &sources,
                device,
                names_device: true,
                node_id: file.node_id(None),
            };
            of_specification(about, of_file, &node)
        }
    };
    let ParameterText { text, count, left_out, findings, .. } = written;
    for (lines, what) in [(&left_out, "left out"), (&findings, "wrong")] {
        for line in lines {
            report.note(&format!("{what}: {line}"));
        }
    }
    let Some(out) = &args.out else { return Ok(print_file(&text)) };
    let name = out.file_name().and_then(|name| name.to_str()).ok_or_else(|| {
        let message = format!("cannot write `{}`: it names no file", shown(out));
        report.refuse(Diagnostic::without_place(codes::WRITE_FAILED, message).help("write the file's name"))
    })?;
    let directory = out.parent().unwrap_or(Path::new(""));
    let artifact = Artifact { path: name.to_owned(), bytes: text.into_bytes(), purpose: String::new() };
    save(directory, std::slice::from_ref(&artifact), forced(args.force, Existing::None))
        .map_err(|diagnostic| report.refuse(diagnostic))?;
    let plural = if count == 1 { "" } else { "s" };
    Ok(print(&format!("  {}  {count} value{plural}\n", shown(out))))
}

/// The device of a DCF and the node that it configures.
fn dcf<'a>(file: &'a Used, path: &Path) -> Result<(&'a Dictionary, Commissioning), Diagnostic> {
    let device = file.system.devices.first();
    device.zip(file.node.as_ref().map(|node| node.at(None))).ok_or_else(|| {
        let message = format!("{} is no DCF", file_name::shown(path));
        Diagnostic::without_place(codes::UNREADABLE, message)
            .help("name a DCF: a specification and an EDS hold no values of a node")
    })
}

fn of_specification(about: About<'_>, of_file: &Dictionary, node: &Commissioning) -> ParameterText {
    let Transferred { node, left_out, .. } = transfer(of_file, node, about.device);
    write(about, &node, left_out)
}

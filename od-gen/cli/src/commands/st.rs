//! `odgen st`.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use clap::Args;
use od_gen::files::Existing;
use od_spec::diag::{Diagnostic, codes};
use od_spec::model::Devices;
use od_spec::rule_codes;
use od_st::write as write_device;

use crate::exit::ERRORS;
use crate::language::language;
use crate::messages::Messages;
use crate::output::{clash, forced, overwritten, write};
use crate::report::{Report, node_id, shown};
use crate::specs;

#[derive(Debug, Args)]
pub(crate) struct StArgs {
    /// Specifications, EDS, DCF, XDD or XDC files [default: the `*.od.yaml` of the current directory]
    pub specs: Vec<PathBuf>,

    /// Directory for the files
    #[arg(long, short, default_value = "generated/st", value_name = "DIR")]
    pub out: PathBuf,

    /// Only these devices
    #[arg(long, value_name = "KEY")]
    pub device: Vec<String>,

    /// The node-ID (1 to 127) that COB-IDs and values are for [default: that of a DCF; else such constants have no node-ID in them]
    #[arg(long, value_name = "ID")]
    pub node: Option<String>,

    /// Language of the comments, such as `en` or `de` [default: the first of the specification]
    #[arg(long, visible_alias = "language", value_name = "CODE")]
    pub lang: Option<String>,

    /// Replace files of these names that odgen did not make
    #[arg(long)]
    pub force: bool,

    #[command(flatten)]
    pub messages: Messages,
}

pub(crate) fn run(args: &StArgs, directory: &Path, report: &Report) -> u8 {
    st(args, directory, report).unwrap_or_else(|code| code)
}

/// Writes the files of all devices, and reports what they do not hold.
fn st(args: &StArgs, directory: &Path, report: &Report) -> Result<u8, u8> {
    let node =
        args.node.as_deref().map(node_id).transpose().map_err(|diagnostic| report.refuse(diagnostic))?;
    let specs = specs::all(&args.specs, directory, report)?;
    // Everything is compiled, so that all messages are shown.
    let used: Vec<_> = specs.iter().map(|path| report.compile_with_sources(path)).collect();
    let used: Option<Vec<_>> = used.into_iter().collect();
    let used = used.ok_or(ERRORS)?;
    for key in &args.device {
        if !used.iter().any(|(used, _)| used.system.device(key).is_some()) {
            return Err(report.unknown_device(used.iter().map(|(used, _)| &used.system), key));
        }
    }
    let systems = used.iter().map(|(used, _)| &used.system);
    let code = args.lang.as_deref().map(|code| language(code, systems)).transpose();
    let code = code.map_err(|diagnostic| report.refuse(*diagnostic))?;
    let devices = Devices::listed(&args.device);
    let mut set = Vec::new();
    let mut left_out = Vec::new();
    for (used, sources) in &used {
        let node = used.node_id(node);
        let configured = used.node.as_ref().map(|of_file| report.moved(of_file, node, sources));
        for device in used.system.devices.iter().filter(|device| devices.includes(&device.key)) {
            let configured = configured.as_ref();
            let device = configured.map_or(Cow::Borrowed(device), |node| Cow::Owned(node.configured(device)));
            let written = write_device(&used.system, &device, node, code.as_deref());
            set.extend(written.artifacts);
            left_out.extend(written.left_out);
        }
    }
    if let Some(what) = clash(&set, "devices") {
        return Err(report.refuse(Diagnostic::without_place(rule_codes::DUPLICATE_NAME, what).help(
            "give the devices other keys, or write them into different directories, with `--device` and `--out`",
        )));
    }
    if let Some(path) = overwritten(&args.out, &set, &specs) {
        let message = format!("cannot write {}: it is read to make it", shown(Path::new(&path)));
        let help = "write into another directory, with `--out`";
        return Err(report.refuse(Diagnostic::without_place(codes::WRITE_FAILED, message).help(help)));
    }
    for left_out in &left_out {
        report.note(&format!("left out: {left_out}"));
    }
    Ok(write(&args.out, &set, forced(args.force, Existing::Generated), "", report))
}

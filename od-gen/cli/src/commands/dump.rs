//! `odgen dump`: the resolved model as JSON.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::exit::ERRORS;
use crate::messages::Messages;
use crate::report::{Report, print_json};
use crate::specs;

#[derive(Debug, Args)]
pub(crate) struct DumpArgs {
    /// The specification, EDS, DCF, XDD or XDC [default: the only `*.od.yaml` of the current directory]
    pub spec: Option<PathBuf>,

    /// As JSON, the only format there is
    #[arg(long)]
    pub json: bool,

    /// Only these devices
    #[arg(long, value_name = "KEY")]
    pub device: Vec<String>,

    #[command(flatten)]
    pub messages: Messages,
}

pub(crate) fn run(args: &DumpArgs, directory: &Path, report: &Report) -> u8 {
    let spec = match specs::one(args.spec.as_deref(), directory, report) {
        Ok(spec) => spec,
        Err(code) => return code,
    };
    let Some((used, _)) = report.compile_with_sources(&spec) else { return ERRORS };
    let id = used.node_id(None);
    let node = used.node.map(|node| node.at(id));
    let system = used.system;
    if let Err(code) = args.device.iter().try_for_each(|key| report.device(&system, key).map(drop)) {
        return code;
    }
    let dump = match node {
        Some(node) => od_formats::json::dump_node(&system, &args.device, &node, id),
        None => od_formats::json::dump(&system, &args.device),
    };
    print_json(&dump)
}

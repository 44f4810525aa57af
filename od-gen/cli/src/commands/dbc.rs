//! `odgen dbc`.

use std::path::{Path, PathBuf};

use clap::Args;
use od_formats::dbc::{Node, write};
use od_gen::Artifact;
use od_gen::files::Existing;

use crate::bus_nodes::BusNodes;
use crate::bus_nodes::NodesArgs;
use crate::messages::Messages;
use crate::output::file_name;
use crate::output::{forced, save};
use crate::report::{Report, print, shown};

#[derive(Debug, Args)]
pub(crate) struct DbcArgs {
    #[command(flatten)]
    pub nodes: NodesArgs,

    /// The file [default: `KEY-N.dbc` of the only node, and `bus.dbc` of several]
    #[arg(long, short, value_name = "FILE")]
    pub out: Option<PathBuf>,

    /// Replace a file of this name that odgen did not make
    #[arg(long)]
    pub force: bool,

    #[command(flatten)]
    pub messages: Messages,
}

pub(crate) fn run(args: &DbcArgs, directory: &Path, report: &Report) -> u8 {
    dbc(args, directory, report).unwrap_or_else(|code| code)
}

/// Writes the DBC of the nodes, and reports what it does not hold.
fn dbc(args: &DbcArgs, directory: &Path, report: &Report) -> Result<u8, u8> {
    let bus = BusNodes::read(&args.nodes, directory, report)?;
    let nodes: Vec<Node<'_>> = bus.iter().map(|(id, system, device)| Node { id, system, device }).collect();
    let path = args.out.clone().unwrap_or_else(|| match nodes.as_slice() {
        [only] => PathBuf::from(format!("{}-{}.dbc", only.device.key, only.id)),
        _ => PathBuf::from("bus.dbc"),
    });
    let name =
        file_name(&path, "the DBC", &args.nodes.specs).map_err(|diagnostic| report.refuse(diagnostic))?;
    let written = write(&nodes);
    for left_out in &written.left_out {
        report.note(&format!("left out: {left_out}"));
    }
    for silent in written.silent.values() {
        report.note(&format!("no messages, because these are sent only after they are set up: {silent}"));
    }
    let line = format!(
        "  {}  {} kB  {}, {}, {}\n",
        shown(&path),
        written.bytes.len().div_ceil(1024),
        count(nodes.len(), "node"),
        count(written.messages, "message"),
        count(written.signals, "signal"),
    );
    let set = [Artifact { path: name, bytes: written.bytes, purpose: String::new() }];
    let folder = path.parent().unwrap_or(Path::new(""));
    save(folder, &set, forced(args.force, Existing::Generated))
        .map_err(|diagnostic| report.refuse(diagnostic))?;
    Ok(print(&line))
}

/// `1 node`, `2 nodes`.
fn count(number: usize, what: &str) -> String {
    format!("{number} {what}{}", if number == 1 { "" } else { "s" })
}

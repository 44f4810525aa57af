//! `odgen node`: the master of a bus.

mod access;
mod keep;
mod monitor;
mod network;
mod reach;

use std::path::Path;

use od_gen::client::{AccessError, Contradiction};
use od_gen::trace;
use od_spec::diag::{Diagnostic, codes};
use od_spec::model::{Dictionary, EntryId, System};
use od_spec::source::SourceMap;

use super::ERRORS;
use super::args::{NodeArgs, NodeCommand, OneNodeArgs};
use super::report::{Report, Used, node_id};
use reach::{connect, reach};

pub(crate) fn run(args: &NodeArgs, directory: &Path, report: &Report) -> u8 {
    let done = match &args.command {
        NodeCommand::Read(args) => access::read(args, report),
        NodeCommand::Write(args) => access::write(args, report),
        NodeCommand::Backup(args) => keep::backup(args, report),
        NodeCommand::Compare(args) => keep::compare(args, report),
        NodeCommand::Restore(args) => keep::restore(args, report),
        NodeCommand::Monitor(args) => monitor::monitor(args, directory, report),
        NodeCommand::Scan(args) => network::scan(args, report),
        NodeCommand::Nmt(args) => network::nmt(args, report),
        NodeCommand::Store(args) => network::store(args, report),
        NodeCommand::LoadDefaults(args) => network::load_defaults(args, report),
    };
    done.unwrap_or_else(|code| code)
}

/// What the specification of a command line says.
struct Described {
    used: Used,
    /// The texts that it was read from: messages about values point into them.
    sources: SourceMap,
}

/// A node of a known device.
#[derive(Clone, Copy)]
struct Target<'a> {
    id: u8,
    system: &'a System,
    device: &'a Dictionary,
}

impl Described {
    fn read(args: &OneNodeArgs, report: &Report) -> Result<Self, u8> {
        let spec = super::specs::one(Some(&args.spec), Path::new("."), report)?;
        let (used, sources) = report.compile_with_sources(&spec).ok_or(ERRORS)?;
        Ok(Self { used, sources })
    }

    /// The node that is meant: that of the command line, or else of a parameter file or a DCF.
    fn target(
        &self,
        args: &OneNodeArgs,
        device: Option<&str>,
        of_file: Option<u8>,
        report: &Report,
    ) -> Result<Target<'_>, u8> {
        let system = &self.used.system;
        let device = report.device_or_only(system, args.device.as_deref().or(device))?;
        let stated = args.node.as_deref().map(node_id).transpose().map_err(|one| report.refuse(one))?;
        let id = stated.or(of_file).or(self.used.stated_node_id).ok_or_else(|| {
            report.refuse(
                Diagnostic::without_place(codes::BAD_NODE_ID, "no node-ID is given")
                    .help("add `--node ID`, 1 to 127"),
            )
        })?;
        Ok(Target { id, system, device })
    }
}

impl<'a> Target<'a> {
    /// Words for its entries and values.
    fn words(self) -> trace::Node<'a> {
        trace::Node::new(self.id, self.system, self.device)
    }

    /// `pmc (node 5)`.
    fn name(self) -> String {
        format!("{} (node {})", self.device.key, self.id)
    }

    /// What is said about an access that failed.
    fn failed(self, what: &str, id: EntryId, error: &AccessError) -> Diagnostic {
        let message = format!("{}: cannot {what} {}: {error}", self.name(), self.words().entry(id));
        helped(Diagnostic::without_place(codes::ACCESS_FAILED, message), error)
    }
}

/// A message with what can be done about the failure.
fn helped(diagnostic: Diagnostic, error: &AccessError) -> Diagnostic {
    match error {
        AccessError::Silent => diagnostic
            .help("check node-ID, bit rate and power; a node that is stopped does not answer; `--timeout MS` waits longer"),
        _ => diagnostic,
    }
}

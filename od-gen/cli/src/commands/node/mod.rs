//! `odgen node`: the master of a bus.

mod access;
mod args;
mod beside;
mod confirm;
mod doubt;
mod had;
mod hand;
mod hint;
mod keep;
mod machine;
mod monitor;
mod network;
mod outcome;
mod program;
mod reach;
mod restore;
mod sign;
mod specify;
mod taken;

use std::cell::OnceCell;
use std::path::Path;

use od_bus::client::{AccessError, Bus, Client};
use od_bus::trace;
use od_spec::diag::{Code, Diagnostic, Diagnostics, codes};
use od_spec::model::{Dictionary, EntryId, System};
use od_spec::rule_codes;
use od_spec::source::SourceMap;

use crate::exit::ERRORS;
use crate::plant_file;
use crate::report::{Report, Used, node_id};
use crate::settings::ParameterFiles;
pub(crate) use args::NodeArgs;
use args::{NodeCommand, OneNodeArgs};
use machine::Machine;
use reach::{connect, has_started, is_meant, reach};

pub(crate) fn run(args: &NodeArgs, directory: &Path, report: &Report) -> u8 {
    let report = &report.for_operators();
    let done = match &args.command {
        NodeCommand::Read(args) => access::read(args, report),
        NodeCommand::Write(args) => access::write(args, report),
        NodeCommand::Backup(args) => keep::backup(args, report),
        NodeCommand::Compare(args) => keep::compare(args, report),
        NodeCommand::Restore(args) => keep::restore(args, report),
        NodeCommand::Monitor(args) => monitor::monitor(args, directory, report),
        NodeCommand::Scan(args) => network::scan(args, report),
        NodeCommand::Program(args) => program::program(args, report),
        NodeCommand::Nmt(args) => network::nmt(args, report),
        NodeCommand::Store(args) => sign::store(args, report),
        NodeCommand::LoadDefaults(args) => sign::load_defaults(args, report),
    };
    done.unwrap_or_else(|code| code)
}

/// What the specification or the plant of a command line says.
enum Described {
    /// Devices, one of which a node is; with the texts that they were read from, into which messages about values point.
    Devices {
        used: Box<Used>,
        sources: SourceMap,
        /// Of a DCF: the device with the values of the node that is meant.
        configured: Box<OnceCell<Dictionary>>,
    },
    /// A machine with its nodes.
    Machine(Machine),
}

/// A node of a known device.
#[derive(Clone, Copy)]
struct Target<'a> {
    id: u8,
    /// Where it is on its machine.
    position: Option<&'a str>,
    /// Its serial number, where the plant or a parameter file states one.
    serial: Option<u32>,
    system: &'a System,
    device: &'a Dictionary,
}

impl Described {
    fn read(spec: &Path, args: &OneNodeArgs, report: &Report) -> Result<Self, u8> {
        if plant_file::names_plant(spec) {
            return Machine::read(spec, args, report).map(Self::Machine);
        }
        if args.machine.is_some() || args.site.is_some() {
            let help = "name a plant file, or leave out `--machine` and `--site`";
            return Err(report.refuse(plant_file::no_plant(spec, help)));
        }
        let spec = crate::specs::one(Some(spec), Path::new("."), report)?;
        let (used, sources) = report.compile_with_sources(&spec).ok_or(ERRORS)?;
        Ok(Self::Devices { used: Box::new(used), sources, configured: Box::default() })
    }

    fn sources(&self) -> &SourceMap {
        match self {
            Self::Devices { sources, .. } => sources,
            Self::Machine(machine) => machine.sources(),
        }
    }

    /// The node that is meant: that of the command line, or else of a parameter file or a DCF.
    fn target(
        &self,
        args: &OneNodeArgs,
        files: Option<&ParameterFiles>,
        report: &Report,
    ) -> Result<Target<'_>, u8> {
        let stated = args.node.as_deref().map(node_id).transpose().map_err(|one| report.refuse(one))?;
        let stated = stated.or_else(|| files.and_then(ParameterFiles::stated_node));
        let key = args.device.as_deref();
        let (used, sources, configured) = match self {
            Self::Devices { used, sources, configured } => (used, sources, configured),
            Self::Machine(machine) => return machine.target(stated, key, report),
        };
        let system = &used.system;
        let device = match files {
            Some(files) => files.device(system, key, report)?,
            None => report.device_or_only(system, key)?,
        };
        let id = used.node_id(stated).ok_or_else(|| report.refuse(no_node_id()))?;
        let device = match &used.node {
            Some(of_file) => {
                configured.get_or_init(|| report.moved(of_file, Some(id), sources).configured(device))
            }
            None => device,
        };
        Ok(Target { id, position: None, serial: None, system, device })
    }
}

impl<'a> Target<'a> {
    /// Words for its entries and values.
    fn words(self) -> trace::Node<'a> {
        trace::Node::new(self.id, self.system, self.device)
    }

    /// `pmc (node 5)`, of a machine `B pmc (node 12)`.
    fn name(self) -> String {
        let place = self.position.map_or_else(String::new, |position| format!("{position} "));
        format!("{place}{} (node {})", self.device.key, self.id)
    }

    /// What is printed before lines that are about it, where others have such lines, too.
    fn mark(self) -> String {
        self.position.map_or_else(String::new, |_| format!("{}: ", self.name()))
    }

    /// Reads an entry of it.
    fn read<B: Bus>(self, client: &mut Client<B>, id: EntryId) -> Result<Vec<u8>, AccessError> {
        match self.device.entry(id) {
            Some(entry) => client.read_as(self.id, id, entry.data_type),
            None => client.read(self.id, id),
        }
    }

    /// The exit code, after a message, where it has started since the client is there.
    fn has_started<B: Bus>(self, client: &mut Client<B>, report: &Report) -> Result<(), u8> {
        has_started(client, self.id, &self.name(), report)
    }

    /// What is said about an access that failed.
    fn failed(self, what: &str, id: EntryId, error: &AccessError) -> Diagnostic {
        let message = format!("{}: cannot {what} {}: {error}", self.name(), self.words().entry(id));
        helped(Diagnostic::without_place(codes::ACCESS_FAILED, message), error)
    }
}

/// What is said where it is not known which node is meant.
fn no_node_id() -> Diagnostic {
    Diagnostic::without_place(codes::BAD_NODE_ID, "no node-ID is given").help("add `--node ID`, 1 to 127")
}

/// A message with what can be done about the failure.
fn helped(diagnostic: Diagnostic, error: &AccessError) -> Diagnostic {
    match error {
        AccessError::Silent => diagnostic
            .help("check node-ID, bit rate and power; a node that is stopped does not answer; `--timeout MS` waits longer"),
        _ => diagnostic,
    }
}

/// What a check says of values that go over a bus, sorted: nothing about the files that tools load at boot, whose lines hold no text with
/// a `;` and whose order is fixed, nor what `besides` names.
fn on_the_bus(found: &Diagnostics, besides: &[&Code]) -> Diagnostics {
    let of_files = [rule_codes::NO_ORDER, rule_codes::NOT_FOR_EDS];
    let mut about = Diagnostics::new();
    for one in found.iter().filter(|one| !of_files.contains(&one.code) && !besides.contains(&one.code)) {
        about.push(one.clone());
    }
    about.sort();
    about
}

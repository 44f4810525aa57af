//! The nodes that a command line names.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use od_spec::diag::{Diagnostic, codes};
use od_spec::model::{Dictionary, EntryId, Index, SubIndex, System, Value};
use od_spec::plant::shared_cob_id;
use od_spec::source::SourceMap;
use od_spec::visible::visible;

use crate::exit::ERRORS;
use crate::plant_file;
use crate::report::{Report, node_id};
use crate::specs;

/// Which nodes there are, and by which specifications.
#[derive(Debug, Args)]
pub(crate) struct NodesArgs {
    /// Specifications, EDS, DCF, XDD or XDC files of the nodes [default: the only `*.od.yaml` of the current directory]
    #[arg(value_name = "SPEC")]
    pub specs: Vec<PathBuf>,

    /// A node: its node-ID, or `ID=KEY` with the key of its device; can be given several times [default: those of the DCFs]
    #[arg(long, value_name = "ID[=KEY]")]
    pub node: Vec<String>,

    /// Key of the device of nodes that name none [default: the only one]
    #[arg(long, value_name = "KEY")]
    pub device: Option<String>,

    /// Where SPEC is a plant file: the machine, by name or number, whose nodes they are, as the plant sets them [default: the only one]
    #[arg(long, value_name = "NAME", conflicts_with_all = ["node", "device"])]
    pub machine: Option<String>,

    /// The site of the machine [default: that of the only machine with this name]
    #[arg(long, value_name = "NAME", conflicts_with_all = ["node", "device"])]
    pub site: Option<String>,
}

impl NodesArgs {
    /// Whether no node is meant, and no file.
    pub(crate) const fn names_nothing(&self) -> bool {
        let Self { specs, node, device, machine, site } = self;
        specs.is_empty() && node.is_empty() && device.is_none() && machine.is_none() && site.is_none()
    }
}

/// Where a device reports its serial number.
const SERIAL_NUMBER: EntryId = EntryId { index: Index(0x1018), sub: SubIndex(4) };

/// Nodes, and what their devices belong to.
pub(crate) struct BusNodes {
    systems: Vec<Described>,
    nodes: Vec<BusNode>,
}

/// What a file describes, with its text.
struct Described {
    system: Arc<System>,
    sources: Arc<SourceMap>,
}

struct BusNode {
    id: u8,
    /// Position of its system.
    system: usize,
    /// Its device; of a DCF with the values of the node as defaults.
    device: Dictionary,
}

impl BusNodes {
    /// The nodes, each with its node-ID, its system and its device.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (u8, &System, &Dictionary)> {
        self.with_sources().map(|(id, system, device, _)| (id, system, device))
    }

    /// The same, each with the texts of its file, which messages about its device show.
    pub(crate) fn with_sources(&self) -> impl Iterator<Item = (u8, &System, &Dictionary, &SourceMap)> {
        self.nodes.iter().filter_map(|node| {
            let Described { system, sources } = self.systems.get(node.system)?;
            Some((node.id, &**system, &node.device, &**sources))
        })
    }

    /// Reads the specifications of a command line and finds its nodes in them; the exit code after a message when it cannot.
    pub(crate) fn read(args: &NodesArgs, directory: &Path, report: &Report) -> Result<Self, u8> {
        if args.machine.is_some()
            || args.site.is_some()
            || args.specs.iter().any(|path| plant_file::names_plant(path))
        {
            return Self::of_machine(args, report);
        }
        let paths = if args.specs.is_empty() {
            vec![specs::one(None, directory, report)?]
        } else {
            specs::all(&args.specs, directory, report)?
        };
        let (mut systems, mut files) = (Vec::new(), Vec::new());
        for path in &paths {
            let (used, sources) = report.compile_with_sources(path).ok_or(ERRORS)?;
            let sources = Arc::new(sources);
            systems.push(Described { system: Arc::new(used.system), sources: Arc::clone(&sources) });
            files.push(used.node.map(|node| (node, sources)));
        }
        let of_file = |system: usize| files.get(system).and_then(Option::as_ref);
        let as_node = |system: usize, device: &Dictionary, id: u8| match of_file(system) {
            Some((node, sources)) => report.moved(node, Some(id), sources).configured(device),
            None => device.clone(),
        };
        let mut found = Self { systems, nodes: Vec::new() };
        let mut named: Vec<(u8, Option<&str>)> = Vec::new();
        for text in &args.node {
            let (id, key) = match text.split_once('=') {
                Some((id, key)) => (id, Some(key.trim())),
                None => (text.as_str(), args.device.as_deref()),
            };
            named.push((node_id(id).map_err(|diagnostic| report.refuse(diagnostic))?, key));
        }
        for (id, key) in named {
            let (system, device) = found.device(key, report)?;
            let device = as_node(system, device, id);
            found.push(BusNode { id, system, device }, report)?;
        }
        if args.node.is_empty() {
            for (system, file) in files.iter().enumerate() {
                let Some(id) = file.as_ref().and_then(|(node, _)| node.stated_id()) else { continue };
                let described = found.systems.get(system);
                let Some(device) = described.and_then(|one| one.system.devices.first()) else { continue };
                let device = as_node(system, device, id);
                found.push(BusNode { id, system, device }, report)?;
            }
        }
        if found.nodes.is_empty() {
            let message = "no node is named, and no DCF states one";
            return Err(report.refuse(Diagnostic::without_place(codes::BAD_NODE_ID, message).help(
                "add `--node ID=KEY` for each node: its node-ID, 1 to 127, and the key of its device",
            )));
        }
        found.send_apart(|node| of_file(node.system).is_some(), report)?;
        Ok(found)
    }

    /// Refuses two nodes that send with one COB-ID, as far as a DCF says what one of them is set to.
    fn send_apart(&self, is_set: impl Fn(&BusNode) -> bool, report: &Report) -> Result<(), u8> {
        for (at, second) in self.nodes.iter().enumerate() {
            for first in self.nodes.iter().take(at).filter(|first| is_set(first) || is_set(second)) {
                if let Some(shared) = shared_cob_id((first.id, &first.device), (second.id, &second.device)) {
                    return Err(report.refuse(shared));
                }
            }
        }
        Ok(())
    }

    /// The nodes of a machine of a plant, as it sets them.
    fn of_machine(args: &NodesArgs, report: &Report) -> Result<Self, u8> {
        let refuse = |message: &str, help: &str| {
            report.refuse(Diagnostic::without_place(codes::BAD_NOTATION, message).help(help.to_owned()))
        };
        let [path] = args.specs.as_slice() else {
            return Err(refuse(
                "the nodes of a machine are those of one plant file",
                "name the plant file, and no other: `odgen serve plant.yaml --machine 17`",
            ));
        };
        if !args.node.is_empty() || args.device.is_some() {
            return Err(refuse(
                "a plant file says itself which nodes there are",
                "choose a machine with `--machine`, in place of `--node` and `--device`",
            ));
        }
        if path.is_file() && !plant_file::names_plant(path) {
            let help = "name a plant file, or the nodes of a specification with `--node ID=KEY`";
            return Err(report.refuse(plant_file::no_plant(path, help)));
        }
        let plant_file::Read { plant, settled, sources, .. } = plant_file::read(path, report)?;
        let sources = Arc::new(sources);
        let machine = plant_file::machine(&plant, args.site.as_deref(), args.machine.as_deref())
            .map_err(|diagnostic| report.refuse(*diagnostic))?;
        let mut found = Self { systems: Vec::new(), nodes: Vec::new() };
        for node in plant.nodes.get(machine.nodes.clone()).unwrap_or_default() {
            let (Some(device), Some(settled)) = (plant.devices.get(node.device), settled.get(node.class))
            else {
                continue;
            };
            let system = found.systems.len();
            let system_and_text =
                Described { system: Arc::clone(&device.system), sources: Arc::clone(&sources) };
            found.systems.push(system_and_text);
            let mut commissioning = plant.commissioning(node, settled);
            if let Some(serial) = commissioning.serial_number {
                commissioning.values.insert(SERIAL_NUMBER, Value::Integer(serial.into()));
            }
            let device = commissioning.configured(&device.dictionary);
            found.push(BusNode { id: node.node.value, system, device }, report)?;
        }
        Ok(found)
    }

    /// The device with a key in any of the specifications, or the only one; with the position of its system.
    fn device(&self, key: Option<&str>, report: &Report) -> Result<(usize, &Dictionary), u8> {
        let all = || {
            let systems = self.systems.iter().enumerate();
            systems.flat_map(|(at, one)| one.system.devices.iter().map(move |device| (at, device)))
        };
        if let Some(key) = key {
            let found = all().find(|(_, device)| device.key == key);
            return found
                .ok_or_else(|| report.unknown_device(self.systems.iter().map(|one| &*one.system), key));
        }
        let mut devices = all();
        if let (Some(only), None) = (devices.next(), devices.next()) {
            return Ok(only);
        }
        let keys: Vec<String> = all().map(|(_, device)| format!("`{}`", device.key)).collect();
        let message = format!("a node names no device, and the specifications have {}", keys.len());
        let help = match keys.as_slice() {
            [] => "name a specification that describes devices, not a library".to_owned(),
            keys => format!("write `--node ID=KEY`, or add `--device KEY`: {}", keys.join(", ")),
        };
        Err(report.refuse(Diagnostic::without_place(codes::UNKNOWN_DEVICE, message).help(help)))
    }

    fn push(&mut self, node: BusNode, report: &Report) -> Result<(), u8> {
        if self.nodes.iter().any(|other| other.id == node.id) {
            let message = format!("two nodes have the node-ID {}", node.id);
            return Err(report.refuse(
                Diagnostic::without_place(codes::BAD_NODE_ID, message)
                    .help(format!("give `{}` a node-ID of its own", visible(&node.device.key))),
            ));
        }
        self.nodes.push(node);
        Ok(())
    }
}

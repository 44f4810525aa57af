//! The nodes of a machine of a plant, and `odgen node backup`, `compare` and `restore` of all of them.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use od_bus::client::{Bus, Client};
use od_gen::Artifact;
use od_gen::files::Existing;
use od_plant::stem;
use od_spec::diag::{Diagnostic, codes};
use od_spec::model::{Dictionary, System};
use od_spec::source::SourceMap;

use super::args::{NodeBackupArgs, NodeFileArgs, NodeRestoreArgs, OneNodeArgs, SkipArgs};
use super::beside::{Beside, beside, compared};
use super::outcome::{Outcome, State, worse};
use super::restore::restored;
use super::taken::{kept_line, parameters_of};
use super::{Target, connect, is_meant};
use crate::exit::{DIFFERS, INTERRUPTED, SUCCESS};
use crate::interrupt::Interrupt;
use crate::output::{forced, keep};
use crate::plant_file;
use crate::report::{Report, node_id, print, shown};

/// A machine, and the texts that its plant was read from.
pub(super) struct Machine {
    /// Site and name.
    name: String,
    nodes: Vec<Node>,
    sources: SourceMap,
}

/// A node of a machine.
struct Node {
    id: u8,
    position: String,
    /// The key of its device in the plant.
    key: String,
    /// The name of its files, without their ending.
    stem: String,
    serial: Option<u32>,
    system: Arc<System>,
    device: Arc<Dictionary>,
}

impl Node {
    fn target(&self) -> Target<'_> {
        Target {
            id: self.id,
            position: Some(&self.position),
            serial: self.serial,
            system: &self.system,
            device: &self.device,
        }
    }

    fn file(&self) -> String {
        format!("{}.yaml", self.stem)
    }
}

impl Machine {
    /// The machine that a command line names.
    pub(super) fn read(spec: &Path, args: &OneNodeArgs, report: &Report) -> Result<Self, u8> {
        let plant_file::Read { plant, sources, .. } = plant_file::read(spec, report)?;
        let machine = plant_file::machine(&plant, args.site.as_deref(), args.machine.as_deref())
            .map_err(|diagnostic| report.refuse(*diagnostic))?;
        let mut nodes = Vec::new();
        for node in plant.nodes.get(machine.nodes.clone()).unwrap_or_default() {
            let Some(device) = plant.devices.get(node.device) else { continue };
            nodes.push(Node {
                id: node.node.value,
                position: node.position.clone(),
                key: device.key.clone(),
                stem: stem(&plant, node),
                serial: node.serial.map(|serial| serial.value),
                system: Arc::clone(&device.system),
                device: Arc::clone(&device.dictionary),
            });
        }
        Ok(Self { name: format!("{} {}", plant.site_of(machine), machine.name), nodes, sources })
    }

    pub(super) const fn sources(&self) -> &SourceMap {
        &self.sources
    }

    /// The node with a node-ID, or the only one with a device.
    pub(super) fn target(
        &self,
        id: Option<u8>,
        key: Option<&str>,
        report: &Report,
    ) -> Result<Target<'_>, u8> {
        let mut found = self.fitting(id, key);
        match (found.next(), found.next()) {
            (Some(only), None) => Ok(only.target()),
            _ => Err(report.refuse(self.no_node(id, key))),
        }
    }

    /// Writes a parameter file of each node; none where one of them does not answer.
    pub(super) fn backup(&self, args: &NodeBackupArgs, report: &Report) -> Result<u8, u8> {
        let nodes = self.chosen(&args.node, &args.skip, report)?;
        let mut client = connect(&args.node.link, report)?;
        let (mut set, mut lines, mut code) = (Vec::new(), String::new(), SUCCESS);
        let interrupt = Interrupt::noted();
        for node in nodes {
            let target = node.target();
            let written = is_meant(&mut client, &args.node, target, report)
                .and_then(|()| parameters_of(&mut client, args, target, &self.sources, &interrupt, report));
            match written {
                Ok(written) => {
                    lines.push_str(&kept_line(&args.out.join(node.file()), written.count, target));
                    let bytes = written.text.into_bytes();
                    set.push(Artifact { path: node.file(), bytes, purpose: String::new() });
                }
                Err(failed) => code = worse(code, failed),
            }
            if interrupt.is_wanted() && code != SUCCESS {
                report.note("no file was written");
                return Err(code);
            }
        }
        for target in self.chosen(&args.node, &args.skip, report)?.into_iter().map(Node::target) {
            if let Err(failed) = target.has_started(&mut client, report) {
                code = worse(code, failed);
            }
        }
        if code != SUCCESS {
            report.note(
                "no file was written, because not every node reports what it has; `--skip ID` leaves a node out",
            );
            return Err(code);
        }
        keep(&args.out, &set, forced(args.force, Existing::None))
            .map_err(|diagnostic| report.refuse(diagnostic))?;
        Ok(print(&lines))
    }

    /// Compares each node with its file of a directory.
    pub(super) fn compare(&self, args: &NodeFileArgs, report: &Report) -> Result<u8, u8> {
        let all = self.files(args, report)?;
        let mut client = connect(&args.node.link, report)?;
        let (interrupt, mut outcomes) = (Interrupt::noted(), Vec::new());
        for beside in &all {
            if interrupt.is_wanted() {
                outcomes.push(Outcome::untouched(beside.target, INTERRUPTED, State::NotDone));
                continue;
            }
            let code = is_meant(&mut client, &args.node, beside.target, report)
                .and_then(|()| compared(&mut client, beside, &interrupt, report))
                .unwrap_or_else(|code| code);
            outcomes.push(Outcome::after(beside.target, code, 0));
        }
        Ok(self.reported(&mut client, "compared", outcomes, report))
    }

    /// Gives each node the values of its file of a directory.
    pub(super) fn restore(&self, args: &NodeRestoreArgs, report: &Report) -> Result<u8, u8> {
        let all = self.files(&args.file, report)?;
        let mut client = connect(&args.file.node.link, report)?;
        let outcomes = restored(&mut client, args, &all, report)?;
        Ok(self.reported(&mut client, "restored", outcomes, report))
    }

    /// Reads the file of each node from a directory, and checks all of them.
    fn files(&self, args: &NodeFileArgs, report: &Report) -> Result<Vec<Beside<'_>>, u8> {
        let (mut all, mut code) = (Vec::new(), SUCCESS);
        for node in self.chosen(&args.node, &args.skip, report)? {
            let path = args.file.join(node.file());
            match beside(&self.sources, path, |_| Ok(node.target()), report) {
                Ok(beside) => all.push(beside),
                Err(failed) => code = worse(code, failed),
            }
        }
        for stranger in self.strangers(&args.file) {
            report.note(&format!("{} is of no node of {}", shown(&stranger), self.name));
        }
        if code != SUCCESS {
            report.note("no node was asked, as not every file is right");
            return Err(code);
        }
        Ok(all)
    }

    /// Reports what became of the nodes; the exit code.
    fn reported<B: Bus>(
        &self,
        client: &mut Client<B>,
        done: &str,
        mut outcomes: Vec<Outcome<'_>>,
        report: &Report,
    ) -> u8 {
        for outcome in &mut outcomes {
            outcome.heed_start(client, report);
        }
        let code = outcomes.iter().fold(SUCCESS, |code, outcome| worse(code, outcome.code));
        let count = |state| outcomes.iter().filter(|outcome| outcome.state == state).count();
        let (differing, well) = (count(State::Differs), count(State::Done) + count(State::Differs));
        let started = outcomes.iter().filter(|outcome| outcome.state == State::Started);
        let started: Vec<String> = started.map(|outcome| outcome.target.name()).collect();
        let again = if started.is_empty() {
            String::new()
        } else {
            format!("; started again in the middle: {}", started.join(", "))
        };
        let differ = match differing {
            0 => String::new(),
            1 => ", 1 differs".to_owned(),
            count => format!(", {count} differ"),
        };
        let mut text = format!("{}: {well} of {} nodes {done}{differ}{again}\n", self.name, outcomes.len());
        if !matches!(code, SUCCESS | DIFFERS) {
            text.extend(outcomes.iter().map(|outcome| outcome.line(done)));
        }
        worse(code, print(&text))
    }

    /// All nodes, or those that the command line names, without those that it leaves out.
    fn chosen(&self, args: &OneNodeArgs, skip: &SkipArgs, report: &Report) -> Result<Vec<&Node>, u8> {
        let id = args.node.as_deref().map(node_id).transpose().map_err(|one| report.refuse(one))?;
        let key = args.device.as_deref();
        let skipped = skip.ids(report)?;
        let unknown = skipped.iter().find(|id| self.fitting(Some(**id), None).next().is_none());
        if let Some(unknown) = unknown {
            let message = format!("{} has no node {unknown}", self.name);
            let help = format!("write `--skip ID`: {}", self.listed());
            return Err(report.refuse(Diagnostic::without_place(codes::BAD_NODE_ID, message).help(help)));
        }
        let found: Vec<&Node> = self.fitting(id, key).collect();
        if found.is_empty() {
            return Err(report.refuse(self.no_node(id, key)));
        }
        let left: Vec<&Node> = found.into_iter().filter(|node| !skipped.contains(&node.id)).collect();
        if left.is_empty() { Err(report.refuse(none_left())) } else { Ok(left) }
    }

    fn fitting(&self, id: Option<u8>, key: Option<&str>) -> impl Iterator<Item = &Node> {
        let fits =
            move |node: &&Node| id.is_none_or(|id| node.id == id) && key.is_none_or(|key| node.key == key);
        self.nodes.iter().filter(fits)
    }

    /// What is said where not one node fits.
    fn no_node(&self, id: Option<u8>, key: Option<&str>) -> Diagnostic {
        let message = match (id, key) {
            (Some(id), Some(key)) => format!("{} has no `{key}` that is node {id}", self.name),
            (Some(id), None) => format!("{} has no node {id}", self.name),
            (None, Some(key)) => {
                format!(
                    "no node-ID is given, and {} has {} `{key}`",
                    self.name,
                    self.fitting(None, Some(key)).count()
                )
            }
            (None, None) => format!("no node-ID is given, and {} has {} nodes", self.name, self.nodes.len()),
        };
        let help = format!("write `--node ID`: {}", self.listed());
        Diagnostic::without_place(codes::BAD_NODE_ID, message).help(help)
    }

    /// `5 (bath heater), 6 (hall warm)`.
    fn listed(&self) -> String {
        let nodes = self.nodes.iter().map(|node| format!("{} ({} {})", node.id, node.position, node.key));
        nodes.collect::<Vec<_>>().join(", ")
    }

    /// Files of a directory that look like parameter files and belong to no node.
    fn strangers(&self, directory: &Path) -> BTreeSet<PathBuf> {
        let own: BTreeSet<String> = self.nodes.iter().map(Node::file).collect();
        let entries = std::fs::read_dir(directory).into_iter().flatten().flatten();
        let paths = entries.map(|entry| entry.path());
        let is_stranger = |path: &PathBuf| {
            let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
            path.extension().is_some_and(|ending| ending == "yaml") && !own.contains(name)
        };
        paths.filter(is_stranger).collect()
    }
}

/// What is said where `--skip` leaves out all nodes.
fn none_left() -> Diagnostic {
    Diagnostic::without_place(codes::BAD_NODE_ID, "`--skip` leaves out all nodes")
        .help("leave out only the nodes that something is wrong with")
}

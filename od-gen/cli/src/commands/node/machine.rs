//! The nodes of a machine of a plant, and `odgen node backup`, `compare` and `restore` of all of them.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use od_gen::Artifact;
use od_gen::files::Existing;
use od_plant::stem;
use od_spec::diag::{Diagnostic, codes};
use od_spec::model::{Dictionary, System};
use od_spec::source::SourceMap;

use super::args::{NodeBackupArgs, NodeFileArgs, OneNodeArgs};
use super::keep::{WithFile, beside, kept_line, parameters_of};
use super::{Target, connect, has_started, is_meant};
use crate::exit::{DIFFERS, INTERRUPTED, SUCCESS, USAGE};
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
    pub(super) fn read(args: &OneNodeArgs, report: &Report) -> Result<Self, u8> {
        let plant_file::Read { plant, sources, .. } = plant_file::read(&args.spec, report)?;
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
        let nodes = self.chosen(&args.node, report)?;
        let mut client = connect(&args.node.link, report)?;
        let (mut set, mut lines, mut code) = (Vec::new(), String::new(), SUCCESS);
        for node in nodes {
            let target = node.target();
            let written = is_meant(&mut client, &args.node, target, report)
                .and_then(|()| parameters_of(&mut client, args, target, &self.sources, report));
            match written {
                Ok(written) => {
                    lines.push_str(&kept_line(&args.out.join(node.file()), written.count, target));
                    let bytes = written.text.into_bytes();
                    set.push(Artifact { path: node.file(), bytes, purpose: String::new() });
                }
                Err(failed) => code = worse(code, failed),
            }
        }
        for target in self.chosen(&args.node, report)?.into_iter().map(Node::target) {
            if let Err(failed) = has_started(&mut client, target, report) {
                code = worse(code, failed);
            }
        }
        if code != SUCCESS {
            report.note(
                "no file was written, as not every node tells what it has; `--node ID` backs up a single one",
            );
            return Err(code);
        }
        keep(&args.out, &set, forced(args.force, Existing::None))
            .map_err(|diagnostic| report.refuse(diagnostic))?;
        Ok(print(&lines))
    }

    /// Takes the file of each node from a directory, checks all of them, and does something with each node.
    pub(super) fn with_files(
        &self,
        args: &NodeFileArgs,
        work: WithFile<'_>,
        report: &Report,
    ) -> Result<u8, u8> {
        let (mut all, mut code) = (Vec::new(), SUCCESS);
        for node in self.chosen(&args.node, report)? {
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
        let mut client = connect(&args.node.link, report)?;
        let mut outcomes = Vec::new();
        for beside in &all {
            if work.is_interrupted() {
                outcomes.push((beside.target, INTERRUPTED, "not asked any more".to_owned()));
                continue;
            }
            let writes = client.writes();
            let one = is_meant(&mut client, &args.node, beside.target, report)
                .and_then(|()| work.with(&mut client, beside, report))
                .unwrap_or_else(|code| code);
            // There is nobody to ask, for any of them.
            if one == USAGE {
                return Err(USAGE);
            }
            let state = state(one, work.done(), client.writes() - writes);
            outcomes.push((beside.target, one, state));
        }
        // One that was done with first may have started again while others were.
        let (mut well, mut differing, mut started, mut states) = (0, 0, Vec::new(), String::new());
        for (target, one, state) in outcomes {
            let (one, state) = match has_started(&mut client, target, report) {
                Ok(()) => (one, state),
                Err(failed) => {
                    started.push(target.name());
                    (worse(one, failed), "started again in the middle".to_owned())
                }
            };
            well += usize::from(one == SUCCESS);
            differing += usize::from(one == DIFFERS);
            code = worse(code, one);
            let _ = writeln!(states, "  {}  {state}", target.name());
        }
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
        let (name, done) = (&self.name, work.done());
        let line = format!("{name}: {} of {} nodes {done}{differ}{again}\n", well + differing, all.len());
        let is_well = matches!(code, SUCCESS | DIFFERS);
        Ok(worse(code, print(&if is_well { line } else { line + &states })))
    }

    /// All nodes, or those that the command line names.
    fn chosen(&self, args: &OneNodeArgs, report: &Report) -> Result<Vec<&Node>, u8> {
        let id = args.node.as_deref().map(node_id).transpose().map_err(|one| report.refuse(one))?;
        let key = args.device.as_deref();
        let found: Vec<&Node> = self.fitting(id, key).collect();
        if found.is_empty() { Err(report.refuse(self.no_node(id, key))) } else { Ok(found) }
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
        let nodes = self.nodes.iter().map(|node| format!("{} ({} {})", node.id, node.position, node.key));
        let help = format!("write `--node ID`: {}", nodes.collect::<Vec<_>>().join(", "));
        Diagnostic::without_place(codes::BAD_NODE_ID, message).help(help)
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

/// In which state a node is that something was done with.
fn state(code: u8, done: &str, writes: usize) -> String {
    match (code, writes) {
        (SUCCESS, _) => done.to_owned(),
        (DIFFERS, _) => "differs".to_owned(),
        (_, 0) => format!("not {done}, left as it was"),
        (_, 1) => format!("not {done}, 1 value was sent"),
        (_, _) => format!("not {done}, {writes} values were sent"),
    }
}

/// The exit code for two things: an error outweighs a difference.
fn worse(one: u8, other: u8) -> u8 {
    match (one, other) {
        (SUCCESS | DIFFERS, SUCCESS | DIFFERS) => one.max(other),
        (SUCCESS | DIFFERS, failed) | (failed, _) => failed,
    }
}

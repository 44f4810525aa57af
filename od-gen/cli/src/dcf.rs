//! `odgen dcf`.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use od_formats::boot::explain;
use od_formats::concise;
use od_formats::eds::write_dcf;
use od_formats::xdd::write_xdc;
use od_gen::Artifact;
use od_gen::condense;
use od_gen::files::Existing;
use od_gen::source::FileLoader;
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::model::{Dictionary, System};
use od_spec::source::SourceMap;
use od_spec::{Commissioning, TextOfNode, assign_layers, bit_rate, rule_codes};

use super::ERRORS;
use super::args::DcfArgs;
use super::output::{forced, save};
use super::report::{Report, node_id, print, shown};
use super::settings::{layer, parameter_files};
use super::specs;

pub(crate) fn run(args: &DcfArgs, directory: &Path, report: &Report) -> u8 {
    match dcf(args, directory, report) {
        Ok(text) => print(&text),
        Err(code) => code,
    }
}

fn dcf(args: &DcfArgs, directory: &Path, report: &Report) -> Result<String, u8> {
    let refuse = |diagnostic| report.refuse(diagnostic);
    let node = args.node.as_deref().map(node_id).transpose().map_err(refuse)?;
    let spec = specs::one(args.spec.as_deref(), directory, report)?;
    let mut sources = SourceMap::new();
    let mut loader = FileLoader::default();
    let mut compiled = od_gen::source::compile_file(&spec, &mut sources, &mut loader);
    if let Some(line) = condense(&spec, &mut compiled) {
        report.note(&line);
    }
    report.show(&compiled.diagnostics, &sources);
    let system = compiled.system.ok_or(ERRORS)?;
    let mut diagnostics = Diagnostics::new();
    let files = parameter_files(&args.params, &mut sources, &mut diagnostics).map_err(|one| refuse(*one))?;
    let show = |mut diagnostics: Diagnostics, sources: &SourceMap| {
        diagnostics.sort();
        report.show(&diagnostics, sources);
        if diagnostics.has_errors() { Err(ERRORS) } else { Ok(()) }
    };
    if diagnostics.has_errors() {
        return Err(show(diagnostics, &sources).err().unwrap_or(ERRORS));
    }
    let device = files.device(&system, args.device.as_deref(), report)?;
    files.check_device(&system, device, &mut diagnostics);
    let node = files.node(node, report).or(compiled.stated_node_id);
    let mut commissioning = commissioning(device, node, compiled.node).map_err(refuse)?;
    files.settle(device, &mut commissioning, &mut diagnostics);
    said_in_options(args, device, &mut commissioning).map_err(refuse)?;
    let node = commissioning.node;
    let path = args.out.clone().unwrap_or_else(|| PathBuf::from(format!("{}-{node}.dcf", device.key)));
    let read: Vec<PathBuf> = loader.read.iter().chain(&args.set_file).chain(&args.params).cloned().collect();
    let name = file_name(&path, "the DCF", &read).map_err(refuse)?;
    let mut layers = files.into_layers();
    layers.push(layer(args, &mut sources, &mut diagnostics).map_err(|diagnostic| refuse(*diagnostic))?);
    let assigned = assign_layers(&system, &commissioning.configured(device), node, &layers, &mut diagnostics);
    show(diagnostics, &sources)?;
    let count = assigned.values.len();
    commissioning.values.extend(assigned.values);
    commissioning.unlocked.extend(assigned.unlocked);
    let kept = commissioning.values.len() - count;
    let as_default = if args.since_default { commissioning.keep_differences(device) } else { 0 };
    if args.explain {
        return explain(&system, device, &commissioning).map_err(|error| {
            refuse(Diagnostic::without_place(codes::BAD_VALUE, error.to_string()).help("leave the entry out"))
        });
    }
    let bytes = write_dcf(&system, device, &commissioning, &name);
    let directory = path.parent().unwrap_or(Path::new(""));
    let size = bytes.len().div_ceil(1024);
    let mut set = vec![Artifact { path: name, bytes, purpose: String::new() }];
    let mut further = String::new();
    if args.concise {
        let (artifact, line) = concise(&system, device, &commissioning, &path, &read).map_err(refuse)?;
        set.push(artifact);
        further = line;
    }
    if args.xdc {
        let path = path.with_extension("xdc");
        let name = file_name(&path, "the DCF", &read).map_err(refuse)?;
        let bytes = write_xdc(&system, device, &commissioning, &name);
        let _ = writeln!(further, "  {}  {} kB", shown(&path), bytes.len().div_ceil(1024));
        set.push(Artifact { path: name, bytes, purpose: String::new() });
    }
    save(directory, &set, forced(args.force, Existing::Generated)).map_err(refuse)?;
    let mut line = count_of(count, "set");
    for (number, what) in [(kept, "kept"), (as_default, "as the default left out")] {
        if number > 0 {
            let _ = write!(line, ", {number} {what}");
        }
    }
    let mut said = format!("  {}  {size} kB  {} node {node}, {line}\n", shown(&path), device.key);
    for id in &commissioning.unlocked {
        let name = device.entry_name(*id).unwrap_or_default();
        let _ = writeln!(
            said,
            "  LOCKED  {id} {name}: the device takes it only while it is unlocked for service"
        );
    }
    said.push_str(&further);
    Ok(said)
}

/// `1 value set`, `2 values set`.
fn count_of(count: usize, what: &str) -> String {
    format!("{count} value{} {what}", if count == 1 { "" } else { "s" })
}

/// The concise DCF beside the DCF, and the line that tells of it.
fn concise(
    system: &System,
    device: &Dictionary,
    node: &Commissioning,
    dcf: &Path,
    read: &[PathBuf],
) -> Result<(Artifact, String), Diagnostic> {
    let path = dcf.with_extension("bin");
    let name = file_name(&path, "the DCF", read)?;
    let writes = node.download(system, device).map_err(|no_value| {
        let message = format!("the concise DCF cannot be made: {no_value}");
        Diagnostic::without_place(rule_codes::VALUE_DOES_NOT_FIT, message).help("correct the value")
    })?;
    let bytes = concise::write(&writes);
    let plural = if writes.len() == 1 { "" } else { "s" };
    let mut line = format!("  {}  {} bytes  {} record{plural}\n", shown(&path), bytes.len(), writes.len());
    let domains = node.files.values().filter(|files| files.download.is_some()).count();
    if domains > 0 {
        let _ = writeln!(
            line,
            "  not in it: the files of {domains} DOMAINs (`DownloadFile`), which the master writes by itself"
        );
    }
    Ok((Artifact { path: name, bytes, purpose: String::new() }, line))
}

/// A node of the device, or that of the DCF it is made from, without the settings. The node-ID is the one that the command line,
/// a parameter file or the DCF states.
fn commissioning(
    device: &Dictionary,
    node: Option<u8>,
    configured: Option<Commissioning>,
) -> Result<Commissioning, Diagnostic> {
    match (node, configured) {
        (Some(node), None) => Ok(Commissioning::of_node(device, node)),
        (Some(node), Some(mut configured)) => {
            configured.node = node;
            Ok(configured)
        }
        (None, configured) => {
            let message = match configured {
                Some(_) => "no node-ID is given, and the DCF states none",
                None => "no node-ID is given",
            };
            Err(Diagnostic::without_place(codes::BAD_NODE_ID, message).help("add `--node ID`, 1 to 127"))
        }
    }
}

/// Takes what the options say about the node but its node-ID and its values.
fn said_in_options(
    args: &DcfArgs,
    device: &Dictionary,
    commissioning: &mut Commissioning,
) -> Result<(), Diagnostic> {
    if let Some(text) = &args.bit_rate {
        commissioning.bit_rate = bit_rate(device, text)?;
    }
    if let Some(name) = &args.node_name {
        commissioning.node_name = TextOfNode::Node.read("--node-name", name)?;
    }
    if let Some(number) = args.net_number {
        commissioning.net_number = number;
    }
    if let Some(name) = &args.net_name {
        commissioning.net_name = TextOfNode::Network.read("--net-name", name)?;
    }
    Ok(())
}

/// The name of the file to write, which is none of those that were read.
pub(super) fn file_name(path: &Path, what: &str, read: &[PathBuf]) -> Result<String, Diagnostic> {
    let refuse = |problem: &str, help: &str| {
        let message = format!("cannot write `{}`: {problem}", path.display());
        Err(Diagnostic::without_place(codes::WRITE_FAILED, message).help(help.to_owned()))
    };
    let Some(name) = path.file_name() else {
        return refuse("it names no file", "write the file's name behind the directory");
    };
    let Some(name) = name.to_str() else {
        return refuse("its name is not Unicode", "choose another name");
    };
    let same = |file: &PathBuf| match (fs::canonicalize(path), fs::canonicalize(file)) {
        (Ok(target), Ok(file)) => target == file,
        _ => false,
    };
    if read.iter().any(same) {
        return refuse(&format!("{what} is made from this file"), "write it to another file");
    }
    Ok(name.to_owned())
}

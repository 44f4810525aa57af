//! `odgen dcf`.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use od_gen::Artifact;
use od_gen::concise;
use od_gen::condense;
use od_gen::eds::write_dcf;
use od_gen::files::Existing;
use od_gen::source::FileLoader;
use od_gen::xdd::write_xdc;
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::model::{Dictionary, System};
use od_spec::source::SourceMap;
use od_spec::{Commissioning, assign, eds_text_problem, rule_codes};

use super::ERRORS;
use super::args::DcfArgs;
use super::output::{forced, save};
use super::report::{Report, node_id, print, shown};
use super::settings::settings;
use super::specs;

/// Longest `NodeName` and `NetworkName`: a line has 255 characters.
const LONGEST_NODE_NAME: usize = 246;
const LONGEST_NET_NAME: usize = 243;

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
    let device = report.device_or_only(&system, args.device.as_deref())?;
    let mut commissioning =
        commissioning(args, device, node.or(compiled.stated_node_id), compiled.node).map_err(refuse)?;
    let node = commissioning.node;
    let path = args.out.clone().unwrap_or_else(|| PathBuf::from(format!("{}-{node}.dcf", device.key)));
    let read: Vec<PathBuf> = loader.read.iter().chain(&args.set_file).cloned().collect();
    let name = file_name(&path, &read).map_err(refuse)?;
    let settings = settings(args, &mut sources).map_err(|diagnostic| refuse(*diagnostic))?;
    let mut diagnostics = Diagnostics::new();
    let settings = assign(&system, &commissioning.configured(device), node, &settings, &mut diagnostics);
    diagnostics.sort();
    report.show(&diagnostics, &sources);
    if diagnostics.has_errors() {
        return Err(ERRORS);
    }
    let count = settings.len();
    commissioning.values.extend(settings);
    let kept = match commissioning.values.len() - count {
        0 => String::new(),
        kept => format!(", {kept} kept"),
    };
    let bytes = write_dcf(&system, device, &commissioning, &name);
    let directory = path.parent().unwrap_or(Path::new(""));
    let mut set = vec![Artifact { path: name, bytes, purpose: String::new() }];
    let mut further = String::new();
    if args.concise {
        let (artifact, line) = concise(&system, device, &commissioning, &path, &read).map_err(refuse)?;
        set.push(artifact);
        further = line;
    }
    if args.xdc {
        let path = path.with_extension("xdc");
        let name = file_name(&path, &read).map_err(refuse)?;
        let bytes = write_xdc(&system, device, &commissioning, &name);
        let _ = writeln!(further, "  {}  {} kB", shown(&path), bytes.len().div_ceil(1024));
        set.push(Artifact { path: name, bytes, purpose: String::new() });
    }
    save(directory, &set, forced(args.force, Existing::Generated)).map_err(refuse)?;
    let plural = if count == 1 { "" } else { "s" };
    let size = set.first().map_or(0, |dcf| dcf.bytes.len().div_ceil(1024));
    Ok(format!(
        "  {}  {size} kB  {} node {node}, {count} value{plural} set{kept}\n{further}",
        shown(&path),
        device.key
    ))
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
    let name = file_name(&path, read)?;
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

/// What the command line says about the node, and else the DCF that it is made from, without the settings. The node-ID is the
/// one that the command line or the DCF states.
fn commissioning(
    args: &DcfArgs,
    device: &Dictionary,
    node: Option<u8>,
    configured: Option<Commissioning>,
) -> Result<Commissioning, Diagnostic> {
    let mut commissioning = match (node, configured) {
        (Some(node), None) => Commissioning::of_node(device, node),
        (Some(node), Some(mut configured)) => {
            configured.node = node;
            configured
        }
        (None, configured) => {
            let message = match configured {
                Some(_) => "no node-ID is given, and the DCF states none",
                None => "no node-ID is given",
            };
            return Err(
                Diagnostic::without_place(codes::BAD_NODE_ID, message).help("add `--node ID`, 1 to 127")
            );
        }
    };
    if let Some(text) = &args.bit_rate {
        commissioning.bit_rate = bit_rate(device, text)?;
    }
    if let Some(name) = &args.node_name {
        commissioning.node_name = text("--node-name", name, LONGEST_NODE_NAME)?;
    }
    if let Some(number) = args.net_number {
        commissioning.net_number = number;
    }
    if let Some(name) = &args.net_name {
        commissioning.net_name = text("--net-name", name, LONGEST_NET_NAME)?;
    }
    Ok(commissioning)
}

/// A text of `[DeviceComissioning]`.
fn text(option: &str, text: &str, longest: usize) -> Result<String, Diagnostic> {
    let text = text.trim();
    match eds_text_problem(text, longest) {
        None => Ok(text.to_owned()),
        Some(problem) => Err(Diagnostic::without_place(
            rule_codes::NOT_FOR_EDS,
            format!("the text of `{option}` {problem}"),
        )
        .help("choose another text")),
    }
}

/// The name of the file to write, which is none of those that were read.
fn file_name(path: &Path, read: &[PathBuf]) -> Result<String, Diagnostic> {
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
        return refuse("the DCF is made from this file", "write the DCF to another file");
    }
    Ok(name.to_owned())
}

fn bit_rate(device: &Dictionary, text: &str) -> Result<u16, Diagnostic> {
    let rates = device.info.bit_rates.iter().map(u16::to_string).collect::<Vec<_>>().join(", ");
    let rate = text.trim().parse::<u16>().ok().filter(|rate| device.info.bit_rates.contains(rate));
    rate.ok_or_else(|| {
        Diagnostic::without_place(
            codes::BIT_RATE_UNSUPPORTED,
            format!("`{}` does not support a bit rate of `{text}` kbit/s", device.key),
        )
        .help(format!("it supports {rates} kbit/s"))
    })
}

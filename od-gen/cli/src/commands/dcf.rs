//! `odgen dcf`.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::Args;
use od_formats::boot::explain;
use od_formats::concise;
use od_formats::eds::write_dcf;
use od_formats::xdd::write_xdc;
use od_gen::Artifact;
use od_gen::condense;
use od_gen::files::Existing;
use od_gen::source::open;
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::model::{Dictionary, System};
use od_spec::source::{SourceMap, Spanned};
use od_spec::{Commissioning, Layer, NodeOfFile, TextOfNode, assign_layers, bit_rate, rule_codes};

use crate::exit::ERRORS;
use crate::messages::Messages;
use crate::modules::plugged_in;
use crate::output::{file_name, forced, save};
use crate::report::{Report, node_id, print, shown};
use crate::settings::parameter_files;
use crate::specs;

#[derive(Debug, Args)]
pub(crate) struct DcfArgs {
    /// The specification, EDS, DCF, XDD or XDC [default: the only `*.od.yaml` of the current directory]
    pub spec: Option<PathBuf>,

    /// Key of the device [default: the only one]
    #[arg(long, value_name = "KEY")]
    pub device: Option<String>,

    /// Node-ID, 1 to 127 [default: of a DCF its own]
    #[arg(long, value_name = "ID")]
    pub node: Option<String>,

    /// Bit rate in kbit/s [default: of a DCF its own; 250, or the device's highest]
    #[arg(long, value_name = "KBIT")]
    pub bit_rate: Option<String>,

    /// Name of the node [default: of a DCF its own; product name and node-ID]
    #[arg(long, value_name = "NAME")]
    pub node_name: Option<String>,

    /// Number of the network [default: of a DCF its own; 1]
    #[arg(long, value_name = "N")]
    pub net_number: Option<u32>,

    /// Name of the network [default: of a DCF its own; none]
    #[arg(long, value_name = "NAME")]
    pub net_name: Option<String>,

    /// Modules plugged into a bus coupler, in order, each by number, order code or name: `3,3,7`
    #[arg(long, value_name = "MODULE", value_delimiter = ',')]
    pub modules: Vec<String>,

    /// Parameter file (YAML) of the node, with values by name and in units; of several, a later one overrides the
    /// earlier ones
    #[arg(long, value_name = "FILE")]
    pub params: Vec<PathBuf>,

    /// Value of an entry: `607D.2=9000`, `607Dsub2=9000`, `"EFC target position=90.00 °"`, `"sensor selection code=-1"`
    #[arg(long = "set", value_name = "ENTRY=VALUE")]
    pub settings: Vec<String>,

    /// File with one such setting on each line; lines that begin with `#` are comments
    #[arg(long, value_name = "FILE")]
    pub set_file: Vec<PathBuf>,

    /// Locked entry that may be set anyway: factory data, which the device takes only while it is unlocked for service
    #[arg(long, value_name = "ENTRY")]
    pub unlock: Vec<String>,

    /// Write no file; report what is written into the node at boot, by a PLC that creates all SDOs, with a concise DCF,
    /// and by a configuration tool
    #[arg(long)]
    pub explain: bool,

    /// Write no value that is the entry's default
    #[arg(long)]
    pub since_default: bool,

    /// File to write [default: the key and node-ID, such as pmc-5.dcf]
    #[arg(long, short, value_name = "FILE")]
    pub out: Option<PathBuf>,

    /// Also the concise DCF for the master's object 1F22h, next to the DCF with the ending `.bin`
    #[arg(long)]
    pub concise: bool,

    /// Also the same as an XDC (CiA 311), next to the DCF with the ending `.xdc`
    #[arg(long)]
    pub xdc: bool,

    /// Replace files of these names that odgen did not make
    #[arg(long)]
    pub force: bool,

    #[command(flatten)]
    pub messages: Messages,
}

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
    let mut loader = report.loader();
    let mut compiled = od_gen::source::compile_file(&spec, &mut sources, &mut loader);
    if !args.modules.is_empty() && compiled.system.is_some() {
        let key = args.device.as_deref();
        compiled = plugged_in(&args.modules, &spec, key, &compiled, &mut sources)
            .map_err(|refusal| refuse(*refusal))?;
    }
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
    let of_file = compiled.node.as_ref();
    let node = files.node(node, report).or_else(|| of_file?.stated_id());
    let mut commissioning = commissioning(device, node, of_file).map_err(refuse)?;
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
    if let Some(of_file) = of_file {
        report.left_behind(of_file, &commissioning, &sources);
    }
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
        report.not_in_xdd(device, Some(&commissioning));
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

/// The concise DCF next to the DCF, and the line that reports it.
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
    of_file: Option<&NodeOfFile>,
) -> Result<Commissioning, Diagnostic> {
    node.map(|node| NodeOfFile::or_defaults(of_file, device, node)).ok_or_else(|| {
        let message = match of_file {
            Some(_) => "no node-ID is given, and the DCF states none",
            None => "no node-ID is given",
        };
        Diagnostic::without_place(codes::BAD_NODE_ID, message).help("add `--node ID`, 1 to 127")
    })
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

/// The layer of the command line: settings of lists first, each with its place, and what may be set although it is locked.
fn layer(
    args: &DcfArgs,
    sources: &mut SourceMap,
    diagnostics: &mut Diagnostics,
) -> Result<Layer, Box<Diagnostic>> {
    let mut settings = Vec::new();
    for path in &args.set_file {
        settings.extend(of_file(path, sources)?);
    }
    let mut of_option = |option: &str, text: &String| {
        let id = sources.add(option, text.as_str());
        Spanned::new(text.clone(), sources.whole(id))
    };
    settings.extend(args.settings.iter().map(|setting| of_option("--set", setting)));
    let mut layer = Layer::of(od_spec::settings(&settings, diagnostics));
    layer.unlocked = args.unlock.iter().map(|name| of_option("--unlock", name)).collect();
    Ok(layer)
}

/// One setting on each line. There is no comment after a value: it would be a part of a text.
fn of_file(path: &Path, sources: &mut SourceMap) -> Result<Vec<Spanned<String>>, Box<Diagnostic>> {
    let help = "check the path; a file of settings has one `ENTRY=VALUE` on each line";
    let id = open(path, help, sources)?;
    let (whole, text) = (sources.whole(id), sources.file(id).text());
    let mut settings = Vec::new();
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let end = start + line.trim_end_matches(['\n', '\r']).len();
        let begin = start + (line.len() - line.trim_start().len());
        let setting = text.get(begin..end).unwrap_or_default();
        if !setting.is_empty() && !setting.starts_with('#') {
            settings.push(Spanned::new(setting.to_owned(), whole.part(begin, end)));
        }
        start += line.len();
    }
    Ok(settings)
}

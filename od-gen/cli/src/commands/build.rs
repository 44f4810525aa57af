//! `odgen build`.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use od_c::{self as c, Prefix};
use od_formats::{Selection, artifacts};
use od_gen::files::{Existing, WriteError, left_over, remove};
use od_gen::{Artifact, CHECK, Provenance, rust};
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::model::{Devices, Dictionary, Origin, PdoMapping, System};
use od_spec::rule_codes;
use od_spec::source::SourceMap;

use crate::exit::ERRORS;
use crate::messages::Messages;
use crate::output::{clash, forced, not_written, overwritten, write};
use crate::report::{Report, Used, node_id, print, shown};
use crate::specs::{self, stem};
use crate::templates::DocsFormat;
use crate::templates::{Problem, templates};

#[derive(Debug, Args)]
pub(crate) struct BuildArgs {
    /// Specifications, EDS, DCF, XDD or XDC files [default: the `*.od.yaml` of the current directory]
    pub specs: Vec<PathBuf>,

    /// Directory for the files
    #[arg(long, short, default_value = "generated", value_name = "DIR")]
    pub out: PathBuf,

    /// Only these devices
    #[arg(long, value_name = "KEY")]
    pub device: Vec<String>,

    /// Also a DCF of each device for this node-ID (1 to 127) [default: of a DCF its own node, with its values]
    #[arg(long, value_name = "ID")]
    pub node: Option<String>,

    /// Also an XDD of each device (CiA 311), `xdd/KEY.xdd`, and an XDC next to each DCF
    #[arg(long)]
    pub xdd: bool,

    /// Also a Rust module of each device, `src/KEY.rs`
    #[arg(long)]
    pub rust: bool,

    /// Also the dictionary of each device in C, for this kind of firmware, `c/KEY/`
    #[arg(long, value_enum, value_name = "KIND")]
    pub c: Vec<CKind>,

    /// What begins the names of the dictionary for CANopenNode, where several are in one program [default: OD]
    #[arg(long, value_name = "NAME", requires = "c")]
    pub prefix: Option<Prefix>,

    /// Also the reference documentation in this format, `docs/`
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub docs: Vec<DocsFormat>,

    /// Remove what odgen made there before and this command does not make
    #[arg(long, conflicts_with = "device")]
    pub prune: bool,

    /// Replace files of these names that odgen did not make
    #[arg(long)]
    pub force: bool,

    #[command(flatten)]
    pub messages: Messages,
}

/// Firmware that a dictionary in C is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum CKind {
    /// Any: a dictionary by itself, C99 without a stack
    Plain,
    /// Firmware with the stack CANopenNode, version 4: `OD.h`, `OD.c`, and an extension that keeps limits, locks and conditions
    #[value(name = "canopennode")]
    CanopenNode,
}

impl From<CKind> for od_c::Kind {
    fn from(kind: CKind) -> Self {
        match kind {
            CKind::Plain => Self::Plain,
            CKind::CanopenNode => Self::CanopenNode,
        }
    }
}

pub(crate) fn run(args: &BuildArgs, directory: &Path, report: &Report) -> u8 {
    let node = match args.node.as_deref().map(node_id).transpose() {
        Ok(node) => node,
        Err(diagnostic) => return report.refuse(diagnostic),
    };
    let specs = match specs::all(&args.specs, directory, report) {
        Ok(specs) => specs,
        Err(code) => return code,
    };
    let Some(mut systems) = compile_all(&specs, args, report) else { return ERRORS };
    let mut set: Vec<Artifact> = Vec::new();
    let mut summary = String::new();
    for key in &args.device {
        if !systems.iter().any(|built| built.used.system.device(key).is_some()) {
            return report.unknown_device(systems.iter().map(|built| &built.used.system), key);
        }
    }
    if let Some(prefix) = &args.prefix
        && let Err(diagnostic) = is_of_one(args, prefix, systems.iter().map(|built| &built.used.system))
    {
        return report.refuse(diagnostic);
    }
    let templates = match args.docs.as_slice() {
        [] => Ok(Vec::new()),
        formats => templates(formats, None),
    };
    let templates = match templates {
        Ok(templates) => templates,
        Err(problem) => return problem.show(report),
    };
    for Built { path, used, sources, code } in &mut systems {
        let system = &used.system;
        let devices: Vec<&Dictionary> = system.devices.iter().filter(|device| wanted(args, device)).collect();
        if devices.is_empty() {
            continue;
        }
        let stem = &stem(path);
        summary.extend(devices.iter().copied().map(describe));
        let node = used.node_id(node);
        if node.is_none() && used.node.is_some() {
            report.note(&format!(
                "{} states no node-ID, so no DCF is made; `--node ID` makes one with its values",
                shown(path)
            ));
        }
        let configured = used.node.as_ref().map(|of_file| report.moved(of_file, node, sources));
        if args.xdd {
            for device in devices {
                report.not_in_xdd(device, configured.as_ref());
            }
        }
        let selection =
            Selection { devices: &args.device, node, configured: configured.as_ref(), xdd: args.xdd };
        set.extend(artifacts(system, stem, &selection));
        set.append(code);
        if !templates.is_empty() {
            let of_node = used.documented(path, report);
            let system = of_node.as_ref().unwrap_or(system);
            let mut options = od_documents::options(system, &args.device, None);
            options.origin = Some(od_documents::origin(sources));
            match od_documents::artifacts(system, "docs/", stem, &options, &templates) {
                Ok(artifacts) => set.extend(artifacts),
                Err(error) => return Problem::Template(error, None).show(report),
            }
        }
    }
    if !set.is_empty() {
        set.extend(c::shared(&kinds(args)));
    }
    if let Some(what) = clash(&set, "devices") {
        return report.refuse(Diagnostic::without_place(rule_codes::DUPLICATE_NAME, what).help(
            "give the devices or specifications other names, or build them into different directories, with `--device` and `--out`",
        ));
    }
    if let Some(path) = overwritten(&args.out, &set, &specs) {
        return report.refuse(
            Diagnostic::without_place(
                codes::WRITE_FAILED,
                format!("cannot write {path}: it is read to make it"),
            )
            .help("build into another directory, with `--out`"),
        );
    }
    // The process ends next: taking the models apart piece by piece would only cost the user time.
    std::mem::forget(systems);
    let code = write(&args.out, &set, forced(args.force, Existing::Generated), &summary, report);
    if code != 0 {
        return code;
    }
    // What is made of some devices says nothing about the others.
    let left = if args.device.is_empty() { left_from_before(args, &set) } else { Ok(String::new()) };
    match left {
        Ok(text) => print(&(text + &to_open(args, &set))),
        Err(error) => report.refuse(not_written(&error)),
    }
}

/// Names what an earlier build made and this one does not, and removes it if that is wanted.
fn left_from_before(args: &BuildArgs, set: &[Artifact]) -> Result<String, WriteError> {
    /// So many files are named.
    const NAMED: usize = 5;
    let mut left = left_over(&args.out, set)?;
    // A build makes a DCF next to the EDS of its device, and an XDC next to its XDD; any other is one of `odgen dcf`.
    left.retain(|path| {
        let path = args.out.join(path);
        let beside = |ending: &str| path.with_extension(ending).exists();
        match path.extension().and_then(std::ffi::OsStr::to_str) {
            Some("dcf") => beside("eds"),
            Some("xdc") => beside("xdd"),
            Some(_) | None => true,
        }
    });
    if left.is_empty() {
        return Ok(String::new());
    }
    let mut names: Vec<String> = left.iter().take(NAMED).map(|path| shown(&args.out.join(path))).collect();
    if left.len() > NAMED {
        names.push(format!("{} more", left.len() - NAMED));
    }
    let names = names.join(", ");
    if args.prune {
        remove(&args.out, &left)?;
        return Ok(format!("  removed, as nothing makes it any more: {names}\n"));
    }
    Ok(format!("  made before, and not by this command: {names}; `--prune` removes it\n"))
}

/// The first file of each kind that a user opens, and how many more there are.
fn to_open(args: &BuildArgs, set: &[Artifact]) -> String {
    type IsOfKind = fn(folder: &str, name: &str, of_stack: &str) -> bool;
    const KINDS: [(&str, IsOfKind); 4] = [
        ("EDS", |folder, name, _| folder == "eds" && matches!(name.rsplit_once('.'), Some((_, "eds")))),
        ("page", |folder, name, _| {
            folder == "docs" && ["README.md", "index.html", "manual.html"].contains(&name)
        }),
        ("Rust", |folder, _, _| folder == "src"),
        ("C", |folder, name, of_stack| folder == "c" && (name == of_stack || name.ends_with("_od.h"))),
    ];
    let of_stack = format!("{}.h", args.prefix.clone().unwrap_or_default());
    let mut text = String::from("to open:\n");
    for (kind, is_of_kind) in KINDS {
        let mut paths = set.iter().map(|artifact| artifact.path.as_str()).filter(|path| {
            let folder = path.split('/').next().unwrap_or_default();
            is_of_kind(folder, path.rsplit('/').next().unwrap_or_default(), &of_stack)
        });
        if let Some(first) = paths.next() {
            let more = match paths.count() {
                0 => String::new(),
                more => format!(", and {more} more"),
            };
            let _ = writeln!(text, "  {kind:<4}  {}{more}", shown(&args.out.join(first)));
        }
    }
    text
}

/// A specification that was compiled.
struct Built {
    path: PathBuf,
    used: Used,
    sources: SourceMap,
    /// Its Rust modules and its C, as far as they are wanted.
    code: Vec<Artifact>,
}

/// Compiles everything, so that all messages are shown; `None` if any has errors.
fn compile_all(specs: &[PathBuf], args: &BuildArgs, report: &Report) -> Option<Vec<Built>> {
    let built = specs.iter().map(|path| {
        let (used, mut diagnostics, sources) = report.compile_unshown(path);
        let code = used.as_ref().and_then(|used| code(args, &used.system, &sources, &mut diagnostics));
        diagnostics.sort();
        report.show_used(path, CHECK, &diagnostics, &sources);
        Some(Built { path: path.clone(), used: used?, sources, code: code? })
    });
    built.collect::<Vec<_>>().into_iter().collect()
}

/// The Rust modules and the C of the wanted devices; `None` if any cannot be made.
fn code(
    args: &BuildArgs,
    system: &System,
    sources: &SourceMap,
    diagnostics: &mut Diagnostics,
) -> Option<Vec<Artifact>> {
    let devices = || system.devices.iter().filter(|device| wanted(args, device));
    let provenance = Provenance::of(sources);
    let (mut set, errors) = (Vec::new(), diagnostics.errors_found());
    if args.rust {
        set.extend(rust::artifacts(system, devices(), &provenance, diagnostics));
    }
    let options = c::Options { kinds: kinds(args), prefix: args.prefix.clone().unwrap_or_default() };
    set.extend(c::artifacts(system, devices(), &provenance, &options, diagnostics));
    (diagnostics.errors_found() == errors).then_some(set)
}

/// Whether a prefix is that of one dictionary for CANopenNode.
fn is_of_one<'s>(
    args: &BuildArgs,
    prefix: &Prefix,
    systems: impl Iterator<Item = &'s System>,
) -> Result<(), Diagnostic> {
    let devices: Vec<&str> = systems
        .flat_map(|system| &system.devices)
        .filter(|device| wanted(args, device))
        .map(|device| device.key.as_str())
        .collect();
    if !kinds(args).contains(&c::Kind::CanopenNode) {
        let message = format!("the prefix `{prefix}` is for no file: only C for CANopenNode has one");
        return Err(Diagnostic::without_place(codes::BAD_NOTATION, message)
            .help("add `--c canopennode`, or leave out `--prefix`"));
    }
    if devices.len() > 1 {
        let message = format!("`{prefix}` cannot begin the names of {} dictionaries", devices.len());
        return Err(Diagnostic::without_place(codes::BAD_NOTATION, message)
            .help(format!("build one with each prefix: `--device {} --prefix {prefix}`", devices[0])));
    }
    Ok(())
}

/// The kinds of C that are wanted, each once.
fn kinds(args: &BuildArgs) -> Vec<c::Kind> {
    let mut kinds: Vec<c::Kind> = args.c.iter().copied().map(c::Kind::from).collect();
    kinds.sort_unstable();
    kinds.dedup();
    kinds
}

fn wanted(args: &BuildArgs, device: &Dictionary) -> bool {
    Devices::listed(&args.device).includes(&device.key)
}

fn describe(device: &Dictionary) -> String {
    let described: Vec<_> =
        device.objects.values().filter(|object| object.origin == Origin::Manual).collect();
    let entries: usize = described.iter().map(|object| object.entries.len()).sum();
    let mappable =
        described.iter().flat_map(|object| &object.entries).filter(|entry| entry.pdo != PdoMapping::None);
    let stored = described.iter().filter(|object| object.is_stored()).count();
    format!(
        "  {:<6} {} objects · {} entries · {} mappable · {} stored · {} more from libraries and PDOs\n",
        device.key,
        described.len(),
        entries,
        mappable.count(),
        stored,
        device.objects.len() - described.len()
    )
}

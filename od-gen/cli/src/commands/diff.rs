//! `odgen diff`.

mod git;

use std::io::IsTerminal as _;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use od_diff::{Difference, Question, Scope, Unpaired, compare, human, json, markdown, short};
use od_gen::source::read_file;
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::file_name;
use od_spec::{Commissioning, NodeOfFile, assign_layers, is_parameter_file};

use crate::exit::{DIFFERS, ERRORS};
use crate::messages::Color;
use crate::report::{Report, Used, print, print_json, print_styled};
use crate::settings::parameter_files;

#[derive(Debug, Args)]
pub(crate) struct DiffArgs {
    /// The dictionary before the changes; with --git the specification
    #[arg(value_name = "OLD")]
    pub old: PathBuf,

    /// The dictionary after the changes
    #[arg(value_name = "NEW", required_unless_present = "git", conflicts_with = "git")]
    pub new: Option<PathBuf>,

    /// Specification of the device that parameter files are for; they are compared with each other, or with a DCF
    #[arg(long, value_name = "SPEC", conflicts_with = "git")]
    pub spec: Option<PathBuf>,

    /// Compare a specification with itself as it was at a revision of git, such as `HEAD` or `v1.08`
    #[arg(long, value_name = "REV")]
    pub git: Option<String>,

    /// Only this device
    #[arg(long, value_name = "KEY")]
    pub device: Option<String>,

    /// How the differences are written
    #[arg(long, value_enum, default_value_t)]
    pub format: DiffFormat,

    /// Fail with exit code 3 when a change is of this class or of a heavier one
    #[arg(long, value_enum, value_name = "CLASS")]
    pub exit_code: Option<DiffClass>,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum DiffFormat {
    /// For people, with reasons and proposals
    #[default]
    Human,
    /// One line for each change
    Short,
    /// Tables and an entry for a changelog
    Markdown,
    /// One JSON object
    Json,
}

/// The classes of changes, the lightest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum DiffClass {
    /// Documents only: whatever differs
    Documents,
    /// Compatible additions
    Addition,
    /// The device does something else
    Behaviour,
    /// Firmware does not compile any more
    Firmware,
    /// Stored parameters are lost
    Stored,
    /// PLC projects break
    Plc,
}

impl From<DiffClass> for od_diff::Class {
    fn from(class: DiffClass) -> Self {
        match class {
            DiffClass::Documents => Self::Documents,
            DiffClass::Addition => Self::Addition,
            DiffClass::Behaviour => Self::Behaviour,
            DiffClass::Firmware => Self::Firmware,
            DiffClass::Stored => Self::Stored,
            DiffClass::Plc => Self::Plc,
        }
    }
}

pub(crate) fn run(args: &DiffArgs, color: Color, report: &Report) -> u8 {
    match difference(args, report) {
        Ok(found) => {
            let code = match args.format {
                DiffFormat::Human if is_coloured(color) => print_styled(&human(&found, true)),
                DiffFormat::Human => print(&human(&found, false)),
                DiffFormat::Short => print(&short(&found)),
                DiffFormat::Markdown => print(&markdown(&found)),
                DiffFormat::Json => print_json(json(&found).as_bytes()),
            };
            let fails = args.exit_code.is_some_and(|class| found.class() >= Some(class.into()));
            if fails && code == crate::exit::SUCCESS { DIFFERS } else { code }
        }
        Err(code) => code,
    }
}

fn difference(args: &DiffArgs, report: &Report) -> Result<Difference, u8> {
    let read = |path: &Path| match Source::of(path) {
        Source::Parameters => configured(path, args, report),
        Source::Specification | Source::Eds | Source::Dcf => {
            report.compile_with_sources(path).map(|(used, _)| used).ok_or(ERRORS)
        }
    };
    let (old, new, scope) = match (&args.git, &args.new) {
        (Some(revision), _) => {
            if Source::of(&args.old) != Source::Specification {
                return Err(report.refuse(
                    Diagnostic::without_place(codes::UNREADABLE, "`--git` takes a specification")
                        .help("write the old file down, `git show REV:FILE > old.eds`, and compare both"),
                ));
            }
            let system = git::compile(revision, &args.old, report)?;
            let old = Used { system, node: None, device: None };
            (old, read(&args.old)?, Scope::Everything)
        }
        (None, Some(new)) => {
            let scope = scope_of(&args.old, new);
            let (before, after) = (read(&args.old), read(new));
            (before?, after?, scope)
        }
        // The parser of the command line asks for one of the two.
        (None, None) => return Err(crate::exit::USAGE),
    };
    let nodes = nodes(&old, &new, report);
    // Who compares the values of a node does not ask about other devices.
    let device = args.device.clone().or_else(|| old.device.clone()).or_else(|| new.device.clone());
    let question = Question {
        old: &old.system,
        new: &new.system,
        scope,
        device: device.as_deref(),
        nodes: nodes.as_ref().map(|(old, new)| (old, new)),
    };
    answer(&question, report)
}

/// What differs, or what is wrong with the question.
pub(crate) fn answer(question: &Question<'_>, report: &Report) -> Result<Difference, u8> {
    compare(question).map_err(|unpaired| {
        let keys = |keys: &[String]| keys.iter().map(|key| format!("`{key}`")).collect::<Vec<_>>().join(", ");
        let help = match &unpaired {
            Unpaired::NoSuchDevice { keys: there, .. } => format!("the devices are {}", keys(there)),
            Unpaired::WhichDevice { keys: there } => format!("name one with `--device`: {}", keys(there)),
        };
        report.refuse(Diagnostic::without_place(codes::UNKNOWN_DEVICE, unpaired.to_string()).help(help))
    })
}

/// The node that a parameter file settles, as a DCF made of it would.
fn configured(path: &Path, args: &DiffArgs, report: &Report) -> Result<Used, u8> {
    let Some(spec) = &args.spec else {
        let message =
            format!("{} is a parameter file, and no specification is named", file_name::shown(path));
        return Err(report.refuse(
            Diagnostic::without_place(codes::UNREADABLE, message)
                .help("add `--spec SPEC`, the specification of the device that it is for"),
        ));
    };
    let (used, mut sources) = report.compile_with_sources(spec).ok_or(ERRORS)?;
    let mut diagnostics = Diagnostics::new();
    let files = parameter_files(&[path.to_owned()], &mut sources, &mut diagnostics)
        .map_err(|diagnostic| report.refuse(*diagnostic))?;
    let device = files.device(&used.system, args.device.as_deref(), report)?;
    files.check_device(&used.system, device, &mut diagnostics);
    let stated = used.node_id(files.node(None, report));
    let mut node = NodeOfFile::or_defaults(used.node.as_ref(), device, stated.unwrap_or(1));
    files.settle(device, &mut node, &mut diagnostics);
    let layers = files.into_layers();
    let configured = node.configured(device);
    let assigned = assign_layers(&used.system, &configured, node.node, &layers, &mut diagnostics);
    diagnostics.sort();
    report.show(&diagnostics, &sources);
    if diagnostics.has_errors() {
        return Err(ERRORS);
    }
    node.values.extend(assigned.values);
    node.unlocked.extend(assigned.unlocked);
    let device = Some(device.key.clone());
    Ok(Used { system: used.system, node: Some(NodeOfFile::of_settings(stated, node)), device })
}

/// The nodes of two DCF or parameter files. Values of one alone cannot be compared, which is said.
fn nodes(old: &Used, new: &Used, report: &Report) -> Option<(Commissioning, Commissioning)> {
    match (&old.node, &new.node) {
        (Some(before), Some(after)) => {
            // One without a node-ID may be the other's node.
            let (first, second) = (before.stated_id(), after.stated_id());
            Some((before.at(first.or(second)), after.at(second.or(first))))
        }
        (Some(one), None) | (None, Some(one)) => {
            let number = one.at(None).values.len();
            if number > 0 {
                let (values, are) = if number == 1 { ("value", "is") } else { ("values", "are") };
                report.note(&format!(
                    "the {number} {values} set for the node {are} not compared, as the other side is about no node"
                ));
            }
            None
        }
        (None, None) => None,
    }
}

/// What a file is, by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Source {
    Specification,
    Eds,
    Dcf,
    Parameters,
}

impl Source {
    fn of(path: &Path) -> Self {
        let ends_with = |ending: &str| path.extension().is_some_and(|one| one.eq_ignore_ascii_case(ending));
        if ends_with("eds") || ends_with("xdd") {
            Self::Eds
        } else if ends_with("dcf") || ends_with("xdc") {
            Self::Dcf
        } else if read_file(path).is_ok_and(|text| is_parameter_file(&String::from_utf8_lossy(&text))) {
            Self::Parameters
        } else {
            Self::Specification
        }
    }
}

/// The facts that two files can state.
pub(crate) fn scope_of(old: &Path, new: &Path) -> Scope {
    scope(Source::of(old), Source::of(new))
}

/// The facts that both kinds of file can state.
const fn scope(old: Source, new: Source) -> Scope {
    match (old, new) {
        (Source::Specification | Source::Parameters, Source::Specification | Source::Parameters) => {
            Scope::Everything
        }
        (Source::Dcf, Source::Specification | Source::Parameters | Source::Eds)
        | (Source::Specification | Source::Parameters | Source::Eds, Source::Dcf) => Scope::WhatADcfStates,
        (Source::Eds, Source::Specification | Source::Parameters | Source::Eds)
        | (Source::Specification | Source::Parameters, Source::Eds)
        | (Source::Dcf, Source::Dcf) => Scope::WhatAnEdsStates,
    }
}

/// Results go to the standard output, which need not be a terminal where messages go to one.
fn is_coloured(color: Color) -> bool {
    match color {
        Color::Always => true,
        Color::Never => false,
        Color::Auto => std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none(),
    }
}

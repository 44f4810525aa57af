//! `odgen docs`.

use std::path::{Path, PathBuf};

use clap::Args;
use od_diff::{Change, Question, Row, row};
use od_documents::{self as docs, Changed, Edition, InLanguage, Siblings, Since};
use od_gen::Artifact;
use od_gen::files::Existing;
use od_spec::diag::{Diagnostic, codes};
use od_spec::file_name;
use od_spec::model::System;
use od_spec::rule_codes;

use crate::commands::diff::{answer, scope_of};
use crate::exit::{ERRORS, SUCCESS};
use crate::language::language;
use crate::logo;
use crate::output::{clash, forced, write};
use crate::pdf;
use crate::report::{Report, print_json};
use crate::specs::{self, stem};
use crate::templates::DocsFormat;
use crate::templates::{Problem, printed, templates};

#[derive(Debug, Clone, Args)]
pub(crate) struct DocsArgs {
    /// Specifications, EDS, DCF, XDD or XDC files [default: the `*.od.yaml` of the current directory]
    pub specs: Vec<PathBuf>,

    /// Directory for the documents; those of a specification go into a directory with its name
    #[arg(long, short, default_value = "generated/docs", value_name = "DIR")]
    pub out: PathBuf,

    /// Only these devices
    #[arg(long, value_name = "KEY")]
    pub device: Vec<String>,

    /// Language of the documents, such as `en` or `de`; with several, each has a directory of its own, and pages link to the
    /// same page in another [default: the first of the specification]
    #[arg(long, value_name = "CODE")]
    pub lang: Vec<String>,

    /// Format; can be given several times [default: md, or with --templates none but theirs]
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub format: Vec<DocsFormat>,

    /// With `--format print`: mark where the manual differs from the issue that it replaces, and list the
    /// errata after it
    #[arg(long)]
    pub errata: bool,

    /// Mark what changed since this earlier specification, EDS, DCF, XDD or XDC file, and list the changes
    #[arg(long, value_name = "OLD")]
    pub since: Option<PathBuf>,
    /// With `--format print`: gather what the manual leaves open in an appendix for its maker
    #[arg(long)]
    pub open_questions: bool,

    /// With `--format print`: logo of the maker on the cover, an SVG or PNG file
    #[arg(long, value_name = "FILE")]
    pub logo: Option<PathBuf>,

    /// With `--format print`: also make the PDF, with WeasyPrint, which has to be installed
    #[arg(long, conflicts_with_all = ["dump_context", "export_templates"])]
    pub pdf: bool,

    /// Directory with templates of your own, which override those of the format
    #[arg(long, value_name = "DIR")]
    pub templates: Option<PathBuf>,

    /// Write the templates of the format into this directory, to start your own from, and nothing else
    #[arg(long, value_name = "DIR", conflicts_with_all = ["templates", "dump_context"])]
    pub export_templates: Option<PathBuf>,

    /// Print what templates see, as JSON, and nothing else
    #[arg(long)]
    pub dump_context: bool,

    /// Replace files of these names that odgen did not make
    #[arg(long)]
    pub force: bool,
}

pub(crate) fn run(args: &DocsArgs, directory: &Path, report: &Report) -> u8 {
    if let Some(target) = &args.export_templates {
        return export(args, target, report);
    }
    if let Some(refused) = without_print(args) {
        return report.refuse(refused);
    }
    let logo = match args.logo.as_deref().map(logo::read).transpose() {
        Ok(logo) => logo.unwrap_or_default(),
        Err(problem) => return report.refuse(problem),
    };
    let specs = match specs::all(&args.specs, directory, report) {
        Ok(specs) => specs,
        Err(code) => return code,
    };
    let Some(systems) = compile_all(&specs, report) else { return ERRORS };
    for key in &args.device {
        if !systems.iter().any(|read| read.system.device(key).is_some()) {
            return report.unknown_device(systems.iter().map(|read| &read.system), key);
        }
    }
    let languages = match languages(&args.lang, &systems) {
        Ok(languages) => languages,
        Err(diagnostic) => return report.refuse(*diagnostic),
    };
    let shows = |read: &&Read| {
        args.device.is_empty() || args.device.iter().any(|key| read.system.device(key).is_some())
    };
    let since = args.since.as_deref().map(|old| since(old, &specs, &systems, report)).transpose();
    let since = match since {
        Ok(since) => since,
        Err(code) => return code,
    };
    let gaps = if args.open_questions { docs::Gaps::Gathered } else { docs::Gaps::LeftOut };
    let wanted = docs::Options { errata: args.errata, gaps, logo, since, ..docs::Options::default() };
    let editions = editions(systems.iter().filter(shows), &languages, &args.device, &wanted);
    if args.dump_context {
        // Pages for the screen say in its place what is open.
        let is_print = args.format.contains(&DocsFormat::Print);
        let gaps = if is_print { gaps } else { docs::Gaps::InPlace };
        return editions.into_iter().fold(SUCCESS, |code, Edition { system, options, .. }| {
            code.max(print_json(&docs::dump_context(system, &docs::Options { gaps, ..options })))
        });
    }
    let templates = match templates(&formats(args), args.templates.as_deref()) {
        Ok(templates) => templates,
        Err(problem) => return problem.show(report),
    };
    let print = || match editions.as_slice() {
        [Edition { system, folder, options }] => docs::artifacts(system, "", folder, options, &templates),
        several => docs::with_start_page(several, &templates),
    };
    let set = match &args.templates {
        Some(_) => printed(report, print),
        None => print(),
    };
    let set = match set {
        Ok(set) => set,
        Err(error) => return Problem::Template(error, args.templates.clone()).show(report),
    };
    if let Some(what) = clash(&set, "specifications") {
        return report.refuse(
            Diagnostic::without_place(rule_codes::DUPLICATE_NAME, what)
                .help("print specifications of one file name into different directories, with `--out`"),
        );
    }
    let code = write(&args.out, &set, forced(args.force, Existing::Generated), "", report);
    if args.pdf && code == SUCCESS {
        let manuals = set.iter().filter(|artifact| artifact.path.ends_with(MANUAL));
        return pdf::make(&mut manuals.map(|manual| args.out.join(&manual.path)), report);
    }
    code
}

/// The page that is the whole printed manual.
const MANUAL: &str = "manual.html";

/// Why options about the printed manual have no effect: nothing is printed.
fn without_print(args: &DocsArgs) -> Option<Diagnostic> {
    if args.format.contains(&DocsFormat::Print) {
        return None;
    }
    let own = args.templates.is_some();
    let (option, help) = if args.errata && !own {
        ("--errata", "pages for the screen always show the errata; for the manual, add `--format print`")
    } else if args.open_questions && !own {
        (
            "--open-questions",
            "pages for the screen say in its place what is open; for the manual, add `--format print`",
        )
    } else if args.logo.is_some() && !own {
        ("--logo", "add `--format print`")
    } else if args.pdf {
        ("--pdf", "add `--format print`")
    } else {
        return None;
    };
    let message = format!("`{option}` is about the printed manual alone");
    Some(Diagnostic::without_place(codes::BAD_NOTATION, message).help(help))
}

/// A specification that was read.
struct Read {
    /// Name of its file without the ending.
    stem: String,
    system: System,
    origin: docs::Origin,
}

/// The languages of a command line, as they are written; one that is named twice counts once.
fn languages(codes: &[String], systems: &[Read]) -> Result<Vec<String>, Box<Diagnostic>> {
    let mut languages = Vec::new();
    for code in codes {
        let known = language(code, systems.iter().map(|read| &read.system))?;
        if !languages.contains(&known) {
            languages.push(known);
        }
    }
    Ok(languages)
}

/// What changed since an earlier state of the only specification.
fn since(old: &Path, specs: &[PathBuf], systems: &[Read], report: &Report) -> Result<Since, u8> {
    let ([path], [new]) = (specs, systems) else {
        let message = format!("`--since` compares one specification, and {} are printed", specs.len());
        return Err(report.refuse(Diagnostic::without_place(codes::BAD_NOTATION, message).help(
            "name the specification that the earlier file is compared with: `odgen docs SPEC --since OLD`",
        )));
    };
    let (used, _) = report.compile_with_sources(old).ok_or(ERRORS)?;
    let scope = scope_of(old, path);
    let question = Question { old: &used.system, new: &new.system, scope, device: None, nodes: None };
    let difference = answer(&question, report)?;
    let changed = |device: Option<&str>, change: &Change| {
        let Row { sign, place, values, consequences } = row(change);
        let device = device.map(str::to_owned);
        Changed { device, index: change.place.index(), sign, place, values, consequences }
    };
    let of_devices = difference
        .devices
        .iter()
        .flat_map(|device| device.changes.iter().map(|change| changed(Some(&device.key), change)));
    let of_system = difference.system.iter().map(|change| changed(None, change));
    let name =
        old.file_name().map_or_else(|| file_name::shown(old), |name| file_name::shown(Path::new(name)));
    Ok(Since { name, changes: of_system.chain(of_devices).collect() })
}

/// Each specification in each language, in a folder of its own, with what is wanted of all.
fn editions<'a>(
    systems: impl Iterator<Item = &'a Read> + Clone,
    languages: &[String],
    devices: &[String],
    wanted: &docs::Options,
) -> Vec<Edition<'a>> {
    let is_single = systems.clone().count() == 1;
    let edition = |Read { stem, system, origin }: &'a Read, language: Option<&String>| {
        let docs::Options { devices, language: code, code_names, .. } =
            docs::options(system, devices, language.map(String::as_str));
        let folder = match language.filter(|_| languages.len() > 1) {
            Some(language) => format!("{stem}/{language}"),
            None => stem.clone(),
        };
        let siblings = match languages {
            [] | [_] if is_single => Siblings::default(),
            [] | [_] => Siblings { start_page: "../index.html".to_owned(), languages: Vec::new() },
            several => Siblings {
                start_page: "../../index.html".to_owned(),
                languages: several.iter().filter(|other| Some(*other) != language).map(in_language).collect(),
            },
        };
        let origin = Some(origin.clone());
        let options =
            docs::Options { devices, language: code, code_names, siblings, origin, ..wanted.clone() };
        Edition { system, folder, options }
    };
    match languages {
        [] => systems.map(|one| edition(one, None)).collect(),
        codes => systems.flat_map(|one| codes.iter().map(move |code| edition(one, Some(code)))).collect(),
    }
}

/// The same pages in another language, as pages in one language find them.
fn in_language(code: &String) -> InLanguage {
    InLanguage { language: code.clone(), name: docs::language_name(code), folder: format!("../{code}") }
}

/// The formats to print; a user's own templates come alone unless a format is named.
fn formats(args: &DocsArgs) -> Vec<DocsFormat> {
    match (args.format.as_slice(), &args.templates) {
        ([], None) => vec![DocsFormat::Md],
        (formats, _) => formats.to_vec(),
    }
}

/// Compiles everything, so that all messages are shown; `None` if any has errors.
fn compile_all(specs: &[PathBuf], report: &Report) -> Option<Vec<Read>> {
    let systems = specs.iter().map(|path| {
        let (used, sources) = report.compile_with_sources(path)?;
        let system = used.documented(path, report).unwrap_or(used.system);
        Some(Read { stem: stem(path), system, origin: docs::origin(&sources) })
    });
    systems.collect::<Vec<_>>().into_iter().collect()
}

fn export(args: &DocsArgs, target: &Path, report: &Report) -> u8 {
    let formats = if args.format.is_empty() { vec![DocsFormat::Md] } else { args.format.clone() };
    let files = formats.into_iter().flat_map(|format| od_documents::Format::from(format).files());
    let set: Vec<Artifact> = files
        .map(|(name, text)| Artifact {
            path: (*name).to_owned(),
            bytes: text.as_bytes().to_vec(),
            purpose: "template".to_owned(),
        })
        .collect();
    // What is there may be templates that a user has changed.
    write(target, &set, forced(args.force, Existing::None), "", report)
}

//! `odgen docs`.

use std::path::{Path, PathBuf};

use clap::Args;
use od_documents as docs;
use od_gen::Artifact;
use od_gen::files::Existing;
use od_spec::diag::{Diagnostic, codes};
use od_spec::model::System;
use od_spec::rule_codes;

use crate::exit::{ERRORS, SUCCESS};
use crate::language::language;
use crate::output::{clash, forced, write};
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

    /// Language of the documents, such as `en` or `de` [default: the first of the specification]
    #[arg(long, value_name = "CODE")]
    pub lang: Option<String>,

    /// Format; can be given several times [default: md, or with --templates none but theirs]
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub format: Vec<DocsFormat>,

    /// With `--format print`: mark where the manual differs from the issue that it takes the place of, and list the errata behind it
    #[arg(long)]
    pub errata: bool,

    /// Directory with templates of your own, which are laid over those of the format
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
    if args.errata && !args.format.contains(&DocsFormat::Print) && args.templates.is_none() {
        return report.refuse(
            Diagnostic::without_place(codes::BAD_NOTATION, "`--errata` is about the printed manual alone")
                .help("pages for the screen always show the errata; for the manual, add `--format print`"),
        );
    }
    let specs = match specs::all(&args.specs, directory, report) {
        Ok(specs) => specs,
        Err(code) => return code,
    };
    let Some(systems) = compile_all(&specs, report) else { return ERRORS };
    for key in &args.device {
        if !systems.iter().any(|(_, system)| system.device(key).is_some()) {
            return report.unknown_device(systems.iter().map(|(_, system)| system), key);
        }
    }
    let mut args = args.clone();
    if let Some(code) = &args.lang {
        match language(code, systems.iter().map(|(_, system)| system)) {
            Ok(known) => args.lang = Some(known),
            Err(diagnostic) => return report.refuse(*diagnostic),
        }
    }
    if args.dump_context {
        return systems.iter().fold(SUCCESS, |code, (_, system)| {
            let options = options(system, &args);
            code.max(print_json(&docs::dump_context(system, &options)))
        });
    }
    let templates = match templates(&formats(&args), args.templates.as_deref()) {
        Ok(templates) => templates,
        Err(problem) => return problem.show(report),
    };
    let shows = |(_, system): &&(String, System)| {
        args.device.is_empty() || args.device.iter().any(|key| system.device(key).is_some())
    };
    let print = || {
        let sets = systems
            .iter()
            .filter(shows)
            .map(|(stem, system)| docs::artifacts(system, "", stem, &options(system, &args), &templates));
        sets.collect::<Result<Vec<_>, _>>().map(|sets| sets.concat())
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
    write(&args.out, &set, forced(args.force, Existing::Generated), "", report)
}

/// What the documents of a specification show.
fn options(system: &System, args: &DocsArgs) -> docs::Options {
    let options = docs::options(system, &args.device, args.lang.as_deref());
    docs::Options { errata: args.errata, ..options }
}

/// The formats to print; a user's own templates come alone unless a format is named.
fn formats(args: &DocsArgs) -> Vec<DocsFormat> {
    match (args.format.as_slice(), &args.templates) {
        ([], None) => vec![DocsFormat::Md],
        (formats, _) => formats.to_vec(),
    }
}

/// Compiles everything, so that all messages are shown; `None` if any has errors.
fn compile_all(specs: &[PathBuf], report: &Report) -> Option<Vec<(String, System)>> {
    let systems = specs.iter().map(|path| {
        let (used, _) = report.compile_with_sources(path)?;
        Some((stem(path), used.documented(path, report).unwrap_or(used.system)))
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
    // What is there may be templates that somebody has changed.
    write(target, &set, forced(args.force, Existing::None), "", report)
}

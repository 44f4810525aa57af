//! `odgen docs`.

use std::fs;
use std::path::Path;

use od_gen::Artifact;
use od_gen::docs::{self, TemplateError, Templates};
use od_gen::files::write_all;
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::model::System;
use od_spec::rule_codes;
use od_spec::source::SourceMap;

use super::args::{DocsArgs, DocsFormat};
use super::build::{SHIPPED, clash, list, shipped, stem};
use super::report::{Report, print, print_bytes};
use super::{ERRORS, FINE};

pub(crate) fn run(args: &DocsArgs, report: &Report) -> u8 {
    if let Some(directory) = &args.export_templates {
        return export(args, directory, report);
    }
    let Some(systems) = compile_all(args, report) else { return ERRORS };
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
        return systems.iter().fold(FINE, |code, (_, system)| {
            let options = docs::options(system, &args.device, args.lang.as_deref());
            code.max(print_bytes(&docs::dump_context(system, &options)))
        });
    }
    let templates = match templates(&formats(&args), args.templates.as_deref()) {
        Ok(templates) => templates,
        Err(problem) => return problem.show(report),
    };
    let mut set = Vec::new();
    let shows = |system: &System| {
        args.device.is_empty() || args.device.iter().any(|key| system.device(key).is_some())
    };
    for (stem, system) in systems.iter().filter(|(_, system)| shows(system)) {
        let options = docs::options(system, &args.device, args.lang.as_deref());
        match docs::artifacts(system, "", stem, &options, &templates) {
            Ok(artifacts) => set.extend(artifacts),
            Err(error) => return Problem::Template(error, args.templates.clone()).show(report),
        }
    }
    if let Some(path) = clash(&set) {
        return report.refuse(
            Diagnostic::without_place(
                rule_codes::DUPLICATE_NAME,
                format!("two specifications would both write {path}"),
            )
            .help("print specifications of one file name into different directories"),
        );
    }
    write(&args.out, &set, report)
}

fn write(out: &Path, set: &[Artifact], report: &Report) -> u8 {
    match write_all(out, set) {
        Ok(outcomes) => print(&list(out, set, &outcomes)),
        Err(error) => report.refuse(
            Diagnostic::without_place(codes::WRITE_FAILED, error.to_string())
                .help("nothing was changed; check the directory, its permissions and the free space"),
        ),
    }
}

/// The language of this code, in any case: one whose fixed words are known, or one of the specifications.
fn language<'a>(code: &str, systems: impl Iterator<Item = &'a System>) -> Result<String, Box<Diagnostic>> {
    let own = systems.flat_map(|system| &system.languages).map(String::as_str);
    let mut known: Vec<&str> = docs_gen::LANGUAGES.iter().copied().chain(own).collect();
    known.sort_unstable();
    known.dedup();
    known.iter().find(|one| one.eq_ignore_ascii_case(code)).map(|one| (*one).to_owned()).ok_or_else(|| {
        let list = known.iter().map(|one| format!("`{one}`")).collect::<Vec<_>>().join(", ");
        Box::new(
            Diagnostic::without_place(codes::UNKNOWN_WORD, format!("there is no language `{code}`"))
                .help(format!("the languages are {list}")),
        )
    })
}

/// The formats to print; a user's own templates come alone unless a format is named.
fn formats(args: &DocsArgs) -> Vec<DocsFormat> {
    match (args.format.as_slice(), &args.templates) {
        ([], None) => vec![DocsFormat::Md],
        (formats, _) => formats.to_vec(),
    }
}

fn compile_all(args: &DocsArgs, report: &Report) -> Option<Vec<(String, System)>> {
    let systems: Vec<Option<(String, System)>> = if args.specs.is_empty() {
        SHIPPED
            .iter()
            .map(|(name, text)| Some((stem(Path::new(name)), shipped(name, text, report)?.0)))
            .collect()
    } else {
        args.specs.iter().map(|path| Some((stem(path), report.compile(path)?))).collect()
    };
    systems.into_iter().collect()
}

/// Why there are no templates.
pub(crate) enum Problem {
    /// A file or directory cannot be read.
    Unreadable(String),
    /// A template is wrong; the directory where the user's own lie.
    Template(TemplateError, Option<std::path::PathBuf>),
}

impl Problem {
    pub(crate) fn show(self, report: &Report) -> u8 {
        match self {
            Problem::Unreadable(message) => report.refuse(
                Diagnostic::without_place(codes::UNREADABLE, message)
                    .help("`odgen docs --export-templates DIR` writes templates to start from"),
            ),
            Problem::Template(error, _) if error.template.is_empty() => report.refuse(
                Diagnostic::without_place(codes::BAD_TEMPLATE, error.message)
                    .help("give the device another key, or the template of devices another extension"),
            ),
            Problem::Template(error, directory) => {
                let own =
                    directory.map(|directory| directory.join(&error.template)).filter(|path| path.exists());
                let name = own.map_or_else(
                    || format!("(built-in) {}", error.template),
                    |path| path.display().to_string(),
                );
                let mut sources = SourceMap::new();
                let file = sources.add(name, error.source);
                let mut diagnostics = Diagnostics::new();
                let span = sources.whole(file);
                let (start, end) = (error.range.start, error.range.end);
                diagnostics.push(
                    Diagnostic::new(codes::BAD_TEMPLATE, span.part(start, end.max(start + 1)), error.message)
                        .help("`odgen docs --dump-context` prints what templates see"),
                );
                report.show(&diagnostics, &sources);
                ERRORS
            }
        }
    }
}

/// The templates of each format, or of none, each with the user's own over them.
pub(crate) fn templates(formats: &[DocsFormat], own: Option<&Path>) -> Result<Vec<Templates>, Problem> {
    let files = own.map(read).transpose()?.unwrap_or_default();
    let wrong = |error| Problem::Template(error, own.map(Path::to_owned));
    if formats.is_empty() {
        return Ok(vec![Templates::new(None, &files).map_err(wrong)?]);
    }
    formats
        .iter()
        .map(|format| {
            // Of a user's files for several formats, those for this one.
            let format = docs_gen::Format::from(*format);
            let known: Vec<&str> = format.files().iter().filter_map(|(name, _)| extension(name)).collect();
            let several = formats.len() > 1;
            let fits = |name: &str| !several || extension(name).is_some_and(|one| known.contains(&one));
            let files: Vec<(String, String)> = files.iter().filter(|(name, _)| fits(name)).cloned().collect();
            Templates::new(Some(format), &files)
        })
        .collect::<Result<_, _>>()
        .map_err(wrong)
}

fn extension(name: &str) -> Option<&str> {
    name.rsplit_once('.').map(|(_, extension)| extension)
}

/// Name and text of the files of a directory.
fn read(directory: &Path) -> Result<Vec<(String, String)>, Problem> {
    let problem = |path: &Path, error: &dyn std::fmt::Display| {
        Problem::Unreadable(format!("cannot read {}: {error}", path.display()))
    };
    let mut files = Vec::new();
    for entry in fs::read_dir(directory).map_err(|error| problem(directory, &error))? {
        let path = entry.map_err(|error| problem(directory, &error))?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if path.is_file() && !name.starts_with('.') {
            let text = fs::read_to_string(&path).map_err(|error| problem(&path, &error))?;
            files.push((name, text));
        }
    }
    if files.is_empty() {
        return Err(Problem::Unreadable(format!("there are no templates in {}", directory.display())));
    }
    files.sort();
    Ok(files)
}

fn export(args: &DocsArgs, directory: &Path, report: &Report) -> u8 {
    let formats = if args.format.is_empty() { vec![DocsFormat::Md] } else { args.format.clone() };
    let files = formats.into_iter().flat_map(|format| docs_gen::Format::from(format).files());
    let set: Vec<Artifact> = files
        .map(|(name, text)| Artifact {
            path: (*name).to_owned(),
            bytes: text.as_bytes().to_vec(),
            purpose: "template".to_owned(),
        })
        .collect();
    write(directory, &set, report)
}

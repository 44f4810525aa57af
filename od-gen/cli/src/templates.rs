//! Templates of a format, with the user's own laid over them.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::ValueEnum;
use od_documents::{TemplateError, Templates};
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::file_name;
use od_spec::source::SourceMap;

use crate::exit::ERRORS;
use crate::limits::{self, Exceeded, Limits};
use crate::report::Report;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum DocsFormat {
    /// Markdown: a file per chapter, device and appendix
    Md,
    /// HTML: a file for the system and one per device, each complete in itself
    Html,
    /// HTML to be printed: a file for everything, with title, contents and page numbers
    Print,
}

impl From<DocsFormat> for od_documents::Format {
    fn from(format: DocsFormat) -> Self {
        match format {
            DocsFormat::Md => od_documents::Format::Markdown,
            DocsFormat::Html => od_documents::Format::Html,
            DocsFormat::Print => od_documents::Format::Print,
        }
    }
}

/// What a user's templates may take. The pages of a device with 100,000 entries need a tenth of it.
const LIMITS: Limits = Limits { memory: 2 << 30, time: Duration::from_secs(600) };

/// Prints pages with a user's own templates. If they take more than pages can need, the command ends with a message before anything is
/// written.
pub(crate) fn printed<T>(report: &Report, print: impl FnOnce() -> T) -> T {
    let exceeded = |limit| {
        let (message, help) = match limit {
            Exceeded::Memory => (
                format!("the templates take more than {} GiB of memory", LIMITS.memory >> 30),
                "look for a text or list that a loop or macro makes longer at every step",
            ),
            Exceeded::Time => (
                format!("the templates take more than {} minutes", LIMITS.time.as_secs() / 60),
                "look for a filter or test that works on a very long list, such as `[0] * 1000000000`",
            ),
        };
        std::process::exit(
            report.refuse(Diagnostic::without_place(codes::BAD_TEMPLATE, message).help(help)).into(),
        );
    };
    limits::limited(LIMITS, exceeded, print)
}

/// Why there are no templates.
pub(crate) enum Problem {
    /// A file or directory cannot be read.
    Unreadable(String),
    /// A template is wrong; the directory where the user's own lie.
    Template(TemplateError, Option<PathBuf>),
}

impl Problem {
    pub(crate) fn show(self, report: &Report) -> u8 {
        match self {
            Problem::Unreadable(message) => report.refuse(
                Diagnostic::without_place(codes::UNREADABLE, message)
                    .help("`odgen docs --export-templates DIR` writes templates to start from"),
            ),
            Problem::Template(error, directory) => {
                let message = error.to_string();
                let of_set =
                    |help| report.refuse(Diagnostic::without_place(codes::BAD_TEMPLATE, message).help(help));
                match error {
                    TemplateError::InTemplate { template, source, range, message } => {
                        let replaced = directory.map(|own| own.join(&template)).filter(|path| path.exists());
                        let name =
                            replaced.map_or_else(|| format!("(built-in) {template}"), file_name::shown);
                        let mut sources = SourceMap::new();
                        let file = sources.add(name, source);
                        let span = sources.whole(file).part(range.start, range.end.max(range.start + 1));
                        let mut diagnostics = Diagnostics::new();
                        diagnostics.push(
                            Diagnostic::new(codes::BAD_TEMPLATE, span, message)
                                .help("`odgen docs --dump-context` prints what templates see"),
                        );
                        report.show(&diagnostics, &sources);
                        ERRORS
                    }
                    TemplateError::NothingIsPrinted => {
                        of_set("name a template without `_` at its beginning: it is printed under its name")
                    }
                    TemplateError::SamePage(_) => {
                        of_set("give the device another key, or the template of devices another extension")
                    }
                }
            }
        }
    }
}

/// The templates of each format, or of none, each with those of the user's directory over them.
pub(crate) fn templates(formats: &[DocsFormat], directory: Option<&Path>) -> Result<Vec<Templates>, Problem> {
    let files = directory.map(read).transpose()?.unwrap_or_default();
    let wrong = |error| Problem::Template(error, directory.map(Path::to_owned));
    if formats.is_empty() {
        return Ok(vec![Templates::new(None, &files).map_err(wrong)?]);
    }
    formats
        .iter()
        .map(|format| {
            // Of a user's files for several formats, those for this one.
            let format = od_documents::Format::from(*format);
            let known: Vec<&str> = format.files().iter().filter_map(|(name, _)| extension(name)).collect();
            let several = formats.len() > 1;
            let fits =
                |name: &str| !several || extension(name).is_some_and(|extension| known.contains(&extension));
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
        Problem::Unreadable(format!("cannot read {}: {error}", file_name::shown(path)))
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
        return Err(Problem::Unreadable(format!(
            "there are no templates in {}",
            file_name::shown(directory)
        )));
    }
    files.sort();
    Ok(files)
}

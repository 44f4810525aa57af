//! `odgen import`: an EDS, a DCF or a table as a specification.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::Args;
use od_gen::Artifact;
use od_gen::files::Existing;
use od_gen::source::{compile_file, read_bytes};
use od_import::{Imported, import};
use od_spec::diag::{Diagnostic, codes};
use od_spec::file_name;
use od_spec::source::SourceMap;
use od_spec::visible::visible;
use od_table::{Assigned, Notation, assigned};

use crate::exit::ERRORS;
use crate::messages::Messages;
use crate::output::{clash, forced, save};
use crate::report::{Report, print, shown};
use crate::specs::stem;

#[derive(Debug, Args)]
pub(crate) struct ImportArgs {
    /// EDS, DCF, XDD or XDC files, or tables: .xlsx, .ods, .csv, .tsv, .html, .md, .txt with tabs
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,

    /// Directory for the specifications, each named like its file
    #[arg(long, short, default_value = ".", value_name = "DIR")]
    pub out: PathBuf,

    /// What the columns of a table hold, where its titles are not understood: `Index=A, Name=C, Type=4`
    #[arg(long, value_name = "COLUMNS", value_parser = columns)]
    pub columns: Option<Assigned>,

    /// Replace specifications that are there already
    #[arg(long)]
    pub force: bool,

    #[command(flatten)]
    pub messages: Messages,
}

pub(crate) fn run(args: &ImportArgs, report: &Report) -> u8 {
    let mut set = Vec::new();
    let mut summary = String::new();
    for path in &args.files {
        let made = match notation(path) {
            Some(notation) => table(path, notation, args.columns.as_ref(), report),
            None => one(path, report),
        };
        let Some((artifact, line)) = made else { return ERRORS };
        set.push(artifact);
        summary.push_str(&line);
    }
    if let Some(message) = clash(&set, "files") {
        return report.refuse(
            Diagnostic::without_place(codes::WRITE_FAILED, message)
                .help("import them into different directories, with `--out`"),
        );
    }
    match save(&args.out, &set, forced(args.force, Existing::None)) {
        Ok(_) => {
            if let [only] = set.as_slice() {
                let name = args.out.join(&only.path);
                let _ = writeln!(summary, "next: odgen build --rust --docs html {}", shown(&name));
            }
            print(&summary)
        }
        Err(diagnostic) => report.refuse(diagnostic),
    }
}

/// The columns of a command line.
fn columns(text: &str) -> Result<Assigned, String> {
    assigned(text).map_err(|part| {
        format!("`{part}` does not say what columns hold, as `Index=A, Sub=B, Name=C, Type=D, Access=5` does")
    })
}

/// How a file holds its tables, if it is named like one that does. A text may be an EDS all the same.
fn notation(path: &Path) -> Option<Notation> {
    let notation = Notation::of_extension(path.extension()?.to_str()?)?;
    let is_eds = notation == Notation::Document
        && read_bytes(path)
            .is_ok_and(|bytes| is_eds(&file_name::shown(path), &String::from_utf8_lossy(&bytes)));
    (!is_eds).then_some(notation)
}

/// Whether a text is that of an EDS, DCF, XDD or XDC.
fn is_eds(name: &str, text: &str) -> bool {
    od_spec::eds::is_eds(name, text) || od_spec::xdd::is_xdd(name, text)
}

/// The specification of a table, and what to say about it.
fn table(
    path: &Path,
    notation: Notation,
    columns: Option<&Assigned>,
    report: &Report,
) -> Option<(Artifact, String)> {
    let name = file_name::shown(path);
    let bytes = match read_bytes(path) {
        Ok(bytes) => bytes,
        Err(reason) => {
            let message = format!("cannot read {name}: {reason}");
            report.refuse(Diagnostic::without_place(codes::UNREADABLE, message).help("check the path"));
            return None;
        }
    };
    let mut sources = SourceMap::new();
    let title = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let imported = match od_table::import(&mut sources, &name, bytes, notation, columns, &title) {
        Ok(imported) => imported,
        Err(diagnostics) => {
            report.show(&diagnostics, &sources);
            return None;
        }
    };
    report.show_with(&imported.diagnostics, &sources, "the specification");
    let name = format!("{title}.od.yaml");
    let written = imported.specification;
    let mut line = described(&name, imported.objects);
    for (count, what, how) in [
        (imported.asked, "cell", "not understood (see the comments)"),
        (written.allowed.len(), "rule", "broken (see `allow:`)"),
        (written.repairs.len(), "fact", "changed, as the language takes no other (see the comments)"),
    ] {
        more(&mut line, count, what, how);
    }
    line.push('\n');
    let artifact = Artifact { path: name, bytes: written.text.into_bytes(), purpose: String::new() };
    Some((artifact, line))
}

/// The specification of one file, and what to say about it.
fn one(path: &Path, report: &Report) -> Option<(Artifact, String)> {
    let mut sources = SourceMap::new();
    let mut loader = report.loader();
    let compiled = compile_file(path, &mut sources, &mut loader);
    let root = sources.files().next().map(|(id, _)| id);
    let eds = root.filter(|root| {
        let file = sources.file(*root);
        is_eds(file.name(), file.text())
    });
    let Some(root) = eds else {
        if compiled.diagnostics.has_errors() {
            report.show(&compiled.diagnostics, &sources);
        } else {
            let message = format!("{} is no EDS, DCF, XDD or XDC", file_name::shown(path));
            report.refuse(
                Diagnostic::without_place(codes::UNREADABLE, message)
                    .help("import takes EDS, DCF, XDD and XDC files, and tables such as .xlsx and .csv"),
            );
        }
        return None;
    };
    let imported = match import(&compiled, &sources, root)? {
        Ok(imported) => imported,
        Err(diagnostics) => {
            report.show(&diagnostics, &sources);
            return None;
        }
    };
    let objects =
        compiled.system.as_ref().map_or(0, |system| system.devices.iter().map(|one| one.objects.len()).sum());
    let name = format!("{}.od.yaml", stem(path));
    let line = describe(&name, objects, &imported);
    let artifact = Artifact { path: name, bytes: imported.text.into_bytes(), purpose: String::new() };
    Some((artifact, line))
}

/// `drive.od.yaml: 412 objects; 1 rule broken (see allow:)`.
fn describe(name: &str, objects: usize, imported: &Imported) -> String {
    let mut line = described(name, objects);
    for (count, what, how) in [
        (imported.allowed.len(), "rule", "broken (see `allow:`)"),
        (imported.repairs.len(), "fact", "changed, as the language takes no other (see the comments)"),
        (imported.without_place, "fact", "without a place in a specification (see the end)"),
    ] {
        more(&mut line, count, what, how);
    }
    line.push('\n');
    line
}

/// `drive.od.yaml: 412 objects`.
fn described(name: &str, objects: usize) -> String {
    format!("{}: {}", visible(name), counted(objects, "object"))
}

/// Adds what happened to so many, if there are any.
fn more(line: &mut String, count: usize, what: &str, how: &str) {
    if count > 0 {
        let _ = write!(line, "; {} {how}", counted(count, what));
    }
}

fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

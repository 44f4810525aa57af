//! `odgen import`: an EDS or DCF as a specification.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::Args;
use od_gen::Artifact;
use od_gen::files::Existing;
use od_gen::source::compile_file;
use od_import::{Imported, import};
use od_spec::diag::{Diagnostic, codes};
use od_spec::file_name;
use od_spec::source::SourceMap;
use od_spec::visible::visible;

use crate::exit::ERRORS;
use crate::messages::Messages;
use crate::output::{clash, forced, save};
use crate::report::{Report, print, shown};
use crate::specs::stem;

#[derive(Debug, Args)]
pub(crate) struct ImportArgs {
    /// EDS, DCF, XDD or XDC files
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,

    /// Directory for the specifications, each named like its file
    #[arg(long, short, default_value = ".", value_name = "DIR")]
    pub out: PathBuf,

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
        let Some((artifact, line)) = one(path, report) else { return ERRORS };
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

/// The specification of one file, and what to say about it.
fn one(path: &Path, report: &Report) -> Option<(Artifact, String)> {
    let mut sources = SourceMap::new();
    let mut loader = report.loader();
    let compiled = compile_file(path, &mut sources, &mut loader);
    let root = sources.files().next().map(|(id, _)| id);
    let eds = root.filter(|root| {
        let file = sources.file(*root);
        od_spec::eds::is_eds(file.name(), file.text()) || od_spec::xdd::is_xdd(file.name(), file.text())
    });
    let Some(root) = eds else {
        if compiled.diagnostics.has_errors() {
            report.show(&compiled.diagnostics, &sources);
        } else {
            let message = format!("{} is no EDS, DCF, XDD or XDC", file_name::shown(path));
            report.refuse(
                Diagnostic::without_place(codes::UNREADABLE, message)
                    .help("import takes EDS, DCF, XDD and XDC files"),
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
    let counted = |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    let mut line = format!("{}: {}", visible(name), counted(objects, "object"));
    for (count, what, how) in [
        (imported.allowed.len(), "rule", "broken (see `allow:`)"),
        (imported.repairs.len(), "fact", "changed, as the language takes no other (see the comments)"),
        (imported.without_place, "fact", "without a place in a specification (see the end)"),
    ] {
        if count > 0 {
            let _ = write!(line, "; {} {how}", counted(count, what));
        }
    }
    line.push('\n');
    line
}

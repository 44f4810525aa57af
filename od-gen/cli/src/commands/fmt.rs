//! `odgen fmt`.

use std::path::{Path, PathBuf};

use clap::Args;
use od_gen::files::replace;
use od_gen::source::{open, read_input};
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::layout;
use od_spec::source::SourceMap;

use crate::exit::{ERRORS, SUCCESS};
use crate::messages::Messages;
use crate::output::not_written;
use crate::report::{Report, print_file, shown};
use crate::specs;

#[derive(Debug, Args)]
pub(crate) struct FmtArgs {
    /// Specifications, their parts and libraries; `-` reads one and prints it [default: the `*.od.yaml` of the current directory]
    #[arg(value_name = "FILE")]
    pub files: Vec<PathBuf>,

    /// Change nothing; name the files that are laid out differently, and fail if there is one
    #[arg(long)]
    pub check: bool,

    #[command(flatten)]
    pub messages: Messages,
}

pub(crate) fn run(args: &FmtArgs, directory: &Path, report: &Report) -> u8 {
    if args.files.iter().any(|path| path.as_os_str() == "-") {
        return standard_input(args, report);
    }
    let files = match specs::files(&args.files, directory, report) {
        Ok(files) => files,
        Err(code) => return code,
    };
    let mut changed: Vec<(PathBuf, Vec<u8>)> = Vec::new();
    let mut code = SUCCESS;
    for path in &files {
        match laid_out(path) {
            Ok(Some(text)) => changed.push((path.clone(), text.into_bytes())),
            Ok(None) => {}
            Err((diagnostics, sources)) => {
                report.show(&diagnostics, &sources);
                code = ERRORS;
            }
        }
    }
    // All or nothing: a file that cannot be laid out keeps the others as they are, too.
    if code != SUCCESS {
        if files.len() > 1 {
            report.note("no file was changed");
        }
        return code;
    }
    if !args.check
        && let Err(error) = replace(&changed)
    {
        return report.refuse(not_written(&error));
    }
    for (path, _) in &changed {
        let what = if args.check { "is laid out otherwise" } else { "was laid out" };
        report.note(&format!("{} {what}", shown(path)));
    }
    match (args.check, changed.len()) {
        (_, 0) => report.note(&format!("{} as it should be", files_in_words(files.len()))),
        (true, _) => {
            report.note("`odgen fmt` changes them");
            return ERRORS;
        }
        (false, _) => {}
    }
    SUCCESS
}

fn files_in_words(count: usize) -> String {
    if count == 1 { "1 file is".to_owned() } else { format!("{count} files are") }
}

type Refused = (Diagnostics, Box<SourceMap>);

fn refused(diagnostic: Diagnostic, sources: SourceMap) -> Refused {
    let mut diagnostics = Diagnostics::new();
    diagnostics.push(diagnostic);
    (diagnostics, Box::new(sources))
}

/// The text of a file in its layout; `None` where it has it already.
fn laid_out(path: &Path) -> Result<Option<String>, Refused> {
    let mut sources = SourceMap::new();
    let file = match open(path, "check the name of the file", &mut sources) {
        Ok(file) => sources.file(file),
        Err(diagnostic) => return Err(refused(*diagnostic, sources)),
    };
    let text = layout(file.name(), file.text().to_owned())?;
    Ok((text != file.text()).then_some(text))
}

/// For editors: what comes in goes out in its layout.
fn standard_input(args: &FmtArgs, report: &Report) -> u8 {
    if let [_, _, ..] = args.files.as_slice() {
        let message = "`-` means standard input, and is used alone";
        return report
            .refuse(Diagnostic::without_place(codes::UNKNOWN_WORD, message).help("name `-`, or files"));
    }
    let unreadable = |reason: &str| {
        Diagnostic::without_place(codes::UNREADABLE, format!("cannot read standard input: {reason}"))
            .help("give a specification as UTF-8 text")
    };
    let text = match read_input(std::io::stdin().lock()).map(String::from_utf8) {
        Ok(Ok(text)) => text,
        Ok(Err(_)) => return report.refuse(unreadable("it is not UTF-8")),
        Err(error) => return report.refuse(unreadable(&error.to_string())),
    };
    match layout("<stdin>", text.clone()) {
        Ok(new) if args.check && new != text => {
            report.note("standard input is laid out otherwise");
            ERRORS
        }
        Ok(_) if args.check => SUCCESS,
        Ok(new) => print_file(&new),
        Err((diagnostics, sources)) => {
            report.show(&diagnostics, &sources);
            ERRORS
        }
    }
}

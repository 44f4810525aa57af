//! Printed manuals as PDF, by WeasyPrint.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use od_spec::diag::{Diagnostic, codes};
use od_spec::file_name;

use crate::exit::SUCCESS;
use crate::report::{Report, print};

/// The program, and the standard for readers with a screen reader that its PDF follow: tags, titles and languages.
const PROGRAM: &str = "weasyprint";
const STANDARD: &str = "pdf/ua-1";

/// Makes a PDF next to each manual.
pub(crate) fn make(manuals: &mut dyn Iterator<Item = PathBuf>, report: &Report) -> u8 {
    for manual in manuals {
        let pdf = manual.with_extension("pdf");
        if let Err(problem) = run(&manual, &pdf) {
            return report.refuse(problem);
        }
        print(&format!("{}\n", file_name::shown(&pdf)));
    }
    SUCCESS
}

fn run(manual: &Path, pdf: &Path) -> Result<(), Diagnostic> {
    let run = Command::new(PROGRAM)
        .args(["--pdf-variant", STANDARD, "--quiet"])
        .args([manual, pdf])
        .stdin(Stdio::null())
        .output();
    let shown = file_name::shown(pdf);
    let failed = |why: String| Diagnostic::without_place(codes::WRITE_FAILED, why);
    match run {
        Ok(output) if output.status.success() => Ok(()),
        Ok(output) => {
            let said = String::from_utf8_lossy(&output.stderr);
            let last = said.lines().last().unwrap_or("it gave no reason").trim();
            Err(failed(format!("WeasyPrint cannot make {shown}: {last}"))
                .help("WeasyPrint 63 or later is needed: `pip install weasyprint`"))
        }
        Err(error) if error.kind() == ErrorKind::NotFound => {
            Err(failed("WeasyPrint, which makes the PDF, is not installed".to_owned())
                .help("install it: `pip install weasyprint`; or print manual.html with a browser"))
        }
        Err(error) => Err(failed(format!("cannot run WeasyPrint: {error}"))),
    }
}

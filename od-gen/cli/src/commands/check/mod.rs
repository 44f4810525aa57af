//! `odgen check`: specifications, EDS and DCF files, as many as there are.

mod args;
mod checked;
mod format;
mod inputs;
mod policy;
mod summary;

use std::path::Path;

use od_formats::findings::{Findings, sarif};
use od_reference::explanation;

use self::checked::{Checked, check};
use self::inputs::Input;
use self::policy::Policy;
use self::summary::Total;
use crate::exit::{ERRORS, SUCCESS};
use crate::messages::Format;
use crate::parallel;
use crate::progress::Progress;
use crate::report::{Report, print, print_json};
pub(crate) use args::{CheckArgs, CheckFormat};

/// Checks; `format` is how messages are written where the command line says so before the command.
pub(crate) fn run(args: &CheckArgs, format: Option<Format>, directory: &Path, report: &Report) -> u8 {
    let format = args.format.or(format.map(CheckFormat::from)).unwrap_or(CheckFormat::Human);
    let policy = match Policy::of(args) {
        Ok(policy) => policy,
        Err(diagnostic) => return report.refuse(*diagnostic),
    };
    let inputs = match inputs::gather(args, format, directory, report) {
        Ok(inputs) => inputs,
        Err(code) => return code,
    };
    let mut progress = Progress::new("checked", "files", inputs.len(), format.audience());
    let (mut total, mut document, mut written) = (Total::default(), Vec::new(), SUCCESS);
    // Printing frames takes longer than finding what they show: that is work for all cores, too.
    let work = |input: &Input| {
        let checked = check(input, args, &policy, report);
        let text = format::of_file(&checked, format, args, report.colour());
        (checked, text)
    };
    parallel::in_order(&inputs, work, |finished, results| {
        for (checked, text) in results {
            progress.clear();
            match format {
                CheckFormat::Human => {
                    report.write(&text);
                    report.write(&summary::of_file(&checked, inputs.len()).unwrap_or_default());
                }
                CheckFormat::Short | CheckFormat::Json => report.write(&text),
                CheckFormat::Github => written = written.max(print(&text)),
                CheckFormat::Sarif => {}
            }
            total.add(&checked);
            if format == CheckFormat::Sarif {
                document.push(checked);
            }
        }
        progress.show(finished);
    });
    progress.clear();
    match format {
        CheckFormat::Human => report.write(&total.text()),
        CheckFormat::Sarif => {
            let findings: Vec<Findings<'_>> = document.iter().map(Checked::findings).collect();
            written =
                written.max(print_json(sarif(env!("CARGO_PKG_VERSION"), explanation, &findings).as_bytes()));
        }
        CheckFormat::Short | CheckFormat::Json | CheckFormat::Github => {}
    }
    if total.has_errors() { ERRORS } else { written }
}

//! Settings of `odgen dcf`, from files and from the command line.

use std::path::Path;

use od_gen::source::open;
use od_spec::diag::Diagnostic;
use od_spec::source::{SourceMap, Spanned};

use super::args::DcfArgs;

/// All settings, those of files first, each with its place.
pub(crate) fn settings(
    args: &DcfArgs,
    sources: &mut SourceMap,
) -> Result<Vec<Spanned<String>>, Box<Diagnostic>> {
    let mut settings = Vec::new();
    for path in &args.set_file {
        settings.extend(of_file(path, sources)?);
    }
    settings.extend(args.settings.iter().map(|setting| {
        let id = sources.add("--set", setting.as_str());
        Spanned::new(setting.clone(), sources.whole(id))
    }));
    Ok(settings)
}

/// One setting on each line. Behind a value there is no comment: it would be a part of a text.
fn of_file(path: &Path, sources: &mut SourceMap) -> Result<Vec<Spanned<String>>, Box<Diagnostic>> {
    let help = "check the path; a file of settings has one `ENTRY=VALUE` on each line";
    let id = open(path, help, sources)?;
    let (whole, text) = (sources.whole(id), sources.file(id).text());
    let mut settings = Vec::new();
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let end = start + line.trim_end_matches(['\n', '\r']).len();
        let begin = start + (line.len() - line.trim_start().len());
        let setting = text.get(begin..end).unwrap_or_default();
        if !setting.is_empty() && !setting.starts_with('#') {
            settings.push(Spanned::new(setting.to_owned(), whole.part(begin, end)));
        }
        start += line.len();
    }
    Ok(settings)
}

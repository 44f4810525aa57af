//! `odgen fix`.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::fs;
use std::ops::Range;
use std::path::PathBuf;

use clap::Args;
use od_gen::files::replace;
use od_lsp::line_diff::line_diff;
use od_spec::diag::{Code, Diagnostic, codes};
use od_spec::eds::Document;
use od_spec::file_name;
use od_spec::source::SourceMap;
use od_spec::visible::visible;
use od_spec::{Fixed, add_source, fix};
use similar::{ChangeTag, DiffOp, group_diff_ops};

use crate::exit::{ERRORS, SUCCESS};
use crate::messages::Messages;
use crate::output::not_written;
use crate::report::{Report, print};

#[derive(Debug, Args)]
pub(crate) struct FixArgs {
    /// EDS or DCF files
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,

    /// Print what changes, as a unified diff with the codes of what it fixes [default, unless --write is given]
    #[arg(long)]
    pub diff: bool,

    /// Change the files
    #[arg(long)]
    pub write: bool,

    #[command(flatten)]
    pub messages: Messages,
}

/// Lines around a change.
const CONTEXT: usize = 3;

pub(crate) fn run(args: &FixArgs, report: &Report) -> u8 {
    let mut files = Vec::new();
    for path in &args.files {
        match read(path) {
            Ok(file) => files.push(file),
            Err(diagnostic) => return report.refuse(*diagnostic),
        }
    }
    if args.write {
        let set: Vec<(PathBuf, Vec<u8>)> =
            files.iter().map(|file| (PathBuf::from(&file.name), file.fixed.to_bytes())).collect();
        if let Err(error) = replace(&set) {
            return report.refuse(not_written(&error));
        }
    }
    for file in &files {
        if (args.diff || !args.write) && print(&file.diff()) != SUCCESS {
            return ERRORS;
        }
        file.report(args.write, report);
    }
    SUCCESS
}

/// A file with what becomes of it.
struct File {
    name: String,
    old: String,
    fixed: Fixed,
}

fn read(path: &PathBuf) -> Result<File, Box<Diagnostic>> {
    let shown = file_name::shown(path);
    let refuse = |message: String, help: &str| {
        Box::new(Diagnostic::without_place(codes::UNREADABLE, message).help(help))
    };
    let bytes = fs::read(path)
        .map_err(|error| refuse(format!("cannot read `{shown}`: {error}"), "check name and permissions"))?;
    if path.to_str().is_none() {
        return Err(refuse(format!("`{shown}` has a name that is not UTF-8"), "rename the file"));
    }
    let mut sources = SourceMap::new();
    let file = add_source(&mut sources, &shown, bytes.clone())?;
    let old = sources.file(file).text();
    if Document::scan(file, old).sections().next().is_none() {
        return Err(refuse(format!("`{shown}` has no section, it is no EDS or DCF"), "name an EDS or DCF"));
    }
    Ok(File { old: old.to_owned(), fixed: fix(&shown, &bytes)?, name: shown })
}

impl File {
    /// What changes, each part with the codes of what it fixes.
    fn diff(&self) -> String {
        let text = self.fixed.text();
        let (old, new): (Vec<&str>, Vec<&str>) =
            (self.old.split_inclusive('\n').collect(), text.split_inclusive('\n').collect());
        let changed = self.changed_lines();
        let mut out = String::new();
        for group in group_diff_ops(line_diff(&old, &new), CONTEXT) {
            if out.is_empty() {
                let _ = write!(out, "--- {0}\n+++ {0}\n", visible(&self.name));
            }
            let (Some(first), Some(last)) = (group.first(), group.last()) else { continue };
            let (old_range, new_range) = (
                first.old_range().start..last.old_range().end,
                first.new_range().start..last.new_range().end,
            );
            let codes: Vec<String> =
                codes_of(&changed, &new_range).iter().map(|code| format!(" {code}")).collect();
            let _ = writeln!(out, "@@ -{} +{} @@{}", hunk(&old_range), hunk(&new_range), codes.concat());
            for op in &group {
                print_lines(op, &old, &new, &mut out);
            }
        }
        out
    }

    /// The line of the new text in which each change begins, ascending.
    fn changed_lines(&self) -> Vec<(usize, &'static Code)> {
        let text = self.fixed.text();
        let starts: Vec<usize> =
            std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1)).collect();
        let last = text.lines().count().saturating_sub(1);
        let line = |at: usize| starts.partition_point(|start| *start <= at).saturating_sub(1).min(last);
        self.fixed.changes.iter().map(|change| (line(change.place.start), change.code)).collect()
    }

    /// Reports what was fixed, and what the user has to decide.
    fn report(&self, written: bool, report: &Report) {
        let mut left = self.fixed.left.clone();
        left.soften();
        let decisions = left.clone().without_notes();
        report.show(&decisions, &self.fixed.sources);
        report.note(&self.summary(written));
        let notes = left.iter().count() - decisions.iter().count();
        if notes > 0 {
            let (plural, them) = if notes == 1 { ("", "it") } else { ("s", "them") };
            report.note(&format!(
                "{0}: {notes} note{plural}, `odgen check {0} --notes` shows {them}",
                visible(&self.name)
            ));
        }
    }

    fn summary(&self, written: bool) -> String {
        let counts = self.fixed.counts();
        if counts.is_empty() {
            return format!("{}: there is nothing to fix without guessing", visible(&self.name));
        }
        let places = self.fixed.changes.len();
        let (plural, would) = match (places, written) {
            (1, true) => ("", "was"),
            (1, false) => ("", "would be"),
            (_, true) => ("s", "were"),
            (_, false) => ("s", "would be"),
        };
        let mut text = format!("{}: {places} place{plural} {would} fixed", visible(&self.name));
        for (code, count) in counts {
            let _ = write!(text, "\n  {count:>5}  {code}  {}", code.title);
        }
        if !written {
            text.push_str("\n`--write` changes the file");
        }
        text
    }
}

/// `3,7`: the first line, from 1, and how many.
fn hunk(lines: &Range<usize>) -> String {
    let first = if lines.is_empty() { lines.start } else { lines.start + 1 };
    format!("{first},{}", lines.len())
}

/// The lines of a step, each with its sign.
fn print_lines(op: &DiffOp, old: &[&str], new: &[&str], out: &mut String) {
    for change in op.iter_changes(old, new) {
        let sign = match change.tag() {
            ChangeTag::Equal => ' ',
            ChangeTag::Delete => '-',
            ChangeTag::Insert => '+',
        };
        let line: &str = change.value();
        let end = if line.ends_with('\n') { "" } else { "\n\\ No newline at end of file\n" };
        let _ = write!(out, "{sign}{line}{end}");
    }
}

/// The codes of the changes in some lines.
fn codes_of(changed: &[(usize, &'static Code)], lines: &Range<usize>) -> BTreeSet<&'static Code> {
    // Lines that are only taken out leave a change at the line after them.
    let end = lines.end.max(lines.start + 1);
    let from = changed.partition_point(|(line, _)| *line < lines.start);
    let to = changed.partition_point(|(line, _)| *line < end);
    changed.get(from..to).unwrap_or_default().iter().map(|(_, code)| *code).collect()
}

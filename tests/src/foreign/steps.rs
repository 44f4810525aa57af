//! The steps that a file is taken through.

use std::path::Path;

use od_formats::eds::write_eds;
use od_import::{Imported, import};
use od_spec::diag::{Diagnostic, Diagnostics, Severity};
use od_spec::eds::Document;
use od_spec::encoding::encode;
use od_spec::model::{Dictionary, System};
use od_spec::source::{FileId, SourceMap, Span};
use od_spec::{Compiled, NoFiles, Strictness, add_source, compile, compile_as, fix};

use super::comparing;
use super::exceptions::except;
use super::files::is_xdd;
use super::{Checked, Findings, Step, differences};

pub(super) fn run(step: Step, name: &str, bytes: &[u8], checked: &mut Checked) {
    let outcome = match step {
        Step::Bytes => bytes_stay(name, bytes, checked),
        Step::Reading => reading(name, bytes, checked),
        Step::Import => facts_stay(name, bytes, checked),
        Step::Again => import_again(name, bytes),
        Step::Fixing => fixing(name, bytes, checked),
        Step::Comparing => comparing(name, bytes, checked),
    };
    if let Err(what) = outcome {
        checked.problem(step, what);
    }
}

/// A file that was read.
struct Source {
    sources: SourceMap,
    root: FileId,
}

fn source(name: &str, bytes: &[u8]) -> Result<Source, String> {
    let mut sources = SourceMap::new();
    let root = add_source(&mut sources, name, bytes.to_vec()).map_err(|refused| first_line(&refused))?;
    Ok(Source { sources, root })
}

fn first_line(diagnostic: &Diagnostic) -> String {
    format!("{} ({})", diagnostic.message, diagnostic.code.id)
}

fn bytes_stay(name: &str, bytes: &[u8], checked: &mut Checked) -> Result<(), String> {
    let Source { sources, root } = source(name, bytes)?;
    let file = sources.file(root);
    let printed = Document::scan(root, file.text()).to_string();
    if printed != file.text() {
        checked.problem(Step::Bytes, "the printed lines are another text");
    }
    match encode(&printed, file.encoding()) {
        Ok(again) if again == bytes => Ok(()),
        Ok(again) => {
            let at = again.iter().zip(bytes).take_while(|(one, other)| one == other).count();
            Err(format!("another byte at {at}, as {}", file.encoding()))
        }
        Err(character) => Err(format!("{} does not have {character:?}", file.encoding())),
    }
}

fn reading(name: &str, bytes: &[u8], checked: &mut Checked) -> Result<(), String> {
    let Source { mut sources, root } = source(name, bytes)?;
    let foreign = compile(&mut sources, root, &mut NoFiles);
    let strict = compile_as(Strictness::Standard, &mut sources, root, &mut NoFiles);
    let of = |severity| strict.diagnostics.iter().filter(|one| one.severity() == severity).count();
    checked.findings =
        Findings { errors: of(Severity::Error), warnings: of(Severity::Warning), notes: of(Severity::Note) };
    for diagnostic in foreign.diagnostics.iter().chain(&strict.diagnostics) {
        if let Some(what) = misplaced(&sources, diagnostic) {
            checked.problem(Step::Reading, what);
        }
    }
    device(&foreign).map(|_| ())
}

/// The first place of a message that is not in its text.
fn misplaced(sources: &SourceMap, diagnostic: &Diagnostic) -> Option<String> {
    let is_outside = |span: &Span| {
        let text = sources.file(span.file).text();
        text.get(span.start as usize..span.end as usize).is_none()
    };
    let labels = diagnostic.labels.iter().map(|label| label.span);
    let span = labels.chain(diagnostic.edits.iter().map(|edit| edit.span)).find(is_outside)?;
    Some(format!("{} to {} is no place in the text: {}", span.start, span.end, first_line(diagnostic)))
}

fn device(compiled: &Compiled) -> Result<&Dictionary, String> {
    let device = compiled.system.as_ref().and_then(|system| system.devices.first());
    device.ok_or_else(|| {
        let errors = compiled.diagnostics.iter().filter(|one| one.severity() == Severity::Error);
        let errors: Vec<String> = errors.map(first_line).take(3).collect();
        format!("no model: {}", errors.join("; "))
    })
}

/// A file as a specification, and that specification as an EDS.
struct Turned {
    original: System,
    imported: Imported,
    eds: Vec<u8>,
}

fn turn(name: &str, bytes: &[u8]) -> Result<Turned, String> {
    let Source { mut sources, root } = source(name, bytes)?;
    let compiled = compile(&mut sources, root, &mut NoFiles);
    let imported = import(&compiled, &sources, root).ok_or("no model to import")?.map_err(|refused| {
        let errors: Vec<String> = refused.iter().map(first_line).take(3).collect();
        format!("cannot be imported: {}", errors.join("; "))
    })?;
    let mut written = SourceMap::new();
    let text = written.add("import.od.yaml", imported.text.as_str());
    let specification = compile(&mut written, text, &mut NoFiles);
    let system = specification.system.as_ref().ok_or_else(|| reported(&specification.diagnostics))?;
    let eds = write_eds(system, device(&specification)?);
    let original = compiled.system.ok_or("no model")?;
    Ok(Turned { original, imported, eds })
}

fn reported(diagnostics: &Diagnostics) -> String {
    let lines: Vec<String> = diagnostics.iter().map(first_line).take(3).collect();
    format!("the import does not compile: {}", lines.join("; "))
}

fn facts_stay(name: &str, bytes: &[u8], checked: &mut Checked) -> Result<(), String> {
    let Turned { original, imported, eds } = turn(name, bytes)?;
    let Source { mut sources, root } = source("again.eds", &eds)?;
    let again = compile(&mut sources, root, &mut NoFiles);
    let before = original.devices.first().ok_or("no device")?;
    let found = differences(before, device(&again)?);
    except(&imported.repairs, before, found, checked);
    Ok(())
}

fn import_again(name: &str, bytes: &[u8]) -> Result<(), String> {
    // What the libraries say about an object comes with the first import, and what its EDS says of that with the second.
    let first = turn(name, bytes)?;
    let of_xdd = is_xdd(name).then(|| Path::new(name).with_extension("eds").to_string_lossy().into_owned());
    let name = of_xdd.as_deref().unwrap_or(name);
    let second = turn(name, &first.eds)?;
    let third = turn(name, &second.eds)?;
    match other_line(&second.imported.text, &third.imported.text) {
        Some(what) => Err(what),
        None => Ok(()),
    }
}

/// The first line that two specifications have otherwise, without comments: those speak of the original.
fn other_line(one: &str, other: &str) -> Option<String> {
    let lines = |text: &str| -> Vec<String> {
        let said = text.lines().filter(|line| !line.trim_start().starts_with('#') && !line.trim().is_empty());
        said.map(ToOwned::to_owned).collect()
    };
    let (one, other) = (lines(one), lines(other));
    let at = (0..one.len().max(other.len())).find(|&at| one.get(at) != other.get(at))?;
    let line = |lines: &[String]| lines.get(at).map_or("nothing", |line| line.trim()).to_owned();
    Some(format!("first `{}`, then `{}`", line(&one), line(&other)))
}

fn fixing(name: &str, bytes: &[u8], checked: &mut Checked) -> Result<(), String> {
    let fixed = fix(name, bytes).map_err(|refused| first_line(&refused))?;
    checked.changes = fixed.changes.len();
    let put_right = fixed.to_bytes();
    let again = fix(name, &put_right).map_err(|refused| first_line(&refused))?;
    if !again.changes.is_empty() || again.to_bytes() != put_right {
        let codes: Vec<&str> = again.counts().into_keys().map(|code| code.id).collect();
        checked.problem(Step::Fixing, format!("a second time changes more: {}", codes.join(", ")));
    }
    let (before, after) = (source(name, bytes)?, source(name, &put_right)?);
    let errors = |mut source: Source| {
        let strict = compile_as(Strictness::Standard, &mut source.sources, source.root, &mut NoFiles);
        strict.diagnostics.count().0
    };
    let model = |mut source: Source| compile(&mut source.sources, source.root, &mut NoFiles);
    let (had, has) = (errors(source(name, bytes)?), errors(source(name, &put_right)?));
    if has > had {
        checked.problem(Step::Fixing, format!("{had} errors before, {has} after"));
    }
    let (before, after) = (model(before), model(after));
    for difference in differences(device(&before)?, device(&after)?) {
        checked.problem(Step::Fixing, difference.to_string());
    }
    Ok(())
}

fn comparing(name: &str, bytes: &[u8], checked: &mut Checked) -> Result<(), String> {
    let Source { sources, root } = source(name, bytes)?;
    for what in comparing::run(name, sources.file(root).text())? {
        checked.problem(Step::Comparing, what);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use od_spec::rule_codes;

    use super::*;

    #[test]
    fn a_place_outside_the_text_is_found() {
        let Source { sources, root } = source("lamp.eds", "[é]\n".as_bytes()).unwrap();
        let at = |start, end| Span { file: root, start, end };
        let said = |label: Span, edit: Span| {
            let diagnostic = Diagnostic::new(rule_codes::DUPLICATE_NAME, label, "twice").edit(edit, "x");
            misplaced(&sources, &diagnostic)
        };
        assert_eq!(said(at(0, 5), at(1, 3)), None);
        assert!(said(at(0, 6), at(1, 3)).unwrap().starts_with("0 to 6 is no place in the text: twice"));
        assert!(said(at(0, 5), at(2, 3)).unwrap().starts_with("2 to 3"));
    }

    #[test]
    fn specifications_differ_in_what_is_no_comment() {
        assert_eq!(other_line("a: 1\n# one\n\nb: 2\n", "a: 1\n  # two\nb: 2\n"), None);
        assert_eq!(other_line("a: 1\n  b: 2\n", "a: 1\n"), Some("first `b: 2`, then `nothing`".to_owned()));
    }

    /// Each step reports what it cannot do.
    #[test]
    fn what_cannot_be_read_is_a_problem() {
        let large = vec![b' '; (64 << 20) + 1];
        let mut checked = Checked::default();
        run(Step::Reading, "lamp.eds", &large, &mut checked);
        assert!(!checked.passed(Step::Reading));
        let reported = turn("lamp.yaml", b"od-spec: 1\n").err();
        assert!(reported.is_some_and(|reported| reported.starts_with("no model")));
    }
}

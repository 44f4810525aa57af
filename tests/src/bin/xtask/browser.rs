//! The documents in a browser.

use docs_gen as docs;
use od_formats::json;
use od_gen::Artifact;
use od_gen::files::write_all;
use od_tests::generate::SPECS;
use od_tests::{Failure, compile_clean, root};

use crate::hostile;
use crate::runner::Runner;

/// The documents as their readers see them.
pub(crate) fn read_documents(runner: &mut Runner) -> Result<(), Failure> {
    const DOCS: &str = "target/browser/docs";
    let mut directories = Vec::new();
    let specs = SPECS.iter().map(|stem| (*stem, format!("od-spec/devices/{stem}.od.yaml"), "en"));
    let more = [
        ("fullmo-drive-de", "od-spec/devices/fullmo-drive.od.yaml", "de"),
        ("pitch-control-system-de", "od-spec/devices/pitch-control-system.od.yaml", "de"),
        ("everything", "tests/readers/everything.od.yaml", "en"),
        ("two", "tests/docs/two.od.yaml", "en"),
        ("two-de", "tests/docs/two.od.yaml", "de"),
    ];
    for (stem, path, language) in specs.chain(more.map(|(stem, path, lang)| (stem, path.to_owned(), lang))) {
        let system = compile_clean(&path)?;
        let mut options = docs::options(&system, &[], Some(language));
        // The German texts of this one are many: they are searched, and its facts are compared in English.
        let is_compared = stem != "pitch-control-system-de";
        let html = [docs::Templates::new(Some(docs::Format::Html), &[])?];
        let mut set = docs::artifacts(&system, "", stem, &options, &html)?;
        if !is_compared {
            write_all(&root().join(DOCS), &set)?;
            directories.push(format!("{DOCS}/{stem}"));
            continue;
        }
        let beside = [("dump", json::dump(&system, &[])), ("context", docs::dump_context(&system, &options))];
        set.extend(beside.map(|(name, bytes)| Artifact {
            path: format!("{stem}/{name}.json"),
            bytes,
            purpose: String::new(),
        }));
        let example = [docs::Templates::new(None, &example()?)?];
        set.extend(docs::artifacts(&system, "", &format!("{stem}-asciidoc"), &options, &example)?);
        // With everything that paper can show.
        options.errata = true;
        let print = [docs::Templates::new(Some(docs::Format::Print), &[])?];
        set.extend(docs::artifacts(&system, "", &format!("{stem}-print"), &options, &print)?);
        write_all(&root().join(DOCS), &set)?;
        directories.extend(["", "-asciidoc", "-print"].map(|kind| format!("{DOCS}/{stem}{kind}")));
    }
    directories.extend(hostile::documents(DOCS)?);
    let directories: Vec<&str> = directories.iter().map(String::as_str).collect();
    runner.python("tests/browser/run.py", &directories)
}

/// The templates of the AsciiDoc example.
fn example() -> Result<Vec<(String, String)>, Failure> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(root().join("docs-gen/examples/asciidoc"))? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        files.push((name, std::fs::read_to_string(path)?));
    }
    files.sort();
    Ok(files)
}

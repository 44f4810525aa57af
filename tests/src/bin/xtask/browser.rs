//! The documents in a browser.

use od_documents as docs;
use od_formats::json;
use od_gen::Artifact;
use od_gen::files::write_all;
use od_tests::{Failure, compile_clean, root};

use crate::hostile;
use crate::parts::Amount;
use crate::runner::Runner;
use crate::workbench;

/// What is done with documents.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Reading {
    /// The search is asked, and links are followed.
    Asked,
    /// Every fact is compared with the dump as well, also on paper and in AsciiDoc.
    Compared,
    /// Nothing.
    Skipped,
}

/// Documents: name of their directory, specification, language, and what is done with them in the sample and in all.
///
/// The German texts of the pitch control system are many: they are searched, and its facts are compared in English.
const DOCUMENTS: [(&str, &str, &str, Reading, Reading); 7] = [
    ("fullmo-drive", "od-spec/devices/fullmo-drive.od.yaml", "en", Reading::Skipped, Reading::Compared),
    (
        "pitch-control-system",
        "od-spec/devices/pitch-control-system.od.yaml",
        "en",
        Reading::Asked,
        Reading::Compared,
    ),
    ("fullmo-drive-de", "od-spec/devices/fullmo-drive.od.yaml", "de", Reading::Skipped, Reading::Compared),
    (
        "pitch-control-system-de",
        "od-spec/devices/pitch-control-system.od.yaml",
        "de",
        Reading::Skipped,
        Reading::Asked,
    ),
    ("everything", "tests/readers/everything.od.yaml", "en", Reading::Compared, Reading::Compared),
    ("two", "tests/docs/two.od.yaml", "en", Reading::Skipped, Reading::Compared),
    ("two-de", "tests/docs/two.od.yaml", "de", Reading::Asked, Reading::Compared),
];

/// The documents as their readers see them.
pub(crate) fn read_documents(runner: &mut Runner, amount: Amount) -> Result<(), Failure> {
    const DOCS: &str = "target/browser/docs";
    let mut arguments = match amount {
        Amount::Sample => vec!["--sample".to_owned()],
        Amount::All => Vec::new(),
    };
    for (stem, path, language, in_sample, in_all) in DOCUMENTS {
        let reading = match amount {
            Amount::Sample => in_sample,
            Amount::All => in_all,
        };
        if reading == Reading::Skipped {
            continue;
        }
        let system = compile_clean(path)?;
        let mut options = docs::options(&system, &[], Some(language));
        let html = [docs::Templates::new(Some(docs::Format::Html), &[])?];
        let mut set = docs::artifacts(&system, "", stem, &options, &html)?;
        set.push(Artifact {
            path: format!("{stem}/workbench.json"),
            bytes: workbench::expected(&system, language, &options)?,
            purpose: String::new(),
        });
        if reading == Reading::Asked {
            write_all(&root().join(DOCS), &set)?;
            arguments.push(format!("{DOCS}/{stem}"));
            continue;
        }
        let on_screen = docs::Options { gaps: docs::Gaps::InPlace, ..options.clone() };
        let siblings =
            [("dump", json::dump(&system, &[])), ("context", docs::dump_context(&system, &on_screen))];
        set.extend(siblings.map(|(name, bytes)| Artifact {
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
        arguments.extend(["", "-asciidoc", "-print"].map(|kind| format!("{DOCS}/{stem}{kind}")));
    }
    write_all(&root().join(DOCS), &with_start_page("start-page")?)?;
    arguments.push(format!("{DOCS}/start-page"));
    arguments.extend(hostile::documents(DOCS, amount)?);
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    runner.python("tests/browser/run.py", &arguments)
}

/// One specification twice, in two languages, below a start page.
fn with_start_page(folder: &str) -> Result<Vec<Artifact>, Failure> {
    let system = compile_clean("tests/docs/two.od.yaml")?;
    let other = |code: &str| docs::InLanguage {
        language: code.to_owned(),
        name: docs::language_name(code),
        folder: format!("../{code}"),
    };
    let edition = |(name, language, others): (&str, &str, &str)| {
        let start_page = "../../index.html".to_owned();
        let siblings = docs::Siblings { start_page, languages: vec![other(others)] };
        let options = docs::Options { siblings, ..docs::options(&system, &[], Some(language)) };
        docs::Edition { system: &system, folder: format!("{name}/{language}"), options }
    };
    let editions =
        [("two", "en", "de"), ("two", "de", "en"), ("twice", "en", "de"), ("twice", "de", "en")].map(edition);
    let templates = [docs::Templates::new(Some(docs::Format::Html), &[])?];
    let set = docs::with_start_page(&editions, &templates)?;
    Ok(set.into_iter().map(|file| Artifact { path: format!("{folder}/{}", file.path), ..file }).collect())
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

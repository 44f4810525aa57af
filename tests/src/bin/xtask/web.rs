//! The command as one HTML page, `target/web/odgen.html`: compiled to WebAssembly, packed, and put into the page of od-gen/web with all
//! that it shows.

use std::fs;
use std::io::Write as _;
use std::path::PathBuf;

use flate2::Compression;
use flate2::write::GzEncoder;
use od_gen::Artifact;
use od_gen::files::write_all;
use od_tests::{Failure, root};

use crate::runner::{self, Runner};
use crate::tools::{PAGE_TARGET, Tool};

/// Where the page is written, from the root.
const FOLDER: &str = "target/web";
const NAME: &str = "odgen.html";

/// Compiles the command and writes the page.
pub(crate) fn build(runner: &mut Runner) -> Result<PathBuf, Failure> {
    if !Tool::PageTarget.is_here() {
        let install = Tool::PageTarget.install().join(" or ");
        return Err(format!("{} is missing: {install}", Tool::PageTarget.name()).into());
    }
    let mut cargo = runner::cargo();
    cargo.args(["build", "--locked", "--profile", "wasm", "--target", PAGE_TARGET]);
    // The lints are those of the command itself.
    cargo.env_remove("RUSTC_WORKSPACE_WRAPPER").env_remove("CARGO_BUILD_RUSTFLAGS");
    runner.run(cargo.args(["--package", "odgen", "--bin", "odgen"]))?;
    let program = fs::read(root().join("target").join(PAGE_TARGET).join("wasm/odgen.wasm"))?;
    let packed = packed(&program)?;
    let page = assembled(&packed)?;
    runner.print(&format!(
        "{FOLDER}/{NAME}: {} kB, the program in it {} kB, packed {} kB",
        page.len() / 1000,
        program.len() / 1000,
        packed.len() / 1000
    ));
    let set = [Artifact { path: NAME.to_owned(), bytes: page.into_bytes(), purpose: String::new() }];
    write_all(&root().join(FOLDER), &set)?;
    Ok(root().join(FOLDER).join(NAME))
}

/// Gzip, without the time and the system that a header of it may have.
fn packed(program: &[u8]) -> Result<Vec<u8>, Failure> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(program)?;
    Ok(encoder.finish()?)
}

/// The page with its parts in the places that `{{NAME}}` marks.
fn assembled(packed: &[u8]) -> Result<String, Failure> {
    let read = |path: &str| fs::read_to_string(root().join(path));
    let style = read("docs-gen/templates/html/_style.css")? + &read("od-gen/web/page.css")?;
    let parts = [
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("style", style),
        ("program", base64(packed)),
        ("worker", read("od-gen/web/worker.js")?),
        ("texts", read("od-gen/web/texts.js")?),
        ("page", read("od-gen/web/page.js")?),
    ];
    let mut page = read("od-gen/web/page.html")?;
    for (name, part) in parts {
        if part.contains("</script") || part.contains("</style") {
            return Err(format!("the part `{name}` of the page would end its element").into());
        }
        let (before, after) = page
            .split_once(&format!("{{{{{name}}}}}"))
            .ok_or_else(|| format!("od-gen/web/page.html has no place for `{name}`"))?;
        page = format!("{before}{}{after}", part.trim_end());
    }
    Ok(page)
}

/// Bytes as letters, of which each is six bits (RFC 4648).
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let byte = |at: usize| u32::from(three.get(at).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for place in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * place) & 63) as usize];
            text.push(if place > three.len() { '=' } else { char::from(letter) });
        }
    }
    text
}

/// Uses the page in Chromium, on files of the tests and the shipped devices, and compares what it makes with what the command makes.
pub(crate) fn try_page(runner: &mut Runner) -> Result<(), Failure> {
    let page = build(runner)?;
    let (page, command) = (page.display().to_string(), runner::beside("odgen")?.display().to_string());
    runner.python("tests/browser/run.py", &["--page", &page, &command])
}

#[cfg(test)]
mod tests {
    use od_spec::diag::readers::{Evidence, Reader};

    use super::*;

    #[test]
    fn bytes_become_letters() {
        for (bytes, text) in
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")]
        {
            assert_eq!(base64(bytes.as_bytes()), text);
        }
        assert_eq!(base64(&[0xff, 0xef, 0xbe]), "/+++");
    }

    #[test]
    fn every_part_has_its_place() {
        let page = assembled(b"program").unwrap();
        assert!(page.contains(&base64(b"program")) && !page.contains("{{"));
        // Nothing is loaded from anywhere.
        assert!(!page.contains("src=") && !page.contains("http:") && !page.contains("https:"));
    }

    /// The page says that a program takes a file only where that is tested.
    #[test]
    fn the_page_knows_all_readers() {
        let script = fs::read_to_string(root().join("od-gen/web/page.js")).unwrap();
        for (list, evidence) in [("TESTED", Evidence::Tested), ("REPORTED", Evidence::Reported)] {
            let readers = Reader::ALL.iter().filter(|reader| reader.evidence() == evidence);
            let names: Vec<String> = readers.map(|reader| format!("\"{}\"", reader.name())).collect();
            let expected = format!("{list} = [{}]", names.join(", "));
            assert!(script.contains(&expected), "{expected}");
        }
    }

    /// The keys of the texts of a language, in their order.
    fn keys(texts: &str, language: &str) -> Vec<String> {
        let begin = texts.find(&format!("  {language}: {{\n")).unwrap();
        let lines = texts[begin..].lines().skip(1).take_while(|line| *line != "  },");
        // A text in quotes may have what looks like a key.
        let outside = |line: &str| line.split('"').step_by(2).collect::<String>();
        lines
            .flat_map(|line| {
                let keys: Vec<String> = outside(line)
                    .split([',', ' '])
                    .filter_map(|word| word.strip_suffix(':'))
                    .map(str::to_owned)
                    .collect();
                keys
            })
            .collect()
    }

    #[test]
    fn texts_are_in_both_languages_and_all_are_used() {
        let read = |name: &str| fs::read_to_string(root().join("od-gen/web").join(name)).unwrap();
        let (texts, page, script) = (read("texts.js"), read("page.html"), read("page.js"));
        let english = keys(&texts, "en");
        assert!(english.len() > 50, "{english:?}");
        assert_eq!(english, keys(&texts, "de"));
        for key in &english {
            let severities = ["error", "errors", "warning", "warnings", "note"];
            let composed = ["view_", "format_"].iter().any(|begin| key.starts_with(begin))
                || severities.contains(&key.as_str());
            let is_used = page.contains(&format!("\"{key}\"")) || script.contains(&format!("\"{key}\""));
            assert!(composed || is_used, "{key} is used nowhere");
        }
        for used in script.split("say(\"").skip(1).filter_map(|rest| rest.split('"').next()) {
            assert!(english.iter().any(|key| key == used), "{used} has no text");
        }
    }
}

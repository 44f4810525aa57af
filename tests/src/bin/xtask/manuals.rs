//! The manuals on paper.

use od_documents as docs;
use od_gen::Artifact;
use od_gen::files::write_all;
use od_tests::{Failure, compile_clean, root};

use crate::parts::Amount;
use crate::runner::Runner;

/// A manual: name of its directory, specification, language, and whether it shows errata. The sample is the last ones.
const MANUALS: [(&str, &str, &str, bool); 5] = [
    ("pitch-control-system", "od-spec/devices/pitch-control-system.od.yaml", "en", false),
    ("fullmo-drive-de", "od-spec/devices/fullmo-drive.od.yaml", "de", false),
    ("fullmo-drive-errata", "od-spec/devices/fullmo-drive.od.yaml", "en", true),
    ("everything", "tests/readers/everything.od.yaml", "en", false),
    ("two-de", "tests/docs/two.od.yaml", "de", true),
];

/// Prints manuals with WeasyPrint and reads the paper.
pub(crate) fn print(runner: &mut Runner, amount: Amount) -> Result<(), Failure> {
    const DOCS: &str = "target/print/docs";
    let templates = [docs::Templates::new(Some(docs::Format::Print), &[])?];
    let mut directories = Vec::new();
    let manuals = match amount {
        Amount::Sample => &MANUALS[3..],
        Amount::All => &MANUALS[..],
    };
    for &(name, path, language, errata) in manuals {
        let system = compile_clean(path)?;
        let options = docs::Options { errata, ..docs::options(&system, &[], Some(language)) };
        let mut set = docs::artifacts(&system, "", name, &options, &templates)?;
        set.push(Artifact {
            path: format!("{name}/context.json"),
            bytes: docs::dump_context(&system, &options),
            purpose: String::new(),
        });
        write_all(&root().join(DOCS), &set)?;
        directories.push(format!("{DOCS}/{name}"));
    }
    let directories: Vec<&str> = directories.iter().map(String::as_str).collect();
    runner.python("tests/print/run.py", &directories)
}

//! The rules over the model: their examples, cases that are easily missed, and their words.

mod cases;
mod examples;
mod words;

use od_spec::diag::{Code, Diagnostics, Language};
use od_spec::source::{SourceMap, Spanned};
use od_spec::{NoFiles, all_codes, assign, compile, is_rule};

/// The codes of all rules.
fn rules() -> impl Iterator<Item = &'static Code> {
    all_codes().into_iter().filter(|code| is_rule(code))
}

/// What is said about a specification, and about settings of node `node` of its first device.
fn said_with(text: &str, node: u8, settings: &[&str]) -> Diagnostics {
    let mut sources = SourceMap::new();
    let root = sources.add("example.od.yaml", text);
    let compiled = compile(&mut sources, root, &mut NoFiles);
    let mut diagnostics = compiled.diagnostics;
    let Some(system) = compiled.system.filter(|_| !settings.is_empty()) else { return diagnostics };
    let settings: Vec<_> = settings
        .iter()
        .map(|setting| {
            let file = sources.add("--set", *setting);
            Spanned::new((*setting).to_owned(), sources.whole(file))
        })
        .collect();
    assign(&system, &system.devices[0], node, &settings, &mut diagnostics);
    diagnostics
}

/// What is said about a text of an example; its lines `# --set ENTRY=VALUE` are settings of node 1.
fn said_of_example(text: &str) -> Diagnostics {
    let settings: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix("# --set ")).collect();
    said_with(&Language::Specification.whole(text), 1, &settings)
}

fn codes(diagnostics: &Diagnostics) -> Vec<&'static str> {
    diagnostics.iter().map(|diagnostic| diagnostic.code.id).collect()
}

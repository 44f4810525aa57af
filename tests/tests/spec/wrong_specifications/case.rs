//! What a case is, and what the compiler says about it.

use od_formats::eds::eds_document;
use od_spec::diag::Diagnostics;
use od_spec::source::{SourceMap, Spanned};
use od_spec::{NoFiles, Strictness, assign, compile, compile_as};

/// The node whose settings a case is about.
const NODE: u8 = 5;

/// A specification, or settings of a node, with a mistake.
pub(crate) struct Case {
    pub(crate) name: &'static str,
    pub(crate) specification: String,
    /// Settings of node 5 of its first device, `INDEX.SUB=VALUE`; the specification is right without them.
    pub(crate) set: &'static [&'static str],
    /// The code of everything that is said about it.
    pub(crate) code: &'static str,
}

/// A specification, or settings of a node, about which nothing is said.
pub(crate) struct Right {
    pub(crate) name: &'static str,
    pub(crate) specification: String,
    /// Settings of node 5 of its first device, `INDEX.SUB=VALUE`.
    pub(crate) set: &'static [&'static str],
}

/// A specification with a mistake.
pub(crate) fn wrong(name: &'static str, specification: impl Into<String>, code: &'static str) -> Case {
    Case { name, specification: specification.into(), set: &[], code }
}

/// A specification about which nothing is said.
pub(crate) fn right(name: &'static str, specification: impl Into<String>) -> Right {
    Right { name, specification: specification.into(), set: &[] }
}

impl Case {
    /// With settings, which make the mistake.
    pub(crate) fn set(self, set: &'static [&'static str]) -> Self {
        Self { set, ..self }
    }
}

impl Right {
    /// With settings.
    pub(crate) fn set(self, set: &'static [&'static str]) -> Self {
        Self { set, ..self }
    }
}

/// Codes and messages of all that is said about a specification; if that is nothing, about the settings.
pub(crate) fn said(specification: &str, set: &[&str]) -> Vec<(&'static str, String)> {
    let mut sources = SourceMap::new();
    let root = sources.add("case.od.yaml", whole(specification));
    let compiled = compile(&mut sources, root, &mut NoFiles);
    let mut diagnostics = compiled.diagnostics;
    if let Some(system) = compiled.system.filter(|_| diagnostics.is_empty() && !set.is_empty()) {
        let settings: Vec<_> = set
            .iter()
            .map(|setting| {
                let file = sources.add("--set", *setting);
                Spanned::new((*setting).to_owned(), sources.whole(file))
            })
            .collect();
        assign(&system, &system.devices[0], NODE, &settings, &mut diagnostics);
    }
    shown(&diagnostics)
}

/// What the rules say about the EDS files of a specification that is right, held to the standard. What the file says as a text
/// has tests of its own, and the vendor's number is unknown.
pub(crate) fn said_of_eds(specification: &str) -> Vec<(&'static str, String)> {
    let mut sources = SourceMap::new();
    let root = sources.add("case.od.yaml", whole(specification));
    let Some(system) = compile(&mut sources, root, &mut NoFiles).system else { return Vec::new() };
    let found = system.devices.iter().flat_map(|device| {
        let root = sources.add("case.eds", eds_document(&system, device).to_string());
        let compiled = compile_as(Strictness::Standard, &mut sources, root, &mut NoFiles);
        shown(&compiled.diagnostics)
    });
    found.filter(|(code, _)| code.starts_with("OD") && *code != "OD0821").collect()
}

fn shown(diagnostics: &Diagnostics) -> Vec<(&'static str, String)> {
    diagnostics.iter().map(|diagnostic| (diagnostic.code.id, diagnostic.message.clone())).collect()
}

/// With a version, a title, and a device where the text has none.
fn whole(text: &str) -> String {
    let has = |key: &str| text.lines().any(|line| line.starts_with(key));
    let mut whole = "od-spec: 1\ntitle: Example\n".to_owned();
    if !has("uses:") {
        whole.push_str("uses: [cia301]\n");
    }
    if !has("devices:") {
        whole.push_str(
            "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer, emergency]}\n",
        );
    }
    whole.push_str(text);
    whole.push('\n');
    whole
}

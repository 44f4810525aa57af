//! The one entry point: text in, model and diagnostics out.

use std::sync::Arc;

use crate::ast::{Spec, Untranslated};
use crate::check;
use crate::check::allowed::Allowed;
use crate::decode;
use crate::diag::shorten;
use crate::diag::{Diagnostic, Diagnostics, Suggestions, codes};
use crate::eds;
use crate::eds::read::{Read, read};
use crate::eds::view::{FileFacts, View};
use crate::files::{self, Loader};
use crate::keys;
use crate::library::kept::built_in;
use crate::library::shipped::LIBRARIES;
use crate::model::System;
use crate::node_of_file::NodeOfFile;
use crate::parameters::{is_parameter_file, of_node};
use crate::parts;
use crate::plant::is_plant;
use crate::resolve::{self, Resolved};
use crate::source::{FileId, SourceFile, SourceMap, Span, Spanned};
use crate::standard;
use crate::visible::straight;
use crate::wording::FileFormat;
use crate::xdd::{self, Disabled};
use crate::yaml::gaps;

/// What [`compile`] gives.
#[derive(Debug)]
#[non_exhaustive]
pub struct Compiled {
    /// The model. A specification, and an EDS that is held to the standard, has one exactly when no error is among the
    /// diagnostics; an EDS that is only read has one whatever is wrong with it.
    pub system: Option<System>,
    /// Of a DCF: the node that it configures.
    pub node: Option<NodeOfFile>,
    /// How much the text describes: objects as they are written, each of a run, and the entries of every device; also
    /// where an error keeps the model back. Memory and time grow with it.
    pub described: usize,
    /// The texts of a specification that lack one of its languages, in the order of its keys, one language after the other.
    pub untranslated: Vec<Untranslated>,
    /// Errors and warnings, sorted by place.
    pub diagnostics: Diagnostics,
}

impl Compiled {
    /// Nothing but messages.
    pub const fn refused(diagnostics: Diagnostics) -> Self {
        Self { system: None, node: None, described: 0, untranslated: Vec::new(), diagnostics }
    }
}

/// What an EDS or DCF is held to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Strictness {
    /// It was written by others, and is read: a fault never prevents a model.
    #[default]
    Foreign,
    /// It is held to the standard, as our own files are.
    Standard,
}

/// Compiles the specification, EDS, DCF, XDD or XDC `root` of `sources`; libraries are added to `sources`.
pub fn compile(sources: &mut SourceMap, root: FileId, loader: &mut dyn Loader) -> Compiled {
    compile_as(Strictness::Foreign, sources, root, loader)
}

/// [`compile`], with an EDS or DCF held to the standard or only read.
pub fn compile_as(
    strictness: Strictness,
    sources: &mut SourceMap,
    root: FileId,
    loader: &mut dyn Loader,
) -> Compiled {
    let file = sources.file(root);
    if xdd::is_xdd(file.name(), file.text()) {
        let rules = check::Rules { format: FileFormat::Xdd, ..standard::rules(&check::RULES) };
        compile_xdd(rules, sources, root, strictness, loader.disabled())
    } else if eds::is_eds(file.name(), file.text()) {
        compile_eds(standard::rules(&check::RULES), sources, root, strictness, None)
    } else if let Some(diagnostic) = no_specification(file, sources.whole(root)) {
        let mut diagnostics = Diagnostics::new();
        diagnostics.push(diagnostic);
        Compiled::refused(diagnostics)
    } else {
        compile_with(standard::rules(&check::RULES), sources, root, loader)
    }
}

/// [`compile`], with these modules plugged into the bus coupler that an EDS or DCF describes, in place of those that it names.
pub fn compile_with_modules(
    sources: &mut SourceMap,
    root: FileId,
    loader: &mut dyn Loader,
    modules: &[u32],
) -> Compiled {
    let file = sources.file(root);
    if xdd::is_xdd(file.name(), file.text()) || !eds::is_eds(file.name(), file.text()) {
        return compile(sources, root, loader);
    }
    compile_eds(standard::rules(&check::RULES), sources, root, Strictness::Foreign, Some(modules))
}

/// Whether a text says by a key that it is a specification, a part of one or a library.
pub fn is_specification(text: &str) -> bool {
    keys::is_marked(text, keys::SPEC_VERSION) || keys::is_marked(text, keys::PART_OF)
}

/// Whether a text shows by its beginning or its name what it is, and is not a specification.
pub(crate) fn is_known(file: &SourceFile) -> bool {
    let (name, text) = (file.name(), file.text());
    eds::is_eds(name, text) || xdd::is_xdd(name, text) || is_parameter_file(text) || is_plant(text)
}

/// A file of this project that says nothing about what a device is, with the command that takes it.
fn no_specification(file: &SourceFile, whole: Span) -> Option<Diagnostic> {
    let text = file.text();
    let (what, key, help) = if is_parameter_file(text) {
        let help = "`odgen check FILE` checks it if `spec:` names its specification, `odgen dcf SPEC --params FILE` makes the DCF";
        ("a parameter file", keys::PARAMETERS_VERSION, help)
    } else if is_plant(text) {
        let help = "`odgen plant check FILE` checks it, `odgen plant build FILE` makes its files";
        ("a plant file", keys::PLANT_VERSION, help)
    } else {
        return None;
    };
    let at = text.find(key)?;
    let span = whole.part(at, at + key.len());
    Some(
        Diagnostic::new(codes::NO_SPECIFICATION, span, format!("this is {what}, expected a specification"))
            .help(help),
    )
}

/// Everything that there is to say about an EDS or DCF, as serious as the standard takes it.
pub(crate) fn findings(sources: &SourceMap, file: FileId) -> Diagnostics {
    compile_eds(standard::rules(&check::RULES), sources, file, Strictness::Standard, None).diagnostics
}

/// An EDS or DCF goes the way of a specification, except for its reader. `modules` are plugged in, or those that it
/// names.
fn compile_eds(
    rules: check::Rules<'_>,
    sources: &SourceMap,
    root: FileId,
    strictness: Strictness,
    modules: Option<&[u32]>,
) -> Compiled {
    let mut diagnostics = Diagnostics::new();
    let file = sources.file(root);
    let text = straight(file.text());
    let document = eds::Document::scan(root, &text);
    let name = eds::file_name(file.name());
    let facts = FileFacts { name, encoding: file.encoding(), format: rules.format };
    let mut view = View::new(&document, root, eds::is_dcf(name), facts);
    if let Some(modules) = modules {
        modules.clone_into(&mut view.connected);
    }
    eds::check::document(&view, &mut diagnostics);
    let read = read(&view, file.name(), standard::data_type, &mut diagnostics);
    resolved(rules, read, strictness, diagnostics)
}

/// An XDD or XDC is translated into the sections of an EDS, and read as one.
#[cfg(feature = "xdd")]
fn compile_xdd(
    rules: check::Rules<'_>,
    sources: &SourceMap,
    root: FileId,
    strictness: Strictness,
    disabled: Disabled,
) -> Compiled {
    let mut diagnostics = Diagnostics::new();
    let file = sources.file(root);
    let text = straight(file.text());
    let translated = xdd::translate(root, &text, standard::data_type, disabled, &mut diagnostics);
    let Some(xdd::Translated { document, texts }) = translated else {
        return Compiled::refused(diagnostics);
    };
    let name = eds::file_name(file.name());
    let facts = FileFacts { name, encoding: file.encoding(), format: rules.format };
    let view = View::new(&document, root, xdd::is_xdc(name), facts);
    if !view.is_dcf {
        xdd::say_values(&view, &mut diagnostics);
    }
    let mut read = read(&view, file.name(), standard::data_type, &mut diagnostics);
    texts.add_to(&mut read.spec);
    let mut compiled = resolved(rules, read, strictness, diagnostics);
    compiled.diagnostics.without_edits();
    compiled
}

/// Without the feature, what an XDD is can be reported, and no more.
#[cfg(not(feature = "xdd"))]
fn compile_xdd(
    _: check::Rules<'_>,
    sources: &SourceMap,
    root: FileId,
    _: Strictness,
    _: Disabled,
) -> Compiled {
    let mut diagnostics = Diagnostics::new();
    let message = format!(
        "`{}` is an XDD, which this program was built without a reader for",
        sources.file(root).name()
    );
    diagnostics.push(
        Diagnostic::new(codes::UNREADABLE, sources.whole(root), message)
            .help("make a specification or an EDS of it: `odgen import`, `odgen build`"),
    );
    Compiled::refused(diagnostics)
}

/// What was read from a file of others, as a model.
fn resolved(
    rules: check::Rules<'_>,
    Read { spec, further, node }: Read,
    strictness: Strictness,
    mut diagnostics: Diagnostics,
) -> Compiled {
    let Resolved { mut system, .. } = resolve::resolve(&spec, &[], &mut diagnostics);
    for device in &mut system.devices {
        device.further.clone_from(&further);
    }
    let id = node.as_ref().and_then(|node| node.node);
    check::foreign(rules, &system, id, &mut diagnostics);
    let device = system.devices.first();
    let node = node.zip(device).map(|(node, device)| of_node(rules, &system, device, node, &mut diagnostics));
    if strictness == Strictness::Foreign {
        diagnostics.soften();
    }
    diagnostics.sort();
    let refused = strictness == Strictness::Standard && diagnostics.has_errors();
    Compiled {
        described: described(&spec, &system),
        untranslated: Vec::new(),
        system: (!refused).then_some(system),
        node: node.filter(|_| !refused),
        diagnostics,
    }
}

/// Compiles under some of the rules.
pub(crate) fn compile_with(
    rules: check::Rules<'_>,
    sources: &mut SourceMap,
    root: FileId,
    loader: &mut dyn Loader,
) -> Compiled {
    let mut diagnostics = Diagnostics::new();
    let built = build(rules, sources, root, loader, &mut diagnostics);
    diagnostics.sort();
    let Some(Built { system, described, untranslated }) = built else {
        return Compiled::refused(diagnostics);
    };
    let system = (!diagnostics.has_errors()).then_some(system);
    Compiled { system, node: None, described, untranslated, diagnostics }
}

fn described(spec: &Spec, system: &System) -> usize {
    let entries: usize = system.devices.iter().map(|device| device.entries().count()).sum();
    spec.objects.len() + entries
}

/// What a specification becomes.
struct Built {
    /// The model, right or not.
    system: System,
    /// How much the text describes.
    described: usize,
    untranslated: Vec<Untranslated>,
}

fn build(
    rules: check::Rules<'_>,
    sources: &mut SourceMap,
    root: FileId,
    loader: &mut dyn Loader,
    diagnostics: &mut Diagnostics,
) -> Option<Built> {
    let spec = file(sources, root, &[], loader, diagnostics)?;
    // Without a library, everything that it would have brought would be reported as missing.
    let libraries = libraries(sources, &spec, loader, diagnostics)?;
    let Resolved { mut system, library } = resolve::resolve(&spec, &libraries, diagnostics);
    for (device, decl) in system.devices.iter_mut().zip(&spec.devices) {
        device.further = Some(Arc::new(eds::read::stated(decl.eds.as_ref(), device, diagnostics)));
    }
    let mut allowed = Allowed::of(&spec, diagnostics);
    check::system(rules, &system, library.as_ref(), &mut allowed, diagnostics);
    Some(Built { described: described(&spec, &system), system, untranslated: spec.untranslated })
}

/// Reads a file and its parts. The tree, which is several times as large as the text, is gone afterwards unless the loader
/// keeps it.
fn file(
    sources: &mut SourceMap,
    file: FileId,
    shown: &[String],
    loader: &mut dyn Loader,
    diagnostics: &mut Diagnostics,
) -> Option<Spec> {
    let mut tree = loader.tree(file, sources.file(file), diagnostics)?;
    parts::refuse_alone(&tree, diagnostics)?;
    gaps::check(file, sources.file(file).text(), diagnostics);
    decode::check(&tree, &keys::SPEC, diagnostics);
    parts::join(sources, &mut tree, loader, diagnostics)?;
    Some(decode::read(&tree, shown, diagnostics))
}

fn libraries(
    sources: &mut SourceMap,
    root: &Spec,
    loader: &mut dyn Loader,
    diagnostics: &mut Diagnostics,
) -> Option<Vec<Arc<Spec>>> {
    let (mut libraries, mut complete) = (Vec::new(), true);
    let from = sources.file(root.file).name().to_owned();
    let shown = root.shown_languages();
    for (at, name) in root.uses.iter().enumerate() {
        if let Some(first) = root.uses[..at].iter().find(|before| before.value == name.value) {
            diagnostics.push(files::twice("library", first.span, name));
            continue;
        }
        if let Some((library, text)) = LIBRARIES.iter().find(|(library, _)| *library == name.value) {
            let id = sources.add(format!("<{library}>"), *text);
            libraries.extend(built_in(library, id, &shown, sources));
            continue;
        }
        let id = match files::read(name, &from, loader, missing_library, no_library) {
            Ok(text) => sources.add(files::beside(&from, &name.value), text),
            Err(diagnostic) => {
                diagnostics.push(*diagnostic);
                complete = false;
                continue;
            }
        };
        let Some(mut library) = file(sources, id, &shown, loader, diagnostics) else {
            complete = false;
            continue;
        };
        if library.profile.is_none() || !library.uses.is_empty() {
            diagnostics.push(no_library(name));
            complete = false;
            continue;
        }
        resolve::expand(&mut library, diagnostics);
        libraries.push(Arc::new(library));
    }
    complete.then_some(libraries)
}

fn no_library(name: &Spanned<String>) -> Diagnostic {
    let message = format!("`{}` is not a library", shorten(&name.value));
    Diagnostic::new(codes::NOT_A_LIBRARY, name.span, message)
        .help("a library has `profile: NAME` at its top level and no `uses:` of its own")
}

fn missing_library(name: &Spanned<String>, reason: &str) -> Diagnostic {
    let path = name.value.as_str();
    let known = LIBRARIES.iter().map(|(name, _)| *name);
    let message = format!("cannot read library `{}`: {reason}", shorten(path));
    let diagnostic = Diagnostic::new(codes::MISSING_LIBRARY, name.span, message);
    match Suggestions::default()
        .nearest(path, known.clone())
        .filter(|word| !path.starts_with("cia") || path.len() != word.len())
    {
        Some(word) => diagnostic.did_you_mean(word),
        None => {
            let known = known.map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
            diagnostic.help(format!("name a built-in library ({known}), or a file relative to this one"))
        }
    }
}

#[cfg(all(test, not(feature = "xdd")))]
mod tests {
    use crate::source::SourceMap;
    use crate::{NoFiles, compile};

    #[test]
    fn without_a_reader_it_is_reported_what_the_file_is() {
        let mut sources = SourceMap::new();
        let root = sources.add("tank.xdd", "<ISO15745ProfileContainer/>");
        let compiled = compile(&mut sources, root, &mut NoFiles);
        assert!(compiled.system.is_none());
        let said: Vec<&str> = compiled.diagnostics.iter().map(|one| one.message.as_str()).collect();
        assert_eq!(said, ["`tank.xdd` is an XDD, which this program was built without a reader for"]);
    }
}

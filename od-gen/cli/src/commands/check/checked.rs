//! One input and what was found in it.

use std::path::Path;

use od_formats::findings::Findings;
use od_gen::rust;
use od_gen::source::{self, FileLoader, read_input};
use od_readers::remark;
use od_spec::diag::{Diagnostic, Diagnostics, Severity, codes};
use od_spec::eds::is_eds;
use od_spec::file_name;
use od_spec::source::{FileId, SourceFile, SourceMap};
use od_spec::xdd::is_xdd;
use od_spec::{Compiled, OnDevice, Strictness, add_source, compile_as, is_parameter_file, on_device};

use super::args::CheckArgs;
use super::inputs::Input;
use super::policy::{Errors, Policy};
use crate::report::Report;

/// What was found in one input.
pub(super) struct Checked {
    /// What messages call it.
    pub name: String,
    /// What it is.
    pub kind: Kind,
    /// How many objects its devices have, where that is known.
    pub objects: Option<usize>,
    /// What there is to show.
    pub shown: Diagnostics,
    /// Notes that are not wanted.
    pub hidden_notes: usize,
    /// How many of those can be fixed without a decision.
    pub hidden_repairs: usize,
    /// The texts that were read.
    pub sources: SourceMap,
}

/// What an input is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Specification,
    Eds,
    /// A parameter file, which is checked on the device that it names.
    Parameters,
    /// It cannot be read.
    Unknown,
}

impl Kind {
    /// Whether `odgen fix` takes a file of this kind.
    pub(super) const fn is_fixed(self) -> bool {
        match self {
            Self::Eds => true,
            Self::Specification | Self::Parameters | Self::Unknown => false,
        }
    }

    /// What a text is.
    fn of(file: &SourceFile) -> Self {
        let (name, text) = (file.name(), file.text());
        if is_eds(name, text) || is_xdd(name, text) {
            Self::Eds
        } else if is_parameter_file(text) {
            Self::Parameters
        } else {
            Self::Specification
        }
    }
}

impl Checked {
    /// For the renderer of a whole run.
    pub(super) fn findings(&self) -> Findings<'_> {
        Findings { name: &self.name, diagnostics: &self.shown, sources: &self.sources }
    }
}

/// Compiles and checks.
pub(super) fn check(input: &Input, args: &CheckArgs, policy: &Policy, report: &Report) -> Checked {
    let strictness = if args.strict { Strictness::Standard } else { Strictness::Foreign };
    let mut sources = SourceMap::new();
    let mut loader = report.loader();
    let (kind, compiled) = match opened(input, &mut sources, &mut loader) {
        Ok(root) => {
            let kind = Kind::of(sources.file(root));
            (kind, compile(kind, root, strictness, &mut sources, &mut loader))
        }
        Err(diagnostic) => (Kind::Unknown, refused(*diagnostic)),
    };
    let Compiled { system, mut diagnostics, untranslated, .. } = compiled;
    if let Some(system) = &system {
        for device in system.devices.iter().filter(|_| args.rust) {
            let _ = rust::tokens(system, device, &mut diagnostics);
        }
        diagnostics.sort();
    }
    let errors = match kind {
        Kind::Eds => Errors::CanBeAllowed,
        Kind::Specification | Kind::Parameters | Kind::Unknown => Errors::Stay,
    };
    let (mut shown, mut hidden_notes, mut hidden_repairs) = (Diagnostics::new(), 0, 0);
    for diagnostic in &policy.apply(&diagnostics, errors) {
        if diagnostic.severity == Severity::Note && !args.notes {
            hidden_notes += 1;
            hidden_repairs += usize::from(kind.is_fixed() && !diagnostic.edits.is_empty());
        } else {
            shown.push(diagnostic.clone());
        }
    }
    for text in untranslated.iter().filter(|_| args.translations) {
        shown.push(text.note());
    }
    let objects = system.map(|system| system.devices.iter().map(|device| device.objects.len()).sum());
    Checked { name: input.name(), kind, objects, shown, hidden_notes, hidden_repairs, sources }
}

/// Adds the text of an input.
fn opened(
    input: &Input,
    sources: &mut SourceMap,
    loader: &mut FileLoader,
) -> Result<FileId, Box<Diagnostic>> {
    match input {
        Input::File(path) => source::opened(path, sources, loader),
        Input::Stdin(name) => match read_input(std::io::stdin().lock()) {
            Ok(bytes) => add_source(sources, name, bytes),
            Err(error) => Err(Box::new(unreadable(name, &error.to_string()))),
        },
        Input::Missing { diagnostic, .. } => Err(Box::new(diagnostic.clone())),
    }
}

/// The model and the findings of a text.
fn compile(
    kind: Kind,
    root: FileId,
    strictness: Strictness,
    sources: &mut SourceMap,
    loader: &mut FileLoader,
) -> Compiled {
    if kind == Kind::Parameters {
        let OnDevice { spec, diagnostics, .. } = on_device(sources, root, loader);
        if spec.is_some() || diagnostics.has_errors() {
            return Compiled::refused(diagnostics);
        }
    }
    let mut compiled = compile_as(strictness, sources, root, loader);
    remark(sources, root, &mut compiled);
    compiled
}

fn unreadable(name: &str, reason: &str) -> Diagnostic {
    let name = file_name::shown(Path::new(name));
    Diagnostic::without_place(codes::UNREADABLE, format!("cannot read {name}: {reason}"))
}

fn refused(diagnostic: Diagnostic) -> Compiled {
    let mut diagnostics = Diagnostics::new();
    diagnostics.push(diagnostic);
    Compiled::refused(diagnostics)
}

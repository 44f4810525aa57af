//! One input and what was found in it.

use std::path::Path;

use od_formats::findings::Findings;
use od_gen::rust;
use od_gen::source::{FileLoader, compile_bytes_as, compile_file_as, read_input};
use od_readers::remark;
use od_spec::diag::{Diagnostic, Diagnostics, Severity, codes};
use od_spec::eds::is_eds;
use od_spec::file_name;
use od_spec::source::SourceMap;
use od_spec::xdd::is_xdd;
use od_spec::{Compiled, Strictness};

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
    /// It cannot be read.
    Unknown,
}

impl Kind {
    /// Whether `odgen fix` takes a file of this kind.
    pub(super) const fn is_fixed(self) -> bool {
        match self {
            Self::Eds => true,
            Self::Specification | Self::Unknown => false,
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
    let mut compiled = compile(input, strictness, &mut sources, &mut report.loader());
    let root = sources.files().next().map(|(id, _)| id);
    if let Some(root) = root {
        remark(&sources, root, &mut compiled);
    }
    let Compiled { system, mut diagnostics, untranslated, .. } = compiled;
    let kind = match root.map(|root| sources.file(root)) {
        None => Kind::Unknown,
        Some(file) if is_eds(file.name(), file.text()) || is_xdd(file.name(), file.text()) => Kind::Eds,
        Some(_) => Kind::Specification,
    };
    if let Some(system) = &system {
        for device in system.devices.iter().filter(|_| args.rust) {
            let _ = rust::tokens(system, device, &mut diagnostics);
        }
        diagnostics.sort();
    }
    let errors = match kind {
        Kind::Eds => Errors::CanBeAllowed,
        Kind::Specification | Kind::Unknown => Errors::Stay,
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

fn compile(
    input: &Input,
    strictness: Strictness,
    sources: &mut SourceMap,
    loader: &mut FileLoader,
) -> Compiled {
    match input {
        Input::File(path) => compile_file_as(strictness, path, sources, loader),
        Input::Stdin(name) => match read_input(std::io::stdin().lock()) {
            Ok(bytes) => compile_bytes_as(strictness, name, bytes, sources, loader),
            Err(error) => refused(unreadable(name, &error.to_string())),
        },
        Input::Missing { diagnostic, .. } => refused(diagnostic.clone()),
    }
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

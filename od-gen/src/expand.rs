//! Generation for a macro.

use std::path::{Path, PathBuf};

use od_spec::Compiled;
use od_spec::diag::render::{Format, render};
use od_spec::diag::{Diagnostic, Diagnostics, Severity, codes};
use od_spec::model::Dictionary;
use od_spec::source::SourceMap;

use crate::foreign::condense;
use crate::rust;
use crate::source::{FileLoader, compile_file};

/// The module of a device as tokens, with all messages of the run.
pub fn expand(specification: &Path, device: Option<&str>) -> Expansion {
    let (mut sources, mut loader) = (SourceMap::new(), FileLoader::default());
    let mut compiled = compile_file(specification, &mut sources, &mut loader);
    let in_short = condense(specification, &mut compiled);
    let Compiled { system, mut diagnostics, .. } = compiled;
    let mut tokens = None;
    if let Some(system) = system {
        let chosen =
            match (device, system.devices.as_slice()) {
                (Some(key), devices) => system.device(key).ok_or_else(|| unknown_device(key, devices)),
                (None, [only]) => Ok(only),
                (None, devices) => Err(Diagnostic::without_place(
                    codes::UNKNOWN_DEVICE,
                    "the specification has several devices",
                )
                .help(format!(
                    "add `device = \"KEY\"`: {}",
                    devices.iter().map(|device| format!("`{}`", device.key)).collect::<Vec<_>>().join(", ")
                ))),
            };
        match chosen {
            Ok(device) => tokens = rust::tokens(&system, device, &mut diagnostics),
            Err(diagnostic) => diagnostics.push(diagnostic),
        }
    }
    let messages = |severity: Severity| {
        let chosen = diagnostics.iter().filter(|diagnostic| diagnostic.severity() == severity);
        chosen
            .map(|diagnostic| {
                let mut one = Diagnostics::new();
                one.push(diagnostic.clone());
                render(&one, &sources, Format::Human, false).trim_end().to_owned()
            })
            .collect::<Vec<_>>()
    };
    Expansion {
        read: loader.read,
        errors: messages(Severity::Error),
        warnings: in_short.into_iter().chain(messages(Severity::Warning)).collect(),
        tokens,
    }
}

/// What [`expand`] gives.
#[derive(Debug)]
pub struct Expansion {
    /// Files that were read, in order.
    pub read: Vec<PathBuf>,
    /// Errors, as `odgen check` prints them.
    pub errors: Vec<String>,
    /// Warnings, as `odgen check` prints them; about an EDS or DCF one line for all.
    pub warnings: Vec<String>,
    /// The items of the module; `None` if there are errors.
    pub tokens: Option<proc_macro2::TokenStream>,
}

/// A device that the specification does not have.
pub(crate) fn unknown_device(key: &str, devices: &[Dictionary]) -> Diagnostic {
    let keys: Vec<String> = devices.iter().map(|device| format!("`{}`", device.key)).collect();
    Diagnostic::without_place(codes::UNKNOWN_DEVICE, format!("there is no device `{key}`"))
        .help(format!("the specification has {}", keys.join(", ")))
}

//! Generated code as a file that people read.

use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::eds::GENERATED;
use od_spec::model::{Dictionary, System};

use super::{Provenance, language, tokens};
use crate::artifact::Artifact;

/// A way to write a module down: [`file()`] or [`plain_file`].
pub type Layout = fn(&System, &Dictionary, &Provenance, &mut Diagnostics) -> Option<String>;

/// A formatted file `src/KEY.rs` for each of some devices; of none when anything is wrong.
pub fn artifacts<'a>(
    system: &System,
    devices: impl Iterator<Item = &'a Dictionary>,
    provenance: &Provenance,
    diagnostics: &mut Diagnostics,
) -> Vec<Artifact> {
    modules(system, devices, provenance, file, diagnostics)
}

/// [`artifacts`], with a layout of one's own.
pub fn modules<'a>(
    system: &System,
    devices: impl Iterator<Item = &'a Dictionary>,
    provenance: &Provenance,
    layout: Layout,
    diagnostics: &mut Diagnostics,
) -> Vec<Artifact> {
    let files = devices.map(|device| {
        let code = layout(system, device, provenance, diagnostics)?;
        Some(Artifact {
            path: format!("src/{}.rs", language::module(&device.key)),
            bytes: code.into_bytes(),
            purpose: "a module for firmware".to_owned(),
        })
    });
    files.collect::<Vec<_>>().into_iter().collect::<Option<_>>().unwrap_or_default()
}

/// The module of a device as a formatted file, which can be a module or be included into one.
pub fn file(
    system: &System,
    device: &Dictionary,
    provenance: &Provenance,
    diagnostics: &mut Diagnostics,
) -> Option<String> {
    let tokens = tokens(system, device, diagnostics)?;
    let parsed = match syn::parse2::<syn::File>(tokens) {
        Ok(parsed) => parsed,
        Err(error) => {
            // A mistake of the generator; the place is the device, for want of a better one.
            diagnostics.push(
                Diagnostic::new(
                    codes::NOT_IN_FIRMWARE,
                    device.span,
                    format!("the generated code is not Rust: {error}"),
                )
                .help("this is a mistake of the generator; please report it with the specification"),
            );
            return None;
        }
    };
    let code = space_out(&prettyplease::unparse(&parsed));
    // The compiler shows these lines: when there is no `firmware-glue`, and when the file was made for another layout of it.
    let code = code.replacen(
        "as firmware;",
        "as firmware; // An error here? Add `firmware-glue` to the dependencies.",
        1,
    );
    let code = code.replacen("as glue;", "as glue; // An error here? Generate this file again.", 1);
    Some(header(device, provenance) + &code)
}

/// The module of a device as one long line: for the compiler, not for people.
pub fn plain_file(
    system: &System,
    device: &Dictionary,
    provenance: &Provenance,
    diagnostics: &mut Diagnostics,
) -> Option<String> {
    let tokens = tokens(system, device, diagnostics)?;
    Some(format!("{}{tokens}\n", header(device, provenance)))
}

fn header(device: &Dictionary, provenance: &Provenance) -> String {
    format!("// Object dictionary `{}` of {}.\n// {GENERATED}\n\n", device.key, provenance.name())
}

/// Puts blank lines between items: printers leave them out.
fn space_out(code: &str) -> String {
    let indent = |line: &str| line.len() - line.trim_start().len();
    let starts_item = |line: &str| {
        // A macro completes the item before it.
        const STARTS: [&str; 9] = ["///", "#[", "pub ", "impl", "static ", "const ", "fn ", "mod ", "use "];
        STARTS.iter().any(|start| line.trim_start().starts_with(start))
    };
    let ends_item = |line: &str| line.ends_with('}') || line.ends_with(';');
    let mut out = String::with_capacity(code.len() + code.len() / 16);
    let mut before = "";
    for line in code.lines() {
        let uses = || before.trim_start().starts_with("use ") && line.trim_start().starts_with("use ");
        if ends_item(before) && indent(line) == indent(before) && starts_item(line) && !uses() {
            out.push('\n');
        }
        out.push_str(line);
        out.push('\n');
        before = line;
    }
    out
}

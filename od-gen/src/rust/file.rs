//! Generated code as a file: for people, or for the compiler.

use od_spec::diag::Diagnostics;
#[cfg(feature = "format")]
use od_spec::diag::{Diagnostic, codes};
use od_spec::eds::GENERATED;
use od_spec::model::{Dictionary, System};
use proc_macro2::{Delimiter, TokenStream, TokenTree};

use super::{Provenance, language, tokens};
use crate::artifact::Artifact;

/// A way to write a module down: [`plain_file`], or `file` with the feature `format`.
pub type Layout = fn(&System, &Dictionary, &Provenance, &mut Diagnostics) -> Option<String>;

/// A formatted file `src/KEY.rs` for each of some devices; of none when anything is wrong.
#[cfg(feature = "format")]
pub fn artifacts<'a>(
    system: &System,
    devices: impl Iterator<Item = &'a Dictionary>,
    provenance: &Provenance,
    diagnostics: &mut Diagnostics,
) -> Vec<Artifact> {
    modules(system, devices, provenance, file, diagnostics)
}

/// A file `src/KEY.rs` with a layout for each of some devices; of none when anything is wrong.
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
#[cfg(feature = "format")]
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
    let mut out = header(device, provenance);
    for line in space_out(&prettyplease::unparse(&parsed)).lines() {
        out.push_str(line);
        out.push_str(hint(line));
        out.push('\n');
    }
    Some(out)
}

/// The module of a device with a statement in each line: for the compiler and its lints, which look at lines. Laying it out for
/// people takes longer than everything before it.
pub fn plain_file(
    system: &System,
    device: &Dictionary,
    provenance: &Provenance,
    diagnostics: &mut Diagnostics,
) -> Option<String> {
    let mut out = header(device, provenance);
    write_items(&mut out, tokens(system, device, diagnostics)?, 0);
    Some(out)
}

fn write_items(out: &mut String, tokens: TokenStream, depth: usize) {
    let mut line = Vec::new();
    for token in tokens {
        match token {
            TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => {
                write_line(out, &mut line, " {", depth);
                write_items(out, group.stream(), depth + 1);
                write_line(out, &mut line, "}", depth);
            }
            token => {
                let is_end = matches!(&token, TokenTree::Punct(sign) if sign.as_char() == ';');
                line.push(token);
                if is_end {
                    write_line(out, &mut line, "", depth);
                }
            }
        }
    }
    if !line.is_empty() {
        write_line(out, &mut line, "", depth);
    }
}

fn write_line(out: &mut String, line: &mut Vec<TokenTree>, end: &str, depth: usize) {
    let start = out.len();
    out.extend(std::iter::repeat_n(' ', depth));
    out.push_str(&line.drain(..).collect::<TokenStream>().to_string());
    out.push_str(end);
    let hint = hint(&out[start..]);
    out.push_str(hint);
    out.push('\n');
}

/// What the compiler shows with a line: when there is no `firmware-glue`, and when the file was made for another layout of it.
fn hint(line: &str) -> &'static str {
    // A text of the specification may end like these, in a comment.
    let used = line.strip_prefix("use ").and_then(|line| line.strip_suffix(';'));
    match used.and_then(|used| used.split_whitespace().last()) {
        Some("firmware") => " // An error here? Add `firmware-glue` to the dependencies.",
        Some("glue") => " // An error here? Generate this file again.",
        _ => "",
    }
}

fn header(device: &Dictionary, provenance: &Provenance) -> String {
    format!("// Object dictionary `{}` of {}.\n// {GENERATED}\n\n", device.key, provenance.name())
}

/// Puts blank lines between items: printers leave them out.
#[cfg(feature = "format")]
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

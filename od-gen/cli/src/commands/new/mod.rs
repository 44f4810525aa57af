//! `odgen new`: a commented specification to start from, and a firmware for it.

mod args;
mod drive;
mod firmware;
mod io;
mod template;

use std::path::Path;

use od_gen::Artifact;
use od_gen::files::{Existing, write_set};
use od_spec::diag::{Diagnostic, codes};
use od_spec::file_name;
use od_spec::model::System;
use od_spec::source::SourceMap;
use od_spec::{NoFiles, compile, is_device_key};

use crate::output::not_written;
use crate::report::{Report, print, shown as shown_path};
pub(crate) use args::NewArgs;
use args::{Firmware, Profile};
use template::fill;

pub(crate) fn run(args: &NewArgs, report: &Report) -> u8 {
    match new(args) {
        Ok(text) => print(&text),
        Err(diagnostic) => report.refuse(diagnostic),
    }
}

fn new(args: &NewArgs) -> Result<String, Diagnostic> {
    let key = args.name.as_str();
    check_key(key)?;
    if args.profile != Profile::Cia402 && !args.modes.is_empty() {
        let message = "`--modes` is for drives, and other devices have no modes of operation";
        return Err(Diagnostic::without_place(codes::UNKNOWN_WORD, message).help("add `--profile cia402`"));
    }
    if args.profile != Profile::Cia401
        && let Some(number) = io::first_number(args)
    {
        let message = format!("`{number}` is for I/O modules, and other devices have no such channels");
        return Err(Diagnostic::without_place(codes::UNKNOWN_WORD, message).help("add `--profile cia401`"));
    }
    let (text, kind) = match args.profile {
        Profile::Cia301 => (device(key)?, "a device without a device profile".to_owned()),
        Profile::Cia401 => {
            let channels = io::Channels::of(args)?;
            (channels.specification(key)?, format!("an I/O module with {channels}"))
        }
        Profile::Cia402 => {
            let modes = drive::modes(&args.modes)?;
            (drive::specification(key, &modes)?, format!("a drive with {}", drive::list(&modes)))
        }
    };
    if args.glue.is_some() && args.firmware != Some(Firmware::Rust) {
        let message = "`--glue` is for firmware in Rust, and nothing else has crates";
        return Err(Diagnostic::without_place(codes::UNKNOWN_WORD, message).help("add `--firmware rust`"));
    }
    let glue = args.glue.as_deref().map(firmware::clone).transpose()?;
    let name = format!("{key}.od.yaml");
    // A project has a directory of its own.
    let directory = if args.firmware.is_some() { args.out.join(key) } else { args.out.clone() };
    let path = directory.join(&name);
    if path.symlink_metadata().is_ok() {
        let shown = path.strip_prefix(".").unwrap_or(&path);
        let message = format!("cannot write `{}`: it is there already", file_name::shown(shown));
        return Err(Diagnostic::without_place(codes::WRITE_FAILED, message)
            .help("choose another name or, with `--out`, another directory"));
    }
    if args.out.is_file() {
        let message = format!("cannot write into `{}`: it is a file", file_name::shown(&args.out));
        return Err(
            Diagnostic::without_place(codes::WRITE_FAILED, message).help("name a directory with `--out`")
        );
    }
    let system = compiled(&name, &text).ok_or_else(|| {
        let message = format!("a specification with the key `{key}` does not compile");
        Diagnostic::without_place(codes::BAD_NOTATION, message).help("choose another name")
    })?;
    let objects: usize = system.devices.iter().map(|device| device.objects.len()).sum();
    let mut files = vec![Artifact { path: name, bytes: text.into_bytes(), purpose: String::new() }];
    if let Some(firmware) = args.firmware {
        files.extend(firmware::files(firmware, key, glue.as_deref(), &system)?);
    }
    write_set(&directory, &files, Existing::None).map_err(|error| not_written(&error))?;
    let shown = |path: &Path| shown_path(path.strip_prefix(".").unwrap_or(path));
    let path = shown(&path);
    let specification = format!("  {path}  {kind}, {objects} objects\n");
    let rest = match args.firmware {
        Some(firmware) => {
            let project =
                files.iter().skip(1).map(|file| format!("  {}\n", shown(&directory.join(&file.path))));
            project.chain([firmware::next(firmware, &shown(&directory), key, glue.as_deref())]).collect()
        }
        None => format!("next: fill in what is marked with <--, then `odgen build {path} --docs html`\n"),
    };
    Ok(specification + &rest)
}

fn check_key(key: &str) -> Result<(), Diagnostic> {
    // `null` is nothing in YAML.
    if is_device_key(key) && key != "null" {
        return Ok(());
    }
    let message = format!("found `{key}`, expected the key of a device");
    Err(Diagnostic::without_place(codes::BAD_NOTATION, message)
        .help("a key has up to 32 lower-case letters, digits and hyphens, such as `my-device`"))
}

fn device(key: &str) -> Result<String, Diagnostic> {
    fill(include_str!("device.od.yaml"), key, &[])
}

fn compiled(name: &str, text: &str) -> Option<System> {
    let mut sources = SourceMap::new();
    let root = sources.add(name, text);
    compile(&mut sources, root, &mut NoFiles).system
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Compiles a starter that is filled in.
    pub(super) fn compiled(key: &str, text: &str) -> System {
        let mut sources = SourceMap::new();
        // What is to be filled in counts as filled in.
        let root = sources.add(key, text.replace("# <--", "#"));
        let compiled = compile(&mut sources, root, &mut NoFiles);
        // The vendor's number is to be filled in.
        let messages: Vec<String> = compiled
            .diagnostics
            .iter()
            .filter(|diagnostic| diagnostic.code != od_spec::rule_codes::NO_VENDOR_NUMBER)
            .map(|diagnostic| format!("{}: {}", diagnostic.code, diagnostic.message))
            .collect();
        assert_eq!(messages, Vec::<String>::new(), "{text}");
        compiled.system.expect("no errors")
    }

    #[test]
    fn the_plain_device_compiles_clean() {
        compiled("plain", &device("plain").unwrap());
    }
}

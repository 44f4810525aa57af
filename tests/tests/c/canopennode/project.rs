//! A firmware project as small as can be: the files of a device, the interface of the stack, and a program of the tests.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::slice;
use std::sync::atomic::{AtomicUsize, Ordering};

use od_c::{self as c, Kind, Options, Prefix};
use od_formats::json;
use od_gen::Provenance;
use od_spec::diag::Diagnostics;
use od_spec::diag::render::{Format, render};
use od_spec::model::System;
use od_spec::source::SourceMap;
use od_spec::{Compiled, compile};
use od_tests::c_dictionary::{LANGUAGE, WARNINGS};
use od_tests::{OfWorkspace, compile_with_sources, root};
use serde_json::Value as Json;

/// The files of one device, in a directory of their own.
pub(crate) struct Project {
    folder: PathBuf,
    prefix: Prefix,
    /// The device in the dump.
    pub(crate) device: Json,
    /// The whole dump.
    pub(crate) dump: Json,
    /// What was reported when the files were made.
    pub(crate) reported: String,
}

/// What makes the stack include the settings of a dictionary.
pub(crate) const CUSTOM: &str = "-DCO_DRIVER_CUSTOM";

/// Of some programs, those that are there.
fn found<const N: usize>(programs: [&'static str; N]) -> Vec<&'static str> {
    let is_there = |program: &&str| {
        Command::new(program).arg("--version").output().is_ok_and(|output| output.status.success())
    };
    programs.into_iter().filter(is_there).collect()
}

/// The projects of all devices of a specification of the workspace.
pub(crate) fn of_workspace(path: &str) -> Vec<Project> {
    let (system, sources) = compile_with_sources(path).unwrap();
    let stem = Path::new(path).file_name().unwrap().to_string_lossy().into_owned();
    of_system(&system, &sources, &Kind::CanopenNode.into(), &stem)
}

/// The project of a text, as a specification or, by its name, an EDS.
pub(crate) fn of_text(name: &str, text: &str) -> Project {
    let (system, sources) = compiled(name, text);
    of_system(&system, &sources, &Kind::CanopenNode.into(), name).remove(0)
}

/// The same with a prefix.
pub(crate) fn with_prefix(name: &str, text: &str, prefix: &str) -> Project {
    let (system, sources) = compiled(name, text);
    let options = Options { kinds: vec![Kind::CanopenNode], prefix: prefix.parse().unwrap() };
    of_system(&system, &sources, &options, name).remove(0)
}

/// What is reported about a text that is refused, or of which C is made: the messages, and whether there are files.
pub(crate) fn reported(name: &str, text: &str) -> (String, bool) {
    let (system, sources) = compiled(name, text);
    let mut diagnostics = Diagnostics::new();
    let set = c::artifacts(
        &system,
        system.devices.iter(),
        &Provenance::of(&sources),
        &Kind::CanopenNode.into(),
        &mut diagnostics,
    );
    (render(&diagnostics, &sources, Format::Human, false), !set.is_empty())
}

fn compiled(name: &str, text: &str) -> (System, SourceMap) {
    let mut sources = SourceMap::new();
    let root = sources.add(name, text);
    let Compiled { system, diagnostics, .. } = compile(&mut sources, root, &mut OfWorkspace);
    (system.unwrap_or_else(|| panic!("{}", render(&diagnostics, &sources, Format::Human, false))), sources)
}

/// Of how many systems there are projects: tests run side by side, and several are about one device.
static PROJECTS: AtomicUsize = AtomicUsize::new(0);

fn of_system(system: &System, sources: &SourceMap, options: &Options, name: &str) -> Vec<Project> {
    let mut diagnostics = Diagnostics::new();
    let set =
        c::artifacts(system, system.devices.iter(), &Provenance::of(sources), options, &mut diagnostics);
    let reported = render(&diagnostics, sources, Format::Human, false);
    assert!(!diagnostics.has_errors(), "{reported}");
    let dump: Json = serde_json::from_slice(&json::dump(system, &[])).unwrap();
    let number = PROJECTS.fetch_add(1, Ordering::Relaxed);
    let folder = root().join(format!("target/canopennode/{number}-{name}"));
    if folder.exists() {
        std::fs::remove_dir_all(&folder).unwrap();
    }
    for file in &set {
        let path = folder.join(&file.path);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, &file.bytes).unwrap();
    }
    let folders: BTreeSet<&str> =
        set.iter().filter_map(|file| file.path.rsplit_once('/')).map(|(folder, _)| folder).collect();
    let devices = dump["devices"].as_array().unwrap();
    assert_eq!(folders.len(), devices.len());
    let of_device = |device: &Json| {
        let key = device["key"].as_str().unwrap().replace(['-', ' ', '.'], "_").to_lowercase();
        let is_of_device = |path: &&&str| {
            path.rsplit('/').next().is_some_and(|folder| folder.trim_start_matches("device_") == key)
        };
        let path = folders.iter().find(is_of_device).unwrap();
        Project {
            folder: folder.join(path),
            prefix: options.prefix.clone(),
            device: device.clone(),
            dump: dump.clone(),
            reported: reported.clone(),
        }
    };
    devices.iter().map(of_device).collect()
}

/// Compiles the files of dictionaries with a program of the tests, by every compiler that is there, and runs the last one.
pub(crate) fn run_together(projects: &[Project], program: &str, arguments: &[&Path]) -> String {
    let tests = root().join("tests/c/canopennode");
    let first = &projects[0];
    let mut output = None;
    let mut folders: Vec<PathBuf> = vec![tests.clone()];
    folders.extend(projects.iter().map(|project| project.folder.clone()));
    let folders: Vec<String> = folders.iter().map(|folder| format!("-I{}", folder.display())).collect();
    let generated: Vec<PathBuf> = projects
        .iter()
        .flat_map(|Project { prefix, folder, .. }| {
            [".c", "_extension.c", "_rules.c"].map(|ending| folder.join(format!("{prefix}{ending}")))
        })
        .collect();
    let own = ["interface.c", program].map(|file| tests.join(file));
    let mut compilers = found(["gcc", "clang"]);
    if compilers.is_empty() {
        // What Rust links with is one of them.
        compilers = found(["cc"]);
    }
    for compiler in compilers {
        let made = first.folder.join(format!("{program}-{compiler}"));
        let mut command = Command::new(compiler);
        command.args([LANGUAGE, CUSTOM, "-fsanitize=undefined", "-fno-sanitize-recover=undefined"]);
        command.args(WARNINGS).args(&folders).args(&generated).args(&own).arg("-o").arg(&made);
        succeeds(&command.output().unwrap(), &format!("{compiler}: {}", first.key()));
        let ended = Command::new(&made).args(arguments).output().unwrap();
        output = Some(succeeds(&ended, &format!("{program}: {}", first.key())));
    }
    for compiler in found(["g++", "clang++"]) {
        for Project { prefix, .. } in projects {
            let names = [
                format!("-DDICTIONARY={prefix}"),
                format!("-DHEADER=\"{prefix}.h\""),
                format!("-DEXTENSION=\"{prefix}_extension.h\""),
            ];
            let mut command = Command::new(compiler);
            command.args(["-std=c++11", CUSTOM, "-fsyntax-only"]).args(names).args(WARNINGS).args(&folders);
            let ended = command.arg(tests.join("includes.cpp")).output().unwrap();
            succeeds(&ended, &format!("{compiler}: {}", first.key()));
        }
    }
    assert!(output.is_some(), "generated C is compiled: install a C compiler");
    output.unwrap()
}

impl Project {
    /// A file of the device.
    pub(crate) fn file(&self, name: &str) -> String {
        std::fs::read_to_string(self.folder.join(name)).unwrap()
    }

    pub(crate) fn key(&self) -> &str {
        self.device["key"].as_str().unwrap()
    }

    /// Compiles the files with a program of the tests, by every compiler that is there, and runs the last one.
    pub(crate) fn run(&self, program: &str, arguments: &[&Path]) -> String {
        run_together(slice::from_ref(self), program, arguments)
    }

    /// What a compiler says of a file with settings of a project.
    pub(crate) fn complaints(&self, file: &str, settings: &[&str]) -> String {
        let tests = root().join("tests/c/canopennode");
        let folders = ["-I".as_ref(), tests.as_os_str(), "-I".as_ref(), self.folder.as_os_str()];
        let mut command = Command::new("cc");
        command.args([LANGUAGE, "-fsyntax-only"]).args(settings).args(folders);
        let output = command.arg(self.folder.join(file)).output().unwrap();
        String::from_utf8_lossy(&output.stderr).into_owned()
    }

    /// Writes a file next to those of the device.
    pub(crate) fn beside(&self, name: &str, bytes: &[u8]) -> PathBuf {
        let path = self.path(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, bytes).unwrap();
        path
    }

    /// Where a file of the device is.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }
}

fn succeeds(output: &Output, what: &str) -> String {
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && said.is_empty(), "{what}:\n{said}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

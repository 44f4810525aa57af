//! The command as its users meet it: exit codes, messages, files.

#![expect(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

mod book;
mod build;
mod check;
mod check_inputs;
mod check_policy;
mod check_readers;
mod codes;
mod concise;
mod dbc;
mod dcf;
mod decode;
mod diff;
mod dirt;
mod docs;
mod files;
mod fix;
mod fmt;
mod foreign;
mod formats;
mod import;
#[path = "../../../../tests/shared/shipped.rs"]
mod in_one_file;
mod machine;
mod monitor;
mod named_files;
mod new;
mod node;
mod node_of_file;
mod operators;
mod parts;
mod plant;
mod program;
mod provoked;
mod relay;
mod serve;
mod served;
mod shipped;
mod specify;
mod specs;
mod st;
mod texts;
#[cfg(unix)]
mod tutorial;
mod xdd;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const PITCH: &str =
    concat!(env!("CARGO_MANIFEST_DIR"), "/../../od-spec/devices/pitch-control-system.od.yaml");

const LAMP: &str = "\
od-spec: 1
title: Lamp
uses: [cia301]
devices:
  lamp: {name: Lamp, bit-rates: [125, 500], features: [heartbeat producer]}
units:
  percent: {symbol: \"%\"}
objects:
  0x2000: {name: brightness, type: unsigned8, unit: percent, access: rw, pdo: receive, default: 80 %, max: 100 %}
pdos:
  lamp:
    receive: {1: {map: [brightness]}}
";

/// A faulty EDS: a name twice, words instead of 0 and 1 in four places, an unknown access type, bit patterns.
const MIXER: &str = include_str!("eds/mixer.eds");

/// An EDS with two faults, and the DCF of a node without any.
const FAN: &str = include_str!("eds/fan.eds");
const ROOF_FAN: &str = include_str!("eds/fan.dcf");

/// A directory of its own for one test, removed at the end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("odgen-cli-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn file(&self, name: &str, text: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.join(name);
        fs::write(&path, text).unwrap();
        path
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn odgen(directory: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_odgen")).current_dir(directory).args(arguments).output().unwrap()
}

fn code(output: &Output) -> i32 {
    output.status.code().expect("no signal")
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

fn files(directory: &Path) -> Vec<String> {
    let mut names = Vec::new();
    for entry in fs::read_dir(directory).unwrap() {
        let entry = entry.unwrap();
        let name = entry.file_name().to_string_lossy().into_owned();
        if entry.file_type().unwrap().is_dir() {
            names.extend(files(&entry.path()).into_iter().map(|below| format!("{name}/{below}")));
        } else {
            names.push(name);
        }
    }
    names.sort();
    names
}

//! The project's own tasks: `cargo xtask help` lists them.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a command talks to its user")]

use std::process::{Command, ExitCode};

use od_gen::docs;
use od_gen::eds::write_dcf;
use od_gen::files::write_all;
use od_gen::{Artifact, Selection, artifacts, json};
use od_spec::diag::Diagnostics;
use od_spec::diag::render::{Format, render};
use od_spec::model::System;
use od_spec::source::{SourceMap, Spanned};
use od_spec::{Commissioning, assign};
use od_tests::generate::SPECS;
use od_tests::{Failure, compile_clean, generate, root};

const HELP: &str = "\
cargo xtask TASK

  test [--without-emulator] [--without-browser]
                     run every test; puts what the foreign readers need into target/. The firmware for an emulated
                     Cortex-M needs QEMU, the linker arm-none-eabi-ld and the target thumbv7em-none-eabi; the documents
                     are read in Chromium and printed, which needs pdftotext, too
  generate [--check] rewrite everything that is generated and checked in, or tell what is not current
  browser            the part of `test` that reads the documents in Chromium
  bench              measure odgen beside other tools
";

/// What `test` can leave out, where its programs are not to be had.
const WITHOUT: [&str; 2] = ["--without-emulator", "--without-browser"];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let result = match arguments.as_slice() {
        ["test", options @ ..] if options.iter().all(|option| WITHOUT.contains(option)) => test(options),
        ["generate"] => write(),
        ["generate", "--check"] => check(),
        ["browser"] => browser(),
        ["bench", rest @ ..] => python("tests/bench/run.py", rest),
        ["help" | "--help"] => {
            print!("{HELP}");
            Ok(())
        }
        _ => {
            eprint!("{HELP}");
            return ExitCode::from(2);
        }
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            ExitCode::FAILURE
        }
    }
}

/// All Rust tests, then the foreign readers.
fn test(options: &[&str]) -> Result<(), Failure> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    run(Command::new(cargo).args(["test", "--workspace", "--no-fail-fast"]))?;
    python("tests/readers/selftest/selftest.py", &[])?;
    // A device with every feature and data type, which the shipped devices do not have.
    let system = compile_clean("tests/readers/everything.od.yaml")?;
    let set = artifacts(&system, "everything", &Selection { devices: &[], node: Some(5) });
    write_all(&root().join("target/everything"), &set)?;
    let everything =
        ["--eds-dir", "target/everything/eds", "--dump", "target/everything/everything.json", "--node", "5"];
    python("tests/readers/run.py", &everything)?;
    write_configured(&system)?;
    let configured = ["--eds-dir", CONFIGURED, "--values", "target/everything/configured/values.txt"];
    python("tests/readers/run.py", &[&configured[..], &everything[2..]].concat())?;
    python("tests/readers/run.py", &[])?;
    read_drives()?;
    for stem in SPECS {
        sdo_client(stem)?;
    }
    if options.contains(&"--without-browser") {
        println!("left out: the documents in a browser, tests/browser");
    } else {
        browser()?;
    }
    if options.contains(&"--without-emulator") {
        println!("left out: the firmware in tests/thumb");
        return Ok(());
    }
    python("tests/thumb/run.py", &["sizes"])?;
    python("tests/thumb/run.py", &["test"])
}

/// The drive of the README, and what `odgen new` starts with, read by every foreign reader.
fn read_drives() -> Result<(), Failure> {
    let odgen = std::env::current_exe()?.with_file_name("odgen");
    let folder = root().join("target/drives");
    if folder.exists() {
        std::fs::remove_dir_all(&folder)?;
    }
    std::fs::create_dir_all(&folder)?;
    let new = |name: &str, modes: &[&str]| {
        run(Command::new(&odgen).args(["new", name, "--out"]).arg(&folder).args(modes))
    };
    new("started", &[])?;
    new("started-pp-hm", &["--profile", "cia402", "--modes", "profile position,homing"])?;
    new("started-all", &["--profile", "cia402", "--modes", "pp,vl,pv,tq,hm,ip,csp,csv,cst"])?;
    std::fs::copy(root().join("tests/readme/lift.od.yaml"), folder.join("lift.od.yaml"))?;
    let mut dumps = Vec::new();
    for stem in ["lift", "started", "started-all", "started-pp-hm"] {
        let system = compile_clean(&format!("target/drives/{stem}.od.yaml"))?;
        write_all(&folder, &artifacts(&system, stem, &Selection { devices: &[], node: Some(1) }))?;
        dumps.push(format!("target/drives/{stem}.json"));
    }
    let mut arguments = vec!["--eds-dir", "target/drives/eds", "--dump"];
    arguments.extend(dumps.iter().map(String::as_str));
    python("tests/readers/run.py", &arguments)
}

/// The documents as their readers see them.
fn browser() -> Result<(), Failure> {
    const DOCS: &str = "target/browser/docs";
    let mut directories = Vec::new();
    let specs = SPECS.iter().map(|stem| (*stem, format!("od-spec/devices/{stem}.od.yaml"), "en"));
    let more = [
        ("fullmo-drive-de", "od-spec/devices/fullmo-drive.od.yaml", "de"),
        ("everything", "tests/readers/everything.od.yaml", "en"),
        ("two", "tests/docs/two.od.yaml", "en"),
        ("two-de", "tests/docs/two.od.yaml", "de"),
    ];
    for (stem, path, language) in specs.chain(more.map(|(stem, path, lang)| (stem, path.to_owned(), lang))) {
        let system = compile_clean(&path)?;
        let options = docs::options(&system, &[], Some(language));
        let html = [docs::Templates::new(Some(docs::Format::Html), &[])?];
        let mut set = docs::artifacts(&system, "", stem, &options, &html)?;
        let beside = [("dump", json::dump(&system, &[])), ("context", docs::dump_context(&system, &options))];
        set.extend(beside.map(|(name, bytes)| Artifact {
            path: format!("{stem}/{name}.json"),
            bytes,
            purpose: String::new(),
        }));
        let example = [docs::Templates::new(None, &example()?)?];
        set.extend(docs::artifacts(&system, "", &format!("{stem}-asciidoc"), &options, &example)?);
        write_all(&root().join(DOCS), &set)?;
        directories.extend([format!("{DOCS}/{stem}"), format!("{DOCS}/{stem}-asciidoc")]);
    }
    let directories: Vec<&str> = directories.iter().map(String::as_str).collect();
    python("tests/browser/run.py", &directories)
}

/// The templates of the AsciiDoc example.
fn example() -> Result<Vec<(String, String)>, Failure> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(root().join("docs-gen/examples/asciidoc"))? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        files.push((name, std::fs::read_to_string(path)?));
    }
    files.sort();
    Ok(files)
}

/// A client that others wrote, against the generated Rust.
fn sdo_client(stem: &str) -> Result<(), Failure> {
    let server = std::env::current_exe()?.with_file_name("sdo-server");
    let python = root().join("target/readers/venv/bin/python");
    let dump = format!("generated/{stem}.json");
    let arguments = ["--eds-dir", "generated/eds", "--dump", &dump, "--server"];
    run(Command::new(python).arg("tests/readers/sdo_client.py").args(arguments).arg(server))
}

/// Where the DCF with [`SETTINGS`] is put.
const CONFIGURED: &str = "target/everything/configured";

/// Settings of `everything.od.yaml` for node 5 in every data type that can be set, and what a DCF must say: the entry
/// and its raw number or text.
const SETTINGS: [(&str, &str); 29] = [
    ("2000=no", "2000.0 0"),
    ("2001=-127", "2001.0 -127"),
    ("2002=32767", "2002.0 32767"),
    ("2003=8388607", "2003.0 8388607"),
    ("2004=2147483646", "2004.0 2147483646"),
    ("2005=-549755813888", "2005.0 -549755813888"),
    ("2006=140737488355327", "2006.0 140737488355327"),
    ("2007=-36028797018963968", "2007.0 -36028797018963968"),
    ("2008=9223372036854775807", "2008.0 9223372036854775807"),
    ("2009=1", "2009.0 1"),
    ("200A=0x1234", "200A.0 4660"),
    ("200B=1", "200B.0 1"),
    ("200C=$NODEID + 0x700", "200C.0 1797"),
    ("200D=1099511627775", "200D.0 1099511627775"),
    ("200E=281474976710655", "200E.0 281474976710655"),
    ("200F=72057594037927935", "200F.0 72057594037927935"),
    ("2010=18446744073709551614", "2010.0 18446744073709551614"),
    ("2011=0.1", "2011.0 0.1"),
    ("2012=-2.5e300", "2012.0 -2.5e300"),
    ("2013=Good bye", "2013.0 Good bye"),
    ("2014=ff 00 A5", "2014.0 FF00A5"),
    ("2015=another text", "2015.0 another text"),
    ("a mode=forward", "2019.0 1"),
    ("201A=0x0007", "201A.0 7"),
    ("201B=21.5 °C", "201B.0 215"),
    ("201C.12=3", "201C.12 3"),
    ("1404.1=0x6F4", "1404.1 1780"),
    ("1605.0=1", "1605.0 1"),
    ("1605.1=0x20090008", "1605.1 537460744"),
];

/// A DCF with every setting, and the list of what it must say.
fn write_configured(system: &System) -> Result<(), Failure> {
    let device = system.devices.first().ok_or("everything.od.yaml has no device")?;
    let mut sources = SourceMap::new();
    let settings = SETTINGS.map(|(setting, _)| {
        let file = sources.add("SETTINGS", setting);
        Spanned::new(setting.to_owned(), sources.whole(file))
    });
    let mut diagnostics = Diagnostics::new();
    let mut commissioning = Commissioning::of_node(device, 5);
    commissioning.values = assign(system, device, commissioning.node, &settings, &mut diagnostics);
    if !diagnostics.is_empty() {
        return Err(render(&diagnostics, &sources, Format::Human, false).into());
    }
    let file = format!("{}.dcf", device.key);
    let bytes = write_dcf(system, device, &commissioning, &file);
    let values = SETTINGS.map(|(_, value)| format!("{value}\n")).concat();
    let set = [
        Artifact { path: file, bytes, purpose: String::new() },
        Artifact { path: "values.txt".to_owned(), bytes: values.into_bytes(), purpose: String::new() },
    ];
    write_all(&root().join(CONFIGURED), &set)?;
    Ok(())
}

fn write() -> Result<(), Failure> {
    for (path, changed) in generate::write_all()? {
        println!("{} {path}", if changed { "wrote" } else { "     " });
    }
    Ok(())
}

fn check() -> Result<(), Failure> {
    match generate::first_difference()? {
        None => Ok(()),
        Some(difference) => Err(difference.into()),
    }
}

fn python(script: &str, arguments: &[&str]) -> Result<(), Failure> {
    run(Command::new("python3").arg(script).args(arguments))
}

/// Runs a command at the root of the workspace.
fn run(command: &mut Command) -> Result<(), Failure> {
    let status =
        command.current_dir(root()).status().map_err(|error| format!("cannot run {command:?}: {error}"))?;
    if status.success() { Ok(()) } else { Err(format!("{command:?} failed ({status})").into()) }
}

//! EDS and DCF files, read by tools that others wrote.

use std::path::{Path, PathBuf};
use std::process::Command;

use od_formats::{Selection, artifacts};
use od_gen::files::write_all;
use od_spec::model::System;
use od_spec::source::SourceMap;
use od_tests::generate::SPECS;
use od_tests::{Failure, compile_clean, compile_with_sources, root};

use crate::configured::{CONFIGURED, write_configured};
use crate::parts::Amount;
use crate::runner::{Runner, beside};
use crate::virtual_nodes;

/// The shipped specifications that so much is.
const fn specs(amount: Amount) -> &'static [&'static str] {
    match amount {
        Amount::Sample => &["fullmo-drive"],
        Amount::All => &SPECS,
    }
}

/// Where the readers are installed.
const VENV: &str = "target/readers/venv";
/// Where to find the files of `everything.od.yaml` and what they must say, for node 5.
const EVERYTHING: [&str; 4] = ["--dump", "target/everything/everything.json", "--node", "5"];

pub(crate) fn every_feature(runner: &mut Runner) -> Result<(), Failure> {
    write_everything()?;
    runner
        .python("tests/readers/run.py", &[&["--eds-dir", "target/everything/eds"], &EVERYTHING[..]].concat())
}

pub(crate) fn configured(runner: &mut Runner) -> Result<(), Failure> {
    let (system, sources) = write_everything()?;
    write_configured(&system, sources)?;
    let values = ["--eds-dir", CONFIGURED, "--values", "target/everything/configured/values.txt"];
    runner.python("tests/readers/run.py", &[&values[..], &EVERYTHING].concat())
}

/// Writes the EDS, DCF and dump of `everything.od.yaml`.
fn write_everything() -> Result<(System, SourceMap), Failure> {
    let (system, sources) = compile_with_sources("tests/readers/everything.od.yaml")?;
    let set = artifacts(&system, "everything", &Selection { node: Some(5), ..Selection::default() });
    write_all(&root().join("target/everything"), &set)?;
    Ok((system, sources))
}

/// The drive of the book, and what `odgen new` starts with, read by every foreign reader.
pub(crate) fn drives(runner: &mut Runner) -> Result<(), Failure> {
    let odgen = beside("odgen")?;
    let folder = root().join("target/drives");
    if folder.exists() {
        std::fs::remove_dir_all(&folder)?;
    }
    std::fs::create_dir_all(&folder)?;
    let mut new = |name: &str, modes: &[&str]| {
        runner.run(Command::new(&odgen).args(["new", name, "--out"]).arg(&folder).args(modes))
    };
    new("started", &[])?;
    new("started-pp-hm", &["--profile", "cia402", "--modes", "profile position,homing"])?;
    new("started-all", &["--profile", "cia402", "--modes", "pp,vl,pv,tq,hm,ip,csp,csv,cst"])?;
    new(
        "started-io",
        &["--profile", "cia401", "--inputs", "20", "--outputs", "9", "--analogue-inputs", "6"],
    )?;
    std::fs::copy(root().join("tests/book/lift.od.yaml"), folder.join("lift.od.yaml"))?;
    let mut dumps = Vec::new();
    for stem in ["lift", "started", "started-all", "started-io", "started-pp-hm"] {
        // What is to be filled in counts as filled in.
        let path = folder.join(format!("{stem}.od.yaml"));
        std::fs::write(&path, std::fs::read_to_string(&path)?.replace("# <--", "#"))?;
        let system = compile_clean(&format!("target/drives/{stem}.od.yaml"))?;
        write_all(&folder, &artifacts(&system, stem, &Selection { node: Some(1), ..Selection::default() }))?;
        dumps.push(format!("target/drives/{stem}.json"));
    }
    let mut arguments = vec!["--eds-dir", "target/drives/eds", "--dump"];
    arguments.extend(dumps.iter().map(String::as_str));
    runner.python("tests/readers/run.py", &arguments)
}

/// The option of scripts that look at so much.
const fn sample(amount: Amount) -> &'static [&'static str] {
    match amount {
        Amount::Sample => &["--sample"],
        Amount::All => &[],
    }
}

/// The scripts of the readers themselves: they notice planted mistakes.
pub(crate) fn self_test(runner: &mut Runner) -> Result<(), Failure> {
    runner.python("tests/readers/selftest/selftest.py", &[])
}

/// Files with planted faults: which readers refuse them, as `odgen check` predicts it.
pub(crate) fn predicted(runner: &mut Runner, amount: Amount) -> Result<(), Failure> {
    let odgen = beside("odgen")?;
    let script = Path::new("tests/readers/predictions.py");
    runner.run(Command::new("python3").arg(script).args(sample(amount)).arg("--odgen").arg(odgen))
}

/// That commands take no more instructions than a table has. They are counted on any machine, but depend on how the program was
/// compiled: the table is of a build without incremental compilation, as that of the gate.
pub(crate) fn instructions(runner: &mut Runner) -> Result<(), Failure> {
    let odgen = beside("odgen")?;
    let table = "tests/bench/instructions.tsv";
    runner.run(
        Command::new("python3")
            .args(["tests/bench/instructions.py", "--held-to", table, "--odgen"])
            .arg(odgen),
    )
}

/// What eds2c makes of the EDS files of the shipped devices.
pub(crate) fn firmware_in_c(runner: &mut Runner) -> Result<(), Failure> {
    let Some(python) = python_of_readers(runner) else { return Ok(()) };
    let dumps = SPECS.map(|stem| format!("generated/{stem}.json"));
    let odgen = beside("odgen")?;
    let arguments = ["tests/readers/eds2c.py", "--eds-dir", "generated/eds", "--odgen"];
    runner.run(Command::new(&python).args(arguments).arg(odgen).arg("--dump").args(dumps))
}

/// What dcfgen makes of the same values, compared with the concise DCF files of odgen.
pub(crate) fn concise_dcf(runner: &mut Runner) -> Result<(), Failure> {
    let Some(python) = python_of_readers(runner) else { return Ok(()) };
    let odgen = beside("odgen")?;
    runner.run(Command::new(&python).args(["tests/readers/lely_dcfgen.py", "--odgen"]).arg(odgen))
}

/// The XDD and XDC files of the shipped devices and of the one with every feature.
pub(crate) fn xdd_structure(runner: &mut Runner) -> Result<(), Failure> {
    const FOLDER: &str = "target/xdd";
    let shipped = SPECS.map(|stem| (stem, format!("od-spec/devices/{stem}.od.yaml")));
    let everything = ("everything", "tests/readers/everything.od.yaml".to_owned());
    let mut dumps = Vec::new();
    for (stem, path) in shipped.into_iter().chain([everything]) {
        let system = compile_clean(&path)?;
        let selection = Selection { node: Some(5), xdd: true, ..Selection::default() };
        write_all(&root().join(FOLDER), &artifacts(&system, stem, &selection))?;
        dumps.push(format!("{FOLDER}/{stem}.json"));
    }
    let mut arguments = vec!["--xdd-dir", "target/xdd/xdd", "--node", "5", "--dump"];
    arguments.extend(dumps.iter().map(String::as_str));
    runner.python("tests/readers/xdd_structure.py", &arguments)?;
    let odgen = beside("odgen")?;
    let odgen = odgen.to_string_lossy();
    let mut files =
        vec!["--odgen".to_owned(), odgen.into_owned(), "od-gen/cli/tests/cli/eds/tank.xdd".to_owned()];
    for entry in std::fs::read_dir(root().join(FOLDER).join("xdd"))? {
        files.push(entry?.path().to_string_lossy().into_owned());
    }
    files[3..].sort();
    runner.python("tests/readers/xdd_foreign.py", &files.iter().map(String::as_str).collect::<Vec<_>>())
}

/// Every DCF of a plant, read by dcfchk and python-canopen.
pub(crate) fn plant(runner: &mut Runner) -> Result<(), Failure> {
    let Some(python) = python_of_readers(runner) else { return Ok(()) };
    let odgen = beside("odgen")?;
    // Of the shipped devices, and what the book shows step by step.
    ["tests/readers/plant.py", "tests/readers/book_plant.py"]
        .into_iter()
        .try_for_each(|script| runner.run(Command::new(&python).args([script, "--odgen"]).arg(&odgen)))
}

/// What the commands make of DCF files, with and without values and a node-ID, compared with what python-canopen reads of them.
pub(crate) fn values_of_nodes(runner: &mut Runner) -> Result<(), Failure> {
    let Some(python) = python_of_readers(runner) else { return Ok(()) };
    let odgen = beside("odgen")?;
    let arguments = ["tests/readers/node_values.py", "--self-test", "tests/readers/nodes", "--odgen"];
    runner.run(Command::new(&python).args(arguments).arg(&odgen))
}

/// What `odgen node` does when something goes wrong in the middle of a command; all commands, as the chapter for operators shows it.
pub(crate) fn faults(runner: &mut Runner, amount: Amount) -> Result<(), Failure> {
    let Some(python) = python_of_readers(runner) else { return Ok(()) };
    let odgen = beside("odgen")?;
    let commands: &[&str] = match amount {
        Amount::Sample => &["--only", "restore"],
        Amount::All => &["--self-test"],
    };
    runner.run(
        Command::new(&python).arg("tests/readers/fault_matrix.py").args(commands).arg("--odgen").arg(&odgen),
    )
}

/// The book: MkDocs follows each link and anchor, and takes no warning.
pub(crate) fn book(runner: &mut Runner) -> Result<(), Failure> {
    let Some(python) = python_of_readers(runner) else { return Ok(()) };
    let arguments = ["-m", "mkdocs", "build", "--strict", "--config-file", "docs/mkdocs.yml"];
    // It announces its successor otherwise.
    runner.run(Command::new(&python).args(arguments).env("NO_MKDOCS_2_WARNING", "1"))
}

/// The Python that the readers are installed for, if that could be done.
fn python_of_readers(runner: &mut Runner) -> Option<PathBuf> {
    let environment = root().join(VENV);
    if environment.join("stamp").exists() {
        return Some(environment.join("bin/python"));
    }
    runner.gap = Some("the readers in Python could not be installed, see above".to_owned());
    None
}

/// Frames of the generated Rust, decoded by cantools with the DBC of a node that sends them; and any bits by the DBC of devices with
/// every scale and type. canmatrix finds the same.
pub(crate) fn dbc(runner: &mut Runner) -> Result<(), Failure> {
    let Some(python) = python_of_readers(runner) else { return Ok(()) };
    let mut command = Command::new(&python);
    command.arg("tests/readers/dbc.py").arg("--odgen").arg(beside("odgen")?);
    command.arg("--frames").arg(beside("pdo-frames")?);
    for file in ["scales", "everything"] {
        command.arg("--as-it-is").arg(format!("tests/readers/{file}.od.yaml"));
    }
    runner.run(command.args(SPECS.map(|stem| format!("od-spec/devices/{stem}.od.yaml"))))
}

/// Structured Text, parsed by blark and compared with the dump; what its functions do is evaluated, on frames of the generated Rust, too.
pub(crate) fn structured_text(runner: &mut Runner, amount: Amount) -> Result<(), Failure> {
    let Some(python) = python_of_readers(runner) else { return Ok(()) };
    let mut command = Command::new(&python);
    command.arg("tests/readers/st.py").args(sample(amount)).arg("--odgen").arg(beside("odgen")?);
    command.arg("--frames").arg(beside("pdo-frames")?);
    let (as_it_is, faulty, specs): (&[&str], &[&str], &[&str]) = match amount {
        Amount::Sample => (&["readers/limits"], &["book/valve"], &[]),
        Amount::All => (
            &["readers/limits", "readers/everything"],
            &["book/valve", "book/lift", "readers/scales"],
            &SPECS,
        ),
    };
    for file in as_it_is {
        command.arg("--as-it-is").arg(format!("tests/{file}.od.yaml"));
    }
    for file in faulty {
        command.arg("--faults").arg(format!("tests/{file}.od.yaml"));
    }
    runner.run(command.args(specs.iter().map(|stem| format!("od-spec/devices/{stem}.od.yaml"))))
}

/// Sessions of a client that others wrote with `odgen lsp`.
pub(crate) fn language_server(runner: &mut Runner) -> Result<(), Failure> {
    let Some(python) = python_of_readers(runner) else { return Ok(()) };
    let mut command = Command::new(&python);
    command.arg("tests/readers/lsp_client.py").arg("--odgen");
    command.arg(beside("odgen")?);
    runner.run(command.args(SPECS.map(|stem| format!("od-spec/devices/{stem}.od.yaml"))))
}

/// What a user does in Neovim with `odgen lsp`.
pub(crate) fn editors(runner: &mut Runner) -> Result<(), Failure> {
    if python_of_readers(runner).is_none() {
        return Ok(());
    }
    let editor = root().join(VENV).join("bin/nvim");
    runner.run(Command::new(editor).args(["-l", "tests/editors/neovim.lua"]).arg(beside("odgen")?))
}

/// The same in Emacs.
pub(crate) fn emacs(runner: &mut Runner) -> Result<(), Failure> {
    runner.run(Command::new("emacs").args(["--batch", "-l", "tests/editors/emacs.el"]).arg(beside("odgen")?))
}

/// The extension for VS Code as a package.
pub(crate) fn extension(runner: &mut Runner) -> Result<(), Failure> {
    let odgen = beside("odgen")?;
    runner.run(Command::new("python3").args(["tests/editors/package.py", "--odgen"]).arg(odgen))
}

/// A client that others wrote, against the generated Rust, and as the master of virtual nodes; and the client of firmware-glue
/// and `odgen node` against a server that others wrote.
pub(crate) fn sdo_client(runner: &mut Runner, amount: Amount) -> Result<(), Failure> {
    let Some(python) = python_of_readers(runner) else { return Ok(()) };
    let server = beside("sdo-server")?;
    let odgen = beside("odgen")?;
    let specs = specs(amount);
    for stem in specs {
        let dump = format!("generated/{stem}.json");
        let arguments = ["--eds-dir", "generated/eds", "--dump", &dump, "--server"];
        runner.run(Command::new(&python).arg("tests/readers/sdo_client.py").args(arguments).arg(&server))?;
        let spec = format!("od-spec/devices/{stem}.od.yaml");
        let arguments = ["--eds-dir", "generated/eds", "--dump", &dump, "--spec", &spec, "--odgen"];
        runner.run(Command::new(&python).arg("tests/readers/virtual_node.py").args(arguments).arg(&odgen))?;
    }
    let paths = specs.iter().map(|stem| format!("od-spec/devices/{stem}.od.yaml"));
    let virtual_pdo = ["tests/readers/virtual_pdo.py", "tests/readers/everything.od.yaml"];
    runner.run(Command::new(&python).args(virtual_pdo).args(paths).arg("--odgen").arg(&odgen))?;
    virtual_nodes::prove(runner, amount, specs, &python, &odgen)?;
    let client = beside("sdo-client")?;
    let arguments = ["tests/readers/sdo_local_node.py", "generated/eds/fullmo.eds", "--client"];
    runner.run(Command::new(&python).args(arguments).arg(&client))?;
    // A drive without defaults would be a node without values.
    for device in ["pmc", "pmm"] {
        let eds = format!("generated/eds/{device}.eds");
        let spec = "od-spec/devices/pitch-control-system.od.yaml";
        let arguments =
            ["tests/readers/node_master.py", "--spec", spec, "--device", device, "--eds", &eds, "--odgen"];
        runner.run(Command::new(&python).args(arguments).arg(&odgen))?;
    }
    // Pseudo-terminals are those of Linux.
    if cfg!(target_os = "linux") {
        let spec = "od-spec/devices/pitch-control-system.od.yaml";
        let arguments = ["tests/readers/serial_node.py", "--spec", spec, "--device", "pmc"];
        let arguments = [&arguments[..], &["--eds", "generated/eds/pmc.eds", "--odgen"]].concat();
        runner.run(Command::new(&python).args(arguments).arg(&odgen))?;
    }
    Ok(())
}

/// What `odgen new --firmware` writes, built and asked.
pub(crate) fn new_firmware(runner: &mut Runner, amount: Amount) -> Result<(), Failure> {
    let odgen = beside("odgen")?;
    runner.run(
        Command::new("python3").arg("tests/thumb/starter.py").args(sample(amount)).arg("--odgen").arg(&odgen),
    )
}

/// The same client and `odgen node`, against the demo firmware on an emulated Cortex-M.
pub(crate) fn demo_firmware(runner: &mut Runner, amount: Amount) -> Result<(), Failure> {
    let Some(python) = python_of_readers(runner) else { return Ok(()) };
    let odgen = beside("odgen")?;
    runner
        .run(Command::new(&python).arg("tests/thumb/demo.py").args(sample(amount)).arg("--odgen").arg(&odgen))
}

//! Virtual nodes, under masters that others wrote: a whole turbine, every access to every entry, and in a long run a bus that loses
//! frames.

use std::path::Path;
use std::process::Command;

use od_formats::{Selection, artifacts};
use od_gen::files::write_all;
use od_tests::{Failure, compile_clean, root};

use crate::parts::Amount;
use crate::runner::Runner;

/// Where the files of `limits.od.yaml` go.
const LIMITS: &str = "target/limits";

pub(crate) fn prove(
    runner: &mut Runner,
    amount: Amount,
    specs: &[&str],
    python: &Path,
    odgen: &Path,
) -> Result<(), Failure> {
    let mut run = |script: &str, arguments: &[&str]| {
        runner.run(Command::new(python).arg(script).args(arguments).arg("--odgen").arg(odgen))
    };
    run("tests/readers/book_turbine.py", &[])?;
    run("tests/readers/traces.py", &[])?;
    run("tests/readers/confirmed.py", &[])?;
    run("tests/readers/bridge.py", &["--self-test"])?;
    for stem in specs {
        let (dump, spec) = (format!("generated/{stem}.json"), format!("od-spec/devices/{stem}.od.yaml"));
        let arguments = ["--dump", &dump, "--eds-dir", "generated/eds", "--spec", &spec];
        run("tests/readers/access_table.py", &arguments)?;
        let modules = ["--modules", "target/readers/npm/node_modules"];
        run("tests/readers/node_reads.py", &[&arguments[..], &modules].concat())?;
    }
    // What the shipped devices do not have.
    let spec = "tests/readers/limits.od.yaml";
    let system = compile_clean(spec)?;
    let set = artifacts(&system, "limits", &Selection::default());
    write_all(&root().join(LIMITS), &set)?;
    let (dump, eds) = (format!("{LIMITS}/limits.json"), format!("{LIMITS}/eds"));
    let arguments = ["--dump", &dump, "--eds-dir", &eds, "--spec", spec, "--least", "1500"];
    run("tests/readers/access_table.py", &arguments)?;
    match amount {
        // It waits for answers that do not come most of the time.
        Amount::All => run("tests/readers/lossy_bus.py", &[]),
        Amount::Sample => Ok(()),
    }
}

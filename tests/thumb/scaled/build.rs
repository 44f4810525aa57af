//! Has tests/bench/runtime/scaled.py write the specifications, and makes Rust modules of them.

use std::path::PathBuf;
use std::process::Command;
use std::{env, fs};

const SCRIPT: &str = "../../bench/runtime/scaled.py";
/// Models, and the modules that they become.
const MODELS: [(&str, &str); 4] =
    [("10", "scaled10"), ("150", "scaled150"), ("full150", "full150"), ("2000", "scaled2000")];

fn main() {
    println!("cargo::rerun-if-changed={SCRIPT}");
    println!("cargo::rerun-if-env-changed=PYTHON");
    let python = env::var_os("PYTHON").unwrap_or_else(|| "python3".into());
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    for (model, module) in MODELS {
        let specification = out.join(format!("{module}.od.yaml"));
        let mut command = Command::new(&python);
        command.args([SCRIPT, model, "--format", "od", "--out"]).arg(&specification);
        let status = command.status().unwrap_or_else(|error| panic!("{}: {error}", python.display()));
        assert!(status.success(), "{SCRIPT} ended with {status}");
        let folder = out.join(module);
        fs::create_dir_all(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
        // Not `generate`: it has cargo watch the specification, which is written here.
        if let Err(error) =
            od_gen::Builder::new(specification).device("controller").out_dir(folder).try_generate()
        {
            panic!("{error}");
        }
    }
}

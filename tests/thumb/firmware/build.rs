//! Hands `memory.x` and the linker script of `cortex-m-rt` to the linker, and has the cases of the test `access` made.

use std::error::Error;
use std::path::PathBuf;
use std::{env, fs};

/// What makes the cases of tests/tests/rust/access.rs.
#[allow(dead_code)]
#[path = "../../src/access_cases.rs"]
mod access_cases;

/// What `access_cases` fails with.
type Failure = Box<dyn Error + Send + Sync>;

/// Dump and key of each device.
const DEVICES: [(&str, &str); 3] = [
    ("../../../generated/pitch-control-system.json", "pmc"),
    ("../../../generated/pitch-control-system.json", "pmm"),
    ("../../../generated/fullmo-drive.json", "fullmo"),
];

fn main() -> Result<(), Failure> {
    println!("cargo::rerun-if-changed=memory.x");
    println!("cargo::rustc-link-search={}", env!("CARGO_MANIFEST_DIR"));
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    // cortex-m-rt: else the GNU linker may align sections to 64 KiB pages.
    println!("cargo::rustc-link-arg-bins=--nmagic");

    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=../../src/access_cases.rs");
    let out = PathBuf::from(env::var_os("OUT_DIR").ok_or("cargo sets OUT_DIR")?);
    for (file, key) in DEVICES {
        println!("cargo::rerun-if-changed={file}");
        let dump = serde_json::from_slice(&fs::read(file).map_err(|error| format!("{file}: {error}"))?)?;
        let cases = access_cases::of_device(&dump, key)?;
        let path = out.join(format!("{key}.cases"));
        fs::write(&path, &cases.bytes).map_err(|error| format!("{}: {error}", path.display()))?;
        let name = key.to_uppercase();
        println!("cargo::rustc-env={name}_CASES={}", path.display());
        println!("cargo::rustc-env={name}_COUNT={}", cases.count);
    }
    Ok(())
}

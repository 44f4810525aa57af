// Included by the build scripts: has `scaled.py` write the model, and notes how long a generator took.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

/// The models, by the feature that enables each. `scaled.py` describes them.
const MODELS: [(&str, &str); 8] = [
    ("size150", "150"),
    ("size2000", "2000"),
    ("size10000", "10000"),
    ("gappy150", "gappy150"),
    ("gappy2000", "gappy2000"),
    ("gappy10000", "gappy10000"),
    ("pmc", "pmc"),
    ("pmm", "pmm"),
];

/// For each enabled model: has it written into `OUT_DIR/FEATURE` and calls `generate` with that directory
/// and the file. Seconds go to `OUT_DIR/FEATURE/seconds`, where `compile.py` reads them.
fn each_size(options: &[&str], extension: &str, mut generate: impl FnMut(&Path, &Path)) {
    let script = if Path::new("scaled.py").exists() { "scaled.py" } else { "../../scaled.py" };
    println!("cargo:rerun-if-changed={script}");
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-env-changed=PYTHON");
    let out = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets it"));
    for (feature, name) in MODELS {
        if std::env::var_os(format!("CARGO_FEATURE_{}", feature.to_uppercase())).is_none() {
            continue;
        }
        let directory = out.join(feature);
        std::fs::create_dir_all(&directory).expect("OUT_DIR is writable");
        let model = directory.join(format!("controller.{extension}"));
        let python = std::env::var_os("PYTHON").unwrap_or_else(|| "python3".into());
        let status =
            Command::new(&python).args([script, name]).args(options).arg("--out").arg(&model).status();
        assert!(status.is_ok_and(|status| status.success()), "{python:?} {script} failed");
        let start = Instant::now();
        generate(&directory, &model);
        let seconds = start.elapsed().as_secs_f64().to_string();
        std::fs::write(directory.join("seconds"), seconds).expect("OUT_DIR is writable");
    }
}

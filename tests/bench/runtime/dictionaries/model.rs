// Included by the build scripts: has `scaled.py` write the model, and notes how long a generator took.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

const SCRIPT: &str = "../../scaled.py";

/// For each enabled size: has the model written into `OUT_DIR/sizeN` and calls `generate` with that
/// directory and the file. Seconds go to `OUT_DIR/sizeN/seconds`, where `compile.py` reads them.
fn each_size(options: &[&str], extension: &str, mut generate: impl FnMut(&Path, &Path)) {
    println!("cargo:rerun-if-changed={SCRIPT}");
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-env-changed=PYTHON");
    let out = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets it"));
    for size in ["150", "2000", "10000"] {
        if std::env::var_os(format!("CARGO_FEATURE_SIZE{size}")).is_none() {
            continue;
        }
        let directory = out.join(format!("size{size}"));
        std::fs::create_dir_all(&directory).expect("OUT_DIR is writable");
        let model = directory.join(format!("controller.{extension}"));
        let python = std::env::var_os("PYTHON").unwrap_or_else(|| "python3".into());
        let status =
            Command::new(&python).args([SCRIPT, size]).args(options).arg("--out").arg(&model).status();
        assert!(status.is_ok_and(|status| status.success()), "{python:?} {SCRIPT} failed");
        let start = Instant::now();
        generate(&directory, &model);
        let seconds = start.elapsed().as_secs_f64().to_string();
        std::fs::write(directory.join("seconds"), seconds).expect("OUT_DIR is writable");
    }
}

//! The crates that users depend on, as a registry would take them.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use od_tests::{Failure, root};
use serde_json::Value;

use crate::runner::Runner;

/// What a user finds in each package beside the code.
const FILES: [&str; 3] = ["README.md", "LICENSE-MIT", "LICENSE-APACHE"];
/// What a registry shows.
const FACTS: [&str; 4] = ["description", "license", "readme", "rust_version"];
/// What people find it by.
const LISTS: [&str; 2] = ["keywords", "categories"];

/// Packages each crate and builds it from its package.
pub(crate) fn package() -> Result<(), Failure> {
    let published = published(&cargo(&["metadata", "--format-version", "1", "--no-deps"])?)?;
    let mut lacks = Vec::new();
    for package in &published {
        let name = name(package)?;
        let listed = cargo(&["package", "--list", "--allow-dirty", "--package", name])?;
        lacks.extend(lacking(package, &listed).into_iter().map(|what| format!("{name} lacks {what}")));
    }
    if !lacks.is_empty() {
        return Err(lacks.join("\n").into());
    }
    let sources = cargo_home().ok_or("neither CARGO_HOME nor HOME is set")?.join("registry/src");
    forget_unpacked(&sources, &published)?;
    // Nor may what was compiled of them count as up to date, which cargo decides by version, too.
    let target = root().join("target/packaged");
    if target.exists() {
        std::fs::remove_dir_all(&target)?;
    }
    let mut arguments =
        vec!["package", "--target-dir", "target/packaged", "--locked", "--allow-dirty", "--quiet"];
    for package in &published {
        arguments.extend(["--package", name(package)?]);
    }
    Runner::default().cargo(&arguments)?;
    let names: Vec<&str> = published.iter().map(name).collect::<Result<_, _>>()?;
    println!("{} packages are complete and build: {}", names.len(), names.join(", "));
    Ok(())
}

/// The packages of the workspace that may be published, by `cargo metadata`.
fn published(metadata: &str) -> Result<Vec<Value>, Failure> {
    let mut metadata: Value = serde_json::from_str(metadata)?;
    let Some(Value::Array(packages)) = metadata.get_mut("packages").map(Value::take) else {
        return Err("cargo metadata lists no packages".into());
    };
    Ok(packages.into_iter().filter(|package| package.get("publish").is_none_or(Value::is_null)).collect())
}

fn name(package: &Value) -> Result<&str, Failure> {
    package.get("name").and_then(Value::as_str).ok_or_else(|| "a package has no name".into())
}

/// The facts that a package does not state, and the files that do not lie in it.
fn lacking<'a>(package: &Value, listed: &str) -> Vec<&'a str> {
    let files: BTreeSet<&str> = listed.lines().collect();
    let states =
        |fact: &&str| package.get(*fact).and_then(Value::as_str).is_some_and(|text| !text.is_empty());
    let lists =
        |fact: &&str| package.get(*fact).and_then(Value::as_array).is_some_and(|words| !words.is_empty());
    let mut lacks: Vec<&str> = FACTS.into_iter().filter(|fact| !states(fact)).collect();
    lacks.extend(LISTS.into_iter().filter(|fact| !lists(fact)));
    lacks.extend(FILES.into_iter().filter(|file| !files.contains(file)));
    lacks
}

/// Removes what an earlier run unpacked of the packages.
///
/// Cargo serves the packages to each other from a temporary registry, but
/// keeps what it unpacks of it by path and version: the next run in the same
/// checkout would build the sources of the last one.
fn forget_unpacked(sources: &Path, published: &[Value]) -> Result<(), Failure> {
    if !sources.exists() {
        return Ok(());
    }
    for registry in sources.read_dir()? {
        let registry = registry?;
        // A registry is named `host-hash`; one on this machine has no host.
        if !registry.file_name().to_string_lossy().starts_with('-') {
            continue;
        }
        for package in published {
            let version = package.get("version").and_then(Value::as_str).ok_or("a package has no version")?;
            let unpacked = registry.path().join(format!("{}-{version}", name(package)?));
            if unpacked.exists() {
                std::fs::remove_dir_all(unpacked)?;
            }
        }
    }
    Ok(())
}

fn cargo_home() -> Option<PathBuf> {
    let home = || Some(PathBuf::from(std::env::var_os("HOME")?).join(".cargo"));
    std::env::var_os("CARGO_HOME").map(PathBuf::from).or_else(home)
}

/// What a command of cargo prints.
fn cargo(arguments: &[&str]) -> Result<String, Failure> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo).args(arguments).current_dir(root()).output()?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        return Err(format!("`cargo {}` failed: {said}", arguments.join(" ")).into());
    }
    Ok(String::from_utf8(output.stdout)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    const METADATA: &str = r#"{"packages": [
        {"name": "private", "publish": []},
        {"name": "bare", "version": "0.2.0", "publish": null, "description": "", "keywords": []},
        {"name": "whole", "version": "0.1.0", "publish": null, "description": "what", "license": "MIT", "readme": "README.md",
         "rust_version": "1.90", "keywords": ["can"], "categories": ["embedded"]}
    ]}"#;

    #[test]
    fn only_what_may_be_published_is_packaged() {
        let published = published(METADATA).unwrap();
        let names: Vec<&str> = published.iter().map(|package| name(package).unwrap()).collect();
        assert_eq!(names, ["bare", "whole"]);
    }

    #[test]
    fn what_a_package_lacks_is_found() {
        let published = published(METADATA).unwrap();
        let all = [&FACTS[..], &LISTS, &FILES].concat();
        assert_eq!(lacking(&published[0], "src/lib.rs\n"), all);
        let whole = "LICENSE-APACHE\nLICENSE-MIT\nREADME.md\nsrc/lib.rs\n";
        assert_eq!(lacking(&published[1], whole), Vec::<&str>::new());
        assert_eq!(lacking(&published[1], "LICENSE-MIT\nold/README.md\n"), ["README.md", "LICENSE-APACHE"]);
    }

    #[test]
    fn only_unpacked_packages_of_a_local_registry_are_forgotten() {
        let sources = std::env::temp_dir().join(format!("od-unpacked-{}", std::process::id()));
        let folders = ["-0a1b/whole-0.1.0", "-0a1b/other-0.1.0", "index.example-0a1b/whole-0.1.0"];
        for folder in folders {
            std::fs::create_dir_all(sources.join(folder)).unwrap();
        }
        forget_unpacked(&sources, &published(METADATA).unwrap()).unwrap();
        let left = folders.map(|folder| sources.join(folder).exists());
        assert_eq!(left, [false, true, true]);
        std::fs::remove_dir_all(&sources).unwrap();
        forget_unpacked(&sources, &[]).unwrap();
    }
}

//! The crates that users depend on, as a registry would take them.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use od_tests::{Failure, root};
use serde_json::Value;

use crate::runner::{self, Runner};

/// What a user finds in each package in addition to the code.
const FILES: [&str; 3] = ["README.md", "LICENSE-MIT", "LICENSE-APACHE"];
/// What a registry shows.
const FACTS: [&str; 4] = ["description", "license", "readme", "rust_version"];
/// What people find it by.
const LISTS: [&str; 2] = ["keywords", "categories"];

/// Each crate that users depend on has what a registry shows, in its manifest and among its files.
pub(crate) fn complete(runner: &mut Runner) -> Result<(), Failure> {
    let published = published(&cargo(&["metadata", "--format-version", "1", "--no-deps"])?)?;
    let mut lacks = Vec::new();
    for package in &published {
        let name = name(package)?;
        let listed = cargo(&["package", "--list", "--allow-dirty", "--package", name])?;
        lacks.extend(lacking(package, &listed).into_iter().map(|what| format!("{name} lacks {what}")));
        let directory = directory(package)?;
        let readme = std::fs::read_to_string(directory.join("README.md")).unwrap_or_default();
        let lost = links(&readme).filter(|link| !listed.lines().any(|file| file == *link));
        lacks.extend(lost.map(|link| format!("{name} lacks {link}, to which its README links")));
    }
    if !lacks.is_empty() {
        return Err(lacks.join("\n").into());
    }
    let names: Vec<&str> = published.iter().map(name).collect::<Result<_, _>>()?;
    runner.print(&format!("{} packages are complete: {}", names.len(), names.join(", ")));
    Ok(())
}

/// Packages each crate and compiles it from its package, with no features except those that it asks for itself. Installs the
/// command as a user does.
pub(crate) fn unpacked(runner: &mut Runner) -> Result<(), Failure> {
    let published = published(&cargo(&["metadata", "--format-version", "1", "--no-deps"])?)?;
    let target = root().join("target/packaged");
    if target.exists() {
        std::fs::remove_dir_all(&target)?;
    }
    let mut arguments = vec![
        "package",
        "--no-verify",
        "--target-dir",
        "target/packaged",
        "--locked",
        "--allow-dirty",
        "--quiet",
    ];
    for package in &published {
        arguments.extend(["--package", name(package)?]);
    }
    runner.cargo(&arguments)?;
    let unpacked = unpack(runner, &target, &published)?;
    let manifest = unpacked.join("Cargo.toml");
    for package in &published {
        // Each alone, as features of packages that are compiled together are the sum of all that are asked for.
        let package =
            ["check", "--quiet", "--target-dir", "target", "--package", name(package)?, "--manifest-path"];
        runner.run(runner::cargo().args(package).arg(&manifest))?;
    }
    runner.print(&format!("{} packages compile", published.len()));
    install(runner, &published)
}

/// The package with the command, installed below `target`.
fn install(runner: &mut Runner, published: &[Value]) -> Result<(), Failure> {
    let has_command = |package: &&Value| {
        let targets = package.get("targets").and_then(Value::as_array);
        targets
            .is_some_and(|targets| targets.iter().any(|target| target.get("name") == Some(&"odgen".into())))
    };
    let package = published.iter().find(has_command).ok_or("no package has the command odgen")?;
    let directory = directory(package)?;
    let installed = root().join("target/installed");
    let mut command = runner::cargo();
    command.args(["install", "--quiet", "--locked", "--debug", "--force", "--path"]).arg(directory);
    runner.run(command.arg("--root").arg(&installed))?;
    runner.run(Command::new(installed.join("bin/odgen")).arg("--version"))
}

/// Unpacks the packages into a workspace of their own, in which each takes the others in place of those of a registry. Cargo's own
/// check of packages does the same through a registry, but compiles every dependency once more.
fn unpack(runner: &mut Runner, target: &Path, published: &[Value]) -> Result<PathBuf, Failure> {
    let unpacked = target.join("unpacked");
    std::fs::create_dir_all(&unpacked)?;
    let mut directories = Vec::new();
    for package in published {
        let version = package.get("version").and_then(Value::as_str).ok_or("a package has no version")?;
        let directory = format!("{}-{version}", name(package)?);
        // In a package every file is equally old; cargo decides by their age what to compile.
        let file = target.join("package").join(format!("{directory}.crate"));
        runner.run(Command::new("tar").arg("-xzmf").arg(file).arg("-C").arg(&unpacked))?;
        directories.push((name(package)?, directory));
    }
    std::fs::write(unpacked.join("Cargo.toml"), workspace(&directories))?;
    std::fs::copy(root().join("Cargo.lock"), unpacked.join("Cargo.lock"))?;
    Ok(unpacked)
}

/// The manifest of a workspace of packages, each with its directory.
fn workspace(packages: &[(&str, String)]) -> String {
    let members: Vec<String> = packages.iter().map(|(_, directory)| format!("{directory:?}")).collect();
    let patches: Vec<String> =
        packages.iter().map(|(name, directory)| format!("{name} = {{ path = {directory:?} }}")).collect();
    format!(
        "[workspace]\nresolver = \"3\"\nmembers = [{}]\n\n[patch.crates-io]\n{}\n",
        members.join(", "),
        patches.join("\n")
    )
}

/// The packages of the workspace that may be published, by `cargo metadata`.
fn published(metadata: &str) -> Result<Vec<Value>, Failure> {
    let mut metadata: Value = serde_json::from_str(metadata)?;
    let Some(Value::Array(packages)) = metadata.get_mut("packages").map(Value::take) else {
        return Err("cargo metadata lists no packages".into());
    };
    Ok(packages.into_iter().filter(|package| package.get("publish").is_none_or(Value::is_null)).collect())
}

fn directory(package: &Value) -> Result<&Path, Failure> {
    let manifest = package.get("manifest_path").and_then(Value::as_str).map(Path::new);
    manifest.and_then(Path::parent).ok_or_else(|| "cargo metadata names no manifest".into())
}

/// The files that a page links to. A registry shows the page without the repository around it.
fn links(page: &str) -> impl Iterator<Item = &str> {
    let targets = page.split("](").skip(1).filter_map(|rest| rest.split([')', '#']).next());
    targets.filter(|target| !target.is_empty() && !target.contains("://"))
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
    // The pages of a registry show what has the default features, unless the package asks for all.
    let has_features = package.get("features").and_then(Value::as_object).is_some_and(|all| !all.is_empty());
    if has_features && package.pointer("/metadata/docs/rs/all-features") != Some(&true.into()) {
        lacks.push("package.metadata.docs.rs.all-features");
    }
    lacks
}

/// What a command of cargo prints.
fn cargo(arguments: &[&str]) -> Result<String, Failure> {
    let output = runner::cargo().args(arguments).current_dir(root()).output()?;
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
         "rust_version": "1.90", "keywords": ["can"], "categories": ["embedded"], "features": {"std": []},
         "metadata": {"docs": {"rs": {"all-features": true}}}}
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
        let mut undocumented = published[1].clone();
        undocumented["metadata"] = Value::Null;
        assert_eq!(lacking(&undocumented, whole), ["package.metadata.docs.rs.all-features"]);
    }

    #[test]
    fn files_that_a_page_links_to_are_found() {
        let page = "[a](docs/a.md#top), [b](https://example.org), [c](#here), ![d](d.png)";
        assert_eq!(links(page).collect::<Vec<_>>(), ["docs/a.md", "d.png"]);
    }

    #[test]
    fn each_package_takes_the_others_from_next_to_it() {
        let packages = [("one", "one-0.1.0".to_owned()), ("two", "two-0.1.0".to_owned())];
        let expected = r#"[workspace]
resolver = "3"
members = ["one-0.1.0", "two-0.1.0"]

[patch.crates-io]
one = { path = "one-0.1.0" }
two = { path = "two-0.1.0" }
"#;
        assert_eq!(workspace(&packages), expected);
    }
}

//! The workflow that builds releases: it parses, its actions are pinned, its targets exist, and its archives are those
//! that `cargo binstall` looks for.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

use od_tests::root;
use serde_json::Value;

fn workflow() -> Value {
    let text = fs::read_to_string(root().join(".github/workflows/release.yml")).unwrap();
    serde_yaml::from_str(&text).unwrap()
}

/// The steps of all jobs.
fn steps(workflow: &Value) -> impl Iterator<Item = &Value> {
    workflow["jobs"].as_object().unwrap().values().flat_map(|job| job["steps"].as_array().unwrap())
}

fn targets(workflow: &Value) -> Vec<&str> {
    let rows = workflow["jobs"]["build"]["strategy"]["matrix"]["include"].as_array().unwrap();
    rows.iter().map(|row| row["target"].as_str().unwrap()).collect()
}

fn printed(command: &mut Command) -> String {
    let output = command.current_dir(root()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// What cargo knows of the package with the command.
fn package() -> Value {
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
    let arguments = ["metadata", "--offline", "--no-deps", "--format-version", "1"];
    let metadata: Value = serde_json::from_str(&printed(Command::new(cargo).args(arguments))).unwrap();
    let packages = metadata["packages"].as_array().unwrap();
    packages.iter().find(|package| package["name"] == "odgen").unwrap().clone()
}

#[test]
fn every_action_is_pinned_to_a_commit() {
    let workflow = workflow();
    let used: Vec<&str> = steps(&workflow).filter_map(|step| step["uses"].as_str()).collect();
    assert!(used.len() >= 3, "{used:?}");
    for action in used {
        let commit = action.split_once('@').unwrap().1;
        assert!(commit.len() == 40 && commit.bytes().all(|byte| byte.is_ascii_hexdigit()), "{action}");
    }
}

#[test]
fn every_target_exists_and_no_system_is_missing() {
    let workflow = workflow();
    let known = printed(Command::new("rustc").args(["--print", "target-list"]));
    let known: BTreeSet<&str> = known.lines().collect();
    let targets = targets(&workflow);
    let unknown: Vec<&&str> = targets.iter().filter(|target| !known.contains(**target)).collect();
    assert!(unknown.is_empty(), "rustc does not know {unknown:?}");
    for system in ["linux-gnu", "linux-musl", "windows", "darwin"] {
        assert!(targets.iter().any(|target| target.contains(system)), "{system}");
    }
    for processor in ["x86_64", "aarch64"] {
        assert!(targets.iter().any(|target| target.starts_with(processor)), "{processor}");
    }
}

/// The version has one home for the crates, and the same value where it is written again.
#[test]
fn the_version_is_the_same_everywhere() {
    let package = package();
    let version = package["version"].as_str().unwrap();
    let read = |path: &str| fs::read_to_string(root().join(path)).unwrap();
    assert!(read("CHANGELOG.md").lines().any(|line| line.starts_with(&format!("## {version}"))), "{version}");
    assert!(read("od-gen/bus/bridge/pyproject.toml").contains(&format!("\nversion = \"{version}\"\n")));
    let extension: Value = serde_json::from_str(&read("od-gen/lsp/vscode/package.json")).unwrap();
    assert_eq!(extension["version"], package["version"]);
    let tags = workflow()["on"]["push"]["tags"].clone();
    assert_eq!(tags, serde_json::json!(["v[0-9]*"]));
}

/// The wheels of a release and those of the tests have one builder.
#[test]
fn wheels_are_built_by_one_version() {
    let read = |path: &str| fs::read_to_string(root().join(path)).unwrap();
    let tests = read("tests/src/bin/xtask/installed.rs");
    let builder = tests.split('"').find(|text| text.starts_with("maturin==")).unwrap();
    assert!(read(".github/workflows/release.yml").contains(&format!("--spec {builder}\n")), "{builder}");
}

/// Runs the step "Pack" as the workflow does, with an empty program.
#[test]
#[cfg(unix)]
fn archives_are_those_that_binstall_looks_for() {
    use std::os::unix::fs::PermissionsExt as _;

    let (workflow, package) = (workflow(), package());
    let (version, binstall) = (package["version"].as_str().unwrap(), &package["metadata"]["binstall"]);
    let pack = steps(&workflow).find(|step| step["name"] == "Pack").unwrap()["run"].as_str().unwrap();
    let folder = std::env::temp_dir().join(format!("od-release-{}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    for target in targets(&workflow) {
        let built = folder.join("target").join(target).join("release");
        let (format, extension) = match binstall["overrides"][target]["pkg-fmt"].as_str() {
            Some("zip") => (".zip", ".exe"),
            None => (".tar.gz", ""),
            Some(other) => panic!("{target}: {other}"),
        };
        assert_eq!(target.contains("windows"), extension == ".exe", "{target}");
        fs::create_dir_all(&built).unwrap();
        fs::write(built.join(format!("odgen{extension}")), "").unwrap();
        for file in ["README.md", "CHANGELOG.md", "LICENSE-MIT", "LICENSE-APACHE"] {
            fs::copy(root().join(file), folder.join(file)).unwrap();
        }
        // The zip program of the Windows runner, as far as it is used: an archive by this name, of this folder.
        let zip = folder.join("7z");
        fs::write(&zip, "#!/bin/sh\n[ \"$1\" = a ] && tar -cf \"$2\" \"$3\"\n").unwrap();
        fs::set_permissions(&zip, fs::Permissions::from_mode(0o755)).unwrap();
        let path = format!("{}:{}", folder.display(), std::env::var("PATH").unwrap());
        let mut bash = Command::new("bash");
        bash.args(["-euo", "pipefail", "-c", pack]).current_dir(&folder);
        bash.env("PATH", path).env("TARGET", target).env("GITHUB_REF_NAME", format!("v{version}"));
        let output = bash.output().unwrap();
        assert!(output.status.success(), "{target}: {}", String::from_utf8_lossy(&output.stderr));

        let filled = |template: &str| {
            let values = [("name", "odgen"), ("bin", "odgen"), ("version", version), ("target", target)];
            let values = values.into_iter().chain([("archive-suffix", format), ("binary-ext", extension)]);
            values.fold(template.to_owned(), |text, (name, value)| {
                text.replace(&format!("{{ {name} }}"), value)
            })
        };
        let url = filled(binstall["pkg-url"].as_str().unwrap());
        let archive = Path::new(&url).file_name().unwrap();
        let archive = folder.join("dist").join(archive);
        assert!(url.starts_with(&format!("{{ repo }}/releases/download/v{version}/")), "{url}");
        assert!(archive.is_file(), "{} is missing", archive.display());
        let listed = printed(Command::new("tar").arg("-tf").arg(&archive));
        let program = filled(binstall["bin-dir"].as_str().unwrap());
        let directory = Path::new(&program).parent().unwrap().display().to_string();
        for file in ["README.md", "CHANGELOG.md", "LICENSE-MIT", "LICENSE-APACHE"] {
            assert!(listed.lines().any(|line| line == format!("{directory}/{file}")), "{file}: {listed}");
        }
        assert!(listed.lines().any(|line| line == program), "{program}: {listed}");
    }
    fs::remove_dir_all(&folder).unwrap();
}

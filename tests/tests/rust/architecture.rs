//! The map of crates in the documentation is that of the manifests, and the index of decisions names each of them.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeSet;
use std::process::Command;

use od_tests::root;
use serde_json::Value;

/// A row of the map.
struct Row {
    package: String,
    folder: String,
    /// Our own packages, or `None` where the map says "all".
    depends_on: Option<BTreeSet<String>>,
    features: BTreeSet<String>,
}

fn read(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap()
}

/// What is between backticks.
fn quoted(cell: &str) -> BTreeSet<String> {
    cell.split('`').skip(1).step_by(2).map(ToOwned::to_owned).collect()
}

fn map(text: &str) -> Vec<Row> {
    let (_, rest) = text.split_once("\n## The map of crates\n").unwrap();
    let (section, _) = rest.split_once("\n## ").unwrap();
    let rows = section.lines().filter(|line| line.starts_with("| `"));
    rows.map(|line| {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let [name, folder, _, depends_on, features] = cells[..] else { panic!("{line}") };
        Row {
            package: name.split('`').nth(1).unwrap().to_owned(),
            folder: folder.trim_matches('`').trim_end_matches('/').to_owned(),
            depends_on: (!depends_on.starts_with("all")).then(|| quoted(depends_on)),
            features: quoted(features),
        }
    })
    .collect()
}

/// What cargo says, without asking a registry.
fn cargo(arguments: &[&str]) -> String {
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
    let output = Command::new(cargo).args(arguments).arg("--offline").current_dir(root()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn packages() -> Vec<Value> {
    let metadata: Value =
        serde_json::from_str(&cargo(&["metadata", "--no-deps", "--format-version", "1"])).unwrap();
    metadata["packages"].as_array().unwrap().clone()
}

/// Where a crate had more features for the tests than for the programs, `cargo xtask` and `cargo test` would compile it and
/// everything above it one after the other.
#[test]
fn tests_ask_for_no_features_that_the_programs_have_not() {
    let features = |edges: &str| {
        let arguments =
            ["tree", "--workspace", "--prefix", "none", "--format", "{p} with {f}", "--edges", edges];
        let text = cargo(&arguments);
        text.lines().map(|line| line.trim_end_matches(" (*)").to_owned()).collect::<BTreeSet<_>>()
    };
    let (programs, tests) = (features("normal,build"), features("normal,build,dev"));
    assert!(programs.len() > 100, "{programs:?}");
    assert_eq!(programs.difference(&tests).collect::<Vec<_>>(), [""; 0]);
}

#[test]
fn the_map_of_crates_is_that_of_the_manifests() {
    let text = read("docs/architecture.md");
    assert!(text.len() <= 15_000, "{} bytes are more than a page", text.len());
    let (rows, packages) = (map(&text), packages());
    let names: Vec<&str> = packages.iter().map(|package| package["name"].as_str().unwrap()).collect();
    let listed: BTreeSet<&str> = rows.iter().map(|row| row.package.as_str()).collect();
    assert_eq!(listed, names.iter().copied().collect());
    let mut above = BTreeSet::new();
    for row in rows {
        let package = packages.iter().find(|package| package["name"] == row.package.as_str()).unwrap();
        let manifest = root().join(&row.folder).join("Cargo.toml");
        assert_eq!(package["manifest_path"].as_str().unwrap(), manifest.to_str().unwrap());
        let own = package["dependencies"].as_array().unwrap().iter().filter(|one| one["kind"].is_null());
        let own = own.map(|one| one["name"].as_str().unwrap()).filter(|name| names.contains(name));
        let own: BTreeSet<String> = own.map(ToOwned::to_owned).collect();
        assert!(own.is_subset(&above), "{}: an arrow leads up, {own:?}", row.package);
        if let Some(depends_on) = row.depends_on {
            assert_eq!(own, depends_on, "{}", row.package);
        }
        let features = package["features"].as_object().unwrap().keys().filter(|name| *name != "default");
        assert_eq!(features.cloned().collect::<BTreeSet<String>>(), row.features, "{}", row.package);
        above.insert(row.package);
    }
}

#[test]
fn the_index_of_decisions_names_each_of_them() {
    let index = read("docs/adr/README.md");
    let linked = index.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    let linked: BTreeSet<String> =
        linked.filter(|path| path.starts_with('0')).map(ToOwned::to_owned).collect();
    let files = std::fs::read_dir(root().join("docs/adr")).unwrap();
    let files = files.map(|file| file.unwrap().file_name().into_string().unwrap());
    assert_eq!(linked, files.filter(|name| name != "README.md").collect());
}

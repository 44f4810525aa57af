//! Who uses a part of the project compiles that part and no other.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::process::Command;

use od_tests::root;

/// The project's own crates that a package is built from, each with its features: `od_spec [xdd]`.
fn crates_of(package: &str) -> Vec<String> {
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
    let arguments = ["tree", "--offline", "--edges", "normal", "--prefix", "none", "--format", "{lib} [{f}]"];
    let mut command = Command::new(cargo);
    let output = command.args(arguments).args(["--package", package]).current_dir(root()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    text.lines().filter(|line| line.starts_with("od_")).map(ToOwned::to_owned).collect()
}

#[test]
fn the_macro_compiles_neither_json_nor_documents_nor_the_reference() {
    assert_eq!(crates_of("od-macros"), ["od_macros []", "od_gen []", "od_spec []"]);
    // The same question about the command has another answer, so the one above can fail.
    let of_command = crates_of("odgen");
    assert!(of_command.iter().any(|line| line == "od_reference []"), "{of_command:?}");
}

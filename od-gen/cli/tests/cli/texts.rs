//! What the command prints without a specification, and its exit codes.

use insta::assert_snapshot;

use crate::{PITCH, Scratch, code, odgen, stderr, stdout};

#[test]
fn the_command_line_has_its_own_exit_code() {
    let scratch = Scratch::new("usage");
    assert_eq!(code(&odgen(&scratch.0, &["frobnicate"])), 2);
    assert_eq!(code(&odgen(&scratch.0, &["explain", "OD9999"])), 2);
    assert_eq!(code(&odgen(&scratch.0, &["--help"])), 0);
}

#[test]
fn explain_errata_and_completions() {
    let scratch = Scratch::new("texts");
    assert_snapshot!(stdout(&odgen(&scratch.0, &["explain", "od0507"])));
    let errata = stdout(&odgen(&scratch.0, &["errata", PITCH, "--at", "6041", "--kind", "access"]));
    assert!(errata.contains("6041h on pmc [access]"), "{errata}");
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let output = odgen(&scratch.0, &["completions", shell]);
        assert!(code(&output) == 0 && stdout(&output).contains("deny-warnings"), "{shell}");
    }
    for (command, start) in [("reference", "# "), ("schema", "{")] {
        assert!(stdout(&odgen(&scratch.0, &[command])).starts_with(start), "{command}");
    }
}

#[test]
fn libraries_are_printed() {
    let scratch = Scratch::new("library");
    assert_eq!(stdout(&odgen(&scratch.0, &["library"])), "cia301\ncia302\ncia401\ncia402\n");
    let output = odgen(&scratch.0, &["library", "cia402"]);
    assert!(stdout(&output).contains("\n  0x6040:"), "{}", stdout(&output));
    let output = odgen(&scratch.0, &["library", "cia999"]);
    assert_eq!((code(&output), stdout(&output)), (2, String::new()));
    assert!(
        stderr(&output).contains("the libraries are cia301, cia302, cia401, cia402"),
        "{}",
        stderr(&output)
    );
}

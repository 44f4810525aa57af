//! `odgen fmt`.

use std::fs;

use crate::check_inputs::odgen_with_input;
use crate::{Scratch, code, odgen, stderr, stdout};

const CROOKED: &str = "od-spec: 1\ntitle:   Lamp\n";
const STRAIGHT: &str = "od-spec: 1\ntitle: Lamp\n";

#[test]
fn files_are_laid_out_once() {
    let scratch = Scratch::new("fmt");
    let file = scratch.file("lamp.od.yaml", CROOKED);
    let output = odgen(&scratch.0, &["fmt", "--check"]);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("lamp.od.yaml is laid out otherwise"), "{}", stderr(&output));
    assert_eq!(fs::read_to_string(&file).unwrap(), CROOKED);
    let output = odgen(&scratch.0, &["fmt", "lamp.od.yaml"]);
    assert_eq!((code(&output), stdout(&output)), (0, String::new()));
    assert_eq!(fs::read_to_string(&file).unwrap(), STRAIGHT);
    let output = odgen(&scratch.0, &["fmt", "--check", "lamp.od.yaml"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(stderr(&output).contains("1 file is as it should be"), "{}", stderr(&output));
}

#[test]
fn one_file_that_is_no_yaml_keeps_all() {
    let scratch = Scratch::new("fmt-refused");
    let file = scratch.file("lamp.od.yaml", CROOKED);
    scratch.file("torn.od.yaml", "a: [1\n");
    let output = odgen(&scratch.0, &["fmt"]);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("OD0104"), "{}", stderr(&output));
    assert_eq!(fs::read_to_string(&file).unwrap(), CROOKED);
    let output = odgen(&scratch.0, &["fmt", "none.od.yaml"]);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("cannot read none.od.yaml"), "{}", stderr(&output));
}

#[test]
fn editors_send_a_text_and_get_it() {
    let scratch = Scratch::new("fmt-stdin");
    let output = odgen_with_input(&scratch.0, &["fmt", "-"], CROOKED.as_bytes());
    assert_eq!((code(&output), stdout(&output)), (0, STRAIGHT.to_owned()));
    // What goes to a file is not a message: nothing in it is shown as an escape.
    let output = odgen_with_input(&scratch.0, &["fmt", "-"], "a: \"\u{2028}\"\n".as_bytes());
    assert_eq!(stdout(&output), "a: \"\u{2028}\"\n");
    let output = odgen_with_input(&scratch.0, &["fmt", "-", "--check"], CROOKED.as_bytes());
    assert_eq!(code(&output), 1);
    let output = odgen_with_input(&scratch.0, &["fmt", "-", "lamp.od.yaml"], CROOKED.as_bytes());
    assert_eq!(code(&output), 2);
}

/// What is laid out is the text, whichever of our files it is.
#[test]
fn parameter_files_and_plants_are_laid_out_too() {
    let scratch = Scratch::new("fmt-others");
    scratch.file("node.yaml", "od-parameters: 1\nparameters:\n    speed:   7   # of the fan\n");
    scratch.file("plant.yaml", "od-plant: 1\ntypes:\n    T:\n        bit-rate:  500\n");
    let output = odgen(&scratch.0, &["fmt", "node.yaml", "plant.yaml"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = |name: &str| fs::read_to_string(scratch.0.join(name)).unwrap();
    assert_eq!(text("node.yaml"), "od-parameters: 1\nparameters:\n  speed: 7       # of the fan\n");
    assert_eq!(text("plant.yaml"), "od-plant: 1\ntypes:\n  T:\n    bit-rate: 500\n");
}

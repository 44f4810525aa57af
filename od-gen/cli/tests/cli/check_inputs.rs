//! What `odgen check` takes: files of any kind, directories, standard input.

use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use crate::{FAN, LAMP, MIXER, ROOF_FAN, Scratch, code, odgen, stderr, stdout};

/// A check of what is written to its standard input.
fn piped(directory: &Path, arguments: &[&str], input: &[u8]) -> Output {
    odgen_with_input(directory, &[&["check"], arguments].concat(), input)
}

/// The command with something on its standard input.
pub(crate) fn odgen_with_input(directory: &Path, arguments: &[&str], input: &[u8]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_odgen"));
    let command = command.current_dir(directory).args(arguments);
    let mut child =
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(input).unwrap();
    child.wait_with_output().unwrap()
}

#[test]
fn standard_input_is_what_its_text_or_its_name_says() {
    let scratch = Scratch::new("stdin");
    let output = piped(&scratch.0, &["-"], LAMP.as_bytes());
    assert_eq!((code(&output), stderr(&output).as_str()), (0, "<stdin>: nothing found, 7 objects\n"));
    let output = piped(&scratch.0, &["-", "--format", "short"], FAN.as_bytes());
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("<stdin>:147:12: error[EDS406]"), "{}", stderr(&output));
    let output =
        piped(&scratch.0, &["-", "--stdin-name", "roof.DCF", "--format", "short"], ROOF_FAN.as_bytes());
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
    // By its name a specification, whatever it looks like.
    let output = piped(&scratch.0, &["-", "--stdin-name", "x.od.yaml", "--format", "short"], FAN.as_bytes());
    assert!(stderr(&output).starts_with("x.od.yaml:"), "{}", stderr(&output));
    // An EDS in the encoding of old Windows tools.
    let latin1 = [b"; Gr\xf6\xdfe\n".as_slice(), ROOF_FAN.as_bytes()].concat();
    assert!(!stderr(&piped(&scratch.0, &["-", "--format", "short"], &latin1)).contains("OD0102"));
}

#[test]
fn a_directory_is_searched_through_and_through() {
    let scratch = Scratch::new("directory");
    for directory in ["eds/deep", "eds/.hidden", "eds/folder.eds", "empty"] {
        fs::create_dir_all(scratch.0.join(directory)).unwrap();
    }
    for name in
        ["eds/b.eds", "eds/A.EDS", "eds/deep/c.Dcf", "eds/.hidden/no.eds", "eds/.no.eds", "eds/notes.txt"]
    {
        scratch.file(name, FAN);
    }
    scratch.file("eds/lamp.od.yaml", LAMP);
    let output = odgen(&scratch.0, &["check", "eds"]);
    assert_eq!(code(&output), 1);
    let said = stderr(&output);
    let files: Vec<&str> = said
        .lines()
        .filter_map(|line| line.strip_prefix("eds/")?.split_once(": "))
        .map(|(name, _)| name)
        .collect();
    assert_eq!(files, ["A.EDS", "b.eds", "deep/c.Dcf", "lamp.od.yaml"], "{said}");
    assert!(said.contains("\n4 files: 3 errors, 4 warnings, "), "{said}");
    assert!(
        said.ends_with(
            "; most frequent: EDS406 in 3 files, EDS506 in 3 files, EDS701 in 1 file; `odgen explain EDS406` says more\n"
        ),
        "{said}"
    );
    // Each file once, where it is named first.
    let output = odgen(&scratch.0, &["check", "eds/b.eds", "eds", "./eds/b.eds", "--format", "short"]);
    let said = stderr(&output);
    assert!(said.starts_with("eds/b.eds:") && said.matches("eds/b.eds:").count() == 2, "{said}");
    let output = odgen(&scratch.0, &["check", "empty", "eds/b.eds", "--format", "short"]);
    let said = stderr(&output);
    assert_eq!(code(&output), 1);
    let nothing = "error[OD0101]: there is no `*.od.yaml`, `*.eds`, `*.dcf`, `*.xdd` or `*.xdc` in empty (name files of other names one by one)\n";
    assert!(said.starts_with(nothing) && said.contains("\neds/b.eds:"), "{said}");
    // What is named is checked, however it is called.
    let output = odgen(&scratch.0, &["check", "eds/notes.txt", "--format", "short"]);
    assert!(stderr(&output).starts_with("eds/notes.txt:"), "{}", stderr(&output));
}

/// Files take different times, and are worked on side by side.
#[test]
fn many_files_are_reported_in_their_order() {
    let scratch = Scratch::new("many");
    let mut names = Vec::new();
    for number in 0..40 {
        let name = format!("f{number:02}.eds");
        scratch.file(&name, if number % 3 == 0 { MIXER } else { FAN });
        names.push(name);
    }
    let backwards: Vec<&str> = names.iter().rev().map(String::as_str).collect();
    let output = odgen(&scratch.0, &[&["check", "--format", "short"], backwards.as_slice()].concat());
    let said = stderr(&output);
    let mut order: Vec<&str> = said.lines().map(|line| line.split(':').next().unwrap()).collect();
    order.dedup();
    assert_eq!(order, backwards);
    // Where there is no terminal, nothing shows how far it is.
    assert!(!said.contains("checked ") && !said.contains('\r'));
    let again = odgen(&scratch.0, &[&["check", "--format", "short"], backwards.as_slice()].concat());
    assert_eq!(stderr(&again), said);
}

#[test]
fn a_file_without_findings_is_named_only_among_few() {
    let scratch = Scratch::new("few");
    let names: Vec<String> = (0..6).map(|number| format!("l{number}.od.yaml")).collect();
    for name in &names {
        scratch.file(name, LAMP);
    }
    let all: Vec<&str> = names.iter().map(String::as_str).collect();
    let said = |files: &[&str]| stderr(&odgen(&scratch.0, &[&["check"], files].concat()));
    assert_eq!(said(&all), "6 files: nothing found, 42 objects\n");
    assert_eq!(
        said(&all[..2]),
        "l0.od.yaml: nothing found, 7 objects\nl1.od.yaml: nothing found, 7 objects\n2 files: nothing found, 14 objects\n"
    );
}

#[test]
fn a_file_that_cannot_be_read_does_not_stop_the_others() {
    let scratch = Scratch::new("others");
    scratch.file("fan.eds", FAN);
    let output = odgen(&scratch.0, &["check", "missing.eds", "fan.eds", "--format", "short"]);
    assert_eq!((code(&output), stdout(&output)), (1, String::new()));
    let said = stderr(&output);
    assert!(said.starts_with("error[OD0101]: cannot read missing.eds: no such file"), "{said}");
    assert!(said.contains("\nfan.eds:147:12: error[EDS406]"), "{said}");
}

/// As in an editor: the file that `spec:` names has the names, types and limits.
#[test]
fn a_parameter_file_is_checked_on_the_device_that_it_names() {
    let scratch = Scratch::new("parameters");
    fs::create_dir(scratch.0.join("hall")).unwrap();
    scratch.file("lamp.od.yaml", LAMP);
    let check = |text: &str| {
        scratch.file("hall/node5.yaml", text);
        let output = odgen(&scratch.0, &["check", "hall/node5.yaml"]);
        (code(&output), stderr(&output))
    };
    let right = "od-parameters: 1\nspec: ../lamp.od.yaml\nnode: 5\nparameters: {brightness: 60 %}\n";
    assert_eq!(check(right), (0, "hall/node5.yaml: nothing found\n".to_owned()));
    let (code_of_value, said) = check(&right.replace("60", "101"));
    assert_eq!(code_of_value, 1);
    assert!(said.contains("error[OD0406]") && said.contains(" --> hall/node5.yaml:4:"), "{said}");
    let (_, said) = check(&right.replace("brightness", "brightnes"));
    assert!(said.contains("did you mean `brightness`?"), "{said}");
    let (code_of_file, said) = check(&right.replace("lamp", "lanp"));
    assert_eq!(code_of_file, 1);
    assert!(said.contains("cannot read `../lanp.od.yaml`: no such file"), "{said}");
    // What cannot describe a device is not read any further.
    let (code_of_file, said) = check(&right.replace("../lamp.od.yaml", "node5.yaml"));
    assert_eq!(code_of_file, 1);
    assert!(said.contains("error[OD0120]"), "{said}");
    // Without `spec:`, nothing could be said about its values.
    let (code_of_none, said) = check("od-parameters: 1\nparameters: {brightness: 60 %}\n");
    assert_eq!(code_of_none, 1);
    assert!(said.contains("error[OD0120]") && said.contains("if `spec:` names its specification"), "{said}");
    // From standard input, relative to where the command runs.
    let output = piped(&scratch.0, &["-", "--format", "short"], right.replace("../", "").as_bytes());
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
}

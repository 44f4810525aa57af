//! Files that another file names: nothing but regular files is read, and nothing is quoted of one that is not what it is
//! named for.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::{Scratch, code, odgen, stderr, stdout};

/// Four ways to name a file, `FILE`: a library, a part, the device of a plant, and the whole that a part belongs to.
const WAYS: [(&[&str], &str, &str); 4] = [
    (
        &["check", "a.od.yaml"],
        "a.od.yaml",
        "od-spec: 1\ntitle: Lamp\nuses: [cia301, FILE]\ndevices: {lamp: {name: Lamp, bit-rates: [125]}}\n",
    ),
    (
        &["check", "a.od.yaml"],
        "a.od.yaml",
        "od-spec: 1\ntitle: Lamp\nparts: [FILE]\ndevices: {lamp: {name: Lamp, bit-rates: [125]}}\n",
    ),
    (
        &["plant", "check", "plant.yaml"],
        "plant.yaml",
        "od-plant: 1\ntitle: Hall\ndevices: {lamp: {from: FILE}}\n\
         machine-types: {wall: {nodes: {1: {device: lamp, name: lamp}}}}\n\
         sites: {hall: {machines: {1: {type: wall}}}}\n",
    ),
    (&["check", "part.od.yaml"], "part.od.yaml", "od-spec: 1\npart-of: FILE\nobjects: {}\n"),
];

/// Files that are something else; each has a secret.
const OTHERS: [(&str, &[u8]); 5] = [
    ("passwd", b"root:x:0:0:secret word:/root:/bin/sh\n\tdaemon: [1\n"),
    ("key.pem", b"-----BEGIN PRIVATE KEY-----\nsecret word/+==\n-----END PRIVATE KEY-----\n"),
    ("program", b"\x7fELF\x02\x01secret word\xff\xfe\x00"),
    ("compose.yaml", b"services:\n  secret word: {password: secret word}\n"),
    ("list.json", b"{\"od\": [\"secret word\", }"),
];

#[test]
fn of_what_is_something_else_nothing_is_quoted() {
    for (arguments, name, text) in WAYS {
        for (other, bytes) in OTHERS {
            let scratch = Scratch::new("quoted");
            scratch.file(other, bytes);
            scratch.file(name, text.replace("FILE", other));
            let output = odgen(&scratch.0, arguments);
            let said = stderr(&output) + &stdout(&output);
            assert_eq!(code(&output), 1, "{said}");
            assert!(!said.contains("secret") && !said.contains("byte 0x"), "{arguments:?} {other}: {said}");
            assert!(said.contains(&format!("`{other}`")), "{arguments:?} {other}: {said}");
        }
    }
}

/// What a command says within some seconds; a pipe would keep it waiting for ever.
fn within_seconds(directory: &Path, arguments: &[&str]) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_odgen"));
    let command = command.current_dir(directory).args(arguments);
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let end = Instant::now() + Duration::from_secs(20);
    while child.try_wait().unwrap().is_none() {
        if Instant::now() > end {
            child.kill().unwrap();
            panic!("{arguments:?} waits");
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    let output = child.wait_with_output().unwrap();
    stderr(&output) + &stdout(&output)
}

#[cfg(unix)]
#[test]
fn a_pipe_that_is_named_is_not_waited_for() {
    for (arguments, name, text) in WAYS {
        let scratch = Scratch::new("pipe");
        let made = Command::new("mkfifo").arg(scratch.0.join("pipe.od.yaml")).status().unwrap();
        assert!(made.success());
        scratch.file(name, text.replace("FILE", "pipe.od.yaml"));
        let said = within_seconds(&scratch.0, arguments);
        let expected =
            if name == "part.od.yaml" { "OD0119" } else { "`pipe.od.yaml`: it is not a regular file" };
        assert!(said.contains(expected), "{said}");
    }
    let scratch = Scratch::new("device-file");
    let (arguments, name, text) = WAYS[0];
    scratch.file(name, text.replace("FILE", "/dev/zero"));
    let said = within_seconds(&scratch.0, arguments);
    assert!(said.contains("`/dev/zero`: it is not a regular file"), "{said}");
}

/// A pipe that the user names is another thing: it is how a shell hands over what a command prints.
#[cfg(unix)]
#[test]
fn a_pipe_on_the_command_line_is_read() {
    let scratch = Scratch::new("piped");
    scratch.file("lamp.od.yaml", crate::LAMP);
    let odgen = env!("CARGO_BIN_EXE_odgen");
    let script = format!("cat lamp.od.yaml | {odgen} check /dev/stdin");
    let output = Command::new("sh").current_dir(&scratch.0).args(["-c", &script]).output().unwrap();
    assert!(stderr(&output).contains("nothing found"), "{}", stderr(&output));
}

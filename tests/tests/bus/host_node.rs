//! The example of a node on the host, read and written by the command.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::io::{BufRead as _, BufReader};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};

use od_tests::root;

/// A program of the workspace.
fn program(name: &str) -> PathBuf {
    let tests = std::env::current_exe().unwrap();
    let folder = tests.parent().and_then(|folder| folder.parent()).unwrap();
    let program = folder.join(name).with_extension(std::env::consts::EXE_EXTENSION);
    assert!(program.is_file(), "{} is missing: `cargo build --workspace` builds it", program.display());
    program
}

/// A program that ends with the test.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[test]
fn the_command_reads_and_writes_the_example_on_the_host() {
    let mut command = Command::new(program("host-node"));
    let mut node = Running(command.arg("127.0.0.1:0").stdout(Stdio::piped()).spawn().unwrap());
    let mut said = BufReader::new(node.0.stdout.take().unwrap()).lines().map(Result::unwrap);
    let place = said.next().unwrap();
    let place = place.strip_prefix("node 5 at ").unwrap();
    let odgen = |command: &str, arguments: &[&str]| {
        let mut odgen = Command::new(program("odgen"));
        odgen.args(["node", command, "lamp.od.yaml", "--node", "5", "--slcan", place]).args(arguments);
        let output = odgen.current_dir(root().join("firmware-glue/examples/host-node")).output().unwrap();
        String::from_utf8([output.stdout, output.stderr].concat()).unwrap()
    };
    assert_eq!(odgen("read", &["brightness"]), "2000h brightness = 80 %  [50]\n");
    let written = odgen("write", &["brightness=40", "--yes"]);
    assert!(written.contains("2000h brightness = 40 %  [28]"), "{written}");
    assert_eq!(said.next().unwrap(), "brightness 40 %");
    assert_eq!(odgen("read", &["brightness"]), "2000h brightness = 40 %  [28]\n");
}

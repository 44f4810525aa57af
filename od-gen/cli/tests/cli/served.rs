//! A running `odgen serve`.

use std::io::{BufRead as _, BufReader};
use std::process::{Child, Command, Stdio};

use crate::Scratch;

/// Nodes on a bus at a free port, ended with the test.
pub(crate) struct Served {
    pub(crate) child: Child,
    /// The line that says where it is.
    pub(crate) line: String,
}

impl Served {
    /// `odgen serve` with these arguments, in a directory.
    pub(crate) fn start(scratch: &Scratch, arguments: &[&str], stderr: Stdio) -> Self {
        Self::at(scratch, arguments, "tcp:127.0.0.1:0", stderr)
    }

    /// [`start`](Self::start) at another place.
    pub(crate) fn at(scratch: &Scratch, arguments: &[&str], place: &str, stderr: Stdio) -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_odgen"));
        command.args([&["serve"], arguments, &["--slcan", place]].concat());
        Self::of(command, scratch, stderr)
    }

    /// [`start`](Self::start) with so many open files at most.
    #[cfg(unix)]
    pub(crate) fn limited(scratch: &Scratch, arguments: &[&str], files: u32) -> Self {
        let mut command = Command::new("sh");
        command.args(["-c", &format!("ulimit -n {files}; exec \"$@\""), "sh", env!("CARGO_BIN_EXE_odgen")]);
        command.args([&["serve"], arguments, &["--slcan", "tcp:127.0.0.1:0"]].concat());
        Self::of(command, scratch, Stdio::null())
    }

    fn of(mut command: Command, scratch: &Scratch, stderr: Stdio) -> Self {
        let mut child = command
            .current_dir(&scratch.0)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(stderr)
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        Self { child, line }
    }

    /// `tcp:127.0.0.1:PORT`.
    pub(crate) fn address(&self) -> &str {
        let address = self.line.trim().rsplit(' ').next().unwrap();
        assert!(address.starts_with("tcp:127.0.0.1:"), "{}", self.line);
        address
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Ends a program as Ctrl-C does; `false` where the system has no signals.
pub(crate) fn interrupt(program: &Child) -> bool {
    #[cfg(unix)]
    rustix::process::kill_process(rustix::process::Pid::from_child(program), rustix::process::Signal::INT)
        .unwrap();
    #[cfg(not(unix))]
    let _ = program;
    cfg!(unix)
}

//! Running programs: their output goes on to the user, at once or later, and what they count is kept for the summary.

use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use od_tests::{Failure, root};

/// The exit code of the scripts below `tests` when they could not install or find something.
const INCOMPLETE: i32 = 3;

/// Runs the programs of one part.
#[derive(Debug, Default)]
pub(crate) struct Runner {
    /// What the programs counted, where they did.
    pub(crate) counts: Option<Counts>,
    /// What could not be run.
    pub(crate) gap: Option<String>,
    pub(crate) output: Output,
}

/// Where the output of programs goes.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) enum Output {
    /// To the user, as it comes.
    #[default]
    Shown,
    /// Here, for a part that runs at the same time as another one.
    Kept(Vec<u8>),
}

/// What a test runner says in its last line.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Counts {
    pub(crate) passed: u64,
    pub(crate) failed: u64,
}

impl Counts {
    /// From a line like `test result: ok. 3 passed; 0 failed; …` or `3 passed, 0 failed, …`.
    fn of_line(line: &str) -> Option<Self> {
        let line = line.trim();
        if !line.starts_with("test result: ") && !line.starts_with(|first: char| first.is_ascii_digit()) {
            return None;
        }
        let words: Vec<&str> = line.split([' ', ',', ';', '.']).filter(|word| !word.is_empty()).collect();
        let before = |what: &str| {
            words
                .windows(2)
                .find(|pair| pair.get(1) == Some(&what))
                .and_then(|pair| pair.first()?.parse().ok())
        };
        Some(Self { passed: before("passed")?, failed: before("failed")? })
    }
}

/// The cargo that runs this program.
pub(crate) fn cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// Another program of the workspace, which is next to this one.
pub(crate) fn beside(name: &str) -> Result<PathBuf, Failure> {
    let program =
        std::env::current_exe()?.with_file_name(name).with_extension(std::env::consts::EXE_EXTENSION);
    if program.is_file() {
        Ok(program)
    } else {
        Err(format!("{} is missing: `cargo build --workspace` makes it", program.display()).into())
    }
}

/// How many arguments of a command its failure shows: a list of a hundred files says no more than its first ones.
const ARGUMENTS_SHOWN: usize = 16;

/// A command as a failure shows it.
fn shown(command: &Command) -> String {
    let mut words = vec![command.get_program().to_string_lossy()];
    words.extend(command.get_args().take(ARGUMENTS_SHOWN).map(std::ffi::OsStr::to_string_lossy));
    let more = command.get_args().len().saturating_sub(ARGUMENTS_SHOWN);
    if more > 0 {
        words.push(format!("… and {more} more").into());
    }
    words.join(" ")
}

impl Runner {
    pub(crate) fn cargo(&mut self, arguments: &[&str]) -> Result<(), Failure> {
        self.run(cargo().args(arguments))
    }

    /// The fuzzer is a program of its own because its allocator counts.
    pub(crate) fn fuzz(&mut self, arguments: &[&str]) -> Result<(), Failure> {
        self.run(Command::new(beside("fuzz")?).args(arguments))
    }

    pub(crate) fn python(&mut self, script: &str, arguments: &[&str]) -> Result<(), Failure> {
        self.run(Command::new("python3").arg(script).args(arguments))
    }

    /// Runs a program at the root of the workspace, without any input.
    pub(crate) fn run(&mut self, command: &mut Command) -> Result<(), Failure> {
        self.run_in(&root(), command)
    }

    /// Runs a program in a directory, without any input.
    pub(crate) fn run_in(&mut self, directory: &Path, command: &mut Command) -> Result<(), Failure> {
        let name = command.get_program().to_string_lossy().into_owned();
        let (reader, writer) = std::io::pipe()?;
        command.current_dir(directory).stdin(Stdio::null()).env("PYTHONUNBUFFERED", "1");
        if matches!(self.output, Output::Kept(_)) {
            command.stderr(writer.try_clone()?);
        }
        let child = command.stdout(writer).spawn();
        // The pipe ends when no process can write to it any more, not even by running the command again.
        command.stdout(Stdio::null()).stderr(Stdio::inherit());
        let mut child = child.map_err(|error| format!("cannot run {name}: {error}"))?;
        self.pass_on(BufReader::new(reader))?;
        let status = child.wait()?;
        let said = shown(command);
        match status.code() {
            Some(0) => Ok(()),
            Some(INCOMPLETE) => {
                self.gap = Some("something could not be installed, see there".to_owned());
                Ok(())
            }
            _ => Err(format!("`{said}` failed ({status})").into()),
        }
    }

    fn pass_on(&mut self, mut from: impl BufRead) -> Result<(), Failure> {
        let mut line = Vec::new();
        while from.read_until(b'\n', &mut line)? > 0 {
            match &mut self.output {
                Output::Shown => std::io::stdout().write_all(&line)?,
                Output::Kept(kept) => kept.extend(&line),
            }
            if let Some(counts) = Counts::of_line(&String::from_utf8_lossy(&line)) {
                let sum = self.counts.get_or_insert_default();
                sum.passed += counts.passed;
                sum.failed += counts.failed;
            }
            line.clear();
        }
        Ok(())
    }

    /// Prints something about the programs, where their output goes.
    pub(crate) fn print(&mut self, text: &str) {
        match &mut self.output {
            Output::Shown => println!("{text}"),
            Output::Kept(kept) => kept.extend(format!("{text}\n").bytes()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn last_lines_of_test_runners_are_counted_and_no_others() {
        let lines = "\
running 2 tests
test result: ok. 2 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out; finished in 0.01s
ok   3 passed, 4 failed
search: 7 passed, 8 failed
12 passed, 1 failed, 3 skipped
5 passed
";
        let mut runner = Runner { output: Output::Kept(Vec::new()), ..Runner::default() };
        runner.pass_on(lines.as_bytes()).unwrap();
        assert_eq!(runner.output, Output::Kept(lines.into()));
        assert_eq!(runner.counts, Some(Counts { passed: 14, failed: 1 }));
    }

    #[test]
    #[cfg(unix)]
    fn what_is_kept_has_messages_of_mistakes_too() {
        let mut runner = Runner { output: Output::Kept(Vec::new()), ..Runner::default() };
        runner.run(Command::new("sh").args(["-c", "echo one; echo two >&2; echo three"])).unwrap();
        assert_eq!(runner.output, Output::Kept(b"one\ntwo\nthree\n".to_vec()));
    }

    #[test]
    #[cfg(unix)]
    fn exit_codes_distinguish_a_failure_from_a_gap() {
        let run = |text: &str| {
            let mut runner = Runner::default();
            (runner.run(Command::new("sh").args(["-c", text])).map_err(|error| error.to_string()), runner.gap)
        };
        assert_eq!(run("exit 0"), (Ok(()), None));
        assert!(matches!(run("exit 3"), (Ok(()), Some(_))));
        assert!(matches!(run("exit 1"), (Err(failure), None) if failure.contains("sh -c exit 1")));
        assert!(Runner::default().run(&mut Command::new("no-program-has-this-name")).is_err());
        let mut command = Command::new("false");
        command.args((0..20).map(|number| number.to_string()));
        let failure = Runner::default().run(&mut command).unwrap_err().to_string();
        assert!(failure.contains("`false 0 1 2 ") && failure.contains(" 15 … and 4 more`"), "{failure}");
    }
}

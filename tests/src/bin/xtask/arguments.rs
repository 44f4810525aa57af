//! The command line of `cargo xtask`.

use std::collections::BTreeSet;

use crate::parts::{self, Area};

/// What there is to do.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Task {
    /// Look at the form and run the unit tests.
    Check,
    /// Run the tests.
    Test(TestOptions),
    /// Write everything that is generated and checked in.
    Generate,
    /// Print what of that is not current.
    CheckGenerated,
    /// Take a directory of foreign EDS and DCF files through everything.
    /// A directory, and of how many files one is taken.
    Corpus(String, usize),
    /// Try mutants of files, with the arguments of the program `fuzz`.
    Fuzz(Vec<String>),
    /// Measure and compare with other tools, with the arguments of tests/bench/run.py.
    Bench(Vec<String>),
    /// Measure the reading of EDS files and compare with other readers, with the arguments of
    /// tests/bench/eds/reading.py.
    BenchReading(Vec<String>),
    /// Write the command as a page.
    Web,
    /// Print a text about a task, or about all.
    Help(String),
}

/// How the tests are run.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct TestOptions {
    pub(crate) choice: Choice,
    /// What happens with parts whose tools are missing.
    pub(crate) gaps: Gaps,
    /// Parts that the user does not want to run.
    pub(crate) unwanted: BTreeSet<Area>,
}

/// Which parts of the tests run.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Choice {
    /// Those of the gate.
    Gate,
    /// Those that are outside it.
    Long,
    /// Those with these names.
    Named(Vec<String>),
}

/// What a part of the tests means that could not run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Gaps {
    /// It is reported at the end, and the tests pass if what ran has passed.
    Reported,
    /// The tests fail.
    Refused,
}

pub(crate) const HELP: &str = "\
cargo xtask TASK

  check               format, lints and unit tests: about a minute
  test [--all | --long] [--without-browser] [--without-emulator] [PART…]
                      run the tests: every part that this machine has the tools for
  generate [--check]  rewrite everything that is generated and checked in, or report what is not current
  corpus DIR          take the EDS, DCF, XDD and XDC files of a directory through everything
  fuzz [--of TEXTS] [--seconds N] [--seed N] [FILE|DIR…]
                      change files by chance, and see whether anything breaks
  bench [ARGUMENT…]   compare odgen with other tools; `bench --help` lists the arguments
  bench eds [ARGUMENT…]
                      compare the reading of EDS files with other readers; `bench eds --help` lists the arguments
  web                 write the command as one HTML page, target/web/odgen.html
  help [TASK]         this text, or one about a task
";

const CHECK: &str = "\
cargo xtask check

Checks the format, the lints of clippy and the documentation, and runs the unit tests. It is the beginning of `cargo xtask test`.
";

const TEST: &str = "\
cargo xtask test [--all | --long] [--without-browser] [--without-emulator] [PART…]

Checks the form, runs the Rust tests, a short fuzzer, five EDS readers and an SDO client that others wrote, the documents in a
browser, and firmware on an emulated Cortex-M. First it lists the tools that are missing, each with the line that installs it; then
it runs every part whose tools are there, also after a failure; at the end it prints what passed, what failed, what was left out
and why, and how long each part took. Other parts run at the same time as the Rust tests; what they print follows after these.

  --all               fail when anything is left out
  --long              run what is outside the gate instead, before a release; fail when anything is left out
  --without-browser   do not read the documents in Chromium and on paper
  --without-emulator  do not build the firmware, and do not run it in QEMU
  PART…               run only these parts, of the gate or outside it; fail when anything is left out

Screenshots and PDFs of the documents go to target/browser/seen. What the parts install for themselves goes into target/, from the
registries of Python, npm and Rust; the target thumbv7em-none-eabi is added with rustup where rustup can fetch it.

Exit codes: 0 all that ran has passed, 1 something failed (or was left out where it may not), 2 wrong command line.
";

const GENERATE: &str = "\
cargo xtask generate [--check]

Rewrites everything that is generated and checked in. With --check it writes nothing, and fails with the first difference.
";

const WEB: &str = "\
cargo xtask web

Compiles odgen to WebAssembly and writes target/web/odgen.html, a page that has it inside and asks for nothing from anywhere. It takes minutes;
`cargo xtask test page` does it, too, and tries the page. It needs Rust's target wasm32-wasip1: `rustup target add wasm32-wasip1`.
";

const CORPUS: &str = "\
cargo xtask corpus DIR [--every N]

Takes every EDS, DCF, XDD and XDC below a directory through everything, and prints a line for each problem and a table of the rest:
bytes to text and back, reading it as it is and as the standard wants it, importing it, the EDS of the import, the import of
that, and fixing it. Facts that do not come back are problems, except those with a reason in
tests/src/foreign/exceptions.rs. Of an XDD or XDC it leaves out what is about lines: bytes, fixing, comparing.
With --every it takes only each Nth file, in the order of their names.

Exit codes: 0 every file is without a problem, 1 one has problems, 2 wrong command line.
";

const FUZZ: &str = "\
cargo xtask fuzz [--of TEXTS] [--seconds N] [--seed N] [--mutants N] [--failures N] [FILE|DIR…]

Changes texts by chance, as the seed decides, and holds every mutant to what is promised of all texts. Of each: no panic; every
place of a finding is in the file; findings read well in every format; memory stays within the bounds of tests/src/fuzz. And of
  eds             EDS and DCF files: their bytes come back; a model comes out; what is fixed says the same, has no more errors than
                  before and is not changed by a second time; an import compiles and has the same facts, except those with a
                  reason in tests/src/foreign/exceptions.rs
  xdd             XDD and XDC files: there is a model or an error; an XDD and an EDS of the model are read again; an import as of an EDS
  specifications  specifications and libraries: there is a model or an error with a place; the EDS and DCF of a model keep the
                  standard and have its objects; its Rust is Rust, its JSON is JSON, its documents are printed
  settings        settings of a node: the DCF of what is accepted keeps the standard, and has every value
  templates       templates of documents: a mistake is reported with its place
It begins with the files of this repository, and with those that are named.

  --of TEXTS          only these; without it, all one after the other
  --seconds N         how long in all (60)
  --seed N            the number of the first mutant (1); the next have the numbers after it
  --mutants N         at most so many
  --failures N        end after so many failures of different kinds (1)

A failure is printed with the seed that makes the mutant again from the same files; the smallest text that was found for it goes
to target/fuzz.

Exit codes: 0 no mutant fails, 1 one fails.
";

const BENCH: &str = "\
cargo xtask bench [ARGUMENT…]
cargo xtask bench eds [ARGUMENT…]

Measures odgen in comparison with other tools; the arguments are those of tests/bench/run.py, whose `--help` lists them. With `eds`, how
long it takes to read, check, convert and import an EDS in comparison with other readers; the arguments are those of
tests/bench/eds/reading.py.
";

/// The task that the arguments mean, or what is wrong with them.
pub(crate) fn parse(arguments: &[&str]) -> Result<Task, String> {
    match arguments {
        [] => Err("no task is named".to_owned()),
        ["help" | "--help" | "-h"] => Ok(Task::Help(HELP.to_owned())),
        ["help", task] => help(task),
        // The scripts of the benchmarks answer `--help` themselves.
        ["bench", "eds", rest @ ..] => Ok(Task::BenchReading(owned(rest))),
        ["fuzz", rest @ ..] if !rest.contains(&"--help") && !rest.contains(&"-h") => {
            Ok(Task::Fuzz(owned(rest)))
        }
        ["bench", rest @ ..] => Ok(Task::Bench(owned(rest))),
        [task, options @ ..] if options.contains(&"--help") || options.contains(&"-h") => help(task),
        ["check"] => Ok(Task::Check),
        ["test", options @ ..] => test(options).map(Task::Test),
        ["generate"] => Ok(Task::Generate),
        ["generate", "--check"] => Ok(Task::CheckGenerated),
        ["web"] => Ok(Task::Web),
        ["corpus", directory] => Ok(Task::Corpus((*directory).to_owned(), 1)),
        ["corpus", directory, "--every", count] => match count.parse() {
            Ok(count) if count > 0 => Ok(Task::Corpus((*directory).to_owned(), count)),
            _ => Err(format!("`--every` wants a number from 1, not `{count}`")),
        },
        ["corpus"] => Err("`corpus` wants a directory".to_owned()),
        [task, rest @ ..] => {
            help(task)?;
            Err(format!("`{task}` does not take `{}`", rest.join(" ")))
        }
    }
}

fn owned(arguments: &[&str]) -> Vec<String> {
    arguments.iter().map(|&argument| argument.to_owned()).collect()
}

fn help(task: &str) -> Result<Task, String> {
    match task {
        "check" => Ok(Task::Help(CHECK.to_owned())),
        "test" => Ok(Task::Help(format!("{TEST}\n{}", parts::listed()))),
        "generate" => Ok(Task::Help(GENERATE.to_owned())),
        "corpus" => Ok(Task::Help(CORPUS.to_owned())),
        "fuzz" => Ok(Task::Help(FUZZ.to_owned())),
        "web" => Ok(Task::Help(WEB.to_owned())),
        "bench" => Ok(Task::Help(BENCH.to_owned())),
        "help" => Ok(Task::Help(HELP.to_owned())),
        _ => Err(format!("there is no task `{task}`")),
    }
}

fn test(options: &[&str]) -> Result<TestOptions, String> {
    let mut chosen = TestOptions { choice: Choice::Gate, gaps: Gaps::Reported, unwanted: BTreeSet::new() };
    let mut named = Vec::new();
    for &option in options {
        match option {
            "--all" => chosen.gaps = Gaps::Refused,
            "--long" => chosen.choice = Choice::Long,
            "--without-browser" => drop(chosen.unwanted.insert(Area::Browser)),
            "--without-emulator" => drop(chosen.unwanted.insert(Area::Firmware)),
            part if parts::named(part).is_some() => named.push(part.to_owned()),
            _ => return Err(format!("`test` does not take `{option}`")),
        }
    }
    if chosen.gaps == Gaps::Refused && !chosen.unwanted.is_empty() {
        return Err("`--all` wants every part, `--without-…` leaves one out".to_owned());
    }
    if !named.is_empty() {
        if chosen != (TestOptions { choice: Choice::Gate, gaps: Gaps::Reported, unwanted: BTreeSet::new() }) {
            return Err("`test` takes either names of parts or options".to_owned());
        }
        chosen.choice = Choice::Named(named);
    }
    if chosen.choice != Choice::Gate {
        if chosen.gaps == Gaps::Refused {
            return Err("`--all` is the gate, `--long` what is outside it".to_owned());
        }
        chosen.gaps = Gaps::Refused;
    }
    Ok(chosen)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn test_with(gaps: Gaps, unwanted: &[Area]) -> Task {
        Task::Test(TestOptions { choice: Choice::Gate, gaps, unwanted: unwanted.iter().copied().collect() })
    }

    #[test]
    fn tasks_and_their_options_are_understood() {
        assert_eq!(parse(&["test"]), Ok(test_with(Gaps::Reported, &[])));
        assert_eq!(parse(&["test", "--all"]), Ok(test_with(Gaps::Refused, &[])));
        assert_eq!(
            parse(&["test", "--without-emulator", "--without-browser"]),
            Ok(test_with(Gaps::Reported, &[Area::Browser, Area::Firmware]))
        );
        let refused =
            |choice| Task::Test(TestOptions { choice, gaps: Gaps::Refused, unwanted: BTreeSet::new() });
        assert_eq!(parse(&["test", "--long"]), Ok(refused(Choice::Long)));
        let named = Choice::Named(vec!["browser".to_owned(), "sdo".to_owned()]);
        assert_eq!(parse(&["test", "browser", "sdo"]), Ok(refused(named)));
        assert_eq!(parse(&["check"]), Ok(Task::Check));
        assert_eq!(parse(&["web"]), Ok(Task::Web));
        assert_eq!(parse(&["generate"]), Ok(Task::Generate));
        assert_eq!(parse(&["generate", "--check"]), Ok(Task::CheckGenerated));
        assert_eq!(parse(&["corpus", "eds"]), Ok(Task::Corpus("eds".to_owned(), 1)));
        assert_eq!(parse(&["corpus", "eds", "--every", "4"]), Ok(Task::Corpus("eds".to_owned(), 4)));
        assert_eq!(
            parse(&["fuzz", "--seed", "7"]),
            Ok(Task::Fuzz(vec!["--seed".to_owned(), "7".to_owned()]))
        );
        assert_eq!(parse(&["bench", "--help"]), Ok(Task::Bench(vec!["--help".to_owned()])));
        assert_eq!(parse(&["bench", "eds", "--help"]), Ok(Task::BenchReading(vec!["--help".to_owned()])));
    }

    #[test]
    fn every_task_has_a_help() {
        let lines =
            HELP.lines().filter_map(|line| line.strip_prefix("  ").filter(|line| !line.starts_with(' ')));
        let tasks: Vec<&str> = lines.filter_map(|line| line.split(' ').next()).collect();
        assert_eq!(tasks, ["check", "test", "generate", "corpus", "fuzz", "bench", "bench", "web", "help"]);
        for task in tasks {
            assert!(matches!(parse(&["help", task]), Ok(Task::Help(_))), "{task}");
        }
        assert!(matches!(parse(&["test", "--all", "-h"]), Ok(Task::Help(text)) if text.contains(TEST)));
        assert_eq!(parse(&["--help"]), Ok(Task::Help(HELP.to_owned())));
    }

    #[test]
    fn what_is_not_understood_is_said() {
        let wrong = |arguments: &[&str]| parse(arguments).unwrap_err();
        assert_eq!(wrong(&[]), "no task is named");
        assert_eq!(wrong(&["tset"]), "there is no task `tset`");
        assert_eq!(wrong(&["tset", "--help"]), "there is no task `tset`");
        assert_eq!(wrong(&["tset", "--all"]), "there is no task `tset`");
        assert_eq!(wrong(&["help", "tset"]), "there is no task `tset`");
        assert_eq!(wrong(&["corpus"]), "`corpus` wants a directory");
        assert_eq!(wrong(&["corpus", "a", "--every", "0"]), "`--every` wants a number from 1, not `0`");
        assert_eq!(wrong(&["corpus", "a", "b"]), "`corpus` does not take `a b`");
        assert_eq!(wrong(&["test", "--al"]), "`test` does not take `--al`");
        assert_eq!(wrong(&["generate", "--chekc"]), "`generate` does not take `--chekc`");
        assert_eq!(wrong(&["test", "brwoser"]), "`test` does not take `brwoser`");
        assert_eq!(wrong(&["test", "browser", "--all"]), "`test` takes either names of parts or options");
        assert_eq!(wrong(&["test", "--long", "--all"]), "`--all` is the gate, `--long` what is outside it");
        assert_eq!(
            wrong(&["test", "--all", "--without-browser"]),
            "`--all` wants every part, `--without-…` leaves one out"
        );
    }
}

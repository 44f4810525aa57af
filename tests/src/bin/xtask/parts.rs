//! The parts of the tests as one table: what each needs, when it runs, and what it does.

use std::collections::BTreeSet;
use std::fmt;

use od_tests::Failure;

use crate::runner::Runner;
use crate::tools::Tool;
use crate::{browser, english, form, installed, manuals, misra, package, plain_c, readers, rust_tests, web};

/// A part of the tests.
pub(crate) struct Part {
    /// The word of the command line.
    pub(crate) name: &'static str,
    pub(crate) title: &'static str,
    pub(crate) area: Area,
    pub(crate) tier: Tier,
    pub(crate) turn: Turn,
    /// Tools without which it cannot run.
    needs: &'static [Tool],
    /// Tools without which it leaves something out: node-canopen, of the five readers and of two masters.
    uses: &'static [Tool],
    /// The script that, with `--install`, fetches from registries what the part needs.
    pub(crate) installer: Option<&'static str>,
    /// Runs it. What it leaves out because a registry cannot be reached is in the runner.
    pub(crate) run: fn(&mut Runner) -> Result<(), Failure>,
}

impl fmt::Debug for Part {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name)
    }
}

/// What parts have in common; what a tool is needed for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Area {
    Rust,
    Readers,
    Browser,
    Firmware,
    Installed,
}

/// How often a part runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Tier {
    /// With `cargo xtask check` and in the gate: after every edit.
    Check,
    /// In the gate: before every change is sent.
    Gate,
    /// With `--long`, before a release, for this reason.
    Long(&'static str),
}

/// How much of what there is a part looks at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Amount {
    /// One of each kind.
    Sample,
    All,
}

/// Which other parts a part runs with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Turn {
    /// From the start, one after the other: cargo, which works on all cores.
    First,
    /// At the same time, two at a time; three when those of cargo have ended.
    Beside,
    /// At the same time as all others, one after the other: these wait for each other's messages most of the time.
    Waiting,
}

/// Whether a part can run.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Readiness {
    /// Everything is there.
    Whole,
    /// It can run, except for what these tools would do.
    Partly(Vec<Tool>),
    /// It cannot run without these tools.
    Lacks(Vec<Tool>),
}

const PYTHON: &[Tool] = &[Tool::Python];
const NODE: &[Tool] = &[Tool::Node];
const BROWSER: &[Tool] = &[Tool::Python, Tool::Node, Tool::Chromium, Tool::Pdftotext];
const PAPER: &[Tool] = &[Tool::Python, Tool::Pdftotext, Tool::Pango];
const THUMB: &[Tool] = &[Tool::Python, Tool::ThumbTarget, Tool::ThumbLinker];
const PAGE: &[Tool] = &[Tool::Python, Tool::Node, Tool::Chromium, Tool::Pdftotext, Tool::PageTarget];
const WINDOWS: &[Tool] = &[Tool::WindowsTarget, Tool::Mingw, Tool::Wine];
const EMULATOR: &[Tool] = &[Tool::Python, Tool::ThumbTarget, Tool::ThumbLinker, Tool::Qemu];
const STARTER: &[Tool] = &[Tool::Python, Tool::Make, Tool::Clang, Tool::ThumbLinker, Tool::Qemu];
const STARTERS: &[Tool] =
    &[Tool::Python, Tool::Make, Tool::Clang, Tool::ThumbTarget, Tool::ThumbLinker, Tool::Qemu];

/// A part of the Rust tests in this tier; other parts change what differs.
const fn rust(
    name: &'static str,
    title: &'static str,
    tier: Tier,
    run: fn(&mut Runner) -> Result<(), Failure>,
) -> Part {
    Part {
        name,
        title,
        area: Area::Rust,
        tier,
        turn: Turn::First,
        needs: &[],
        uses: &[],
        installer: None,
        run,
    }
}

/// A part with tools that others wrote.
const fn reader(
    name: &'static str,
    title: &'static str,
    tier: Tier,
    run: fn(&mut Runner) -> Result<(), Failure>,
) -> Part {
    let installer = Some("tests/readers/run.py");
    Part { area: Area::Readers, turn: Turn::Beside, needs: PYTHON, installer, ..rust(name, title, tier, run) }
}

/// All parts, in the order in which they run.
pub(crate) static PARTS: [Part; 53] = [
    rust("form", "form", Tier::Check, form::check),
    rust("english", "plain English", Tier::Check, english::check),
    rust("unit", "unit tests", Tier::Check, rust_tests::unit),
    rust("rust", "Rust tests", Tier::Gate, rust_tests::integration),
    rust("examples", "examples in the documentation", Tier::Gate, rust_tests::examples),
    rust("packages", "packages are complete", Tier::Gate, package::complete),
    // What takes longest begins first.
    Part {
        area: Area::Browser,
        turn: Turn::Beside,
        needs: BROWSER,
        installer: Some("tests/browser/run.py"),
        ..rust("browser", "documents in a browser", Tier::Gate, |runner| {
            browser::read_documents(runner, Amount::Sample)
        })
    },
    reader("st", "Structured Text", Tier::Gate, |runner| readers::structured_text(runner, Amount::Sample)),
    // The same mutants in every run, as the seed decides.
    Part {
        turn: Turn::Beside,
        ..rust("mutants", "mutants of files", Tier::Gate, |runner| {
            runner.fuzz(&["--seconds", "5", "--seed", "1"])
        })
    },
    Part {
        uses: NODE,
        ..reader("everything", "EDS readers: every feature", Tier::Gate, readers::every_feature)
    },
    Part {
        uses: NODE,
        ..reader("configured", "EDS readers: a DCF with settings", Tier::Gate, readers::configured)
    },
    Part {
        uses: NODE,
        ..reader("shipped", "EDS readers: shipped devices", Tier::Gate, |runner| {
            runner.python("tests/readers/run.py", &[])
        })
    },
    Part { uses: NODE, ..reader("drives", "EDS readers: drives of odgen new", Tier::Gate, readers::drives) },
    Part {
        uses: NODE,
        ..reader("predicted", "EDS readers: what is predicted", Tier::Gate, |runner| {
            readers::predicted(runner, Amount::Sample)
        })
    },
    reader("eds2c", "EDS readers: firmware in C", Tier::Gate, readers::firmware_in_c),
    reader("concise", "EDS readers: concise DCF", Tier::Gate, readers::concise_dcf),
    reader("xdd", "EDS readers: XDD and XDC", Tier::Gate, readers::xdd_structure),
    reader("plant", "EDS readers: a plant", Tier::Gate, readers::plant),
    reader("values", "EDS readers: values of nodes", Tier::Gate, readers::values_of_nodes),
    reader("book", "the book and its links", Tier::Gate, readers::book),
    Part {
        turn: Turn::Waiting,
        ..reader("faults", "faults on a live bus", Tier::Gate, |runner| {
            readers::faults(runner, Amount::Sample)
        })
    },
    reader("dbc", "DBC readers", Tier::Gate, readers::dbc),
    reader("lsp", "language server", Tier::Gate, readers::language_server),
    reader("editors", "language server in Neovim", Tier::Gate, readers::editors),
    Part {
        uses: NODE,
        turn: Turn::Waiting,
        ..reader("sdo", "SDO client", Tier::Gate, |runner| readers::sdo_client(runner, Amount::Sample))
    },
    Part {
        area: Area::Browser,
        turn: Turn::Beside,
        needs: PAPER,
        installer: Some("tests/print/run.py"),
        ..rust("paper", "manuals on paper", Tier::Gate, |runner| manuals::print(runner, Amount::Sample))
    },
    Part {
        area: Area::Firmware,
        turn: Turn::Beside,
        needs: THUMB,
        ..rust("sizes", "sizes of firmware", Tier::Gate, |runner| {
            runner.python("tests/thumb/run.py", &["sizes"])
        })
    },
    Part {
        area: Area::Firmware,
        turn: Turn::Beside,
        needs: EMULATOR,
        ..rust("emulator", "firmware in an emulator", Tier::Gate, |runner| {
            runner.python("tests/thumb/run.py", &["test"])
        })
    },
    Part {
        area: Area::Firmware,
        turn: Turn::Beside,
        needs: EMULATOR,
        ..rust("demo", "demo firmware in an emulator", Tier::Gate, |runner| {
            readers::demo_firmware(runner, Amount::Sample)
        })
    },
    Part {
        area: Area::Firmware,
        turn: Turn::Beside,
        needs: &[Tool::ThumbLinker, Tool::Qemu, Tool::Clang],
        ..rust("plain-c", "dictionaries in plain C", Tier::Gate, |runner| {
            plain_c::try_all(runner, Amount::Sample)
        })
    },
    Part {
        area: Area::Firmware,
        turn: Turn::Beside,
        needs: STARTER,
        ..rust("starter", "firmware of odgen new in an emulator", Tier::Gate, |runner| {
            readers::new_firmware(runner, Amount::Sample)
        })
    },
    Part {
        area: Area::Readers,
        turn: Turn::Beside,
        needs: &[Tool::Python, Tool::Valgrind],
        ..rust("instructions", "instructions of eight commands", Tier::Gate, readers::instructions)
    },
    rust(
        "long-rust",
        "Rust tests with all random values",
        Tier::Long("finds rare faults only; the gate tries the first quarter of the same values"),
        rust_tests::long,
    ),
    rust(
        "documentation",
        "links of the documentation",
        Tier::Long(
            "reads every crate once more; the gate's lints want a text at each item, and its examples run",
        ),
        form::documentation,
    ),
    rust(
        "features",
        "each feature alone",
        Tier::Long(
            "compiles libraries a dozen times; the gate compiles none of the features and all of them",
        ),
        form::features,
    ),
    rust(
        "unpacked",
        "crates from their packages, and the installed command",
        Tier::Long("compiles everything once more; the gate looks at the lists of files and the manifests"),
        package::unpacked,
    ),
    Part {
        area: Area::Installed,
        turn: Turn::First,
        needs: WINDOWS,
        ..rust(
            "windows",
            "the command on Windows",
            Tier::Long("compiles everything once more; the gate tests the same code on this system"),
            installed::windows,
        )
    },
    Part {
        area: Area::Installed,
        turn: Turn::First,
        needs: PYTHON,
        ..rust(
            "wheel",
            "the command from a Python package",
            Tier::Long("fetches a builder of packages; the package has nothing but the program"),
            installed::wheel,
        )
    },
    Part {
        area: Area::Browser,
        turn: Turn::First,
        needs: PAGE,
        installer: Some("tests/browser/run.py"),
        ..rust(
            "page",
            "the command in a browser",
            Tier::Long("compiles everything once more, optimized; the gate tests the same code as a command"),
            web::try_page,
        )
    },
    rust(
        "long-mutants",
        "mutants of files for ten minutes",
        Tier::Long("finds rare faults only; the gate tries the first of the same mutants"),
        |runner| runner.fuzz(&["--seconds", "600", "--seed", "1"]),
    ),
    Part {
        uses: NODE,
        ..reader(
            "selftest",
            "EDS readers notice mistakes",
            Tier::Long("changes its answer with the scripts of the readers only, which the gate runs"),
            readers::self_test,
        )
    },
    Part {
        uses: NODE,
        ..reader(
            "long-predicted",
            "EDS readers: what is predicted of all faults",
            Tier::Long(
                "plants the same faults in more places; the gate takes each sixth of the files, of which all have to agree",
            ),
            |runner| readers::predicted(runner, Amount::All),
        )
    },
    reader(
        "long-st",
        "Structured Text of all devices",
        Tier::Long(
            "the parser that others wrote takes minutes for it; the gate takes a small device and the limits of values, \
             and of their constants and of the planted faults a few",
        ),
        |runner| readers::structured_text(runner, Amount::All),
    ),
    Part {
        area: Area::Firmware,
        turn: Turn::Beside,
        needs: &[Tool::ThumbLinker, Tool::Qemu, Tool::Clang],
        ..rust(
            "long-plain-c",
            "dictionaries in plain C with all random requests",
            Tier::Long(
                "finds rare faults only; the gate asks the first quarter of the same requests, and none of the \
                 shipped devices, which the Rust tests ask on the host",
            ),
            |runner| plain_c::try_all(runner, Amount::All),
        )
    },
    Part {
        area: Area::Firmware,
        turn: Turn::Beside,
        needs: &[Tool::Cppcheck],
        ..rust(
            "misra",
            "dictionaries in plain C by MISRA",
            Tier::Long("needs a tool that few machines have, and whose findings differ by its version"),
            misra::try_all,
        )
    },
    Part {
        uses: NODE,
        ..reader(
            "long-sdo",
            "SDO client with all devices",
            Tier::Long("asks three devices the same, and on a bus that loses frames; the gate asks one"),
            |runner| readers::sdo_client(runner, Amount::All),
        )
    },
    Part {
        turn: Turn::Waiting,
        ..reader(
            "long-faults",
            "faults on a live bus in every command",
            Tier::Long("does the same to five commands; the gate does it to the one that writes most"),
            |runner| readers::faults(runner, Amount::All),
        )
    },
    Part {
        area: Area::Firmware,
        turn: Turn::Beside,
        needs: EMULATOR,
        ..rust(
            "long-demo",
            "firmware of all devices in an emulator",
            Tier::Long("tries the entries of three devices in the same way; the gate tries those of one"),
            |runner| readers::demo_firmware(runner, Amount::All),
        )
    },
    Part {
        area: Area::Firmware,
        turn: Turn::Beside,
        needs: STARTERS,
        ..rust(
            "long-starter",
            "firmware of odgen new in Rust in an emulator",
            Tier::Long("compiles a build script with all of od-gen; the gate tries those in C"),
            |runner| readers::new_firmware(runner, Amount::All),
        )
    },
    Part {
        needs: &[Tool::Python, Tool::Node],
        installer: None,
        ..reader(
            "extension",
            "packages of the extension for VS Code",
            Tier::Long("downloads a packager; the gate reads the extension and runs its server in Neovim"),
            readers::extension,
        )
    },
    Part {
        needs: &[Tool::Emacs],
        installer: None,
        ..reader(
            "emacs",
            "language server in Emacs",
            Tier::Long("needs an editor that few machines have; the gate does the same in Neovim"),
            readers::emacs,
        )
    },
    Part {
        area: Area::Browser,
        turn: Turn::Beside,
        needs: BROWSER,
        installer: Some("tests/browser/run.py"),
        ..rust(
            "long-browser",
            "all documents in a browser",
            Tier::Long(
                "looks at eight documents, at everything in each width; the gate looks at three, at one of each kind, \
                 and asks the largest a sixth of the questions",
            ),
            |runner| browser::read_documents(runner, Amount::All),
        )
    },
    Part {
        area: Area::Browser,
        turn: Turn::Beside,
        needs: PAPER,
        installer: Some("tests/print/run.py"),
        ..rust(
            "long-paper",
            "all manuals on paper",
            Tier::Long("prints five manuals in the same way; the gate prints two of them"),
            |runner| manuals::print(runner, Amount::All),
        )
    },
];

impl Part {
    /// Whether it can run with these tools.
    pub(crate) fn readiness(&self, found: &BTreeSet<Tool>) -> Readiness {
        let missing =
            |tools: &[Tool]| tools.iter().copied().filter(|tool| !found.contains(tool)).collect::<Vec<_>>();
        let (lacks, does_without) = (missing(self.needs), missing(self.uses));
        if !lacks.is_empty() {
            Readiness::Lacks(lacks)
        } else if !does_without.is_empty() {
            Readiness::Partly(does_without)
        } else {
            Readiness::Whole
        }
    }

    /// Its position in the table.
    pub(crate) fn position(&self) -> usize {
        PARTS.iter().position(|part| part.name == self.name).unwrap_or(PARTS.len())
    }
}

/// The parts by name, for the help; those outside the gate with the reason.
pub(crate) fn listed() -> String {
    let row = |part: &Part| match part.tier {
        Tier::Check | Tier::Gate => format!("  {:<14}{}\n", part.name, part.title),
        Tier::Long(why) => format!("  {:<14}{}; {why}\n", part.name, part.title),
    };
    let (long, gate): (Vec<&Part>, Vec<&Part>) =
        PARTS.iter().partition(|part| matches!(part.tier, Tier::Long(_)));
    let rows = |parts: Vec<&Part>| parts.into_iter().map(row).collect::<String>();
    format!("Parts of the gate:\n{}\nParts outside it, and why:\n{}", rows(gate), rows(long))
}

/// The part with this name.
pub(crate) fn named(name: &str) -> Option<&'static Part> {
    PARTS.iter().find(|part| part.name == name)
}

impl Area {
    pub(crate) const fn title(self) -> &'static str {
        match self {
            Area::Rust => "the Rust tests",
            Area::Readers => "the foreign readers of EDS files",
            Area::Browser => "the documents in a browser",
            Area::Firmware => "the firmware for a Cortex-M",
            Area::Installed => "the command on other systems",
        }
    }
}

/// What a tool is needed for.
pub(crate) fn needed_for(tool: Tool, parts: &[&Part]) -> BTreeSet<Area> {
    let needing = parts.iter().filter(|part| part.needs.contains(&tool) || part.uses.contains(&tool));
    needing.map(|part| part.area).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn readiness(name: &str, missing: &[Tool]) -> Readiness {
        let found = Tool::ALL.into_iter().filter(|tool| !missing.contains(tool)).collect();
        named(name).unwrap().readiness(&found)
    }

    #[test]
    fn names_and_titles_are_different_and_short() {
        let names: BTreeSet<&str> = PARTS.iter().map(|part| part.name).collect();
        let titles: BTreeSet<&str> = PARTS.iter().map(|part| part.title).collect();
        assert_eq!((names.len(), titles.len()), (PARTS.len(), PARTS.len()));
        assert!(
            names
                .iter()
                .all(|name| name.bytes().all(|byte| byte.is_ascii_lowercase() || b"-2".contains(&byte)))
        );
        assert!(Tool::ALL.is_sorted() && Tool::ALL.last() == Some(&Tool::Valgrind));
    }

    #[test]
    fn with_everything_every_part_runs_and_with_nothing_the_rust_tests() {
        for part in &PARTS {
            assert_eq!(readiness(part.name, &[]), Readiness::Whole);
            let alone = readiness(part.name, &Tool::ALL);
            assert_eq!(alone == Readiness::Whole, part.area == Area::Rust, "{part:?}: {alone:?}");
            assert!(!matches!(alone, Readiness::Partly(_)), "{part:?}");
        }
    }

    #[test]
    fn each_tool_is_missed_by_what_needs_it() {
        assert_eq!(readiness("shipped", &[Tool::Node]), Readiness::Partly(vec![Tool::Node]));
        assert_eq!(readiness("sdo", &[Tool::Node]), Readiness::Partly(vec![Tool::Node]));
        assert_eq!(readiness("plant", &[Tool::Node]), Readiness::Whole);
        assert_eq!(readiness("browser", &[Tool::Node]), Readiness::Lacks(vec![Tool::Node]));
        assert_eq!(readiness("sizes", &[Tool::Qemu]), Readiness::Whole);
        assert_eq!(readiness("emulator", &[Tool::Qemu]), Readiness::Lacks(vec![Tool::Qemu]));
        let all: Vec<&Part> = PARTS.iter().collect();
        for tool in Tool::ALL {
            assert!(PARTS.iter().any(|part| readiness(part.name, &[tool]) != Readiness::Whole), "{tool:?}");
            assert!(!needed_for(tool, &all).is_empty(), "{tool:?}");
        }
    }

    /// What moves out of the gate leaves a cheap one of its kind there.
    #[test]
    fn a_long_part_that_does_more_of_a_part_has_this_part_in_the_gate() {
        for name in PARTS.iter().filter_map(|part| part.name.strip_prefix("long-")) {
            let short = named(name).unwrap_or_else(|| panic!("{name}"));
            assert_eq!(short.tier, Tier::Gate, "{name}");
        }
    }
}

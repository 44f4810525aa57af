//! The parts of the tests, what each needs, and whether it can run on this machine.

use std::collections::BTreeSet;

use od_tests::Failure;

use crate::runner::Runner;
use crate::tools::Tool;
use crate::{browser, manuals, plain_c, readers};

/// A part of the tests, in the order in which they run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Part {
    Rust,
    /// Mutants of EDS and DCF files, specifications, settings and templates, from the same seed in every run.
    Mutants,
    /// The foreign readers notice what is wrong.
    ReadersSelfTest,
    /// A device with every feature and data type, which the shipped devices do not have.
    EveryFeature,
    /// A DCF with settings in every data type.
    Configured,
    Shipped,
    /// The README's drive, and what `odgen new` starts with.
    Drives,
    /// What is foretold of the foreign readers, compared with what they do.
    Foretold,
    /// What a tool of others makes of the shipped EDS for firmware in C.
    FirmwareInC,
    /// Concise DCF files beside those of a tool of others.
    ConciseDcf,
    /// XDD and XDC files, read by an XML parser of others and held to the structure of the format.
    XddStructure,
    /// Every DCF of a plant.
    Plant,
    /// DBC files, and frames of the generated Rust that are read by them.
    Dbc,
    /// Structured Text, parsed by a parser that others wrote, and evaluated.
    StructuredText,
    /// `odgen lsp`, asked by a client that others wrote.
    LanguageServer,
    /// A client that others wrote, against the generated Rust.
    SdoClient,
    Browser,
    /// The manuals, printed by WeasyPrint.
    Manuals,
    FirmwareSizes,
    FirmwareTests,
    /// A client that others wrote, against the demo firmware in an emulator.
    DemoFirmware,
    /// Dictionaries in plain C: every compiler and platform, and an emulator.
    PlainC,
}

/// What parts have in common; what a tool is needed for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Area {
    Rust,
    Readers,
    Browser,
    Firmware,
}

/// What a part runs beside.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Turn {
    /// From the start.
    First,
    /// At the same time, one after the other, as these parts share what they install.
    Beside,
    /// When all others have ended, one after the other: a client, a browser or an emulator is given a time to answer.
    Alone,
}

/// Whether a part can run.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Readiness {
    /// Everything is there.
    Whole,
    /// It can run, but for what these tools would do.
    Partly(Vec<Tool>),
    /// It cannot run without these tools.
    Lacks(Vec<Tool>),
}

impl Part {
    pub(crate) const ALL: [Part; 22] = [
        Part::Rust,
        Part::Mutants,
        Part::ReadersSelfTest,
        Part::EveryFeature,
        Part::Configured,
        Part::Shipped,
        Part::Drives,
        Part::Foretold,
        Part::FirmwareInC,
        Part::ConciseDcf,
        Part::XddStructure,
        Part::Plant,
        Part::Dbc,
        Part::StructuredText,
        Part::LanguageServer,
        Part::SdoClient,
        Part::Browser,
        Part::Manuals,
        Part::FirmwareSizes,
        Part::FirmwareTests,
        Part::DemoFirmware,
        Part::PlainC,
    ];

    pub(crate) const fn title(self) -> &'static str {
        match self {
            Part::Rust => "Rust tests",
            Part::Mutants => "mutants of files",
            Part::ReadersSelfTest => "EDS readers notice mistakes",
            Part::EveryFeature => "EDS readers: every feature",
            Part::Configured => "EDS readers: a DCF with settings",
            Part::Shipped => "EDS readers: shipped devices",
            Part::Drives => "EDS readers: drives of odgen new",
            Part::Foretold => "EDS readers: what is foretold",
            Part::FirmwareInC => "EDS readers: firmware in C",
            Part::ConciseDcf => "EDS readers: concise DCF",
            Part::XddStructure => "EDS readers: XDD and XDC",
            Part::Plant => "EDS readers: a plant",
            Part::Dbc => "DBC readers",
            Part::StructuredText => "Structured Text",
            Part::LanguageServer => "language server",
            Part::SdoClient => "SDO client",
            Part::Browser => "documents in a browser",
            Part::Manuals => "manuals on paper",
            Part::FirmwareSizes => "sizes of firmware",
            Part::FirmwareTests => "firmware in an emulator",
            Part::DemoFirmware => "demo firmware in an emulator",
            Part::PlainC => "dictionaries in plain C",
        }
    }

    pub(crate) const fn area(self) -> Area {
        match self {
            Part::Rust | Part::Mutants => Area::Rust,
            Part::ReadersSelfTest
            | Part::EveryFeature
            | Part::Configured
            | Part::Shipped
            | Part::Drives
            | Part::Foretold
            | Part::FirmwareInC
            | Part::ConciseDcf
            | Part::XddStructure
            | Part::Plant
            | Part::Dbc
            | Part::StructuredText
            | Part::LanguageServer
            | Part::SdoClient => Area::Readers,
            Part::Browser | Part::Manuals => Area::Browser,
            Part::FirmwareSizes | Part::FirmwareTests | Part::DemoFirmware | Part::PlainC => Area::Firmware,
        }
    }

    pub(crate) const fn turn(self) -> Turn {
        match self {
            Part::Rust => Turn::First,
            Part::Mutants
            | Part::ReadersSelfTest
            | Part::EveryFeature
            | Part::Configured
            | Part::Shipped
            | Part::Drives
            | Part::Foretold
            | Part::FirmwareInC
            | Part::ConciseDcf
            | Part::XddStructure
            | Part::Plant
            | Part::Dbc
            | Part::StructuredText
            | Part::LanguageServer
            | Part::Manuals
            | Part::FirmwareSizes
            | Part::PlainC => Turn::Beside,
            Part::SdoClient | Part::Browser | Part::FirmwareTests | Part::DemoFirmware => Turn::Alone,
        }
    }

    /// Tools without which it cannot run.
    const fn needs(self) -> &'static [Tool] {
        match self {
            Part::Rust | Part::Mutants => &[],
            Part::ReadersSelfTest
            | Part::EveryFeature
            | Part::Configured
            | Part::Shipped
            | Part::Drives
            | Part::Foretold
            | Part::FirmwareInC
            | Part::ConciseDcf
            | Part::XddStructure
            | Part::Plant
            | Part::Dbc
            | Part::StructuredText
            | Part::LanguageServer
            | Part::SdoClient => &[Tool::Python],
            Part::Browser => &[Tool::Python, Tool::Node, Tool::Chromium, Tool::Pdftotext],
            Part::Manuals => &[Tool::Python, Tool::Pdftotext, Tool::Pango],
            Part::FirmwareSizes => &[Tool::Python, Tool::ThumbTarget, Tool::ThumbLinker],
            Part::FirmwareTests | Part::DemoFirmware => {
                &[Tool::Python, Tool::ThumbTarget, Tool::ThumbLinker, Tool::Qemu]
            }
            Part::PlainC => &[Tool::ThumbLinker, Tool::Qemu, Tool::Clang],
        }
    }

    /// Tools without which it leaves something out: node-canopen, of the five readers and of two masters.
    const fn uses(self) -> &'static [Tool] {
        match self {
            Part::ReadersSelfTest
            | Part::EveryFeature
            | Part::Configured
            | Part::Shipped
            | Part::Drives
            | Part::Foretold
            | Part::SdoClient => &[Tool::Node],
            Part::Rust
            | Part::Mutants
            | Part::FirmwareInC
            | Part::ConciseDcf
            | Part::XddStructure
            | Part::Plant
            | Part::Dbc
            | Part::StructuredText
            | Part::LanguageServer
            | Part::Browser
            | Part::Manuals
            | Part::FirmwareSizes
            | Part::FirmwareTests
            | Part::DemoFirmware
            | Part::PlainC => &[],
        }
    }

    /// Whether it can run with these tools.
    pub(crate) fn readiness(self, found: &BTreeSet<Tool>) -> Readiness {
        let missing =
            |tools: &[Tool]| tools.iter().copied().filter(|tool| !found.contains(tool)).collect::<Vec<_>>();
        let (lacks, does_without) = (missing(self.needs()), missing(self.uses()));
        if !lacks.is_empty() {
            Readiness::Lacks(lacks)
        } else if !does_without.is_empty() {
            Readiness::Partly(does_without)
        } else {
            Readiness::Whole
        }
    }

    /// Runs it. What it leaves out, because a registry cannot be reached, stands in the runner.
    pub(crate) fn run(self, runner: &mut Runner) -> Result<(), Failure> {
        match self {
            Part::Rust => {
                runner.cargo(&["test", "--workspace", "--no-fail-fast"])?;
                // What no other package asks for.
                runner.cargo(&["test", "--package", "firmware-glue", "--all-features", "--no-fail-fast"])
            }
            // On a machine that is busy with other parts.
            Part::Mutants => runner.fuzz(&["--seconds", "90", "--seed", "1"]),
            Part::ReadersSelfTest => runner.python("tests/readers/selftest/selftest.py", &[]),
            Part::EveryFeature => readers::every_feature(runner),
            Part::Configured => readers::configured(runner),
            Part::Shipped => runner.python("tests/readers/run.py", &[]),
            Part::Drives => readers::drives(runner),
            Part::Foretold => readers::foretold(runner),
            Part::FirmwareInC => readers::firmware_in_c(runner),
            Part::ConciseDcf => readers::concise_dcf(runner),
            Part::XddStructure => readers::xdd_structure(runner),
            Part::Plant => readers::plant(runner),
            Part::Dbc => readers::dbc(runner),
            Part::StructuredText => readers::structured_text(runner),
            Part::LanguageServer => readers::language_server(runner),
            Part::SdoClient => readers::sdo_client(runner),
            Part::Browser => browser::read_documents(runner),
            Part::Manuals => manuals::print(runner),
            Part::FirmwareSizes => runner.python("tests/thumb/run.py", &["sizes"]),
            Part::FirmwareTests => runner.python("tests/thumb/run.py", &["test"]),
            Part::DemoFirmware => readers::demo_firmware(runner),
            Part::PlainC => plain_c::try_all(runner),
        }
    }
}

impl Area {
    pub(crate) const fn title(self) -> &'static str {
        match self {
            Area::Rust => "the Rust tests",
            Area::Readers => "the foreign readers of EDS files",
            Area::Browser => "the documents in a browser",
            Area::Firmware => "the firmware for a Cortex-M",
        }
    }
}

/// What a tool is needed for.
pub(crate) fn needed_for(tool: Tool, parts: &[Part]) -> BTreeSet<Area> {
    let needing = parts.iter().filter(|part| part.needs().contains(&tool) || part.uses().contains(&tool));
    needing.map(|part| part.area()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn readiness(part: Part, missing: &[Tool]) -> Readiness {
        let found = Tool::ALL.into_iter().filter(|tool| !missing.contains(tool)).collect();
        part.readiness(&found)
    }

    #[test]
    fn all_parts_are_listed_in_the_order_in_which_they_are_declared() {
        assert!(Part::ALL.is_sorted() && Part::ALL.last() == Some(&Part::PlainC));
        assert!(Tool::ALL.is_sorted() && Tool::ALL.last() == Some(&Tool::Clang));
    }

    #[test]
    fn with_everything_every_part_runs_and_with_nothing_the_rust_tests() {
        for part in Part::ALL {
            assert_eq!(readiness(part, &[]), Readiness::Whole);
            let alone = readiness(part, &Tool::ALL);
            assert_eq!(alone == Readiness::Whole, part.area() == Area::Rust, "{part:?}: {alone:?}");
            assert!(!matches!(alone, Readiness::Partly(_)), "{part:?}");
        }
    }

    #[test]
    fn each_tool_is_missed_by_what_needs_it() {
        assert_eq!(readiness(Part::Shipped, &[Tool::Node]), Readiness::Partly(vec![Tool::Node]));
        assert_eq!(readiness(Part::SdoClient, &[Tool::Node]), Readiness::Partly(vec![Tool::Node]));
        assert_eq!(readiness(Part::Plant, &[Tool::Node]), Readiness::Whole);
        assert_eq!(readiness(Part::Browser, &[Tool::Node]), Readiness::Lacks(vec![Tool::Node]));
        assert_eq!(readiness(Part::FirmwareSizes, &[Tool::Qemu]), Readiness::Whole);
        assert_eq!(readiness(Part::FirmwareTests, &[Tool::Qemu]), Readiness::Lacks(vec![Tool::Qemu]));
        for tool in Tool::ALL {
            assert!(Part::ALL.iter().any(|&part| readiness(part, &[tool]) != Readiness::Whole), "{tool:?}");
            assert!(!needed_for(tool, &Part::ALL).is_empty(), "{tool:?}");
        }
    }
}

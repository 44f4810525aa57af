//! Codes that only the command provokes, with the arguments that do; the tests of all codes read this table, too.

/// A command line that provokes a code, in a directory with a specification and a template.
pub(crate) struct Provocation {
    pub(crate) code: &'static str,
    pub(crate) arguments: &'static [&'static str],
}

/// What readers do not take in a file that nobody else minds.
const READERS: &[&str] = &["check", "readers.eds", "--notes", "--all"];

pub(crate) const PROVOKED: &[Provocation] = &[
    Provocation { code: "EDS801", arguments: READERS },
    Provocation { code: "EDS802", arguments: READERS },
    Provocation { code: "EDS803", arguments: READERS },
    Provocation { code: "EDS804", arguments: READERS },
    Provocation { code: "EDS805", arguments: READERS },
    Provocation { code: "EDS806", arguments: READERS },
    Provocation { code: "EDS807", arguments: READERS },
    Provocation { code: "EDS808", arguments: READERS },
    Provocation { code: "OD0101", arguments: &["check", "missing.od.yaml"] },
    Provocation { code: "OD0701", arguments: &["dcf", "lamp.od.yaml", "--device", "lamp", "--node", "0"] },
    Provocation {
        code: "OD0706",
        arguments: &["dcf", "lamp.od.yaml", "--device", "lamp", "--node", "5", "--bit-rate", "333"],
    },
    Provocation { code: "OD0709", arguments: &["build", "lamp.od.yaml", "--out", "lamp.od.yaml"] },
    Provocation { code: "OD0711", arguments: &["docs", "lamp.od.yaml", "--templates", "templates"] },
    Provocation { code: "OD0712", arguments: &["concise", "show", "cut.bin", "lamp.od.yaml"] },
    Provocation { code: "OD0713", arguments: &["concise", "show", "long.bin", "lamp.od.yaml"] },
    Provocation { code: "OD0811", arguments: &["check", "lamp.od.yaml", "--notes"] },
];

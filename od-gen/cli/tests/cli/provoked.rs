//! Codes that only the command provokes, with the arguments that do; the tests of all codes read this table, too.

/// A command line that provokes a code, in a directory with a specification and a template.
pub(crate) struct Provocation {
    pub(crate) code: &'static str,
    pub(crate) arguments: &'static [&'static str],
}

/// Represents the address of an adapter on a bus without nodes.
pub(crate) const ADAPTER: &str = "tcp:ADAPTER";

/// What readers do not take in a file that no other reader refuses.
const READERS: &[&str] = &["check", "readers.eds", "--notes", "--all"];

/// An XDD with a fault of each kind.
const FAULTY: &[&str] = &["check", "faulty.xdd", "--notes", "--all"];

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
    Provocation { code: "OD0122", arguments: &["import", "titles.csv"] },
    Provocation { code: "OD0868", arguments: &["import", "cells.csv"] },
    Provocation { code: "OD0701", arguments: &["dcf", "lamp.od.yaml", "--device", "lamp", "--node", "0"] },
    Provocation {
        code: "OD0706",
        arguments: &["dcf", "lamp.od.yaml", "--device", "lamp", "--node", "5", "--bit-rate", "333"],
    },
    Provocation { code: "OD0709", arguments: &["build", "lamp.od.yaml", "--out", "lamp.od.yaml"] },
    Provocation { code: "OD0711", arguments: &["docs", "lamp.od.yaml", "--templates", "templates"] },
    Provocation { code: "OD0712", arguments: &["concise", "show", "cut.bin", "lamp.od.yaml"] },
    Provocation { code: "OD0713", arguments: &["concise", "show", "long.bin", "lamp.od.yaml"] },
    Provocation {
        code: "OD0714",
        arguments: &["decode", "lamp.od.yaml", "--node", "5", "--trace", "bad.log"],
    },
    Provocation {
        code: "OD0715",
        arguments: &["serve", "lamp.od.yaml", "--node", "5", "--slcan", "tcp:192.0.2.1:4000"],
    },
    Provocation {
        code: "OD0716",
        arguments: &[
            "node",
            "read",
            "lamp.od.yaml",
            "--node",
            "5",
            "--timeout",
            "1",
            "--slcan",
            ADAPTER,
            "--any-device",
            "1017",
        ],
    },
    Provocation {
        code: "OD0717",
        arguments: &["node", "read", "lamp.od.yaml", "--node", "5", "--slcan", ADAPTER, "1017"],
    },
    Provocation { code: "OD0718", arguments: &["serve", "lamp.od.yaml", "--node", "5", "--watch"] },
    Provocation { code: "OD0811", arguments: &["check", "lamp.od.yaml", "--notes"] },
    Provocation { code: "OD0861", arguments: &["dcf", "fixed.dcf", "--node", "9"] },
    Provocation { code: "XDD101", arguments: &["check", "open.xdd"] },
    Provocation { code: "XDD102", arguments: &["check", "typed.xdd"] },
    Provocation { code: "XDD103", arguments: &["check", "other.xdd"] },
    Provocation { code: "XDD201", arguments: FAULTY },
    Provocation { code: "XDD202", arguments: FAULTY },
    Provocation { code: "XDD203", arguments: FAULTY },
    Provocation { code: "XDD204", arguments: FAULTY },
    Provocation { code: "XDD205", arguments: FAULTY },
    Provocation { code: "XDD206", arguments: FAULTY },
    Provocation { code: "XDD207", arguments: FAULTY },
    Provocation { code: "XDD208", arguments: FAULTY },
    Provocation { code: "XDD209", arguments: FAULTY },
    Provocation { code: "XDD210", arguments: FAULTY },
    Provocation { code: "XDD211", arguments: FAULTY },
];

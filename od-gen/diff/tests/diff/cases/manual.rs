//! The printed manual: title, issue, chapters, errata.

use crate::Case;

pub(crate) const CASES: &[Case] = &[
    Case {
        name: "the title",
        at: "title:",
        find: "Pitch Control System",
        replace: "Pitch system",
        expected: &["*: ~ system: name: Pitch Control System -> Pitch system [documents]"],
    },
    Case {
        name: "the languages",
        at: "languages:",
        find: "[en]",
        replace: "[en, fr]",
        expected: &["*: ~ system: languages: en -> en, fr [documents]"],
    },
    Case {
        name: "the issue of the manual",
        at: "revision:",
        find: "\"1.09\"",
        replace: "\"1.10\"",
        expected: &["*: ~ system, issue: document: 1.09 -> 1.10 [documents]"],
    },
    Case {
        name: "an abbreviation",
        at: "glossary:",
        find: "pulse width modulation, the way the motor is driven",
        replace: "pulse width modulation",
        expected: &[
            "*: ~ system, term PWM: document: pulse width modulation, the way the motor is driven -> pulse width modulation [documents]",
        ],
    },
    Case {
        name: "a section",
        at: "document:",
        find: "title: Introduction",
        replace: "title: Overview",
        expected: &["*: ~ system, section 1: document: Introduction -> Overview [documents]"],
    },
    Case {
        name: "an erratum",
        at: "errata:",
        find: "reads: vendor number 0",
        replace: "reads: the number 0",
        expected: &[
            "*: ~ system, erratum (gap) title pages: errata: vendor number 0; product code 0 and product revision 0 for b… -> the number 0; product code 0 and product revision 0 for both… [documents]",
        ],
    },
];

//! PDO mappings.

use firmware_glue::AbortCode;

use crate::agreement::case::Party::{Settings, Specification};
use crate::agreement::case::{Case, Said, Set, accepted, number, refused};
use crate::agreement::reason::Reason;

pub(crate) fn cases() -> Vec<Case> {
    [entries(), placeholders(), counts()].into_iter().flatten().collect()
}

const RECEIVE: u16 = 0x1600;
const TRANSMIT: u16 = 0x1A00;

/// A mapping of one entry.
fn single(mapping: u16, parameter: i128) -> [Set; 1] {
    [number(mapping, 1, parameter)]
}

/// A mapping of several entries; the subject is their number.
fn several(mapping: u16, parameters: &[i128]) -> Vec<Set> {
    let count = i128::try_from(parameters.len()).unwrap();
    let entries = (1..).zip(parameters).map(|(sub, parameter)| number(mapping, sub, *parameter));
    [number(mapping, 0, count)].into_iter().chain(entries).collect()
}

/// A mapping whose length contradicts the type has no words in the language.
fn unsaid(case: Case) -> Case {
    case.but(Specification, Said::NoWords, Reason::FollowsFromType)
}

/// `pdos:` names what it maps: a name or index that is not there is unknown before it is mapped.
fn unnamed(case: Case) -> Case {
    case.but(Specification, Said::Refused("OD0310".to_owned()), Reason::MapNamesEntries)
}

fn entries() -> Vec<Case> {
    use AbortCode as A;
    const NOT_MAPPABLE: &str = "OD0502";
    let wrong = |about, mapping, parameter| {
        refused(about, &single(mapping, parameter), NOT_MAPPABLE, A::NOT_MAPPABLE)
    };
    let unknown = |mapping, parameter| {
        unnamed(refused("no entry", &single(mapping, parameter), "OD0502", A::NO_OBJECT))
    };
    vec![
        accepted("an entry for RPDOs", &single(RECEIVE, 0x2020_0008)),
        accepted("an entry for both", &single(RECEIVE, 0x2025_0010)),
        accepted("an entry for both", &single(TRANSMIT, 0x2025_0010)),
        accepted("all 64 bits", &single(RECEIVE, 0x2026_0040)),
        unknown(RECEIVE, 0x7064_0008),
        unknown(RECEIVE, 0x2020_0108),
        unknown(TRANSMIT, 0x7064_0008),
        wrong("no entry for PDOs", RECEIVE, 0x2027_0008),
        wrong("no entry for PDOs", TRANSMIT, 0x2027_0008),
        wrong("an entry for TPDOs", RECEIVE, 0x2023_0008),
        wrong("an entry for RPDOs", TRANSMIT, 0x2020_0008),
        wrong("a communication parameter", RECEIVE, 0x1017_0010),
        unsaid(wrong("less than its length", RECEIVE, 0x2025_0008)),
        unsaid(wrong("more than its length", RECEIVE, 0x2025_0018)),
        unsaid(wrong("no length", RECEIVE, 0x2025_0000)),
        refused("less than the granularity", &single(RECEIVE, 0x2028_0001), "OD0508", A::NOT_MAPPABLE),
    ]
}

fn placeholders() -> Vec<Case> {
    use AbortCode as A;
    let unknown =
        |about, mapping, parameter| refused(about, &single(mapping, parameter), "OD0506", A::NO_OBJECT);
    vec![
        accepted("a placeholder", &single(RECEIVE, 0x0005_0008)),
        accepted("a placeholder", &single(RECEIVE, 0x0003_0010)),
        unknown("a placeholder that the device does not have", RECEIVE, 0x0006_0010),
        unknown("a placeholder of a type without placeholders", RECEIVE, 0x0008_0020),
        unknown("a placeholder in a TPDO", TRANSMIT, 0x0005_0008),
        unsaid(refused(
            "a placeholder of another length",
            &single(RECEIVE, 0x0005_0010),
            "OD0506",
            A::NOT_MAPPABLE,
        )),
        unsaid(refused(
            "a placeholder without a length",
            &single(RECEIVE, 0x0005_0000),
            "OD0506",
            A::NOT_MAPPABLE,
        )),
        unnamed(refused(
            "no placeholder has a sub-index",
            &single(RECEIVE, 0x0005_0108),
            "OD0502",
            A::NO_OBJECT,
        )),
    ]
}

fn counts() -> Vec<Case> {
    use AbortCode as A;
    let frame = [0x2022_0020, 0x2025_0010, 0x2021_0010];
    let twice = || Said::Warned("OD0819".to_owned());
    vec![
        accepted("64 bits", &several(RECEIVE, &frame)),
        accepted("64 bits with a placeholder", &several(RECEIVE, &[0x2022_0020, 0x0003_0010, 0x2021_0010])),
        refused(
            "72 bits",
            &several(RECEIVE, &[0x2022_0020, 0x2025_0010, 0x2021_0010, 0x2020_0008]),
            "OD0507",
            A::PDO_LENGTH,
        ),
        refused(
            "72 bits with a placeholder",
            &several(RECEIVE, &[0x2026_0040, 0x0005_0008]),
            "OD0507",
            A::PDO_LENGTH,
        ),
        accepted("as many entries as the PDO offers", &several(RECEIVE, &[0x0005_0008; 8])),
        accepted("an entry twice", &several(RECEIVE, &[0x2020_0008; 2]))
            .but(Specification, twice(), Reason::TwiceIsHarmless)
            .but(Settings, twice(), Reason::TwiceIsHarmless),
        unsaid(refused(
            "more entries than the PDO offers",
            &[number(RECEIVE, 0, 9)],
            "OD0508",
            A::PDO_LENGTH,
        )),
        unsaid(refused("a multiplexed PDO", &[number(RECEIVE, 0, 255)], "OD0511", A::PDO_LENGTH)),
        unsaid(refused("an empty entry", &[number(RECEIVE, 0, 2)], "OD0508", A::NO_OBJECT)),
        accepted("nothing", &[number(RECEIVE, 0, 0)]).but(
            Specification,
            Said::Warned("OD0879".to_owned()),
            Reason::EmptyIsSwitchedOff,
        ),
        refused("a mapping that is fixed", &single(0x1602, 0x2025_0010), "OD0703", A::READ_ONLY).but(
            Specification,
            Said::Accepted,
            Reason::DefaultNeedsNoWrite,
        ),
    ]
}

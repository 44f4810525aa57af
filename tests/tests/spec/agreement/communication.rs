//! Communication objects: COB-IDs, transmission types, SYNC, heartbeats, signatures.

use firmware_glue::AbortCode;

use crate::agreement::case::Party::{Device, Settings, Specification};
use crate::agreement::case::{Case, Said, accepted, number, refused};
use crate::agreement::reason::Reason;

pub(crate) fn cases() -> Vec<Case> {
    [identifiers(), flags(), services(), transmission(), sync(), heartbeats(), commands()]
        .into_iter()
        .flatten()
        .collect()
}

const UNUSABLE: &str = "OD0503";
const NOT_VALID: i128 = 1 << 31;
const NO_REMOTE_FRAMES: i128 = 1 << 30;
const EXTENDED: i128 = 1 << 29;

/// A free identifier that is not the one of the pre-defined connection set, as the default of a PDO that exists.
fn of_its_own(case: Case) -> Case {
    case.but(Specification, Said::Warned("OD0823".to_owned()), Reason::DefaultIsPredefined)
}

/// CAN identifiers at the boundaries of what CiA 301 table 35 keeps for other services.
fn identifiers() -> Vec<Case> {
    let restricted =
        [0x000, 0x001, 0x07F, 0x101, 0x180, 0x581, 0x5FF, 0x601, 0x67F, 0x6E0, 0x701, 0x77F, 0x780, 0x7FF];
    let free = [0x580, 0x600, 0x680, 0x6DF, 0x6E1, 0x700];
    let mut cases = Vec::new();
    for (communication, about) in [(0x1400, "an RPDO's identifier"), (0x1800, "a TPDO's identifier")] {
        let cob_id = |id| [number(communication, 1, id)];
        cases.extend(restricted.map(|id| refused(about, &cob_id(id), UNUSABLE, AbortCode::INVALID_VALUE)));
        cases.extend(free.map(|id| of_its_own(accepted(about, &cob_id(id)))));
    }
    cases
}

fn flags() -> Vec<Case> {
    let receive = |id| [number(0x1400, 1, id)];
    let transmit = |id| [number(0x1800, 1, id)];
    let invalid = AbortCode::INVALID_VALUE;
    let clash = |about, set: &[_]| {
        refused(about, set, "OD0504", invalid).but(Device, Said::Accepted, Reason::PassedOnTheWay)
    };
    vec![
        refused("bit 30 of an RPDO", &receive(NO_REMOTE_FRAMES | 0x201), "OD0508", invalid),
        refused("bit 30 of an RPDO", &receive(NOT_VALID | NO_REMOTE_FRAMES | 0x201), "OD0508", invalid),
        of_its_own(accepted("bit 30 of a TPDO", &transmit(NO_REMOTE_FRAMES | 0x6E1))),
        refused("a 29-bit frame", &receive(EXTENDED | 0x300), UNUSABLE, invalid),
        refused("a 29-bit frame", &transmit(EXTENDED | 0x300), UNUSABLE, invalid),
        refused("a 29-bit frame, switched off", &receive(NOT_VALID | EXTENDED | 0x300), UNUSABLE, invalid),
        refused("12 bits", &receive(0x800), UNUSABLE, invalid),
        refused("12 bits, switched off", &receive(NOT_VALID | 0x800), UNUSABLE, invalid),
        accepted("switched off", &receive(NOT_VALID | 0x6E1)),
        accepted("switched off, without an identifier", &receive(NOT_VALID)),
        accepted("switched off, with a restricted identifier", &receive(NOT_VALID | 0x601)),
        clash("the identifier of SYNC", &receive(0x080)),
        clash("the identifier of TIME", &[number(0x1400, 1, 0x100), number(0x1012, 0, NOT_VALID | 0x100)]),
        of_its_own(accepted("the identifier of a TIME that the device does not use", &receive(0x100))),
        clash("the identifier of EMCY", &receive(0x085)),
        clash("the identifier of a TPDO", &receive(0x185)),
    ]
}

fn services() -> Vec<Case> {
    let invalid = AbortCode::INVALID_VALUE;
    let mut cases = Vec::new();
    for (index, sub, about) in [
        (0x1005, 0, "SYNC"),
        (0x1012, 0, "TIME"),
        (0x1014, 0, "EMCY"),
        (0x1028, 1, "EMCY consumer"),
        (0x1201, 1, "SDO server"),
        (0x1201, 2, "SDO server"),
    ] {
        let cob_id = |id| [number(index, sub, id)];
        let free = accepted(about, &cob_id(0x6E1));
        cases.push(match index {
            0x1014 => free.but(Specification, Said::Warned("OD0815".to_owned()), Reason::DefaultIsPredefined),
            _ => free,
        });
        for id in [0x000, 0x07F, 0x101, 0x180, 0x581, 0x601, 0x6E0, 0x701, 0x780, 0x800, EXTENDED | 0x300] {
            cases.push(refused(about, &cob_id(id), UNUSABLE, invalid));
        }
    }
    for (index, sub, about) in [(0x1014, 0, "EMCY"), (0x1028, 1, "EMCY consumer"), (0x1201, 1, "SDO server")]
    {
        let cob_id = |id| [number(index, sub, id)];
        cases.push(accepted(about, &cob_id(NOT_VALID)));
        cases.push(accepted(about, &cob_id(NOT_VALID | 0x6E1)));
        cases.push(refused(about, &cob_id(NOT_VALID | EXTENDED | 0x300), UNUSABLE, invalid));
    }
    let warned = |codes: &str| Said::Warned(codes.to_owned());
    for (index, sub, about, default) in [
        (0x1014, 0, "EMCY, reserved bit", "OD0810 OD0815"),
        (0x1028, 1, "EMCY consumer, reserved bit", "OD0810"),
    ] {
        let reason = Reason::ReservedBitIsHarmless;
        let case = accepted(about, &[number(index, sub, 1 << 30 | 0x6E1)]);
        cases.push(case.but(Specification, warned(default), reason).but(Settings, warned("OD0810"), reason));
    }
    for (sub, first_channel) in [(1, [0x601, 0x67F]), (2, [0x581, 0x5FF])] {
        let cob_id = |id| [number(0x1280, sub, id)];
        cases.extend(first_channel.map(|id| accepted("SDO client of a first channel", &cob_id(id))));
        cases.push(accepted("SDO client", &cob_id(0x6E1)));
        cases.push(accepted("no SDO client", &cob_id(NOT_VALID | first_channel[0])));
        for id in [0x000, 0x101, 0x6E0, 0x701, 0x800, EXTENDED | 0x601] {
            cases.push(refused("SDO client", &cob_id(id), UNUSABLE, invalid));
        }
    }
    for (sub, other_way) in [(1, 0x586), (2, 0x606)] {
        cases.push(refused(
            "SDO client, the other way round",
            &[number(0x1280, sub, other_way)],
            UNUSABLE,
            invalid,
        ));
    }
    let server = |node| [number(0x1280, 3, node)];
    cases.push(accepted("server of a client channel", &server(127)));
    cases.push(refused("server of a client channel", &server(128), "OD0510", invalid));
    cases.push(accepted("SYNC of a producer", &[number(0x1005, 0, 1 << 30 | 0x6E1)]));
    cases.push(accepted("SYNC, bit 31 of any value", &[number(0x1005, 0, NOT_VALID | 0x6E1)]));
    cases.push(accepted("TIME of a consumer", &[number(0x1012, 0, 1 << 31 | 0x6E1)]));
    cases.push(accepted("TIME of a producer", &[number(0x1012, 0, 1 << 30 | 0x6E1)]));
    cases
}

fn transmission() -> Vec<Case> {
    let reserved = |about, index, transmission| {
        refused(about, &[number(index, 2, transmission)], "OD0505", AbortCode::INVALID_VALUE)
    };
    let mut cases = Vec::new();
    for (index, about) in [(0x1400, "an RPDO's transmission"), (0x1800, "a TPDO's transmission")] {
        cases.extend([0, 1, 240, 254, 255].map(|kind| accepted(about, &[number(index, 2, kind)])));
        cases.extend([241, 251].map(|kind| reserved(about, index, kind)));
    }
    for kind in [252, 253] {
        cases.push(reserved("remote frames for an RPDO", 0x1400, kind));
        cases.push(accepted("remote frames for a TPDO", &[number(0x1800, 2, kind)]));
        let forbidden = [number(0x1800, 2, kind), number(0x1800, 1, NO_REMOTE_FRAMES | 0x185)];
        let case =
            refused("remote frames that are forbidden", &forbidden, "OD0516", AbortCode::INVALID_VALUE);
        cases.push(case.but(Device, Said::Accepted, Reason::NeverSentIsHarmless));
    }
    cases
}

fn sync() -> Vec<Case> {
    let start = |raw| [number(0x1801, 6, raw), number(0x1801, 2, 1), number(0x1019, 0, 240)];
    let warned = || Said::Warned("OD0836".to_owned());
    let unreached = |about, set: &[_]| {
        let reason = Reason::NothingReachesIt;
        accepted(about, set).but(Specification, warned(), reason).but(Settings, warned(), reason)
    };
    let counter = |raw| [number(0x1019, 0, raw)];
    let never = |raw| {
        refused("a count that SYNC never reaches", &start(raw), "OD0508", AbortCode::INVALID_VALUE).but(
            Specification,
            Said::Refused("OD0205 OD0508".to_owned()),
            Reason::KeyHasARange,
        )
    };
    vec![
        accepted("any SYNC", &start(0)),
        unreached("a SYNC without counter", &[number(0x1801, 6, 1), number(0x1801, 2, 1)]),
        unreached(
            "a SYNC beyond the counter",
            &[number(0x1801, 6, 3), number(0x1801, 2, 1), number(0x1019, 0, 2)],
        ),
        unreached("a SYNC for an event", &[number(0x1801, 6, 1), number(0x1019, 0, 2)]),
        accepted("the first SYNC", &start(1)),
        accepted("the last SYNC", &start(240)),
        never(241),
        never(255),
        accepted("an inhibit time", &[number(0x1801, 3, 0xFFFF)]),
        accepted("an event timer", &[number(0x1801, 5, 0xFFFF)]),
        accepted("no counter", &counter(0)),
        refused("a counter that never changes", &counter(1), "OD0510", AbortCode::INVALID_VALUE),
        accepted("the least counter", &counter(2)),
        accepted("the largest counter", &counter(240)),
        refused("a reserved counter", &counter(241), "OD0406", AbortCode::TOO_HIGH),
    ]
}

fn heartbeats() -> Vec<Case> {
    let watch = |raw| [number(0x1016, 1, raw)];
    let twice = |first, second| [number(0x1016, 2, second), number(0x1016, 1, first)];
    let invalid = AbortCode::INVALID_VALUE;
    let nobody = || Said::Warned("OD0828".to_owned());
    vec![
        accepted("the last node", &watch(0x007F_03E8)),
        accepted("no node", &watch(0x0000_03E8))
            .but(Specification, nobody(), Reason::WatchingNobodyIsHarmless)
            .but(Settings, nobody(), Reason::WatchingNobodyIsHarmless),
        refused("a node that cannot be", &watch(0x0080_03E8), "OD0510", invalid),
        refused("a reserved bit", &watch(0x0106_03E8), "OD0510", invalid),
        accepted("two nodes", &twice(0x0006_03E8, 0x0007_03E8)),
        accepted("one node, once without a time", &twice(0x0006_03E8, 0x0006_0000)),
        refused("one node twice", &twice(0x0006_03E8, 0x0006_07D0), "OD0510", AbortCode::INCOMPATIBLE),
        refused("a node that a default watches", &watch(0x0009_03E8), "OD0510", AbortCode::INCOMPATIBLE),
    ]
}

fn commands() -> Vec<Case> {
    vec![refused("an error that was not", &[number(0x1003, 0, 1)], "OD0510", AbortCode::INVALID_VALUE).but(
        Settings,
        Said::Refused("OD0510 OD0707".to_owned()),
        Reason::OnlyToolsMustNot,
    )]
}

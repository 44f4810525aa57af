//! Values of single entries: type, limits, enums, bits, texts, access, conditions, views.

use firmware_glue::AbortCode;

use crate::agreement::case::Party::{Settings, Specification};
use crate::agreement::case::{Case, Raw, Said, accepted, number, refused, set};
use crate::agreement::reason::Reason;

pub(crate) fn cases() -> Vec<Case> {
    [limits(), lists(), texts(), access(), others(), views()].into_iter().flatten().collect()
}

const BELOW: &str = "OD0406";
const ABOVE: &str = "OD0406";
const NO_VALUE_OF_TYPE: &str = "OD0404";

fn limits() -> Vec<Case> {
    use AbortCode as A;
    let is = |raw| [number(0x2000, 0, raw)];
    let small = |raw| [number(0x2001, 0, raw)];
    let odd = |raw| [number(0x200D, 0, raw)];
    let wide = |raw: u64| [number(0x200E, 0, raw.into())];
    vec![
        accepted("the low limit", &is(-100)),
        refused("below the low limit", &is(-101), BELOW, A::TOO_LOW),
        accepted("the high limit", &is(1000)),
        refused("above the high limit", &is(1001), ABOVE, A::TOO_HIGH),
        accepted("a special value above the limits", &is(32767)),
        refused("next to a special value", &is(32766), ABOVE, A::TOO_HIGH),
        accepted("a special value below the limits", &is(-32768)),
        refused("next to a special value", &is(-32767), BELOW, A::TOO_LOW),
        refused("more than INTEGER16", &is(32768), NO_VALUE_OF_TYPE, A::TOO_LONG),
        accepted("the low limit", &small(1)),
        refused("below the low limit", &small(0), BELOW, A::TOO_LOW),
        accepted("the high limit", &small(254)),
        refused("above the high limit", &small(255), ABOVE, A::TOO_HIGH),
        refused("more than UNSIGNED8", &small(256), NO_VALUE_OF_TYPE, A::TOO_LONG),
        accepted("the least INTEGER24", &odd(-0x80_0000)),
        accepted("the largest INTEGER24", &odd(0x7F_FFFF)),
        refused("more than INTEGER24", &odd(0x80_0000), NO_VALUE_OF_TYPE, A::TOO_LONG),
        accepted("a limit beyond 63 bits", &wide(u64::MAX - 1)),
        refused("above a limit beyond 63 bits", &wide(u64::MAX), ABOVE, A::TOO_HIGH),
        refused("below the low limit", &wide(0), BELOW, A::TOO_LOW),
    ]
}

fn lists() -> Vec<Case> {
    use AbortCode as A;
    let mode = |raw| [number(0x2002, 0, raw)];
    let flags = |raw| [number(0x2003, 0, raw)];
    let switch = |raw| [number(0x200B, 0, raw)];
    let reserved = |case: Case| {
        let warned = || Said::Warned("OD0810".to_owned());
        let reason = Reason::ReservedBitIsHarmless;
        case.but(Specification, warned(), reason).but(Settings, warned(), reason)
    };
    vec![
        accepted("the first value of an enum", &mode(-1)),
        accepted("the last value of an enum", &mode(3)),
        refused("a stranger to an enum", &mode(1), "OD0403", A::INVALID_VALUE),
        refused("a stranger below an enum", &mode(-2), "OD0403", A::INVALID_VALUE),
        refused("a stranger above an enum", &mode(4), "OD0403", A::INVALID_VALUE),
        refused("an unsupported value of an enum", &mode(5), "OD0403", A::INVALID_VALUE),
        accepted("a special value in addition to an enum", &mode(9)),
        refused("next to a special value of an enum", &mode(8), "OD0403", A::INVALID_VALUE),
        accepted("a bit with a name", &flags(1)),
        reserved(accepted("a reserved bit", &flags(2))),
        reserved(accepted("all bits", &flags(0xFFFF))),
        accepted("a BOOLEAN", &switch(1)),
        refused("more than a BOOLEAN", &switch(2), "OD0401", A::INVALID_VALUE),
    ]
}

fn texts() -> Vec<Case> {
    use AbortCode as A;
    let label = |text| [set(0x2008, 0, Raw::Text(text))];
    let key = |octets| [set(0x2009, 0, Raw::Octets(octets))];
    let title = |text| [set(0x200A, 0, Raw::Text(text))];
    let no_line = || Said::Refused("OD0319".to_owned());
    let line = Reason::EdsLineHoldsLess;
    vec![
        accepted("as long as the capacity", &label("12345")),
        refused("longer than the capacity", &label("123456"), NO_VALUE_OF_TYPE, A::TOO_LONG),
        accepted("no characters", &label("")).but(Settings, no_line(), line),
        accepted("a sign that EDS readers misread", &label("a;b")).but(Specification, no_line(), line).but(
            Settings,
            no_line(),
            line,
        ),
        refused("no character of VISIBLE_STRING", &label("µs"), "OD0401", A::INVALID_VALUE),
        accepted("as long as the capacity", &key(&[0, 1, 0xFF])),
        refused("longer than the capacity", &key(&[0, 1, 2, 3]), NO_VALUE_OF_TYPE, A::TOO_LONG),
        accepted("no octets", &key(&[])).but(Settings, no_line(), line),
        accepted("as long as the capacity", &title("abc")),
        refused("longer than the capacity", &title("abcd"), NO_VALUE_OF_TYPE, A::TOO_LONG),
        accepted("characters beyond ASCII", &title("aµ")).but(Specification, no_line(), line).but(
            Settings,
            no_line(),
            line,
        ),
    ]
}

fn access() -> Vec<Case> {
    use AbortCode as A;
    let one = |index| [number(index, 0, 7)];
    let stated = |case: Case| case.but(Specification, Said::Accepted, Reason::DefaultNeedsNoWrite);
    let refused_setting = |code: &str| Said::Refused(code.to_owned());
    vec![
        stated(refused("an entry that can only be read", &one(0x2005), "OD0703", A::READ_ONLY)),
        stated(refused("a constant", &one(0x2006), "OD0703", A::READ_ONLY)),
        stated(refused("a locked entry", &one(0x2004), "OD0704", A::DEVICE_STATE)),
        accepted("an entry that can only be written", &one(0x200C)),
        accepted("a trigger", &one(0x200F)).but(
            Settings,
            refused_setting("OD0707"),
            Reason::OnlyToolsMustNot,
        ),
        accepted("read-only in the EDS", &one(0x2010)).but(
            Settings,
            refused_setting("OD0703"),
            Reason::EdsShowsLess,
        ),
        stated(refused("while its condition does not hold", &one(0x2007), "OD0710", A::DEVICE_STATE)).but(
            Settings,
            Said::Warned("OD0710".to_owned()),
            Reason::OnlyWhileConditionHolds,
        ),
        accepted("while its condition holds", &[number(0x2007, 0, 9), number(0x2001, 0, 7)]),
    ]
}

fn others() -> Vec<Case> {
    use AbortCode as A;
    let no_notation = || Said::Refused("OD0401".to_owned());
    let low = |raw| [number(0x2014, 0, raw)];
    vec![
        accepted("a number", &[set(0x2011, 0, Raw::Real(0.5))]).but(
            Specification,
            Said::Warned("OD0807".to_owned()),
            Reason::RealsAreMisread,
        ),
        accepted("a time", &[set(0x2012, 0, Raw::Octets(&[1, 2, 3, 4, 5, 6]))])
            .but(Specification, no_notation(), Reason::NoNotation)
            .but(Settings, no_notation(), Reason::NoNotation),
        refused("a DOMAIN", &[set(0x2013, 0, Raw::Octets(&[1, 2, 3]))], "OD0401", A::UNSUPPORTED_ACCESS),
        accepted("thresholds in order", &low(39)),
        refused("thresholds out of order", &low(40), "OD0606", A::INCOMPATIBLE),
    ]
}

fn views() -> Vec<Case> {
    use AbortCode as A;
    let position = |raw| [number(0x5000, 0, raw)];
    let volts = |raw| [number(0x5001, 0, raw)];
    let battery = |raw| [number(0x5002, 0, raw)];
    let supply = |raw| [number(0x5004, 0, raw)];
    vec![
        accepted("the low limit of the target", &position(-1000)),
        refused("below the low limit of the target", &position(-1001), BELOW, A::TOO_LOW),
        refused("above the high limit of the target", &position(1001), ABOVE, A::TOO_HIGH),
        refused("more than the view's INTEGER16", &position(0x8000), NO_VALUE_OF_TYPE, A::TOO_LONG).but(
            Specification,
            Said::Refused(ABOVE.to_owned()),
            Reason::TargetIsWider,
        ),
        accepted("the high limit of the target, in another unit", &volts(9)),
        refused("above the high limit of the target, in another unit", &volts(10), ABOVE, A::TOO_HIGH),
        refused("far above the limit of the target", &volts(0xFFFF), ABOVE, A::TOO_HIGH),
        accepted("a whole step of the target", &battery(3000)),
        refused("between two steps of the target", &battery(1500), "OD0412", A::INVALID_VALUE).but(
            Specification,
            Said::NoWords,
            Reason::BetweenSteps,
        ),
        accepted("the most that the target's type holds", &supply(65)),
        refused("more than the target's type holds", &supply(66), NO_VALUE_OF_TYPE, A::INVALID_VALUE),
        refused("a view of a locked entry", &[number(0x5003, 0, 7)], "OD0704", A::DEVICE_STATE).but(
            Specification,
            Said::Accepted,
            Reason::DefaultNeedsNoWrite,
        ),
    ]
}

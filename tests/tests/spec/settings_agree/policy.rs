//! Where odgen and the device may differ, and why; with settings that need it.

use crate::settings_agree::chance::Setting;

/// A difference that is meant.
pub(crate) struct Difference {
    /// The code of what odgen says.
    pub(crate) code: &'static str,
    pub(crate) reason: &'static str,
    /// The device of [`DEVICES`](crate::settings_agree::devices::DEVICES) and the settings, about which odgen says this and nothing else.
    pub(crate) device: &'static str,
    pub(crate) settings: fn() -> Vec<Setting>,
}

/// What odgen refuses although the device would take it.
pub(crate) const REFUSED_BY_POLICY: &[Difference] = &[
    Difference {
        code: "OD0319",
        reason: "an EDS or DCF line cannot hold the text; the bus can",
        device: "bench",
        settings: || vec![Setting::text(0x2013, 0, "a;b")],
    },
    Difference {
        code: "OD0504",
        reason: "while PDOs are configured one after the other, two may pass through one identifier",
        device: "bench",
        settings: || vec![Setting::number(0x1400, 1, 0x185)],
    },
    Difference {
        code: "OD0516",
        reason: "a PDO that is never sent is no error of the device; its user wants it sent",
        device: "bench",
        settings: || vec![Setting::number(0x1800, 1, 0x4000_0185), Setting::number(0x1800, 2, 253)],
    },
    Difference {
        code: "OD0606",
        reason: "the constraint is between two devices, of which each knows itself alone",
        device: "pmc",
        settings: || vec![Setting::number(0x6510, 5, 397)],
    },
    Difference {
        code: "OD0703",
        reason: "the EDS shows less access than the device gives, and a DCF goes by the EDS",
        device: "bench",
        settings: || vec![Setting::number(0x2055, 0, 1)],
    },
    Difference {
        code: "OD0707",
        reason: "a tool must not write it at each boot; a person with a client may",
        device: "bench",
        settings: || vec![Setting::number(0x2054, 0, 1)],
    },
    Difference {
        code: "OD0708",
        reason: "one value is set through two views; which of them counts would follow from the order",
        device: "bench",
        settings: || vec![Setting::number(0x2004, 0, 1), Setting::number(0x5000, 0, 2)],
    },
];

/// What odgen warns of, because the device refuses it unless it is in another state.
pub(crate) const ACCEPTED_IN_SOME_STATE: &[Difference] = &[
    Difference {
        code: "OD0710",
        reason: "a DCF cannot know in which state the device will be when it is downloaded",
        device: "bench",
        settings: || vec![Setting::number(0x2030, 0, 5)],
    },
    Difference {
        code: "OD0838",
        reason: "each value is right with the others; what is missing is a way from the defaults to them",
        device: "bench",
        settings: || vec![Setting::number(0x2041, 0, 40), Setting::number(0x2042, 0, 60)],
    },
];

/// Settings that both refuse, by the code of the rule: the configurations by chance reach each of these rules.
pub(crate) const REFUSED_BY_BOTH: [&str; 12] = [
    "OD0403", "OD0404", "OD0406", "OD0502", "OD0503", "OD0505", "OD0506", "OD0507", "OD0508", "OD0510",
    "OD0511", "OD0606",
];

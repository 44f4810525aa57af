//! The state machine of CiA 402, typed by hand from its tables: states by mask and value, transitions by number, and what a
//! control word asks for, decided bit by bit. It shares nothing with the specifications.

/// States: name in lower case without signs, mask, value of the status word.
pub(crate) const STATES: [(&str, u16, u16); 8] = [
    ("not ready to switch on", 0x4F, 0x00),
    ("switch on disabled", 0x4F, 0x40),
    ("ready to switch on", 0x6F, 0x21),
    ("switched on", 0x6F, 0x23),
    ("operation enabled", 0x6F, 0x27),
    ("quick stop active", 0x6F, 0x07),
    ("fault reaction active", 0x4F, 0x0F),
    ("fault", 0x4F, 0x08),
];

pub(crate) const NOT_READY: usize = 0;
pub(crate) const DISABLED: usize = 1;
pub(crate) const READY: usize = 2;
pub(crate) const SWITCHED_ON: usize = 3;
pub(crate) const ENABLED: usize = 4;
pub(crate) const QUICK_STOP: usize = 5;
pub(crate) const REACTION: usize = 6;
pub(crate) const FAULT: usize = 7;

/// Transitions 1 to 16 but 13, which leaves every state: number, from, to.
pub(crate) const WAYS: [(u8, usize, usize); 15] = [
    (1, NOT_READY, DISABLED),
    (2, DISABLED, READY),
    (3, READY, SWITCHED_ON),
    (4, SWITCHED_ON, ENABLED),
    (5, ENABLED, SWITCHED_ON),
    (6, SWITCHED_ON, READY),
    (7, READY, DISABLED),
    (8, ENABLED, READY),
    (9, ENABLED, DISABLED),
    (10, SWITCHED_ON, DISABLED),
    (11, ENABLED, QUICK_STOP),
    (12, QUICK_STOP, DISABLED),
    (14, REACTION, FAULT),
    (15, FAULT, DISABLED),
    (16, QUICK_STOP, ENABLED),
];

/// The transition that a control word asks for in a state. No two at once.
pub(crate) fn asked(state: usize, before: u16, word: u16) -> Option<u8> {
    let bit = |at: u16| word >> at & 1 == 1;
    let (switch_on, voltage, no_quick_stop, enable) = (bit(0), bit(1), bit(2), bit(3));
    if bit(7) {
        return (state == FAULT && before >> 7 & 1 == 0).then_some(15);
    }
    let disable_voltage = !voltage;
    let quick_stop = voltage && !no_quick_stop;
    let shutdown = voltage && no_quick_stop && !switch_on;
    let on = voltage && no_quick_stop && switch_on;
    match state {
        DISABLED if shutdown => Some(2),
        READY if on => Some(3),
        READY if disable_voltage || quick_stop => Some(7),
        SWITCHED_ON if on && enable => Some(4),
        SWITCHED_ON if shutdown => Some(6),
        SWITCHED_ON if disable_voltage || quick_stop => Some(10),
        ENABLED if on && !enable => Some(5),
        ENABLED if shutdown => Some(8),
        ENABLED if disable_voltage => Some(9),
        ENABLED if quick_stop => Some(11),
        QUICK_STOP if disable_voltage => Some(12),
        QUICK_STOP if on && enable => Some(16),
        _ => None,
    }
}

/// The commands of the pitch controller as its manual prints them (Table 52), bits 8, 7, 4, 3, 2, 1, 0, and their transitions; `^` is an edge upwards.
pub(crate) const PITCH_COMMANDS: [(&str, &[u8]); 8] = [
    ("x00x110", &[2, 6, 8]),
    ("x000111", &[3]),
    ("1001111", &[3, 4]),
    ("x00xx0x", &[7, 9, 10, 12]),
    ("x001011", &[7, 10, 11]),
    ("1000111", &[5]),
    ("1001111", &[4, 16]),
    ("x^0xxxx", &[15]),
];

/// What a control word of the pitch controller asks for in a state, by its printed table.
pub(crate) fn asked_of_pitch(state: usize, before: u16, word: u16) -> Option<u8> {
    let mut found: Vec<u8> = PITCH_COMMANDS
        .iter()
        .filter(|(bits, _)| {
            bits.chars().zip([8, 7, 4, 3, 2, 1, 0]).all(|(bit, at)| match bit {
                '0' => word >> at & 1 == 0,
                '1' => word >> at & 1 == 1,
                '^' => word >> at & 1 == 1 && before >> at & 1 == 0,
                _ => true,
            })
        })
        .flat_map(|(_, transitions)| transitions.iter().copied())
        .filter(|number| WAYS.iter().any(|(way, from, _)| way == number && *from == state))
        .collect();
    found.dedup();
    assert!(found.len() < 2, "{state} {word:04X}: {found:?}");
    found.pop()
}

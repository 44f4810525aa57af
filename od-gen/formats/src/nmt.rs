//! Network management in words: the commands of the master and the states of nodes (CiA 301 7.3.2, 7.2.8.3.2).

/// Commands, by their specifier.
pub const COMMANDS: [(u8, &str); 5] = [
    (1, "start"),
    (2, "stop"),
    (128, "enter pre-operational"),
    (129, "reset node"),
    (130, "reset communication"),
];

/// States, as boot-up, heartbeat and node guarding report them in seven bits.
pub const STATES: [(u8, &str); 4] =
    [(0, "boot-up"), (4, "stopped"), (5, "operational"), (127, "pre-operational")];

/// The word for a number, if there is one.
pub fn word(words: &[(u8, &'static str)], number: u8) -> Option<&'static str> {
    words.iter().find(|(known, _)| *known == number).map(|(_, word)| *word)
}

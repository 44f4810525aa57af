// What the benches ask for, the same of every contender.

/// What the bench has to know of a model; `scaled.py` writes it down.
#[allow(dead_code, reason = "not every bench asks for everything")]
pub struct Model {
    pub name: &'static str,
    /// Indices of all setpoints, the only scalars of type u16.
    pub setpoints: &'static [u16],
    /// Indices of all records whose sub-index 1 is a u16, and of all arrays u16[8].
    pub records: &'static [u16],
    pub arrays: &'static [u16],
    /// Index of a position, which is read-only.
    pub position: u16,
    /// Indices of the setpoint and position that TPDO 1 maps, and of the speed that RPDO 1 maps with the setpoint.
    pub mapped: [u16; 3],
}

/// Keys of an iteration.
pub const KEYS: usize = 1024;

/// Indices of objects in a random order that is always the same.
pub fn keys(objects: &[u16]) -> Vec<u16> {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        usize::try_from(state >> 33).expect("31 bits are left") % objects.len()
    };
    (0..KEYS).map(|_| objects[next()]).collect()
}

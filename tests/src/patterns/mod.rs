//! Specifications with something in them so many times: what a compiler does with them may grow with their size, and not
//! faster.

mod right;
mod wrong;

pub use right::RIGHT;
pub use wrong::WRONG;

/// A specification that holds something `n` times.
#[derive(Debug, Clone, Copy)]
pub struct Pattern {
    /// What it holds.
    pub name: &'static str,
    /// Makes it.
    pub make: fn(usize) -> String,
}

const fn pattern(name: &'static str, make: fn(usize) -> String) -> Pattern {
    Pattern { name, make }
}

/// A specification of one device, `d`, with these sections and objects.
fn spec(sections: &str, objects: &str) -> String {
    device_with("", sections, objects)
}

/// [`spec`], with more keys of the device.
fn device_with(keys: &str, sections: &str, objects: &str) -> String {
    format!(
        "od-spec: 1\ntitle: t\nuses: [cia301]\nvendor: {{name: v, number: 1}}\ndevices:\n  d: {{name: d, bit-rates: [125], \
         features: [heartbeat producer]{keys}, eds: {{created: 2024-02-29 12:00}}}}\n{sections}objects:\n{objects}"
    )
}

/// A text for each of `0..n`.
fn each(n: usize, text: impl Fn(usize) -> String) -> String {
    (0..n).map(text).collect()
}

/// Texts for `0..n` with commas between them.
fn list(n: usize, text: impl Fn(usize) -> String) -> String {
    (0..n).map(text).collect::<Vec<_>>().join(", ")
}

/// The index of object `at`: those of the manufacturer, then those of the profiles.
const fn index(at: usize) -> usize {
    0x2000 + at
}

/// Objects that are right: one for each of `0..n`, with more keys.
fn objects(n: usize, keys: impl Fn(usize) -> String) -> String {
    each(n, |at| {
        format!("  0x{:04X}: {{name: object {at}, type: unsigned16, access: rw{}}}\n", index(at), keys(at))
    })
}

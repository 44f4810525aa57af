//! I/O modules with their channels.

use std::fmt::{self, Write as _};

use od_spec::diag::{Diagnostic, codes};

use super::args::NewArgs;
use super::template::{fill, items};

/// How many channels a module has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Channels {
    inputs: u16,
    outputs: u16,
    analogue_inputs: u16,
    analogue_outputs: u16,
}

/// A module without a stated number.
const EXAMPLE: Channels = Channels { inputs: 16, outputs: 8, analogue_inputs: 4, analogue_outputs: 2 };

/// Bits of the high word of 1000h.
const DIGITAL_INPUTS: u32 = 1 << 16;
const DIGITAL_OUTPUTS: u32 = 1 << 17;
const ANALOGUE_INPUTS: u32 = 1 << 18;
const ANALOGUE_OUTPUTS: u32 = 1 << 19;

/// Digital channels of an element, of 8 bits.
const DIGITAL_OF_ELEMENT: u16 = 8;
/// Elements that PDO 1 holds.
const DIGITAL_ELEMENTS_OF_PDO: u16 = 8;
/// Analogue channels of 16 bits that a PDO holds.
const ANALOGUE_OF_PDO: u16 = 4;
/// The last PDO that has a COB-ID without being given one.
const LAST_PDO: u16 = 4;

/// The first of the numbers that only I/O modules have.
pub(super) fn first_number(args: &NewArgs) -> Option<&'static str> {
    let numbers = [
        ("--inputs", args.inputs),
        ("--outputs", args.outputs),
        ("--analogue-inputs", args.analogue_inputs),
        ("--analogue-outputs", args.analogue_outputs),
    ];
    numbers.into_iter().find(|(_, number)| number.is_some()).map(|(name, _)| name)
}

impl Channels {
    /// What was asked for; an example, if nothing was.
    pub(super) fn of(args: &NewArgs) -> Result<Self, Diagnostic> {
        if first_number(args).is_none() {
            return Ok(EXAMPLE);
        }
        let channels = Self {
            inputs: args.inputs.unwrap_or(0),
            outputs: args.outputs.unwrap_or(0),
            analogue_inputs: args.analogue_inputs.unwrap_or(0),
            analogue_outputs: args.analogue_outputs.unwrap_or(0),
        };
        if channels.stated().next().is_none() {
            let message = "an I/O module without channels";
            return Err(Diagnostic::without_place(codes::UNKNOWN_WORD, message)
                .help("say how many it has, such as `--inputs 16 --analogue-inputs 4`"));
        }
        Ok(channels)
    }

    /// What there is, in the order of the indices: how many, in words, the feature, its bit of 1000h.
    fn stated(self) -> impl Iterator<Item = (u16, &'static str, &'static str, u32)> {
        let all = [
            (self.inputs, "digital inputs", "digital inputs 8-bit", DIGITAL_INPUTS),
            (self.outputs, "digital outputs", "digital outputs 8-bit", DIGITAL_OUTPUTS),
            (self.analogue_inputs, "analogue inputs", "analogue inputs 16-bit", ANALOGUE_INPUTS),
            (self.analogue_outputs, "analogue outputs", "analogue outputs 16-bit", ANALOGUE_OUTPUTS),
        ];
        all.into_iter().filter(|(number, ..)| *number > 0)
    }

    /// A starter for a module with these channels.
    ///
    /// # Errors
    /// A template that is wrong.
    pub(super) fn specification(self, key: &str) -> Result<String, Diagnostic> {
        let device_type = self.stated().fold(0x0191, |bits, (.., bit)| bits | bit);
        let features = self.stated().map(|(number, _, feature, _)| format!("{feature}: {number}"));
        let features: Vec<String> = features.collect();
        let beside: Vec<&str> = self
            .beside()
            .into_iter()
            .filter(|(number, _)| *number > 0)
            .flat_map(|(_, features)| features.iter().copied())
            .collect();
        let pdos = [
            pdos("receive", 0x6200, self.outputs, 0x6411, self.analogue_outputs),
            pdos("transmit", 0x6000, self.inputs, 0x6401, self.analogue_inputs),
        ];
        fill(
            include_str!("io.od.yaml"),
            key,
            &[
                ("type", &format!("0x{:04X}_{:04X}", device_type >> 16, device_type & 0xFFFF)),
                ("channels", &items(features.iter().map(String::as_str))),
                ("also", &items(beside.into_iter())),
                ("pdos", pdos.concat().trim_end()),
            ],
        )
    }

    /// Features that modules often have in addition to their channels.
    fn beside(self) -> [(u16, &'static [&'static str]); 4] {
        [
            (self.inputs, &["digital input polarity 8-bit"]),
            (self.outputs, &["digital output polarity 8-bit", "digital output error value 8-bit"]),
            (self.analogue_inputs, &["analogue input interrupts"]),
            (self.analogue_outputs, &["analogue output error value"]),
        ]
    }
}

impl fmt::Display for Channels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words: Vec<String> =
            self.stated().map(|(number, words, ..)| format!("{number} {words}")).collect();
        f.write_str(&words.join(", "))
    }
}

/// The default PDOs of one direction as the profile has them: PDO 1 the digital channels, PDOs 2 to 4 the analogue ones.
fn pdos(direction: &str, digital: u16, channels: u16, analogue: u16, analogue_channels: u16) -> String {
    let elements = channels.div_ceil(DIGITAL_OF_ELEMENT);
    let mapped = |index: u16, first: u16, last: u16| {
        let entries = (first..=last).map(|sub| format!("0x{index:04X}.{sub}"));
        format!("[{}]", entries.collect::<Vec<_>>().join(", "))
    };
    let mut lines = String::new();
    if elements > 0 {
        let map = mapped(digital, 1, elements.min(DIGITAL_ELEMENTS_OF_PDO));
        let _ = writeln!(lines, "      1: {{map: {map}}}");
    }
    for (pdo, first) in (2..=LAST_PDO).zip((1..=analogue_channels).step_by(ANALOGUE_OF_PDO.into())) {
        let map = mapped(analogue, first, analogue_channels.min(first + ANALOGUE_OF_PDO - 1));
        let _ = writeln!(lines, "      {pdo}: {{map: {map}}}");
    }
    if elements > DIGITAL_ELEMENTS_OF_PDO || analogue_channels > ANALOGUE_OF_PDO * (LAST_PDO - 1) {
        lines.push_str("      # the profile maps no more; give further PDOs their `cob-id:`\n");
    }
    if lines.is_empty() { lines } else { format!("    {direction}:\n{lines}") }
}

#[cfg(test)]
mod tests {
    use super::super::tests::compiled;
    use super::*;
    use od_spec::model::{Direction, Index, Mapped, System};

    fn elements(system: &System, index: u16) -> usize {
        system.devices[0].objects.get(&Index(index)).map_or(0, |object| object.entries.len() - 1)
    }

    #[test]
    fn modules_of_every_kind_and_size_compile_clean() {
        for inputs in [0, 1, 8, 9, 2032] {
            for analogue_inputs in [0, 4, 5, 12, 254] {
                for (outputs, analogue_outputs) in [(0, 0), (16, 0), (0, 2), (65, 13)] {
                    let channels = Channels { inputs, outputs, analogue_inputs, analogue_outputs };
                    if channels.stated().next().is_some() {
                        let system = compiled("io", &channels.specification("io").unwrap());
                        assert_eq!(elements(&system, 0x6000), usize::from(inputs).div_ceil(8));
                        assert_eq!(elements(&system, 0x6002), elements(&system, 0x6000));
                        assert_eq!(elements(&system, 0x6200), usize::from(outputs).div_ceil(8));
                        assert_eq!(elements(&system, 0x6401), usize::from(analogue_inputs));
                        assert_eq!(elements(&system, 0x6426), usize::from(analogue_inputs));
                        assert_eq!(elements(&system, 0x6411), usize::from(analogue_outputs));
                    }
                }
            }
        }
    }

    /// Of 20 inputs, 8 outputs and 5 analogue inputs.
    #[test]
    fn pdos_are_those_of_the_profile() {
        let channels = Channels { inputs: 20, outputs: 8, analogue_inputs: 5, analogue_outputs: 0 };
        let system = compiled("io", &channels.specification("io").unwrap());
        let of = |direction| -> Vec<(u16, Vec<u32>)> {
            let pdos = system.devices[0].pdos_of(direction);
            pdos.map(|pdo| (pdo.number, pdo.map.iter().map(Mapped::parameter).collect())).collect()
        };
        assert_eq!(of(Direction::Receive), [(1, vec![0x6200_0108])]);
        assert_eq!(
            of(Direction::Transmit),
            [
                (1, vec![0x6000_0108, 0x6000_0208, 0x6000_0308]),
                (2, vec![0x6401_0110, 0x6401_0210, 0x6401_0310, 0x6401_0410]),
                (3, vec![0x6401_0510]),
            ]
        );
        assert!(channels.specification("io").unwrap().contains("device-type: 0x0007_0191"));
    }
}

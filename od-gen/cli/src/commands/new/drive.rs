//! Drives with their modes of operation.

use std::fmt::Write as _;

use od_spec::diag::{Diagnostic, codes};

use super::template::{fill, items};

/// What a mode of operation means for a starter specification.
pub(super) struct Mode {
    /// As drive makers abbreviate it.
    short: &'static str,
    /// Feature of the library `cia402`.
    feature: &'static str,
    /// Bit of 6502h.
    bit: u8,
    /// Set-point for an RPDO.
    set_point: Option<&'static str>,
    /// Actual value for a TPDO.
    actual: Option<&'static str>,
    /// A line that an object of the mode may have, as an example.
    example: &'static str,
    /// Features that drives with this mode often have in addition to it.
    beside: &'static [&'static str],
}

impl Mode {
    /// Its number in 6060h, one more than its bit of 6502h.
    const fn number(&self) -> u8 {
        self.bit + 1
    }
}

const MODES: [Mode; 9] = [
    Mode {
        short: "pp",
        feature: "profile position mode",
        bit: 0,
        set_point: Some("Target position"),
        actual: Some("Position actual value"),
        example: "0x607A: {from: cia402, unit: centidegree}",
        beside: &["quick stop", "position window", "following error", "software position limit"],
    },
    Mode {
        short: "vl",
        feature: "velocity mode",
        bit: 1,
        set_point: Some("vl target velocity"),
        actual: Some("vl velocity actual value"),
        example: "0x6042: {from: cia402, min: -3000, max: 3000}",
        beside: &["vl factors"],
    },
    Mode {
        short: "pv",
        feature: "profile velocity mode",
        bit: 2,
        set_point: Some("Target velocity"),
        actual: Some("Velocity actual value"),
        example: "0x60FF: {from: cia402, min: -3000, max: 3000}",
        beside: &["quick stop", "velocity window", "velocity threshold"],
    },
    Mode {
        short: "tq",
        feature: "torque profile mode",
        bit: 3,
        set_point: Some("Target torque"),
        actual: Some("Torque actual value"),
        example: "0x6071: {from: cia402, min: -150.0 %, max: 150.0 %}",
        beside: &["torque limit", "motor ratings"],
    },
    Mode {
        short: "hm",
        feature: "homing mode",
        bit: 5,
        set_point: None,
        actual: None,
        example: "0x6098: {from: cia402, default: 35}",
        beside: &["home offset", "homing acceleration"],
    },
    Mode {
        short: "ip",
        feature: "interpolated position mode",
        bit: 6,
        set_point: Some("0x60C1.1"),
        actual: Some("Position actual value"),
        example: "0x6064: {from: cia402, unit: centidegree}",
        beside: &["interpolation time period"],
    },
    Mode {
        short: "csp",
        feature: "cyclic synchronous position mode",
        bit: 7,
        set_point: Some("Target position"),
        actual: Some("Position actual value"),
        example: "0x607A: {from: cia402, unit: centidegree}",
        beside: &["interpolation time period", "following error"],
    },
    Mode {
        short: "csv",
        feature: "cyclic synchronous velocity mode",
        bit: 8,
        set_point: Some("Target velocity"),
        actual: Some("Velocity actual value"),
        example: "0x60FF: {from: cia402, min: -3000, max: 3000}",
        beside: &["interpolation time period"],
    },
    Mode {
        short: "cst",
        feature: "cyclic synchronous torque mode",
        bit: 9,
        set_point: Some("Target torque"),
        actual: Some("Torque actual value"),
        example: "0x6071: {from: cia402, min: -150.0 %, max: 150.0 %}",
        beside: &["interpolation time period", "motor ratings"],
    },
];

/// PDOs of each direction that have a COB-ID of their own without being given one.
const PDOS: usize = 4;

/// The modes that were asked for, in the standard's order.
pub(super) fn modes(words: &[String]) -> Result<Vec<&'static Mode>, Diagnostic> {
    let known = || {
        let known = MODES.iter().map(|mode| format!("{} ({})", mode.short, mode.feature));
        format!("the modes are {}", known.collect::<Vec<_>>().join(", "))
    };
    if words.is_empty() {
        let message = "`--modes` is missing: a drive has at least one mode of operation";
        return Err(Diagnostic::without_place(codes::UNKNOWN_WORD, message).help(known()));
    }
    let mut wanted = Vec::new();
    for word in words {
        let word = word.trim();
        let is = |mode: &&Mode| {
            [mode.short, mode.feature, mode.feature.trim_end_matches(" mode")]
                .iter()
                .any(|name| name.eq_ignore_ascii_case(word))
        };
        let Some(mode) = MODES.iter().find(is) else {
            let message = format!("found `{word}`, expected a mode of operation");
            return Err(Diagnostic::without_place(codes::UNKNOWN_WORD, message).help(known()));
        };
        wanted.push(mode.bit);
    }
    Ok(MODES.iter().filter(|mode| wanted.contains(&mode.bit)).collect())
}

pub(super) fn list(modes: &[&Mode]) -> String {
    modes.iter().map(|mode| mode.feature).collect::<Vec<_>>().join(", ")
}

/// A starter for a drive with these modes.
///
/// # Errors
/// A template that is wrong.
pub(super) fn specification(key: &str, modes: &[&Mode]) -> Result<String, Diagnostic> {
    let features = modes.iter().map(|mode| mode.feature);
    let beside = without_repetition(modes.iter().flat_map(|mode| mode.beside.iter().copied()));
    let supported = modes.iter().fold(0_u32, |bits, mode| bits | 1 << mode.bit);
    let several = modes.len() > 1;
    let set_points = without_repetition(modes.iter().filter_map(|mode| mode.set_point));
    let actuals = without_repetition(modes.iter().filter_map(|mode| mode.actual));
    fill(
        include_str!("drive.od.yaml"),
        key,
        &[
            ("modes", &items(features)),
            ("also", &items(beside.into_iter())),
            ("kind", if modes.iter().all(|mode| mode.short == "vl") { "0x0001_0192" } else { "0x0002_0192" }),
            ("example", modes.first().map_or("", |mode| mode.example)),
            ("mode", &modes.first().map_or(0, |mode| mode.number()).to_string()),
            ("supported", &format!("0x{supported:04X}")),
            ("receive", &pdos(several.then_some("Modes of operation"), "Controlword", &set_points)),
            ("transmit", &pdos(several.then_some("Modes of operation display"), "Statusword", &actuals)),
        ],
    )
}

/// PDO 1 with the word and the mode, where there is a choice of modes; then one PDO with the word and each value.
fn pdos(mode: Option<&str>, word: &str, values: &[&str]) -> String {
    let mut mappings: Vec<String> = mode.iter().map(|mode| format!("[{word}, {mode}]")).collect();
    mappings.extend(values.iter().map(|value| format!("[{word}, {value}]")));
    if mappings.is_empty() {
        mappings.push(format!("[{word}]"));
    }
    let mut lines = String::new();
    for (at, mapping) in mappings.iter().enumerate() {
        if at == PDOS {
            lines.push_str("      # CiA 301 has COB-IDs for four; give each further one its `cob-id:` instead of `valid: no`\n");
        }
        let valid = if at < PDOS { "" } else { ", valid: no" };
        let _ = writeln!(lines, "      {}: {{map: {mapping}{valid}}}", at + 1);
    }
    lines.trim_end().to_owned()
}

fn without_repetition<'a>(names: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut distinct = Vec::new();
    for name in names {
        if !distinct.contains(&name) {
            distinct.push(name);
        }
    }
    distinct
}

#[cfg(test)]
mod tests {
    use super::super::tests::compiled;
    use super::*;
    use od_spec::model::Category;

    #[test]
    fn every_mode_and_every_pair_of_modes_compiles_clean() {
        for first in &MODES {
            for second in &MODES {
                let modes = modes(&[first.short.to_owned(), second.feature.to_owned()]).expect("modes");
                let system = compiled("drive", &specification("drive", &modes).unwrap());
                let supported =
                    system.devices[0].objects[&od_spec::model::Index(0x6502)].entries[0].default.clone();
                let bits = 1_i128 << first.bit | 1 << second.bit;
                assert_eq!(supported, Some(od_spec::model::Value::Integer(bits)));
            }
        }
    }

    #[test]
    fn all_modes_together_compile_clean() {
        let all: Vec<&Mode> = MODES.iter().collect();
        let system = compiled("drive", &specification("drive", &all).unwrap());
        let mandatory =
            system.devices[0].objects.values().filter(|object| object.category == Some(Category::Mandatory));
        assert!(mandatory.count() > 5);
    }

    /// The commented examples can be used as they are.
    #[test]
    fn examples_in_comments_compile() {
        for mode in &MODES {
            let text = specification("drive", &[mode])
                .unwrap()
                .replace("  #   0x", "  0x")
                .replace("  # centidegree:", "  centidegree:");
            let text = if text.contains("unit: centidegree}\n") {
                text
            } else {
                text.replace("  centidegree:", "  # ")
            };
            assert!(text.contains(&format!("\n  {}\n", mode.example)), "{text}");
            compiled("drive", &text);
        }
    }

    /// What the table here says of a mode is what the library says.
    #[test]
    fn modes_are_the_bits_of_6502h() {
        let system = compiled("drive", &specification("drive", &[&MODES[0]]).unwrap());
        let entry = &system.devices[0].objects[&od_spec::model::Index(0x6502)].entries[0];
        let Some(od_spec::model::TypeKind::Bits(fields)) = entry.named_type.as_ref().map(|named| &named.kind)
        else {
            panic!("a bit field");
        };
        for mode in &MODES {
            assert!(
                fields.iter().any(|field| field.first == mode.bit && field.name == mode.feature),
                "{}",
                mode.feature
            );
        }
    }
}

//! A symbol of a unit means what it says: its prefix is that of the SI, and it has one base.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::diag::{Code, Diagnostic, Example, Severity, shorten};
use crate::model::{Author, Ratio, System, Unit};
use crate::order::Arrange as _;
use crate::scalar;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::System(check) };

const CODE: &Code = &Code {
    id: "OD0883",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a unit that contradicts its symbol",
    explanation: "`base:` says what one symbol is worth, and the symbol says it, too: kV are 1000 V, µs are 1/1000000 \
        s, and 1 V is 1 V. Where two units have one symbol, they have one base, or none; otherwise a value such as `5 \
        rpm` would depend on the entry that it is written for. A number is not a symbol. Every conversion and every \
        constraint would be wrong by the difference. Correct `base:`, or the symbol.",
    clause: None,
    example: Some(Example::new(
        "units: {kilovolt: {symbol: kV, base: 1/1000 V}}\nobjects:\n  0x2000: {name: level, type: unsigned16, access: rw, unit: kilovolt, default: 0}",
        "units: {kilovolt: {symbol: kV, base: 1000 V}}\nobjects:\n  0x2000: {name: level, type: unsigned16, access: rw, unit: kilovolt, default: 0}",
    )),
};

/// Prefixes of the SI, with their powers of ten; `u` replaces µ, which has two characters.
const PREFIXES: [(&str, i32); 22] = [
    ("Y", 24),
    ("Z", 21),
    ("E", 18),
    ("P", 15),
    ("T", 12),
    ("G", 9),
    ("M", 6),
    ("k", 3),
    ("h", 2),
    ("da", 1),
    ("d", -1),
    ("c", -2),
    ("m", -3),
    ("µ", -6),
    ("μ", -6),
    ("u", -6),
    ("n", -9),
    ("p", -12),
    ("f", -15),
    ("a", -18),
    ("z", -21),
    ("y", -24),
];

fn check(system: &System, findings: &mut Findings) {
    let own = system.units.values().filter(|unit| unit.stated.author != Author::Library);
    let mut own: Vec<&Unit> = own.map(AsRef::as_ref).collect();
    own.arrange_by_key(|unit| (unit.stated.span.file, unit.stated.span.start));
    for (at, unit) in own.iter().enumerate() {
        // `1` is the unit of what has none.
        if unit.symbol != "1" && scalar::decimal(&unit.symbol).is_some() {
            let message = format!("`{}` is a number, not a symbol", shorten(&unit.symbol));
            findings.push(
                Diagnostic::new(CODE, unit.stated.span, message)
                    .help("write the symbol of the unit; a factor is its `scale:`"),
            );
            continue;
        }
        if let Some(finding) = of_prefix(unit) {
            findings.push(finding);
            continue;
        }
        let is_other = |other: &&&Unit| {
            other.symbol == unit.symbol && other.base != unit.base && of_prefix(other).is_none()
        };
        if let Some(other) = own.get(..at).and_then(|before| before.iter().find(is_other)) {
            let message = format!(
                "`{}` has another base here than in `{}`",
                shorten(&unit.symbol),
                shorten(&other.name)
            );
            findings.push(
                Diagnostic::new(CODE, unit.stated.span, message)
                    .with(other.stated.span, "the other unit")
                    .help("give both units one base, or two symbols"),
            );
        }
    }
}

/// A unit whose base is not what the prefixes of the two symbols say.
fn of_prefix(unit: &Unit) -> Option<Diagnostic> {
    let base = unit.base.as_ref()?;
    let expected: Vec<Ratio> = powers(&unit.symbol, &base.symbol).filter_map(power_of_ten).collect();
    let first = expected.first().filter(|_| !expected.contains(&base.factor))?;
    let (symbol, base_symbol) = (shorten(&unit.symbol), shorten(&base.symbol));
    let message = format!("1 {symbol} is {first} {base_symbol}, not {}", base.factor);
    Some(Diagnostic::new(CODE, unit.stated.span, message).help(format!(
        "write `base: {} {}`, or correct the symbol",
        fraction(*first),
        base.symbol
    )))
}

/// The powers of ten between two symbols that are one and the same after their prefixes.
fn powers<'s>(symbol: &'s str, base: &'s str) -> impl Iterator<Item = i32> + 's {
    let of_base: Vec<(&str, i32)> = roots(base).collect();
    roots(symbol).flat_map(move |(root, power)| {
        let same = of_base.iter().filter(move |(other, _)| *other == root);
        same.map(move |(_, of_base)| (power - of_base) * exponent(root)).collect::<Vec<_>>()
    })
}

/// What a symbol may be after a prefix, or without one. Bits and bytes are counted in powers of two, too.
fn roots(symbol: &str) -> impl Iterator<Item = (&str, i32)> {
    let prefixed =
        PREFIXES.iter().filter_map(move |(prefix, power)| Some((symbol.strip_prefix(prefix)?, *power)));
    let is_unit = |root: &&str| {
        !root.is_empty() && !matches!(*root, "B" | "b" | "bit" | "bits" | "byte" | "Byte" | "bytes")
    };
    [(symbol, 0)].into_iter().chain(prefixed).filter(move |(root, _)| is_unit(root))
}

/// The exponent of the first unit of a symbol, to which its prefix belongs: 2 in `m²/s`.
fn exponent(root: &str) -> i32 {
    let first = root.split(['/', '·', '*', ' ']).next().unwrap_or(root);
    match first.chars().next_back() {
        Some('²' | '2') => 2,
        Some('³' | '3') => 3,
        Some(_) | None => 1,
    }
}

/// A power of ten as a specification writes it: `1000`, `1/1000`.
fn fraction(power: Ratio) -> String {
    match power.to_whole() {
        Some(whole) => whole.to_string(),
        None => format!("{}/{}", power.numerator(), power.denominator()),
    }
}

fn power_of_ten(power: i32) -> Option<Ratio> {
    let number = 10_i128.checked_pow(power.unsigned_abs())?;
    if power < 0 { Ratio::new(1, number) } else { Ratio::new(number, 1) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn expected(symbol: &str, base: &str) -> Vec<i32> {
        powers(symbol, base).collect()
    }

    #[test]
    fn prefixes_belong_to_the_first_unit_of_a_symbol() {
        assert_eq!(expected("kV", "V"), [3]);
        assert_eq!(expected("V", "mV"), [3]);
        assert_eq!(expected("kV", "mV"), [6]);
        assert_eq!(expected("mm/s", "m/s"), [-3]);
        assert_eq!(expected("mm²", "m²"), [-6]);
        assert_eq!(expected("cm3", "dm3"), [-3]);
        assert_eq!(expected("V", "V"), [0]);
        assert_eq!(expected("dam", "m"), [1]);
    }

    #[test]
    fn other_symbols_say_nothing_about_each_other() {
        for (symbol, base) in
            [("min", "s"), ("rpm", "1/s"), ("h", "s"), ("kB", "B"), ("m", "km/h"), ("%", "1"), ("d", "h")]
        {
            assert_eq!(expected(symbol, base), [0; 0], "{symbol} {base}");
        }
    }
}

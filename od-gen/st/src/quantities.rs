//! Quantities: what raw values are in their units, and back.
//!
//! A raw value is `(raw * factor + summand) / divisor` in its unit, with three whole numbers that LREAL has exactly, so that
//! nothing is rounded before the last step. On the way back a controller's own rounding does not matter: what it makes of a
//! number is corrected by what is left over, and only then compared with whole limits.

use std::collections::BTreeMap;

use od_spec::model::{Dictionary, Entry, EntryId, Object, Ratio, Unit};

use super::device::{Device, number};
use super::elementary::{Elementary, convert, real};
use super::names::Wanted;
use super::phrases::Phrase;
use super::text::{Declaration, Text};
use super::{LeftOut, Why};

/// Largest whole number up to which LREAL has them all.
const EXACT: i128 = 1 << 53;
/// As many steps a value may be to become a raw value: with more of them, what is lost on the way could be half a step.
const MOST_STEPS: i128 = 1 << 50;

/// A quantity that one or more entries of an object have in common.
pub(super) struct Quantity<'a> {
    pub entries: Vec<EntryId>,
    entry: &'a Entry,
    unit: &'a Unit,
    /// Type of the raw value.
    raw: Elementary,
    linear: Linear,
    /// Name of the function from raw to physical.
    pub to_value: String,
    /// Name of the function back, where the device takes values.
    pub to_raw: Option<String>,
}

/// `(raw * factor + summand) / divisor`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Linear {
    factor: i128,
    summand: i128,
    divisor: i128,
}

impl Linear {
    /// The scale and offset of a unit; `None` where LREAL does not have the numbers.
    fn of(unit: &Unit) -> Option<Self> {
        let (scale, offset) = (unit.scale, unit.offset);
        let gcd = gcd(scale.denominator(), offset.denominator());
        let divisor = scale.denominator().checked_mul(offset.denominator() / gcd)?;
        let numerator = |ratio: Ratio| ratio.numerator().checked_mul(divisor / ratio.denominator());
        let linear = Self { factor: numerator(scale)?, summand: numerator(offset)?, divisor };
        let is_exact = [linear.factor, linear.summand, linear.divisor].iter().all(|part| part.abs() <= EXACT);
        (is_exact && linear.factor != 0).then_some(linear)
    }

    /// The expression of the value of a raw one.
    fn value(self, raw: &str) -> String {
        let mut text = raw.to_owned();
        if self.factor != 1 {
            text = format!("{text} * {}.0", self.factor);
        }
        if self.summand != 0 {
            let sign = if self.summand < 0 { '-' } else { '+' };
            text = format!("{text} {sign} {}.0", self.summand.abs());
        }
        if self.divisor != 1 {
            let is_product = self.factor == 1 && self.summand == 0;
            text = if is_product { text } else { format!("({text})") };
            text = format!("{text} / {}.0", self.divisor);
        }
        text
    }

    /// The expression of the raw value, which need not be whole, of a value.
    fn steps(self, value: &str) -> String {
        let mut text = value.to_owned();
        if self.divisor != 1 {
            text = format!("{text} * {}.0", self.divisor);
        }
        if self.summand != 0 {
            let sign = if self.summand < 0 { '+' } else { '-' };
            text = format!("{text} {sign} {}.0", self.summand.abs());
        }
        if self.factor != 1 {
            let is_product = self.divisor == 1 && self.summand == 0;
            text = if is_product { text } else { format!("({text})") };
            text = format!("{text} / {}.0", self.factor);
        }
        text
    }

    /// The value of a raw one as a number of the language, to the nearest that there is.
    #[expect(clippy::cast_precision_loss, reason = "a bound with a margin, or a number that is shown")]
    fn number(self, raw: i128) -> f64 {
        (raw * self.factor + self.summand) as f64 / self.divisor as f64
    }
}

fn gcd(one: i128, other: i128) -> i128 {
    if other == 0 { one.abs() } else { gcd(other, one % other) }
}

/// The unit of an entry whose raw value counts steps of it.
pub(super) fn unit_of(entry: &Entry) -> Option<&Unit> {
    entry.unit.as_deref().filter(|_| entry.data_type.is_integer() && entry.named_type.is_none())
}

/// What entries have to have in common to share functions.
fn facts(entry: &Entry) -> impl PartialEq {
    let special: Vec<i128> = entry.special.iter().map(|special| special.value).collect();
    let unit = entry.unit.as_ref().map(|unit| unit.name.clone());
    (unit, entry.data_type, entry.low, entry.high, special, is_taken(entry))
}

/// Whether the device takes values of the entry.
const fn is_taken(entry: &Entry) -> bool {
    entry.access.is_writable()
}

/// The groups of an object's entries that share functions: all quantities of it, where nothing distinguishes them; else
/// each.
fn groups(object: &Object) -> Vec<(Vec<&Entry>, bool)> {
    let entries: Vec<&Entry> = object.entries.iter().filter(|entry| unit_of(entry).is_some()).collect();
    let is_one = entries.len() > 1
        && entries.windows(2).all(|pair| matches!(pair, [one, other] if facts(one) == facts(other)));
    if is_one {
        vec![(entries, true)]
    } else {
        entries.into_iter().map(|entry| (vec![entry], false)).collect()
    }
}

/// The quantities of a device, ascending, with what there is no function for.
pub(super) fn quantities<'a>(device: &mut Device<'a>, left_out: &mut Vec<LeftOut>) -> Vec<Quantity<'a>> {
    let dictionary: &'a Dictionary = device.dictionary;
    let mut found: Vec<Quantity<'a>> = Vec::new();
    let mut wanted: Vec<(Wanted, Wanted)> = Vec::new();
    for object in dictionary.objects.values() {
        for (entries, is_shared) in groups(object) {
            let [entry, ..] = entries.as_slice() else { continue };
            let id = EntryId { index: object.index, sub: entry.sub };
            let (Some(unit), Some(raw)) = (unit_of(entry), Elementary::of(entry)) else { continue };
            let what = || format!("conversions of {} of {}", device.title(id), dictionary.key);
            let Some(linear) = Linear::of(unit) else {
                left_out.push(LeftOut { what: what(), why: Why::InexactScale { unit: unit.name.clone() } });
                continue;
            };
            let base = if is_shared { device.name_of_object(object) } else { device.name_of(id).to_owned() };
            let name = |behind: &str| Wanted::new(format!("{base}_{behind}"), number(id));
            wanted.push((name("to_value"), name("to_raw")));
            let is_bounded = bounds(entry, raw).is_some();
            if is_taken(entry) && !is_bounded {
                left_out.push(LeftOut { what: what(), why: Why::BeyondLreal });
            }
            found.push(Quantity {
                entries: entries
                    .iter()
                    .map(|entry| EntryId { index: object.index, sub: entry.sub })
                    .collect(),
                entry,
                unit,
                raw,
                linear,
                to_value: String::new(),
                to_raw: (is_taken(entry) && is_bounded).then(String::new),
            });
        }
        for entry in object.entries.iter().filter(|entry| !entry.data_type.is_integer()) {
            let id = EntryId { index: object.index, sub: entry.sub };
            if let Some(unit) = entry.unit.as_deref().filter(|unit| !unit.is_plain()) {
                let what = format!("conversions of {} of {}", device.title(id), dictionary.key);
                left_out.push(LeftOut { what, why: Why::RealWithScale { unit: unit.name.clone() } });
            }
        }
    }
    let (to_value, to_raw): (Vec<_>, Vec<_>) = wanted.into_iter().unzip();
    let (to_value, to_raw) = (device.scope.give_all(&to_value), device.scope.give_all(&to_raw));
    for ((quantity, to_value), to_raw) in found.iter_mut().zip(to_value).zip(to_raw) {
        quantity.to_value = to_value;
        if let Some(name) = &mut quantity.to_raw {
            *name = to_raw;
        }
    }
    found
}

/// The quantities by entry.
pub(super) fn by_entry<'q, 'a>(quantities: &'q [Quantity<'a>]) -> BTreeMap<EntryId, &'q Quantity<'a>> {
    quantities.iter().flat_map(|quantity| quantity.entries.iter().map(move |id| (*id, quantity))).collect()
}

/// The smallest and largest raw value that a value can become: the limits, or the ends of the type, as far as LREAL has every
/// whole number; `None` where there is none.
fn bounds(entry: &Entry, raw: Elementary) -> Option<(i128, i128)> {
    let (least, most) = entry.data_type.range()?;
    let (low, high) = (entry.low.unwrap_or(least).max(least), entry.high.unwrap_or(most).min(most));
    let (low, high) =
        if raw.bits() == 64 { (low.max(-MOST_STEPS), high.min(MOST_STEPS)) } else { (low, high) };
    (low <= high).then_some((low, high))
}

impl Quantity<'_> {
    /// The unit's symbol, or its name where it has none.
    pub(super) fn symbol(&self) -> &str {
        if self.unit.symbol.is_empty() { &self.unit.name } else { &self.unit.symbol }
    }

    /// The value that a raw one is, as a literal.
    pub(super) fn literal(&self, raw: i128) -> String {
        real(self.linear.number(raw))
    }

    /// Both functions.
    pub(super) fn print(&self, device: &Device<'_>, text: &mut Text) {
        let titles: Vec<String> = self.entries.iter().map(|id| device.title(*id)).collect();
        let mut about = vec![device.phrase(Phrase::AlsoOf, &[&titles.join(", ")])];
        about.extend(
            self.unit.formula.as_ref().map(|formula| device.phrase(Phrase::Formula, &[&formula.text])),
        );
        if self.raw.bits() == 64 {
            about.push(device.phrase(Phrase::Inexact, &[]));
        }
        self.print_to_value(device, text, &about);
        if let Some((name, (low, high))) = self.to_raw.as_ref().zip(bounds(self.entry, self.raw)) {
            self.print_to_raw(device, text, &about, name, (low, high));
        }
    }

    fn print_to_value(&self, device: &Device<'_>, text: &mut Text, about: &[String]) {
        let name = &self.to_value;
        let step = device.wording.counted_step(self.unit);
        let mut comment = vec![device.phrase(Phrase::ToValue, &[self.symbol(), &step])];
        let special: Vec<String> =
            self.entry.special.iter().map(|special| device.wording.special(self.entry, special)).collect();
        if special.is_empty() {
            comment.push(device.phrase(Phrase::ToValueAlways, &[]));
        } else {
            comment.push(format!("{} {}", device.phrase(Phrase::ToValueSpecial, &[]), special.join(", ")));
        }
        comment.extend_from_slice(about);
        text.line("");
        text.comment(&comment);
        text.line(&format!("FUNCTION {name} : BOOL"));
        text.variables("VAR_INPUT", &[Declaration::new("raw", self.raw.name(), "")]);
        text.variables("VAR_IN_OUT", &[Declaration::new("value", "LREAL", self.symbol())]);
        let raw = convert(self.raw, Elementary::Lreal, "raw");
        let assignment = format!("value := {};", self.linear.value(&raw));
        let is_special: Vec<String> = self
            .entry
            .special
            .iter()
            .map(|special| format!("(raw = {})", self.raw.literal(special.value)))
            .collect();
        if is_special.is_empty() {
            text.line(&assignment);
            text.line(&format!("{name} := TRUE;"));
        } else {
            text.block(&format!("IF {} THEN", is_special.join(" OR ")), "ELSE", |text| {
                text.line(&format!("{name} := FALSE;"));
            });
            text.indented("END_IF;", |text| {
                text.line(&assignment);
                text.line(&format!("{name} := TRUE;"));
            });
        }
        text.line("END_FUNCTION");
    }

    fn print_to_raw(
        &self,
        device: &Device<'_>,
        text: &mut Text,
        about: &[String],
        name: &str,
        (low, high): (i128, i128),
    ) {
        let amount = |raw: i128| device.wording.physical(self.unit, raw);
        let mut comment = vec![device.phrase(
            Phrase::ToRaw,
            &[self.symbol(), &amount(low), &amount(high), &low.to_string(), &high.to_string()],
        )];
        comment.extend_from_slice(about);
        // A step of room on either side, so that no value beyond the type is ever converted.
        let ends = [self.linear.number(low - 1), self.linear.number(high + 1)];
        let (above, below) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        let has_room = i128::from(i32::MIN) + 2 <= low && high <= i128::from(i32::MAX) - 2;
        let whole = if has_room { Elementary::Dint } else { Elementary::Lint };
        let special =
            self.entry.special.iter().map(|special| special.value).filter(|raw| (low..=high).contains(raw));
        let unless: Vec<String> =
            special.map(|raw| format!(" AND (whole <> {})", whole.literal(raw))).collect();
        let unless = unless.concat();
        text.line("");
        text.comment(&comment);
        text.line(&format!("FUNCTION {name} : BOOL"));
        text.variables("VAR_INPUT", &[Declaration::new("value", "LREAL", self.symbol())]);
        text.variables("VAR_IN_OUT", &[Declaration::new("raw", self.raw.name(), "")]);
        text.variables(
            "VAR",
            &[
                Declaration::new("steps", "LREAL", ""),
                Declaration::new("rest", "LREAL", ""),
                Declaration::new("whole", whole.name(), ""),
            ],
        );
        text.line(&format!("{name} := FALSE;"));
        text.block(
            &format!("IF (value > {}) AND (value < {}) THEN", real(above), real(below)),
            "END_IF;",
            |text| {
                text.line(&format!("steps := {};", self.linear.steps("value")));
                text.line(&format!("whole := {};", convert(Elementary::Lreal, whole, "steps")));
                text.line(&format!("rest := steps - {};", convert(whole, Elementary::Lreal, "whole")));
                text.block("IF steps < 0.0 THEN", "ELSE", |text| nearest(text, [">", "<="]));
                text.indented("END_IF;", |text| nearest(text, [">=", "<"]));
                let inside =
                    format!("(whole >= {}) AND (whole <= {})", whole.literal(low), whole.literal(high));
                text.block(&format!("IF {inside}{unless} THEN"), "END_IF;", |text| {
                    text.line(&format!("raw := {};", convert(whole, self.raw, "whole")));
                    text.line(&format!("{name} := TRUE;"));
                });
            },
        );
        text.line("END_FUNCTION");
    }
}

/// Corrects what a controller has made of the steps: cut off or rounded, halves up, down or to even.
fn nearest(text: &mut Text, [above, below]: [&str; 2]) {
    text.block(&format!("IF rest {above} 0.5 THEN"), &format!("ELSIF rest {below} -0.5 THEN"), |text| {
        text.line("whole := whole + 1;");
    });
    text.indented("END_IF;", |text| text.line("whole := whole - 1;"));
}

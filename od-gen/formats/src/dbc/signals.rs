//! What PDOs carry, as signals.

use od_gen::plan::Words;
use od_spec::model::{
    BitField, DataType, Edge, Entry, EntryId, Family, Object, Pdo, PdoTarget, Ratio, TypeKind, Value,
};
use od_spec::order::Arrange as _;
use od_spec::wording::{Notation, Wording};

use super::Node;
use super::names::{Named, SignalName, of_entry, signal_names};
use super::number::{decimal, is_exact};

const WORDING: Wording = Wording::english(Notation::Diagnostic);

/// A part of a message.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Signal {
    /// Name.
    pub name: SignalName,
    /// Lowest bit, and how many.
    pub bits: (u32, u32),
    /// How the bits are a number.
    pub coding: Coding,
    /// Symbols per raw step, as a decimal.
    pub factor: String,
    /// What the raw value 0 means, as a decimal.
    pub offset: String,
    /// Smallest and largest value in the unit; "0" and "0" where nothing limits it.
    pub limits: (String, String),
    /// Symbol of the unit; may be empty.
    pub unit: String,
    /// Raw values that have names.
    pub values: Vec<(i128, String)>,
    /// Raw value after start, as a decimal.
    pub start: Option<String>,
    /// What a person should know.
    pub comment: String,
}

/// How the bits of a signal are a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Coding {
    Unsigned,
    Signed,
    Real32,
    Real64,
}

impl Signal {
    /// A number without unit, limits and more.
    pub(super) fn unsigned(name: SignalName, bits: (u32, u32)) -> Self {
        Self {
            name,
            bits,
            coding: Coding::Unsigned,
            factor: "1".to_owned(),
            offset: "0".to_owned(),
            limits: ("0".to_owned(), "0".to_owned()),
            unit: String::new(),
            values: Vec::new(),
            start: None,
            comment: String::new(),
        }
    }

    /// Whether another signal means the same at the same place, whatever it is called.
    pub(super) fn is_laid_out_as(&self, other: &Self) -> bool {
        let layout = |signal: &Self| {
            (
                signal.bits,
                signal.coding,
                signal.factor.clone(),
                signal.offset.clone(),
                signal.unit.clone(),
                signal.values.clone(),
            )
        };
        layout(self) == layout(other)
    }
}

/// The signals of a PDO as it is mapped; placeholders are not signals.
pub(super) fn of_pdo(node: &Node<'_>, pdo: &Pdo) -> Vec<Signal> {
    let parts: Vec<(Named, Signal)> = pdo
        .fields()
        .filter_map(|field| match field.mapped.target {
            PdoTarget::Entry(id) => {
                Some(of_entry_at(node, id, u32::from(field.mapped.bits), field.first_bit))
            }
            PdoTarget::Dummy(_) => None,
        })
        .flatten()
        .collect();
    let (named, signals): (Vec<Named>, Vec<Signal>) = parts.into_iter().unzip();
    signal_names(&named).into_iter().zip(signals).map(|(name, signal)| Signal { name, ..signal }).collect()
}

/// The signals of an entry that lies in a message from `first` on: one, or those of its bit field.
pub(super) fn of_entry_at(node: &Node<'_>, id: EntryId, bits: u32, first: u32) -> Vec<(Named, Signal)> {
    let (words, most) = of_entry(node.device, id);
    let found = node.device.objects.get(&id.index).and_then(|object| Some((object, object.entry(id.sub)?)));
    let whole =
        |signal: Signal| vec![(Named { words: words.clone(), most: most.clone(), id, bit: None }, signal)];
    let Some((object, entry)) = found else {
        return whole(Signal::unsigned(SignalName::plain(""), (first, bits)));
    };
    if let Some(TypeKind::Bits(fields)) = entry.named_type.as_ref().map(|named| &named.kind) {
        let used: Vec<_> = fields.iter().filter(|field| is_used(field, bits)).collect();
        if !used.is_empty() {
            let part = |field: &&BitField| {
                let name =
                    if field.name.is_empty() { format!("bit {}", field.first) } else { field.name.clone() };
                let named =
                    Named { words: words.and(&name), most: Words::of(&name), id, bit: Some(field.first) };
                (named, of_field(node, id, entry, field, (first, bits)))
            };
            return used.iter().map(part).collect();
        }
    }
    whole(of_number(node, object, entry, (first, bits)))
}

/// Whether bits mean something, and at least one of them is mapped.
fn is_used(field: &BitField, mapped: u32) -> bool {
    field.is_told() && u32::from(field.first) < mapped
}

/// One field of a bit field.
fn of_field(
    node: &Node<'_>,
    id: EntryId,
    entry: &Entry,
    field: &BitField,
    (first, mapped): (u32, u32),
) -> Signal {
    let at = u32::from(field.first);
    let count = (u32::from(field.last) + 1).min(mapped) - at;
    let mut signal = Signal::unsigned(SignalName::plain(""), (first + at, count));
    signal.values = field.values.iter().map(|value| (value.value, value.name.clone())).collect();
    let raw = entry.default.as_ref().and_then(|value| value.integer_for(node.id));
    signal.start = raw.and_then(|raw| {
        let mask = 1_i128.checked_shl(count)?.checked_sub(1)?;
        Some((raw.checked_shr(at)? & mask).to_string())
    });
    let place = if field.first == field.last {
        format!("{id}, bit {}", field.first)
    } else {
        format!("{id}, bits {} to {}", field.first, field.last)
    };
    let mut lines = vec![format!(
        "{place}{}",
        if field.name.is_empty() { String::new() } else { format!(": {}", field.name) }
    )];
    if field.active == 0 {
        lines.push("active: 0".to_owned());
    }
    lines.extend(field.edge.map(|edge| {
        match edge {
            Edge::Rising => "acts when it changes from 0 to 1",
            Edge::Falling => "acts when it changes from 1 to 0",
            Edge::Both => "acts when it changes",
        }
        .to_owned()
    }));
    let language = node.system.language();
    lines.extend(field.about.get(language).map(str::to_owned));
    for meaning in &field.modes {
        let about = meaning.about.get(language).map(|about| format!(": {about}")).unwrap_or_default();
        lines.push(format!("mode {}: {}{about}", meaning.mode.value, meaning.name));
    }
    signal.comment = lines.join("\n");
    signal
}

/// An entry that is one number; anything else, such as a text, is one to this format, too.
fn of_number(node: &Node<'_>, object: &Object, entry: &Entry, bits: (u32, u32)) -> Signal {
    let mut signal = Signal::unsigned(SignalName::plain(""), bits);
    let width = width(entry.data_type);
    let is_whole = width == Some(bits.1);
    signal.coding = coding(entry.data_type, is_whole);
    let (scale, offset) =
        entry.unit.as_ref().map_or((Ratio::ONE, Ratio::ZERO), |unit| (unit.scale, unit.offset));
    signal.factor = decimal(scale);
    signal.offset = decimal(offset);
    if let Some(unit) = &entry.unit {
        signal.unit.clone_from(&unit.symbol);
    }
    signal.limits = limits(entry, scale, offset).unwrap_or(signal.limits);
    signal.values = values(entry);
    signal.start = entry.default.as_ref().and_then(|value| match (value, value.integer_for(node.id)) {
        (_, Some(raw)) => Some(raw.to_string()),
        (Value::Real(real), None) if is_whole => Some(real.number().to_string()),
        (_, None) => None,
    });
    signal.comment = comment(node, object, entry, bits.1).join("\n");
    signal
}

/// Bits of a value in a PDO; a BOOLEAN is one.
fn width(data_type: DataType) -> Option<u32> {
    match data_type {
        DataType::Boolean => Some(1),
        sized => sized.bits().map(u32::from),
    }
}

/// A part of a value has no sign.
fn coding(data_type: DataType, is_whole: bool) -> Coding {
    match data_type.family() {
        Family::Signed if is_whole => Coding::Signed,
        Family::Real if is_whole && data_type == DataType::Real32 => Coding::Real32,
        Family::Real if is_whole => Coding::Real64,
        Family::Boolean
        | Family::Signed
        | Family::Unsigned
        | Family::Real
        | Family::VisibleString
        | Family::OctetString
        | Family::UnicodeString
        | Family::Time
        | Family::Domain => Coding::Unsigned,
    }
}

/// The limits in the unit, widened to take in the special values; where one side has none, the end of the type.
fn limits(entry: &Entry, scale: Ratio, offset: Ratio) -> Option<(String, String)> {
    if !entry.is_limited() {
        return None;
    }
    if let (Some(low), Some(high)) = (&entry.real_limits.low, &entry.real_limits.high) {
        return Some((low.number().to_string(), high.number().to_string()));
    }
    let (low, high) = entry.hull();
    let (least, most) = entry.data_type.range()?;
    let physical = |raw: i128| Some(decimal(Ratio::whole(raw).checked_mul(scale)?.checked_add(offset)?));
    Some((physical(low.unwrap_or(least))?, physical(high.unwrap_or(most))?))
}

/// Names of raw values: of an enum, and those with a meaning of their own.
fn values(entry: &Entry) -> Vec<(i128, String)> {
    let mut values: Vec<(i128, String)> = match entry.named_type.as_ref().map(|named| &named.kind) {
        Some(TypeKind::Enum(values)) => {
            values.iter().map(|value| (value.value, value.name.clone())).collect()
        }
        Some(TypeKind::Bits(_)) | None => Vec::new(),
    };
    for special in &entry.special {
        if !values.iter().any(|(raw, _)| *raw == special.value) {
            values.push((special.value, special.name.clone()));
        }
    }
    values.arrange_by_key(|(raw, _)| *raw);
    values
}

fn comment(node: &Node<'_>, object: &Object, entry: &Entry, mapped: u32) -> Vec<String> {
    let id = EntryId { index: object.index, sub: entry.sub };
    let mut lines = vec![format!("{id} {}", node.device.entry_name(id).unwrap_or_default())];
    let language = node.system.language();
    lines.extend(entry.warning.get(language).map(|warning| format!("Warning: {warning}")));
    lines.extend(entry.about.get(language).map(str::to_owned));
    if let Some(alias) = &entry.alias {
        lines.push(format!("view of {}", node.device.entry_name(alias.target).unwrap_or_default()));
    }
    if let Some(unit) = &entry.unit
        && !(is_exact(unit.scale) && is_exact(unit.offset))
    {
        lines.push(format!("one step is exactly {}", WORDING.step(unit)));
    }
    // The limits of the signal take in the special values.
    if entry.hull() != (entry.low, entry.high)
        && let Some(range) = WORDING.range(object.index, entry)
    {
        lines.push(format!("range {range}, or a special value"));
    }
    if let Some(width) = width(entry.data_type).filter(|width| *width != mapped) {
        lines.push(format!("{mapped} of its {width} bits are mapped"));
    }
    match entry.data_type.family() {
        Family::VisibleString
        | Family::OctetString
        | Family::UnicodeString
        | Family::Time
        | Family::Domain => {
            lines.push(format!("{}, here the number that its bytes would be", entry.data_type.name()));
        }
        Family::Boolean | Family::Signed | Family::Unsigned | Family::Real => {}
    }
    lines
}

//! Enums and bit fields.

use std::collections::BTreeMap;

use super::numbers::to_u16;
use crate::ast::{BitDecl, BitRange, TypeDecl, ValueDecl, Words};
use crate::check::codes as rule_codes;
use crate::diag::shorten;
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{
    BitField, DataType, EnumValue, ModeMeaning, NamedType, Phrases, Statement, Text, TypeKind,
};
use crate::order::Arrange as _;
use crate::source::{FileId, Span, Spanned};

/// Resolves a type; `None` when it is too broken to be used.
pub(super) fn resolve(decl: &TypeDecl, maker: FileId, diagnostics: &mut Diagnostics) -> Option<NamedType> {
    let name = decl.base.as_ref()?;
    let Some(base) = DataType::from_name(&name.value).filter(|base| base.is_integer()) else {
        let integers =
            DataType::ALL.into_iter().filter(|data_type| data_type.is_integer()).map(DataType::name);
        let meant = diagnostics.suggestions.nearest(&name.value, integers);
        let message = format!("`{}` cannot carry values or bits", shorten(&name.value));
        let diagnostic = Diagnostic::new(codes::BAD_BASE_TYPE, name.span, message);
        diagnostics.push(match meant {
            Some(word) if word != name.value => diagnostic.did_you_mean(word),
            _ => diagnostic.help("write an integer type such as `unsigned16`"),
        });
        return None;
    };
    let (low, high) = base.range()?;
    let kind = match (&decl.values, &decl.bits) {
        (Some(list), None) => {
            if list.is_empty() && !decl.unsure {
                diagnostics.push(
                    Diagnostic::new(
                        codes::MISSING_KEY,
                        decl.name.span,
                        format!("enum `{}` has no values", shorten(&decl.name.value)),
                    )
                    .help("list the values with their names"),
                );
            }
            TypeKind::Enum(values(list, (low, high), &format!("{base}"), diagnostics).into())
        }
        (None, Some(list)) => TypeKind::Bits(bits(decl, list, base, diagnostics)?),
        // Reported by the keys of a type.
        (Some(_), Some(_)) | (None, None) => return None,
    };
    let stated = Statement::written(decl.name.span, maker);
    Some(NamedType {
        name: decl.name.value.clone(),
        base,
        about: with_gap(&decl.about, &decl.gap),
        kind,
        stated,
    })
}

/// A text or none.
pub(super) fn words(words: &Words) -> Text {
    words.as_ref().map(|words| words.value.clone()).unwrap_or_default()
}

/// A description with what the printed manual leaves open.
pub(super) fn with_gap(about: &Words, gap: &Words) -> Text {
    words(about).leaving_open(words(gap))
}

/// The phrases by which readers look for something, if there are any.
pub(super) fn phrases(written: Option<&Spanned<Phrases>>) -> Phrases {
    written.map(|phrases| phrases.value.clone()).unwrap_or_default()
}

fn values(
    list: &[ValueDecl],
    (low, high): (i128, i128),
    carrier: &str,
    diagnostics: &mut Diagnostics,
) -> Vec<EnumValue> {
    let mut names: BTreeMap<&str, Span> = BTreeMap::new();
    let mut values = Vec::new();
    for decl in list {
        let value = decl.value.value;
        if !(low..=high).contains(&value) {
            diagnostics.push(
                Diagnostic::new(
                    rule_codes::VALUE_DOES_NOT_FIT,
                    decl.value.span,
                    format!("{value} does not fit {carrier}"),
                )
                .label(format!("allowed: {low} to {high}"))
                .help("correct the value or take a wider type"),
            );
            continue;
        }
        let Some(name) = &decl.name else { continue };
        unique_name(&name.value, name.span, &mut names, diagnostics);
        values.push(EnumValue {
            value,
            name: name.value.clone(),
            supported: decl.supported.is_none_or(|supported| supported.value),
            about: with_gap(&decl.about, &decl.gap),
            search: phrases(decl.search.as_ref()),
            place: Spanned::new((), name.span),
        });
    }
    values.arrange_by_key(|value| value.value);
    values
}

fn unique_name<'a>(
    name: &'a str,
    span: Span,
    names: &mut BTreeMap<&'a str, Span>,
    diagnostics: &mut Diagnostics,
) {
    if let Some(before) = names.insert(name, span) {
        diagnostics.push(
            Diagnostic::new(
                rule_codes::DUPLICATE_NAME,
                span,
                format!("the name `{}` is used twice in this type", shorten(name)),
            )
            .label("again here")
            .with(before, "first here")
            .help("give each value or bit a name of its own"),
        );
    }
}

fn bits(
    decl: &TypeDecl,
    list: &[BitDecl],
    base: DataType,
    diagnostics: &mut Diagnostics,
) -> Option<Vec<BitField>> {
    let width = u8::try_from(base.bits()?).ok()?;
    let mut owner: Vec<Option<Span>> = vec![None; usize::from(width)];
    let mut names: BTreeMap<&str, Span> = BTreeMap::new();
    let mut fields = Vec::new();
    for bit in list {
        let Spanned { value: BitRange { first, last }, span } = bit.bits;
        if last >= width {
            diagnostics.push(
                Diagnostic::new(rule_codes::VALUE_DOES_NOT_FIT, span, format!("{base} has no bit {last}"))
                    .label(format!("bits 0 to {}", width - 1))
                    .help("correct the bit number or take a wider type"),
            );
            owner.iter_mut().skip(usize::from(first)).for_each(|bit| *bit = bit.or(Some(span)));
            continue;
        }
        let range = usize::from(first)..=usize::from(last);
        let taken = owner[range.clone()].iter().flatten().next().copied();
        owner[range].iter_mut().for_each(|bit| *bit = bit.or(Some(span)));
        if let Some(before) = taken {
            diagnostics.push(
                Diagnostic::new(codes::OVERLAPPING_BITS, span, "these bits overlap with others")
                    .label("overlaps")
                    .with(before, "taken here")
                    .help("each bit belongs to one field"),
            );
            continue;
        }
        if let Some(name) = &bit.name {
            unique_name(&name.value, name.span, &mut names, diagnostics);
        }
        fields.push(field(bit, diagnostics));
    }
    fill(decl, &owner, &mut fields, diagnostics);
    fields.arrange_by_key(|field| field.first);
    Some(fields)
}

fn field(bit: &BitDecl, diagnostics: &mut Diagnostics) -> BitField {
    let BitRange { first, last } = bit.bits.value;
    let highest = (1i128 << (last - first + 1)) - 1;
    BitField {
        first,
        last,
        usage: bit.usage,
        name: bit.name.as_ref().map_or(String::new(), |name| name.value.clone()),
        about: with_gap(&bit.about, &bit.gap),
        search: phrases(bit.search.as_ref()),
        errors: bit.errors.iter().map(|code| code.map(to_u16)).collect(),
        mnemonic: bit.mnemonic.as_ref().map(|mnemonic| mnemonic.value.clone()),
        clamp: bit.clamp.as_ref().map(|clamp| clamp.value.clone()),
        active: u8::from(bit.active.is_none_or(|active| active.value == 1)),
        edge: bit.edge,
        priority: bit.priority.as_ref().map(|priority| priority.value.clone()),
        values: values(&bit.values, (0, highest), "these bits", diagnostics),
        modes: bit
            .modes
            .iter()
            .filter_map(|bit| {
                let name = bit.name.as_ref()?.value.clone();
                Some(ModeMeaning { mode: bit.mode.clone(), name, about: with_gap(&bit.about, &bit.gap) })
            })
            .collect(),
        place: Spanned::new((), bit.name.as_ref().map_or(bit.bits.span, |name| name.span)),
    }
}

/// Gives the bits that are not listed the usage that `rest` names.
fn fill(decl: &TypeDecl, owner: &[Option<Span>], fields: &mut Vec<BitField>, diagnostics: &mut Diagnostics) {
    let mut free = Vec::new();
    let mut at = 0;
    while at < owner.len() {
        let length = owner[at..].iter().take_while(|bit| bit.is_none()).count();
        if length > 0 {
            free.push((at, at + length - 1));
        }
        at += length.max(1);
    }
    let Some(Spanned { value: usage, .. }) = decl.rest else {
        if !free.is_empty() && !decl.unsure {
            let runs =
                free.iter().map(
                    |(first, last)| {
                        if first == last { format!("{first}") } else { format!("{first}..{last}") }
                    },
                );
            let runs = runs.collect::<Vec<_>>().join(", ");
            diagnostics.push(
                Diagnostic::new(
                    codes::BITS_MISSING,
                    decl.name.span,
                    format!("type `{}` leaves out bits {runs}", shorten(&decl.name.value)),
                )
                .help("list them as `reserved` or `unused`, or add `rest: reserved`"),
            );
        }
        return;
    };
    fields.extend(free.into_iter().filter_map(|(first, last)| {
        Some(BitField {
            first: u8::try_from(first).ok()?,
            last: u8::try_from(last).ok()?,
            usage,
            name: String::new(),
            about: Text::default(),
            search: Phrases::default(),
            errors: Vec::new(),
            mnemonic: None,
            clamp: None,
            active: 1,
            edge: None,
            priority: None,
            values: Vec::new(),
            modes: Vec::new(),
            place: Spanned::new((), decl.name.span),
        })
    }));
}

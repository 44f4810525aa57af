//! One entry: type, access, unit, values, policy.

use std::sync::Arc;

use super::bit_values;
use super::defaults;
use super::scope::{Scope, unknown_or};
use super::surroundings::{EdsDefaults, Surroundings};
use super::types::{phrases, with_gap, words};
use super::values::{self, Expected};
use crate::ast::{BitErrorDecl, BitRange, ConditionDecl, DefaultDecl, EntryDecl, Name, SpecialDecl};
use crate::diag::shorten;
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{
    Access, AccessRight, BitErrors, DataType, EdsPolicy, Entry, EntryId, Expr, Fact, Family, NamedType,
    PdoMapping, RealLimits, SpecialValue, Storage, SubIndex, TypeKind, Value,
};
use crate::order::Arrange as _;
use crate::source::Spanned;

/// Resolves an entry; `None` when it is too broken to mean anything.
pub(super) fn resolve(
    decl: &EntryDecl,
    sub: SubIndex,
    name: String,
    around: Surroundings<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Entry> {
    let id = around.index.map(|index| EntryId { index, sub });
    diagnostics.now_about(id.map(Into::into));
    let decl = &*defaults::of_device(decl, around, diagnostics);
    let EntryType { data_type, named_type } = entry_type(decl, around.scope, diagnostics)?;
    let Some(access) = &decl.access else {
        if decl.unsure {
            return None;
        }
        diagnostics
            .push(Diagnostic::new(codes::MISSING_KEY, decl.span, "an entry needs the key `access`").help(
            "add `access: ro`, `wo`, `rw`, `rwr`, `rww` or `const`, here or where the entry inherits from",
        ));
        return None;
    };
    let AccessRight { access, locked } = access.value;
    let unit = decl.unit.as_ref().and_then(|unit| around.scope.unit(unit, diagnostics));
    let special = special_values(decl.special.as_ref(), data_type, diagnostics);
    let expected =
        Expected { data_type, named: named_type.as_deref(), unit: unit.as_deref(), special: &special };
    // Values in a unit that is broken or unknown cannot be read; that was said already.
    let readable = decl.unit.is_some() == unit.is_some();
    let (low, high) = if readable { limits(decl, expected, diagnostics) } else { (None, None) };
    let default = decl.default.as_ref().filter(|_| readable);
    let default = read_default(default, expected, around, diagnostics);
    let stored = decl.stored.map_or(Storage::No, |stored| stored.value);
    let mut entry = Entry {
        sub,
        name,
        data_type,
        access,
        locked,
        pdo: decl.pdo.map_or(PdoMapping::None, |pdo| pdo.value),
        default,
        low: low.as_ref().and_then(Value::integer),
        high: high.as_ref().and_then(Value::integer),
        real_limits: RealLimits {
            low: low.as_ref().and_then(Value::real).cloned(),
            high: high.as_ref().and_then(Value::real).cloned(),
        },
        special,
        stored,
        alias: None,
        category: decl.category.map(|category| category.value),
        since: decl.since.as_ref().map(|since| since.value.clone()),
        writable_when: decl.writable_when.as_ref().map(|condition| match &condition.value {
            ConditionDecl::Plain(condition) => condition.clone(),
            ConditionDecl::Named(text) => Expr::unresolved(text),
        }),
        capacity: capacity(decl, data_type, diagnostics),
        identifier: identifier(decl, diagnostics),
        bit_errors: bit_errors(decl.bit_errors.as_ref(), named_type.as_deref(), diagnostics),
        eds: EdsPolicy { access, default: true, no_write: false, no_scan: false },
        warning: words(&decl.warning),
        about: with_gap(&decl.about, &decl.gap),
        search: phrases(decl.search.as_ref()),
        facts: decl.facts(around.file),
        span: decl.span,
        named_type,
        unit,
    };
    if let Some(condition) = decl.writable_when.as_ref().filter(|_| !access.is_writable()) {
        diagnostics.push(
            Diagnostic::new(
                codes::CONFLICTING_KEYS,
                condition.span,
                format!("`writable-when` has no effect here: the entry is `{}`", access.word()),
            )
            .help("remove it, or correct the access"),
        );
    }
    entry.eds = eds_policy(&entry, decl, around.eds);
    Some(entry)
}

/// A default: one value, or the bits of a bit field that are 1.
fn read_default(
    default: Option<&Spanned<DefaultDecl>>,
    expected: Expected<'_>,
    around: Surroundings<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Value> {
    if let Some(Spanned { value: DefaultDecl::Each(bits), .. }) = default
        && let Some(TypeKind::Bits(fields)) = expected.named.map(|named| &named.kind)
    {
        return bit_values::read(bits, fields, expected.data_type, diagnostics);
    }
    let default = defaults::one(default, around, diagnostics);
    values::read_into(default.as_ref(), expected, diagnostics)
}

fn capacity(decl: &EntryDecl, data_type: DataType, diagnostics: &mut Diagnostics) -> Option<u16> {
    let capacity = decl.capacity?;
    if !data_type.is_string() {
        diagnostics.push(
            Diagnostic::new(
                codes::CONFLICTING_KEYS,
                capacity.span,
                format!("`capacity` has no effect here: {data_type} is not a string"),
            )
            .help("remove it; only strings have a capacity"),
        );
        return None;
    }
    let bytes = super::numbers::to_u16(capacity.value);
    if data_type == DataType::UnicodeString && bytes % 2 == 1 {
        diagnostics.push(
            Diagnostic::new(
                codes::BAD_NOTATION,
                capacity.span,
                "a UNICODE_STRING has an even number of bytes",
            )
            .help("write the number of 16-bit units times two"),
        );
        return None;
    }
    Some(bytes)
}

/// The name in generated code; `None` also for one that is not valid, which is reported.
pub(super) fn identifier(decl: &EntryDecl, diagnostics: &mut Diagnostics) -> Option<String> {
    let name = decl.identifier.as_ref()?;
    if is_identifier(&name.value) {
        return Some(name.value.clone());
    }
    diagnostics.push(no_identifier(name));
    None
}

/// Whether a text can name something in generated code.
pub(super) fn is_identifier(name: &str) -> bool {
    let lower = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'_';
    let plain = name.bytes().all(lower) && !name.contains("__") && !name.ends_with('_');
    plain && name.starts_with(|first: char| first.is_ascii_lowercase())
}

/// A text that cannot.
pub(super) fn no_identifier(name: &Name) -> Diagnostic {
    let message = format!("`{}` is not an identifier", shorten(&name.value));
    Diagnostic::new(codes::BAD_NOTATION, name.span, message)
        .help("write lower-case words joined by single `_`, beginning with a letter: `speed_limit_2`")
}

/// The data type of an entry, and the enum or bit field that gives its values a meaning.
pub(super) struct EntryType {
    pub data_type: DataType,
    pub named_type: Option<Arc<NamedType>>,
}

/// The type of an entry.
pub(super) fn entry_type(
    decl: &EntryDecl,
    scope: &Scope,
    diagnostics: &mut Diagnostics,
) -> Option<EntryType> {
    let Some(name) = &decl.type_name else {
        if decl.unsure {
            return None;
        }
        diagnostics.push(
            Diagnostic::new(codes::MISSING_KEY, decl.span, "an entry needs the key `type`")
                .help("add `type:` with a data type or a named type, here or where the entry inherits from"),
        );
        return None;
    };
    if let Some(data_type) = DataType::from_name(&name.value) {
        return Some(EntryType { data_type, named_type: None });
    }
    if let Some(named) = scope.types.get(&name.value) {
        return Some(EntryType { data_type: named.base, named_type: Some(Arc::clone(named)) });
    }
    if !scope.is_broken(&name.value) {
        let named = scope.types.keys().map(String::as_str);
        let known = named.chain(DataType::ALL.iter().map(|data_type| data_type.name()));
        let elsewhere = crate::notation::words::data_type(&name.value);
        let known = known.filter(|_| elsewhere.is_none());
        let otherwise = |diagnostic: Diagnostic| match elsewhere {
            Some(data_type) => diagnostic.write(data_type.name()),
            None => {
                diagnostic.help("write a data type such as `unsigned16`, or define the name under `types:`")
            }
        };
        unknown_or(codes::UNKNOWN_TYPE, name, "type", known, otherwise, diagnostics);
    }
    None
}

fn special_values(
    list: Option<&Spanned<Vec<SpecialDecl>>>,
    data_type: DataType,
    diagnostics: &mut Diagnostics,
) -> Vec<SpecialValue> {
    let Some(list) = list else { return Vec::new() };
    if data_type.range().is_none() {
        diagnostics.push(
            Diagnostic::new(codes::LIMIT_ON_TYPE, list.span, format!("{data_type} has no special values"))
                .help("remove `special:`; only integers have such values"),
        );
        return Vec::new();
    }
    let mut values = Vec::new();
    for decl in &list.value {
        if let Err(diagnostic) = values::fits(decl.value.value, decl.value.span, data_type, decl.value.value)
        {
            diagnostics.push(*diagnostic);
        } else if let Some(name) = &decl.name {
            let about = words(&decl.about);
            let place = Spanned::new((), name.span);
            values.push(SpecialValue { value: decl.value.value, name: name.value.clone(), about, place });
        }
    }
    values.arrange_by_key(|special| special.value);
    values
}

fn limits(
    decl: &EntryDecl,
    expected: Expected<'_>,
    diagnostics: &mut Diagnostics,
) -> (Option<Value>, Option<Value>) {
    let mut limit = |text: Option<&Name>| {
        let text = text?;
        if !expected.data_type.is_integer() && expected.data_type.family() != Family::Real {
            diagnostics.push(
                Diagnostic::new(
                    codes::LIMIT_ON_TYPE,
                    text.span,
                    format!("{} has no limits", expected.data_type),
                )
                .help("remove the limit; only numbers have limits"),
            );
            return None;
        }
        let value = values::read_into(Some(text), expected, diagnostics)?;
        if matches!(value, Value::NodeId(_)) {
            diagnostics.push(
                Diagnostic::new(codes::BAD_VALUE, text.span, "a limit cannot depend on the node-ID")
                    .help("write a number"),
            );
            return None;
        }
        Some(value)
    };
    (limit(decl.min.as_ref()), limit(decl.max.as_ref()))
}

fn bit_errors(
    list: Option<&Spanned<Vec<BitErrorDecl>>>,
    named: Option<&NamedType>,
    diagnostics: &mut Diagnostics,
) -> Vec<BitErrors> {
    let Some(list) = list else { return Vec::new() };
    let fields = match named.map(|named| &named.kind) {
        Some(TypeKind::Bits(fields)) => fields.as_slice(),
        _ => &[],
    };
    let mut errors = Vec::new();
    for decl in &list.value {
        let BitRange { first, last } = decl.bits.value;
        if !fields.iter().any(|field| (field.first, field.last) == (first, last)) {
            diagnostics.push(
                Diagnostic::new(
                    codes::UNKNOWN_BIT,
                    decl.bits.span,
                    match named {
                        Some(named) if !fields.is_empty() => {
                            let run = if first == last {
                                format!("bit {first}")
                            } else {
                                format!("bits {first}..{last}")
                            };
                            format!("type `{}` does not list {run}", shorten(&named.name))
                        }
                        _ => "the entry's type is not a bit field".to_owned(),
                    },
                )
                .help("name a bit, or the whole run of bits, of the entry's bit field type"),
            );
            continue;
        }
        let codes = decl.codes.iter().map(|code| code.map(super::numbers::to_u16)).collect();
        errors.push(BitErrors { bit: first, codes });
    }
    errors.arrange_by_key(|errors: &BitErrors| errors.bit);
    errors
}

/// What the EDS shows. A locked entry is read-only to a PLC; the defaults of locked and stored entries stay out of a
/// `safe` EDS, because some PLCs write every writable entry that has a default at each boot.
fn eds_policy(entry: &Entry, decl: &EntryDecl, defaults: EdsDefaults) -> EdsPolicy {
    let kept = entry.locked
        || matches!(entry.stored, Storage::Application | Storage::Manufacturer | Storage::Remanent);
    let access = match (entry.access, entry.pdo) {
        // What cannot be read stays `wo`; its flags keep tools from writing it.
        _ if entry.locked && entry.access.is_readable() => Access::Ro,
        (access, pdo) => access.joined(pdo),
    };
    let stated = decl.eds.as_ref().map(|eds| &eds.value);
    let protected = kept && entry.access.is_writable();
    let default = match defaults {
        EdsDefaults::All => true,
        EdsDefaults::Safe => !protected,
        EdsDefaults::Own => !protected && !entry.is_only_standard(Fact::Default),
    };
    EdsPolicy {
        access: stated.and_then(|eds| eds.access).unwrap_or(access),
        default: stated.and_then(|eds| eds.default).unwrap_or(default),
        no_write: entry.locked || stated.is_some_and(|eds| eds.no_write),
        no_scan: stated.is_some_and(|eds| eds.no_scan),
    }
}

/// The policy of a view of another entry: whatever protects the target protects the view.
pub(super) fn alias_policy(
    alias: &Entry,
    target: &Entry,
    decl: &EntryDecl,
    defaults: EdsDefaults,
) -> EdsPolicy {
    let facts = target.facts.clone();
    let as_target = Entry { locked: target.locked, stored: target.stored, facts, ..alias.clone() };
    let policy = eds_policy(&as_target, decl, defaults);
    EdsPolicy { no_write: policy.no_write || target.eds.no_write, ..policy }
}

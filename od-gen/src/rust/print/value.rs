//! Values in code: their types, and how bytes become values and values bytes.

use od_spec::model::{DataType, Family, Outside, Value};
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::literal::{decimal, hex};
use crate::plan::{
    Members, Place, Plan, PlannedAlias, PlannedEntry, PlannedSpecialValue, ValueKind, default_integer,
};

/// How a number is carried in code.
#[derive(Clone, Copy)]
pub(super) struct Carrier {
    signed: bool,
    bytes: usize,
}

impl Carrier {
    /// The integer that carries a data type; a bit field is unsigned, whatever its base.
    fn of(kind: &ValueKind, is_bits: bool) -> Option<Self> {
        let bits = kind.data_type.bits()?;
        kind.data_type.is_integer().then(|| Self {
            signed: kind.data_type.is_signed() && !is_bits,
            bytes: usize::from(bits.div_ceil(8)),
        })
    }

    /// Whether Rust has an integer of exactly this width.
    const fn is_exact(self) -> bool {
        matches!(self.bytes, 1 | 2 | 4 | 8)
    }

    fn name(self) -> TokenStream {
        let bits = if self.is_exact() { self.bytes * 8 } else { 64 };
        let name = format_ident!("{}{bits}", if self.signed { 'i' } else { 'u' });
        quote!(#name)
    }
}

/// How a raw value is carried in code.
#[derive(Clone, Copy)]
enum Raw {
    Integer(Carrier),
    Bool,
    Single,
    Double,
    Visible,
    Octets,
    Unicode,
    Time,
    /// A DOMAIN lies with the application: code has no value of it.
    Nothing,
}

/// What is printed where: how module paths begin, and the bytes that hold the values.
pub(super) struct At {
    /// Nothing at the top of the dictionary's module, `super::` in its modules.
    pub root: TokenStream,
    /// The bytes to read.
    pub image: TokenStream,
    /// The bytes to write.
    pub image_mut: TokenStream,
}

impl At {
    /// In the methods of the dictionary itself.
    pub(super) fn top() -> Self {
        Self { root: quote!(), image: quote!(&self.0), image_mut: quote!(&mut self.0) }
    }

    /// In the methods of a group of accessors.
    pub(super) fn group() -> Self {
        Self {
            root: quote!(super::),
            image: quote!(&self.0.borrow().0),
            image_mut: quote!(&mut self.0.borrow_mut().0),
        }
    }

    /// How links begin: as module paths do.
    pub(super) fn link_root(&self) -> String {
        self.root.to_string().replace(' ', "")
    }

    /// Where `dictionary` is a reference, in a module.
    pub(super) fn reference() -> Self {
        Self { root: quote!(super::), image: quote!(&dictionary.0), image_mut: quote!(&mut dictionary.0) }
    }
}

/// Code that gives a value.
pub(super) struct Get {
    pub value: TokenStream,
    /// The type of the value; for an alias that may have nothing to show, an `Option`.
    pub value_type: TokenStream,
}

/// Code that stores a value.
pub(super) struct Store {
    pub code: TokenStream,
    /// The error of the `Result` that the code gives; `None` for code that always succeeds and gives nothing.
    pub error: Option<TokenStream>,
}

/// Printing of values for one dictionary.
pub(super) struct Values<'p, 'a> {
    pub plan: &'p Plan<'a>,
}

impl Values<'_, '_> {
    fn is_bits(&self, kind: &ValueKind) -> bool {
        let named =
            kind.named.as_ref().and_then(|name| self.plan.types.iter().find(|planned| planned.name == *name));
        named.is_some_and(|planned| matches!(planned.members, Members::Bits(_)))
    }

    fn carrier(&self, kind: &ValueKind) -> Option<Carrier> {
        Carrier::of(kind, self.is_bits(kind))
    }

    fn raw(&self, kind: &ValueKind) -> Raw {
        match kind.data_type.family() {
            Family::Signed | Family::Unsigned => self.carrier(kind).map_or(Raw::Nothing, Raw::Integer),
            Family::Boolean => Raw::Bool,
            Family::Real if kind.data_type == DataType::Real32 => Raw::Single,
            Family::Real => Raw::Double,
            Family::VisibleString => Raw::Visible,
            Family::OctetString => Raw::Octets,
            Family::UnicodeString => Raw::Unicode,
            Family::Time => Raw::Time,
            Family::Domain => Raw::Nothing,
        }
    }

    /// The type without its wrapping: `u16`, `f32`, `bool`, `&str`.
    pub(super) fn raw_type(&self, kind: &ValueKind, root: &TokenStream) -> TokenStream {
        match self.raw(kind) {
            Raw::Integer(carrier) => carrier.name(),
            Raw::Bool => quote!(bool),
            Raw::Single => quote!(f32),
            Raw::Double => quote!(f64),
            Raw::Visible => quote!(&str),
            Raw::Octets => quote!(&[u8]),
            Raw::Unicode => quote!(#root glue::Utf16<'_>),
            Raw::Time => quote!(#root glue::Time),
            Raw::Nothing => quote!(()),
        }
    }

    /// The type that accessors give: `units::Volt<u16>`.
    pub(super) fn value_type(&self, kind: &ValueKind, root: &TokenStream) -> TokenStream {
        let raw = self.raw_type(kind, root);
        let inner = match (&kind.named, &kind.unit) {
            (Some(named), _) => {
                let named = format_ident!("{named}");
                quote!(#root types::#named)
            }
            (None, Some(unit)) => {
                let unit = format_ident!("{unit}");
                quote!(#root units::#unit<#raw>)
            }
            (None, None) => raw,
        };
        match self.special_name(kind) {
            Some(special) => quote!(#root glue::Special<#inner, #root specials::#special>),
            None => inner,
        }
    }

    fn special_name(&self, kind: &ValueKind) -> Option<proc_macro2::Ident> {
        let special = self.plan.specials.get(kind.special?)?;
        Some(format_ident!("{}", special.name))
    }

    /// Wraps a number, apart from special values.
    pub(super) fn wrap(kind: &ValueKind, root: &TokenStream, raw: &TokenStream) -> TokenStream {
        match (&kind.named, &kind.unit) {
            (Some(named), _) => {
                let named = format_ident!("{named}");
                quote!(#root types::#named(#raw))
            }
            (None, Some(unit)) => {
                let unit = format_ident!("{unit}");
                quote!(#root units::#unit(#raw))
            }
            (None, None) => raw.clone(),
        }
    }

    /// A value from its raw form.
    pub(super) fn decode(&self, kind: &ValueKind, root: &TokenStream, raw: &TokenStream) -> TokenStream {
        let (Some(special), Some(name)) =
            (kind.special.and_then(|at| self.plan.specials.get(at)), self.special_name(kind))
        else {
            return Self::wrap(kind, root, raw);
        };
        let arms = special.values.iter().map(|PlannedSpecialValue { name: variant, value, .. }| {
            let (variant, value) = (format_ident!("{variant}"), decimal(*value));
            quote!(#value => #root glue::Special::Special(#root specials::#name::#variant),)
        });
        let value = Self::wrap(kind, root, &quote!(value));
        quote!(match #raw { #(#arms)* value => #root glue::Special::Value(#value), })
    }

    /// A raw number as a constant value, which may be special.
    pub(super) fn constant(&self, kind: &ValueKind, root: &TokenStream, number: i128) -> TokenStream {
        let literal = decimal(number);
        let special = kind.special.and_then(|at| self.plan.specials.get(at)).zip(self.special_name(kind));
        let Some((special, name)) = special else { return Self::wrap(kind, root, &quote!(#literal)) };
        match special.values.iter().find(|special| special.value == number) {
            Some(special) => {
                let variant = format_ident!("{}", special.name);
                quote!(#root glue::Special::Special(#root specials::#name::#variant))
            }
            None => {
                let value = Self::wrap(kind, root, &quote!(#literal));
                quote!(#root glue::Special::Value(#value))
            }
        }
    }

    /// The raw form of a value.
    pub(super) fn encode(&self, kind: &ValueKind, root: &TokenStream, value: &TokenStream) -> TokenStream {
        let wrapped = kind.named.is_some() || kind.unit.is_some();
        let unwrap = |value: &TokenStream| if wrapped { quote!(#value.0) } else { value.clone() };
        let (Some(special), Some(name)) =
            (kind.special.and_then(|at| self.plan.specials.get(at)), self.special_name(kind))
        else {
            return unwrap(value);
        };
        let arms =
            special.values.iter().map(|PlannedSpecialValue { name: variant, value: number, .. }| {
                let (variant, number) = (format_ident!("{variant}"), decimal(*number));
                quote!(#root glue::Special::Special(#root specials::#name::#variant) => #number,)
            });
        let inner = unwrap(&quote!(value));
        quote!(match #value { #root glue::Special::Value(value) => #inner, #(#arms)* })
    }

    /// The raw form of the value at an offset of some bytes.
    pub(super) fn load(&self, kind: &ValueKind, size: usize, at: &At, offset: &TokenStream) -> TokenStream {
        let At { root, image, .. } = at;
        let size = Literal::usize_unsuffixed(size);
        match self.raw(kind) {
            Raw::Integer(carrier) if carrier.is_exact() => {
                let get = format_ident!("get_{}", carrier.name().to_string());
                quote!(#root glue::#get(#image, #offset))
            }
            Raw::Integer(carrier) => {
                let bytes = Literal::usize_unsuffixed(carrier.bytes);
                let get = if carrier.signed { quote!(get_signed) } else { quote!(get_unsigned) };
                quote!(#root glue::image::#get::<#bytes>(#image, #offset))
            }
            Raw::Bool => quote!(#root glue::get_bool(#image, #offset)),
            Raw::Single => quote!(#root glue::get_f32(#image, #offset)),
            Raw::Double => quote!(#root glue::get_f64(#image, #offset)),
            Raw::Time => quote!(#root glue::get_time(#image, #offset)),
            Raw::Visible => quote!(#root glue::text::visible(#image, #offset, #size)),
            Raw::Octets => quote!(#root glue::text::octets(#image, #offset, #size)),
            Raw::Unicode => quote!(#root glue::text::unicode(#image, #offset, #size)),
            Raw::Nothing => quote!(()),
        }
    }

    /// Code that puts a raw value at an offset.
    pub(super) fn store(
        &self,
        kind: &ValueKind,
        size: usize,
        at: &At,
        offset: &TokenStream,
        raw: &TokenStream,
    ) -> Store {
        let At { root, image_mut, .. } = at;
        let size = Literal::usize_unsuffixed(size);
        let always = |code| Store { code, error: None };
        let in_range = |code| Store { code, error: Some(quote!(#root glue::OutOfRange)) };
        let with_room = |code| Store { code, error: Some(quote!(#root glue::NoFit)) };
        match self.raw(kind) {
            Raw::Integer(carrier) if carrier.is_exact() => {
                let put = format_ident!("put_{}", carrier.name().to_string());
                always(quote!(#root glue::#put(#image_mut, #offset, #raw)))
            }
            Raw::Integer(carrier) => {
                let bytes = Literal::usize_unsuffixed(carrier.bytes);
                let put = if carrier.signed { quote!(put_signed) } else { quote!(put_unsigned) };
                in_range(quote!(#root glue::image::#put::<#bytes>(#image_mut, #offset, #raw)))
            }
            Raw::Bool => always(quote!(#root glue::put_bool(#image_mut, #offset, #raw))),
            Raw::Single => always(quote!(#root glue::put_f32(#image_mut, #offset, #raw))),
            Raw::Double => always(quote!(#root glue::put_f64(#image_mut, #offset, #raw))),
            Raw::Time => always(quote!(#root glue::put_time(#image_mut, #offset, #raw))),
            Raw::Visible => {
                with_room(quote!(#root glue::text::put_visible(#image_mut, #offset, #size, #raw)))
            }
            Raw::Octets => with_room(quote!(#root glue::text::put_octets(#image_mut, #offset, #size, #raw))),
            Raw::Unicode => {
                with_room(quote!(#root glue::text::put_unicode(#image_mut, #offset, #size, #raw)))
            }
            Raw::Nothing => always(quote!(())),
        }
    }

    /// What a setter takes.
    pub(super) fn parameter_type(&self, kind: &ValueKind, root: &TokenStream) -> TokenStream {
        if kind.data_type == DataType::UnicodeString { quote!(&str) } else { self.value_type(kind, root) }
    }

    /// The value of an entry wherever it lies; `None` for what lies with the application.
    pub(super) fn get(&self, entry: &PlannedEntry<'_>, at: &At) -> Option<Get> {
        let value_type = self.value_type(&entry.kind, &at.root);
        match entry.place {
            Place::Image(offset) => {
                let offset = Literal::usize_unsuffixed(offset);
                let raw = self.load(&entry.kind, entry.size, at, &quote!(#offset));
                Some(Get { value: self.decode(&entry.kind, &at.root, &raw), value_type })
            }
            Place::Constant(_) => {
                let raw = self.literal(entry)?;
                let value_type = match entry.kind.data_type.family() {
                    Family::VisibleString => quote!(&'static str),
                    Family::OctetString => quote!(&'static [u8]),
                    Family::Boolean
                    | Family::Signed
                    | Family::Unsigned
                    | Family::Real
                    | Family::UnicodeString
                    | Family::Time
                    | Family::Domain => value_type,
                };
                Some(Get { value: self.decode(&entry.kind, &at.root, &raw), value_type })
            }
            Place::Alias => {
                let alias = self.alias_of(entry)?;
                let target = self.number(self.plan.entry(alias.target)?, at)?;
                let (root, view) = (&at.root, view_name(entry));
                if alias.outside == Outside::Abort {
                    let narrow = self.narrowed(&entry.kind, root, &quote!(number));
                    let value = self.decode(&entry.kind, root, &narrow);
                    return Some(Get {
                        value: quote!(#root #view.show(#target).ok().map(|number| #value)),
                        value_type: quote!(Option<#value_type>),
                    });
                }
                let shown = quote!(#root #view.show_or_zero(#target));
                let raw = self.narrowed(&entry.kind, root, &shown);
                let value = self.decode(&entry.kind, root, &raw);
                Some(Get { value, value_type })
            }
            Place::Application => None,
        }
    }

    /// A number in 64 bits as the raw form of a value. A bit field on a signed base is unsigned in code.
    fn narrowed(&self, kind: &ValueKind, root: &TokenStream, number: &TokenStream) -> TokenStream {
        let narrow = self.raw_type(kind, root);
        if self.is_bits(kind) && kind.data_type.is_signed() {
            let bits = kind.data_type.bits().unwrap_or(64);
            let signed = format_ident!("i{}", if matches!(bits, 8 | 16 | 32) { bits } else { 64 });
            let mask =
                (!matches!(bits, 8 | 16 | 32 | 64)).then(|| hex((1 << bits) - 1, usize::from(bits / 4)));
            let mask = mask.map(|mask| quote!(& #mask));
            return quote!(#root glue::narrow::<#signed>(#number).cast_unsigned() #mask);
        }
        if kind.special.is_some() {
            return quote!(#root glue::narrow::<#narrow>(#number));
        }
        quote!(#root glue::narrow(#number))
    }

    /// The raw form of a value as a number in 64 bits.
    pub(super) fn widened(&self, kind: &ValueKind, raw: &TokenStream) -> TokenStream {
        let signed_bits = self.is_bits(kind) && kind.data_type.is_signed();
        match self.carrier(kind) {
            Some(carrier) if carrier.bytes < 8 && carrier.is_exact() && signed_bits => {
                quote!(i64::from((#raw).cast_signed()))
            }
            Some(carrier) if carrier.bytes < 8 && carrier.is_exact() => quote!(i64::from(#raw)),
            Some(carrier) if !carrier.signed => quote!((#raw).cast_signed()),
            _ => raw.clone(),
        }
    }

    pub(super) fn alias_of(&self, entry: &PlannedEntry<'_>) -> Option<&PlannedAlias> {
        let row = self.plan.row(entry.id)?;
        self.plan.aliases.iter().find(|alias| alias.row == row)
    }

    /// The raw integer of an entry in 64 bits.
    pub(super) fn number(&self, entry: &PlannedEntry<'_>, at: &At) -> Option<TokenStream> {
        let plain = ValueKind { named: None, unit: None, special: None, ..entry.kind.clone() };
        match entry.place {
            Place::Image(offset) => {
                let offset = Literal::usize_unsuffixed(offset);
                let raw = self.load(&plain, entry.size, at, &quote!(#offset));
                let carrier = Carrier::of(&plain, false);
                let narrow = carrier.is_some_and(|carrier| carrier.is_exact() && carrier.bytes < 8);
                let odd_unsigned = carrier.is_some_and(|carrier| !carrier.is_exact() && !carrier.signed);
                Some(if narrow || plain.data_type == DataType::Boolean {
                    quote!(i64::from(#raw))
                } else if odd_unsigned {
                    quote!(#raw.cast_signed())
                } else {
                    raw
                })
            }
            Place::Constant(_) => {
                let number = default_integer(entry.entry)?;
                let number = match (i64::try_from(number), u64::try_from(number)) {
                    (Ok(number), _) if plain.data_type != DataType::Unsigned64 => {
                        Literal::i64_suffixed(number)
                    }
                    (_, Ok(number)) => Literal::u64_suffixed(number),
                    _ => return None,
                };
                Some(quote!(#number))
            }
            Place::Alias => {
                let alias = self.alias_of(entry)?;
                let target = self.number(self.plan.entry(alias.target)?, at)?;
                let (root, view) = (&at.root, view_name(entry));
                Some(quote!(#root #view.show_or_zero(#target)))
            }
            Place::Application => None,
        }
    }

    /// The default of an entry as a raw literal.
    pub(super) fn literal(&self, entry: &PlannedEntry<'_>) -> Option<TokenStream> {
        let default = entry.entry.default.as_ref()?;
        self.literal_of(&entry.kind, default)
    }

    /// A value as a raw literal.
    pub(super) fn literal_of(&self, kind: &ValueKind, value: &Value) -> Option<TokenStream> {
        Some(match value {
            Value::Integer(raw) if kind.data_type == DataType::Boolean => {
                let value = *raw != 0;
                quote!(#value)
            }
            Value::Integer(raw) => {
                // The bits of a negative default of a bit field, which is unsigned in code.
                let raw = match self.carrier(kind) {
                    Some(carrier) if !carrier.signed && *raw < 0 => raw + (1 << (carrier.bytes * 8)),
                    _ => *raw,
                };
                let literal = if self.is_bits(kind) {
                    let digits = kind.data_type.bits().map_or(2, |bits| usize::from(bits.div_ceil(4)));
                    hex(u64::try_from(raw).ok()?, digits)
                } else {
                    decimal(raw)
                };
                quote!(#literal)
            }
            Value::Real(real) => {
                let literal = if kind.data_type == DataType::Real32 {
                    #[expect(
                        clippy::cast_possible_truncation,
                        reason = "the nearest value that the type has"
                    )]
                    let single = real.number() as f32;
                    Literal::f32_unsuffixed(single)
                } else {
                    Literal::f64_unsuffixed(real.number())
                };
                quote!(#literal)
            }
            Value::Text(text) if kind.data_type == DataType::VisibleString => quote!(#text),
            // Code has no constant for a formula, which each node resolves, nor for characters of 16 bits.
            Value::NodeId(_) | Value::Text(_) => return None,
            Value::Bytes(bytes) => {
                let literal = Literal::byte_string(bytes);
                quote!(#literal)
            }
        })
    }
}

/// The constant that says how an alias shows its target: `VIEW_5064`.
pub(super) fn view_name(entry: &PlannedEntry<'_>) -> proc_macro2::Ident {
    format_ident!("VIEW_{:04X}", entry.id.index.0)
}

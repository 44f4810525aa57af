//! Units, enums, bit fields and special values.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{ToTokens, TokenStreamExt as _, format_ident, quote};

use super::super::language;
use super::docs::{WORDING, doc, escape};
use super::literal::{decimal, hex};
use crate::facts;
use crate::plan::{
    Members, Plan, PlannedBits, PlannedOffset, PlannedSpecial, PlannedSpecialValue, PlannedType, PlannedUnit,
    PlannedValue, SignedFraction,
};

impl Plan<'_> {
    /// `mod units`.
    pub(super) fn units_module(&self) -> TokenStream {
        if self.units.is_empty() {
            return quote!();
        }
        let units = self.units.iter().map(|unit| self.unit(unit));
        let bases: BTreeSet<(String, &str)> =
            self.units.iter().map(|unit| (base_name(unit), unit.unit.base_symbol())).collect();
        let bases = bases.into_iter().map(|(name, symbol)| {
            let (about, name) = (doc(&format!("Measured in {}.", escape(symbol))), format_ident!("{name}"));
            quote!(#about #[derive(Debug)] pub enum #name {})
        });
        quote! {
            /// Physical units: newtypes around raw values.
            #[allow(dead_code, unreachable_pub)]
            pub mod units {
                #(#units)*

                /// What units have in common that convert into each other.
                pub mod bases {
                    #(#bases)*
                }
            }
        }
    }

    fn unit(&self, planned: &PlannedUnit<'_>) -> TokenStream {
        let PlannedUnit { unit, name, scale, step, offset } = planned;
        let about = self.words(&unit.about);
        let text =
            format!("{}: one raw step is {}.", escape(&unit.name), escape(&WORDING.counted_step(unit)));
        let about = doc(format!("{text} {about}").trim());
        let (name, base, symbol) =
            (format_ident!("{name}"), format_ident!("{}", base_name(planned)), &unit.symbol);
        let [n, d, sn, sd] = [scale.numerator, scale.denominator, step.numerator, step.denominator]
            .map(|number| decimal(number.into()));
        let offset = offset.map(|PlannedOffset { in_symbol, in_base }| {
            let fraction = |fraction: SignedFraction| {
                let (numerator, denominator) =
                    (decimal(fraction.numerator.into()), decimal(fraction.denominator.into()));
                quote!(#numerator / #denominator)
            };
            let (in_symbol, in_base) = (fraction(in_symbol), fraction(in_base));
            quote!(, offset #in_symbol, origin #in_base)
        });
        quote! {
            #about
            #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
            #[repr(transparent)]
            pub struct #name<__T>(pub __T);

            super::firmware::quantity! {
                #name = #symbol, scale #n / #d, step #sn / #sd of #base #offset
            }
        }
    }

    /// `mod types`.
    pub(super) fn types_module(&self) -> TokenStream {
        if self.types.is_empty() {
            return quote!();
        }
        let types = self.types.iter().map(|planned| self.named_type(planned));
        quote! {
            /// Enums and bit fields: newtypes around raw values, also around those without a name.
            #[allow(dead_code, unreachable_pub)]
            pub mod types {
                #(#types)*
            }
        }
    }

    fn named_type(&self, planned: &PlannedType<'_>) -> TokenStream {
        let name = format_ident!("{}", planned.name);
        let about = self.words(&planned.named.about);
        let text =
            format!("{}{}{about}", escape(&planned.named.name), if about.is_empty() { "." } else { ": " });
        let about = doc(&text);
        let raw = Carrier::of(planned);
        let derives = quote!(#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)] #[repr(transparent)]);
        let label = &planned.named.name;
        match &planned.members {
            Members::Values(values) => {
                let constants =
                    values.iter().map(|planned| self.constant(planned, &quote!(Self), &quote!(Self)));
                let names = values.iter().map(|PlannedValue { value, .. }| {
                    let (number, text) = (decimal(value.value), &value.name);
                    quote!(#number => #text,)
                });
                quote! {
                    #about
                    #derives
                    pub struct #name(pub #raw);

                    impl #name {
                        #(#constants)*
                    }

                    super::firmware::enumeration! {
                        #name(#raw) = #label { #(#names)* }
                    }
                }
            }
            Members::Bits(bits) => {
                let accessors = bits.iter().map(|bits| self.bits(bits, raw));
                let fields = bits.iter().map(|bits| {
                    let [first, last] = [bits.first, bits.last].map(Literal::u8_unsuffixed);
                    let label = &bits.label;
                    quote!(#first..=#last => #label,)
                });
                quote! {
                    #about
                    #derives
                    pub struct #name(pub #raw);

                    impl #name {
                        #(#accessors)*
                    }

                    super::firmware::bit_field! {
                        #name = #label { #(#fields)* }
                    }
                }
            }
        }
    }

    fn constant(&self, planned: &PlannedValue<'_>, ty: &TokenStream, wrap: &TokenStream) -> TokenStream {
        let PlannedValue { name, value } = planned;
        let (name, number) = (format_ident!("{name}"), decimal(value.value));
        let about = self.words(&value.about);
        let support = if value.supported { "" } else { " Not supported." };
        let text = format!(
            "{} {}{}{about}",
            value.value,
            escape(&value.name),
            if about.is_empty() { "." } else { ": " }
        );
        let about = doc(&format!("{text}{support}"));
        quote!(#about pub const #name: #ty = #wrap(#number);)
    }

    /// The accessors of a bit or of a run of bits.
    fn bits(&self, bits: &PlannedBits<'_>, raw: Carrier) -> TokenStream {
        let accessors = if bits.first == bits.last { one_bit(bits, raw) } else { run(bits, raw) };
        let own = Carrier::of_run(bits);
        let constants = bits.values.iter().map(|PlannedValue { name, value }| {
            let (name, number) = (format_ident!("{name}"), decimal(value.value));
            let about = self.words(&value.about);
            let end = if about.is_empty() { "." } else { ": " };
            let about = doc(&format!(
                "{} of [`{}`](Self::{}): {}{end}{about}",
                value.value,
                bits.name,
                bits.name,
                escape(&value.name)
            ));
            quote!(#about pub const #name: #own = #number;)
        });
        // A single bit is a `bool`, which needs no constants.
        let constants = constants.filter(|_| bits.first != bits.last);
        let about = self.bits_doc(bits);
        quote!(#(#constants)* #about #accessors)
    }

    fn bits_doc(&self, bits: &PlannedBits<'_>) -> TokenStream {
        doc(&facts::bits(self, bits, escape))
    }

    /// `mod specials`.
    pub(super) fn specials_module(&self) -> TokenStream {
        if self.specials.is_empty() {
            return quote!();
        }
        let specials = self.specials.iter().filter_map(|planned| {
            let is_first = self.specials.iter().find(|other| other.name == planned.name) == Some(planned);
            is_first.then(|| special(planned, &self.numbers_of(planned)))
        });
        quote! {
            /// Raw values with a meaning of their own, in addition to the ordinary ones.
            #[allow(dead_code, unreachable_pub)]
            pub mod specials {
                #(#specials)*
            }
        }
    }
    /// The raw values of each meaning of a set: one, or several where entries differ in it. A value is as wide as in the first
    /// entry that has it.
    fn numbers_of(&self, set: &PlannedSpecial) -> Vec<String> {
        let same_name = (0..).zip(&self.specials).filter(|(_, other)| other.name == set.name);
        let mut numbers = vec![Vec::new(); set.values.len()];
        for (at, other) in same_name {
            let Some(planned) = self.entries.iter().find(|entry| entry.kind.special == Some(at)) else {
                continue;
            };
            for (of_meaning, special) in numbers.iter_mut().zip(&other.values) {
                let number = WORDING.special_number(planned.entry, special.value);
                if !of_meaning.contains(&number) {
                    of_meaning.push(number);
                }
            }
        }
        numbers.iter().map(|of_meaning| of_meaning.join(" or ")).collect()
    }
}

/// A value at the place of some bits, or from there.
fn shifted(bits: &PlannedBits<'_>, value: TokenStream, operator: &TokenStream) -> TokenStream {
    let first = Literal::u8_unsuffixed(bits.first);
    if bits.first == 0 { value } else { quote!(#value #operator #first) }
}

/// The documentation of what gives a word with other bits.
fn with_doc(bits: &PlannedBits<'_>) -> TokenStream {
    doc(&format!("With another [`{}`](Self::{}).", bits.name, bits.name))
}

fn one_bit(bits: &PlannedBits<'_>, raw: Carrier) -> TokenStream {
    let (get, with, with_about) = (format_ident!("{}", bits.name), with(bits), with_doc(bits));
    let read = shifted(bits, quote!(self.0), &quote!(>>));
    let mask = shifted(bits, quote!(1), &quote!(<<));
    let set = shifted(bits, quote!((value as #raw)), &quote!(<<));
    quote! {
        #[inline]
        pub const fn #get(self) -> bool {
            #read & 1 != 0
        }

        #with_about
        #[inline]
        #[must_use]
        pub const fn #with(self, value: bool) -> Self {
            Self(self.0 & !(#mask) | #set)
        }
    }
}

/// A run of bits has the smallest integer that holds it. What that integer holds and the run does not, is refused.
fn run(bits: &PlannedBits<'_>, raw: Carrier) -> TokenStream {
    let (get, with) = (format_ident!("{}", bits.name), with(bits));
    let (count, own) = (count(bits), Carrier::of_run(bits));
    let max = u64::MAX >> (64 - count);
    let mask = hex(max, usize::from(count.div_ceil(4)));
    let cast = |value: TokenStream, to: Carrier| if own == raw { value } else { quote!(#value as #to) };
    let (read, set) = if count == raw.bits {
        (quote!(self.0), quote!(Self(value)))
    } else {
        let read = shifted(bits, quote!(self.0), &quote!(>>));
        let read = if own == raw { quote!(#read & #mask) } else { quote!((#read & #mask)) };
        let place = shifted(bits, quote!(#mask), &quote!(<<));
        let value = cast(quote!(value), raw);
        let value = if own == raw || bits.first == 0 { value } else { quote!((#value)) };
        let set = shifted(bits, value, &quote!(<<));
        (cast(read, own), quote!(Self(self.0 & !(#place) | #set)))
    };
    let getter = quote! {
        #[inline]
        pub const fn #get(self) -> #own {
            #read
        }
    };
    if count == own.bits {
        let about = with_doc(bits);
        return quote! {
            #getter

            #about
            #[inline]
            #[must_use]
            pub const fn #with(self, value: #own) -> Self {
                #set
            }
        };
    }
    let about = doc(&format!(
        "With another [`{}`](Self::{}); `None` for a value above {max}, which its bits cannot hold.",
        bits.name, bits.name
    ));
    quote! {
        #getter

        #about
        #[inline]
        #[must_use]
        pub const fn #with(self, value: #own) -> Option<Self> {
            if value > #mask {
                return None;
            }
            Some(#set)
        }
    }
}

/// How many bits a run has.
fn count(bits: &PlannedBits<'_>) -> u16 {
    u16::from(bits.last - bits.first) + 1
}

fn with(bits: &PlannedBits<'_>) -> Ident {
    format_ident!("{}", language::with(&bits.name))
}

/// The type of a set of special values, with the raw values of each meaning.
fn special(planned: &PlannedSpecial, numbers: &[String]) -> TokenStream {
    let name = format_ident!("{}", planned.name);
    let meanings = || planned.values.iter().zip(numbers);
    let texts: Vec<String> =
        meanings().map(|(value, numbers)| format!("{} ({numbers})", escape(&value.text))).collect();
    let about = doc(&format!("{}.", texts.join(" or ")));
    let variants = meanings().map(|(PlannedSpecialValue { name, text, .. }, numbers)| {
        let about = doc(&format!("{}: raw value {numbers}.", escape(text)));
        let variant = format_ident!("{name}");
        quote!(#about #variant,)
    });
    let names = planned.values.iter().map(|PlannedSpecialValue { name, text, .. }| {
        let variant = format_ident!("{name}");
        quote!(Self::#variant => #text,)
    });
    quote! {
        #about
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum #name {
            #(#variants)*
        }

        impl #name {
            /// What the value means, as the specification says it.
            pub const fn name(self) -> &'static str {
                match self {
                    #(#names)*
                }
            }
        }

        /// What the value means.
        impl core::fmt::Display for #name {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                f.write_str(self.name())
            }
        }

        super::firmware::defmt_text!(#name);
    }
}

/// The base of a unit as an identifier of its own, whatever characters its symbol has: `BaseV`, `BasePUPersUB2`.
fn base_name(planned: &PlannedUnit<'_>) -> String {
    planned.unit.base_symbol().chars().fold("Base".to_owned(), |mut name, c| {
        match c {
            c if c.is_ascii_alphanumeric() => name.push(c),
            '/' => name.push_str("Per"),
            '°' => name.push_str("Degree"),
            '%' => name.push_str("Percent"),
            c => {
                let _ = write!(name, "U{:X}", u32::from(c));
            }
        }
        name
    })
}

/// An integer of Rust.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Carrier {
    bits: u16,
    signed: bool,
}

impl Carrier {
    /// That of a named type: a bit field is unsigned, whatever its base.
    fn of(planned: &PlannedType<'_>) -> Self {
        let bits = planned.named.base.bits().filter(|bits| matches!(bits, 8 | 16 | 32)).unwrap_or(64);
        Self { bits, signed: planned.named.base.is_signed() && matches!(planned.members, Members::Values(_)) }
    }

    /// The smallest that holds a run of bits.
    fn of_run(bits: &PlannedBits<'_>) -> Self {
        Self { bits: count(bits).next_power_of_two().max(8), signed: false }
    }
}

impl ToTokens for Carrier {
    fn to_tokens(&self, tokens: &mut TokenStream) {
        tokens.append(format_ident!("{}{}", if self.signed { 'i' } else { 'u' }, self.bits));
    }
}

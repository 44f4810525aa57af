//! Units, enums, bit fields and special values.

use std::fmt::Write as _;

use od_spec::model::{Edge, EnumValue};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::super::plan::{Members, Plan, PlannedBits, PlannedSpecial, PlannedType, PlannedUnit};
use super::docs::{doc, escape};
use super::value::{decimal, hex};

impl Plan<'_> {
    /// `mod units`.
    pub(super) fn units_module(&self) -> TokenStream {
        if self.units.is_empty() {
            return quote!();
        }
        let units = self.units.iter().map(|unit| self.unit(unit));
        let mut bases: Vec<(&str, &str)> =
            self.units.iter().map(|unit| (unit.base.as_str(), unit.unit.base_symbol())).collect();
        bases.sort_unstable();
        bases.dedup();
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
        let PlannedUnit { unit, name, scale, step, base } = planned;
        let about = self.words(&unit.about);
        let text = format!("{}: one raw step is {}.", escape(&unit.name), escape(&step_text(unit)));
        let about = doc(format!("{text} {about}").trim());
        let (name, base, symbol) = (format_ident!("{name}"), format_ident!("{base}"), &unit.symbol);
        let [n, d, sn, sd] = [scale.0, scale.1, step.0, step.1].map(|number| decimal(number.into()));
        quote! {
            ::firmware_glue::unit! {
                #about
                pub struct #name = #symbol, scale #n / #d, step #sn / #sd of #base;
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
            /// Enums and bit fields: newtypes around raw values, also around those that nobody named.
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
        let raw = carrier(planned);
        let derives = quote!(#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)] #[repr(transparent)]);
        let label = &planned.named.name;
        match &planned.members {
            Members::Values(values) => {
                let constants = values
                    .iter()
                    .map(|(constant, value)| self.constant(constant, value, &quote!(Self), &quote!(Self)));
                let names = values.iter().map(|(_, value)| {
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

                    ::firmware_glue::enumeration! {
                        #name(#raw) = #label { #(#names)* }
                    }
                }
            }
            Members::Bits(bits) => {
                let width = planned.named.base.bits().unwrap_or(64);
                let accessors = bits.iter().map(|bits| self.bits(bits, &raw, width));
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

                    ::firmware_glue::bit_field! {
                        #name = #label { #(#fields)* }
                    }
                }
            }
        }
    }

    fn constant(&self, name: &str, value: &EnumValue, ty: &TokenStream, wrap: &TokenStream) -> TokenStream {
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

    fn bits(&self, bits: &PlannedBits<'_>, raw: &TokenStream, width: u16) -> TokenStream {
        let (get, with) = (format_ident!("{}", bits.name), format_ident!("with_{}", bits.name));
        let about = self.bits_doc(bits);
        let with_about = doc(&format!("With another [`{}`](Self::{}).", bits.name, bits.name));
        let shift = |value: TokenStream, operator: TokenStream| {
            let first = Literal::u8_unsuffixed(bits.first);
            if bits.first == 0 { value } else { quote!(#value #operator #first) }
        };
        let (left, right) = (|value| shift(value, quote!(<<)), |value| shift(value, quote!(>>)));
        if bits.first == bits.last {
            let (read, mask, set) = (right(quote!(self.0)), left(quote!(1)), left(quote!((value as #raw))));
            return quote! {
                #about
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
            };
        }
        let run = u16::from(bits.last - bits.first) + 1;
        let mask = hex(u64::MAX >> (64 - run), usize::from(run.div_ceil(4)));
        let constants = bits.values.iter().map(|(name, value)| {
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
            quote!(#about pub const #name: #raw = #number;)
        });
        let (read, write) = if run == width {
            (quote!(self.0), quote!(Self(value)))
        } else {
            let (read, place, set) =
                (right(quote!(self.0)), left(quote!(#mask)), left(quote!((value & #mask))));
            (quote!(#read & #mask), quote!(Self(self.0 & !(#place) | #set)))
        };
        quote! {
            #(#constants)*

            #about
            #[inline]
            pub const fn #get(self) -> #raw {
                #read
            }

            #with_about
            #[inline]
            #[must_use]
            pub const fn #with(self, value: #raw) -> Self {
                #write
            }
        }
    }

    fn bits_doc(&self, bits: &PlannedBits<'_>) -> TokenStream {
        let place = if bits.first == bits.last {
            format!("Bit {}", bits.first)
        } else {
            format!("Bits {} to {}", bits.first, bits.last)
        };
        let about = self.words(bits.about);
        let mut text =
            format!("{place}, {}{}{about}", escape(&bits.label), if about.is_empty() { "." } else { ": " });
        let field = bits.field;
        if field.active == 0 {
            text.push_str(" Active at 0.");
        }
        if let Some(edge) = field.edge {
            text.push_str(match edge {
                Edge::Rising => " Acts on a change to 1.",
                Edge::Falling => " Acts on a change to 0.",
                Edge::Both => " Acts on every change.",
            });
        }
        if let Some(clamp) = &field.clamp {
            let _ = write!(text, " Clamp {}.", escape(clamp));
        }
        if !field.errors.is_empty() {
            let codes: Vec<String> = field.errors.iter().map(|code| format!("{code:04X}h")).collect();
            let _ = write!(text, " Error {}.", codes.join(", "));
        }
        doc(&text)
    }

    /// `mod specials`.
    pub(super) fn specials_module(&self) -> TokenStream {
        if self.specials.is_empty() {
            return quote!();
        }
        let specials = self.specials.iter().map(special);
        quote! {
            /// Raw values with a meaning of their own, beside the ordinary ones.
            #[allow(dead_code, unreachable_pub)]
            pub mod specials {
                #(#specials)*
            }
        }
    }
}

fn special(planned: &PlannedSpecial) -> TokenStream {
    let name = format_ident!("{}", planned.name);
    let texts: Vec<String> =
        planned.values.iter().map(|(_, text, value)| format!("{} ({value})", escape(text))).collect();
    let about = doc(&format!("{}.", texts.join(" or ")));
    let variants = planned.values.iter().map(|(variant, text, value)| {
        let (about, variant): (_, Ident) =
            (doc(&format!("{}: raw value {value}.", escape(text))), format_ident!("{variant}"));
        quote!(#about #variant,)
    });
    let names = planned.values.iter().map(|(variant, text, _)| {
        let variant = format_ident!("{variant}");
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

        ::firmware_glue::defmt_text!(#name);
    }
}

fn step_text(unit: &od_spec::model::Unit) -> String {
    let text = unit.step_text();
    if text.starts_with(|first: char| first.is_ascii_digit()) { text } else { format!("1 {text}") }
}

/// The integer of a named type: a bit field is unsigned, whatever its base.
fn carrier(planned: &PlannedType<'_>) -> TokenStream {
    let bits = planned.named.base.bits().filter(|bits| matches!(bits, 8 | 16 | 32)).unwrap_or(64);
    let signed = planned.named.base.is_signed() && matches!(planned.members, Members::Values(_));
    let name = format_ident!("{}{bits}", if signed { 'i' } else { 'u' });
    quote!(#name)
}

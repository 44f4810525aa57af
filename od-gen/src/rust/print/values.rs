//! Defaults and limits as constants.

use od_spec::model::Value;
use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::docs::doc;
use super::value::Values;
use crate::plan::{Plan, PlannedEntry, ValueKind};

impl Plan<'_> {
    /// `mod defaults`: the values after a factory reset that the specification states, apart from those of PDOs.
    pub(super) fn defaults_module(&self) -> TokenStream {
        let values = Values { plan: self };
        let root = quote!(super::);
        let constants: Vec<_> = self
            .stated()
            .filter_map(|entry| {
                let default = entry.entry.default.as_ref().filter(|_| entry.entry.alias.is_none())?;
                let raw = values.literal_of(&entry.kind, default)?;
                let value = if entry.kind.special.is_some() {
                    let number = default.integer()?;
                    values.constant(&entry.kind, &root, number)
                } else {
                    values.decode(&entry.kind, &root, &raw)
                };
                let value_type = static_type(values.value_type(&entry.kind, &root), default);
                let about = doc(&format!("Of `{}`.", entry.id));
                let name = format_ident!("{}", entry.name.to_uppercase());
                Some(quote!(#about pub const #name: #value_type = #value;))
            })
            .collect();
        if constants.is_empty() {
            return quote!();
        }
        quote! {
            /// Values after a factory reset.
            #[allow(dead_code, unreachable_pub)]
            pub mod defaults {
                #(#constants)*
            }
        }
    }

    /// `mod limits`: smallest and largest values.
    pub(super) fn limits_module(&self) -> TokenStream {
        let values = Values { plan: self };
        let root = quote!(super::);
        let constants: Vec<_> = self
            .stated()
            .filter(|entry| entry.entry.is_limited())
            .map(|entry| {
                let kind = ValueKind { special: None, ..entry.kind.clone() };
                let end = |limit: &Value| {
                    let literal = values.literal_of(&kind, limit).unwrap_or_else(|| quote!(0));
                    values.decode(&kind, &root, &literal)
                };
                let (low, high) = entry.entry.limits();
                let of_type = match entry.entry.data_type.range() {
                    Some((lowest, highest)) => (end(&Value::Integer(lowest)), end(&Value::Integer(highest))),
                    None => {
                        let float = values.value_type(&kind, &root);
                        (quote!(#float::NEG_INFINITY), quote!(#float::INFINITY))
                    }
                };
                let low = low.as_ref().map_or(of_type.0, &end);
                let high = high.as_ref().map_or(of_type.1, &end);
                let value_type = values.value_type(&kind, &root);
                let about = doc(&format!("Of `{}`.", entry.id));
                let name = format_ident!("{}", entry.name.to_uppercase());
                quote!(#about pub const #name: RangeInclusive<#value_type> = #low..=#high;)
            })
            .collect();
        if constants.is_empty() {
            return quote!();
        }
        quote! {
            /// Smallest and largest values that can be written over the bus, apart from special values.
            #[allow(dead_code, unreachable_pub)]
            pub mod limits {
                use core::ops::RangeInclusive;

                #(#constants)*
            }
        }
    }

    /// Entries with values of the specification's own.
    fn stated(&self) -> impl Iterator<Item = &PlannedEntry<'_>> {
        self.entries.iter().filter(|entry| self.is_stated(entry))
    }
}

fn static_type(value_type: TokenStream, default: &Value) -> TokenStream {
    match default {
        Value::Text(_) => quote!(&str),
        Value::Bytes(_) => quote!(&[u8]),
        Value::Integer(_) | Value::NodeId(_) | Value::Real(_) => value_type,
    }
}

//! Default PDOs as structures.

use od_spec::model::{Direction, Outside, Value};
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::docs::{WORDING, doc};
use super::literal::hex;
use super::value::{At, Get, Store, Values};
use crate::plan::{Place, Plan, PlannedField, PlannedPdo};

impl Plan<'_> {
    /// `mod pdos`.
    pub(super) fn pdos_module(&self) -> TokenStream {
        if self.pdos.is_empty() {
            return quote!();
        }
        let pdos = self.pdos.iter().map(|pdo| self.pdo(pdo));
        quote! {
            /// PDOs with their default mappings.
            #[allow(dead_code, unreachable_pub)]
            pub mod pdos {
                #(#pdos)*
            }
        }
    }

    fn pdo(&self, planned: &PlannedPdo<'_>) -> TokenStream {
        let PlannedPdo { pdo, name, fields, bits, served: _ } = planned;
        let about = self.pdo_doc(planned);
        let name = format_ident!("{name}");
        let number = Literal::u16_unsuffixed(pdo.number);
        let length = Literal::usize_unsuffixed(usize::try_from(bits.div_ceil(8)).unwrap_or(8));
        let mapping = pdo.map.iter().map(|mapped| hex(mapped.parameter().into(), 8));
        let transmission = pdo.transmission.map(|transmission| {
            let transmission = Literal::u8_unsuffixed(transmission);
            quote! {
                /// Transmission type after a factory reset.
                pub const TRANSMISSION: u8 = #transmission;
            }
        });
        let cob_id = pdo.cob_id.as_ref().map(cob_id);
        let members = fields.iter().filter_map(|field| self.member(field));
        let unpack = fields.iter().filter_map(|field| self.unpack(field));
        let no_data = fields.is_empty();
        let pack = fields.iter().filter_map(|field| self.pack(field));
        let of = (pdo.direction == Direction::Transmit).then(|| self.pdo_of(planned)).flatten();
        let data = if no_data { quote!(_data) } else { quote!(data) };
        let pack =
            if no_data { quote!([0; #length]) } else { quote!(let mut data = [0; #length]; #(#pack)* data) };
        quote! {
            #about
            #[derive(Debug, Clone, Copy, PartialEq)]
            pub struct #name {
                #(#members)*
            }

            impl #name {
                /// Number of the PDO.
                pub const NUMBER: u16 = #number;
                /// Bytes of its data.
                pub const LENGTH: usize = #length;
                #transmission
                /// Mapping parameters after a factory reset: index, sub-index and bits of each entry.
                pub const MAPPING: &'static [u32] = &[#(#mapping),*];

                #cob_id

                /// The values in the data of the PDO.
                #[inline]
                pub fn unpack(#data: [u8; #length]) -> Self {
                    Self { #(#unpack)* }
                }

                /// The data of the PDO.
                #[inline]
                pub fn pack(self) -> [u8; #length] {
                    #pack
                }

                #of
            }

            const _: () = assert!(super::glue::pdo::mapped_bits(#name::MAPPING).div_ceil(8) == #name::LENGTH);
        }
    }

    /// The field of a mapped entry.
    fn member(&self, field: &PlannedField) -> Option<TokenStream> {
        let entry = self.entry(field.row)?;
        let last_bit = field.first_bit + u32::from(field.bits) - 1;
        let about = doc(&format!("`{}`, bits {} to {last_bit}.", entry.id, field.first_bit));
        let name = format_ident!("{}", field.name);
        let value_type = Values { plan: self }.value_type(&entry.kind, &quote!(super::));
        Some(quote!(#about pub #name: #value_type,))
    }

    fn pdo_doc(&self, planned: &PlannedPdo<'_>) -> TokenStream {
        let pdo = planned.pdo;
        let about = self.words(&pdo.about);
        let facts: String = [
            pdo.cob_id.as_ref().map(|cob_id| format!("CAN-ID {}, ", WORDING.can_id(cob_id))),
            pdo.transmission.map(|transmission| format!("transmission type {transmission}, ")),
            (!pdo.valid).then(|| "off after a factory reset, ".to_owned()),
        ]
        .into_iter()
        .flatten()
        .collect();
        doc(&format!(
            "{} {}: {}; parameters `{:04X}h` and `{:04X}h`.\n\n{about}",
            pdo.direction.pdo(),
            pdo.number,
            facts.trim_end_matches(", "),
            pdo.communication_index(),
            pdo.mapping_index(),
        ))
    }

    /// Whether a value fills whole bytes of the data.
    const fn is_aligned(field: &PlannedField) -> bool {
        field.first_bit.is_multiple_of(8) && field.bits.is_multiple_of(8)
    }

    fn unpack(&self, field: &PlannedField) -> Option<TokenStream> {
        let values = Values { plan: self };
        let entry = self.entry(field.row)?;
        let at = At { root: quote!(super::), image: quote!(&data), image_mut: quote!(&mut data) };
        let raw = if Self::is_aligned(field) {
            let offset = Literal::u32_unsuffixed(field.first_bit / 8);
            values.load(&entry.kind, entry.size, &at, &quote!(#offset))
        } else {
            let (first, bits) =
                (Literal::u32_unsuffixed(field.first_bit), Literal::u8_unsuffixed(field.bits));
            let bytes = quote!(&super::glue::pdo::get_bits(&data, #first, #bits).to_le_bytes());
            values.load(&entry.kind, entry.size, &At { image: bytes, ..at }, &quote!(0))
        };
        let (name, value) =
            (format_ident!("{}", field.name), values.decode(&entry.kind, &quote!(super::), &raw));
        Some(quote!(#name: #value,))
    }

    fn pack(&self, field: &PlannedField) -> Option<TokenStream> {
        let values = Values { plan: self };
        let entry = self.entry(field.row)?;
        let name = format_ident!("{}", field.name);
        let raw = values.encode(&entry.kind, &quote!(super::), &quote!(self.#name));
        let at = At { root: quote!(super::), image: quote!(&data), image_mut: quote!(&mut data) };
        if Self::is_aligned(field) {
            let offset = Literal::u32_unsuffixed(field.first_bit / 8);
            let Store { code, error } = values.store(&entry.kind, entry.size, &at, &quote!(#offset), &raw);
            // What does not fit its width is 0 in the data, as in the dictionary it came from.
            return Some(if error.is_some() { quote!(let _ = #code;) } else { quote!(#code;) });
        }
        let (first, bits) = (Literal::u32_unsuffixed(field.first_bit), Literal::u8_unsuffixed(field.bits));
        let bytes = At { image_mut: quote!(&mut bytes), ..at };
        let Store { code, error } = values.store(&entry.kind, entry.size, &bytes, &quote!(0), &raw);
        let store = if error.is_some() { quote!(let _ = #code;) } else { quote!(#code;) };
        Some(quote! {
            let mut bytes = [0; 8];
            #store
            super::glue::pdo::put_bits(&mut data, #first, #bits, u64::from_le_bytes(bytes));
        })
    }

    /// The values that a TPDO sends now; `None` if an alias in it may have nothing to show.
    fn pdo_of(&self, planned: &PlannedPdo<'_>) -> Option<TokenStream> {
        let values = Values { plan: self };
        let at = At::reference();
        // Constants are written into the code.
        let (mut members, mut asks) = (Vec::new(), false);
        for field in &planned.fields {
            let entry = self.entry(field.row)?;
            let may_abort = values.alias_of(entry).is_some_and(|alias| alias.outside == Outside::Abort);
            if may_abort {
                return None;
            }
            let (name, Get { value, .. }) = (format_ident!("{}", field.name), values.get(entry, &at)?);
            members.push(quote!(#name: #value,));
            asks |= !matches!(entry.place, Place::Constant(_));
        }
        let dictionary = format_ident!("{}", self.name);
        let parameter = if asks { quote!(dictionary) } else { quote!(_dictionary) };
        Some(quote! {
            /// The values of a dictionary now.
            #[inline]
            pub fn of(#parameter: &super::#dictionary) -> Self {
                Self { #(#members)* }
            }
        })
    }
}

/// The function that gives the COB-ID; of a formula, for a node.
fn cob_id(value: &Value) -> TokenStream {
    let (parameter, number) = match value {
        Value::NodeId(offset) => {
            let offset = hex(*offset, 3);
            (quote!(node_id: u8), quote!(#offset + node_id as u32))
        }
        fixed @ (Value::Integer(_) | Value::Real(_) | Value::Text(_) | Value::Bytes(_)) => {
            let raw = fixed.integer().and_then(|raw| u64::try_from(raw).ok()).unwrap_or_default();
            let number = hex(raw, 3);
            (quote!(), quote!(#number))
        }
    };
    quote! {
        /// COB-ID with its flag bits after a factory reset.
        pub const fn cob_id(#parameter) -> u32 {
            #number
        }
    }
}

//! Default PDOs as structures.

use od_spec::model::{Direction, Value};
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::super::plan::{Plan, PlannedField, PlannedPdo};
use super::docs::doc;
use super::value::{At, Values, hex};

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
        let PlannedPdo { pdo, name, fields, bits } = planned;
        let values = Values { plan: self };
        let root = quote!(super::);
        let about = self.pdo_doc(planned);
        let name = format_ident!("{name}");
        let number = Literal::u16_unsuffixed(pdo.number);
        let length = Literal::usize_unsuffixed(usize::try_from(bits.div_ceil(8)).unwrap_or(8));
        let mapping = pdo.map.iter().map(|mapped| hex(mapped.parameter().into(), 8));
        let transmission = Literal::u8_unsuffixed(pdo.transmission);
        let cob_id = match &pdo.cob_id {
            Value::NodeId(offset) => {
                let offset = hex(*offset, 3);
                quote!(#offset + node_id as u32)
            }
            cob_id => {
                let number =
                    hex(cob_id.integer().and_then(|raw| u64::try_from(raw).ok()).unwrap_or_default(), 3);
                quote!(#number)
            }
        };
        let node_id = if matches!(pdo.cob_id, Value::NodeId(_)) { quote!(node_id: u8) } else { quote!() };
        let members = fields.iter().filter_map(|field| {
            let entry = self.entry(field.row)?;
            let about = doc(&format!(
                "`{}`, bits {} to {}.",
                entry.id,
                field.first_bit,
                field.first_bit + u32::from(field.bits) - 1
            ));
            let (name, ty) = (format_ident!("{}", field.name), values.value_type(&entry.kind, &root));
            Some(quote!(#about pub #name: #ty,))
        });
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
                /// Transmission type after a factory reset.
                pub const TRANSMISSION: u8 = #transmission;
                /// Mapping parameters after a factory reset: index, sub-index and bits of each entry.
                pub const MAPPING: &'static [u32] = &[#(#mapping),*];

                /// COB-ID with its flag bits after a factory reset.
                pub const fn cob_id(#node_id) -> u32 {
                    #cob_id
                }

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

    fn pdo_doc(&self, planned: &PlannedPdo<'_>) -> TokenStream {
        let pdo = planned.pdo;
        let about = self.words(&pdo.about);
        let cob_id = match &pdo.cob_id {
            Value::NodeId(offset) => format!("COB-ID {:X}h + node-ID", offset & 0x7FF),
            cob_id => format!("COB-ID {:X}h", cob_id.integer().unwrap_or_default() & 0x7FF),
        };
        let valid = if pdo.valid { "" } else { ", off after a factory reset" };
        doc(&format!(
            "{} {}: {cob_id}, transmission type {}{valid}; parameters `{:04X}h` and `{:04X}h`.\n\n{about}",
            pdo.direction.pdo(),
            pdo.number,
            pdo.transmission,
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
            let (store, error) = values.store(&entry.kind, entry.size, &at, &quote!(#offset), &raw);
            // What does not fit its width is 0 in the data, as in the dictionary it came from.
            return Some(if error.is_some() { quote!(let _ = #store;) } else { quote!(#store;) });
        }
        let (first, bits) = (Literal::u32_unsuffixed(field.first_bit), Literal::u8_unsuffixed(field.bits));
        let bytes = At { image_mut: quote!(&mut bytes), ..at };
        let (store, error) = values.store(&entry.kind, entry.size, &bytes, &quote!(0), &raw);
        let store = if error.is_some() { quote!(let _ = #store;) } else { quote!(#store;) };
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
        let mut members = Vec::new();
        for field in &planned.fields {
            let entry = self.entry(field.row)?;
            let may_abort =
                values.alias_of(entry).is_some_and(|alias| alias.outside == od_spec::model::Outside::Abort);
            if may_abort {
                return None;
            }
            let (name, (value, _)) = (format_ident!("{}", field.name), values.get(entry, &at)?);
            members.push(quote!(#name: #value,));
        }
        let dictionary = format_ident!("{}", self.name);
        let parameter = if members.is_empty() { quote!(_dictionary) } else { quote!(dictionary) };
        Some(quote! {
            /// The values of a dictionary now.
            #[inline]
            pub fn of(#parameter: &super::#dictionary) -> Self {
                Self { #(#members)* }
            }
        })
    }
}

//! What entries have in common, by the names of `firmware-glue`.

use od_spec::model::{DataType, Storage};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use super::super::plan::{Attributes, Flags, NONE, PlaceKind};

/// A row of `firmware_glue::table::Attributes`.
pub(super) fn attributes(attributes: &Attributes) -> TokenStream {
    let data_type = data_type_name(attributes.data_type);
    let flags = flags(attributes.flags);
    let place = match attributes.place {
        PlaceKind::Image => quote!(Image),
        PlaceKind::Constant => quote!(Constant),
        PlaceKind::Alias => quote!(Alias),
        PlaceKind::Application => quote!(Application),
    };
    let storage = storage(attributes.storage);
    let (page, size) =
        (Literal::usize_unsuffixed(attributes.page), Literal::usize_unsuffixed(attributes.size));
    let reference = |at: u16| {
        if at == NONE {
            quote!(glue::table::NONE)
        } else {
            let at = Literal::u16_unsuffixed(at);
            quote!(#at)
        }
    };
    let (limits, values, condition) =
        (reference(attributes.limits), reference(attributes.values), reference(attributes.condition));
    quote! {
        glue::table::Attributes {
            data_type: glue::DataType::#data_type,
            flags: #flags,
            place: glue::table::Place::#place,
            storage: #storage,
            page: #page,
            size: #size,
            limits: #limits,
            values: #values,
            condition: #condition,
        }
    }
}

/// `firmware_glue::table::Flags`, by their names.
fn flags(flags: Flags) -> TokenStream {
    let Flags { read, write, locked, receive, transmit, sparse, only_values } = flags;
    let set = [
        (read, quote!(READ)),
        (write, quote!(WRITE)),
        (locked, quote!(LOCKED)),
        (receive, quote!(RECEIVE)),
        (transmit, quote!(TRANSMIT)),
        (sparse, quote!(SPARSE)),
        (only_values, quote!(ONLY_VALUES)),
    ];
    let mut names = set.into_iter().filter(|(is_set, _)| *is_set).map(|(_, name)| name);
    let first = names.next().unwrap_or_else(|| quote!(NONE));
    quote!(glue::table::Flags::#first #(.with(glue::table::Flags::#names))*)
}

/// The name of a storage group in `firmware_glue::Storage`.
pub(super) fn storage(storage: Storage) -> TokenStream {
    let name = match storage {
        Storage::No => quote!(No),
        Storage::Communication => quote!(Communication),
        Storage::Application => quote!(Application),
        Storage::Manufacturer => quote!(Manufacturer),
        Storage::Remanent => quote!(Remanent),
    };
    quote!(glue::Storage::#name)
}

/// The name of a data type in `firmware_glue::DataType`.
pub(super) fn data_type_name(data_type: DataType) -> Ident {
    let name = match data_type {
        DataType::Boolean => "Boolean",
        DataType::Integer8 => "Integer8",
        DataType::Integer16 => "Integer16",
        DataType::Integer32 => "Integer32",
        DataType::Unsigned8 => "Unsigned8",
        DataType::Unsigned16 => "Unsigned16",
        DataType::Unsigned32 => "Unsigned32",
        DataType::Real32 => "Real32",
        DataType::VisibleString => "VisibleString",
        DataType::OctetString => "OctetString",
        DataType::UnicodeString => "UnicodeString",
        DataType::TimeOfDay => "TimeOfDay",
        DataType::TimeDifference => "TimeDifference",
        DataType::Domain => "Domain",
        DataType::Integer24 => "Integer24",
        DataType::Real64 => "Real64",
        DataType::Integer40 => "Integer40",
        DataType::Integer48 => "Integer48",
        DataType::Integer56 => "Integer56",
        DataType::Integer64 => "Integer64",
        DataType::Unsigned24 => "Unsigned24",
        DataType::Unsigned40 => "Unsigned40",
        DataType::Unsigned48 => "Unsigned48",
        DataType::Unsigned56 => "Unsigned56",
        DataType::Unsigned64 => "Unsigned64",
    };
    Ident::new(name, Span::call_site())
}

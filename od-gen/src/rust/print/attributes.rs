//! What entries have in common, by the names of `firmware-glue`.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::glue;
use crate::plan::{Attributes, Flags, NONE, PlaceKind};

/// A row of `firmware_glue::table::Attributes`.
pub(super) fn attributes(attributes: &Attributes) -> TokenStream {
    let data_type = glue::data_type(attributes.data_type);
    let flags = flags(attributes.flags);
    let place = match attributes.place {
        PlaceKind::Image => quote!(Image),
        PlaceKind::Constant => quote!(Constant),
        PlaceKind::Alias => quote!(Alias),
        PlaceKind::Application => quote!(Application),
    };
    let storage = glue::storage(attributes.storage);
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
            data_type: #data_type,
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

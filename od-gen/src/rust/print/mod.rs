//! A plan as Rust.

mod accessors;
mod attributes;
mod docs;
mod errors;
mod glue;
mod literal;
mod machine_names;
mod machines;
mod pdos;
mod runs;
mod table;
mod transitions;
mod types;
mod value;
mod values;

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use crate::plan::Plan;

/// The layout of `firmware-glue` that is printed for: `firmware_glue::table::Table::generated` tells when it changes.
const LAYOUT: u32 = 2;

/// The items of a dictionary's module. One import reaches out of it, and its types do not come from macros: where the crate has no
/// `firmware-glue`, that import is the one error.
pub(super) fn tokens(plan: &Plan<'_>) -> TokenStream {
    let parts = [
        plan.dictionary(),
        plan.entry_enum(),
        plan.records_module(),
        plan.pdos_module(),
        plan.types_module(),
        plan.specials_module(),
        plan.machines_module(),
        plan.errors_module(),
        plan.units_module(),
        plan.defaults_module(),
        plan.limits_module(),
        plan.traits(),
        plan.views(),
        plan.lookup_tables(),
        plan.tables(),
    ];
    let glue = format_ident!("generated_for_layout_{LAYOUT}");
    let (layout, dictionary) = (Literal::u32_unsuffixed(LAYOUT), format_ident!("{}", plan.name));
    quote! {
        use ::firmware_glue as firmware;
        use self::firmware::#glue as glue;

        firmware::stand_in!(#layout, #dictionary, Entry);

        #(#parts)*
    }
}

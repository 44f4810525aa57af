//! A plan as Rust.

mod accessors;
mod docs;
mod glue;
mod literal;
mod machines;
mod pdos;
mod table;
mod types;
mod value;
mod values;

use proc_macro2::TokenStream;
use quote::quote;

use crate::plan::Plan;

/// The items of a dictionary's module.
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
    quote! {
        use ::firmware_glue as glue;

        #(#parts)*
    }
}

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

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use crate::plan::Plan;

/// The layout of `firmware-glue` that is printed for; its module of this name describes when the number changes.
const LAYOUT: &str = "generated_for_layout_1";

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
    let glue = format_ident!("{LAYOUT}");
    quote! {
        use ::firmware_glue as firmware;
        use self::firmware::#glue as glue;

        #(#parts)*
    }
}

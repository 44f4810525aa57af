//! The enums of `firmware-glue`, by name.

use od_spec::model::{DataType, Outside, Rounding, Storage};
use proc_macro2::TokenStream;
use quote::quote;

/// `glue::DataType::Unsigned16`.
pub(super) fn data_type(data_type: DataType) -> TokenStream {
    match data_type {
        DataType::Boolean => quote!(glue::DataType::Boolean),
        DataType::Integer8 => quote!(glue::DataType::Integer8),
        DataType::Integer16 => quote!(glue::DataType::Integer16),
        DataType::Integer24 => quote!(glue::DataType::Integer24),
        DataType::Integer32 => quote!(glue::DataType::Integer32),
        DataType::Integer40 => quote!(glue::DataType::Integer40),
        DataType::Integer48 => quote!(glue::DataType::Integer48),
        DataType::Integer56 => quote!(glue::DataType::Integer56),
        DataType::Integer64 => quote!(glue::DataType::Integer64),
        DataType::Unsigned8 => quote!(glue::DataType::Unsigned8),
        DataType::Unsigned16 => quote!(glue::DataType::Unsigned16),
        DataType::Unsigned24 => quote!(glue::DataType::Unsigned24),
        DataType::Unsigned32 => quote!(glue::DataType::Unsigned32),
        DataType::Unsigned40 => quote!(glue::DataType::Unsigned40),
        DataType::Unsigned48 => quote!(glue::DataType::Unsigned48),
        DataType::Unsigned56 => quote!(glue::DataType::Unsigned56),
        DataType::Unsigned64 => quote!(glue::DataType::Unsigned64),
        DataType::Real32 => quote!(glue::DataType::Real32),
        DataType::Real64 => quote!(glue::DataType::Real64),
        DataType::VisibleString => quote!(glue::DataType::VisibleString),
        DataType::OctetString => quote!(glue::DataType::OctetString),
        DataType::UnicodeString => quote!(glue::DataType::UnicodeString),
        DataType::TimeOfDay => quote!(glue::DataType::TimeOfDay),
        DataType::TimeDifference => quote!(glue::DataType::TimeDifference),
        DataType::Domain => quote!(glue::DataType::Domain),
    }
}

/// `glue::Outside::Saturate`.
pub(super) fn outside(outside: Outside) -> TokenStream {
    match outside {
        Outside::Saturate => quote!(glue::Outside::Saturate),
        Outside::Wrap => quote!(glue::Outside::Wrap),
        Outside::Abort => quote!(glue::Outside::Abort),
    }
}

/// `glue::Rounding::Down`.
pub(super) fn rounding(rounding: Rounding) -> TokenStream {
    match rounding {
        Rounding::Down => quote!(glue::Rounding::Down),
        Rounding::Up => quote!(glue::Rounding::Up),
        Rounding::Nearest => quote!(glue::Rounding::Nearest),
        Rounding::Zero => quote!(glue::Rounding::Zero),
    }
}

/// `glue::Storage::Communication`.
pub(super) fn storage(storage: Storage) -> TokenStream {
    match storage {
        Storage::No => quote!(glue::Storage::No),
        Storage::Communication => quote!(glue::Storage::Communication),
        Storage::Application => quote!(glue::Storage::Application),
        Storage::Manufacturer => quote!(glue::Storage::Manufacturer),
        Storage::Remanent => quote!(glue::Storage::Remanent),
    }
}

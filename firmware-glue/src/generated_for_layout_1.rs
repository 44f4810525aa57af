//! What generated code of the present layout uses: the contract between the generator and this crate.
//!
//! A generated file imports this module under the name of the layout that it was made for. A change here, or in what something
//! here means, with which a file made before no longer compiles or does something else, needs another number: in the name of
//! this module, and in the generator (`od-gen`, `LAYOUT`). A file of the other layout then has one error, at its import: of
//! what comes from an import that failed, the compiler reports nothing more. The traits of the dictionary and the macros of
//! types are used without a layout, so that the program around such a file has no error either.

pub use crate::access::constraint::Constraint;
pub use crate::pdo;
pub use crate::table::view::{Outside, Rounding, View};
pub use crate::table::{self, Storage, Table};
pub use crate::value::data_type::DataType;
pub use crate::value::image::{
    self, OutOfRange, get_bool, get_f32, get_f64, get_i8, get_i16, get_i32, get_i64, get_time, get_u8,
    get_u16, get_u32, get_u64, narrow, put_bool, put_f32, put_f64, put_i8, put_i16, put_i32, put_i64,
    put_time, put_u8, put_u16, put_u32, put_u64,
};
pub use crate::value::special::Special;
pub use crate::value::text::{self, NoFit, Utf16};
pub use crate::value::time::Time;

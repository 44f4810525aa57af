//! What generated code of the present layout uses, and nothing else: the contract between the generator and this crate.
//!
//! A generated file imports this module under the name of the layout that it was made for, `generated_for_layout_2`. Whoever
//! changes something here, or what it means, so that a file made before no longer compiles or does something else, changes the
//! number: in `lib.rs`, and in the generator (`od-gen`, `LAYOUT`). The macros that make types have no layout; see
//! [`Table::generated`].

pub use crate::alias::{Outside, Rounding, View};
pub use crate::constraint::{Constrained, Constraint};
pub use crate::data_type::DataType;
pub use crate::dictionary::Dictionary;
pub use crate::entries::Entries;
pub use crate::image::{
    self, OutOfRange, get_bool, get_f32, get_f64, get_i8, get_i16, get_i32, get_i64, get_time, get_u8,
    get_u16, get_u32, get_u64, narrow, put_bool, put_f32, put_f64, put_i8, put_i16, put_i32, put_i64,
    put_time, put_u8, put_u16, put_u32, put_u64,
};
pub use crate::pdo;
pub use crate::special::Special;
pub use crate::table::{self, Storage, Table};
pub use crate::text::{self, NoFit, Utf16};
pub use crate::time::Time;

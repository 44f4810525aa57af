//! How the rules of an area are listed: each once.

/// Declares the file of each rule of an area, and `RULES`, their list. `cargo fmt` does not look into macros; `rustfmt FILE` does
/// its work for such a file.
macro_rules! rules {
    ($rule:ty: $($name:ident,)+) => {
        $(pub(crate) mod $name;)+

        /// The rules of this area.
        pub(super) static RULES: &[$rule] = &[$($name::RULE),+];
    };
}

pub(crate) use rules;

//! What keeps the rest of a program quiet when a generated file is for another layout.

/// Implements the traits for a dictionary that was generated for another layout than the present one, so that the only error is
/// the one that tells so, and not one more for every use of the dictionary in the program. Of the present layout, it does
/// nothing.
#[doc(hidden)]
#[macro_export]
macro_rules! stand_in {
    (2, $dictionary:ident, $entry:ident) => {};
    ($other_layout:literal, $dictionary:ident, $entry:ident) => {
        impl $crate::Entries for $dictionary {
            type Entry = $entry;
        }

        impl $crate::Dictionary<'static> for $dictionary {
            fn table(&self) -> &'static $crate::Table<'static> {
                const { &$crate::Table::generated($crate::table::Parts::EMPTY) }
            }

            fn entry(&self, _: u16) -> ::core::option::Option<$entry> {
                ::core::option::Option::None
            }

            fn row(&self, _: $entry) -> u16 {
                0
            }

            fn image(&self) -> &[u8] {
                &[]
            }

            fn image_mut(&mut self) -> &mut [u8] {
                &mut []
            }

            fn condition(&self, _: u16) -> bool {
                false
            }
        }

        impl $crate::Constrained for $dictionary {
            const CONSTRAINTS: &'static [$crate::Constraint<Self>] = &[];
        }
    };
}

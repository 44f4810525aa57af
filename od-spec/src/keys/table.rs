//! How tables of keys are written down.
//!
//! Where each key is read into a field of its own, the table is a macro (`device_keys!`) that passes its rows on: to
//! [`keys`], which makes the table that checks, suggests and explains; to [`declaration`](crate::ast), which makes the
//! structure; and to [`reader`](crate::decode), which fills it. So one line says all there is to say about a key.

use super::shape::Key;

/// A table of keys: `"key" required: shape => field: type, "meaning", "example";`, where `required` (or `inherited`), the
/// field and the example may be left out. The keys that depend on each other precede it: `needs [One(["a", "b"])]`.
macro_rules! keys {
    ($(#[$meta:meta])* $name:ident = $title:literal $(needs [$($choice:ident($keys:expr)),+])? {
        $($key:literal $($need:ident)?: $shape:expr $(=> $field:ident: $type:ty)?, $about:literal
            $(, $example:literal)?;)+
    }) => {
        $(#[$meta])*
        pub static $name: Keys = Keys {
            name: $title,
            keys: $crate::keys::table::key_list! { $($key $($need)?: $shape, $about $(, $example)?;)+ },
            choices: &[$($($crate::keys::Choice::$choice(&$keys)),+)?],
        };
    };
}
pub(super) use keys;

/// The keys of a table without the table.
macro_rules! key_list {
    ($($key:literal $($need:ident)?: $shape:expr, $about:literal $(, $example:literal)?;)+) => {
        &[$(Key {
            name: $key,
            shape: $shape,
            need: $crate::keys::table::key_list!(@need $($need)?),
            about: $about,
            example: $crate::keys::table::key_list!(@example $($example)?),
        },)+]
    };
    (@need required) => { $crate::keys::Need::Required };
    (@need inherited) => { $crate::keys::Need::Inherited };
    (@need) => { $crate::keys::Need::Optional };
    (@example $example:literal) => { Some($example) };
    (@example) => { None };
}
pub(super) use key_list;

/// Lists of keys, one after the other.
pub(super) const fn joined<const N: usize>(lists: &[&[Key]]) -> [Key; N] {
    let mut keys = [lists[0][0]; N];
    let (mut list, mut length) = (0, 0);
    while list < lists.len() {
        let mut at = 0;
        while at < lists[list].len() {
            keys[length] = lists[list][at];
            at += 1;
            length += 1;
        }
        list += 1;
    }
    assert!(length == N);
    keys
}
